// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <core/segment/contour_pictures.hpp>
#include <fovea/segment/approximate_polygon.hpp>

namespace fovea::test {
namespace {

using Points = std::vector<Point>;

Points approximated(const Points& points, Closure closure, SubPixel tolerance) {
    std::vector<std::uint8_t> scratch(points.size());
    Points corners(points.size());
    int count = 0;
    EXPECT_EQ(approximate_polygon(span_of(points), closure, tolerance,
                                  {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                                  ListView<Point>(corners.data(), static_cast<int>(corners.size()), &count)),
              Status::ok);
    corners.resize(static_cast<std::size_t>(count));
    return corners;
}

long double distance(Point p, Point a, Point b) {
    const long double dx = b.x - a.x, dy = b.y - a.y;
    const long double square = dx * dx + dy * dy;
    long double t = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;
    t = std::clamp<long double>(t, 0, 1);
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

TEST(ApproximatePolygon, KeepsTheCornersOfARectangle) {
    Points points;
    for (int x = 0; x < 10; ++x) points.push_back({x, 0});
    for (int y = 0; y < 6; ++y) points.push_back({10, y});
    for (int x = 10; x > 0; --x) points.push_back({x, 6});
    for (int y = 6; y > 0; --y) points.push_back({0, y});
    EXPECT_EQ(approximated(points, Closure::closed, SubPixel()), (Points{{0, 0}, {10, 0}, {10, 6}, {0, 6}}));
}

TEST(ApproximatePolygon, ATickGoesWithinItsTolerance) {
    const Points line = {{0, 0}, {3, 0}, {4, 1}, {5, 0}, {9, 0}};
    EXPECT_EQ(approximated(line, Closure::open, SubPixel::from_int(1)), (Points{{0, 0}, {9, 0}}));
    EXPECT_EQ(approximated(line, Closure::open, SubPixel::from_raw(128)),
              (Points{{0, 0}, {3, 0}, {4, 1}, {5, 0}, {9, 0}}));
}

TEST(ApproximatePolygon, MeasuresFromThePieceAndNotFromTheLineThroughIt) {
    // The point lies on the line through both ends, but ten pixels behind one of them.
    EXPECT_EQ(approximated({{0, 0}, {20, 0}, {10, 0}}, Closure::open, SubPixel::from_int(3)),
              (Points{{0, 0}, {20, 0}, {10, 0}}));
}

TEST(ApproximatePolygon, LeavesNoPointFartherAwayThanTheTolerance) {
    Random random(91);
    for (int round = 0; round < 200; ++round) {
        const bool closed = round % 2 == 0;
        Points points = random_points(random, random.between(1, 80), random.between(1, 200));
        if (round % 3 == 0) points.assign(7, {4, 4});
        const SubPixel tolerance = SubPixel::from_raw(random.between(0, 40 * 256));
        const Points corners = approximated(points, closed ? Closure::closed : Closure::open, tolerance);
        ASSERT_EQ(corners[0], points[0]);
        std::size_t from = 0;
        Points around = points;
        Points pieces = corners;
        if (closed) {
            around.push_back(points[0]);
            pieces.push_back(corners[0]);
        }
        // Every point lies near the piece of its place in the order.
        std::size_t piece = 0;
        for (std::size_t i = 1; i < around.size(); ++i) {
            if (piece + 1 < pieces.size() && around[i] == pieces[piece + 1] &&
                (i + 1 == around.size() || piece + 2 < pieces.size())) {
                for (std::size_t k = from; k <= i; ++k)
                    ASSERT_LE(distance(around[k], pieces[piece], pieces[piece + 1]),
                              tolerance.raw() / 256.0L + 1e-9L)
                        << "round " << round;
                from = i;
                ++piece;
            }
        }
    }
}

TEST(ApproximatePolygon, EndsOnASpiralThatLosesOnePointAtATime) {
    // Farther and farther out: the farthest point is always the last but one.
    Points points;
    for (int i = 0; i < 3000; ++i) {
        const double angle = i * 0.05;
        points.push_back({static_cast<int>(std::lround((20 + i) * std::cos(angle))),
                          static_cast<int>(std::lround((20 + i) * std::sin(angle)))});
    }
    const Points corners = approximated(points, Closure::open, SubPixel::from_int(1));
    EXPECT_GT(corners.size(), 100u);
    EXPECT_LT(corners.size(), points.size());
    EXPECT_EQ(approximated(points, Closure::open, SubPixel()).back(), points.back());
}

TEST(ApproximatePolygon, TwiceIsTheSameAsOnceForAnOpenLineWithoutTolerance) {
    Random random(92);
    const Points points = random_points(random, 60, 5);
    const Points once = approximated(points, Closure::open, SubPixel());
    EXPECT_EQ(approximated(once, Closure::open, SubPixel()), once);
}

TEST(ApproximatePolygon, SaysWhatIsWrongAndLeavesTheList) {
    const Points points = {{0, 0}, {4, 0}, {4, 4}};
    std::uint8_t scratch[8];
    List<Point, 2> two;
    ASSERT_EQ(two.push({7, 7}), Status::ok);
    const auto run = [&](Span<const Point> p, SubPixel tolerance, int room) {
        return approximate_polygon(p, Closure::closed, tolerance, Span<std::uint8_t>(scratch).first(room),
                                   two);
    };
    EXPECT_EQ(run({}, SubPixel(), 8), Status::not_found);
    EXPECT_EQ(run(span_of(points), SubPixel::from_raw(-1), 8), Status::bad_argument);
    EXPECT_EQ(run(span_of(points), SubPixel::from_int(32768), 8), Status::bad_argument);
    EXPECT_EQ(run(span_of({{0, 0}, {0, 40000}}), SubPixel(), 8), Status::bad_argument);
    EXPECT_EQ(run(span_of(points), SubPixel(), 2), Status::scratch_too_small);
    EXPECT_EQ(run(span_of(points), SubPixel(), 8), Status::capacity_exceeded);
    ASSERT_EQ(two.size(), 1);
    EXPECT_EQ(two[0], (Point{7, 7}));
}

}  // namespace
}  // namespace fovea::test
