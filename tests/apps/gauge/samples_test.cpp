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
using apps::Picture;
using apps::Samples;
using Notes = std::vector<std::string>;

/// A picture of one level.
Picture<Gray8> flat(Gray8 level) {
    Picture<Gray8> picture({60, 50});
    std::fill(picture.pixels.begin(), picture.pixels.end(), level);
    return picture;
}

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
        samples_in({lying(plate(), 0, 509), lying(disc(20), 0, 510)}, {"good.png", "small.png"});
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
    const Samples samples = samples_in({flat(200), lying(plate(), 0, 508)}, {"flat.png", "good.png"});
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

}  // namespace
}  // namespace fovea::test
