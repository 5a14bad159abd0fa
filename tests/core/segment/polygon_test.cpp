// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <core/segment/contour_pictures.hpp>
#include <fovea/segment/polygon.hpp>

namespace fovea::test {
namespace {

using Points = std::vector<Point>;

const Points square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};

TEST(PolygonLength, CountsStepsAndRootsOfTwo) {
    EXPECT_EQ(polygon_length(span_of(square), Closure::closed)->raw(), 16 * 65536);
    EXPECT_EQ(polygon_length(span_of(square), Closure::open)->raw(), 12 * 65536);
    // 3 diagonals: 3 * 65536 * 1.41421356 = 278045.6
    EXPECT_EQ(polygon_length(span_of({{0, 0}, {3, 3}}), Closure::open)->raw(), 278046);
    EXPECT_EQ(polygon_length(span_of({{0, 0}, {3, 4}}), Closure::open)->raw(), 5 * 65536);
    EXPECT_EQ(polygon_length(span_of({{7, 7}}), Closure::closed)->raw(), 0);
    EXPECT_EQ(polygon_length({}, Closure::closed)->raw(), 0);
}

TEST(PolygonLength, IsRightToHalfAStepOfTheFormatForEachPoint) {
    Random random(61);
    for (int round = 0; round < 200; ++round) {
        const Points points = random_points(random, random.between(1, 30), random.between(1, 16000));
        long double sum = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Point a = points[i], b = points[(i + 1) % points.size()];
            sum += std::sqrt(static_cast<long double>((a.x - b.x) * static_cast<long double>(a.x - b.x) +
                                                      (a.y - b.y) * static_cast<long double>(a.y - b.y)));
        }
        const auto length = polygon_length(span_of(points), Closure::closed);
        ASSERT_TRUE(length);
        // Each step and the sum of the diagonals are off by half of 2^-16 at most.
        EXPECT_NEAR(static_cast<double>(length->raw()), static_cast<double>(sum * 65536),
                    0.5 * static_cast<double>(points.size()) + 0.6);
    }
}

TEST(DoubledArea, IsPositiveClockwiseOnScreen) {
    EXPECT_EQ(*doubled_area(span_of(square)), 32);
    EXPECT_EQ(*doubled_area(span_of({{0, 4}, {4, 4}, {4, 0}, {0, 0}})), -32);
    EXPECT_EQ(*doubled_area(span_of({{0, 0}, {5, 5}})), 0);
    EXPECT_EQ(*doubled_area({}), 0);
    const int far = 32767;
    EXPECT_EQ(*doubled_area(span_of({{0, 0}, {far, 0}, {far, far}, {0, far}})), std::int64_t{2} * far * far);
}

TEST(DoubledArea, DoesNotDependOnWhereItBeginsOrLies) {
    Random random(62);
    for (int round = 0; round < 100; ++round) {
        Points points = random_points(random, random.between(3, 20), 1000);
        const std::int64_t area = doubled_area(span_of(points)).value();
        std::rotate(points.begin(), points.begin() + 1, points.end());
        for (Point& p : points) p = {p.x + 5000, p.y - 70000};
        EXPECT_EQ(doubled_area(span_of(points)).value(), area);
    }
}

TEST(PlaceInPolygon, KnowsInsideOutsideAndTheLine) {
    const Points arrow = {{0, 0}, {8, 4}, {0, 8}, {3, 4}};
    EXPECT_EQ(*place_in_polygon(span_of(arrow), {5, 4}), PointPlace::inside);
    EXPECT_EQ(*place_in_polygon(span_of(arrow), {1, 4}), PointPlace::outside);
    EXPECT_EQ(*place_in_polygon(span_of(arrow), {4, 2}), PointPlace::on_line);
    EXPECT_EQ(*place_in_polygon(span_of(arrow), {3, 4}), PointPlace::on_line);
    EXPECT_EQ(*place_in_polygon(span_of(arrow), {-1, 0}), PointPlace::outside);
    EXPECT_EQ(*place_in_polygon(span_of({{2, 2}}), {2, 2}), PointPlace::on_line);
    EXPECT_EQ(*place_in_polygon({}, {2, 2}), PointPlace::outside);
}

TEST(PlaceInPolygon, EqualsTheWindingOfATriangle) {
    Random random(63);
    for (int round = 0; round < 500; ++round) {
        const Points t = random_points(random, 3, 9);
        const Point p = random_points(random, 1, 10)[0];
        const auto turn = [](Point o, Point a, Point b) {
            return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
        };
        const int a = turn(t[0], t[1], p), b = turn(t[1], t[2], p), c = turn(t[2], t[0], p);
        if (turn(t[0], t[1], t[2]) == 0) continue;
        const bool inside = (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
        const bool closed = (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
        EXPECT_EQ(*place_in_polygon(span_of(t), p), inside   ? PointPlace::inside
                                                    : closed ? PointPlace::on_line
                                                             : PointPlace::outside);
    }
}

TEST(Convexity, SeesDentsCrossingsAndTurningTwice) {
    EXPECT_EQ(*convexity(span_of(square)), Convexity::convex);
    EXPECT_EQ(*convexity(span_of({{0, 4}, {4, 4}, {4, 0}, {0, 0}})), Convexity::convex);
    EXPECT_EQ(*convexity(span_of({{0, 0}, {2, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}})), Convexity::convex);
    EXPECT_EQ(*convexity(span_of({{0, 0}, {8, 4}, {0, 8}, {3, 4}})), Convexity::not_convex);
    EXPECT_EQ(*convexity(span_of({{0, 0}, {4, 4}, {4, 0}, {0, 4}})), Convexity::not_convex);
    // A star of five points turns right everywhere, twice around.
    EXPECT_EQ(*convexity(span_of({{50, 0}, {80, 95}, {0, 36}, {100, 36}, {20, 95}})), Convexity::not_convex);
    // There and back on a spike.
    EXPECT_EQ(*convexity(span_of({{0, 0}, {6, 0}, {4, 0}, {4, 4}, {0, 4}})), Convexity::not_convex);
    EXPECT_EQ(*convexity(span_of({{0, 0}, {2, 2}, {5, 5}})), Convexity::convex);
    EXPECT_EQ(*convexity(span_of({{1, 1}})), Convexity::convex);
    EXPECT_EQ(*convexity({}), Convexity::convex);
}

TEST(Polygon, RefusesWhatIsLargerThanAnImage) {
    const Points wide = {{-1, 0}, {32767, 0}, {5, 5}};
    const Points away = {{1 << 25, 0}};
    for (const Points& points : {wide, away}) {
        EXPECT_EQ(polygon_length(span_of(points), Closure::open).status(), Status::bad_argument);
        EXPECT_EQ(doubled_area(span_of(points)).status(), Status::bad_argument);
        EXPECT_EQ(convexity(span_of(points)).status(), Status::bad_argument);
        EXPECT_EQ(place_in_polygon(span_of(points), {0, 0}).status(), Status::bad_argument);
    }
    EXPECT_EQ(place_in_polygon(span_of(square), {32768, 0}).status(), Status::bad_argument);
    EXPECT_EQ(place_in_polygon(span_of(square), {0, 1 << 30}).status(), Status::bad_argument);
}

}  // namespace
}  // namespace fovea::test
