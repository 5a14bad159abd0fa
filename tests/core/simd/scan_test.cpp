// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/scan.hpp>

namespace fovea::test {
namespace {

TEST(Scan, FindsTheFirstByteThatReachesALevel) {
    const std::uint8_t row[] = {3, 200, 90, 100, 99};
    EXPECT_EQ(simd::find_at_least(row, 0, 5, 100), 1);
    EXPECT_EQ(simd::find_at_least(row, 2, 5, 100), 3);
    EXPECT_EQ(simd::find_at_least(row, 4, 5, 100), 5);
    EXPECT_EQ(simd::find_below(row, 1, 5, 100), 2);
    EXPECT_EQ(simd::find_below(row, 0, 5, 3), 5);
    EXPECT_EQ(simd::find_below(row, 5, 5, 255), 5);
}

TEST(Scan, TellsEveryByteFromEveryLevel) {
    for (int level = 1; level <= 255; ++level)
        for (int byte = 0; byte <= 255; ++byte) {
            // Neighbours that a carry would come from, or spoil.
            std::vector<std::uint8_t> row(24, static_cast<std::uint8_t>(level - 1));
            row[13] = static_cast<std::uint8_t>(byte);
            ASSERT_EQ(simd::find_at_least(row.data(), 0, 24, level), byte >= level ? 13 : 24);
            row.assign(24, 255);
            row[13] = static_cast<std::uint8_t>(byte);
            ASSERT_EQ(simd::find_below(row.data(), 0, 24, level), byte < level ? 13 : 24);
        }
}

TEST(Scan, IsTheLoopOverBytesFromAnyPlace) {
    Random random(2);
    for (int turn = 0; turn < 3000; ++turn) {
        std::vector<std::uint8_t> row(40);
        const std::uint32_t rare = 1 + random.below(40);
        for (std::uint8_t& byte : row)
            byte = static_cast<std::uint8_t>(random.below(rare) == 0 ? random.next() >> 24 : 100);
        const int level = random.between(1, 255);
        const int first = random.between(0, 39);
        const int end = random.between(first, 40);
        int bright = first;
        while (bright < end && row[static_cast<std::size_t>(bright)] < level) ++bright;
        int dark = first;
        while (dark < end && row[static_cast<std::size_t>(dark)] >= level) ++dark;
        ASSERT_EQ(simd::find_at_least(row.data(), first, end, level), bright);
        ASSERT_EQ(simd::find_below(row.data(), first, end, level), dark);
    }
}

}  // namespace
}  // namespace fovea::test
