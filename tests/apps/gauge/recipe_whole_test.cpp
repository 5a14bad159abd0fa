// SPDX-License-Identifier: MIT
//
// Mistakes that single keys do not show: what must stand beside what in a recipe.
#include <gtest/gtest.h>

#include <string>

#include <support/recipe_problem.hpp>

namespace fovea::test {
namespace {

TEST(RecipeMistakes, OfKeysThatContradictEachOther) {
    EXPECT_EQ(problem_of(in_locate("area_min = 10\narea_max = 9")), "4:1: area_min is above area_max");
    EXPECT_EQ(problem_of(in_locate("area_max = 9\narea_min = 10")), "4:1: area_min is above area_max");
    EXPECT_EQ(problem_of(in_locate("area_max = 9")), "3:1: area_min is above area_max");
    EXPECT_EQ(problem_of(in_locate("area_min = 10\narea_max = 10")), "");
    EXPECT_EQ(problem_of(in_locate("opening = 4")),
              "3:1: opening: expected an odd number, so that it has a middle");
    EXPECT_EQ(problem_of(in_scale("per_pixel_x = 0.1\nper_pixel_y = 0.400001")),
              "4:1: per_pixel_x and per_pixel_y differ by more than four times");
    EXPECT_EQ(problem_of(in_scale("per_pixel_x = 0.400001\nper_pixel_y = 0.1")),
              "4:1: per_pixel_x and per_pixel_y differ by more than four times");
    EXPECT_EQ(problem_of(in_scale("per_pixel_x = 0.1\nper_pixel_y = 0.4")), "");
}

TEST(RecipeMistakes, OfAScaleThatIsHalfGiven) {
    // A length in mm of a pixel that nobody gave would be 1 mm, silently.
    EXPECT_EQ(problem_of(in_scale("unit = \"mm\"")),
              "3:1: [scale] lacks per_pixel_x: how long a pixel is in mm");
    EXPECT_EQ(problem_of(in_scale("unit = \"mm\"\nper_pixel_x = 0.1")),
              "4:1: [scale] lacks per_pixel_y: how long a pixel is in mm");
    EXPECT_EQ(problem_of(in_scale("per_pixel_y = 1.5")),
              "3:1: [scale] lacks per_pixel_x: how long a pixel is in px");
    EXPECT_EQ(problem_of(in_scale("unit = \"px\"")), "");
}

TEST(RecipeMistakes, OfSymmetry) {
    EXPECT_EQ(problem_of(in_locate("orientation = \"rotational\"\nsymmetry_order = 6")), "");
    EXPECT_EQ(problem_of(in_locate("orientation = \"rotational\"")),
              "3:1: [locate] lacks symmetry_order: in how many directions the part looks the same");
    EXPECT_EQ(problem_of(in_locate("symmetry_order = 6")),
              "3:1: symmetry_order has no meaning without orientation = \"rotational\"");
    EXPECT_EQ(problem_of(in_locate("orientation = \"rotational\"\nsymmetry_order = 2")),
              "4:18: symmetry_order: expected a whole number from 3 to 12, not 2");
    const std::string opened = "orientation = \"rotational\"\nsymmetry_order = 6\nopening = 3\n";
    EXPECT_EQ(problem_of(in_locate(opened)),
              "5:1: orientation = \"rotational\" with an opening needs pose = \"outline\"");
    EXPECT_EQ(problem_of(in_locate(opened + "pose = \"outline\"")), "");
}

TEST(RecipeMistakes, OfKeysWithoutMeaningBesideTheThreshold) {
    EXPECT_EQ(problem_of(in_locate("level = 90")), "3:1: level has no meaning without threshold = \"fixed\"");
    EXPECT_EQ(problem_of(in_locate("threshold = \"fixed\"\ndark_quantile = 0.1")),
              "4:1: dark_quantile has no meaning without threshold = \"quantile\"");
    EXPECT_EQ(problem_of(in_locate("bright_quantile = 0.9")),
              "3:1: bright_quantile has no meaning without threshold = \"quantile\"");
    // The ends may stay when the orientation is changed.
    EXPECT_EQ(problem_of(in_locate("orientation = \"symmetric\"\nends = [0.1, 0, 0, 0]")), "");
    EXPECT_EQ(problem_of(in_locate("ends = [0, 0, 0, 0]")), "");
}

}  // namespace
}  // namespace fovea::test
