// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/simd/bits.hpp>

namespace fovea::test {
namespace {

TEST(Bits, AreThoseOfTheBytes) {
    Random random(661);
    for (int round = 0; round < 2000; ++round) {
        std::uint8_t bytes[32];
        for (std::uint8_t& byte : bytes)
            byte = static_cast<std::uint8_t>(round % 2 == 0 ? random.next() >> 24 : random.below(2) * 255);
        const auto level = static_cast<std::uint8_t>(round < 256 ? round : random.between(0, 255));
        std::uint32_t expected = 0;
        for (int i = 0; i < 32; ++i) expected |= (bytes[i] >= level ? 1u : 0u) << i;
        ASSERT_EQ(simd::bits_at_least(bytes, level), expected);
        std::uint8_t spread[32];
        simd::spread_bits(expected, spread);
        for (int i = 0; i < 32; ++i) ASSERT_EQ(spread[i], bytes[i] >= level ? 255 : 0);
    }
}

}  // namespace
}  // namespace fovea::test
