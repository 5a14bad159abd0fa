// SPDX-License-Identifier: MIT
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <fovea/base/random.hpp>
#include <fovea/code/blur_scene.hpp>

#include "support/blurred_bars.hpp"

namespace fovea::detail {
namespace {

constexpr BlurLight even_light{{51200, 51200}, {35840, 35840}};

TEST(SampleProfile, IsLinearBetweenPlacesAndKeepsItsEnds) {
    std::vector<std::uint16_t> profile(300);
    for (std::size_t x = 0; x < profile.size(); ++x) profile[x] = static_cast<std::uint16_t>(100 * x);
    std::int32_t levels[most_blur_samples];
    // Modules of 2 px from 10: sample j lies at 10 + 2 * (2 (j - 7) + 1) / 4.
    const BlurScene scene{10 << 16, 200 << 16, 0, 1 << 16, even_light};
    sample_profile(ean_13_plan, {profile.data(), 300}, scene, levels);
    for (int j = 0; j < ean_13_plan.samples(); ++j) {
        // What is cut off of a share of 1/65536 in 190 px, and of the level.
        EXPECT_NEAR(levels[j], 100 * (10 + (2 * (j - blur_reach) + 1) / 2.0), 2) << j;
    }
    const BlurScene beyond{-500 * 65536, 900 << 16, 0, 1 << 16, even_light};
    sample_profile(ean_13_plan, {profile.data(), 300}, beyond, levels);
    EXPECT_EQ(levels[0], 0);
    EXPECT_EQ(levels[ean_13_plan.samples() - 1], 29899);
}

TEST(DarknessOf, IsTheShareBetweenWhiteAndBlack) {
    static BlurLightTable table;
    std::int32_t levels[most_blur_samples];
    std::int32_t darkness[most_blur_samples];
    for (std::int32_t& level : levels) level = 51200 - 35840 / 2;
    make_light_table(ean_13_plan, even_light, table);
    darkness_of(ean_13_plan, levels, table, darkness);
    for (const std::int32_t at : darkness) EXPECT_EQ(at, full_darkness / 2);
    for (std::int32_t& level : levels) level = 0;
    make_light_table(ean_13_plan, {{51200, 51200}, {0, 0}}, table);
    darkness_of(ean_13_plan, levels, table, darkness);
    for (const std::int32_t at : darkness) EXPECT_EQ(at, 2 * full_darkness);
}

TEST(DarknessOf, IsTheQuotientInAnyLight) {
    static BlurLightTable table;
    Random random(5);
    std::int32_t levels[most_blur_samples];
    std::int32_t darkness[most_blur_samples];
    for (const BlurPlan& plan : {ean_13_plan, ean_8_plan}) {
        for (int trial = 0; trial < 300; ++trial) {
            // As bright and as steep as fit_light() lets it be, and as faint.
            const int most = trial % 3 == 0 ? 5000 : 262144;
            const BlurLight light{
                {random.between(-300000, 300000), random.between(-300000, 300000)},
                {random.between(least_blur_contrast, most), random.between(least_blur_contrast, most)}};
            make_light_table(plan, light, table);
            for (int j = 0; j < plan.samples(); ++j) {
                const LightAt at = light_at(plan, light, j);
                // Some about what is an exact multiple, where a quotient is off first.
                levels[j] = trial % 2 == 0 ? random.between(0, 65535)
                                           : at.white - at.dark / 1024 * random.between(-1100, 2100) +
                                                 random.between(-1, 1);
            }
            darkness_of(plan, levels, table, darkness);
            for (int j = 0; j < plan.samples(); ++j) {
                const LightAt at = light_at(plan, light, j);
                const std::int64_t quotient = std::int64_t{at.white - levels[j]} * full_darkness / at.dark;
                ASSERT_EQ(darkness[j], clamp<std::int64_t>(quotient, -full_darkness, 2 * full_darkness))
                    << trial << ' ' << j;
            }
        }
    }
}

TEST(FitLight, FindsTheLightThatLevelsWereMadeIn) {
    std::int32_t levels[most_blur_samples];
    std::int32_t darkness[most_blur_samples];
    const BlurLight made{{45000, 46000}, {25000, 25500}};
    for (int j = 0; j < ean_13_plan.samples(); ++j) {
        darkness[j] = j % 2 == 0 ? 0 : 1000;  // with no slope of its own
        const LightAt at = light_at(ean_13_plan, made, j);
        levels[j] = at.white - static_cast<std::int32_t>(std::int64_t{at.dark} * darkness[j] / full_darkness);
    }
    BlurLight found{};
    ASSERT_TRUE(fit_light(ean_13_plan, levels, darkness, found));
    for (int side = 0; side < 2; ++side) {
        // The light of a half is not even: it is met at its middle, and what it changes by to both sides is
        // not explained.
        EXPECT_NEAR(found.white[side], made.white[side], made.white[side] / 200);
        EXPECT_NEAR(found.dark[side], made.dark[side], made.dark[side] / 100);
    }
    for (std::int32_t& level : levels) level = 60000 - level;
    const BlurLight before = found;
    EXPECT_FALSE(fit_light(ean_13_plan, levels, darkness, found));
    EXPECT_EQ(found.white[0], before.white[0]);
}

TEST(FallsTo, IsWhereAProfileCrossesALevelFirst) {
    const std::uint16_t profile[6] = {1000, 1000, 800, 400, 900, 100};
    EXPECT_EQ(falls_to({profile, 6}, 0, 1, 900), (1 << 16) + (1 << 15));
    EXPECT_EQ(falls_to({profile, 6}, 0, 1, 50), -1);
    EXPECT_EQ(falls_to({profile, 6}, 4, -1, 650), (3 << 16) + (1 << 15));
    EXPECT_EQ(falls_to({profile, 6}, 9, 1, 900), -1);
}

TEST(SceneFit, FindsPlaceSizeAndBlurOfLettersThatAreKnown) {
    test::BarCamera camera;
    camera.module = 1.8;
    camera.blur = 4.5;
    camera.bend = 0.02;
    const std::vector<std::uint16_t> profile = test::bar_profile(test::ean_modules("9780905705712"), camera);
    const std::uint8_t digits[13] = {9, 7, 8, 0, 9, 0, 5, 7, 0, 5, 7, 1, 2};
    std::uint8_t row[most_blur_letters];
    for (int i = 0; i < 12; ++i) row[i] = static_cast<std::uint8_t>(letter_of(ean_13_plan, digits, i));
    BlurScene scene{(20 << 16) + 50000, ((20 + 171) << 16) - 40000, 0, 3 << 16, even_light};
    std::int32_t levels[most_blur_samples];
    std::int32_t darkness[most_blur_samples];
    SceneFit fit(ean_13_plan, {profile.data(), static_cast<std::ptrdiff_t>(profile.size())}, row, levels,
                 darkness);
    const std::int64_t first = fit.improve(scene);
    for (int turn = 0; turn < 3; ++turn) fit.improve(scene);
    EXPECT_LE(fit.improve(scene), first);
    // Steps end at a 32nd of a module, 0.06 px, and what is left of one is made good by another.
    EXPECT_NEAR(scene.start / 65536.0, 20, 0.15);
    EXPECT_NEAR(scene.end / 65536.0, 20 + 171, 0.15);
    EXPECT_NEAR(scene.blur / 65536.0, 4.5, 0.25);
    EXPECT_NEAR(scene.bend / 65536.0, 0.02, 3.0 / 512);  // its steps end at a 512th
}

}  // namespace
}  // namespace fovea::detail
