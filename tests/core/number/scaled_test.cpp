// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fovea/base/random.hpp>
#include <fovea/number/scaled.hpp>

namespace fovea::test {
namespace {

long double value_of(Scaled number) {
    return std::ldexp(static_cast<long double>(number.mantissa()), number.exponent());
}
std::int64_t any(Random& random) {
    const auto high = static_cast<std::uint64_t>(random.next());
    return static_cast<std::int64_t>(high << 32 | random.next()) >> random.between(0, 63);
}
/// 2^-59 of the numbers at hand, or what the reference itself can tell.
long double near(long double size) {
    return std::abs(size) * std::max(std::ldexp(1.0L, -59), 4 * std::numeric_limits<long double>::epsilon());
}
bool well_formed(Scaled a) {
    const std::uint64_t size = magnitude(a.mantissa());
    return size == 0 ? a.exponent() == 0 : size >> 61 == 1;
}

TEST(Scaled, OfWholeNumbersIsExactAndComesBack) {
    Random random(71);
    for (int i = 0; i < 100000; ++i) {
        const std::int64_t a = any(random) / 2;
        const Scaled number = Scaled::from_int(a);
        ASSERT_TRUE(well_formed(number));
        ASSERT_EQ(number.rounded(0), a);
        ASSERT_EQ(Scaled::from_int(Int128(a)), number);
        ASSERT_EQ(-number, Scaled::from_int(-a));
    }
    EXPECT_EQ(Scaled::from_int(Int128::product(std::int64_t{1} << 60, std::int64_t{3} << 50)).rounded(-108),
              12);
}

TEST(Scaled, CalculatesAsTheReference) {
    Random random(72);
    for (int i = 0; i < 100000; ++i) {
        const Scaled a = Scaled::from_int(Int128::product(any(random), any(random)));
        const Scaled b = Scaled::from_int(any(random));
        const Scaled sum = a + b;
        const Scaled product = a * b;
        ASSERT_TRUE(well_formed(sum) && well_formed(product));
        ASSERT_LE(std::abs(value_of(sum) - (value_of(a) + value_of(b))),
                  near(std::abs(value_of(a)) + std::abs(value_of(b))));
        ASSERT_LE(std::abs(value_of(product) - value_of(a) * value_of(b)), near(value_of(product)));
        ASSERT_EQ(a - b, -(b - a));
        ASSERT_EQ(a + b, b + a);
        ASSERT_EQ(-a * b, -(a * b));
        if (b.zero()) continue;
        const Scaled quotient = a / b;
        ASSERT_TRUE(well_formed(quotient));
        ASSERT_LE(std::abs(value_of(quotient) - value_of(a) / value_of(b)), near(value_of(quotient)));
        ASSERT_EQ(a / -b, -quotient);
    }
}

TEST(Scaled, RoundsToUnitsAndHoldsTheEnds) {
    const Scaled third = Scaled::from_int(1) / Scaled::from_int(3);
    EXPECT_EQ(third.rounded(16), 21845);
    EXPECT_EQ((-third).rounded(17), -43691);
    EXPECT_EQ(third.rounded(1), 1);
    EXPECT_EQ(third.rounded(0), 0);
    EXPECT_EQ(third.rounded(-100), 0);
    EXPECT_EQ(third.rounded(100), std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ((-third).rounded(100), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(Scaled().rounded(5), 0);
}

TEST(Scaled, RootIsThatOfTheReference) {
    Random random(73);
    EXPECT_EQ(root_of(0), Scaled());
    for (const std::uint64_t square : {std::uint64_t{1}, std::uint64_t{4}, std::uint64_t{1} << 60})
        EXPECT_LE(std::abs(value_of(root_of(square)) - std::sqrt(static_cast<long double>(square))),
                  near(1e9L));
    for (int i = 0; i < 20000; ++i) {
        const std::uint64_t a = magnitude(any(random)) >> 2;
        const long double root = std::sqrt(static_cast<long double>(a));
        ASSERT_LE(std::abs(value_of(root_of(a)) - root), near(root)) << a;
    }
}

TEST(Log2, IsThatOfTheReference) {
    EXPECT_EQ(*log2_of(Scaled::from_int(1)), Log2::from_int(0));
    EXPECT_EQ(*log2_of(Scaled::from_int(-8)), Log2::from_int(3));
    EXPECT_EQ(*log2_of(Scaled::from_int(1) / Scaled::from_int(1024)), Log2::from_int(-10));
    EXPECT_EQ(log2_of(Scaled()).status(), Status::degenerate);
    Random random(74);
    for (int i = 0; i < 100000; ++i) {
        const Scaled a = Scaled::from_int(any(random) | 1) / Scaled::from_int(any(random) | 1);
        const long double real = std::log2(std::abs(value_of(a)));
        ASSERT_LE(std::abs(static_cast<long double>(log2_of(a)->raw()) - real * 65536), 0.51L);
    }
}

}  // namespace
}  // namespace fovea::test
