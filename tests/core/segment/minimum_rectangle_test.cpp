// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <core/segment/contour_pictures.hpp>
#include <fovea/segment/convex_hull.hpp>
#include <fovea/segment/minimum_rectangle.hpp>

namespace fovea::test {
namespace {

using Points = std::vector<Point>;

Points hull_of(const Points& points) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(convex_hull_scratch(span_of(points).size())));
    Points hull(points.size());
    int count = 0;
    EXPECT_EQ(convex_hull(span_of(points), {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                          ListView<Point>(hull.data(), static_cast<int>(hull.size()), &count)),
              Status::ok);
    hull.resize(static_cast<std::size_t>(count));
    return hull;
}

TEST(MinimumAreaRectangle, FindsARectangleThatLiesOnItsCorner) {
    // Sides (4, 3) * 2 and (-3, 4): 10 by 5.
    const auto found = minimum_area_rectangle(span_of({{0, 4}, {3, 0}, {11, 6}, {8, 10}}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->length.raw(), 10 * 65536);
    EXPECT_EQ(found->width.raw(), 5 * 65536);
    EXPECT_EQ(found->centre, (FinePoint{FinePixel::from_ratio(11, 2), FinePixel::from_int(5)}));
    EXPECT_NEAR(found->axis.microdegrees(), 36869898, 1);
}

TEST(MinimumAreaRectangle, AnUprightOneHasAnAxisOf90DegreesAndASquareOf0) {
    const auto tall = minimum_area_rectangle(span_of({{0, 0}, {2, 0}, {2, 9}, {0, 9}}));
    ASSERT_TRUE(tall);
    EXPECT_EQ(tall->axis, FineAngle::quarter_turn());
    EXPECT_EQ(tall->length.raw(), 9 * 65536);
    const auto square = minimum_area_rectangle(span_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}}));
    ASSERT_TRUE(square);
    EXPECT_EQ(square->axis, FineAngle());
}

TEST(MinimumAreaRectangle, OfAPointOrALineHasNoArea) {
    const auto point = minimum_area_rectangle(span_of({{5, -3}}));
    ASSERT_TRUE(point);
    EXPECT_EQ(point->centre, (FinePoint{FinePixel::from_int(5), FinePixel::from_int(-3)}));
    EXPECT_EQ(point->length.raw(), 0);
    const auto line = minimum_area_rectangle(span_of({{0, 0}, {3, -4}}));
    ASSERT_TRUE(line);
    EXPECT_EQ(line->length.raw(), 5 * 65536);
    EXPECT_EQ(line->width.raw(), 0);
    EXPECT_EQ(line->centre, (FinePoint{FinePixel::from_ratio(3, 2), FinePixel::from_int(-2)}));
    EXPECT_NEAR(line->axis.microdegrees(), -53130102, 1);
}

TEST(MinimumAreaRectangle, EqualsTheReferenceOfEveryEdge) {
    Random random(81);
    for (int round = 0; round < 300; ++round) {
        // Diagonals stay below the 32767 px at which sides are held.
        const Points hull = hull_of(random_points(random, random.between(3, 60), random.between(2, 11000)));
        const auto found = minimum_area_rectangle(span_of(hull));
        ASSERT_TRUE(found);
        if (hull.size() < 3) continue;
        long double least = 1e30L;
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const Point a = hull[i], b = hull[(i + 1) % hull.size()];
            const long double dx = b.x - a.x, dy = b.y - a.y;
            long double first = 0, last = 0, across = 0;
            for (const Point p : hull) {
                first = std::min(first, dx * (p.x - a.x) + dy * (p.y - a.y));
                last = std::max(last, dx * (p.x - a.x) + dy * (p.y - a.y));
                across = std::max(across, dx * (p.y - a.y) - dy * (p.x - a.x));
            }
            least = std::min(least, (last - first) * across / (dx * dx + dy * dy));
        }
        const long double length = found->length.raw() / 65536.0L;
        const long double width = found->width.raw() / 65536.0L;
        // Both sides are off by 2^-16 at most.
        ASSERT_NEAR(static_cast<double>(length * width), static_cast<double>(least),
                    static_cast<double>(length + width + 1) / 65536);
        ASSERT_GE(found->length, found->width);
        // All corners lie in it.
        const long double turn = found->axis.raw() * (6.283185307179586476925L / 4294967296.0L);
        for (const Point p : hull) {
            const long double x = p.x - found->centre.x.raw() / 65536.0L;
            const long double y = p.y - found->centre.y.raw() / 65536.0L;
            ASSERT_LE(std::abs(x * std::cos(turn) + y * std::sin(turn)), length / 2 + 1e-4L);
            ASSERT_LE(std::abs(y * std::cos(turn) - x * std::sin(turn)), width / 2 + 1e-4L);
        }
    }
}

TEST(MinimumAreaRectangle, HoldsTheLargestImageAndRefusesWhatIsNoHull) {
    EXPECT_TRUE(minimum_area_rectangle(span_of({{0, 0}, {32767, 0}, {32767, 32767}, {0, 32767}})));
    EXPECT_EQ(minimum_area_rectangle({}).status(), Status::not_found);
    EXPECT_EQ(minimum_area_rectangle(span_of({{0, 0}, {32768, 0}})).status(), Status::bad_argument);
    EXPECT_EQ(minimum_area_rectangle(span_of({{0, 0}, {0, 4}, {4, 4}, {4, 0}})).status(),
              Status::bad_argument);
    EXPECT_EQ(minimum_area_rectangle(span_of({{0, 0}, {2, 0}, {4, 0}, {4, 4}})).status(),
              Status::bad_argument);
    // Winds around twice: nothing is found that makes sense, but it ends.
    const auto star = minimum_area_rectangle(span_of({{50, 0}, {80, 95}, {0, 36}, {100, 36}, {20, 95}}));
    EXPECT_TRUE(star.ok());
}

}  // namespace
}  // namespace fovea::test
