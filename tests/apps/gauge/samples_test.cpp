// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gauge/samples.hpp>
#include <support/teaching.hpp>

namespace fovea::test {
namespace {

using namespace shapes;
using apps::find_samples;
using apps::Picture;
using apps::rule_from;
using apps::Samples;
using Notes = std::vector<std::string>;

constexpr Size wide{460, 250};

/// The plate beside another object.
Picture<Gray8> plate_beside(const Shape& other) {
    return picture_of(wide, {{plate(), 115, 120, 5}, {other, 350, 120, 0}}, back_light(), 501);
}
Samples samples_of(const Picture<Gray8>& picture, std::optional<bool> dark = {}) {
    return find_samples({picture}, {"a.png"}, dark);
}
/// A picture of one level.
Picture<Gray8> flat(Gray8 level) {
    Picture<Gray8> picture({60, 50});
    std::fill(picture.pixels.begin(), picture.pixels.end(), level);
    return picture;
}
std::int64_t pixels_of(const apps::Sample& part) { return part.region.moments.area(); }

TEST(Samples, FindsBrightnessAndHolesByItself) {
    const Samples dark = samples_of(lying(plate(), 20, 502));
    ASSERT_EQ(dark.parts.size(), 1u);
    EXPECT_TRUE(dark.dark);
    EXPECT_EQ(dark.parts[0].holes.size(), 2u);
    EXPECT_EQ(dark.pose, PoseRule::outline);
    EXPECT_EQ(dark.notes, Notes());
    const Samples bright = samples_of(lying(rectangle(150, 60), 20, 503, front_light()));
    ASSERT_EQ(bright.parts.size(), 1u);
    EXPECT_FALSE(bright.dark);
    EXPECT_EQ(bright.pose, PoseRule::region);
    EXPECT_EQ(bright.notes, Notes());
}

TEST(Samples, TakesTheBrightnessItIsTold) {
    // Of the dark plate, the large hole is what is bright and does not touch the border.
    const Samples holes = samples_of(lying(plate(), 20, 502), false);
    ASSERT_EQ(holes.parts.size(), 1u);
    EXPECT_NEAR(static_cast<double>(pixels_of(holes.parts[0])), pi * 15 * 15, 20);
    EXPECT_FALSE(holes.dark);
}

TEST(Samples, WarnsThatItMayHaveTakenTheHolesOfAPartThatTouchesTheBorder) {
    const Shape part = without(rectangle(180, 100), disc(30), 40, 0);
    const Picture<Gray8> touching = picture_of(one_part_size, {{part, 80, 125, 0}}, back_light(), 504);
    const Samples doubtful = samples_of(touching);
    ASSERT_EQ(doubtful.parts.size(), 1u);
    EXPECT_FALSE(doubtful.dark);
    EXPECT_EQ(
        doubtful.notes,
        Notes{"most of the border is as bright as the part; if that is not the part, give --part dark"});
    // Who said bright means it.
    EXPECT_EQ(samples_of(touching, false).notes, Notes());
}

TEST(Samples, SayWhichPictureGaveNone) {
    const Samples samples =
        find_samples({lying(plate(), 0, 509), lying(disc(20), 0, 510)}, {"good.png", "small.png"}, {});
    EXPECT_EQ(samples.parts.size(), 1u);
    EXPECT_EQ(samples.problem, "");
    EXPECT_EQ(samples.notes, Notes{"small.png: not a sample: nothing in it is about as large as the part"});
}

TEST(Samples, SaysWhyAPictureHasNoPart) {
    EXPECT_EQ(samples_of(flat(90)).problem,
              "no part found: it must lie whole in the picture, on a ground of another brightness");
    EXPECT_EQ(samples_of(flat(90)).notes, Notes{"a.png: no part found: all pixels are alike"});
    Scene faint = back_light();
    faint.dark = 205;
    faint.bright = 214;
    faint.noise = 0;
    EXPECT_EQ(samples_of(lying(plate(), 0, 506, faint)).notes,
              Notes{"a.png: no part found: part and ground differ by 9 grey levels alone"});
    const Picture<Gray8> cut =
        picture_of(one_part_size, {{rectangle(180, 70), 60, 120, 0}}, back_light(), 507);
    EXPECT_EQ(samples_of(cut).notes,
              Notes{"a.png: no part found: nothing in it is large enough and away from its border"});
    EXPECT_NE(samples_of(cut).problem, "");
}

TEST(Samples, GoesOnWithTheOtherPicturesWhenOneHasNoPart) {
    const Samples samples = find_samples({flat(200), lying(plate(), 0, 508)}, {"flat.png", "good.png"}, {});
    EXPECT_EQ(samples.problem, "");
    EXPECT_EQ(samples.parts.size(), 1u);
    EXPECT_EQ(samples.notes, Notes{"flat.png: no part found: all pixels are alike"});
}

TEST(Samples, LeaveOutWhatEnclosesLessThanThreeQuartersOfTheLargest) {
    const Samples alike = samples_of(plate_beside(rectangle(150, 70)));
    EXPECT_EQ(alike.parts.size(), 2u);
    const Samples smaller = samples_of(plate_beside(rectangle(120, 70)));
    ASSERT_EQ(smaller.parts.size(), 1u);
    EXPECT_EQ(smaller.parts[0].holes.size(), 2u);
    ASSERT_EQ(smaller.other_areas.size(), 1u);
    EXPECT_NEAR(static_cast<double>(smaller.other_areas[0]), 120 * 70, 190);
}

// ---- The rule ----------------------------------------------------------------------------------

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

}  // namespace
}  // namespace fovea::test
