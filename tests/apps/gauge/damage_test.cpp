// SPDX-License-Identifier: MIT
//
// What a taught recipe makes of damage that its features do not measure as such: it must never be OK in
// silence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gauge/teach.hpp>
#include <support/teaching.hpp>

namespace fovea::test {
namespace {

using namespace shapes;
using apps::Taught;

const Recipe& recipe_of_the_plate() {
    static const Recipe recipe = recipe_of(taught_from({lying(plate(), 7, 800)}));
    return recipe;
}

TEST(Damage, OfAnEdgeUnderAProbeIsNeverOk) {
    // The probe of the length has 25 lines, about 10 px beside the axis.
    for (const double width : {8.0, 14.0})
        for (const double beside : {-18.0, -10.0, -2.0})
            for (const double turn : {20.0, 215.0}) {
                const Shape burr = with(plate(), rectangle(8, width), -90, beside);
                const Shape nick = without(plate(), rectangle(8, width), -90, beside);
                for (const Shape& shape : {burr, nick})
                    EXPECT_NE(verdicts_of(lying(shape, turn, 820), recipe_of_the_plate()), "ok")
                        << width << " " << beside << " " << turn;
            }
}

TEST(Damage, OfTheEdgeOfAHoleIsNeverOk) {
    // A burr of 4 px, 8 px wide, which is 4 of 48 probes, and holes that are oval by 1.5 px or more.
    for (int i = 0; i < 12; i += 20 / accepted_poses) {
        const double turn = i * pi / 6;
        const Shape burr = with(plate(), rectangle(8, 8), 50 + 15 * std::cos(turn), -2 + 15 * std::sin(turn));
        EXPECT_NE(verdicts_of(lying(burr, 30.0 * i, 830), recipe_of_the_plate()), "ok") << i;
        for (const double e : {1.5, 2.0, 3.0}) {
            const Shape oval = [=](double s, double t) {
                const double u = s * std::cos(turn) + t * std::sin(turn);
                const double v = t * std::cos(turn) - s * std::sin(turn);
                return std::hypot(u / (15 + e), v / (15 - e)) <= 1;
            };
            const Shape plain = with(plate(), disc(17), 50, -2);
            EXPECT_EQ(verdicts_of(lying(without(plain, oval, 50, -2), 7, 840), recipe_of_the_plate()),
                      "unmeasured hole_2:unmeasured")
                << e << " " << i;
        }
    }
}

TEST(Damage, OfAHoleThatIsALittleOvalLeavesItsMeanDiameter) {
    // 15.6 x 14.4: the mean of both, whichever way it lies.
    Recipe recipe = recipe_of_the_plate();
    for (int i = 0; i < 12; i += 20 / accepted_poses) {
        const double turn = i * pi / 6;
        const Shape oval = [=](double s, double t) {
            const double u = s * std::cos(turn) + t * std::sin(turn);
            const double v = t * std::cos(turn) - s * std::sin(turn);
            return std::hypot(u / 15.6, v / 14.4) <= 1;
        };
        const Shape plain = with(plate(), disc(17), 50, -2);
        EXPECT_EQ(verdicts_of(lying(without(plain, oval, 50, -2), 7, 850), recipe), "ok") << i;
    }
}

TEST(Damage, OfAWasherWithANotchIsMeasuredRoundAboutIt) {
    const auto washer = [](double radius, double bore) {
        return without(without(disc(radius), disc(bore), 0, 0), rectangle(40, 44), 90, 0);
    };
    const Taught taught = taught_from({lying(washer(90, 45), 7, 860), lying(washer(90, 45), 130, 861)});
    EXPECT_EQ(taught.problem, "");
    ASSERT_NE(feature_named(taught.recipe, "diameter"), nullptr);
    ASSERT_NE(feature_named(taught.recipe, "hole_1"), nullptr);
    EXPECT_GT(feature_named(taught.recipe, "diameter")->outliers, 9);
    EXPECT_LT(feature_named(taught.recipe, "hole_1")->outliers, 4);
    EXPECT_NEAR(nominal_of(taught.recipe, "diameter"), 180, 0.05);
    const bool told = std::any_of(taught.notes.begin(), taught.notes.end(), [](const std::string& note) {
        return note.compare(0, 36, "diameter is not round all around: da") == 0;
    });
    EXPECT_TRUE(told);
    ASSERT_FALSE(taught.notes.empty());
    EXPECT_NE(taught.notes.back().find("% of the outline is off the circle (a notch, "), std::string::npos);
    accepts_in_twenty_poses(taught.recipe, washer(90, 45), 180, 862);
    EXPECT_NE(verdicts_of(lying(washer(90.75, 45), 100, 890), taught.recipe).find("diameter:high"),
              std::string::npos);
    EXPECT_NE(verdicts_of(lying(washer(90, 44.25), 100, 891), taught.recipe).find("hole_1:low"),
              std::string::npos);
}

TEST(Damage, OfAShaftWithAFlatIsSeenAtTheFlat) {
    const auto shaft = [](double flat) -> Shape {
        return [=](double s, double t) { return std::hypot(s, t) <= 60 && s <= flat; };
    };
    const Taught taught = taught_from({lying(shaft(50), 7, 896)});
    EXPECT_NE(feature_named(taught.recipe, "diameter"), nullptr);
    accepts_in_twenty_poses(taught.recipe, shaft(50), 180, 897);
    for (const double flat : {47.0, 53.0})
        for (const double turn : {10.0, 100.0, 200.0})
            EXPECT_NE(verdicts_of(lying(shaft(flat), turn, 898), taught.recipe), "ok") << flat << " " << turn;
}

TEST(Damage, OfALargeDiscIsSeenWhereTwoProbesMeetIt) {
    const Taught taught = taught_from({lying(disc(110), 7, 899)});
    ASSERT_NE(feature_named(taught.recipe, "diameter"), nullptr);
    EXPECT_EQ(feature_named(taught.recipe, "diameter")->probes, 128);
    EXPECT_EQ(feature_named(taught.recipe, "diameter")->outliers, 1);
    accepts_in_twenty_poses(taught.recipe, disc(110), 180, 900);
    for (const double turn : {0.0, 1.4, 2.8, 45.0})
        EXPECT_NE(verdicts_of(lying(without(disc(110), rectangle(12, 12), 110, 0), turn, 901), taught.recipe),
                  "ok")
            << turn;
}

TEST(Damage, OfABoreIsSeenThoughItsPlaceDependsOnTheTurn) {
    // A bore out of the middle by 0.7 px, on a part without direction.
    const auto washer = [](double bore) { return without(disc(80), disc(bore), 0.7, 0); };
    const Taught taught = taught_from({lying(washer(40), 7, 870)});
    EXPECT_EQ(taught.recipe.locate.orientation, OrientationRule::none);
    ASSERT_NE(feature_named(taught.recipe, "hole_1"), nullptr);
    accepts_in_twenty_poses(taught.recipe, washer(40), 180, 871);
    EXPECT_NE(verdicts_of(lying(washer(41), 60, 895), taught.recipe).find("hole_1:high"), std::string::npos);
}

TEST(Damage, OfASlotIsNotMeasuredAndTeachingSaysSo) {
    const Shape slotted = without(plate(), stadium(40, 12), -8, 22);
    const Taught taught = taught_from({lying(slotted, 7, 880)});
    const bool told = std::any_of(taught.notes.begin(), taught.notes.end(), [](const std::string& note) {
        return note.find(" is not round: its size is not measured") != std::string::npos;
    });
    EXPECT_TRUE(told);
}

TEST(Damage, IsNotWhatAProbeMeetsOnATip) {
    const Shape house = [](double s, double t) {
        return s >= -90 && std::abs(t) <= 35 && s + 2 * std::abs(t) <= 90;
    };
    for (const double turn : {7.0, 40.0, 100.0})
        EXPECT_EQ(feature_named(taught_from({lying(house, turn, 920)}).recipe, "length"), nullptr) << turn;
}

}  // namespace
}  // namespace fovea::test
