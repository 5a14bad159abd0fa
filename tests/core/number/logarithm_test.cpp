// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/number/logarithm.hpp>
#include <support/scalars.hpp>

namespace fovea::test {
namespace {

std::int64_t any(Random& random) {
    const auto high = static_cast<std::uint64_t>(random.next());
    return static_cast<std::int64_t>(high << 32 | random.next()) >> random.between(0, 63);
}

TEST(Log2, IsThatOfTheReference) {
    EXPECT_EQ(*log2_of(Real::from_int(1)), Log2::from_int(0));
    EXPECT_EQ(*log2_of(Real::from_int(-8)), Log2::from_int(3));
    EXPECT_EQ(*log2_of(Real::from_ratio(1, 1024)), Log2::from_int(-10));
    EXPECT_EQ(log2_of(Real()).status(), Status::degenerate);
    Random random(74);
    for (int i = 0; i < 100000; ++i) {
        const Real a = Real::from_int(any(random) | 1) / Real::from_int(any(random) | 1);
        const long double real = std::log2(std::abs(value_of(a)));
        ASSERT_LE(std::abs(static_cast<long double>(log2_of(a)->raw()) - real * 65536), 0.51L);
    }
}

TEST(Log2, IsHeldAtItsEnds) {
    constexpr std::int32_t largest = 0x7fffffff, smallest = -largest - 1;
    EXPECT_EQ(log2_of(Real::from_int(1, 32767))->raw(), 32767 * 65536);
    EXPECT_EQ(log2_of(Real::from_int(1, 32768))->raw(), largest);
    EXPECT_EQ(log2_of(Real::from_int(1, 1000000))->raw(), largest);
    EXPECT_EQ(log2_of(Real::from_int(1, -32768))->raw(), smallest);
    EXPECT_EQ(log2_of(Real::from_int(1, -32769))->raw(), smallest);
    EXPECT_EQ(log2_of(Real::from_int(1, -1000000))->raw(), smallest);
    // Just below a power of two, where every square passes 2.
    EXPECT_EQ(*log2_of(Real::from_int(0x7fffffffffffffff, -63)), Log2::from_int(0));
}

}  // namespace
}  // namespace fovea::test
