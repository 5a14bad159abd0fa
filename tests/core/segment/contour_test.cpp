// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include <core/segment/contour_pictures.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/contour.hpp>
#include <fovea/segment/polygon.hpp>

namespace fovea::test {
namespace {

using Points = std::vector<Point>;

Points border(const GuardedImage<Gray8>& image, Point start,
              Connectivity connectivity = Connectivity::eight) {
    Points points;
    EXPECT_EQ(trace_region_border(image.view(), connectivity, start, [&](Point p) { points.push_back(p); }),
              Status::ok);
    return points;
}

struct Traced {
    Status status = Status::ok;
    std::vector<Region> regions;
    std::vector<Hole> holes;
    std::vector<Contour> contours;
    Points points;

    Points of(std::size_t i) const {
        const auto first = points.begin() + contours[i].first;
        return {first, first + contours[i].count};
    }
};

Traced trace(ImageView<const Gray8> image, Connectivity connectivity, ContourPoints wanted,
             int point_room = 20000, int contour_room = 4000) {
    Traced traced;
    traced.regions.resize(4000);
    traced.holes.resize(4000);
    traced.contours.resize(static_cast<std::size_t>(contour_room));
    traced.points.resize(static_cast<std::size_t>(point_room));
    int regions = 0, holes = 0, points = 0, contours = 0;
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(connected_components_scratch(std::max(image.width(), 1))));
    ComponentOptions options;
    options.connectivity = connectivity;
    EXPECT_EQ(
        connected_components(image, options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                             ListView<Region>(traced.regions.data(), 4000, &regions),
                             ListView<Hole>(traced.holes.data(), 4000, &holes)),
        Status::ok);
    traced.regions.resize(static_cast<std::size_t>(regions));
    traced.holes.resize(static_cast<std::size_t>(holes));
    traced.status = trace_contours(image, connectivity, wanted, {traced.regions.data(), regions},
                                   {traced.holes.data(), holes},
                                   ListView<Point>(traced.points.data(), point_room, &points),
                                   ListView<Contour>(traced.contours.data(), contour_room, &contours));
    traced.points.resize(static_cast<std::size_t>(points));
    traced.contours.resize(static_cast<std::size_t>(contours));
    return traced;
}

TEST(TraceRegionBorder, WalksClockwiseAroundAPlus) {
    const auto image = drawn({".....", "..#..", ".###.", "..#..", "....."});
    EXPECT_EQ(border(image, {2, 1}), (Points{{2, 1}, {3, 2}, {2, 3}, {1, 2}}));
    EXPECT_EQ(border(image, {2, 1}, Connectivity::four),
              (Points{{2, 1}, {2, 2}, {3, 2}, {2, 2}, {2, 3}, {2, 2}, {1, 2}, {2, 2}}));
}

TEST(TraceRegionBorder, APixelIsOnePointAndALineIsWalkedThereAndBack) {
    EXPECT_EQ(border(drawn({"#"}), {0, 0}), (Points{{0, 0}}));
    EXPECT_EQ(border(drawn({"###"}), {0, 0}), (Points{{0, 0}, {1, 0}, {2, 0}, {1, 0}}));
}

TEST(TraceRegionBorder, OfAWholeImageIsItsRim) {
    GuardedImage<Gray8> image({5, 4});
    image.fill(Gray8{1});
    EXPECT_EQ(border(image, {0, 0}).size(), 14u);
}

TEST(TraceHoleBorder, WalksCounterClockwiseAroundAHole) {
    const auto image = drawn({"####", "#..#", "####"});
    Points points;
    ASSERT_EQ(
        trace_hole_border(image.view(), Connectivity::eight, {1, 1}, [&](Point p) { points.push_back(p); }),
        Status::ok);
    EXPECT_EQ(points, (Points{{0, 1}, {1, 2}, {2, 2}, {3, 1}, {2, 0}, {1, 0}}));
}

TEST(ChainCode, IsTheWayBetweenNeighbours) {
    for (int code = 0; code < 8; ++code) {
        const Point step = chain_step(static_cast<ChainCode>(code));
        const Result<ChainCode> found = chain_code({5, 5}, {5 + step.x, 5 + step.y});
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, code);
    }
    EXPECT_EQ(chain_code({0, 0}, {0, 0}).status(), Status::bad_argument);
    EXPECT_EQ(chain_code({0, 0}, {2, 1}).status(), Status::bad_argument);
}

/// The pixels that a contour must visit: those of a region that touch a piece of ground, which is all outside
/// for its outer border, one hole for an inner one.
std::set<std::pair<int, int>> touching(ImageView<const Gray8> image, Connectivity connectivity, Point seed,
                                       Point ground_seed) {
    const auto flood = [&](Point from, bool set, bool corners) {
        std::set<std::pair<int, int>> done = {{from.x, from.y}};
        std::vector<Point> open = {from};
        while (!open.empty()) {
            const Point p = open.back();
            open.pop_back();
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const Point q{p.x + dx, p.y + dy};
                    if (dx != 0 && dy != 0 && !corners) continue;
                    if (q.x < -1 || q.y < -1 || q.x > image.width() || q.y > image.height()) continue;
                    const bool belongs = image.contains(q) && image(q.x, q.y) != 0;
                    if (belongs == set && done.insert({q.x, q.y}).second) open.push_back(q);
                }
        }
        return done;
    };
    const bool eight = connectivity == Connectivity::eight;
    const auto region = flood(seed, true, eight);
    const auto ground = flood(ground_seed, false, !eight);
    std::set<std::pair<int, int>> rim;
    for (const auto& [x, y] : region)
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if ((eight ? dx == 0 || dy == 0 : true) && ground.count({x + dx, y + dy}) != 0)
                    rim.insert({x, y});
    return rim;
}

TEST(TraceContours, VisitExactlyThePixelsThatTouchTheirGround) {
    Random random(51);
    for (int round = 0; round < 50; ++round) {
        const Size size{random.between(1, 24), random.between(1, 20)};
        const auto image = random_blocks(size, random);
        for (const Connectivity connectivity : {Connectivity::eight, Connectivity::four}) {
            const Traced traced = trace(image.view(), connectivity, ContourPoints::all);
            ASSERT_EQ(traced.status, Status::ok);
            ASSERT_EQ(traced.contours.size(), traced.regions.size() + traced.holes.size());
            for (std::size_t i = 0; i < traced.contours.size(); ++i) {
                const Contour& contour = traced.contours[i];
                const Points points = traced.of(i);
                const bool hole = i >= traced.regions.size();
                ASSERT_EQ(contour.hole, hole);
                ASSERT_EQ(contour.parent, hole ? contour.region : -1);
                std::set<std::pair<int, int>> visited;
                for (std::size_t k = 0; k < points.size(); ++k) {
                    visited.insert({points[k].x, points[k].y});
                    const Point next = points[(k + 1) % points.size()];
                    if (points.size() > 1) {
                        ASSERT_TRUE(chain_code(points[k], next)) << "a step is to a neighbour";
                    }
                }
                const Region& region = traced.regions[static_cast<std::size_t>(contour.region)];
                const Point ground = hole ? traced.holes[i - traced.regions.size()].first : Point{-1, -1};
                auto expected = touching(image.view(), connectivity, region.first, ground);
                // Of a region inside a hole the ground outside is that hole.
                if (!hole)
                    expected = touching(image.view(), connectivity, region.first,
                                        {region.first.x - 1, region.first.y});
                ASSERT_EQ(visited, expected) << "round " << round << " contour " << i;
                const auto area = doubled_area(span_of(points));
                ASSERT_TRUE(area);
                ASSERT_TRUE(hole ? *area <= 0 : *area >= 0);
            }
        }
    }
}

TEST(TraceContours, AreaFollowsPicksTheorem) {
    // A region without holes or thin places: pixels = enclosed area + half the points + 1.
    const auto image = drawn({"........", "..###...", ".#####..", ".######.", "..####..", "........"});
    const Traced traced = trace(image.view(), Connectivity::eight, ContourPoints::all);
    ASSERT_EQ(traced.contours.size(), 1u);
    const auto doubled = doubled_area(span_of(traced.points));
    EXPECT_EQ(2 * traced.regions[0].moments.area(), *doubled + static_cast<int>(traced.points.size()) + 2);
}

TEST(TraceContours, CornersEncloseTheSameAndHaveTheSameLength) {
    Random random(52);
    for (int round = 0; round < 60; ++round) {
        const auto image = random_blocks({random.between(1, 40), random.between(1, 40)}, random);
        const auto connectivity = round % 2 == 0 ? Connectivity::eight : Connectivity::four;
        const Traced all = trace(image.view(), connectivity, ContourPoints::all);
        const Traced corners = trace(image.view(), connectivity, ContourPoints::corners);
        ASSERT_EQ(all.contours.size(), corners.contours.size());
        for (std::size_t i = 0; i < all.contours.size(); ++i) {
            const Points a = all.of(i), b = corners.of(i);
            ASSERT_LE(b.size(), a.size());
            ASSERT_EQ(doubled_area(span_of(a)).value(), doubled_area(span_of(b)).value());
            ASSERT_EQ(polygon_length(span_of(a), Closure::closed).value(),
                      polygon_length(span_of(b), Closure::closed).value());
            for (std::size_t k = 0; b.size() > 2 && k < b.size(); ++k) {
                const Point p = b[k], q = b[(k + 1) % b.size()], r = b[(k + 2) % b.size()];
                const int turn = (q.x - p.x) * (r.y - q.y) - (q.y - p.y) * (r.x - q.x);
                const int along = (q.x - p.x) * (r.x - q.x) + (q.y - p.y) * (r.y - q.y);
                ASSERT_FALSE(turn == 0 && along > 0) << "a point on a straight piece";
            }
        }
    }
}

TEST(TraceContours, GoThroughSpiralsAndCombs) {
    const auto wound = spiral(61);
    const Traced line = trace(wound.view(), Connectivity::eight, ContourPoints::all);
    ASSERT_EQ(line.contours.size(), 1u);
    // A line is walked there and back; corners are cut diagonally on one side of them or both.
    EXPECT_GT(static_cast<int>(line.points.size()), line.regions[0].moments.area());
    const auto teeth = comb({41, 17});
    const Traced walked = trace(teeth.view(), Connectivity::eight, ContourPoints::corners);
    ASSERT_EQ(walked.contours.size(), 1u);
    EXPECT_EQ(walked.contours[0].count, static_cast<int>(walked.points.size()));
}

TEST(TraceContours, KeepWholeContoursWhenAListIsFull) {
    const auto image = drawn({"##.##.##", "##.##.##"});
    const Traced few_points = trace(image.view(), Connectivity::eight, ContourPoints::all, 10);
    EXPECT_EQ(few_points.status, Status::capacity_exceeded);
    EXPECT_EQ(few_points.contours.size(), 2u);
    EXPECT_EQ(few_points.points.size(), 8u);
    const Traced few_contours = trace(image.view(), Connectivity::eight, ContourPoints::all, 100, 1);
    EXPECT_EQ(few_contours.status, Status::capacity_exceeded);
    EXPECT_EQ(few_contours.points.size(), 4u);
}

TEST(TraceContours, SayWhatIsWrong) {
    const auto image = drawn({".##", ".##", "..."});
    const auto ignore = [](Point) {};
    EXPECT_EQ(trace_region_border(ImageView<const Gray8>(), Connectivity::eight, {0, 0}, ignore),
              Status::empty_image);
    EXPECT_EQ(trace_region_border(image.view(), Connectivity::eight, {3, 0}, ignore), Status::out_of_range);
    for (const Point p : {Point{0, 0}, Point{2, 0}, Point{1, 1}})
        EXPECT_EQ(trace_region_border(image.view(), Connectivity::eight, p, ignore), Status::bad_argument);
    EXPECT_EQ(trace_hole_border(ImageView<const Gray8>(), Connectivity::eight, {0, 0}, ignore),
              Status::empty_image);
    EXPECT_EQ(trace_hole_border(image.view(), Connectivity::eight, {0, -1}, ignore), Status::out_of_range);
    for (const Point p : {Point{0, 0}, Point{1, 0}, Point{1, 2}})
        EXPECT_EQ(trace_hole_border(image.view(), Connectivity::eight, p, ignore), Status::bad_argument);
    Traced stray;
    List<Point, 8> points;
    List<Contour, 8> contours;
    Hole lost;
    lost.region = 1;
    const Hole holes[] = {lost};
    EXPECT_EQ(
        trace_contours(image.view(), Connectivity::eight, ContourPoints::all, {}, holes, points, contours),
        Status::bad_argument);
}

}  // namespace
}  // namespace fovea::test
