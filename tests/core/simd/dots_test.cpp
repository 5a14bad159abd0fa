// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include <fovea/base/random.hpp>
#include <fovea/simd/dots.hpp>

namespace fovea::test {
namespace {

constexpr int values = simd::lanes / 2;

simd::RawWords raw(const std::uint16_t (&from)[values]) {
    simd::RawWords words;
    std::memcpy(&words, from, sizeof words);
    return words;
}

TEST(Dots, PairProductsAddUpNeighbours) {
    Random random(651);
    for (int round = 0; round < 100; ++round) {
        std::uint16_t a[values];
        std::uint16_t b[values];
        for (int i = 0; i < values; ++i) {
            a[i] = round == 0 ? 32767 : static_cast<std::uint16_t>(random.next() >> 17);
            b[i] = round == 0 ? 32767 : static_cast<std::uint16_t>(random.next() >> 17);
        }
        std::uint32_t sums[simd::sum_lanes];
        const simd::RawSums made = simd::pair_products(raw(a), raw(b));
        std::memcpy(sums, &made, sizeof sums);
        for (int i = 0; i < simd::sum_lanes; ++i)
            ASSERT_EQ(sums[i],
                      std::uint32_t{a[2 * i]} * b[2 * i] + std::uint32_t{a[2 * i + 1]} * b[2 * i + 1]);
    }
}

TEST(Dots, TotalsAreThoseOfEachVector) {
    Random random(652);
    simd::RawSums sums[4];
    std::uint32_t expected[4] = {};
    for (int k = 0; k < 4; ++k) {
        std::uint32_t lanes_of[simd::sum_lanes];
        for (std::uint32_t& value : lanes_of) expected[k] += value = random.next();
        std::memcpy(&sums[k], lanes_of, sizeof lanes_of);
    }
    std::uint32_t totals[4];
    simd::totals_of(sums[0], sums[1], sums[2], sums[3], totals);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(totals[k], expected[k]);
}

TEST(Dots, BlendsTheHalvesOfAWord) {
    Random random(653);
    for (std::uint32_t weight = 0; weight <= 256; ++weight)
        for (int round = 0; round < 100; ++round) {
            const std::uint32_t halves = round == 0 ? 0xffffffffu : round == 1 ? 0x80007fffu : random.next();
            const std::uint64_t sum =
                std::uint64_t{halves & 0xffff} * (256 - weight) + std::uint64_t{halves >> 16} * weight;
            ASSERT_EQ(simd::blend_halves(halves, (256 - weight) | weight << 16), (sum + (1 << 15)) >> 16);
        }
}

}  // namespace
}  // namespace fovea::test
