// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include <fovea/base/random.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::test {
namespace {

__extension__ using Native = __int128;

/// A 64-bit number of any length, so that small and large ones are equally likely.
std::int64_t any(Random& random) {
    const auto high = static_cast<std::uint64_t>(random.next());
    const auto bits = static_cast<std::int64_t>(high << 32 | random.next());
    return bits >> random.between(0, 63);
}

Native slow_floor_divide(Native value, Native divisor) {
    Native quotient = value / divisor;
    while (quotient * divisor > value) --quotient;
    while ((quotient + 1) * divisor <= value) ++quotient;
    return quotient;
}
/// floor(value / divisor + 1/2): the nearest, ties toward plus infinity.
Native slow_round_divide(Native value, Native divisor) {
    return slow_floor_divide(2 * value + divisor, 2 * divisor);
}

TEST(Integer, HoldsBetweenTwoEnds) {
    EXPECT_EQ(minimum(3, -4), -4);
    EXPECT_EQ(maximum(3, -4), 3);
    EXPECT_EQ(clamp(5, 0, 9), 5);
    EXPECT_EQ(clamp(-5, 0, 9), 0);
    EXPECT_EQ(clamp(50, 0, 9), 9);
    EXPECT_EQ(clamp(0, 0, 0), 0);
}

TEST(Magnitude, TakesTheMostNegativeNumber) {
    EXPECT_EQ(magnitude(std::int32_t{-7}), 7u);
    EXPECT_EQ(magnitude(std::int32_t{7}), 7u);
    EXPECT_EQ(magnitude(INT32_MIN), 0x80000000u);
    EXPECT_EQ(magnitude(std::int64_t{0}), 0u);
    EXPECT_EQ(magnitude(INT64_MAX), std::uint64_t{INT64_MAX});
    EXPECT_EQ(magnitude(INT64_MIN), std::uint64_t{1} << 63);
}

template <class To, class From>
void expect_saturated(From value) {
    const Native low = std::numeric_limits<To>::min();
    const Native high = std::numeric_limits<To>::max();
    const Native expected = value < low ? low : value > high ? high : Native{value};
    ASSERT_EQ(Native{saturate_cast<To>(value)}, expected) << static_cast<long long>(value);
}
template <class From>
void expect_saturated_everywhere(From value) {
    expect_saturated<std::int8_t>(value);
    expect_saturated<std::uint8_t>(value);
    expect_saturated<std::int16_t>(value);
    expect_saturated<std::uint16_t>(value);
    expect_saturated<std::int32_t>(value);
    expect_saturated<std::uint32_t>(value);
    expect_saturated<std::int64_t>(value);
}

TEST(SaturateCast, HoldsAtTheEndsOfEveryType) {
    for (int bits = 0; bits < 64; ++bits)
        for (std::int64_t off = -2; off <= 2; ++off) {
            const auto value =
                static_cast<std::int64_t>((std::uint64_t{1} << bits) + static_cast<std::uint64_t>(off));
            expect_saturated_everywhere(value);
            expect_saturated_everywhere(static_cast<std::int64_t>(0u - static_cast<std::uint64_t>(value)));
            expect_saturated_everywhere(static_cast<std::uint32_t>(value));
            expect_saturated_everywhere(static_cast<std::int32_t>(value));
            expect_saturated_everywhere(static_cast<std::uint16_t>(value));
        }
    EXPECT_EQ(saturate_cast<std::uint8_t>(-1), 0);
    EXPECT_EQ(saturate_cast<std::uint8_t>(256), 255);
    EXPECT_EQ(saturate_cast<std::int16_t>(UINT32_MAX), 32767);
}

TEST(RoundShift, RoundsToTheNearestWithTiesTowardPlusInfinity) {
    EXPECT_EQ(round_shift(5, 1), 3);
    EXPECT_EQ(round_shift(-5, 1), -2);
    EXPECT_EQ(round_shift(-6, 2), -1);
    EXPECT_EQ(round_shift(-7, 2), -2);
    EXPECT_EQ(round_shift(7, 0), 7);
    EXPECT_EQ(round_shift(INT32_MIN, 31), -1);
    EXPECT_EQ(round_shift(std::uint32_t{6}, 2), 2u);
}

TEST(RoundShift, EqualsTheDivisionByAPowerOfTwo) {
    for (int value = -300; value <= 300; ++value)
        for (int bits = 0; bits <= 10; ++bits)
            ASSERT_EQ(Native{round_shift(value, bits)}, slow_round_divide(value, 1 << bits))
                << value << " " << bits;
    Random random(51);
    for (int i = 0; i < 100000; ++i) {
        const int bits = random.between(1, 62);
        const std::int64_t value = any(random);
        if (value > INT64_MAX - (std::int64_t{1} << (bits - 1))) continue;  // the contract
        ASSERT_EQ(Native{round_shift(value, bits)}, slow_round_divide(value, Native{1} << bits)) << value;
    }
}

TEST(FloorDivide, GoesTowardMinusInfinity) {
    EXPECT_EQ(floor_divide(7, 2), 3);
    EXPECT_EQ(floor_divide(-7, 2), -4);
    EXPECT_EQ(floor_divide(-8, 2), -4);
    EXPECT_EQ(floor_divide(-1, 1000), -1);
    EXPECT_EQ(floor_divide(INT64_MIN, std::int64_t{1}), INT64_MIN);
    EXPECT_EQ(floor_divide(INT64_MIN, INT64_MAX), -2);
}

TEST(RoundDivide, GoesToTheNearestWithTiesTowardPlusInfinityInEveryType) {
    EXPECT_EQ(round_divide(5, 2), 3);
    EXPECT_EQ(round_divide(-5, 2), -2);
    EXPECT_EQ(round_divide(-7, 4), -2);
    EXPECT_EQ(round_divide(std::uint32_t{5}, std::uint32_t{2}), 3u);
    for (int value = -200; value <= 200; ++value)
        for (int divisor = 1; divisor <= 30; ++divisor) {
            ASSERT_EQ(Native{floor_divide(value, divisor)}, slow_floor_divide(value, divisor));
            ASSERT_EQ(Native{round_divide(value, divisor)}, slow_round_divide(value, divisor));
        }
}

TEST(RoundDivide, NeverOverflowsOnTheWay) {
    EXPECT_EQ(round_divide(INT64_MIN, std::int64_t{3}), -3074457345618258603);
    EXPECT_EQ(round_divide(INT64_MIN, std::int64_t{1}), INT64_MIN);
    EXPECT_EQ(round_divide(INT64_MAX, std::int64_t{2}), std::int64_t{1} << 62);
    EXPECT_EQ(round_divide(INT64_MAX, INT64_MAX), 1);
    EXPECT_EQ(round_divide(INT64_MIN, INT64_MAX), -1);
    EXPECT_EQ(round_divide(INT32_MIN, 3), -715827883);
    Random random(52);
    for (int i = 0; i < 100000; ++i) {
        const std::int64_t near_an_end = random.below(100);
        const std::int64_t value = i % 4 == 0   ? INT64_MIN + near_an_end
                                   : i % 4 == 1 ? INT64_MAX - near_an_end
                                                : any(random);
        const std::int64_t divisor = any(random);
        if (divisor <= 0) continue;
        ASSERT_EQ(Native{floor_divide(value, divisor)}, slow_floor_divide(value, divisor));
        ASSERT_EQ(Native{round_divide(value, divisor)}, slow_round_divide(value, divisor))
            << value << " / " << divisor;
    }
}

TEST(LeadingZeros, CountsThemAndTakesZero) {
    EXPECT_EQ(leading_zeros(std::uint32_t{0}), 32);
    EXPECT_EQ(leading_zeros(std::uint64_t{0}), 64);
    for (int bit = 0; bit < 32; ++bit) EXPECT_EQ(leading_zeros(std::uint32_t{1} << bit), 31 - bit);
    for (int bit = 0; bit < 64; ++bit) EXPECT_EQ(leading_zeros(~std::uint64_t{0} >> bit), bit);
    for (int bit = 0; bit < 32; ++bit) EXPECT_EQ(trailing_zeros(~std::uint32_t{0} << bit), bit);
    for (int bit = 0; bit < 64; ++bit) EXPECT_EQ(trailing_zeros(std::uint64_t{1} << bit), bit);
}

TEST(Isqrt, IsExactAboutEverySquareOf32Bits) {
    EXPECT_EQ(isqrt(std::uint32_t{0}), 0u);
    for (std::uint32_t root = 1; root < 65536; ++root) {
        ASSERT_EQ(isqrt(root * root), root);
        ASSERT_EQ(isqrt(root * root - 1), root - 1);
        ASSERT_EQ(isqrt(root * root + 1), root);
        ASSERT_EQ(isqrt(root * root + 2 * root), root);
    }
    EXPECT_EQ(isqrt(UINT32_MAX), 65535u);
}

TEST(Isqrt, IsExactAboutSquaresOf64Bits) {
    EXPECT_EQ(isqrt(std::uint64_t{0}), 0u);
    EXPECT_EQ(isqrt(UINT64_MAX), UINT32_MAX);
    Random random(53);
    for (int i = 0; i < 100000; ++i) {
        // Roots of every length, those next to powers of two among them.
        const int length = random.between(1, 32);
        const std::uint64_t top = (std::uint64_t{1} << length) - 1;
        const std::uint64_t root = i % 3 == 0   ? top - random.below(3) % top
                                   : i % 3 == 1 ? (top >> 1) + 1
                                                : 1 + random.next() % top;
        ASSERT_EQ(isqrt(root * root), root);
        ASSERT_EQ(isqrt(root * root - 1), root - 1);
        ASSERT_EQ(isqrt(root * root + 1), root);
        ASSERT_EQ(isqrt(root * root + 2 * root), root);
    }
}

TEST(Isqrt, MeetsItsDefinitionOnAnyNumber) {
    Random random(54);
    for (int i = 0; i < 100000; ++i) {
        const auto value = static_cast<std::uint64_t>(any(random));
        const Native root = isqrt(value);
        ASSERT_LE(root * root, Native{value});
        ASSERT_GT((root + 1) * (root + 1), Native{value});
        const auto small = static_cast<std::uint32_t>(value);
        ASSERT_EQ(isqrt(small), isqrt(std::uint64_t{small}));
    }
}

TEST(Hypotenuse, IsExactWhileItsSidesHave31Bits) {
    Random random(55);
    for (int i = 0; i < 100000; ++i) {
        const std::int64_t x = any(random) >> 33;
        const std::int64_t y = any(random) >> 33;
        const Native length = hypotenuse(x, y);
        const Native square = Native{x} * x + Native{y} * y;
        ASSERT_LE(length * length, square);
        ASSERT_GT((length + 1) * (length + 1), square);
    }
    EXPECT_EQ(hypotenuse(INT32_MAX, INT32_MAX), 3037000498);  // floor(sqrt 2 * (2^31 - 1))
}

TEST(MultiplyHigh, IsTheProductOver2To32RoundedDown) {
    EXPECT_EQ(multiply_high(INT32_MIN, INT32_MIN), 1 << 30);
    EXPECT_EQ(multiply_high(INT32_MIN, INT32_MAX), -(1 << 30));
    EXPECT_EQ(multiply_high(-1, 1), -1);
    EXPECT_EQ(multiply_high(65536, 65536), 1);
    Random random(56);
    for (int i = 0; i < 10000; ++i) {
        const auto a = static_cast<std::int32_t>(any(random) >> 32);
        const auto b = static_cast<std::int32_t>(any(random) >> 32);
        ASSERT_EQ(Native{multiply_high(a, b)}, slow_floor_divide(Native{a} * b, Native{1} << 32));
    }
}

TEST(Integer, WorksInConstants) {
    static_assert(isqrt(std::uint32_t{99}) == 9 && isqrt(std::uint64_t{100}) == 10);
    static_assert(round_divide(-5, 2) == -2 && round_shift(-5, 1) == -2 && floor_divide(-5, 2) == -3);
    static_assert(saturate_cast<std::uint8_t>(300) == 255);
    static_assert(hypotenuse(3, 4) == 5);
}

}  // namespace
}  // namespace fovea::test
