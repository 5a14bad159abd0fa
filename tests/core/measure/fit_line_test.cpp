// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/measure/fit_line.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

Span<const FinePoint> span_of(const std::vector<FinePoint>& points) {
    return {points.data(), static_cast<std::ptrdiff_t>(points.size())};
}
Result<LineFit> robust(const std::vector<FinePoint>& points) {
    std::vector<FinePixel> scratch(points.size());
    return fit_line_robust(span_of(points), {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
}
double radians(FineAngle angle) { return angle.signed_raw() * pi / 2147483648.0; }

/// Points of a line through (x, y); a share `wrong` of them is moved away to one side.
std::vector<FinePoint> line_points(Random& random, int count, double x, double y, double angle, double noise,
                                   double wrong) {
    std::vector<FinePoint> points;
    for (int i = 0; i < count; ++i) {
        const double t = uniform(random, -80, 80);
        double away = noise * normal(random);
        if (std::floor((i + 1) * wrong) > std::floor(i * wrong)) away += uniform(random, 1, 30);
        points.push_back(fine(x + t * std::cos(angle) - away * std::sin(angle),
                              y + t * std::sin(angle) + away * std::cos(angle)));
    }
    return points;
}

TEST(FitLine, GoesThroughPointsOnALine) {
    const std::vector<FinePoint> points = {fine(10, 20), fine(20, 30), fine(30, 40)};
    const Result<LineFit> fit = fit_line(span_of(points));
    ASSERT_TRUE(fit.ok());
    EXPECT_EQ(fit->line.point, fine(20, 30));
    EXPECT_EQ(fit->line.direction, FineAngle::from_microdegrees(45000000));
    EXPECT_EQ(fit->rms.raw(), 0);
    EXPECT_EQ(fit->used, 3);
    EXPECT_NEAR(real(distance_from(fit->line, fine(20, 31))), std::sqrt(0.5), 1e-4);
    EXPECT_NEAR(real(distance_from(fit->line, fine(21, 30))), -std::sqrt(0.5), 1e-4);
}

TEST(FitLine, UprightLinesPointDownTheImage) {
    const std::vector<FinePoint> points = {fine(10, 20), fine(10, 30)};
    EXPECT_EQ(fit_line(span_of(points))->line.direction, FineAngle::quarter_turn());
}

TEST(FitLine, EqualsTheEigenvectorsOfTheScatter) {
    Random random(91);
    for (int round = 0; round < 200; ++round) {
        const std::vector<FinePoint> points =
            line_points(random, random.between(3, 200), uniform(random, 100, 30000),
                        uniform(random, 100, 30000), uniform(random, -pi, pi), 2, 0);
        const Result<LineFit> fit = fit_line(span_of(points));
        ASSERT_TRUE(fit.ok());
        Eigen::MatrixXd rows(static_cast<Eigen::Index>(points.size()), 2);
        for (std::size_t i = 0; i < points.size(); ++i)
            rows.row(static_cast<Eigen::Index>(i)) << real(points[i].x), real(points[i].y);
        const Eigen::RowVector2d centre = rows.colwise().mean();
        const Eigen::MatrixXd offsets = rows.rowwise() - centre;
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(offsets.transpose() * offsets);
        const Eigen::Vector2d axis = solver.eigenvectors().col(1);
        const double angle = radians(fit->line.direction);
        EXPECT_NEAR(std::abs(axis.x() * std::sin(angle) - axis.y() * std::cos(angle)), 0, 2e-8);
        EXPECT_NEAR(real(fit->line.point.x), centre.x(), 1e-5);
        EXPECT_NEAR(real(fit->rms), std::sqrt(solver.eigenvalues()(0) / static_cast<double>(points.size())),
                    1e-4);
    }
}

TEST(FitLineRobust, IgnoresTwoFifthsOfWrongPoints) {
    Random random(92);
    for (int round = 0; round < 200; ++round) {
        const double x = uniform(random, 100, 600);
        const double y = uniform(random, 100, 600);
        const double angle = uniform(random, -pi, pi);
        const std::vector<FinePoint> points = line_points(random, 50, x, y, angle, 0.05, 0.4);
        const Result<LineFit> fit = robust(points);
        ASSERT_TRUE(fit.ok());
        // 30 good points of 0.05 px over 160 px: 0.009 px and 0.0002 rad; five of these.
        EXPECT_LT(std::abs(std::sin(radians(fit->line.direction) - angle)), 0.001) << round;
        EXPECT_LT(std::abs(real(distance_from(fit->line, fine(x, y)))), 0.06) << round;
        EXPECT_GE(fit->used, 15);
    }
}

TEST(FitLineRobust, EqualsThePlainFitWhenAllPointsAreGood) {
    std::vector<FinePoint> points;
    for (int i = 0; i < 20; ++i) points.push_back(fine(i, 2 * i));
    EXPECT_EQ(robust(points)->line.direction, fit_line(span_of(points))->line.direction);
    EXPECT_EQ(robust(points)->used, 20);
}

TEST(FitLine, SaysWhatIsWrong) {
    const std::vector<FinePoint> one = {fine(1, 1)};
    const std::vector<FinePoint> same = {fine(1, 1), fine(1, 1), fine(1, 1)};
    const std::vector<FinePoint> square = {fine(0, 0), fine(1, 0), fine(0, 1), fine(1, 1)};
    const std::vector<FinePoint> many(1025);
    const std::vector<FinePoint> two = {fine(1, 1), fine(2, 1)};
    EXPECT_EQ(fit_line(Span<const FinePoint>()).status(), Status::degenerate);
    EXPECT_EQ(fit_line(span_of(one)).status(), Status::degenerate);
    EXPECT_EQ(fit_line(span_of(same)).status(), Status::degenerate);
    EXPECT_EQ(fit_line(span_of(square)).status(), Status::degenerate);
    EXPECT_EQ(fit_line(span_of(many)).status(), Status::bad_argument);
    EXPECT_EQ(robust(one).status(), Status::degenerate);
    EXPECT_EQ(robust(same).status(), Status::degenerate);
    EXPECT_EQ(robust(many).status(), Status::bad_argument);
    EXPECT_EQ(fit_line_robust(span_of(two), {}).status(), Status::scratch_too_small);
}

TEST(FitLineRobust, LeavesOutAPointFartherAwayThanANumberHolds) {
    std::vector<FinePoint> points;
    for (int i = -30000; i <= 30000; i += 10000) points.push_back(fine(i, i));
    points.push_back(fine(32767, -32767));
    const Result<LineFit> fit = robust(points);
    ASSERT_TRUE(fit.ok());
    EXPECT_EQ(fit->used, 7);
    EXPECT_EQ(fit->line.direction, FineAngle::from_microdegrees(45000000));
}

TEST(FitLine, TakesTheFarthestPointsThereAre) {
    const FinePixel most = FinePixel::from_raw(2147483647);
    const FinePixel least = FinePixel::from_raw(-2147483647 - 1);
    const std::vector<FinePoint> points = {{least, least}, {most, most}, {least, least}, {most, most}};
    const Result<LineFit> fit = fit_line(span_of(points));
    ASSERT_TRUE(fit.ok());
    EXPECT_EQ(fit->line.direction, FineAngle::from_microdegrees(45000000));
    EXPECT_TRUE(robust(points).ok());
}

}  // namespace
}  // namespace fovea::test
