// SPDX-License-Identifier: MIT
//
// Teaching parts without a longest axis: what is the same in several directions, and what has none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <support/teaching.hpp>

namespace fovea::test {
namespace {

using namespace shapes;
using apps::Picture;
using apps::Taught;
using Names = std::vector<std::string>;

TEST(TeachSymmetry, MeasuresASquareHoweverItLies) {
    const Picture<Gray8> good = lying(rectangle(120, 120), 7, 428);
    const Recipe recipe = recipe_of(taught_from({good}));
    EXPECT_EQ(recipe.locate.orientation, OrientationRule::rotational);
    EXPECT_EQ(recipe.locate.symmetry_order, 4);
    EXPECT_EQ(feature_names(recipe),
              (Names{"length", "width_1", "angle_1", "angle_2", "angle_3", "angle_4", "holes"}));
    EXPECT_NEAR(nominal_of(recipe, "length"), 120, 0.05);
    EXPECT_EQ(verdicts_of(good, recipe), "ok");
    accepts_in_twenty_poses(recipe, rectangle(120, 120), 180, 429);
    for (const double turn : {0, 20, 60, 100})
        EXPECT_NE(verdicts_of(lying(rectangle(121.5, 120), turn, 430), recipe).find("high"),
                  std::string::npos)
            << turn;
    EXPECT_EQ(verdicts_of(lying(disc(67.7), 0, 430), recipe),
              "unmeasured length:unmeasured width_1:unmeasured "
              "angle_1:unmeasured angle_2:unmeasured angle_3:unmeasured angle_4:unmeasured");
}

TEST(TeachSymmetry, GivesNoLengthToWhatIsNearlySquare) {
    const Taught taught = taught_from({lying(rectangle(120, 122), 7, 443)});
    EXPECT_EQ(taught.recipe.locate.orientation, OrientationRule::rotational);
    EXPECT_EQ(feature_named(taught.recipe, "length"), nullptr);
    EXPECT_EQ(feature_named(taught.recipe, "width_1"), nullptr);
    EXPECT_EQ(
        std::count(taught.notes.begin(), taught.notes.end(),
                   "some distances between parallel edges are left out: they are not the same in all the "
                   "directions that are not told apart"),
        1);
}

TEST(TeachSymmetry, MeasuresEveryArmOfACrossAndEverySideOfAPentagon) {
    const Shape bar = rectangle(160, 40);
    const Shape upright = rectangle(40, 160);
    const Shape cross = with(bar, upright, 0, 0);
    const Recipe of_cross = taught_from({lying(cross, 7, 444)}).recipe;
    EXPECT_EQ(verdicts_of(lying(cross, 40, 445), of_cross), "ok");
    const Shape thin = [=](double s, double t) { return cross(s, t) && !(s > 22 && std::abs(t) > 18); };
    const Recipe of_pentagon = taught_from({lying(polygon(5, 70), 7, 446)}).recipe;
    EXPECT_EQ(verdicts_of(lying(polygon(5, 70), 40, 447), of_pentagon), "ok");
    const Shape cut = [](double s, double t) { return polygon(5, 70)(s, t) && s < 67; };
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(verdicts_of(lying(thin, 45.0 * i, 448), of_cross).compare(0, 6, "not_ok"), 0) << i;
        EXPECT_EQ(verdicts_of(lying(cut, 45.0 * i, 449), of_pentagon).compare(0, 6, "not_ok"), 0) << i;
    }
}

TEST(TeachSymmetry, MeasuresEveryPairOfFlatsOfANutHoweverItLies) {
    const auto nut = [](double across) { return without(polygon(6, across / 2), disc(30), 0, 0); };
    const Recipe recipe = recipe_of(taught_from({lying(nut(130), 7, 436)}));
    EXPECT_EQ(recipe.locate.orientation, OrientationRule::rotational);
    EXPECT_EQ(recipe.locate.symmetry_order, 6);
    for (const char* name : {"length", "width_1", "width_2"})
        EXPECT_NEAR(nominal_of(recipe, name), 130, 0.05) << name;
    accepts_in_twenty_poses(recipe, nut(130), 180, 437);
    // Too small however it lies, and a nut of which one pair of flats is worn, whichever it is.
    const auto worn = [&](double s, double t) { return nut(130)(s, t) && std::abs(s) <= 64.4; };
    Random random(438);
    for (int i = 0; i < 20; i += 20 / accepted_poses) {
        const double turn = uniform(random, -180, 180);
        EXPECT_EQ(verdicts_of(lying(nut(128.8), turn, random.next()), recipe),
                  "not_ok length:low width_1:low width_2:low")
            << turn;
        EXPECT_EQ(verdicts_of(lying(worn, turn, random.next()), recipe).compare(0, 6, "not_ok"), 0) << turn;
    }
}

TEST(TeachSymmetry, MeasuresTheHolesOfAFlangeHoweverItLies) {
    const Recipe recipe = recipe_of(taught_from({lying(flange(6), 7, 439)}));
    EXPECT_EQ(recipe.locate.symmetry_order, 6);
    for (const char* name : {"diameter", "hole_1", "hole_6", "hole_1_position", "hole_6_position"})
        EXPECT_NE(feature_named(recipe, name), nullptr) << name;
    EXPECT_EQ(feature_named(recipe, "hole_7"), nullptr);
    accepts_in_twenty_poses(recipe, flange(6), 180, 440);
    // A hole that is too large, or out of its place, whichever it is and however the part lies.
    for (int i = 0; i < 6; ++i) {
        const double x = 55 * std::cos(i * pi / 3);
        const double y = 55 * std::sin(i * pi / 3);
        EXPECT_EQ(verdicts_of(lying(without(flange(6), disc(10), x, y), 40.0 * i, 442), recipe)
                      .compare(0, 6, "not_ok"),
                  0);
        const Shape moved = without(with(flange(6), disc(12), x, y), disc(9), x * 57.5 / 55, y * 57.5 / 55);
        EXPECT_EQ(verdicts_of(lying(moved, 40.0 * i, 442), recipe).compare(0, 6, "not_ok"), 0);
    }
    const Shape lacking = with(flange(6), disc(12), 55, 0);
    EXPECT_EQ(verdicts_of(lying(lacking, 100, 441), recipe).compare(0, 16, "not_ok holes:low"), 0);
}

TEST(TeachSymmetry, MeasuresTheHolesOfAHexagonThatHasOneBehindEverySecondSide) {
    // The outline alone repeats itself six times, with the holes it does three times.
    const auto part = [](double wide_hole) {
        return without(drilled(polygon(6, 70), 3, 42, 10), disc(wide_hole), -21, -21 * std::sqrt(3.0));
    };
    const Recipe recipe = taught_from({lying(part(0), 7, 457)}).recipe;
    EXPECT_EQ(recipe.locate.symmetry_order, 3);
    const Names names = feature_names(recipe);
    for (const char* name : {"length", "width_1", "width_2", "hole_1", "hole_2", "hole_3", "holes"})
        EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
    accepts_in_twenty_poses(recipe, part(0), 120, 458);
    for (const int turn : {7, 67, 127, 187})
        EXPECT_EQ(verdicts_of(lying(part(10.75), turn, 480), recipe).compare(0, 11, "not_ok hole"), 0)
            << turn;
}

TEST(TeachSymmetry, ProposesOnlyWhatDoesNotDependOnTheTurnOfAPartWithoutDirection) {
    // Waves of two orders, of which none stands out.
    const auto cam = [](double hole) -> Shape {
        return [hole](double s, double t) {
            const double angle = std::atan2(t, s);
            const double radius = std::hypot(s, t);
            return radius <= 70 + 5 * std::cos(3 * angle) + 5 * std::cos(5 * angle + 1) && radius > hole;
        };
    };
    const Taught taught = taught_from({lying(cam(20), 7, 430)});
    EXPECT_EQ(taught.problem, "");
    EXPECT_EQ(taught.recipe.locate.orientation, OrientationRule::none);
    EXPECT_EQ(feature_named(taught.recipe, "length"), nullptr);
    EXPECT_EQ(feature_named(taught.recipe, "angle_1"), nullptr);
    EXPECT_NE(feature_named(taught.recipe, "hole_1"), nullptr);
    ASSERT_EQ(taught.notes.size(), 1u);
    EXPECT_EQ(taught.notes[0].compare(0, 44, "the part has no clear axis and no symmetry, "), 0);
    accepts_in_twenty_poses(taught.recipe, cam(20), 180, 435);
    EXPECT_EQ(verdicts_of(lying(cam(20.75), 100, 436), taught.recipe), "not_ok hole_1:high");
}

TEST(TeachSymmetry, DoesNotTakeTheManySmallHolesOfADiscForOneThatIsTheSameHoweverItLies) {
    const auto disc_of = [](int holes) -> Shape {
        return [holes](double s, double t) {
            const double angle = std::remainder(std::atan2(t, s), 2 * pi / holes);
            const double radius = std::hypot(s, t);
            return radius <= 100 &&
                   std::hypot(radius * std::cos(angle) - 80, radius * std::sin(angle)) >= 2.9;
        };
    };
    for (const int holes : {11, 13}) {
        const Recipe recipe = taught_from({lying(disc_of(holes), 7, 450)}).recipe;
        EXPECT_EQ(recipe.locate.orientation, OrientationRule::none);
        EXPECT_EQ(feature_names(recipe), (Names{"diameter", "holes"})) << holes;
        EXPECT_EQ(verdicts_of(lying(disc_of(holes), 7 + 180.0 / holes, 451), recipe), "ok") << holes;
    }
}

TEST(TeachSymmetry, SaysWhatARecipeHasNoRoomFor) {
    const auto wheel = [](int teeth) -> Shape {
        return [teeth](double s, double t) {
            const double turn = std::atan2(t, s) / (2 * pi) * teeth;
            return std::hypot(s, t) <= (turn - std::floor(turn) < 0.5 ? 100 : 45);
        };
    };
    const auto full = [](const Taught& taught) {
        return std::count(taught.notes.begin(), taught.notes.end(),
                          "a recipe holds 24 features: there is more to measure");
    };
    const Taught many = taught_from({lying(wheel(8), 7, 452)});
    EXPECT_EQ(many.recipe.locate.symmetry_order, 8);
    EXPECT_NE(feature_named(many.recipe, "holes"), nullptr);
    EXPECT_EQ(full(many), 1);
    EXPECT_EQ(full(taught_from({lying(polygon(4, 80), 7, 453)})), 0);
}

TEST(TeachSymmetry, MeasuresEveryToothOfAWheel) {
    const auto wheel = [](int short_tooth) -> Shape {
        return [short_tooth](double s, double t) {
            const double turn = std::atan2(t, s) / (2 * pi) * 12 + 12;
            const int tooth = static_cast<int>(turn) % 12;
            const bool on_tooth = turn - std::floor(turn) < 0.6;
            return std::hypot(s, t) <= (on_tooth ? (tooth == short_tooth ? 94 : 100) : 84);
        };
    };
    const Recipe recipe = taught_from({lying(wheel(-1), 3, 454)}).recipe;
    EXPECT_EQ(recipe.locate.symmetry_order, 12);
    EXPECT_NE(feature_named(recipe, "holes"), nullptr);
    EXPECT_EQ(verdicts_of(lying(wheel(-1), 40, 455), recipe), "ok");
    for (int tooth = 0; tooth < 12; ++tooth)
        EXPECT_EQ(verdicts_of(lying(wheel(tooth), 3, 456), recipe).compare(0, 6, "not_ok"), 0) << tooth;
}

}  // namespace
}  // namespace fovea::test
