// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/simd/table_blend.hpp>

namespace fovea::test {
namespace {

TEST(TableBlend, WeighsTheFourEntriesOfEveryByte) {
    Random random(654);
    std::uint8_t tables[4][256];  // above left, above right, below left, below right
    for (auto& table : tables)
        for (std::uint8_t& entry : table) entry = static_cast<std::uint8_t>(random.next() >> 9);
    tables[0][7] = tables[1][7] = tables[2][7] = tables[3][7] = 255;
    tables[0][8] = tables[1][8] = tables[2][8] = tables[3][8] = 0;
    simd::TableBlend joined;
    joined.join(tables[0], tables[2], 256);
    for (std::size_t count = 0; count <= 40; ++count)
        for (const std::uint32_t lower : {0u, 1u, 100u, 256u}) {
            std::vector<std::uint8_t> row(count);
            std::vector<std::uint16_t> weights(count);
            std::vector<std::uint8_t> expected;
            for (std::size_t x = 0; x < count; ++x) {
                const auto level = static_cast<std::uint8_t>(x < 2 ? 7 + x : random.next() >> 13);
                const std::uint32_t weight = random.below(257);
                const std::uint32_t above = tables[0][level] * (256 - weight) + tables[1][level] * weight;
                const std::uint32_t below = tables[2][level] * (256 - weight) + tables[3][level] * weight;
                expected.push_back(
                    static_cast<std::uint8_t>((above * (256 - lower) + below * lower + (1 << 15)) >> 16));
                row[x] = level;
                weights[x] = static_cast<std::uint16_t>(weight);
            }
            simd::blend_row(row.data(), weights.data(), static_cast<int>(count), joined, lower, row.data());
            ASSERT_EQ(row, expected) << count << " pixels, " << lower << " of the lower tables";
        }
}

TEST(TableBlend, OfOneTableGivesItsEntries) {
    std::uint8_t table[256];
    for (int i = 0; i < 256; ++i) table[i] = static_cast<std::uint8_t>(255 - i);
    simd::TableBlend joined;
    joined.join(table, table, 0);
    std::uint8_t row[256];
    std::uint16_t weights[256];
    for (int i = 0; i < 256; ++i) row[i] = static_cast<std::uint8_t>(i);
    for (int i = 0; i < 256; ++i) weights[i] = static_cast<std::uint16_t>(i);
    simd::blend_row(row, weights, 256, joined, 77, row);
    for (int i = 0; i < 256; ++i) EXPECT_EQ(row[i], 255 - i);
}

}  // namespace
}  // namespace fovea::test
