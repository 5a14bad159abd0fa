// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include <fovea/base/random.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/decision/recipe_range.hpp>
#include <support/recipes.hpp>

namespace fovea::test {
namespace {

TEST(Recipe, ReadsANameUpToItsZeroOrItsEnd) {
    const char empty[4] = {};
    const char short_name[4] = {'a', 'b', '\0', 'd'};
    const char full[4] = {'a', 'b', 'c', 'd'};
    EXPECT_EQ(name_text(empty), "");
    EXPECT_EQ(name_text(short_name), "ab");
    EXPECT_EQ(name_text(full), "abcd");
}

TEST(Recipe, TellsTheHeightOfAPixelInWidths) {
    EXPECT_EQ(aspect_of(Scale()), PixelAspect::from_int(1));
    EXPECT_EQ(aspect_of({LengthUnit::millimetre, 20000, 30000}), PixelAspect::from_ratio(3, 2));
    EXPECT_EQ(aspect_of({LengthUnit::millimetre, max_units_per_pixel, max_units_per_pixel / 4}),
              PixelAspect::from_ratio(1, 4));
}

TEST(RecipeRange, TakesEveryRecipeThatAFileCanHold) {
    Random random(602);
    for (int i = 0; i < 300; ++i) {
        const Recipe recipe = random_recipe(random);
        EXPECT_TRUE(detail::rule_in_range(recipe.locate)) << i;
        for (const Feature& feature : recipe.features) EXPECT_TRUE(detail::feature_in_range(feature)) << i;
    }
}

template <class Change>
bool rule_with(Change change) {
    LocateRule rule;
    change(rule);
    return detail::rule_in_range(rule);
}

TEST(RecipeRange, RefusesARuleForEveryFieldThatIsOutside) {
    EXPECT_TRUE(rule_with([](LocateRule&) {}));
    EXPECT_TRUE(rule_with([](LocateRule& r) { r.ends.ttt = Ratio::from_int(-4); }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.threshold = static_cast<ThresholdRule>(3); }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.pose = static_cast<PoseRule>(2); }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.orientation = static_cast<OrientationRule>(4); }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.symmetry_order = min_symmetry_order - 1; }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.symmetry_order = max_symmetry_order + 1; }));
    const auto opened = [](PoseRule pose) {
        return rule_with([&](LocateRule& r) {
            r.orientation = OrientationRule::rotational;
            r.opening = 3;
            r.pose = pose;
        });
    };
    EXPECT_TRUE(opened(PoseRule::outline));
    EXPECT_FALSE(opened(PoseRule::region));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.dark_quantile = -1; }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.bright_quantile = 1000001; }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.opening = 2; }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.opening = -1; }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.opening = max_element_side + 2; }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.area_min = -1; }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.area_max = r.area_min - 1; }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.hole_area_min = -1; }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.ends.sss = Ratio::from_raw(4 * Ratio::one + 1); }));
    EXPECT_FALSE(rule_with([](LocateRule& r) { r.ends.stt = Ratio::from_raw(-2147483647 - 1); }));
}

template <class Change>
bool feature_with(Change change) {
    Feature feature;
    change(feature);
    return detail::feature_in_range(feature);
}

TEST(RecipeRange, RefusesAFeatureForEveryFieldThatIsOutside) {
    constexpr std::int64_t too_far = max_part_coordinate + 1;
    EXPECT_TRUE(feature_with([](Feature&) {}));
    EXPECT_TRUE(feature_with([](Feature& f) { f.from.x = -max_part_coordinate; }));
    for (PartPoint Feature::*const place :
         {&Feature::from, &Feature::to, &Feature::second_from, &Feature::second_to, &Feature::centre}) {
        EXPECT_FALSE(feature_with([&](Feature& f) { (f.*place).x = too_far; }));
        EXPECT_FALSE(feature_with([&](Feature& f) { (f.*place).y = -too_far; }));
    }
    for (std::int64_t Feature::*const length : {&Feature::radius, &Feature::search}) {
        EXPECT_FALSE(feature_with([&](Feature& f) { f.*length = -1; }));
        EXPECT_FALSE(feature_with([&](Feature& f) { f.*length = too_far; }));
    }
    EXPECT_FALSE(feature_with([](Feature& f) { f.lines = 0; }));
    EXPECT_FALSE(feature_with([](Feature& f) { f.lines = max_probe_lines + 1; }));
    EXPECT_FALSE(feature_with([](Feature& f) { f.probes = 2; }));
    EXPECT_FALSE(feature_with([](Feature& f) { f.probes = Feature::max_probes + 1; }));
    EXPECT_FALSE(feature_with([](Feature& f) { f.smoothing = 0; }));
    EXPECT_FALSE(feature_with([](Feature& f) { f.smoothing = max_probe_smoothing + 1; }));
    EXPECT_FALSE(feature_with([](Feature& f) { f.contrast_min = -1; }));
    EXPECT_FALSE(feature_with([](Feature& f) { f.contrast_min = 256; }));
    EXPECT_FALSE(feature_with([](Feature& f) { f.tolerance.nominal.millionths = -too_far; }));
    EXPECT_FALSE(feature_with([](Feature& f) { f.tolerance.minus.millionths = -1; }));
    EXPECT_FALSE(feature_with([](Feature& f) { f.tolerance.plus.millionths = too_far; }));
}

}  // namespace
}  // namespace fovea::test
