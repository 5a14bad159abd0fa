// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gauge/sample_rule.hpp>
#include <support/teaching.hpp>

namespace fovea::test {
namespace {

using namespace shapes;
using apps::Picture;
using apps::rule_from;
using apps::Samples;
using Notes = std::vector<std::string>;

TEST(RuleFrom, AllowsAQuarterMoreAndLessThanTheParts) {
    const Samples samples = samples_of(lying(plate(), 0, 509));
    const std::int64_t area = pixels_of(samples.parts.at(0));
    const LocateRule rule = rule_from(samples, Scale());
    EXPECT_EQ(rule.area_min, area * 3 / 4);
    EXPECT_EQ(rule.area_max, area * 5 / 4);
    EXPECT_TRUE(rule.dark_part);
    EXPECT_EQ(rule.orientation, OrientationRule::full);
}

TEST(RuleFrom, MovesTheGateHalfwayToAnObjectThatIsNearlyAsLarge) {
    // The plate encloses 12300 px but has 11339 without its holes; the bar has 8820, more than three quarters
    // of that.
    const Samples samples = samples_of(plate_beside(rectangle(126, 70)));
    ASSERT_EQ(samples.parts.size(), 1u);
    ASSERT_EQ(samples.other_areas.size(), 1u);
    const std::int64_t area = pixels_of(samples.parts[0]);
    const std::int64_t other = samples.other_areas[0];
    ASSERT_GT(other, area * 3 / 4);
    const LocateRule rule = rule_from(samples, Scale());
    EXPECT_EQ(rule.area_min, (area + other + 1) / 2);
    EXPECT_EQ(rule.area_max, area * 5 / 4);
    const apps::Taught taught = taught_from({plate_beside(rectangle(126, 70))});
    EXPECT_EQ(taught.notes, Notes());
    EXPECT_EQ(verdicts_of(plate_beside(rectangle(126, 70)), taught.recipe), "ok");
}

TEST(RuleFrom, MovesTheUpperGateToAnObjectThatHasMorePixelsButEnclosesLess) {
    // A ring encloses much and has few pixels.
    const Picture<Gray8> picture =
        picture_of(wide, {{ring(80, 55), 115, 120, 0}, {rectangle(150, 80), 340, 120, 0}}, back_light(), 510);
    const Samples samples = samples_of(picture);
    ASSERT_EQ(samples.parts.size(), 1u);
    ASSERT_EQ(samples.other_areas.size(), 1u);
    const std::int64_t area = pixels_of(samples.parts[0]);
    ASSERT_GT(samples.other_areas[0], area);
    const LocateRule rule = rule_from(samples, Scale());
    EXPECT_EQ(rule.area_max, (area + samples.other_areas[0]) / 2);
    EXPECT_EQ(rule.area_min, area * 3 / 4);
}

TEST(RuleFrom, TakesThePartsOfLeastAndMostAreaForItsGate) {
    const Samples samples = samples_of(plate_beside(rectangle(150, 70)));
    ASSERT_EQ(samples.parts.size(), 2u);
    const std::int64_t least = std::min(pixels_of(samples.parts[0]), pixels_of(samples.parts[1]));
    const std::int64_t most = std::max(pixels_of(samples.parts[0]), pixels_of(samples.parts[1]));
    ASSERT_LT(least, most);
    const LocateRule rule = rule_from(samples, Scale());
    EXPECT_EQ(rule.area_min, least * 3 / 4);
    EXPECT_EQ(rule.area_max, most * 5 / 4);
}

TEST(RuleFrom, TakesHolesBelowAThreeThousandthOfThePartForDirt) {
    // 40000 px: holes count from 13 px on. One of the radius 1.5 has about 7, one of 3.5 about 38.
    const Shape dirty = without(without(rectangle(200, 200), disc(1.5), 40, 30), disc(3.5), -50, -20);
    const Picture<Gray8> picture = lying(dirty, 0, 511);
    const Samples samples = samples_of(picture);
    ASSERT_EQ(samples.parts.size(), 1u);
    EXPECT_EQ(samples.parts[0].holes.size(), 1u);
    EXPECT_EQ(samples.parts[0].region.holes, 1);
    EXPECT_EQ(samples.parts[0].region.hole_area, samples.parts[0].holes.at(0).moments.area());
    EXPECT_EQ(rule_from(samples, Scale()).hole_area_min, pixels_of(samples.parts[0]) / 3000);
    const apps::Taught taught = taught_from({picture});
    EXPECT_EQ(nominal_of(taught.recipe, "holes"), 1);
    EXPECT_EQ(verdicts_of(picture, taught.recipe), "ok");
}

TEST(RuleFrom, TellsEndsApartOnlyWhereEverySampleAgrees) {
    const Shape bar = rectangle(160, 60);
    EXPECT_EQ(rule_from(samples_of(lying(bar, 30, 512)), Scale()).orientation, OrientationRule::symmetric);
    EXPECT_EQ(rule_from(samples_of(lying(disc(50), 30, 513)), Scale()).orientation, OrientationRule::none);
    const Picture<Gray8> both =
        picture_of(wide, {{plate(), 115, 120, 5}, {rectangle(175, 70), 345, 120, 0}}, back_light(), 514);
    const Samples samples = samples_of(both);
    ASSERT_EQ(samples.parts.size(), 2u);
    const LocateRule rule = rule_from(samples, Scale());
    EXPECT_EQ(rule.orientation, OrientationRule::symmetric);
    EXPECT_TRUE(ends_disagree(samples, rule, Scale()));
    EXPECT_FALSE(ends_disagree(samples_of(lying(bar, 30, 512)), rule, Scale()));
    // Of a round and a long sample, one has no axis.
    const Picture<Gray8> round_and_long =
        picture_of(wide, {{rectangle(160, 50), 115, 120, 5}, {disc(50), 345, 120, 0}}, back_light(), 515);
    EXPECT_EQ(rule_from(samples_of(round_and_long), Scale()).orientation, OrientationRule::none);
}

TEST(RuleFrom, FindsTheOrderOfWhatRepeatsItself) {
    struct Example {
        const char* name;
        Shape shape;
        int order;
        PoseRule pose;
    };
    const Example examples[] = {
        {"triangle", polygon(3, 40), 3, PoseRule::region},
        {"square", rectangle(120, 120), 4, PoseRule::region},
        {"star", star(), 5, PoseRule::region},
        {"nut", without(polygon(6, 60), disc(30), 0, 0), 6, PoseRule::outline},
        {"hexagon with 3 holes", drilled(polygon(6, 60), 3, 36, 9), 3, PoseRule::region},
        {"square with 4 holes", drilled(rectangle(120, 120), 4, 40, 9), 4, PoseRule::outline},
        {"flange of 5", flange(5), 5, PoseRule::region},
        {"flange of 8", flange(8), 8, PoseRule::region}};
    std::uint64_t seed = 516;
    for (const Example& example : examples) {
        SCOPED_TRACE(example.name);
        const LocateRule rule = rule_from(samples_of(lying(example.shape, 17, seed++)), Scale());
        EXPECT_EQ(rule.orientation, OrientationRule::rotational);
        EXPECT_EQ(rule.symmetry_order, example.order);
        EXPECT_EQ(rule.pose, example.pose);
    }
}

TEST(RuleFrom, TakesNoNickForSymmetry) {
    const Shape nicked = without(disc(60), rectangle(10, 8), 58, 0);
    const LocateRule rule = rule_from(samples_of(lying(nicked, 17, 523)), Scale());
    EXPECT_EQ(rule.orientation, OrientationRule::none);
    EXPECT_EQ(rule.pose, PoseRule::region);
    // Nor the symmetry that only one of two parts has.
    const Picture<Gray8> both =
        picture_of(wide, {{rectangle(100, 100), 115, 120, 5}, {disc(56), 345, 120, 0}}, back_light(), 524);
    EXPECT_EQ(samples_of(both).parts.size(), 2u);
    EXPECT_EQ(rule_from(samples_of(both), Scale()).orientation, OrientationRule::none);
}

}  // namespace
}  // namespace fovea::test
