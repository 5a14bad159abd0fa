// SPDX-License-Identifier: MIT
//
// Teaching with a scale: the true one is that of the rendering.
#include <gtest/gtest.h>

#include <cmath>
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
using Notes = std::vector<std::string>;

constexpr std::int64_t mm = 1000000;

TeachOptions known_length(std::int64_t length) {
    TeachOptions options;
    options.known_length = length;
    return options;
}
/// A part in a world whose units are squeezed into rows that are farther apart.
Picture<Gray8> squeezed(const Shape& shape, double degrees, double stretch_y, std::uint64_t seed) {
    return picture_of(one_part_size, {{shape, 125.4, 124.1, degrees, stretch_y}}, back_light(), seed);
}
double mm_of(std::int64_t millionths) { return static_cast<double>(millionths) * 1e-6; }

/// Five hundredths of a pixel along the plate: more than ever seen at this blur and noise (docs/accuracy.md).
constexpr double scale_error = 0.05 / 180;

TEST(TeachKnownLength, MakesOneScaleFromOneDirection) {
    // 180 px are 45 mm.
    for (const double degrees : {0.0, 33.0, 90.0}) {
        const Taught taught = taught_from({lying(plate(), degrees, 601)}, known_length(45 * mm));
        EXPECT_EQ(taught.problem, "");
        EXPECT_EQ(taught.notes, Notes());
        const Scale& scale = taught.recipe.scale;
        EXPECT_EQ(scale.unit, LengthUnit::millimetre);
        EXPECT_NEAR(mm_of(scale.x_per_pixel), 0.25, 0.25 * scale_error) << degrees;
        EXPECT_EQ(scale.x_per_pixel, scale.y_per_pixel);
        EXPECT_NEAR(nominal_of(taught.recipe, "length"), 45, 0.005);
        EXPECT_NEAR(nominal_of(taught.recipe, "width_1"), 17.5, 0.02);
    }
}

TEST(TeachKnownLength, MakesAScaleForRowsAndOneForColumnsFromTwoDirections) {
    for (const double stretch_y : {1.0, 0.9, 0.7}) {
        SCOPED_TRACE(stretch_y);
        const std::vector<Picture<Gray8>> good = {squeezed(plate(), 1, stretch_y, 602),
                                                  squeezed(plate(), 89, stretch_y, 603)};
        const Taught taught = taught_from(good, known_length(45 * mm));
        EXPECT_EQ(taught.problem, "");
        EXPECT_EQ(taught.notes, Notes());
        const Scale& scale = taught.recipe.scale;
        EXPECT_NEAR(mm_of(scale.x_per_pixel), 0.25, 0.25 * scale_error);
        EXPECT_NEAR(mm_of(scale.y_per_pixel), 0.25 / stretch_y, 0.25 / stretch_y * scale_error / stretch_y);
        EXPECT_NEAR(nominal_of(taught.recipe, "length"), 45, 0.005);
        EXPECT_NEAR(nominal_of(taught.recipe, "width_1"), 17.5, 0.02);
        EXPECT_NEAR(nominal_of(taught.recipe, "hole_1"), 4.5, 0.02);
        for (const Picture<Gray8>& picture : good) EXPECT_EQ(verdicts_of(picture, taught.recipe), "ok");
    }
}

TEST(TeachKnownLength, JudgesGoodPlatesInTwentyPosesWhereRowsAreFartherApart) {
    const double stretch_y = 0.8;
    const Taught taught = taught_from(
        {squeezed(plate(), 0, stretch_y, 604), squeezed(plate(), 90, stretch_y, 605)}, known_length(45 * mm));
    ASSERT_EQ(taught.problem, "");
    Random random(606);
    for (int i = 0; i < 20; i += 20 / accepted_poses) {
        const double degrees = uniform(random, -180, 180);
        EXPECT_EQ(verdicts_of(squeezed(plate(), degrees, stretch_y, random.next()), taught.recipe), "ok")
            << "pose " << i << ": " << degrees;
    }
    // The proposed half pixel is that of the coarser direction: 0.5 * 0.25 / 0.8 mm.
    EXPECT_NE(verdicts_of(squeezed(longer_plate(1.7), 40, stretch_y, 607), taught.recipe).find("length:high"),
              std::string::npos);
}

TEST(TeachKnownLength, IsTheSameWhereTheAxisOfThePictureIsNotThatOfThePart) {
    // A corner that is cut off turns the axis against the edges, and otherwise in a squeezed picture: with
    // the length taken along that axis, the rows came out 1.2 % too near to each other.
    const Shape cut = [](double s, double t) {
        return rectangle(107, 73)(s, t) && (s - (53.5 - 28)) / 28 + (t - (36.5 - 24)) / 24 <= 1;
    };
    const double stretch_y = 0.85;
    const Taught taught = taught_from({squeezed(cut, -4, stretch_y, 620), squeezed(cut, 86, stretch_y, 621)},
                                      known_length(53500000));
    ASSERT_EQ(taught.problem, "");
    EXPECT_NEAR(mm_of(taught.recipe.scale.x_per_pixel), 0.5, 0.5 * 0.001);
    EXPECT_NEAR(mm_of(taught.recipe.scale.y_per_pixel), 0.5 / stretch_y, 0.5 / stretch_y * 0.001);
}

TEST(TeachKnownLength, RefusesAPartThatIsNotEquallyLongInAllPictures) {
    // Squeezed, the second one is nearly square, and what lies along its rows is its height.
    const double stretch_y = 0.83;
    const std::string problem =
        "--known-length gives no scale: the part is not equally long in all pictures, or its axis lies "
        "otherwise; "
        "give --mm-per-px";
    EXPECT_EQ(taught_from({squeezed(rectangle(61, 51), 0, stretch_y, 622),
                           squeezed(rectangle(61, 51), 90, stretch_y, 623)},
                          known_length(61 * mm))
                  .problem,
              problem);
    EXPECT_EQ(
        taught_from({lying(longer_plate(-3), 0, 624), lying(longer_plate(3), 0, 625)}, known_length(45 * mm))
            .problem,
        problem);
    EXPECT_EQ(
        taught_from({lying(longer_plate(-1), 0, 626), lying(longer_plate(1), 0, 627)}, known_length(45 * mm))
            .problem,
        "");
}

TEST(TeachKnownLength, TakesTheDiameterOfADisc) {
    const Taught taught = taught_from({lying(disc(60), 0, 608)}, known_length(30 * mm));
    EXPECT_EQ(taught.problem, "");
    EXPECT_NEAR(mm_of(taught.recipe.scale.x_per_pixel), 0.25, 0.25 * 0.05 / 120);
    EXPECT_EQ(taught.recipe.scale.x_per_pixel, taught.recipe.scale.y_per_pixel);
    EXPECT_NEAR(nominal_of(taught.recipe, "diameter"), 30, 0.005);
}

TEST(TeachKnownLength, RefusesWhatGivesNoScale) {
    const Picture<Gray8> good = lying(plate(), 0, 609);
    const std::string out_of_range =
        "--known-length gives no scale: a pixel would be below 10 nm or above 100 mm, or four times as long "
        "one "
        "way as the other";
    // 180 px: 1.7 um are 9.4 nm each, 18.1 m are 100.6 mm each.
    EXPECT_EQ(taught_from({good}, known_length(1700)).problem, out_of_range);
    EXPECT_EQ(taught_from({good}, known_length(1900)).problem, "");
    EXPECT_EQ(taught_from({good}, known_length(18100 * mm)).problem, out_of_range);
    EXPECT_EQ(taught_from({good}, known_length(17900 * mm)).problem, "");
    EXPECT_EQ(
        taught_from({lying(triangle(), 12, 610)}, known_length(45 * mm)).problem,
        "--known-length gives no scale: no two edges are as far apart as the part is long; give --mm-per-px");
}

TEST(TeachScale, MeasuresInTheMillimetresItIsGiven) {
    TeachOptions options;
    options.scale = Scale{LengthUnit::millimetre, 50000, 50000};
    const Picture<Gray8> good = lying(plate(), 20, 613);
    const Taught taught = taught_from({good}, options);
    EXPECT_EQ(taught.problem, "");
    EXPECT_NEAR(nominal_of(taught.recipe, "length"), 9, 0.002);
    EXPECT_EQ(feature_named(taught.recipe, "length")->tolerance.plus, Decimal{25000});
    EXPECT_EQ(verdicts_of(good, taught.recipe), "ok");
    EXPECT_NE(verdicts_of(lying(longer_plate(1.5), 70, 614), taught.recipe).find("length:high"),
              std::string::npos);
}

TEST(TeachTolerance, IsThatOfEveryLengthAndOfNothingElse) {
    TeachOptions options;
    options.tolerance = 2500000;
    const Taught taught = taught_from({lying(plate(), 20, 615)}, options);
    for (const char* name : {"length", "width_1", "hole_1", "hole_2"}) {
        const Feature* feature = feature_named(taught.recipe, name);
        ASSERT_NE(feature, nullptr) << name;
        EXPECT_EQ(feature->tolerance.plus, Decimal{2500000}) << name;
        EXPECT_EQ(feature->tolerance.minus, Decimal{2500000}) << name;
    }
    EXPECT_EQ(feature_named(taught.recipe, "angle_1")->tolerance.plus, Decimal{500000});
    EXPECT_EQ(feature_named(taught.recipe, "holes")->tolerance.plus, Decimal());
    EXPECT_EQ(verdicts_of(lying(longer_plate(2), 70, 616), taught.recipe).find("length"), std::string::npos);
    EXPECT_NE(verdicts_of(lying(longer_plate(3.5), 70, 616), taught.recipe).find("length:high"),
              std::string::npos);
}

TEST(TeachTolerance, SaysThatGoodPartsDifferByMore) {
    TeachOptions options;
    options.tolerance = 300000;
    const Taught taught =
        taught_from({lying(longer_plate(-0.5), 0, 617), lying(longer_plate(0.5), 0, 618)}, options);
    ASSERT_FALSE(taught.notes.empty());
    EXPECT_EQ(taught.notes[0].compare(0, 26, "length differs by up to 0."), 0) << taught.notes[0];
    EXPECT_NE(taught.notes[0].find(" px from the mean of what was measured; that is more than --tolerance"),
              std::string::npos);
    EXPECT_EQ(feature_named(taught.recipe, "length")->tolerance.plus, Decimal{300000});
}

}  // namespace
}  // namespace fovea::test
