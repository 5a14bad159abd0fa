// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <climits>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/number/angle.hpp>

namespace fovea::test {
namespace {

__extension__ using Native = __int128;

TEST(Angle, TakesDegreesOfAnyNumberOfTurns) {
    EXPECT_EQ(Angle::from_degrees(0).raw(), 0);
    EXPECT_EQ(Angle::from_degrees(45).raw(), 0x2000);
    EXPECT_EQ(Angle::from_degrees(90).raw(), 0x4000);
    EXPECT_EQ(Angle::from_degrees(180).raw(), 0x8000);
    EXPECT_EQ(Angle::from_degrees(-90).raw(), 0xc000);
    EXPECT_EQ(Angle::from_degrees(360), Angle());
    EXPECT_EQ(Angle::from_degrees(1).raw(), 182);      // 182.04
    EXPECT_EQ(Angle::from_degrees(359).raw(), 65354);  // 65353.96
    for (const int turns : {-5000000, -3, 2, 5000000})
        for (int degrees = 0; degrees < 360; ++degrees)
            ASSERT_EQ(Angle::from_degrees(360 * turns + degrees), Angle::from_degrees(degrees));
    EXPECT_EQ(Angle::from_degrees(INT_MAX), Angle::from_degrees(INT_MAX % 360));
    EXPECT_EQ(Angle::from_degrees(INT_MIN), Angle::from_degrees(INT_MIN % 360));
}

TEST(Angle, WrapsInSumsAndDifferences) {
    const Angle three_quarters = Angle::from_degrees(270);
    EXPECT_EQ(three_quarters + Angle::from_degrees(180), Angle::from_degrees(90));
    EXPECT_EQ(Angle::from_degrees(90) - Angle::from_degrees(180), three_quarters);
    EXPECT_NE(three_quarters, Angle());
    EXPECT_EQ(three_quarters.signed_raw(), -0x4000);
    EXPECT_EQ(Angle::from_raw(0x8000).signed_raw(), INT16_MIN);
    EXPECT_EQ(Angle::from_raw(0x7fff).signed_raw(), INT16_MAX);
}

TEST(FineAngle, HoldsEveryAngleAndRoundsBackToIt) {
    for (int raw = 0; raw < 65536; ++raw) {
        const Angle angle = Angle::from_raw(static_cast<std::uint16_t>(raw));
        ASSERT_EQ(FineAngle(angle).raw(), static_cast<std::uint32_t>(raw) << 16);
        ASSERT_EQ(FineAngle(angle).coarse(), angle);
    }
    EXPECT_EQ(FineAngle::from_raw(0x00017fff).coarse().raw(), 1);
    EXPECT_EQ(FineAngle::from_raw(0x00018000).coarse().raw(), 2);
    EXPECT_EQ(FineAngle::from_raw(0xffff7fff).coarse().raw(), 0xffff);
    EXPECT_EQ(FineAngle::from_raw(0xffff8000).coarse().raw(), 0);
}

TEST(FineAngle, WrapsInSumsDifferencesAndNegation) {
    const FineAngle quarter = FineAngle::quarter_turn();
    EXPECT_EQ(quarter + quarter, FineAngle::half_turn());
    EXPECT_EQ(FineAngle() - quarter, -quarter);
    EXPECT_EQ(-FineAngle::half_turn(), FineAngle::half_turn());
    EXPECT_EQ((-quarter).signed_raw(), -0x40000000);
    EXPECT_NE(quarter, -quarter);
    EXPECT_EQ(FineAngle::half_turn() + FineAngle::half_turn(), FineAngle());
}

TEST(FineAngle, RoundsMicrodegreesOfAnyNumberOfTurns) {
    EXPECT_EQ(FineAngle::from_microdegrees(90000000), FineAngle::quarter_turn());
    EXPECT_EQ(FineAngle::from_microdegrees(-90000000), -FineAngle::quarter_turn());
    EXPECT_EQ(FineAngle::from_microdegrees(360000000), FineAngle());
    EXPECT_EQ(FineAngle::from_microdegrees(359999999).raw(), 0u - 12);  // 11.93 below a turn
    EXPECT_EQ(FineAngle::from_microdegrees(1).raw(), 12u);
    Random random(61);
    for (int i = 0; i < 100000; ++i) {
        const auto high = static_cast<std::uint64_t>(random.next());
        const auto bits = static_cast<std::int64_t>(high << 32 | random.next());
        const std::int64_t microdegrees = i == 0   ? INT64_MIN
                                          : i == 1 ? INT64_MAX
                                                   : bits >> random.between(0, 63);
        // floor(m 2^32 / turn + 1/2) modulo 2^32.
        const Native turn = 360000000;
        const Native doubled = Native{microdegrees} * (Native{1} << 33) + turn;
        Native quotient = doubled / (2 * turn);
        if (quotient * 2 * turn > doubled) --quotient;
        ASSERT_EQ(FineAngle::from_microdegrees(microdegrees).raw(), static_cast<std::uint32_t>(quotient))
            << microdegrees;
    }
}

TEST(FineAngle, GivesMicrodegreesBackUnchanged) {
    // A step is 0.084 millionths of a degree, so that half a step never reaches the next one.
    Random random(62);
    for (int i = 0; i < 100000; ++i) {
        const int microdegrees = random.between(-180000000, 179999999);
        ASSERT_EQ(FineAngle::from_microdegrees(microdegrees).microdegrees(), microdegrees);
    }
    EXPECT_EQ(FineAngle::from_microdegrees(-180000000).microdegrees(), -180000000);
    EXPECT_EQ(FineAngle::from_microdegrees(179999999).microdegrees(), 179999999);
    EXPECT_EQ(FineAngle::from_microdegrees(180000000).microdegrees(), -180000000);
}

TEST(FineAngle, RoundsToMicrodegreesUpToBothHalfTurns) {
    EXPECT_EQ(FineAngle::from_raw(0).microdegrees(), 0);
    EXPECT_EQ(FineAngle::from_raw(5).microdegrees(), 0);  // 0.42
    EXPECT_EQ(FineAngle::from_raw(6).microdegrees(), 1);  // 0.503
    EXPECT_EQ(FineAngle::from_raw(0u - 6).microdegrees(), -1);
    EXPECT_EQ(FineAngle::half_turn().microdegrees(), -180000000);
    EXPECT_EQ(FineAngle::from_raw(0x7fffffff).microdegrees(), 180000000);  // 179999999.92
}

TEST(Angle, WorksInConstants) {
    static_assert(Angle::from_degrees(90).raw() == 0x4000);
    static_assert(FineAngle::from_microdegrees(-90000000).microdegrees() == -90000000);
    static_assert(FineAngle(Angle::from_degrees(180)) == FineAngle::half_turn());
}

}  // namespace
}  // namespace fovea::test
