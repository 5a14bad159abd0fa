// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/bar_line.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

SubPixelPoint at(int x, int y) { return {SubPixel::from_int(x), SubPixel::from_int(y)}; }

BarPicture ramp() {
    BarPicture picture({20, 10});
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x) picture.view()(x, y) = static_cast<Gray8>(10 * x + y);
    return picture;
}
std::vector<std::int16_t> sampled(const BarPicture& picture, const BarLine& line, int breadth) {
    std::vector<std::int16_t> profile(static_cast<std::size_t>(line.samples));
    sample_bar_line(picture.view(), line, breadth, {profile.data(), line.samples});
    return profile;
}

TEST(BarLine, SamplesARow) {
    const BarLine row = bar_line_through({20, 10}, at(3, 4), at(7, 4), 0);
    EXPECT_EQ(row.samples, 5);
    EXPECT_EQ(sampled(ramp(), row, 1), (std::vector<std::int16_t>{544, 704, 864, 1024, 1184}));
    EXPECT_EQ(sampled(ramp(), row, 3), (std::vector<std::int16_t>{544, 704, 864, 1024, 1184}));
}

TEST(BarLine, SamplesAColumnFromBelow) {
    const BarLine column = bar_line_through({20, 10}, at(3, 6), at(3, 4), 0);
    EXPECT_EQ(sampled(ramp(), column, 1), (std::vector<std::int16_t>{36 * 16, 35 * 16, 34 * 16}));
}

TEST(BarLine, SamplesBetweenPixels) {
    const BarLine slanted = bar_line_through({20, 10}, at(2, 2), at(14, 7), 0);
    EXPECT_EQ(slanted.samples, 14);
    const std::vector<std::int16_t> profile = sampled(ramp(), slanted, 1);
    for (int i = 0; i < slanted.samples; ++i) {
        // The direction is (12, 5) / 13.
        EXPECT_NEAR(profile[static_cast<std::size_t>(i)] / 16.0, 22 + i * (120 + 5) / 13.0, 0.2);
    }
}

TEST(BarLine, ReachesBeyondTheEndsAsFarAsTheImageGoes) {
    const BarLine row = bar_line_through({20, 10}, at(4, 3), at(12, 3), 8);
    EXPECT_EQ(row.samples, 8 + 4 + 4 + 1);
    EXPECT_EQ(row.from.x, FinePixel::from_int(0));
    EXPECT_EQ(bar_line_through({20, 10}, at(4, 3), at(12, 3), 64).samples, 20);
    EXPECT_EQ(bar_line_through({20, 10}, at(4, 3), at(4, 3), 8).samples, 0);
    EXPECT_EQ(bar_line_through({20, 10}, at(4, -3), at(12, -3), 8).samples, 0);
}

TEST(BarLine, PointsLieOnIt) {
    const BarLine row = bar_line_through({20, 10}, at(4, 3), at(12, 3), 0);
    EXPECT_EQ(point_of(row, 640).x.raw(), 4 * 256 + 640);
    EXPECT_EQ(point_of(row, 640).y.raw(), 3 * 256);
}

TEST(BarLine, AnyLineStaysInTheImage) {
    Random random(3161);
    for (int round = 0; round < 2000; ++round) {
        const Size size{random.between(1, 40), random.between(1, 40)};
        BarPicture picture(size);
        const auto point = [&] { return at(random.between(-10, 50), random.between(-10, 50)); };
        const BarLine line = bar_line_through(size, point(), point(), random.between(0, 40));
        EXPECT_LE(line.samples, size.width + size.height);
        for (const std::int16_t sample : sampled(picture, line, random.between(0, 3) * 2 + 1)) {
            EXPECT_NEAR(sample, 3200, 1);
        }
    }
}

/// Sample by sample, every place limited to the image.
std::vector<std::int16_t> sampled_plainly(const BarPicture& picture, const BarLine& line, int breadth) {
    const int last_x = picture.view().width() - 1;
    const int last_y = picture.view().height() - 1;
    std::vector<std::int16_t> profile;
    for (int i = 0; i < line.samples; ++i) {
        std::int64_t sum = 0;
        for (int k = -(breadth / 2); k <= breadth / 2; ++k) {
            const std::int64_t step_x = line.step.x.raw();
            const std::int64_t step_y = line.step.y.raw();
            const std::int64_t x = clamp<std::int64_t>(line.from.x.raw() + step_x * i - step_y * k, 0,
                                                       std::int64_t{last_x} * 65536);
            const std::int64_t y = clamp<std::int64_t>(line.from.y.raw() + step_y * i + step_x * k, 0,
                                                       std::int64_t{last_y} * 65536);
            const auto pixel = [&](std::int64_t column, std::int64_t row) {
                return std::int64_t{picture.view()(static_cast<int>(minimum<std::int64_t>(column, last_x)),
                                                   static_cast<int>(minimum<std::int64_t>(row, last_y)))};
            };
            const std::int64_t right = x >> 8 & 255;
            const std::int64_t below = y >> 8 & 255;
            const auto mixed = [&](std::int64_t row) {
                return pixel(x >> 16, row) * (256 - right) + pixel((x >> 16) + 1, row) * right;
            };
            sum += (mixed(y >> 16) * (256 - below) + mixed((y >> 16) + 1) * below) >> 12;
        }
        profile.push_back(static_cast<std::int16_t>((sum * (65536 / breadth) + 32768) >> 16));
    }
    return profile;
}

TEST(BarLine, SamplesAsThePlainFormulaDoesWhereverItLies) {
    Random random(8);
    BarPicture picture({60, 45});
    for (int y = 0; y < 45; ++y)
        for (int x = 0; x < 60; ++x) picture.view()(x, y) = static_cast<Gray8>(random.below(256));
    for (int trial = 0; trial < 3000; ++trial) {
        const bool straight = trial % 4 == 0;
        const SubPixelPoint from = at(random.between(0, 59), random.between(0, 44));
        SubPixelPoint to = at(random.between(0, 59), random.between(0, 44));
        if (straight && trial % 8 == 0) to.x = from.x;
        if (straight && trial % 8 != 0) to.y = from.y;
        const BarLine line = bar_line_through({60, 45}, from, to, random.between(0, 20));
        const int breadth = 2 * random.between(0, 3) + 1;
        ASSERT_EQ(sampled(picture, line, breadth), sampled_plainly(picture, line, breadth))
            << trial << ' ' << breadth;
    }
}

}  // namespace
}  // namespace fovea::test
