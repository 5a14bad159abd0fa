// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/column_sums.hpp>

namespace fovea::test {
namespace {

TEST(ColumnSums, GainTheLastRowAndLoseTheFirst) {
    Random random(657);
    for (std::size_t width = 0; width <= 40; ++width) {
        std::vector<std::uint8_t> first(width), last(width);
        std::vector<std::uint16_t> remaining(width), sums(width), expected_sums, expected_remaining;
        for (std::size_t x = 0; x < width; ++x) {
            first[x] = static_cast<std::uint8_t>(x == 0 ? 255 : random.next() >> 9);
            last[x] = static_cast<std::uint8_t>(random.next() >> 9);
            // The first row is in the sums.
            remaining[x] = static_cast<std::uint16_t>(first[x] + random.below(15000));
            expected_sums.push_back(static_cast<std::uint16_t>(remaining[x] + last[x]));
            expected_remaining.push_back(static_cast<std::uint16_t>(expected_sums.back() - first[x]));
        }
        simd::sum_columns(first.data(), last.data(), static_cast<int>(width), remaining.data(), sums.data());
        ASSERT_EQ(sums, expected_sums);
        ASSERT_EQ(remaining, expected_remaining);
    }
}

TEST(ColumnSums, MeansRunAlongTheRow) {
    Random random(658);
    for (const int side : {3, 9, 63})
        for (std::size_t width = 0; width <= 40; ++width) {
            const auto columns = static_cast<std::size_t>(side);
            const auto most = 255 * static_cast<std::uint32_t>(side);
            const auto area = static_cast<std::uint32_t>(side * side);
            std::vector<std::uint16_t> sums(width + columns + 1);
            for (std::uint16_t& sum : sums)
                sum = static_cast<std::uint16_t>(random.below(3) == 0 ? most : random.below(most + 1));
            std::vector<std::uint8_t> expected;
            for (std::size_t x = 0; x < width; ++x) {
                std::uint32_t sum = area / 2;
                for (std::size_t i = 1; i <= columns; ++i) sum += sums[x + i];
                expected.push_back(static_cast<std::uint8_t>(sum / area));
            }
            // What the window holds before the first column enters.
            std::uint32_t before = area / 2;
            for (std::size_t i = 0; i < columns; ++i) before += sums[i];
            std::vector<std::uint8_t> dst(width);
            simd::running_means(sums.data() + columns, sums.data(), static_cast<int>(width), before,
                                0xffffffffu / area + 1, dst.data());
            ASSERT_EQ(dst, expected) << side;
        }
}

}  // namespace
}  // namespace fovea::test
