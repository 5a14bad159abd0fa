// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/jpeg_colour.hpp>

namespace fovea::test {
namespace {

using Row = std::vector<std::uint8_t>;

Row random_row(Random& random, int width) {
    Row row(static_cast<std::size_t>(width));
    for (std::uint8_t& sample : row) sample = static_cast<std::uint8_t>(random.next());
    return row;
}
int at(const Row& row, int i) {
    return row[static_cast<std::size_t>(std::clamp(i, 0, static_cast<int>(row.size()) - 1))];
}

TEST(UpsampleAcross, WeighsThreeToOneWorkedByHand) {
    const Row src = {0, 100, 40};
    Row dst(6);
    jpeg::upsample_across(src.data(), 3, dst.data());
    // 0, (0 * 3 + 100 + 2) / 4, (300 + 0 + 1) / 4, (300 + 40 + 2) / 4, (120 + 100 + 1) / 4, 40
    EXPECT_EQ(dst, (Row{0, 25, 75, 85, 55, 40}));
}

TEST(UpsampleAcross, EqualsTheFormulaAtEveryWidth) {
    Random random(45);
    for (int width = 1; width <= 70; ++width) {
        const Row src = random_row(random, width);
        Row dst(static_cast<std::size_t>(2 * width + 1), 77);
        jpeg::upsample_across(src.data(), width, dst.data());
        for (int i = 0; i < width; ++i) {
            const int left = width <= 2 ? at(src, i) : at(src, i - 1);
            const int right = width <= 2 ? at(src, i) : at(src, i + 1);
            ASSERT_EQ(at(dst, 2 * i), (3 * at(src, i) + left + 1) / 4) << width;
            ASSERT_EQ(at(dst, 2 * i + 1), (3 * at(src, i) + right + 2) / 4) << width;
        }
        EXPECT_EQ(dst.back(), 77);
    }
}

TEST(UpsampleDown, EqualsTheFormulaOnBothSides) {
    Random random(46);
    for (int width = 1; width <= 70; ++width) {
        const Row nearer = random_row(random, width);
        const Row farther = random_row(random, width);
        for (const auto side : {jpeg::Farther::above, jpeg::Farther::below}) {
            Row dst(static_cast<std::size_t>(width + 1), 77);
            jpeg::upsample_down(nearer.data(), farther.data(), side, width, dst.data());
            const int half = side == jpeg::Farther::above ? 1 : 2;
            for (int i = 0; i < width; ++i)
                ASSERT_EQ(at(dst, i), (3 * at(nearer, i) + at(farther, i) + half) / 4);
            EXPECT_EQ(dst.back(), 77);
        }
    }
}

TEST(UpsampleBoth, EqualsTheFormulaAtEveryWidth) {
    Random random(47);
    for (int width = 1; width <= 70; ++width) {
        const Row nearer = random_row(random, width);
        const Row farther = random_row(random, width);
        Row dst(static_cast<std::size_t>(2 * width + 1), 77);
        jpeg::upsample_both(nearer.data(), farther.data(), width, dst.data());
        const auto sum = [&](int i) { return 3 * at(nearer, i) + at(farther, i); };
        for (int i = 0; i < width; ++i) {
            const int left = width <= 2 ? at(nearer, i) : (3 * sum(i) + sum(i - 1) + 8) / 16;
            const int right = width <= 2 ? at(nearer, i) : (3 * sum(i) + sum(i + 1) + 7) / 16;
            ASSERT_EQ(at(dst, 2 * i), left) << width;
            ASSERT_EQ(at(dst, 2 * i + 1), right) << width;
        }
        EXPECT_EQ(dst.back(), 77);
    }
}

TEST(ColourRow, TurnsPrimariesIntoThemselves) {
    // T.871: Y, Cb, Cr of black, white, and of red, green and blue, each rounded.
    const Row luma = {0, 255, 76, 150, 29};
    const Row blue = {128, 128, 85, 44, 255};
    const Row red = {128, 128, 255, 21, 107};
    std::vector<Rgb888> dst(5);
    jpeg::colour_row(luma.data(), blue.data(), red.data(), 5, dst.data());
    const std::vector<Rgb888> expected = {{0, 0, 0}, {255, 255, 255}, {254, 0, 0}, {0, 255, 1}, {0, 0, 254}};
    EXPECT_EQ(dst, expected);
}

TEST(ColourRow, EqualsRealArithmeticForEveryColour) {
    // The factors are rounded to 1/65536, an error of at most 128 / 131072 a factor: 0.002 for two. Only a
    // sum that close to a half may be rounded to the other side.
    const auto check = [](int actual, double exact) {
        const double lowest = std::clamp(std::floor(exact - 0.002 + 0.5), 0.0, 255.0);
        const double highest = std::clamp(std::floor(exact + 0.002 + 0.5), 0.0, 255.0);
        return actual >= lowest && actual <= highest;
    };
    Row luma(256), blue(256), red(256);
    std::vector<Rgb888> dst(256);
    for (int y = 0; y < 256; ++y) luma[static_cast<std::size_t>(y)] = static_cast<std::uint8_t>(y);
    for (int b = 0; b < 256; ++b)
        for (int r = 0; r < 256; ++r) {
            std::fill(blue.begin(), blue.end(), static_cast<std::uint8_t>(b));
            std::fill(red.begin(), red.end(), static_cast<std::uint8_t>(r));
            jpeg::colour_row(luma.data(), blue.data(), red.data(), 256, dst.data());
            for (int y = 0; y < 256; ++y) {
                const Rgb888 colour = dst[static_cast<std::size_t>(y)];
                ASSERT_TRUE(check(colour.red, y + 1.402 * (r - 128))) << y << " " << b << " " << r;
                ASSERT_TRUE(check(colour.green, y - 0.344136 * (b - 128) - 0.714136 * (r - 128)))
                    << y << " " << b << " " << r;
                ASSERT_TRUE(check(colour.blue, y + 1.772 * (b - 128))) << y << " " << b << " " << r;
            }
        }
}

TEST(ColourRow, GivesTheSameColourInAndBehindAChunk) {
    Random random(48);
    const Row luma = random_row(random, 100), blue = random_row(random, 100), red = random_row(random, 100);
    std::vector<Rgb888> whole(100);
    jpeg::colour_row(luma.data(), blue.data(), red.data(), 100, whole.data());
    for (int width = 0; width <= 100; ++width) {
        std::vector<Rgb888> dst(101, Rgb888{7, 7, 7});
        jpeg::colour_row(luma.data(), blue.data(), red.data(), width, dst.data());
        for (std::size_t x = 0; x <= 100; ++x)
            ASSERT_EQ(dst[x], x < static_cast<std::size_t>(width) ? whole[x] : (Rgb888{7, 7, 7}));
    }
}

}  // namespace
}  // namespace fovea::test
