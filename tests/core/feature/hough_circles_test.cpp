// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/feature/canny.hpp>
#include <fovea/feature/hough_circles.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

struct Circles {
    std::vector<HoughCircle> room;
    int count = 0;

    explicit Circles(int capacity) : room(static_cast<std::size_t>(capacity)) {}
    ListView<HoughCircle> list() { return {room.data(), static_cast<int>(room.size()), &count}; }
    const HoughCircle& operator[](int index) const { return room[static_cast<std::size_t>(index)]; }
};

Status find(const std::vector<EdgePoint>& points, Size size, const HoughCircleOptions& options,
            Circles& circles) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(hough_circles_scratch(
                                          size, static_cast<std::int64_t>(points.size()), options)),
                                      0xee);
    return hough_circles({points.data(), static_cast<std::ptrdiff_t>(points.size())}, size, options,
                         {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, circles.list());
}

EdgePoint point_at(double x, double y, double turn) {
    EdgePoint point;
    point.place = {SubPixel::from_raw(static_cast<std::int32_t>(std::lround(x * 256))),
                   SubPixel::from_raw(static_cast<std::int32_t>(std::lround(y * 256)))};
    point.gradient = Angle::from_raw(
        static_cast<std::uint16_t>(static_cast<std::int64_t>(std::floor(turn / (2 * M_PI) * 65536)) & 65535));
    point.strength = 100;
    return point;
}

/// Points a pixel apart on an arc, gradients outwards or inwards.
void add_arc(std::vector<EdgePoint>& points, double cx, double cy, double r, double from = 0,
             double to = 2 * M_PI, bool outwards = true) {
    for (double turn = from; turn < to; turn += 1 / r)
        points.push_back(
            point_at(cx + r * std::cos(turn), cy + r * std::sin(turn), outwards ? turn : turn + M_PI));
}

void expect_circle(const HoughCircle& circle, double cx, double cy, double r, double tolerance) {
    EXPECT_NEAR(circle.centre.x.raw() / 256.0, cx, tolerance);
    EXPECT_NEAR(circle.centre.y.raw() / 256.0, cy, tolerance);
    EXPECT_NEAR(circle.radius.raw() / 256.0, r, tolerance);
}

TEST(HoughCircles, FindOneToATenthOfAPixelWithAllItsPoints) {
    std::vector<EdgePoint> points;
    add_arc(points, 60.3, 50.7, 31.4);
    Circles circles(4);
    ASSERT_EQ(find(points, {120, 100}, {}, circles), Status::ok);
    ASSERT_EQ(circles.count, 1);
    expect_circle(circles[0], 60.3, 50.7, 31.4, 0.1);
    EXPECT_EQ(circles[0].votes, static_cast<int>(points.size()));
    EXPECT_NEAR(circles[0].share.raw() / 65536.0, 1, 0.02);
}

TEST(HoughCircles, AboutOneCentreAreAllFound) {
    std::vector<EdgePoint> points;
    add_arc(points, 100, 90, 40);
    add_arc(points, 100, 90, 70, 0, 2 * M_PI, false);
    add_arc(points, 100, 90, 15);
    Circles circles(8);
    HoughCircleOptions options;
    ASSERT_EQ(find(points, {200, 180}, options, circles), Status::ok);
    ASSERT_EQ(circles.count, 3);
    expect_circle(circles[0], 100, 90, 70, 0.1);
    expect_circle(circles[1], 100, 90, 40, 0.1);
    expect_circle(circles[2], 100, 90, 15, 0.1);
    options.tone = CircleTone::bright;  // brighter inside
    ASSERT_EQ(find(points, {200, 180}, options, circles), Status::ok);
    ASSERT_EQ(circles.count, 1);
    expect_circle(circles[0], 100, 90, 70, 0.1);
    options.tone = CircleTone::dark;
    ASSERT_EQ(find(points, {200, 180}, options, circles), Status::ok);
    EXPECT_EQ(circles.count, 2);
}

TEST(HoughCircles, AreThoseOfThePointsInAnyOrder) {
    Random random(155);
    std::vector<EdgePoint> points;
    for (int i = 0; i < 6; ++i)
        add_arc(points, random.between(30, 270), random.between(30, 370), random.between(11, 60));
    for (int i = 0; i < 500; ++i)
        points.push_back(point_at(random.between(0, 299), random.between(0, 399), random.between(0, 6)));
    std::vector<EdgePoint> rows;  // those inside, row by row, with what a place may be off its row
    for (const EdgePoint& point : points)
        if (point.place.x.raw() >= 0 && point.place.y.raw() >= 0 && point.place.x.round() < 299 &&
            point.place.y.round() < 399)
            rows.push_back(point);
    std::stable_sort(rows.begin(), rows.end(), [](const EdgePoint& a, const EdgePoint& b) {
        return a.place.y.round() < b.place.y.round();
    });
    std::vector<EdgePoint> mixed = rows;
    for (std::size_t i = mixed.size(); i > 1; --i)
        std::swap(mixed[i - 1], mixed[random.below(static_cast<std::uint32_t>(i))]);
    Circles a(16), b(16);
    HoughCircleOptions options;
    options.min_votes = 30;
    ASSERT_EQ(find(rows, {300, 400}, options, a), Status::ok);
    ASSERT_EQ(find(mixed, {300, 400}, options, b), Status::ok);
    ASSERT_EQ(a.count, b.count);
    ASSERT_GE(a.count, 4);
    for (int i = 0; i < a.count; ++i) {
        EXPECT_EQ(a[i].centre.x, b[i].centre.x);
        EXPECT_EQ(a[i].centre.y, b[i].centre.y);
        EXPECT_EQ(a[i].radius, b[i].radius);
        EXPECT_EQ(a[i].votes, b[i].votes);
    }
}

TEST(HoughCircles, AtTheRimOfTheImageAreStruckOutInsideIt) {
    // The toolkit tested the wrong coordinate here and could write outside. Memory checks watch this.
    for (const Point centre : {Point{0, 0}, {79, 0}, {0, 59}, {79, 59}, {40, 0}, {79, 30}}) {
        std::vector<EdgePoint> points;
        for (double turn = 0; turn < 2 * M_PI; turn += 1 / 25.0) {
            const double x = centre.x + 25 * std::cos(turn), y = centre.y + 25 * std::sin(turn);
            if (x >= 0 && y >= 0 && x <= 79 && y <= 59) points.push_back(point_at(x, y, turn));
        }
        HoughCircleOptions options;
        options.min_votes = 20;
        options.min_share = Ratio();
        options.min_distance = 1000;
        for (const int cell : {1, 2, 3, 16}) {
            options.cell = cell;
            Circles circles(4);
            ASSERT_EQ(find(points, {80, 60}, options, circles), Status::ok);
            if (cell > 3) continue;  // too coarse for so small a circle
            ASSERT_EQ(circles.count, 1) << centre.x << "," << centre.y << " cell " << cell;
            // A quarter of a circle determines its centre worse than a whole one.
            expect_circle(circles[0], centre.x, centre.y, 25, 1.5);
        }
    }
}

TEST(HoughCircles, AreFoundInAPictureOfDiscsAmongNoise) {
    Random random(8);
    const Size size{240, 200};
    GuardedImage<Gray8> src(size), edges(size);
    struct Disc {
        double x, y, r;
        int level;
    };
    const std::vector<Disc> discs = {
        {60.25, 55.5, 32.75, 200}, {160.5, 70.25, 41.5, 20}, {100, 150, 24.25, 180}};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            double level = 100;
            for (const Disc& disc : discs) {
                const double inside = std::clamp(disc.r - std::hypot(x - disc.x, y - disc.y) + 0.5, 0.0, 1.0);
                level += (disc.level - level) * inside;
            }
            src(x, y) = static_cast<Gray8>(std::lround(level) + random.between(-4, 4));
        }
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(canny_scratch(size)));
    ASSERT_EQ(canny(src.view(), 60, 150, Border::replicate,
                    {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, edges.view()),
              Status::ok);
    std::vector<EdgePoint> points(3000);
    int count = 0;
    ASSERT_EQ(canny_points(src.view(), edges.view(), Border::replicate,
                           ListView<EdgePoint>(points.data(), 3000, &count)),
              Status::ok);
    points.resize(static_cast<std::size_t>(count));
    Circles circles(10);
    HoughCircleOptions options;
    options.min_radius = 20;
    options.max_radius = 60;
    options.min_share = Ratio::from_ratio(1, 2);
    ASSERT_EQ(find(points, size, options, circles), Status::ok);
    ASSERT_EQ(circles.count, 3);
    for (int i = 0; i < 3; ++i) {
        const HoughCircle& circle = circles[i];
        const auto disc = std::find_if(discs.begin(), discs.end(), [&](const Disc& d) {
            return std::hypot(circle.centre.x.raw() / 256.0 - d.x, circle.centre.y.raw() / 256.0 - d.y) < 5;
        });
        ASSERT_NE(disc, discs.end());
        expect_circle(circle, disc->x, disc->y, disc->r, 0.15);
        // On slopes some rows have two pixels of an edge.
        EXPECT_NEAR(circle.share.raw() / 65536.0, 1.1, 0.1);
    }
}

TEST(HoughCircles, NeedDirectionsThatPointAtTheCentre) {
    std::vector<EdgePoint> points;
    add_arc(points, 60, 50, 30);
    for (EdgePoint& point : points) point.gradient = point.gradient + Angle::from_degrees(30);
    Circles circles(4);
    ASSERT_EQ(find(points, {120, 100}, {}, circles), Status::ok);
    EXPECT_EQ(circles.count, 0);
}

TEST(HoughCircles, KeepTheStrongestOfMoreThanTheListHolds) {
    std::vector<EdgePoint> points;
    add_arc(points, 50, 50, 20);
    add_arc(points, 150, 50, 30);
    add_arc(points, 90, 140, 45);
    Circles circles(2);
    ASSERT_EQ(find(points, {220, 200}, {}, circles), Status::capacity_exceeded);
    ASSERT_EQ(circles.count, 2);
    expect_circle(circles[0], 90, 140, 45, 0.1);
    expect_circle(circles[1], 150, 50, 30, 0.1);
}

TEST(HoughCircles, BearPointsOfEveryKind) {
    Random random(10);
    for (int round = 0; round < 60; ++round) {
        const Size size = test_sizes()[static_cast<std::size_t>(round) % test_sizes().size()];
        std::vector<EdgePoint> points(static_cast<std::size_t>(random.between(0, 200)));
        for (EdgePoint& point : points) {
            point.place = {
                SubPixel::from_raw(random.below(9) == 0 ? static_cast<std::int32_t>(random.next())
                                                        : random.between(0, 256 * (size.width - 1))),
                SubPixel::from_raw(random.below(9) == 0 ? static_cast<std::int32_t>(random.next())
                                                        : random.between(0, 256 * (size.height - 1)))};
            point.gradient = Angle::from_raw(static_cast<std::uint16_t>(random.next()));
        }
        HoughCircleOptions options;
        options.min_radius = random.between(2, 20);
        options.max_radius = options.min_radius + random.between(0, 50);
        options.cell = random.between(1, 16);
        options.min_votes = 1;
        options.min_share = Ratio();
        options.window = Angle::from_degrees(random.between(0, 89));
        Circles circles(50);
        const Status status = find(points, size, options, circles);
        ASSERT_TRUE(status == Status::ok || status == Status::capacity_exceeded);
        for (int i = 1; i < circles.count; ++i) ASSERT_GE(circles[i - 1].votes, circles[i].votes);
    }
}

TEST(HoughCircles, NeedLessThanTwoHundredKilobytesAtVgaWhereTheToolkitTook104Megabytes) {
    EXPECT_LT(hough_circles_scratch({640, 480}, 10000, {}), 200 * 1000);
}

TEST(HoughCircles, SayWhatIsWrongAndLeaveTheList) {
    std::vector<std::uint8_t> memory(static_cast<std::size_t>(hough_circles_scratch({30, 20}, 0, {})));
    const Span<std::uint8_t> scratch(memory.data(), static_cast<std::ptrdiff_t>(memory.size()));
    Circles circles(3);
    circles.count = 2;
    EXPECT_EQ(hough_circles({}, {}, {}, scratch, circles.list()), Status::empty_image);
    EXPECT_EQ(hough_circles({}, {32768, 2}, {}, scratch, circles.list()), Status::image_too_large);
    EXPECT_EQ(hough_circles({}, {30, 20}, {}, scratch.first(scratch.size() - 1), circles.list()),
              Status::scratch_too_small);
    const auto refused = [&](auto change) {
        HoughCircleOptions options;
        change(options);
        EXPECT_EQ(hough_circles({}, {30, 20}, options, scratch, circles.list()), Status::bad_argument);
        EXPECT_EQ(hough_circles_scratch({30, 20}, 0, options), 0);
    };
    refused([](HoughCircleOptions& o) { o.min_radius = 1; });
    refused([](HoughCircleOptions& o) { o.max_radius = 9; });
    refused([](HoughCircleOptions& o) { o.max_radius = 8193; });
    refused([](HoughCircleOptions& o) { o.cell = 0; });
    refused([](HoughCircleOptions& o) { o.cell = 17; });
    refused([](HoughCircleOptions& o) { o.min_votes = 0; });
    refused([](HoughCircleOptions& o) { o.min_share = Ratio::from_raw(-1); });
    refused([](HoughCircleOptions& o) { o.min_distance = -1; });
    refused([](HoughCircleOptions& o) { o.max_misses = 0; });
    refused([](HoughCircleOptions& o) { o.window = Angle::from_degrees(90); });
    EXPECT_EQ(circles.count, 2);
}

}  // namespace
}  // namespace fovea::test
