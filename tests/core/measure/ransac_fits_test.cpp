// SPDX-License-Identifier: MIT
#include <fovea/measure/ransac_fits.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/measure/fit_plane.hpp>
#include <support/scalars.hpp>

namespace fovea {
namespace {

using test::value_of;

FinePoint fine(double x, double y) {
    return {FinePixel::from_raw(static_cast<std::int32_t>(std::lround(x * 65536))),
            FinePixel::from_raw(static_cast<std::int32_t>(std::lround(y * 65536)))};
}
template <class Point>
Span<const Point> span(const std::vector<Point>& points) {
    return {points.data(), static_cast<std::ptrdiff_t>(points.size())};
}

TEST(RansacFitsTest, LineOfAThirdOfThePoints) {
    Random random(3);
    std::vector<FinePoint> points;
    for (int i = 0; i < 40; ++i) {
        const double noise = random.between(-100, 100) / 1000.0;
        points.push_back(fine(10 + 12 * i, 50 + 5 * i + noise));
    }
    for (int i = 0; i < 80; ++i) {
        const int x = random.between(0, 500);
        const int y = random.between(0, 500);
        points.push_back(fine(x, y));
    }
    const auto fit = fit_line_ransac(span(points), FinePixel::from_ratio(1, 4));
    ASSERT_TRUE(fit);
    EXPECT_GE(fit->used, 40);
    EXPECT_LE(fit->used, 43);
    // Both ends of the line are near it, whatever its direction's sign.
    for (const int i : {0, 39})
        EXPECT_LT(std::abs(distance_from(fit->line, fine(10 + 12 * i, 50 + 5 * i)).raw()), 65536 / 10);
    EXPECT_LT(fit->rms.raw(), 65536 / 8);
}

TEST(RansacFitsTest, CircleOfAThirdOfThePoints) {
    Random random(4);
    std::vector<FinePoint> points;
    for (int i = 0; i < 30; ++i) {
        const double noise = random.between(-100, 100) / 1000.0;
        const double angle = i * 0.2;
        points.push_back(fine(200 + (80 + noise) * std::cos(angle), 150 + (80 + noise) * std::sin(angle)));
    }
    for (int i = 0; i < 60; ++i) {
        const int x = random.between(0, 400);
        const int y = random.between(0, 300);
        points.push_back(fine(x, y));
    }
    const auto fit = fit_circle_ransac(span(points), FinePixel::from_ratio(1, 4));
    ASSERT_TRUE(fit);
    EXPECT_GE(fit->used, 30);
    EXPECT_LE(fit->used, 33);
    EXPECT_NEAR(fit->circle.centre.x.raw() / 65536.0, 200, 0.1);
    EXPECT_NEAR(fit->circle.centre.y.raw() / 65536.0, 150, 0.1);
    EXPECT_NEAR(fit->circle.radius.raw() / 65536.0, 80, 0.1);
}

TEST(RansacFitsTest, AreTheFitsToAllWhereAllAreWithin) {
    std::vector<FinePoint> line;
    for (int i = 0; i < 9; ++i) line.push_back(fine(i * 10, i % 2 * 0.1));
    const auto all = fit_line(span(line));
    const auto most = fit_line_ransac(span(line), FinePixel::from_int(1));
    ASSERT_TRUE(all && most);
    EXPECT_EQ(most->line.point, all->line.point);
    EXPECT_EQ(most->line.direction, all->line.direction);
    EXPECT_EQ(most->used, 9);
}

TEST(RansacFitsTest, RefuseWhatIsNone) {
    const std::vector<FinePoint> same(10, fine(3, 4));
    const FinePixel near = FinePixel::from_int(1);
    EXPECT_EQ(fit_line_ransac(span(same), near).status(), Status::degenerate);
    EXPECT_EQ(fit_circle_ransac(span(same), near).status(), Status::degenerate);
    EXPECT_EQ(fit_line_ransac(span(same), FinePixel()).status(), Status::bad_argument);
    EXPECT_EQ(fit_circle_ransac(span(same).first(2), near).status(), Status::bad_argument);
    const std::vector<FinePoint> many(static_cast<std::size_t>(max_fit_points + 1));
    EXPECT_EQ(fit_line_ransac(span(many), near).status(), Status::bad_argument);
    std::vector<FinePoint> corners{fine(0, 0), fine(100, 0), fine(0, 100), fine(100, 90), fine(40, 55)};
    RansacOptions options;
    options.enough = 4;
    EXPECT_EQ(fit_line_ransac(span(corners), near, options).status(), Status::not_found);
}

TEST(FitPlaneTest, ByHandAndAtTheEndsOfTheRange) {
    // x + 2 y + 2 z = 9, whose normal has length 3.
    const std::vector<SpacePoint> points{{9, 0, 0}, {1, 4, 0}, {1, 0, 4}, {3, 3, 0}};
    const auto fit = fit_plane(span(points));
    ASSERT_TRUE(fit);
    const double expected[3] = {1 / 3.0, 2 / 3.0, 2 / 3.0};
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(static_cast<double>(value_of(fit->plane.normal[i])), expected[i], 1e-15);
    EXPECT_NEAR(static_cast<double>(value_of(fit->plane.offset)), 3, 1e-15);
    EXPECT_LT(value_of(fit->rms), 1e-8);
    EXPECT_EQ(fit->used, 4);

    const int most = std::numeric_limits<std::int32_t>::max();
    const std::vector<SpacePoint> far{{-most - 1, 5, -most - 1}, {most, 5, -most - 1}, {0, 5, most}};
    const auto flat = fit_plane(span(far));
    ASSERT_TRUE(flat);
    EXPECT_NEAR(static_cast<double>(value_of(flat->plane.normal[1])), 1, 1e-15);
    EXPECT_NEAR(static_cast<double>(value_of(flat->plane.offset)), 5, 1e-9);
}

TEST(FitPlaneTest, AsInDoubleAndNoTurnFitsBetter) {
    Random random(8);
    for (int k = 0; k < 20; ++k) {
        std::vector<SpacePoint> points;
        const int a = random.between(-50, 50);
        const int b = random.between(-50, 50);
        for (int i = 0; i < 30; ++i) {
            const int x = random.between(-5000, 5000);
            const int y = random.between(-5000, 5000);
            const int noise = random.between(-40, 40);
            points.push_back({x, y, (a * x + b * y) / 100 + 12345 + noise});
        }
        const auto fit = fit_plane(span(points));
        const auto twin = fit_plane<double>(span(points));
        ASSERT_TRUE(fit && twin);
        double sum = 0;
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(static_cast<double>(value_of(fit->plane.normal[i])), twin->plane.normal[i], 1e-12);
        for (const SpacePoint point : points) {
            const double distance = distance_from(twin->plane, vector_of<double>(point));
            sum += distance * distance;
        }
        EXPECT_NEAR(static_cast<double>(value_of(fit->rms)), std::sqrt(sum / 30), 1e-9);
        for (const double turn : {0.001, -0.001}) {
            for (int axis = 0; axis < 2; ++axis) {
                Vector<3, double> normal = twin->plane.normal;
                normal[axis] += turn;
                // With its best offset: through the mean.
                double mean[2] = {0, 0};
                for (const SpacePoint point : points) mean[0] += dot(normal, vector_of<double>(point)) / 30;
                double other = 0;
                for (const SpacePoint point : points) {
                    const double distance = dot(normal, vector_of<double>(point)) - mean[0];
                    other += distance * distance / dot(normal, normal);
                }
                EXPECT_GT(other, sum);
            }
        }
    }
}

TEST(FitPlaneTest, TheLargestComponentOfTheNormalIsAboveZero) {
    Random random(10);
    for (int k = 0; k < 24; ++k) {
        std::vector<SpacePoint> points;
        const int a = random.between(-3, 3);
        const int b = random.between(-3, 3);
        for (int i = 0; i < 5; ++i) {
            const int x = random.between(-50, 50);
            const int y = random.between(-50, 50);
            const int z = a * x + b * y;
            points.push_back(k % 3 == 0   ? SpacePoint{x, y, z}
                             : k % 3 == 1 ? SpacePoint{z, x, y}
                                          : SpacePoint{y, z, x});
        }
        const auto fit = fit_plane(span(points));
        ASSERT_TRUE(fit);
        int largest = 0;
        for (int i = 1; i < 3; ++i)
            if (fit->plane.normal[largest].absolute() < fit->plane.normal[i].absolute()) largest = i;
        EXPECT_LT(Real(), fit->plane.normal[largest]) << k;
        for (const SpacePoint point : points)
            EXPECT_LT(value_of(distance_from(fit->plane, vector_of<Real>(point)).absolute()), 1e-12);
    }
}

TEST(FitPlaneTest, OfMostPoints) {
    Random random(9);
    std::vector<SpacePoint> points;
    for (int i = 0; i < 40; ++i) {
        const int x = random.between(-500, 500);
        const int y = random.between(-500, 500);
        points.push_back({x, y, x / 2 - y / 4 + 100});
    }
    for (int i = 0; i < 40; ++i) {
        const int x = random.between(-500, 500);
        const int y = random.between(-500, 500);
        const int z = random.between(-500, 500);
        points.push_back({x, y, z});
    }
    const auto fit = fit_plane_ransac(span(points), Real::from_int(2));
    ASSERT_TRUE(fit);
    EXPECT_GE(fit->used, 40);
    EXPECT_LE(fit->used, 42);
    // z - x / 2 + y / 4 = 100, at length 1.
    const double length = std::sqrt(1 + 0.25 + 0.0625);
    EXPECT_NEAR(static_cast<double>(value_of(fit->plane.normal[2])), 1 / length, 0.002);
    EXPECT_NEAR(static_cast<double>(value_of(fit->plane.offset)), 100 / length, 1);
}

TEST(FitPlaneTest, RefusesWhatDeterminesNone) {
    std::vector<SpacePoint> line;
    for (int i = 0; i < 9; ++i) line.push_back({i * 3, i * 5, 7 - i});
    EXPECT_EQ(fit_plane(span(line)).status(), Status::degenerate);
    EXPECT_EQ(fit_plane_ransac(span(line), Real::from_int(1)).status(), Status::degenerate);
    EXPECT_EQ(fit_plane(span(line).first(2)).status(), Status::bad_argument);
    EXPECT_EQ(fit_plane(Span<const SpacePoint>()).status(), Status::bad_argument);
    EXPECT_EQ(fit_plane_ransac(span(line), Real()).status(), Status::bad_argument);
    const std::vector<SpacePoint> same(5, SpacePoint{1, 2, 3});
    EXPECT_EQ(fit_plane(span(same)).status(), Status::degenerate);
    // The corners of a cube spread alike in all directions.
    std::vector<SpacePoint> cube;
    for (int i = 0; i < 8; ++i) cube.push_back({i & 1, i >> 1 & 1, i >> 2});
    EXPECT_EQ(fit_plane(span(cube)).status(), Status::degenerate);
    RansacOptions options;
    options.enough = 7;
    EXPECT_EQ(fit_plane_ransac(span(cube), Real::from_ratio(1, 10), options).status(), Status::not_found);
}

}  // namespace
}  // namespace fovea
