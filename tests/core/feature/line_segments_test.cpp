// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/feature/line_segments.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

struct Segments {
    std::vector<LineSegment> room;
    int count = 0;

    explicit Segments(int capacity) : room(static_cast<std::size_t>(capacity)) {}
    ListView<LineSegment> list() { return {room.data(), static_cast<int>(room.size()), &count}; }
    const LineSegment& operator[](int index) const { return room[static_cast<std::size_t>(index)]; }
};

PolarLine line_of(double degrees, double distance) {
    PolarLine line;
    line.theta = FineAngle::from_microdegrees(static_cast<std::int64_t>(degrees * 1e6));
    line.distance = SubPixel::from_raw(static_cast<std::int32_t>(distance * 256));
    return line;
}

Status find(ImageView<const Gray8> edges, const std::vector<PolarLine>& lines,
            const LineSegmentOptions& options, Segments& segments) {
    return line_segments(edges, {lines.data(), static_cast<std::ptrdiff_t>(lines.size())}, options,
                         segments.list());
}

TEST(LineSegments, EndWhereTheEdgeEndsAndSpanShortGaps) {
    GuardedImage<Gray8> edges({60, 20});
    edges.fill(Gray8{0});
    for (int x = 5; x <= 50; ++x)
        if (x != 20 && x != 21 && (x < 30 || x > 32)) edges(x, x < 40 ? 7 : 8) = 255;
    Segments segments(5);
    LineSegmentOptions options;
    options.min_length = 5;
    ASSERT_EQ(find(edges.view(), {line_of(90, 7)}, options, segments), Status::ok);
    ASSERT_EQ(segments.count, 2);
    // Two pixels are missing at 20, which is bridged; three at 30 are not. Row 8 is within the tolerance.
    EXPECT_EQ(segments[0].from, (Point{5, 7}));
    EXPECT_EQ(segments[0].to, (Point{29, 7}));
    EXPECT_EQ(segments[0].pixels, 23);
    EXPECT_EQ(segments[1].from, (Point{33, 7}));
    EXPECT_EQ(segments[1].to, (Point{50, 8}));
    options.tolerance = 0;
    options.max_gap = 3;
    options.min_length = 35;
    ASSERT_EQ(find(edges.view(), {line_of(90, 7), line_of(90, 8)}, options, segments), Status::ok);
    ASSERT_EQ(segments.count, 1);
    EXPECT_EQ(segments[0].to, (Point{39, 7}));
    EXPECT_EQ(segments[0].pixels, 30);
}

TEST(LineSegments, HaveTheEndsOfLinesThatWereDrawn) {
    Random random(5);
    for (int round = 0; round < 200; ++round) {
        GuardedImage<Gray8> edges({120, 90});
        edges.fill(Gray8{0});
        const Point a{random.between(0, 119), random.between(0, 89)};
        const Point b{random.between(0, 119), random.between(0, 89)};
        const int length = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
        if (length < 25) continue;
        ASSERT_EQ(draw_line(edges.view(), a, b, Gray8{255}), Status::ok);
        // The normal is the line's direction a quarter turn on.
        PolarLine line;
        line.theta = angle_of(std::int32_t{-(b.y - a.y)}, std::int32_t{b.x - a.x});
        const UnitVector normal = unit_vector(line.theta);
        line.distance = SubPixel::from_raw(static_cast<std::int32_t>(
            round_shift(std::int64_t{a.x} * normal.x.raw() + std::int64_t{a.y} * normal.y.raw(), 22)));
        Segments segments(3);
        ASSERT_EQ(find(edges.view(), {line}, {}, segments), Status::ok);
        ASSERT_EQ(segments.count, 1) << a.x << "," << a.y << " " << b.x << "," << b.y;
        const bool forward = segments[0].from == a && segments[0].to == b;
        const bool backward = segments[0].from == b && segments[0].to == a;
        EXPECT_TRUE(forward || backward) << a.x << "," << a.y << " " << b.x << "," << b.y;
        EXPECT_EQ(segments[0].pixels, length + 1);
    }
}

TEST(LineSegments, KeepThoseWithMostPixels) {
    GuardedImage<Gray8> edges({100, 30});
    edges.fill(Gray8{0});
    for (const auto& [from, to] : {std::pair{0, 9}, {20, 39}, {50, 59}, {70, 99}})
        for (int x = from; x <= to; ++x) edges(x, 4) = 255;
    LineSegmentOptions options;
    options.min_length = 3;
    for (const int capacity : {0, 1, 2, 3, 4}) {
        Segments segments(capacity);
        EXPECT_EQ(find(edges.view(), {line_of(90, 4)}, options, segments),
                  capacity < 4 ? Status::capacity_exceeded : Status::ok);
        ASSERT_EQ(segments.count, capacity);
        const std::vector<std::vector<int>> firsts = {{}, {70}, {20, 70}, {0, 20, 70}, {0, 20, 50, 70}};
        for (int i = 0; i < capacity; ++i)
            EXPECT_EQ(segments[i].from.x,
                      firsts[static_cast<std::size_t>(capacity)][static_cast<std::size_t>(i)]);
    }
}

TEST(LineSegments, AskForNoPixelOutside) {
    Random random(6);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> edges(size);
        edges.fill(Gray8{255});
        for (int i = 0; i < 50; ++i) {
            PolarLine line;
            line.theta = FineAngle::from_raw(random.next());
            line.distance = SubPixel::from_raw(i < 45 ? random.between(-20000, 20000)
                                                      : static_cast<std::int32_t>(random.next()));
            LineSegmentOptions options;
            options.min_length = 1;
            options.tolerance = random.between(0, 8);
            Segments segments(10);
            ASSERT_EQ(find(edges.view(), {line}, options, segments), Status::ok);
            for (int k = 0; k < segments.count; ++k) {
                ASSERT_TRUE(edges.view().contains(segments[k].from));
                ASSERT_TRUE(edges.view().contains(segments[k].to));
            }
        }
    }
}

TEST(LineSegments, SayWhatIsWrongAndLeaveTheList) {
    GuardedImage<Gray8> edges({30, 20});
    edges.fill(Gray8{255});
    Segments segments(3);
    segments.count = 2;
    EXPECT_EQ(find({}, {line_of(0, 3)}, {}, segments), Status::empty_image);
    for (const LineSegmentOptions& wrong : {LineSegmentOptions{0, 2, 1}, LineSegmentOptions{1, -1, 1},
                                            LineSegmentOptions{1, 2, -1}, LineSegmentOptions{1, 2, 9}})
        EXPECT_EQ(find(edges.view(), {line_of(0, 3)}, wrong, segments), Status::bad_argument);
    EXPECT_EQ(segments.count, 2);
}

}  // namespace
}  // namespace fovea::test
