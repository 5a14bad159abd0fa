// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/light_section/line_peak.hpp>
#include <fovea/stream/stream.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

Span<LinePeak> span_of(std::vector<LinePeak>& peaks) {
    return {peaks.data(), static_cast<std::ptrdiff_t>(peaks.size())};
}
std::vector<LinePeak> peaks_of(int rows) { return std::vector<LinePeak>(static_cast<std::size_t>(rows)); }

void expect_equal(const LinePeak& a, const LinePeak& b) {
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.strength, b.strength);
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.runs, b.runs);
}

/// Every stretch of pixels that reach the level and cannot be longer, one after the other.
LinePeak naive_line_peak(const GuardedImage<Gray8>& image, int width, int y, const LinePeakOptions& options) {
    const auto bright = [&](int x) { return x >= 0 && x < width && image(x, y) >= options.level; };
    LinePeak best;
    for (int first = 0; first < width; ++first) {
        if (!bright(first) || bright(first - 1)) continue;
        for (int end = first + 1; end <= width; ++end) {
            bool run = !bright(first - 1) && !bright(end);
            for (int x = first; x < end; ++x) run = run && bright(x);
            if (!run) continue;
            std::int64_t weights = 0;
            std::int64_t moments = 0;
            for (int x = first; x < end; ++x) {
                weights += image(x, y) - (options.level - 1);
                moments += std::int64_t{x} * (image(x, y) - (options.level - 1));
            }
            if (end - first < options.width_min || end - first > options.width_max) continue;
            if (weights < options.strength_min) continue;
            ++best.runs;
            if (weights <= best.strength) continue;
            best.strength = static_cast<int>(weights);
            best.width = static_cast<std::uint16_t>(end - first);
            // To the nearest, ties up.
            best.x = SubPixel::from_raw(static_cast<std::int32_t>((512 * moments + weights) / (2 * weights)));
        }
    }
    return best;
}

TEST(LinePeak, IsTheCentreOfWhatStandsAboveTheLevel) {
    //                      0  1  2    3    4    5  6  7    8  9
    const Gray8 row[10] = {9, 9, 109, 119, 114, 9, 9, 130, 9, 9};
    LinePeakOptions options;
    options.level = 100;
    // Weights 10, 20 and 15 at 2, 3 and 4: 140 / 45 = 3.1111, that is 796.44 / 256. Alone, 31 at 7 are less.
    const LinePeak peak = line_peak(row, 10, options);
    EXPECT_EQ(peak.x.raw(), 796);
    EXPECT_EQ(peak.strength, 45);
    EXPECT_EQ(peak.width, 3);
    EXPECT_EQ(peak.runs, 2);
    options.width_max = 2;
    expect_equal(line_peak(row, 10, options), {SubPixel::from_int(7), 31, 1, 1});
    options.strength_min = 32;
    EXPECT_TRUE(line_peak(row, 10, options).empty());
    EXPECT_EQ(line_peak(row, 10, options).runs, 0);
}

TEST(LinePeak, TakesTheFirstOfEquals) {
    const Gray8 row[5] = {200, 0, 200, 0, 200};
    const LinePeak peak = line_peak(row, 5, {});
    EXPECT_EQ(peak.x, SubPixel::from_int(0));
    EXPECT_EQ(peak.runs, 3);
}

TEST(LinePeak, RoundsHalvesUp) {
    // Weights 255, 255 and 2 from 1 on: 1 + 259 / 512, that is 385.5 / 256.
    const Gray8 row[4] = {0, 255, 255, 2};
    LinePeakOptions options;
    options.level = 1;
    EXPECT_EQ(line_peak(row, 4, options).x.raw(), 386);
}

TEST(LinePeaks, AreThoseOfTheObviousWay) {
    Random random(41);
    for (const Size size : test_sizes())
        for (int turn = 0; turn < 6; ++turn) {
            GuardedImage<Gray8> image(size);
            image.fill(random);
            LinePeakOptions options;
            options.level = random.between(1, 255);
            options.width_min = random.between(1, 3);
            options.width_max = turn % 2 == 0 ? max_image_side : options.width_min + random.between(0, 9);
            options.strength_min = random.between(1, 200);
            std::vector<LinePeak> peaks = peaks_of(size.height);
            ASSERT_EQ(line_peaks(image.view(), options, span_of(peaks)), Status::ok);
            for (int y = 0; y < size.height; ++y)
                expect_equal(peaks[static_cast<std::size_t>(y)],
                             naive_line_peak(image, size.width, y, options));
        }
}

TEST(LinePeaks, MoveWithTheLine) {
    // A line of three pixels, further right by one and with the same grey levels.
    GuardedImage<Gray8> image({64, 60});
    image.fill(Gray8{20});
    for (int y = 0; y < 60; ++y) {
        image(y, y) = 150;
        image(y + 1, y) = 210;
        image(y + 2, y) = 170;
    }
    std::vector<LinePeak> peaks = peaks_of(60);
    ASSERT_EQ(line_peaks(image.view(), {}, span_of(peaks)), Status::ok);
    for (int y = 0; y < 60; ++y)
        EXPECT_EQ(peaks[static_cast<std::size_t>(y)].x, peaks[0].x + SubPixel::from_int(y));
}

TEST(LinePeaks, OfExtremeImages) {
    GuardedImage<Gray8> image({33, 3});
    std::vector<LinePeak> peaks = peaks_of(3);
    image.fill(Gray8{0});
    ASSERT_EQ(line_peaks(image.view(), {}, span_of(peaks)), Status::ok);
    for (const LinePeak& peak : peaks) EXPECT_TRUE(peak.empty());
    image.fill(Gray8{255});
    ASSERT_EQ(line_peaks(image.view(), {}, span_of(peaks)), Status::ok);
    for (const LinePeak& peak : peaks) expect_equal(peak, {SubPixel::from_int(16), 33 * 128, 33, 1});
    std::vector<Gray8> longest(max_image_side, 255);
    LinePeakOptions options;
    options.level = 1;
    expect_equal(line_peak(longest.data(), max_image_side, options),
                 {SubPixel::from_int(16383), 255 * max_image_side, max_image_side, 1});
}

TEST(LinePeaks, SayWhatIsWrongAndLeaveThePeaks) {
    GuardedImage<Gray8> image({4, 3});
    image.fill(Gray8{255});
    std::vector<LinePeak> peaks(4, LinePeak{SubPixel::from_int(7), 7, 7, 7});
    EXPECT_EQ(line_peaks({}, {}, span_of(peaks)), Status::empty_image);
    EXPECT_EQ(line_peaks(image.view(), {}, span_of(peaks)), Status::size_mismatch);
    const auto refused = [&](const LinePeakOptions& options) {
        EXPECT_EQ(line_peaks(image.view(), options, span_of(peaks).first(3)), Status::bad_argument);
    };
    LinePeakOptions options;
    options.level = 0;
    refused(options);
    options.level = 256;
    refused(options);
    options = {};
    options.width_min = 0;
    refused(options);
    options.width_min = 5;
    options.width_max = 4;
    refused(options);
    options = {};
    options.strength_min = 0;
    refused(options);
    EXPECT_EQ(LinePeakAccumulator({}, span_of(peaks)).begin({max_image_side + 1, 4}),
              Status::image_too_large);
    for (const LinePeak& peak : peaks) EXPECT_EQ(peak.strength, 7);
}

TEST(LinePeakAccumulator, GivesTheSameOfRowsAndOfStrips) {
    Random random(42);
    std::vector<std::uint8_t> memory(1 << 13);
    const Span<std::uint8_t> work{memory.data(), 1 << 13};
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> image(size);
        image.fill(random);
        std::vector<LinePeak> expected = peaks_of(size.height), made = expected, shared = expected;
        ASSERT_EQ(line_peaks(image.view(), {}, span_of(expected)), Status::ok);
        LinePeakAccumulator accumulator({}, span_of(made));
        auto rows = stream(into(accumulator));
        ASSERT_EQ(rows.start(size, Border::zero, work), Status::ok);
        for (int y = 0; y < size.height; ++y) ASSERT_EQ(rows.push(image.view().row(y)), Status::ok);
        auto strips = stream(LinePeakAccumulator({}, span_of(shared)));
        for (int y = size.height - 1; y >= 0; --y)
            ASSERT_EQ(strips.run_strip(image.view(), Border::zero, y, y, work), Status::ok);
        for (std::size_t y = 0; y < expected.size(); ++y) {
            expect_equal(made[y], expected[y]);
            expect_equal(shared[y], expected[y]);
        }
    }
}

}  // namespace
}  // namespace fovea::test
