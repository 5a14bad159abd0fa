// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gauge/explain.hpp>
#include <gauge/gauge_command.hpp>
#include <support/recipes.hpp>
#include <support/teaching.hpp>

namespace fovea::test {
namespace {

using apps::explain;
using apps::Picture;

std::vector<PartResult> gauged(const Picture<Gray8>& picture, const Recipe& recipe) {
    std::vector<PartResult> parts;
    static_cast<void>(apps::gauge_picture(picture, recipe, parts));
    return parts;
}

/// The probe of a width along the axis of a bar, so far to both sides, is drawn at the left border.
bool draws_probe_that_reaches(std::int64_t far) {
    const Picture<Gray8> picture =
        picture_of({100, 80}, {{shapes::rectangle(60, 30), 50, 40, 0}}, back_light(), 1001);
    Recipe recipe;
    recipe.locate.orientation = OrientationRule::symmetric;
    Feature feature;
    set_name(feature.name, "w");
    feature.from.x = -far * 1000000;
    feature.to.x = far * 1000000;
    EXPECT_EQ(recipe.features.push(feature), Status::ok);
    const Picture<Rgb888> drawn = explain(picture, recipe, gauged(picture, recipe));
    EXPECT_EQ(drawn.size, (Size{400, 320}));
    for (int y = 155; y < 170; ++y)
        if (drawn.view()(0, y) == apps::detail::colour_unmeasured) return true;
    return false;
}

TEST(Explain, DrawsWhatIsSeenOfAProbeThatBeginsFarOutside) {
    EXPECT_FALSE(draws_probe_that_reaches(40));
    EXPECT_TRUE(draws_probe_that_reaches(60));
    // Magnified by four, these are beyond 32767 pixels.
    EXPECT_TRUE(draws_probe_that_reaches(8200));
    EXPECT_TRUE(draws_probe_that_reaches(16000));
    // No image reaches so far.
    EXPECT_FALSE(draws_probe_that_reaches(100000));
}

TEST(Explain, DrawsRandomRecipesOverAPlate) {
    const Picture<Gray8> picture = picture_of(
        {100, 80}, {{shapes::without(shapes::rectangle(60, 30), shapes::disc(6), 12, 0), 50, 40, 5}},
        back_light(), 1002);
    Random random(1003);
    int parts = 0;
    for (int i = 0; i < 80; ++i) {
        Recipe recipe = random_recipe(random);
        recipe.locate.threshold = ThresholdRule::otsu;
        recipe.locate.area_min = 1;
        recipe.locate.area_max = LocateRule().area_max;
        recipe.locate.opening = 1;
        const std::vector<PartResult> found = gauged(picture, recipe);
        parts += static_cast<int>(found.size());
        EXPECT_EQ(explain(picture, recipe, found).size, (Size{400, 320}));
    }
    EXPECT_GT(parts, 60);
}

}  // namespace
}  // namespace fovea::test
