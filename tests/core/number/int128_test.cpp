// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include <fovea/base/random.hpp>
#include <fovea/number/int128.hpp>

namespace fovea::test {
namespace {

__extension__ using Native = __int128;
__extension__ using Unsigned = unsigned __int128;

Native native(Int128 value) {
    const auto low = static_cast<std::uint64_t>(value.low_word());
    const auto high = static_cast<std::uint64_t>((value >> 64).low_word());
    return static_cast<Native>(static_cast<Unsigned>(high) << 64 | low);
}
/// A 64-bit number of any length, so that small and large ones are equally likely.
std::int64_t any(Random& random) {
    const auto high = static_cast<std::uint64_t>(random.next());
    const auto bits = static_cast<std::int64_t>(high << 32 | random.next());
    const int drop = random.between(0, 63);
    return bits >> drop;
}

TEST(Int128, MultipliesAddsAndShiftsAsTheCompilerDoes) {
    Random random(21);
    for (int i = 0; i < 200000; ++i) {
        const std::int64_t a = any(random);
        const std::int64_t b = any(random);
        const std::int64_t c = any(random);
        const int shift = random.between(0, 127);
        const Int128 product = Int128::product(a, b);
        const Native expected = static_cast<Native>(a) * b;
        ASSERT_EQ(native(product), expected);
        ASSERT_EQ(native(Int128::product_in_words(a, b)), expected);
        ASSERT_EQ(native(product + Int128(c)), expected + c);
        ASSERT_EQ(native(product - Int128(c)), expected - c);
        ASSERT_EQ(native(-product), -expected);
        const std::int64_t small = c >> 40;
        ASSERT_EQ(native((product >> 24) * small), (expected >> 24) * small);
        ASSERT_EQ(native(product >> shift), expected >> shift);
        ASSERT_EQ(native(product << shift), static_cast<Native>(static_cast<Unsigned>(expected) << shift));
        ASSERT_EQ(product < Int128(c), expected < c);
        ASSERT_EQ(product.fits_int64(), expected == static_cast<std::int64_t>(expected));
    }
}

TEST(Int128, ProductTakesTheMostNegativeNumber) {
    EXPECT_EQ(native(Int128::product(INT64_MIN, INT64_MIN)), static_cast<Native>(1) << 126);
    EXPECT_EQ(native(Int128::product(INT64_MIN, 1)), static_cast<Native>(INT64_MIN));
    EXPECT_EQ(native(Int128::product_in_words(INT64_MIN, INT64_MIN)), static_cast<Native>(1) << 126);
    EXPECT_EQ(native(Int128::product_in_words(INT64_MIN, 1)), static_cast<Native>(INT64_MIN));
}

TEST(Hypotenuse, IsTheLengthRoundedDown) {
    EXPECT_EQ(hypotenuse(3, -4), 5);
    EXPECT_EQ(hypotenuse(0, 0), 0);
    EXPECT_EQ(hypotenuse(1, 1), 1);
    EXPECT_EQ(hypotenuse(-(std::int64_t{1} << 61), 0), std::int64_t{1} << 61);
    Random random(23);
    for (int i = 0; i < 100000; ++i) {
        const std::int64_t x = any(random) >> 2;
        const std::int64_t y = any(random) >> 2;
        const long double length =
            std::sqrt(static_cast<long double>(x) * x + static_cast<long double>(y) * y);
        const long double found = hypotenuse(x, y);
        ASSERT_LE(found, length);
        ASSERT_GE(found, length - 1 - length / (1 << 28)) << x << " " << y;
    }
}

TEST(RoundDivide, RoundsToTheNearestWithTiesTowardPlusInfinity) {
    EXPECT_EQ(multiply_divide(5, 1, 2), 3);
    EXPECT_EQ(multiply_divide(-5, 1, 2), -2);
    EXPECT_EQ(multiply_divide(5, 1, -2), -2);
    EXPECT_EQ(multiply_divide(-7, 1, 4), -2);
    EXPECT_EQ(multiply_divide(0, 12, 7), 0);
    EXPECT_EQ(multiply_divide(1, 1, 1000), 0);
}

TEST(RoundDivide, EqualsTheCompilersDivisionAndHoldsAtTheEnds) {
    Random random(22);
    for (int i = 0; i < 200000; ++i) {
        const Int128 value = Int128::product(any(random), any(random) >> 1);
        const Int128 divisor =
            i % 2 == 0 ? Int128(any(random)) : Int128::product(any(random), any(random) >> 1);
        if (divisor == Int128(0)) continue;
        const Native n = native(value);
        const Native d = native(divisor);
        Native quotient = n / d;
        Native rest = n % d;
        if (rest != 0 && (rest < 0) != (d < 0)) {
            --quotient;
            rest += d;
        }
        // floor and a rest with the sign of d: up when twice the rest reaches d.
        if ((d > 0 && 2 * rest >= d) || (d < 0 && 2 * rest <= d)) ++quotient;
        if (quotient > INT64_MAX) quotient = INT64_MAX;
        if (quotient < INT64_MIN) quotient = INT64_MIN;
        ASSERT_EQ(round_divide(value, divisor), static_cast<std::int64_t>(quotient)) << i;
    }
    EXPECT_EQ(round_divide(Int128::product(INT64_MAX, 4), Int128(2)), INT64_MAX);
    EXPECT_EQ(round_divide(Int128::product(INT64_MAX, -4), Int128(2)), INT64_MIN);
}

}  // namespace
}  // namespace fovea::test
