// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/measure/fit_circle.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

Span<const FinePoint> span_of(const std::vector<FinePoint>& points) {
    return {points.data(), static_cast<std::ptrdiff_t>(points.size())};
}
Result<CircleFit> robust(const std::vector<FinePoint>& points) {
    std::vector<FinePixel> scratch(points.size());
    return fit_circle_robust(span_of(points), {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
}

std::vector<FinePoint> arc_points(Random& random, int count, double x, double y, double radius, double arc,
                                  double noise, double wrong) {
    std::vector<FinePoint> points;
    const double start = uniform(random, 0, 2 * pi);
    for (int i = 0; i < count; ++i) {
        const double angle = start + arc * i / count;
        double r = radius + noise * normal(random);
        if (i < count * wrong) r += uniform(random, 1, 15);
        points.push_back(fine(x + r * std::cos(angle), y + r * std::sin(angle)));
    }
    return points;
}

/// The geometric fit in double precision, from a start that is known to be good.
Eigen::Vector3d reference(const std::vector<FinePoint>& points, Eigen::Vector3d circle) {
    for (int round = 0; round < 100; ++round) {
        Eigen::MatrixXd slopes(static_cast<Eigen::Index>(points.size()), 3);
        Eigen::VectorXd errors(static_cast<Eigen::Index>(points.size()));
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            const double dx = real(points[i].x) - circle.x();
            const double dy = real(points[i].y) - circle.y();
            const double r = std::hypot(dx, dy);
            slopes.row(row) << dx / r, dy / r, 1;
            errors(row) = r - circle.z();
        }
        circle += slopes.colPivHouseholderQr().solve(errors);
    }
    return circle;
}

TEST(CircleThrough, TakesThreePoints) {
    const Result<Circle> circle = circle_through(fine(15, 10), fine(10, 15), fine(5, 10));
    ASSERT_TRUE(circle.ok());
    EXPECT_EQ(circle->centre, fine(10, 10));
    EXPECT_EQ(circle->radius, fine(5));
    EXPECT_EQ(real(distance_from(*circle, fine(10, 22))), 7);
    EXPECT_EQ(real(distance_from(*circle, fine(10, 10))), -5);
    EXPECT_EQ(circle_through(fine(1, 1), fine(2, 2), fine(3, 3)).status(), Status::degenerate);
    EXPECT_EQ(circle_through(fine(1, 1), fine(1, 1), fine(3, 3)).status(), Status::degenerate);
    EXPECT_EQ(circle_through(fine(0, 0), fine(1000, 0.0001), fine(2000, 0)).status(), Status::degenerate);
}

TEST(FitCircle, GoesThroughPointsOnACircle) {
    const std::vector<FinePoint> points = {fine(15, 10), fine(10, 15), fine(5, 10), fine(10, 5)};
    const Result<CircleFit> fit = fit_circle(span_of(points));
    ASSERT_TRUE(fit.ok());
    EXPECT_EQ(fit->circle.centre, fine(10, 10));
    EXPECT_EQ(fit->circle.radius, fine(5));
    EXPECT_EQ(fit->used, 4);
    EXPECT_EQ(fit->rms.raw(), 0);
}

TEST(FitCircle, EqualsTheReferenceOnWholeCirclesAndArcs) {
    Random random(93);
    for (int round = 0; round < 300; ++round) {
        const double radius = uniform(random, 3, 900);
        const double arc = uniform(random, 0.5, 2 * pi);
        const double x = uniform(random, 1000, 20000);
        const double y = uniform(random, 1000, 20000);
        // On a short arc the noise must stay small against its height, or no circle is determined.
        const double noise = std::min(0.3, 0.01 * radius * arc * arc);
        const std::vector<FinePoint> points =
            arc_points(random, random.between(8, 200), x, y, radius, arc, noise, 0);
        const Result<CircleFit> fit = fit_circle(span_of(points));
        ASSERT_TRUE(fit.ok()) << round << " r " << radius << " arc " << arc << " n " << points.size();
        const Eigen::Vector3d expected = reference(points, {x, y, radius});
        // Distances are cut to 2^-16 px; on a short arc centre and radius move together by 1 / (1 -
        // cos(arc/2)).
        const double tolerance = 4 / 65536.0 / (1 - std::cos(std::min(arc, pi) / 2));
        EXPECT_NEAR(real(fit->circle.centre.x), expected.x(), tolerance) << round;
        EXPECT_NEAR(real(fit->circle.centre.y), expected.y(), tolerance) << round;
        EXPECT_NEAR(real(fit->circle.radius), expected.z(), tolerance) << round;
    }
}

TEST(FitCircleRobust, IgnoresAThirdOfWrongPoints) {
    Random random(94);
    for (int round = 0; round < 200; ++round) {
        const double radius = uniform(random, 8, 100);
        const double x = uniform(random, 200, 400);
        const double y = uniform(random, 200, 400);
        const std::vector<FinePoint> points = arc_points(random, 48, x, y, radius, 2 * pi, 0.05, 0.33);
        const Result<CircleFit> fit = robust(points);
        ASSERT_TRUE(fit.ok());
        // 32 good points of 0.05 px: 0.0125 px for the centre; five of these.
        EXPECT_NEAR(real(fit->circle.centre.x), x, 0.07) << round;
        EXPECT_NEAR(real(fit->circle.centre.y), y, 0.07) << round;
        EXPECT_NEAR(real(fit->circle.radius), radius, 0.07) << round;
    }
}

TEST(FitCircleRobust, TakesAllPointsWhereAllAreWithinItsLimit) {
    // An ellipse of 20.6 x 19.4.
    std::vector<FinePoint> points;
    for (int i = 0; i < 48; ++i)
        points.push_back(fine(100 + 20.6 * std::cos(i * pi / 24), 100 + 19.4 * std::sin(i * pi / 24)));
    std::vector<FinePixel> scratch(points.size());
    const Span<FinePixel> room(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    const Result<CircleFit> all = fit_circle_robust(span_of(points), room, FinePixel::from_ratio(61, 100));
    ASSERT_TRUE(all);
    EXPECT_EQ(all->used, 48);
    EXPECT_NEAR(real(all->circle.radius), 20, 0.01);
    EXPECT_NEAR(real(all->circle.centre.x), 100, 0.01);
    const Result<CircleFit> some = fit_circle_robust(span_of(points), room, FinePixel::from_ratio(1, 10));
    ASSERT_TRUE(some);
    EXPECT_LT(some->used, 48);
    // A point far off is none of them.
    points[7] = fine(104, 103);
    const Result<CircleFit> others = fit_circle_robust(span_of(points), room, FinePixel::from_int(1));
    ASSERT_TRUE(others);
    EXPECT_LT(others->used, 48);
    EXPECT_NEAR(real(others->circle.radius), 20, 0.6);
}

TEST(FitCircle, SaysWhatIsWrong) {
    const std::vector<FinePoint> two = {fine(1, 1), fine(2, 1)};
    const std::vector<FinePoint> row = {fine(1, 1), fine(2, 1), fine(3, 1), fine(9, 1)};
    const std::vector<FinePoint> same(5, fine(3, 3));
    const std::vector<FinePoint> many(1025);
    const std::vector<FinePoint> good = {fine(15, 10), fine(10, 15), fine(5, 10)};
    EXPECT_EQ(fit_circle(Span<const FinePoint>()).status(), Status::degenerate);
    EXPECT_EQ(fit_circle(span_of(two)).status(), Status::degenerate);
    EXPECT_EQ(fit_circle(span_of(row)).status(), Status::degenerate);
    EXPECT_EQ(fit_circle(span_of(same)).status(), Status::degenerate);
    EXPECT_EQ(fit_circle(span_of(many)).status(), Status::bad_argument);
    EXPECT_EQ(robust(two).status(), Status::degenerate);
    EXPECT_EQ(robust(row).status(), Status::degenerate);
    EXPECT_EQ(robust(same).status(), Status::degenerate);
    EXPECT_EQ(robust(many).status(), Status::bad_argument);
    EXPECT_EQ(fit_circle_robust(span_of(good), {}).status(), Status::scratch_too_small);
}

TEST(CircleThrough, RefusesThreePointsThatHardlyBend) {
    constexpr std::int32_t long_way = 1 << 29;
    const FinePoint a = fine(1, 1);
    const auto behind_a = [&](std::int32_t x, std::int32_t y) {
        return FinePoint{a.x + FinePixel::from_raw(x), a.y + FinePixel::from_raw(y)};
    };
    EXPECT_EQ(
        circle_through(a, behind_a(long_way, long_way - 1), behind_a(-long_way - 1, -long_way)).status(),
        Status::degenerate);
    EXPECT_EQ(
        circle_through(a, behind_a(long_way - 1, long_way), behind_a(-long_way, -long_way - 1)).status(),
        Status::degenerate);
}

TEST(FitCircle, TakesPointsFartherFromTheCircleThanANumberHolds) {
    const std::vector<FinePoint> points = {fine(0, 30000), fine(-32768, 30000), fine(30000, 30000),
                                           fine(0, 32000)};
    const Result<CircleFit> fit = fit_circle(span_of(points));
    EXPECT_TRUE(fit.ok() || fit.status() == Status::degenerate);
}

TEST(FitCircle, NeitherCrashesNorHangsOnAnyPoints) {
    Random random(95);
    for (int round = 0; round < 3000; ++round) {
        std::vector<FinePoint> points(static_cast<std::size_t>(random.between(3, 12)));
        const int drop = random.between(0, 30);
        for (FinePoint& point : points) {
            point.x = FinePixel::from_raw(static_cast<std::int32_t>(random.next()) >> drop);
            point.y = FinePixel::from_raw(static_cast<std::int32_t>(random.next()) >> drop);
        }
        const Result<CircleFit> plain = fit_circle(span_of(points));
        const Result<CircleFit> careful = robust(points);
        EXPECT_TRUE(!plain || plain->circle.radius.raw() > 0);
        EXPECT_TRUE(!careful || careful->circle.radius.raw() > 0);
    }
}

}  // namespace
}  // namespace fovea::test
