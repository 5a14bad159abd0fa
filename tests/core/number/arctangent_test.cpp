// SPDX-License-Identifier: MIT
#include <fovea/number/arctangent.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include <fovea/base/random.hpp>
#include <support/scalars.hpp>

namespace fovea::test {
namespace {

constexpr long double exact_pi = 3.14159265358979323846264338327950288L;

/// A number of 64 random digits and a random size.
Real random_number(Random& random) {
    const std::uint64_t high = random.next();
    const std::uint64_t low = random.next();
    const int exponent = random.between(-100, -30);
    const bool negative = random.below(2) == 1;
    const Real size = Real::from_int(static_cast<std::int64_t>((high << 32 | low) >> 1), exponent);
    return negative ? -size : size;
}

TEST(Arctangent, IsThatOfLongDouble) {
    Random random(97);
    for (int i = 0; i < 20000; ++i) {
        const Real y = random_number(random);
        const Real x = random_number(random);
        const long double expected = std::atan2(value_of(y), value_of(x));
        const long double found = value_of(arctangent(y, x));
        // 2^-60.5 of the angle, and the last digit of long double.
        ASSERT_LE(std::abs(found - expected), std::abs(expected) * 0x1.7p-60L) << i;
    }
}

TEST(Arctangent, OfTheAxesAndDiagonals) {
    const Real zero;
    const Real one = Real::one();
    EXPECT_EQ(arctangent(zero, zero), zero);
    EXPECT_EQ(arctangent(zero, one), zero);
    EXPECT_EQ(arctangent(one, zero), pi<Real>(1));
    EXPECT_EQ(arctangent(-one, zero), -pi<Real>(1));
    EXPECT_EQ(arctangent(zero, -one), pi<Real>());
    EXPECT_LE(std::abs(value_of(arctangent(one, one)) - exact_pi / 4), 0x1p-63L);
    EXPECT_LE(std::abs(value_of(arctangent(-one, -one)) + exact_pi * 3 / 4), 0x1p-61L);
    EXPECT_LE(std::abs(value_of(pi<Real>()) - exact_pi), 0x1p-62L);
    // Beside the eighths, where the table changes.
    for (int i = 1; i < 16; ++i)
        for (int bits = 20; bits <= 70; bits += 10) {
            const Real y = Real::from_int(i, -4) + Real::from_int(i % 2 == 0 ? 1 : -1, -bits);
            const long double expected = std::atan2(value_of(y), 1.0L);
            ASSERT_LE(std::abs(value_of(arctangent(y, one)) - expected), expected * 0x1.7p-60L) << i;
        }
}

TEST(CosineAndSine, AreThoseOfLongDouble) {
    Random random(98);
    for (int i = 0; i < 20000; ++i) {
        const std::int64_t high = random.between(-2147483647, 2147483647);
        const std::int64_t low = random.next();
        // Up to 2 pi.
        const Real angle = Real::from_int(high * 4294967296 + low, -63) * pi<Real>(-1);
        const CosineAndSine<Real> turn(angle);
        ASSERT_LE(std::abs(value_of(turn.cosine) - std::cos(value_of(angle))), 0x1.7p-60L) << i;
        ASSERT_LE(std::abs(value_of(turn.sine) - std::sin(value_of(angle))), 0x1.7p-60L) << i;
    }
    const CosineAndSine<Real> none{Real()};
    EXPECT_EQ(none.cosine, Real::one());
    EXPECT_EQ(none.sine, Real());
    const CosineAndSine<Real> half(pi<Real>());
    EXPECT_EQ(half.cosine, -Real::one());
    EXPECT_LE(half.sine.absolute(), Real::from_int(1, -60));
}

}  // namespace
}  // namespace fovea::test
