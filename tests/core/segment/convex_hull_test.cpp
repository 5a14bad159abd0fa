// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <core/segment/contour_pictures.hpp>
#include <fovea/segment/convex_hull.hpp>

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

std::int64_t turn(Point o, Point a, Point b) {
    return std::int64_t{a.x - o.x} * (b.y - o.y) - std::int64_t{a.y - o.y} * (b.x - o.x);
}

TEST(ConvexHull, DropsWhatIsInsideAndOnTheEdges) {
    EXPECT_EQ(hull_of({{2, 2}, {0, 0}, {4, 0}, {2, 0}, {4, 4}, {0, 4}, {0, 2}, {1, 3}}),
              (Points{{0, 0}, {4, 0}, {4, 4}, {0, 4}}));
}

TEST(ConvexHull, OfFewPointsIsThosePoints) {
    EXPECT_EQ(hull_of({{3, 4}}), (Points{{3, 4}}));
    EXPECT_EQ(hull_of({{3, 4}, {3, 4}, {3, 4}}), (Points{{3, 4}}));
    EXPECT_EQ(hull_of({{3, 4}, {-1, 9}}), (Points{{-1, 9}, {3, 4}}));
    EXPECT_EQ(hull_of({{5, 1}, {5, 7}, {5, 3}}), (Points{{5, 1}, {5, 7}}));
    EXPECT_EQ(hull_of({{0, 0}, {1, 1}, {2, 2}, {3, 3}}), (Points{{0, 0}, {3, 3}}));
    EXPECT_EQ(hull_of({{0, 0}, {100, 100}, {50, 50}}), (Points{{0, 0}, {100, 100}}));
}

TEST(ConvexHull, PointsAboveEachOtherAreOrderedByY) {
    // Points of one column in any order, at both ends.
    EXPECT_EQ(hull_of({{0, 5}, {0, 1}, {0, 3}, {9, 2}, {9, 8}, {9, 4}}),
              (Points{{0, 1}, {9, 2}, {9, 8}, {0, 5}}));
}

TEST(ConvexHull, EqualsTheReferenceOfEveryPair) {
    Random random(71);
    for (int round = 0; round < 300; ++round) {
        // Many points over few columns, and few over many.
        const Points points =
            random_points(random, random.between(1, 40), random.between(1, round % 2 == 0 ? 9 : 16000));
        const Points hull = hull_of(points);
        // p is a corner if some pair of steps around it leaves all others strictly inside or beyond: it is
        // not between two others, nor inside a triangle. Slow: no triangle or segment of other points holds
        // it.
        Points distinct = points;
        const auto less = [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
        std::sort(distinct.begin(), distinct.end(), less);
        distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
        Points corners;
        for (const Point p : distinct) {
            // A corner sees all others within less than half a turn: one of them has none to its left.
            bool corner = distinct.size() == 1;
            for (const Point q : distinct) {
                if (q == p) continue;
                bool first = true;
                for (const Point r : distinct) {
                    if (r == p || r == q) continue;
                    const std::int64_t side = turn(p, q, r);
                    const std::int64_t along =
                        std::int64_t{q.x - p.x} * (r.x - p.x) + std::int64_t{q.y - p.y} * (r.y - p.y);
                    if (side < 0 || (side == 0 && along < 0)) first = false;
                }
                corner = corner || first;
            }
            if (corner) corners.push_back(p);
        }
        Points sorted = hull;
        std::sort(sorted.begin(), sorted.end(), less);
        ASSERT_EQ(sorted, corners) << "round " << round;
        ASSERT_EQ(hull[0], distinct[0]);
        for (std::size_t i = 0; hull.size() > 2 && i < hull.size(); ++i)
            ASSERT_GT(turn(hull[i], hull[(i + 1) % hull.size()], hull[(i + 2) % hull.size()]), 0);
    }
}

TEST(ConvexHull, OfAHullIsItself) {
    Random random(72);
    const Points hull = hull_of(random_points(random, 500, 10000));
    EXPECT_EQ(hull_of(hull), hull);
}

TEST(ConvexHull, TakesTheFourCornersOfTheLargestImage) {
    EXPECT_EQ(hull_of({{0, 0}, {32767, 32767}, {0, 32767}, {32767, 0}}).size(), 4u);
}

TEST(ConvexHull, SaysWhatIsWrongAndLeavesTheList) {
    const Points points = {{0, 0}, {4, 0}, {4, 4}};
    std::uint8_t scratch[256];
    List<Point, 2> two;
    ASSERT_EQ(two.push({7, 7}), Status::ok);
    EXPECT_EQ(convex_hull({}, scratch, two), Status::not_found);
    EXPECT_EQ(convex_hull(span_of({{0, 0}, {32768, 0}}), scratch, two), Status::bad_argument);
    EXPECT_EQ(
        convex_hull(span_of(points), Span<std::uint8_t>(scratch).first(convex_hull_scratch(3) - 1), two),
        Status::scratch_too_small);
    EXPECT_EQ(convex_hull(span_of(points), scratch, two), Status::capacity_exceeded);
    ASSERT_EQ(two.size(), 1);
    EXPECT_EQ(two[0], (Point{7, 7}));
}

}  // namespace
}  // namespace fovea::test
