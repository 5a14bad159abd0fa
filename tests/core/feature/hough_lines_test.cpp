// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/feature/hough_lines.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

struct Lines {
    std::vector<PolarLine> room;
    int count = 0;

    explicit Lines(int capacity) : room(static_cast<std::size_t>(capacity)) {}
    ListView<PolarLine> list() { return {room.data(), static_cast<int>(room.size()), &count}; }
    const PolarLine& operator[](int index) const { return room[static_cast<std::size_t>(index)]; }
};

Status find(ImageView<const Gray8> edges, const HoughLineOptions& options, Lines& lines) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(hough_lines_scratch(edges.size(), options)),
                                      0xee);
    return hough_lines(edges, options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                       lines.list());
}
Status find_directed(const std::vector<EdgePoint>& points, Size size, const HoughLineOptions& options,
                     Lines& lines) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(hough_lines_scratch(size, options)), 0xee);
    return hough_lines_directed({points.data(), static_cast<std::ptrdiff_t>(points.size())}, size, options,
                                {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, lines.list());
}

EdgePoint point_at(int x, int y, double degrees) {
    EdgePoint point;
    point.pixel = {x, y};
    point.place = {SubPixel::from_int(x), SubPixel::from_int(y)};
    point.gradient = FineAngle::from_microdegrees(std::llround(degrees * 1e6)).coarse();
    point.strength = 100;
    return point;
}

double degrees(const PolarLine& line) { return line.theta.microdegrees() / 1e6; }
double distance(const PolarLine& line) { return line.distance.raw() / 256.0; }

/// Counts every bin and takes the highest again and again, with nothing kept between.
std::vector<PolarLine> slow_lines(ImageView<const Gray8> edges, const HoughLineOptions& o) {
    const Point middle{(edges.width() - 1) / 2, (edges.height() - 1) / 2};
    const int half = 2 * (edges.width() + edges.height()) * 256 / o.distance_step.raw() + 2;
    std::vector<std::vector<int>> bins(static_cast<std::size_t>(o.angles),
                                       std::vector<int>(static_cast<std::size_t>(2 * half + 1)));
    const auto at = [&](int k, int d) -> int& {
        return bins[static_cast<std::size_t>(k)][static_cast<std::size_t>(d + half)];
    };
    const double step = o.distance_step.raw() / 256.0;
    for (int y = 0; y < edges.height(); ++y)
        for (int x = 0; x < edges.width(); ++x)
            for (int k = 0; k < o.angles && edges(x, y) != 0; ++k) {
                // The table's numbers, so that ties fall alike.
                const double c = std::floor(std::cos(M_PI * k / o.angles) / step * 65536 + 0.5) / 65536;
                const double s = std::floor(std::sin(M_PI * k / o.angles) / step * 65536 + 0.5) / 65536;
                ++at(k, static_cast<int>(std::floor((x - middle.x) * c + (y - middle.y) * s + 0.5)));
            }
    std::vector<PolarLine> lines;
    while (static_cast<int>(lines.size()) < o.max_lines) {
        int best_k = 0, best_d = -half;
        for (int k = 0; k < o.angles; ++k)
            for (int d = -half; d <= half; ++d)
                if (at(k, d) > at(best_k, best_d)) {
                    best_k = k;
                    best_d = d;
                }
        if (at(best_k, best_d) < o.min_votes) break;
        const double turn = M_PI * best_k / o.angles;
        const double far = best_d * step + middle.x * std::cos(turn) + middle.y * std::sin(turn);
        lines.push_back({FineAngle::from_raw(static_cast<std::uint32_t>(
                             std::floor(std::ldexp(static_cast<double>(best_k) / o.angles, 31) + 0.5))),
                         SubPixel::from_raw(static_cast<std::int32_t>(std::floor(far * 256 + 0.5))),
                         at(best_k, best_d)});
        for (int i = best_k - o.suppressed_angles; i <= best_k + o.suppressed_angles; ++i)
            for (int j = -o.suppressed_distances; j <= o.suppressed_distances; ++j) {
                const bool turned = i < 0 || i >= o.angles;
                const int d = turned ? -(best_d + j) : best_d + j;
                if (d >= -half && d <= half) at((i + o.angles) % o.angles, d) = 0;
            }
    }
    return lines;
}

TEST(HoughLines, FindARowAndAColumnWithAllTheirPixels) {
    GuardedImage<Gray8> edges({101, 61});
    edges.fill(Gray8{0});
    for (int x = 10; x < 90; ++x) edges(x, 17) = 255;
    for (int y = 5; y < 60; ++y) edges(70, y) = 1;
    Lines lines(10);
    HoughLineOptions options;
    options.min_votes = 40;
    ASSERT_EQ(find(edges.view(), options, lines), Status::ok);
    ASSERT_EQ(lines.count, 2);
    EXPECT_EQ(lines[0].theta, FineAngle::quarter_turn());
    EXPECT_EQ(lines[0].distance, SubPixel::from_int(17));
    EXPECT_EQ(lines[0].votes, 80);
    EXPECT_EQ(lines[1].theta, FineAngle());
    EXPECT_EQ(lines[1].distance, SubPixel::from_int(70));
    EXPECT_EQ(lines[1].votes, 55);
}

TEST(HoughLines, TakeGrayImagesWhichTheToolkitRefused) {
    GuardedImage<Gray8> edges({40, 40});
    edges.fill(Gray8{0});
    for (int i = 0; i < 40; ++i) edges(i, i) = 255;
    Lines lines(4);
    HoughLineOptions options;
    options.min_votes = 30;
    ASSERT_EQ(find(edges.view(), options, lines), Status::ok);
    ASSERT_EQ(lines.count, 1);
    EXPECT_NEAR(degrees(lines[0]), 135, 1.01);
    EXPECT_NEAR(distance(lines[0]), 0, 1);
}

TEST(HoughLines, NegateTheDistanceBeyondHalfATurnWhenTheyStrikeOut) {
    // A line at half a turn's end has its shoulders at its beginning, with the other sign: the toolkit struck
    // out the wrong ones and found it twice.
    GuardedImage<Gray8> edges({201, 201});
    edges.fill(Gray8{0});
    for (int y = 0; y < 201; ++y)  // normal at 179.2 degrees: x = 30 + y * 0.014
        edges(static_cast<int>(std::lround(30 + (y - 100) * 0.014)), y) = 255;
    Lines lines(10);
    HoughLineOptions options;
    options.min_votes = 60;
    ASSERT_EQ(find(edges.view(), options, lines), Status::ok);
    ASSERT_EQ(lines.count, 1);
    options.suppressed_angles = 0;
    ASSERT_EQ(find(edges.view(), options, lines), Status::ok);
    EXPECT_GT(lines.count, 1);
}

TEST(HoughLines, EqualTheReference) {
    Random random(6);
    for (const Size size : test_sizes())
        for (int round = 0; round < 5; ++round) {
            GuardedImage<Gray8> edges(size);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) edges(x, y) = random.below(6) == 0 ? 255 : 0;
            HoughLineOptions options;
            options.angles = random.between(2, 90);
            options.distance_step = SubPixel::from_raw(round == 0 ? 256 : random.between(64, 900));
            options.min_votes = random.between(1, 4);
            options.suppressed_angles = random.between(0, std::min(9, options.angles / 2));
            options.suppressed_distances = random.between(0, 12);
            options.max_lines = 12;
            Lines lines(12);
            ASSERT_EQ(find(edges.view(), options, lines), Status::ok);
            const std::vector<PolarLine> expected = slow_lines(edges.view(), options);
            ASSERT_EQ(lines.count, static_cast<int>(expected.size()));
            for (int i = 0; i < lines.count; ++i) {
                const PolarLine& wanted = expected[static_cast<std::size_t>(i)];
                ASSERT_EQ(lines[i].votes, wanted.votes) << size.width << "x" << size.height;
                ASSERT_EQ(lines[i].theta, wanted.theta);
                ASSERT_NEAR(lines[i].distance.raw(), wanted.distance.raw(), 1);
            }
        }
}

TEST(HoughLines, OfAFullImageDoNotOverflow) {
    const Size size{400, 300};
    GuardedImage<Gray8> edges(size);
    edges.fill(Gray8{255});
    HoughLineOptions options;
    options.distance_step = SubPixel::from_int(16);
    options.max_lines = 1;
    Lines lines(1);
    ASSERT_EQ(find(edges.view(), options, lines), Status::ok);
    // 16 columns wide and as long as the diagonal, less its ends.
    EXPECT_GT(lines[0].votes, 16 * 400);
    EXPECT_LT(lines[0].votes, 17 * 500);
}

TEST(HoughLinesDirected, CountTheHitsThatTheToolkitLeftEmpty) {
    std::vector<EdgePoint> points;
    for (int i = 0; i < 60; ++i) points.push_back(point_at(20 + i, 30, 90));
    for (int i = 0; i < 37; ++i) points.push_back(point_at(50, 10 + i, i % 2 == 0 ? 0 : 180));
    Lines lines(5);
    HoughLineOptions options;
    options.min_votes = 20;
    ASSERT_EQ(find_directed(points, {120, 90}, options, lines), Status::ok);
    ASSERT_EQ(lines.count, 2);
    EXPECT_EQ(lines[0].votes, 60);
    EXPECT_EQ(lines[0].theta, FineAngle::quarter_turn());
    EXPECT_EQ(lines[0].distance, SubPixel::from_int(30));
    EXPECT_EQ(lines[1].votes, 37);
    EXPECT_EQ(lines[1].theta, FineAngle());
    EXPECT_EQ(lines[1].distance, SubPixel::from_int(50));
}

TEST(HoughLinesDirected, HeedTheDirectionOfEveryPoint) {
    // The same row of points, but the gradients run along it.
    std::vector<EdgePoint> points;
    for (int i = 0; i < 60; ++i) points.push_back(point_at(20 + i, 30, 10));
    Lines lines(5);
    HoughLineOptions options;
    options.min_votes = 20;
    ASSERT_EQ(find_directed(points, {120, 90}, options, lines), Status::ok);
    EXPECT_EQ(lines.count, 0);
    options.window = Angle::from_degrees(89);
    ASSERT_EQ(find_directed(points, {120, 90}, options, lines), Status::ok);
    EXPECT_EQ(lines.count, 1);
}

TEST(HoughLinesDirected, VoteOnceForEveryAngleInTheWindowAndNeverOutside) {
    Random random(9);
    for (int round = 0; round < 300; ++round) {
        HoughLineOptions options;
        options.angles = random.between(2, 400);
        options.window = Angle::from_raw(static_cast<std::uint16_t>(random.below(65536)));
        options.min_votes = 1;
        options.max_lines = 500;
        options.suppressed_angles = options.suppressed_distances = 0;
        const EdgePoint point =
            point_at(random.between(0, 63), random.between(0, 47), random.between(0, 359));
        Lines lines(500);
        ASSERT_EQ(find_directed({point}, {64, 48}, options, lines), Status::ok);
        int expected = 0;
        const int window = std::min<int>(options.window.raw(), 16383);
        for (int k = 0; k < options.angles; ++k) {
            const double apart = std::remainder(k * 32768.0 / options.angles - point.gradient.raw(), 32768);
            expected += std::abs(apart) <= window ? 1 : 0;
        }
        EXPECT_EQ(lines.count, expected);
        for (int i = 0; i < lines.count; ++i) EXPECT_EQ(lines[i].votes, 1);
    }
    Lines lines(5);
    HoughLineOptions options;
    options.min_votes = 1;
    EdgePoint outside = point_at(64, 3, 0);
    ASSERT_EQ(find_directed({outside, point_at(-1, 3, 0), point_at(3, 48, 0)}, {64, 48}, options, lines),
              Status::ok);
    EXPECT_EQ(lines.count, 0);
}

TEST(HoughLinesDirected, HoldTheCounterOfTooManyPoints) {
    const std::vector<EdgePoint> points(70000, point_at(3, 3, 0));
    Lines lines(1);
    HoughLineOptions options;
    options.max_lines = 1;
    ASSERT_EQ(find_directed(points, {8, 8}, options, lines), Status::ok);
    ASSERT_EQ(lines.count, 1);
    EXPECT_EQ(lines[0].votes, 65535);
}

TEST(HoughLines, KeepTheStrongestOfMoreThanTheListHolds) {
    GuardedImage<Gray8> edges({100, 100});
    edges.fill(Gray8{0});
    for (int row = 0; row < 4; ++row)
        for (int x = 0; x < 60 + 10 * row; ++x) edges(x, 10 + 25 * row) = 255;
    Lines lines(2);
    ASSERT_EQ(find(edges.view(), {}, lines), Status::capacity_exceeded);
    ASSERT_EQ(lines.count, 2);
    EXPECT_EQ(lines[0].votes, 90);
    EXPECT_EQ(lines[1].votes, 80);
    HoughLineOptions two;
    two.max_lines = 2;
    EXPECT_EQ(find(edges.view(), two, lines), Status::ok);
}

TEST(HoughLines, SayWhatIsWrongAndLeaveTheList) {
    GuardedImage<Gray8> edges({30, 20});
    edges.fill(Gray8{0});
    std::vector<std::uint8_t> memory(static_cast<std::size_t>(hough_lines_scratch({30, 20}, {})));
    const Span<std::uint8_t> scratch(memory.data(), static_cast<std::ptrdiff_t>(memory.size()));
    Lines lines(3);
    lines.count = 2;
    EXPECT_EQ(hough_lines({}, {}, scratch, lines.list()), Status::empty_image);
    EXPECT_EQ(hough_lines(edges.view(), {}, scratch.first(scratch.size() - 1), lines.list()),
              Status::scratch_too_small);
    EXPECT_EQ(hough_lines_directed({}, {}, {}, scratch, lines.list()), Status::empty_image);
    EXPECT_EQ(hough_lines_directed({}, {32767, 32767}, {}, scratch, lines.list()), Status::image_too_large);
    EXPECT_EQ(hough_lines_directed({}, {32768, 1}, {}, scratch, lines.list()), Status::image_too_large);
    EXPECT_EQ(hough_lines_scratch({32767, 32767}, {}), 0);
    EXPECT_GT(hough_lines_scratch({16000, 16000}, {}), 0);
    const auto refused = [&](auto change) {
        HoughLineOptions options;
        change(options);
        EXPECT_EQ(hough_lines(edges.view(), options, scratch, lines.list()), Status::bad_argument);
        EXPECT_EQ(hough_lines_scratch({30, 20}, options), 0);
    };
    refused([](HoughLineOptions& o) { o.angles = 1; });
    refused([](HoughLineOptions& o) { o.angles = 4097; });
    refused([](HoughLineOptions& o) { o.distance_step = SubPixel::from_raw(63); });
    refused([](HoughLineOptions& o) { o.distance_step = SubPixel::from_int(17); });
    refused([](HoughLineOptions& o) { o.min_votes = 0; });
    refused([](HoughLineOptions& o) { o.max_lines = 0; });
    refused([](HoughLineOptions& o) { o.suppressed_angles = -1; });
    refused([](HoughLineOptions& o) { o.suppressed_angles = 91; });
    refused([](HoughLineOptions& o) { o.suppressed_distances = -1; });
    EXPECT_EQ(lines.count, 2);
}

TEST(HoughLines, NeedLessThanThreeHundredKilobytesAtVga) {
    EXPECT_LT(hough_lines_scratch({640, 480}, {}), 300 * 1000);
}

}  // namespace
}  // namespace fovea::test
