// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gauge/explain.hpp>
#include <support/commands.hpp>
#include <support/recipes.hpp>
#include <support/teaching.hpp>

namespace fovea::test {
namespace {

using apps::explain;
using apps::Picture;

std::vector<PartResult> gauged(const Picture<Gray8>& picture, const Recipe& recipe) {
    std::vector<PartResult> parts;
    static_cast<void>(gauge_parts(picture, recipe, parts));
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
        // It is not measured there, for it leaves the image.
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

// ---- What it says with colours and labels -------------------------------------------------------

/// True if a label with this text stands in a picture, in this colour.
bool shows(const Picture<Rgb888>& drawn, const std::string& text, Rgb888 colour) {
    Picture<Rgb888> label(label_size(apps::span_of(text)));
    EXPECT_EQ(draw_label(label.view(), {0, 0}, apps::span_of(text), colour, apps::detail::colour_paper),
              Status::ok);
    for (int top = 0; top + label.size.height <= drawn.size.height; ++top)
        for (int left = 0; left + label.size.width <= drawn.size.width; ++left) {
            bool same = true;
            for (int y = 0; same && y < label.size.height; ++y)
                for (int x = 0; same && x < label.size.width; ++x)
                    same = label.view()(x, y) == drawn.view()(left + x, top + y);
            if (same) return true;
        }
    return false;
}
bool has(const Picture<Rgb888>& drawn, Point at, Rgb888 colour) { return drawn.view()(at.x, at.y) == colour; }

using apps::detail::colour_bad;
using apps::detail::colour_ok;
using apps::detail::colour_probe;
using apps::detail::colour_unmeasured;

/// 60 x 30 with a hole of radius 6, in a picture that is drawn four times as large.
Picture<Gray8> bar() {
    return picture_of({100, 80},
                      {{shapes::without(shapes::rectangle(60, 30), shapes::disc(6), 12, 0), 50, 40, 0}},
                      back_light(), 1004);
}
/// Lying as it lies: the frame is along the rows, its origin at about (49.1, 40).
Recipe recipe_with(const std::vector<Feature>& features) {
    Recipe recipe;
    recipe.locate.orientation = OrientationRule::none;
    recipe.locate.pose = PoseRule::outline;
    for (const Feature& feature : features) EXPECT_EQ(recipe.features.push(feature), Status::ok);
    return recipe;
}
Feature feature_of(const std::string& name, FeatureKind kind, std::int64_t nominal) {
    Feature feature;
    set_name(feature.name, name);
    feature.kind = kind;
    feature.tolerance = {{nominal * 1000000}, {500000}, {500000}};
    return feature;
}
PartPoint at(std::int64_t x, std::int64_t y) { return {x * 1000000, y * 1000000}; }
/// A pixel of the image in the middle of its square of the drawn one.
Point drawn_at(int x, int y) { return {4 * x + 1, 4 * y + 1}; }

Picture<Rgb888> explained(const Recipe& recipe) {
    const Picture<Gray8> picture = bar();
    return explain(picture, recipe, gauged(picture, recipe));
}
int count_of(const Picture<Rgb888>& drawn, Rgb888 colour) {
    return static_cast<int>(std::count(drawn.pixels.begin(), drawn.pixels.end(), colour));
}

TEST(Explain, DrawsTheProbeOfAFeatureWithoutAValueInTheColourOfNotMeasured) {
    Feature width = feature_of("w", FeatureKind::width, 30);
    width.from = at(-10, -25);
    width.to = at(-10, 25);
    const Picture<Rgb888> good = explained(recipe_with({width}));
    EXPECT_GT(count_of(good, colour_probe), 20);
    EXPECT_EQ(count_of(good, colour_unmeasured), 0);
    // Beside the part.
    width.from = at(-10, 20);
    width.to = at(20, 20);
    const Picture<Rgb888> bad = explained(recipe_with({width}));
    EXPECT_EQ(count_of(bad, colour_probe), 0);
    for (int x = 45; x < 65; ++x) {
        bool orange = false;
        for (int y = 235; y < 250; ++y) orange = orange || has(bad, {4 * x, y}, colour_unmeasured);
        EXPECT_TRUE(orange) << x;
    }
    EXPECT_TRUE(shows(bad, "w NOT MEASURED", colour_unmeasured));
}

TEST(Explain, DrawsACircleThatIsFartherThanAnyImage) {
    Feature hole = feature_of("h", FeatureKind::hole_diameter, 12);
    hole.centre = at(-23000, -23000);
    hole.search = 9000000000;
    EXPECT_EQ(explained(recipe_with({hole})).size, (Size{400, 320}));
}

TEST(Explain, CirclesWhereAHoleIsNotFound) {
    for (const FeatureKind kind : {FeatureKind::hole_diameter, FeatureKind::position}) {
        Feature hole = feature_of("h", kind, 12);
        hole.centre = at(-15, 0);
        hole.search = 5000000;
        const Recipe recipe = recipe_with({hole});
        const std::vector<PartResult> parts = gauged(bar(), recipe);
        ASSERT_EQ(parts.size(), 1u);
        EXPECT_NE(parts[0].features[0].status, Status::ok);
        const Picture<Rgb888> drawn = explained(recipe);
        // The part's middle is (50, 40): the circle about (35, 40) passes (30, 40), and its centre is
        // crossed.
        bool rim = false;
        for (int x = 117; x < 126; ++x) rim = rim || has(drawn, {x, 161}, colour_unmeasured);
        EXPECT_TRUE(rim);
        bool centre = false;
        for (int x = 138; x < 146; ++x) centre = centre || has(drawn, {x, 161}, colour_unmeasured);
        EXPECT_TRUE(centre);
        EXPECT_TRUE(shows(drawn, "h NOT MEASURED", colour_unmeasured));
    }
}

TEST(Explain, ShowsTheRingInWhichADiameterIsNotFound) {
    Feature circle = feature_of("c", FeatureKind::diameter, 12);
    circle.centre = at(-15, 0);
    circle.radius = 8000000;
    circle.search = 2000000;
    const Picture<Rgb888> drawn = explained(recipe_with({circle}));
    EXPECT_EQ(count_of(drawn, colour_ok), 0);
    for (const int radius : {6, 10}) {
        bool rim = false;
        for (int y = -4; y <= 4; ++y)
            rim = rim || has(drawn, {drawn_at(35, 40).x, drawn_at(35, 40 + radius).y + y}, colour_unmeasured);
        EXPECT_TRUE(rim) << radius;
    }
}

TEST(Explain, PutsTheLabelOfAnAngleThatFailsBesideItsEdges) {
    Feature angle = feature_of("a", FeatureKind::angle, 90);
    angle.from = at(-20, 0);
    angle.to = at(-2, 0);
    angle.second_from = at(0, 2);
    angle.second_to = at(0, 12);
    angle.search = 1000000;
    const Picture<Rgb888> drawn = explained(recipe_with({angle}));
    EXPECT_EQ(count_of(drawn, colour_probe), 0);
    EXPECT_TRUE(has(drawn, {4 * 40 + 2, 161}, colour_unmeasured) ||
                has(drawn, {4 * 40 + 2, 162}, colour_unmeasured));
    ASSERT_TRUE(shows(drawn, "a NOT MEASURED", colour_unmeasured));
    // Its text is not far from the corner at (49, 41) of the image.
    Picture<Rgb888> corner({200, 100});
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 200; ++x) corner.view()(x, y) = drawn.view()(130 + x, 115 + y);
    EXPECT_TRUE(shows(corner, "a NOT MEASURED", colour_unmeasured));
}

TEST(Explain, ShowsTheHoleCountBelowTheTitleInTheColourOfItsVerdict) {
    const Picture<Rgb888> good = explained(recipe_with({feature_of("holes", FeatureKind::hole_count, 1)}));
    EXPECT_TRUE(shows(good, "part 0 OK", colour_ok));
    EXPECT_TRUE(shows(good, "holes 1", colour_ok));
    const Picture<Rgb888> bad = explained(recipe_with({feature_of("holes", FeatureKind::hole_count, 3)}));
    EXPECT_TRUE(shows(bad, "part 0 NOT OK", colour_bad));
    EXPECT_TRUE(shows(bad, "holes 1 LOW (least 2.5)", colour_bad));
}

TEST(Explain, SaysWhyAPartIsNotJudged) {
    Recipe recipe = recipe_with({feature_of("holes", FeatureKind::hole_count, 0)});
    recipe.locate.orientation = OrientationRule::symmetric;
    const Picture<Gray8> picture = picture_of({100, 80}, {{shapes::disc(25), 50, 40}}, back_light(), 1005);
    const Picture<Rgb888> drawn = explain(picture, recipe, gauged(picture, recipe));
    EXPECT_TRUE(shows(drawn, "part 0 NOT JUDGED", colour_unmeasured));
    EXPECT_TRUE(shows(drawn, "no clear axis", colour_unmeasured));
}

TEST(Explain, FramesWhatWasLeftOut) {
    using shapes::rectangle;
    const Picture<Gray8> picture = picture_of({200, 160},
                                              {{rectangle(60, 30), 60, 40, 0},
                                               {rectangle(60, 30), 190, 40, 0},
                                               {rectangle(120, 30), 80, 100, 0},
                                               {rectangle(20, 15), 80, 140, 0}},
                                              back_light(), 1006);
    Recipe recipe = recipe_with({feature_of("holes", FeatureKind::hole_count, 0)});
    recipe.locate.area_max = 2500;
    recipe.locate.area_min = 500;
    const std::vector<PartResult> parts = gauged(picture, recipe);
    ASSERT_EQ(parts.size(), 1u);
    const apps::LeftOut left_out = apps::left_out_of(picture, recipe.locate);
    const Picture<Rgb888> drawn = explain(picture, recipe, parts, left_out);
    EXPECT_TRUE(shows(drawn, "at the border", colour_unmeasured));
    EXPECT_TRUE(shows(drawn, "too large", colour_unmeasured));
    EXPECT_TRUE(shows(drawn, "too small", colour_unmeasured));
    for (const Region& region :
         {left_out.at_border.at(0), left_out.too_small.at(0), left_out.too_large.at(0)}) {
        EXPECT_TRUE(has(drawn, {4 * region.box.x, 4 * region.box.y}, colour_unmeasured));
        EXPECT_TRUE(has(drawn, {4 * region.box.x, 4 * region.box.y + 40}, colour_unmeasured));
    }
    // Nobody looked for it.
    EXPECT_FALSE(shows(explain(picture, recipe, parts), "too large", colour_unmeasured));
}

TEST(Explain, WritesWhyThereIsNoPartIntoThePicture) {
    const Picture<Gray8> picture = bar();
    const Picture<Rgb888> drawn = explain(picture, recipe_with({}), {}, {},
                                          "no part found: the picture may be empty; is the light on?");
    EXPECT_TRUE(shows(drawn, "no part found: the picture may be empty", colour_unmeasured));
    Picture<Rgb888> corner({300, 20});
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 300; ++x) corner.view()(x, y) = drawn.view()(x, y);
    EXPECT_TRUE(shows(corner, "no part found: the picture may be empty", colour_unmeasured));
    // On two lines where it is too long for one: 400 pixels are 64 characters.
    const std::string words = "word word word word word word word word word word word word";
    EXPECT_TRUE(shows(explain(picture, recipe_with({}), {}, {}, words + " word word"), words + " word\nword",
                      colour_unmeasured));
}

TEST(Explain, LeavesTheValuesThatAreOkToTheirLinesInACrowd) {
    std::vector<Lying> lying;
    for (int i = 0; i < 60; ++i)
        lying.push_back({shapes::rectangle(60, 30), 45.0 + i % 10 * 90, 30.0 + i / 10 * 50, 0});
    const Picture<Gray8> picture = picture_of({960, 310}, lying, back_light(), 1007);
    Feature width = feature_of("height_of_part", FeatureKind::width, 30);
    width.from = at(0, -20);
    width.to = at(0, 20);
    Recipe recipe = recipe_with({width});
    recipe.locate.area_min = 500;
    const std::vector<PartResult> parts = gauged(picture, recipe);
    ASSERT_EQ(parts.size(), 60u);
    const std::string text = apps::human_feature(parts[0].features[0], recipe.features[0], recipe.scale);
    EXPECT_FALSE(shows(explain(picture, recipe, parts), text, colour_ok));
    EXPECT_TRUE(shows(explain(picture, recipe, {parts[0]}), text, colour_ok));
    // What is wrong is said in any crowd.
    recipe.features[0].tolerance.nominal.millionths = 40000000;
    const std::vector<PartResult> wrong = gauged(picture, recipe);
    EXPECT_TRUE(shows(explain(picture, recipe, wrong),
                      apps::human_feature(wrong[0].features[0], recipe.features[0], recipe.scale),
                      colour_bad));
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
