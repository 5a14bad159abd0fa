// SPDX-License-Identifier: MIT
//
// What is taught from good parts accepts good parts however they lie, and refuses others.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <gauge/teach.hpp>
#include <support/teaching.hpp>

namespace fovea::test {
namespace {

using namespace shapes;
using apps::Picture;
using apps::Taught;
using apps::TeachOptions;
using Names = std::vector<std::string>;

const Names features_of_the_plate = {"length", "width_1",         "angle_1", "angle_2",        "holes",
                                     "hole_1", "hole_1_position", "hole_2",  "hole_2_position"};

// ---- One good part -----------------------------------------------------------------------------

TEST(Teach, AcceptsThePlateItWasTaughtFromAndTwentyOthers) {
    const Picture<Gray8> good = lying(plate(), 0, 401);
    const Recipe recipe = recipe_of(taught_from({good}));
    EXPECT_EQ(feature_names(recipe), features_of_the_plate);
    EXPECT_NEAR(nominal_of(recipe, "length"), 180, 0.05);
    EXPECT_NEAR(nominal_of(recipe, "width_1"), 70, 0.05);
    EXPECT_EQ(nominal_of(recipe, "holes"), 2);
    EXPECT_EQ(verdicts_of(good, recipe), "ok");
    accepts_in_twenty_poses(recipe, plate(), 180, 402);
}

TEST(Teach, AcceptsBrightPlatesWhenTaughtFromABrightOne) {
    const Picture<Gray8> good = lying(plate(), 0, 403, front_light());
    const Recipe recipe = recipe_of(taught_from({good}));
    EXPECT_FALSE(recipe.locate.dark_part);
    EXPECT_EQ(feature_names(recipe), features_of_the_plate);
    EXPECT_EQ(verdicts_of(good, recipe), "ok");
    accepts_in_twenty_poses(recipe, plate(), 180, 404, front_light());
}

TEST(Teach, DoesNotCareHowThePlateLayWhenItWasTaught) {
    for (const double degrees : {23.0, 90.0, 131.0, -158.0}) {
        const Picture<Gray8> good = lying(plate(), degrees, 405);
        const Recipe recipe = recipe_of(taught_from({good}));
        EXPECT_EQ(recipe.locate.orientation, OrientationRule::full);
        EXPECT_NEAR(nominal_of(recipe, "length"), 180, 0.05) << degrees;
        EXPECT_EQ(nominal_of(recipe, "holes"), 2);
        EXPECT_EQ(verdicts_of(good, recipe), "ok") << degrees;
        for (const double other : {0.0, 66.0, 181.0, 300.0})
            EXPECT_EQ(verdicts_of(lying(plate(), other, 406), recipe), "ok") << degrees << " " << other;
    }
}

TEST(Teach, RefusesAPlateThatIsAPixelLongerThanItsToleranceAllows) {
    const Recipe recipe = recipe_of(taught_from({lying(plate(), 0, 407)}));
    const Feature* length = feature_named(recipe, "length");
    ASSERT_NE(length, nullptr);
    const double plus = static_cast<double>(length->tolerance.plus.millionths) * 1e-6;
    EXPECT_NEAR(plus, 0.5, 0.01);
    for (const double degrees : {2.0, 95.0, 190.0, 290.0}) {
        EXPECT_NE(verdicts_of(lying(longer_plate(plus + 1), degrees, 408), recipe).find("length:high"),
                  std::string::npos)
            << verdicts_of(lying(longer_plate(plus + 1), degrees, 408), recipe);
        EXPECT_NE(verdicts_of(lying(longer_plate(-plus - 1), degrees, 408), recipe).find("length:low"),
                  std::string::npos);
        EXPECT_EQ(verdicts_of(lying(longer_plate(plus / 2), degrees, 408), recipe), "ok");
    }
}

TEST(Teach, RefusesAPlateThatLacksAHole) {
    const Recipe recipe = recipe_of(taught_from({lying(plate(), 0, 409)}));
    for (const double degrees : {2.0, 95.0, 190.0, 290.0})
        EXPECT_EQ(verdicts_of(lying(plate_without_its_small_hole(), degrees, 410), recipe),
                  "not_ok holes:low hole_1:unmeasured hole_1_position:unmeasured");
}

TEST(Teach, FindsTheLengthOfABracketWhateverItsNoise) {
    // Its outline begins somewhere on the upper edge, and its axis lies across its edges.
    for (std::uint64_t seed = 430; seed < 450; ++seed) {
        const Recipe recipe = recipe_of(taught_from({lying(l_shape(), 0, seed)}));
        EXPECT_NEAR(nominal_of(recipe, "length"), 120, 0.1) << seed;
    }
}

TEST(Teach, NumbersHolesByTheirPlace) {
    // Two of one size, whose order by area is that of the noise.
    const Shape bracket = without(without(l_shape(), disc(7), 40, 0), disc(7), 10, 0);
    for (std::uint64_t seed = 455; seed < 461; ++seed) {
        const Recipe recipe = recipe_of(taught_from({lying(bracket, 0, seed)}));
        const Feature* first = feature_named(recipe, "hole_1");
        const Feature* second = feature_named(recipe, "hole_2");
        ASSERT_TRUE(first != nullptr && second != nullptr);
        EXPECT_LT(first->centre.x, second->centre.x);
    }
}

// ---- Several good parts ------------------------------------------------------------------------

TEST(Teach, TakesEveryPartOfAPictureForASample) {
    const Picture<Gray8> good =
        picture_of({460, 330}, {{plate(), 120, 75, 4}, {plate(), 340, 100, -40}, {plate(), 130, 240, 185}},
                   back_light(), 411);
    const Taught taught = taught_from({good});
    EXPECT_EQ(taught.samples.parts.size(), 3u);
    const Recipe recipe = recipe_of(taught);
    EXPECT_EQ(recipe.locate.orientation, OrientationRule::full);
    EXPECT_EQ(feature_names(recipe), features_of_the_plate);
    EXPECT_EQ(verdicts_of(good, recipe), "ok ok ok");
    accepts_in_twenty_poses(recipe, plate(), 180, 412);
}

TEST(Teach, TakesTheMeanOverSeveralPicturesAndThreeTimesWhatTheyDifferByForTheTolerance) {
    const std::vector<Picture<Gray8>> good = {lying(longer_plate(-0.4), 10, 413),
                                              lying(longer_plate(0.4), 100, 414), lying(plate(), -170, 415)};
    const Recipe recipe = recipe_of(taught_from(good));
    const Feature* length = feature_named(recipe, "length");
    ASSERT_NE(length, nullptr);
    EXPECT_NEAR(nominal_of(recipe, "length"), 180, 0.05);
    EXPECT_NEAR(static_cast<double>(length->tolerance.plus.millionths) * 1e-6, 3 * 0.4, 0.15);
    EXPECT_EQ(length->tolerance.minus, length->tolerance.plus);
    for (const Picture<Gray8>& picture : good) EXPECT_EQ(verdicts_of(picture, recipe), "ok");
    accepts_in_twenty_poses(recipe, plate(), 180, 416);
}

TEST(Teach, SaysThatGoodPartsDifferMoreThanPartsOfOneKindShould) {
    const Taught taught = taught_from({lying(longer_plate(-2.5), 0, 417), lying(longer_plate(2.5), 0, 418)});
    EXPECT_EQ(taught.problem, "");
    ASSERT_FALSE(taught.notes.empty());
    EXPECT_EQ(taught.notes[0].compare(0, 26, "length differs by up to 2."), 0) << taught.notes[0];
    EXPECT_NE(taught.notes[0].find(" px from the mean of what was measured; its tolerance follows from that"),
              std::string::npos);
}

TEST(Teach, LeavesOutWhatDiffersTooMuchToBeOneKind) {
    const Taught taught = taught_from({lying(rectangle(136, 60), 0, 451), lying(rectangle(180, 60), 0, 452)});
    EXPECT_EQ(taught.problem, "");
    EXPECT_EQ(feature_named(taught.recipe, "length"), nullptr);
    EXPECT_NE(feature_named(taught.recipe, "width_1"), nullptr);
    ASSERT_FALSE(taught.notes.empty());
    EXPECT_NE(taught.notes[0].find("it is left out: is all of this one kind of part?"), std::string::npos)
        << taught.notes[0];
}

TEST(Teach, PutsTheHolesWhereTheyAreOnAverage) {
    const auto shifted = [](double by) { return without(rectangle(180, 70), disc(10), 40 + by, 6); };
    const std::vector<Picture<Gray8>> good = {lying(shifted(-0.5), 0, 453), lying(shifted(0.5), 30, 454)};
    const Recipe recipe = taught_from(good).recipe;
    const Feature* place = feature_named(recipe, "hole_1_position");
    ASSERT_NE(place, nullptr);
    // Half a pixel off at most, and half a pixel that every length gets.
    EXPECT_NEAR(static_cast<double>(place->tolerance.plus.millionths) * 1e-6, 1, 0.1);
    for (const Picture<Gray8>& picture : good) EXPECT_EQ(verdicts_of(picture, recipe), "ok");
}

TEST(Teach, SaysThatALengthDiffersByMoreThanHalfAPixel) {
    const Picture<Gray8> good = lying(rectangle(180, 70), 0, 433);
    const auto notes_with = [&](double length) {
        return taught_from({good, lying(rectangle(length, 70), 0, 434)}).notes;
    };
    EXPECT_EQ(notes_with(180.4), Names());
    const Names notes = notes_with(181.6);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0].compare(0, 26, "length differs by up to 0."), 0) << notes[0];
}

TEST(Teach, LeavesOutTheCountOfHolesWhereGoodPartsDisagreeAndSaysSo) {
    const Taught taught =
        taught_from({lying(plate(), 0, 419), lying(plate_without_its_small_hole(), 30, 420)});
    EXPECT_EQ(taught.problem, "");
    EXPECT_EQ(feature_named(taught.recipe, "holes"), nullptr);
    EXPECT_NE(feature_named(taught.recipe, "length"), nullptr);
    EXPECT_EQ(taught.notes, (Names{"holes are not counted: the good parts have from 1 to 2",
                                   "hole_1 is not found on every part"}));
    EXPECT_EQ(verdicts_of(lying(plate(), 60, 421), taught.recipe), "ok");
    EXPECT_EQ(verdicts_of(lying(plate_without_its_small_hole(), 60, 421), taught.recipe), "ok");
}

// ---- Other shapes ------------------------------------------------------------------------------

TEST(Teach, MeasuresADiscAsOneWithoutDirection) {
    const Picture<Gray8> good = lying(disc(60), 0, 422);
    const Recipe recipe = recipe_of(taught_from({good}));
    EXPECT_EQ(recipe.locate.orientation, OrientationRule::none);
    EXPECT_EQ(feature_names(recipe), (Names{"diameter", "holes"}));
    EXPECT_NEAR(nominal_of(recipe, "diameter"), 120, 0.05);
    EXPECT_EQ(verdicts_of(good, recipe), "ok");
    accepts_in_twenty_poses(recipe, disc(60), 180, 423);
    EXPECT_EQ(verdicts_of(lying(disc(60.75), 0, 424), recipe), "not_ok diameter:high");
    EXPECT_EQ(verdicts_of(lying(disc(59.25), 0, 424), recipe), "not_ok diameter:low");
    EXPECT_EQ(verdicts_of(lying(ring(60, 8), 0, 424), recipe), "not_ok holes:high");
}

TEST(Teach, MeasuresAPartWithAlikeEndsEitherWayRound) {
    const Shape bar = without(without(rectangle(180, 60), disc(12), 50, 0), disc(12), -50, 0);
    const Picture<Gray8> good = lying(bar, 0, 425);
    const Recipe recipe = recipe_of(taught_from({good}));
    EXPECT_EQ(recipe.locate.orientation, OrientationRule::symmetric);
    EXPECT_EQ(nominal_of(recipe, "holes"), 2);
    EXPECT_NE(feature_named(recipe, "hole_1_position"), nullptr);
    EXPECT_EQ(verdicts_of(good, recipe), "ok");
    accepts_in_twenty_poses(recipe, bar, 180, 426);
    const Shape longer = without(without(rectangle(181.5, 60), disc(12), 50, 0), disc(12), -50, 0);
    EXPECT_EQ(verdicts_of(lying(longer, 200, 427), recipe), "not_ok length:high");
    const std::string lacking =
        verdicts_of(lying(without(rectangle(180, 60), disc(12), 50, 0), 20, 427), recipe);
    EXPECT_EQ(lacking.compare(0, 17, "not_ok holes:low "), 0) << lacking;
}

TEST(Teach, SaysThatAPartWithoutTwoEndsHasNoLength) {
    const Picture<Gray8> good = lying(triangle(), 12, 440);
    const Taught taught = taught_from({good});
    EXPECT_EQ(taught.problem, "");
    EXPECT_EQ(taught.notes,
              Names{"no length: no probe along the axis meets both ends of every part; it needs "
                    "straight ends and 8 pixels of ground around it"});
    EXPECT_EQ(feature_named(taught.recipe, "length"), nullptr);
    EXPECT_EQ(verdicts_of(good, taught.recipe), "ok");
    accepts_in_twenty_poses(taught.recipe, triangle(), 180, 441);
}

TEST(Teach, TakesNoArcForAStraightEdge) {
    for (std::uint64_t seed = 462; seed < 468; ++seed)
        EXPECT_EQ(feature_named(taught_from({lying(crescent(), 0, seed)}).recipe, "angle_1"), nullptr)
            << seed;
}

TEST(Teach, AcceptsManyShapesInTwentyPoses) {
    struct Example {
        const char* name;
        Shape shape;
        OrientationRule orientation;
    };
    const Example examples[] = {{"stadium", stadium(160, 60), OrientationRule::symmetric},
                                {"T", t_shape(), OrientationRule::full}};
    std::uint64_t seed = 431;
    for (const Example& example : examples) {
        SCOPED_TRACE(example.name);
        const Picture<Gray8> good = lying(example.shape, 12, seed);
        const Recipe recipe = recipe_of(taught_from({good}));
        EXPECT_EQ(recipe.locate.orientation, example.orientation);
        EXPECT_EQ(verdicts_of(good, recipe), "ok");
        accepts_in_twenty_poses(recipe, example.shape, 180, seed + 100);
        ++seed;
    }
}

}  // namespace
}  // namespace fovea::test
