// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include <fovea/base/random.hpp>
#include <fovea/number/fixed.hpp>

namespace fovea::test {
namespace {

__extension__ using Native = __int128;
using Wide = Fixed<std::int64_t, 8>;
using Whole = Fixed<std::int64_t, 0>;
using Finest = Fixed<std::int64_t, 62>;
using Narrow = Fixed<std::int8_t, 4>;

/// A 64-bit number of any length, so that small and large ones are equally likely.
std::int64_t any(Random& random) {
    const auto high = static_cast<std::uint64_t>(random.next());
    const auto bits = static_cast<std::int64_t>(high << 32 | random.next());
    return bits >> random.between(0, 63);
}

/// floor(numerator / denominator + 1/2), the ends of Rep held.
template <class Rep>
Native rounded(Native numerator, Native denominator) {
    const Native doubled = 2 * numerator + denominator;
    Native quotient = doubled / (2 * denominator);
    if (quotient * 2 * denominator > doubled) --quotient;
    const Native low = std::numeric_limits<Rep>::min();
    const Native high = std::numeric_limits<Rep>::max();
    return quotient < low ? low : quotient > high ? high : quotient;
}

TEST(Fixed, IsMadeOfWholeNumbersRawBitsAndRatios) {
    EXPECT_EQ(SubPixel().raw(), 0);
    EXPECT_EQ(SubPixel::from_int(-3).raw(), -768);
    EXPECT_EQ(SubPixel::from_raw(5).raw(), 5);
    EXPECT_EQ(SubPixel::from_ratio(1, 2).raw(), 128);
    EXPECT_EQ(SubPixel::one, 256);
    EXPECT_EQ(Unit::from_int(-2).raw(), INT32_MIN);
    EXPECT_EQ(FinePixel::from_int(32767).raw(), 32767 * 65536);
}

TEST(Fixed, RoundsRatiosToTheNearestWithTiesTowardPlusInfinity) {
    EXPECT_EQ(SubPixel::from_ratio(1, 512).raw(), 1);
    EXPECT_EQ(SubPixel::from_ratio(-1, 512).raw(), 0);
    EXPECT_EQ(SubPixel::from_ratio(3, 512).raw(), 2);
    EXPECT_EQ(SubPixel::from_ratio(-3, 512).raw(), -1);
    EXPECT_EQ(SubPixel::from_ratio(1, 3).raw(), 85);
    EXPECT_EQ(SubPixel::from_ratio(-1, 3).raw(), -85);
    Random random(65);
    for (int i = 0; i < 50000; ++i) {
        const std::int64_t numerator = any(random) / (std::int64_t{2} << 30);  // times 2^30 within 62 bits
        const std::int64_t denominator = any(random);
        if (denominator <= 0) continue;
        ASSERT_EQ(Native{Unit::from_ratio(numerator, denominator).raw()},
                  rounded<std::int32_t>(Native{numerator} * Unit::one, denominator));
        ASSERT_EQ(Native{Narrow::from_ratio(numerator, denominator).raw()},
                  rounded<std::int8_t>(Native{numerator} * Narrow::one, denominator));
        ASSERT_EQ(Native{Wide::from_ratio(numerator, denominator).raw()},
                  rounded<std::int64_t>(Native{numerator} * Wide::one, denominator));
    }
}

TEST(Fixed, HoldsRatiosAtTheEndsOfTheFormat) {
    EXPECT_EQ(SubPixel::from_ratio(std::int64_t{1} << 50, 1).raw(), INT32_MAX);
    EXPECT_EQ(SubPixel::from_ratio(-(std::int64_t{1} << 50), 1).raw(), INT32_MIN);
    EXPECT_EQ(Unit::from_ratio(2, 1).raw(), INT32_MAX);
    EXPECT_EQ(Unit::from_ratio(-2, 1).raw(), INT32_MIN);
    EXPECT_EQ(Narrow::from_ratio(100, 1).raw(), 127);
    EXPECT_EQ(Narrow::from_ratio(-100, 1).raw(), -128);
}

TEST(Fixed, GoesToWholeNumbersDownAndToTheNearest) {
    EXPECT_EQ(SubPixel::from_raw(-1).floor(), -1);
    EXPECT_EQ(SubPixel::from_raw(255).floor(), 0);
    EXPECT_EQ(SubPixel::from_raw(128).round(), 1);
    EXPECT_EQ(SubPixel::from_raw(127).round(), 0);
    EXPECT_EQ(SubPixel::from_raw(-128).round(), 0);
    EXPECT_EQ(SubPixel::from_raw(-129).round(), -1);
    EXPECT_EQ(FinePixel::from_raw(INT32_MAX).round(), 32768);
    EXPECT_EQ(FinePixel::from_raw(INT32_MIN).round(), -32768);
    EXPECT_EQ(Finest::from_raw(INT64_MAX).round(), 2);
    EXPECT_EQ(Finest::from_raw(INT64_MIN).round(), -2);
    for (int whole = -1000; whole <= 1000; ++whole) {
        ASSERT_EQ(SubPixel::from_int(whole).round(), whole);
        ASSERT_EQ(SubPixel::from_int(whole).floor(), whole);
    }
}

TEST(Fixed, ConvertsByHand) {
    EXPECT_EQ(FinePixel::from_raw(128).convert<SubPixel>().raw(), 1);   // half a step goes up
    EXPECT_EQ(FinePixel::from_raw(-128).convert<SubPixel>().raw(), 0);  // and so does minus half a step
    EXPECT_EQ(FinePixel::from_raw(127).convert<SubPixel>().raw(), 0);
    EXPECT_EQ(SubPixel::from_raw(3).convert<FinePixel>().raw(), 768);
    EXPECT_EQ(SubPixel::from_int(100000).convert<FinePixel>().raw(), INT32_MAX);
    EXPECT_EQ(SubPixel::from_int(-100000).convert<FinePixel>().raw(), INT32_MIN);
    EXPECT_EQ(SubPixel::from_raw(77).convert<SubPixel>().raw(), 77);
}

/// The definition of convert(): the same number, rounded, the ends of the format held.
template <class From, class To>
void expect_converted(std::int64_t raw) {
    using FromRaw = decltype(From().raw());
    const From from = From::from_raw(saturate_cast<FromRaw>(raw));
    constexpr int drop = From::fraction_bits - To::fraction_bits;
    constexpr Native one = 1;
    const Native numerator = drop > 0 ? Native{from.raw()} : Native{from.raw()} * (one << -minimum(drop, 0));
    const Native expected = rounded<decltype(To().raw())>(numerator, one << maximum(drop, 0));
    ASSERT_EQ(Native{from.template convert<To>().raw()}, expected)
        << from.raw() << " with " << From::fraction_bits << " bits to " << To::fraction_bits;
}
template <class From>
void expect_converted_to_all(std::int64_t raw) {
    expect_converted<From, SubPixel>(raw);
    expect_converted<From, FinePixel>(raw);
    expect_converted<From, Unit>(raw);
    expect_converted<From, Wide>(raw);
    expect_converted<From, Whole>(raw);
    expect_converted<From, Finest>(raw);
    expect_converted<From, Narrow>(raw);
}

TEST(Fixed, ConvertsBetweenAllFormatsWithoutOverflow) {
    Random random(66);
    for (int i = 0; i < 20000; ++i) {
        const std::int64_t near_an_end = random.below(1000);
        const std::int64_t raw = i % 8 == 0   ? INT64_MAX - near_an_end
                                 : i % 8 == 1 ? INT64_MIN + near_an_end
                                              : any(random);
        expect_converted_to_all<SubPixel>(raw);
        expect_converted_to_all<FinePixel>(raw);
        expect_converted_to_all<Unit>(raw);
        expect_converted_to_all<Wide>(raw);
        expect_converted_to_all<Whole>(raw);
        expect_converted_to_all<Finest>(raw);
        expect_converted_to_all<Narrow>(raw);
    }
}

TEST(Fixed, AddsNegatesScalesAndCompares) {
    constexpr SubPixel a = SubPixel::from_raw(300);
    constexpr SubPixel b = SubPixel::from_raw(-200);
    static_assert((a + b).raw() == 100 && (a - b).raw() == 500 && (-a).raw() == -300 &&
                  (b * 3).raw() == -600);
    static_assert(a != b && b < a && a > b && a >= a && a <= a && !(a < a) && !(a > a) && a == a);
    SubPixel sum = a;
    sum += b;
    EXPECT_EQ(sum.raw(), 100);
    sum -= a;
    EXPECT_EQ(sum.raw(), -200);
    constexpr Narrow small = Narrow::from_raw(-100);
    static_assert((small + Narrow::from_raw(50)).raw() == -50 && (-small).raw() == 100);
}

}  // namespace
}  // namespace fovea::test
