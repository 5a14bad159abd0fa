// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>

#include <fovea/base/random.hpp>
#include <fovea/number/real.hpp>
#include <support/scalars.hpp>

namespace fovea::test {
namespace {

__extension__ using Word128 = unsigned __int128;

constexpr std::int64_t int64_min = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t int64_max = std::numeric_limits<std::int64_t>::max();

/// Mantissas of which half are patterns that carry far.
Real any(Random& random, int least_exponent, int most_exponent) {
    const std::uint64_t high = random.next();
    const std::uint64_t bits = high << 32 | random.next();
    const int shift = random.between(0, 63);
    const std::uint64_t patterns[] = {
        bits, ~(bits >> shift), bits >> shift, std::uint64_t{1} << shift, ~std::uint64_t{0} << shift, bits};
    const std::uint64_t mantissa = patterns[random.below(6)] | std::uint64_t{1} << 63;
    const int exponent = random.between(least_exponent, most_exponent);
    const Real half = Real::from_int(static_cast<std::int64_t>(mantissa >> 1), exponent - 62);
    const Real number = mantissa & 1 ? half + Real::from_int(1, exponent - 63) : half;
    return random.below(2) == 0 ? number : -number;
}

/// The Real of a magnitude of 128 bits, cut after 64 digits.
Real cut(bool negative, Word128 size, int exponent) {
    if (size == 0) return {};
    int drop = 0;
    while (size >> drop >= static_cast<Word128>(1) << 64) ++drop;
    const auto digits = static_cast<std::uint64_t>(size >> drop);
    const Real top = Real::from_int(static_cast<std::int64_t>(digits >> 1), exponent + drop + 1);
    const Real number = digits & 1 ? top + Real::from_int(1, exponent + drop) : top;
    return negative ? -number : number;
}

/// The sum as the rule says it: the smaller is shifted with one digit more.
Real sum_reference(Real a, Real b) {
    if (a.absolute() < b.absolute()) return sum_reference(b, a);
    if (b.zero() || a.exponent() - b.exponent() > 63) return a;
    const Word128 large = static_cast<Word128>(a.mantissa()) << 1;
    const Word128 small = (static_cast<Word128>(b.mantissa()) << 1) >> (a.exponent() - b.exponent());
    const bool differ = a.negative() != b.negative();
    return cut(a.negative(), differ ? large - small : large + small, a.exponent() - 64);
}

bool well_formed(Real a) { return a.zero() ? a == Real() && !a.negative() : a.mantissa() >> 63 == 1; }

TEST(Real, OfWholeNumbersIsExactAndComesBack) {
    Random random(1);
    for (int i = 0; i < 100000; ++i) {
        const std::uint64_t high = random.next();
        const auto a = static_cast<std::int64_t>(high << 32 | random.next()) >> random.between(0, 63);
        const Real number = Real::from_int(a);
        ASSERT_TRUE(well_formed(number));
        ASSERT_EQ(number.rounded(0), a);
        ASSERT_EQ(Real::from_int(Int128(a)), number);
        ASSERT_EQ(Real::from_int(a, -70).scaled(70), number);
        ASSERT_EQ(-number, Real::from_int(0) - number);
    }
    EXPECT_EQ(Real::from_int(int64_min).rounded(0), int64_min);
    EXPECT_EQ(Real::from_int(Int128::product(int64_max, int64_max), -126).rounded(62),
              (std::int64_t{1} << 62) - 1);
    EXPECT_EQ(Real::from_ratio(1, 3).rounded(16), 21845);
    EXPECT_EQ(Real::from_ratio(1, 0), Real());
    EXPECT_EQ(Real::one(), Real::from_int(1));
    EXPECT_EQ(Real::from_fixed(SubPixel::from_raw(-384)), Real::from_ratio(-3, 2));
}

TEST(Real, OfBytesThatAre0Is0) {
    Real number = Real::one();
    const unsigned char zeros[sizeof number] = {};
    EXPECT_EQ(sizeof number, 12u);
    std::memcpy(static_cast<void*>(&number), zeros, sizeof number);
    EXPECT_EQ(number, Real());
    EXPECT_EQ(number + Real::one(), Real::one());
}

TEST(Real, SumsFollowTheirRuleInBothWays) {
    Random random(2);
    for (int i = 0; i < 1000000; ++i) {
        const Real a = any(random, 0, 0);
        const Real b = i % 3 == 0 ? any(random, -1, 1) : any(random, -70, 70);
        const Real expected = sum_reference(a, b);
        ASSERT_EQ(Real::sum_with_branches(a, b), expected) << value_of(a) << " + " << value_of(b);
        ASSERT_EQ(Real::sum_without_branches(a, b), expected) << value_of(a) << " + " << value_of(b);
        ASSERT_TRUE(well_formed(expected));
        ASSERT_EQ(a + b, b + a);
        ASSERT_EQ(a - b, -(b - a));
        ASSERT_EQ(a - a, Real());
        ASSERT_EQ(a + Real(), a);
        ASSERT_EQ(Real() - a, -a);
        ASSERT_EQ(Real::sum_with_branches(Real(), b), b);
        ASSERT_EQ(Real::sum_without_branches(b, Real()), b);
    }
    EXPECT_EQ(Real() - Real(), Real());
    EXPECT_EQ(-Real(), Real());
    // 2^63 less the half of 2^64 - 1: the digit behind the last one is all that is left.
    const Real nearly_two = Real::from_int(Int128::product(int64_max, 2) + Int128(1), -63);
    for (const Real difference : {Real::sum_with_branches(Real::from_int(2), -nearly_two),
                                  Real::sum_without_branches(Real::from_int(2), -nearly_two)})
        EXPECT_EQ(difference, Real::from_int(1, -63));
}

TEST(Real, ProductsAndQuotientsAreTheTrueOnesCutAfter64Digits) {
    Random random(3);
    for (int i = 0; i < 300000; ++i) {
        const Real a = any(random, -40, 40);
        const Real b = any(random, -40, 40);
        const bool negative = a.negative() != b.negative();
        const Word128 product = static_cast<Word128>(a.mantissa()) * b.mantissa();
        ASSERT_EQ(a * b, cut(negative, product, a.exponent() + b.exponent() - 126));
        // 65 digits of the quotient, of which the last may be one too many.
        const Word128 first = (static_cast<Word128>(a.mantissa()) << 63) / b.mantissa();
        const Word128 rest = (static_cast<Word128>(a.mantissa()) << 63) % b.mantissa();
        const Word128 quotient = first << 1 | (rest << 1 >= b.mantissa() ? 1 : 0);
        ASSERT_EQ(a / b, cut(negative, quotient, a.exponent() - b.exponent() - 64));
        ASSERT_EQ(a * Real(), Real());
        ASSERT_EQ(Real() / a, Real());
        ASSERT_EQ(a / Real(), Real());
        ASSERT_EQ(a * Real::one(), a);
    }
}

TEST(Real, RootIsTheLargestThatFits) {
    Random random(4);
    EXPECT_EQ(Real().square_root(), Real());
    for (const std::int64_t root : {1, 2, 3, 1000001}) {
        EXPECT_EQ(Real::from_int(root * root, 10).square_root(), Real::from_int(root, 5));
        EXPECT_EQ(Real::from_int(-root * root, -6).square_root(), Real::from_int(root, -3));
    }
    for (int i = 0; i < 300000; ++i) {
        const Real a = any(random, -9, 9).absolute();
        const Real root = a.square_root();
        // Of an odd power of two, counted from the first digit behind the point, the last digit is dropped.
        const int odd = (a.exponent() + 1) & 1;
        const Word128 wanted = static_cast<Word128>(a.mantissa() >> odd) << 64;
        const Word128 square = static_cast<Word128>(root.mantissa()) * root.mantissa();
        ASSERT_LE(square, wanted);
        ASSERT_LE(wanted - square, 2 * static_cast<Word128>(root.mantissa()));
        ASSERT_EQ(2 * root.exponent() + 2, a.exponent() + 1 + odd);
        ASSERT_EQ((-a).square_root(), root);
    }
}

TEST(Real, ComparesAsNumbers) {
    Random random(5);
    for (int i = 0; i < 300000; ++i) {
        const Real a = i % 7 == 0 ? Real() : any(random, -1, 1);
        const Real b = i % 5 == 0 ? Real() : i % 5 == 1 ? -a : any(random, -1, 1);
        const Real difference = a - b;
        ASSERT_EQ(a < b, difference.negative());
        ASSERT_EQ(a > b, difference.positive());
        ASSERT_EQ(a <= b, !difference.positive());
        ASSERT_EQ(a >= b, !difference.negative());
        ASSERT_EQ(a == b, difference.zero());
    }
}

TEST(Real, RoundsToUnitsAndHoldsTheEnds) {
    EXPECT_EQ(Real::from_ratio(-1, 3).rounded(17), -43691);
    EXPECT_EQ(Real::from_ratio(1, 2).rounded(0), 1);
    EXPECT_EQ(Real::from_ratio(-5, 2).rounded(0), -3);
    EXPECT_EQ(Real::from_ratio(1, 4).rounded(0), 0);
    EXPECT_EQ(Real::from_ratio(1, 3).rounded(-100), 0);
    EXPECT_EQ(Real::from_ratio(1, 3).rounded(100), int64_max);
    // Where the sum of both exponents has no room in an int.
    constexpr int most = std::numeric_limits<int>::max(), least = std::numeric_limits<int>::min();
    for (const Real& value : {Real::from_int(-3, -1000), Real::from_int(-3), Real::from_int(-3, 1000)}) {
        EXPECT_EQ(value.rounded(most), int64_min);
        EXPECT_EQ((-value).rounded(most), int64_max);
        EXPECT_EQ(value.rounded(least), 0);
    }
    EXPECT_EQ(Real().rounded(most), 0);
    EXPECT_EQ(Real::from_ratio(-1, 3).rounded(100), int64_min);
    EXPECT_EQ(Real::from_int(1, 63).rounded(0), int64_max);
    EXPECT_EQ(Real::from_int(-1, 63).rounded(0), int64_min);
    EXPECT_EQ((Real::from_int(1, 63) - Real::from_ratio(1, 2)).rounded(0), int64_max);
    EXPECT_EQ(Real().rounded(200), 0);
    EXPECT_EQ(Real::from_ratio(-3, 2).to_fixed<SubPixel>(), SubPixel::from_raw(-384));
    EXPECT_EQ(Real::from_int(1, 40).to_fixed<SubPixel>(),
              SubPixel::from_raw(std::numeric_limits<std::int32_t>::max()));
    Random random(6);
    for (int i = 0; i < 100000; ++i) {
        const Real a = any(random, -70, 70);
        const int bits = random.between(-70, 70);
        const std::int64_t rounded = a.rounded(bits);
        if (rounded == int64_min || rounded == int64_max) continue;
        const Real off = (a.scaled(bits) - Real::from_int(rounded)).absolute();
        ASSERT_LE(off, Real::from_ratio(1, 2));
        if (off == Real::from_ratio(1, 2)) {
            ASSERT_GT(Real::from_int(rounded).absolute(), a.scaled(bits).absolute());
        }
    }
}

}  // namespace
}  // namespace fovea::test
