// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <utility>

#include <fovea/base/random.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/products.hpp>

namespace fovea::test {
namespace {

#if FOVEA_BYTES >= 16

constexpr int places = simd::places;

/// Numbers of all sizes, among them the largest and 0.
std::uint32_t number(Random& random) { return random.next() >> random.below(32); }

TEST(LowProducts, AreWholeAndIgnoreTheUpperHalves) {
    Random random(41);
    for (int run = 0; run < 1000; ++run) {
        std::uint64_t a[places / 2];
        std::uint64_t b[places / 2];
        for (int i = 0; i < places / 2; ++i) {
            a[i] = run == 0 ? ~std::uint64_t{0} : std::uint64_t{random.next()} << 32 | number(random);
            b[i] = run == 0 ? ~std::uint64_t{0} : std::uint64_t{random.next()} << 32 | number(random);
        }
        simd::Longs x;
        simd::Longs y;
        std::memcpy(&x, a, sizeof x);
        std::memcpy(&y, b, sizeof y);
        const simd::Longs product = simd::low_products(x, y);
        for (int i = 0; i < places / 2; ++i)
            ASSERT_EQ(product[i], (a[i] & 0xffffffffu) * (b[i] & 0xffffffffu)) << i;
    }
}

TEST(Halves, AreTheTwoLanesInEachLaneOf64Bits) {
    Random random(42);
    simd::Unsigned lanes{};
    for (int i = 0; i < places; ++i) lanes[i] = random.next();
    const simd::Longs low = simd::low_halves(lanes);
    const simd::Longs high = simd::high_halves(lanes);
    constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    for (int i = 0; i < places / 2; ++i) {
        EXPECT_EQ(low[i] & 0xffffffffu, lanes[2 * i + (big_endian ? 1 : 0)]);
        EXPECT_EQ(high[i], lanes[2 * i + (big_endian ? 0 : 1)]);
    }
}

TEST(HeldPairs, HoldBothAndKeepTheirLanes) {
    Random random(43);
    for (int run = 0; run < 1000; ++run) {
        simd::Ints low{};
        simd::Ints high{};
        for (int i = 0; i < places; ++i) {
            low[i] = static_cast<std::int32_t>(number(random));
            high[i] = -static_cast<std::int32_t>(number(random) >> 1);
        }
        if (run % 2 == 1) std::swap(low, high);
        const auto pairs = simd::bits_as<simd::Unsigned>(simd::held_pairs(low, high));
        for (int i = 0; i < places; ++i) {
            const auto held = [](std::int32_t value) {
                return static_cast<std::uint32_t>(clamp<std::int32_t>(value, -32768, 32767)) & 0xffffu;
            };
            ASSERT_EQ(pairs[i], held(low[i]) | held(high[i]) << 16) << i;
        }
    }
}

#endif

}  // namespace
}  // namespace fovea::test
