// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/short_sums.hpp>

namespace fovea::test {
namespace {

TEST(ShortSums, AddTheBytesOfEachStretch) {
    const std::uint8_t row[] = {1, 2, 4, 8, 16, 32, 64, 128, 255};
    std::uint32_t sums[] = {1000, 0, 0, 7};
    simd::add_stretches(row, 9, 4, sums);
    EXPECT_EQ(sums[0], 1015u);
    EXPECT_EQ(sums[1], 240u);
    EXPECT_EQ(sums[2], 255u) << "the last is shorter";
    EXPECT_EQ(sums[3], 7u) << "there is no fourth";
}

TEST(ShortSums, OfTheBrightestBytesFit) {
    alignas(8) std::uint8_t row[2 * simd::most_stretch];
    for (std::uint8_t& byte : row) byte = 255;
    for (int stretch = 1; stretch <= simd::most_stretch; ++stretch) {
        std::uint32_t sums[2] = {};
        simd::add_stretches(row, 2 * stretch, stretch, sums);
        EXPECT_EQ(sums[0], 255u * static_cast<unsigned>(stretch));
        EXPECT_EQ(sums[1], sums[0]);
    }
}

TEST(ShortSums, AreTheLoopOverBytesFromAnyPlace) {
    Random random(3);
    std::vector<std::uint8_t> row(400);
    for (int turn = 0; turn < 2000; ++turn) {
        for (std::uint8_t& byte : row) byte = static_cast<std::uint8_t>(random.next() >> 24);
        const int first = random.between(0, 8);
        const int width = random.between(0, 390);
        const int stretch = turn % 2 == 0 ? 4 << random.between(0, 6) : random.between(1, simd::most_stretch);
        const auto count = static_cast<std::size_t>((width + stretch - 1) / stretch);
        std::vector<std::uint32_t> expected(count, 5), sums = expected;
        for (int i = 0; i < width; ++i)
            expected[static_cast<std::size_t>(i / stretch)] += row[static_cast<std::size_t>(first + i)];
        simd::add_stretches(row.data() + first, width, stretch, sums.data());
        ASSERT_EQ(sums, expected);
    }
}

}  // namespace
}  // namespace fovea::test
