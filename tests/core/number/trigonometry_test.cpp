// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea::test {
namespace {

constexpr long double pi = 3.14159265358979323846264338327950288L;
constexpr long double turn = 4294967296.0L;  // raw values of a FineAngle
constexpr std::uint32_t quarter = 0x40000000u;

/// The larger error of cosine and sine, in 2^-30.
long double error_of(std::uint32_t raw) {
    const UnitVector found = unit_vector(FineAngle::from_raw(raw));
    const long double angle = raw * (2 * pi / turn);
    return std::max(std::abs(found.x.raw() - Unit::one * std::cos(angle)),
                    std::abs(found.y.raw() - Unit::one * std::sin(angle)));
}

/// The error of an angle of (x, y), in 2^-32 turn, the short way round.
long double error_of(FineAngle found, std::int64_t x, std::int64_t y) {
    const long double true_angle =
        std::atan2(static_cast<long double>(y), static_cast<long double>(x)) * (turn / (2 * pi));
    const long double off = found.raw() - true_angle;
    return std::abs(off - turn * std::round(off / turn));
}

TEST(UnitVector, IsWithinItsBoundAllAroundTheTurn) {
    long double largest = 0;
    // A step that is odd and no simple fraction of the turn, so that the sample is as fine as its number
    // everywhere.
    std::uint32_t raw = 12345;
    for (int i = 0; i < 400000; ++i, raw += 2654435769u) largest = std::max(largest, error_of(raw));
    // Where the polynomials meet, and about the axes.
    for (std::uint32_t eighth = 0; eighth < 8; ++eighth)
        for (std::uint32_t off = 0; off < 2000; ++off) {
            largest = std::max(largest, error_of((eighth << 29) + off));
            largest = std::max(largest, error_of((eighth << 29) - off));
        }
    EXPECT_LE(largest, 1.3L);
}

TEST(UnitVector, IsExactAtTheQuarters) {
    const struct {
        std::uint32_t raw;
        int x, y;
    } quarters[] = {{0, 1, 0}, {quarter, 0, 1}, {2 * quarter, -1, 0}, {3 * quarter, 0, -1}};
    for (const auto& q : quarters) {
        const UnitVector found = unit_vector(FineAngle::from_raw(q.raw));
        EXPECT_EQ(found.x, Unit::from_int(q.x)) << q.raw;
        EXPECT_EQ(found.y, Unit::from_int(q.y)) << q.raw;
    }
}

TEST(UnitVector, HasRootsOfOneHalfAtTheEighths) {
    // sqrt(1/2) * 2^30 = 759250124.99; the bound of 1.3 leaves three integers.
    for (int eighth = 1; eighth < 8; eighth += 2) {
        const UnitVector found = unit_vector(Angle::from_degrees(45 * eighth));
        EXPECT_NEAR(std::abs(found.x.raw()), 759250125, 1);
        EXPECT_NEAR(std::abs(found.y.raw()), 759250125, 1);
        EXPECT_EQ(found.x.raw() > 0, eighth == 1 || eighth == 7);
        EXPECT_EQ(found.y.raw() > 0, eighth < 4);
    }
}

TEST(UnitVector, TurnsByAQuarterAsItsBitsSay) {
    Random random(71);
    for (int i = 0; i < 10000; ++i) {
        const FineAngle angle = FineAngle::from_raw(random.next());
        const UnitVector here = unit_vector(angle);
        const UnitVector next = unit_vector(angle + FineAngle::quarter_turn());
        ASSERT_EQ(next.x, -here.y);
        ASSERT_EQ(next.y, here.x);
        const UnitVector back = unit_vector(angle + FineAngle::half_turn());
        ASSERT_EQ(back.x, -here.x);
        ASSERT_EQ(back.y, -here.y);
    }
}

TEST(AngleOf, IsExactOnAxesAndDiagonals) {
    for (const std::int32_t side : {1, 2, 3, 1000, 65536, INT32_MAX}) {
        EXPECT_EQ(angle_of(side, 0).raw(), 0u);
        EXPECT_EQ(angle_of(side, side).raw(), quarter / 2);
        EXPECT_EQ(angle_of(0, side).raw(), quarter);
        EXPECT_EQ(angle_of(-side, side).raw(), quarter / 2 * 3);
        EXPECT_EQ(angle_of(-side, 0).raw(), quarter * 2);
        EXPECT_EQ(angle_of(-side, -side).raw(), quarter / 2 * 5);
        EXPECT_EQ(angle_of(0, -side).raw(), quarter * 3);
        EXPECT_EQ(angle_of(side, -side).raw(), quarter / 2 * 7);
    }
    EXPECT_EQ(angle_of(0, 0).raw(), 0u);
    EXPECT_EQ(angle_of(INT32_MIN, 0).raw(), quarter * 2);
    EXPECT_EQ(angle_of(0, INT32_MIN).raw(), quarter * 3);
    EXPECT_EQ(angle_of(INT32_MIN, INT32_MIN).raw(), quarter / 2 * 5);
}

TEST(AngleOf, IsWithinItsBoundForSidesOfEveryLength) {
    Random random(72);
    long double largest = 0;
    for (int i = 0; i < 400000; ++i) {
        const auto x = static_cast<std::int32_t>(random.next()) >> random.between(0, 31);
        const auto y = static_cast<std::int32_t>(random.next()) >> random.between(0, 31);
        if (x == 0 && y == 0) continue;
        largest = std::max(largest, error_of(angle_of(x, y), x, y));
    }
    EXPECT_LE(largest, 1.1L);
}

TEST(AngleOf, IsWithinItsBoundWhereThePolynomialsMeet) {
    long double largest = 0;
    for (const std::int32_t large : {INT32_MAX, INT32_MIN, 1 << 30, 1000003, 8 * 4099})
        for (std::int64_t part = 0; part <= 8; ++part)
            for (std::int64_t off = -300; off <= 300; ++off) {
                const std::int64_t small = std::abs(std::int64_t{large}) * part / 8 + off;
                if (small > INT32_MAX || small < INT32_MIN) continue;
                const auto side = static_cast<std::int32_t>(small);
                largest = std::max(largest, error_of(angle_of(large, side), large, side));
                largest = std::max(largest, error_of(angle_of(side, large), side, large));
            }
    EXPECT_LE(largest, 1.1L);
}

TEST(AngleOf, IsMirroredAsItsVectorIs) {
    Random random(73);
    for (int i = 0; i < 20000; ++i) {
        const auto x = static_cast<std::int32_t>(random.next()) >> random.between(1, 31);
        const auto y = static_cast<std::int32_t>(random.next()) >> random.between(1, 31);
        if (x == 0 || y == 0) continue;
        ASSERT_EQ(angle_of(x, -y), -angle_of(x, y));
        ASSERT_EQ(angle_of(-x, y), FineAngle::half_turn() - angle_of(x, y));
        ASSERT_EQ(angle_of(-x, -y), FineAngle::half_turn() + angle_of(x, y));
    }
}

TEST(AngleOf, EqualsItselfForNarrowSidesInItsWideForm) {
    Random random(74);
    for (int i = 0; i < 20000; ++i) {
        const auto x = static_cast<std::int32_t>(random.next()) >> random.between(1, 31);
        const auto y = static_cast<std::int32_t>(random.next()) >> random.between(1, 31);
        ASSERT_EQ(angle_of(std::int64_t{x}, std::int64_t{y}), angle_of(x, y));
    }
}

TEST(AngleOf, LosesAtMostFourStepsForWideSides) {
    // 1.1 * 2^-32 of the polynomials, and 2^-30 turn = 4 * 2^-32 of the shift.
    Random random(75);
    long double largest = 0;
    for (int i = 0; i < 200000; ++i) {
        const auto wide = [&] {
            const auto high = static_cast<std::uint64_t>(random.next());
            return static_cast<std::int64_t>(high << 32 | random.next()) >> random.between(0, 63);
        };
        const std::int64_t x = wide();
        const std::int64_t y = wide();
        if (x == 0 && y == 0) continue;
        largest = std::max(largest, error_of(angle_of(x, y), x, y));
    }
    EXPECT_LE(largest, 5.1L);
    EXPECT_EQ(angle_of(INT64_MIN, std::int64_t{0}).raw(), 2 * quarter);
    EXPECT_EQ(angle_of(std::int64_t{0}, INT64_MIN).raw(), 3 * quarter);
    EXPECT_EQ(angle_of(INT64_MIN, INT64_MIN).raw(), quarter / 2 * 5);
    EXPECT_LE(error_of(angle_of(INT64_MAX, INT64_MIN), INT64_MAX, INT64_MIN), 5.1L);
}

TEST(AngleOf, UndoesUnitVector) {
    // A component is off by 1.3 * 2^-30 at most: sqrt(2) * 1.3 * 2^-30 / (2 pi) turn = 1.17 * 2^-32, and 1.1
    // more.
    Random random(76);
    for (int i = 0; i < 50000; ++i) {
        const FineAngle angle = FineAngle::from_raw(random.next());
        const UnitVector way = unit_vector(angle);
        const std::int32_t off = (angle_of(way.x.raw(), way.y.raw()) - angle).signed_raw();
        ASSERT_LE(std::abs(off), 2) << angle.raw();
    }
}

TEST(Trigonometry, WorksInConstants) {
    static_assert(unit_vector(FineAngle::quarter_turn()).y == Unit::from_int(1));
    static_assert(angle_of(-1, 0) == FineAngle::half_turn());
}

}  // namespace
}  // namespace fovea::test
