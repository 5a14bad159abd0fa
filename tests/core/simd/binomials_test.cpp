// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/binomials.hpp>

namespace fovea::test {
namespace {

using simd::Bytes;
constexpr auto lanes = static_cast<std::size_t>(simd::lanes);

TEST(Binomials, WeighTheRowsOfAWindow) {
    Random random(121);
    for (int round = 0; round < 100; ++round) {
        std::uint8_t rows[5][lanes];
        for (auto& row : rows)
            for (std::uint8_t& pixel : row)
                pixel = round == 0 ? 255 : static_cast<std::uint8_t>(random.below(256));
        const auto row = [&](int i) { return Bytes::load(rows[i]); };
        std::uint16_t three[lanes], five[lanes];
        binomial(row(0), row(1), row(2)).store(three);
        binomial(row(0), row(1), row(2), row(3), row(4)).store(five);
        for (std::size_t x = 0; x < lanes; ++x) {
            EXPECT_EQ(three[x], rows[0][x] + 2 * rows[1][x] + rows[2][x]);
            EXPECT_EQ(five[x], rows[0][x] + 4 * rows[1][x] + 6 * rows[2][x] + 4 * rows[3][x] + rows[4][x]);
        }
    }
}

TEST(Binomials, WeighTheColumnsOfALine) {
    Random random(14641);
    constexpr int width = 3 * simd::lanes;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(word_line_scratch(width)));
    simd::WordLine line({scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, width);
    for (int round = 0; round < 100; ++round) {
        // The largest numbers that five rows of pixels make, and any.
        for (int x = -2; x < width + 2; ++x)
            line.set(x, static_cast<std::uint16_t>(round == 0 ? 4080 : random.below(4081)));
        const auto at = [&](int x) { return int{line.value(x)}; };
        for (int x = 0; x < width; x += simd::lanes) {
            std::uint16_t three[lanes], five[lanes];
            binomial_3(line, x, 8).store(three);
            binomial_5(line, x, 128).store(five);
            for (int i = 0; i < simd::lanes; ++i) {
                const int c = x + i;
                EXPECT_EQ(three[i], at(c - 1) + 2 * at(c) + at(c + 1) + 8);
                EXPECT_EQ(five[i], at(c - 2) + 4 * (at(c - 1) + at(c + 1)) + 6 * at(c) + at(c + 2) + 128);
            }
        }
    }
}

}  // namespace
}  // namespace fovea::test
