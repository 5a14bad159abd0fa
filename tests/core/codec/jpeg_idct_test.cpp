// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <core/codec/jpeg_file.hpp>
#include <fovea/base/random.hpp>
#include <fovea/codec/jpeg_idct.hpp>

namespace fovea::test {
namespace {

jpeg::Block block_of(const std::vector<double>& coefficients) {
    jpeg::Block block{};
    for (int i = 0; i < 64; ++i) {
        block.coefficient[i] = static_cast<std::int16_t>(coefficients[static_cast<std::size_t>(i)]);
        if (block.coefficient[i] != 0) block.used |= i;
    }
    return block;
}

TEST(InverseDct, OfNothingIsMiddleGray) {
    const jpeg::Block block{};
    std::uint8_t samples[64];
    inverse_dct(block, samples, 8);
    for (const std::uint8_t sample : samples) EXPECT_EQ(sample, 128);
}

TEST(InverseDct, OfTheMeanAloneIsFlatAndRounded) {
    for (int mean = jpeg::Block::least; mean <= jpeg::Block::most; ++mean) {
        jpeg::Block block{};
        block.coefficient[0] = static_cast<std::int16_t>(mean);
        std::uint8_t samples[64];
        inverse_dct(block, samples, 8);
        const int expected = std::clamp(static_cast<int>(std::floor(mean / 8.0 + 0.5)) + 128, 0, 255);
        for (const std::uint8_t sample : samples) ASSERT_EQ(sample, expected) << mean;
    }
}

TEST(InverseDct, OfOneHorizontalWaveWorkedByHand) {
    // 100 / 4 * sqrt(1/2) * cos((2 x + 1) pi / 16) = 17.68 * (0.981, 0.831, 0.556, 0.195, ...) for all rows.
    jpeg::Block block{};
    block.coefficient[1] = 100;
    block.used = 1;
    std::uint8_t samples[64];
    inverse_dct(block, samples, 8);
    const int expected[8] = {128 + 17, 128 + 15, 128 + 10, 128 + 3, 128 - 3, 128 - 10, 128 - 15, 128 - 17};
    for (int i = 0; i < 64; ++i) EXPECT_EQ(samples[i], expected[i % 8]);
}

TEST(InverseDct, PutsRowsAStrideApartAndNothingBetween) {
    jpeg::Block block{};
    block.coefficient[8] = -300;
    block.used = 8;
    std::uint8_t dense[64];
    inverse_dct(block, dense, 8);
    std::vector<std::uint8_t> wide(8 * 13, 77);
    inverse_dct(block, wide.data(), 13);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 13; ++x)
            EXPECT_EQ(wide[static_cast<std::size_t>(13 * y + x)], x < 8 ? dense[8 * y + x] : 77);
}

TEST(InverseDct, GivesTheSameBitsWhicheverCoefficientsAreSaidToBeUsed) {
    // A shorter way is taken when half of the rows or columns are 0; all used must give the same.
    Random random(41);
    for (int round = 0; round < 4000; ++round) {
        const int rows = random.between(1, 8);
        const int columns = random.between(1, 8);
        jpeg::Block block{};
        for (int v = 0; v < rows; ++v)
            for (int u = 0; u < columns; ++u) {
                block.coefficient[8 * v + u] = static_cast<std::int16_t>(random.between(-400, 400));
                if (block.coefficient[8 * v + u] != 0) block.used |= 8 * v + u;
            }
        std::uint8_t some[64];
        std::uint8_t all[64];
        inverse_dct(block, some, 8);
        block.used = 63;
        inverse_dct(block, all, 8);
        for (int i = 0; i < 64; ++i) ASSERT_EQ(some[i], all[i]) << rows << " rows, " << columns << " columns";
    }
}

TEST(InverseDct, SurvivesTheLargestCoefficients) {
    Random random(42);
    for (int round = 0; round < 2000; ++round) {
        jpeg::Block block{};
        block.used = 63;
        for (std::int16_t& coefficient : block.coefficient)
            coefficient =
                static_cast<std::int16_t>(random.below(2) == 0 ? jpeg::Block::least : jpeg::Block::most);
        std::uint8_t samples[64];
        inverse_dct(block, samples, 8);
    }
}

/// IEEE 1180-1990 section 3: random samples, transformed with real numbers and rounded, then back both ways.
/// Ours are held at 0..255 after adding 128, so the reference is held there too.
void check_accuracy(int low, int high, int sign, int rounds) {
    Random random(1180);
    std::vector<double> error(64), square(64);
    int peak = 0;
    for (int round = 0; round < rounds; ++round) {
        std::vector<double> samples(64);
        for (double& sample : samples) sample = sign * random.between(low, high);
        std::vector<double> coefficients = naive_forward(samples);
        for (double& c : coefficients)
            c = std::clamp(std::round(c), double{jpeg::Block::least}, double{jpeg::Block::most});
        const std::vector<double> expected = naive_inverse(coefficients);
        std::uint8_t actual[64];
        inverse_dct(block_of(coefficients), actual, 8);
        for (std::size_t i = 0; i < 64; ++i) {
            const int rounded = std::clamp(static_cast<int>(std::floor(expected[i] + 0.5)) + 128, 0, 255);
            const int difference = actual[i] - rounded;
            peak = std::max(peak, std::abs(difference));
            error[i] += difference;
            square[i] += difference * difference;
        }
    }
    double error_sum = 0, square_sum = 0, worst_error = 0, worst_square = 0;
    for (std::size_t i = 0; i < 64; ++i) {
        error_sum += error[i] / rounds;
        square_sum += square[i] / rounds;
        worst_error = std::max(worst_error, std::abs(error[i] / rounds));
        worst_square = std::max(worst_square, square[i] / rounds);
    }
    SCOPED_TRACE(testing::Message() << low << ".." << high << " times " << sign);
    EXPECT_LE(peak, 1);
    EXPECT_LE(worst_square, 0.06);
    EXPECT_LE(square_sum / 64, 0.02);
    EXPECT_LE(worst_error, 0.015);
    EXPECT_LE(std::abs(error_sum / 64), 0.0015);
}

TEST(InverseDct, IsAsAccurateAsIeee1180Asks) {
    for (const int sign : {1, -1}) {
        check_accuracy(-256, 255, sign, 10000);
        check_accuracy(-5, 5, sign, 10000);
        check_accuracy(-300, 300, sign, 10000);
        check_accuracy(-128, 127, sign, 10000);
    }
}

}  // namespace
}  // namespace fovea::test
