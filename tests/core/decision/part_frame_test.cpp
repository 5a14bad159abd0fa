// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/decision/part_frame.hpp>
#include <support/recipes.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

constexpr std::int64_t unit = 1000000;

TEST(PartFrame, CarriesAPlaceByHand) {
    const Scale scale{LengthUnit::millimetre, 20000, 40000};
    const PartFrame upright(fine(100, 50), FineAngle(), scale);
    EXPECT_EQ(*upright.to_image({2 * unit, 4 * unit}), fine(200, 150));
    const PartPoint back = upright.to_part(fine(200, 150));
    EXPECT_TRUE(same(back, {2 * unit, 4 * unit}));

    // A quarter turn clockwise: the part's x runs down the image, its y to the left.
    const PartFrame turned(fine(100, 50), FineAngle::quarter_turn(), scale);
    EXPECT_EQ(*turned.to_image({4 * unit, 2 * unit}), fine(0, 150));
}

TEST(PartFrame, HasItsOriginAtTheOriginOfThePart) {
    const PartFrame frame(fine(12.25, 7.5), FineAngle::from_microdegrees(33000000), Scale());
    EXPECT_EQ(*frame.to_image({}), frame.origin());
    EXPECT_TRUE(same(frame.to_part(frame.origin()), {}));
}

TEST(PartFrame, ComesBackFromTheImageToTheSamePlace) {
    Random random(611);
    for (int i = 0; i < 3000; ++i) {
        const std::int64_t x_per_pixel = random.between(min_units_per_pixel, max_units_per_pixel);
        const Scale scale{
            LengthUnit::millimetre, x_per_pixel,
            std::max<std::int64_t>(x_per_pixel * random.between(25, 400) / 100, min_units_per_pixel)};
        const PartFrame frame(fine(uniform(random, 0, 8191), uniform(random, 0, 8191)),
                              FineAngle::from_raw(random.next()), scale);
        const FinePoint place = fine(uniform(random, 0, 8191), uniform(random, 0, 8191));
        const Result<FinePoint> back = frame.to_image(frame.to_part(place));
        ASSERT_TRUE(back.ok());
        // Half a millionth is lost in both coordinates of the part, 2^-30 of 11600 px in the direction, which
        // is 0.7 raw units each way, and half a unit on the way back.
        const double fine_units =
            3 + 65536.0 / static_cast<double>(std::min(scale.x_per_pixel, scale.y_per_pixel));
        EXPECT_NEAR(back->x.raw(), place.x.raw(), fine_units) << i;
        EXPECT_NEAR(back->y.raw(), place.y.raw(), fine_units) << i;
    }
}

TEST(PartFrame, KeepsLengthsWhateverTheTurn) {
    Random random(612);
    for (int i = 0; i < 500; ++i) {
        const PartFrame frame(fine(500, 500), FineAngle::from_raw(random.next()), Scale());
        const FinePoint a = *frame.to_image({-40 * unit, 30 * unit});
        const FinePoint b = *frame.to_image({140 * unit, -20 * unit});
        EXPECT_NEAR(std::hypot(real(b.x) - real(a.x), real(b.y) - real(a.y)), std::hypot(180, 50),
                    4 / 65536.0);
    }
}

TEST(PartFrame, RefusesWhatLiesBeyondTheCoordinates) {
    const PartFrame frame(fine(10, 10), FineAngle(), Scale());
    EXPECT_EQ(frame.to_image({32757 * unit, 0})->x, FinePixel::from_int(32767));
    EXPECT_EQ(frame.to_image({32758 * unit, 0}).status(), Status::out_of_range);
    EXPECT_EQ(frame.to_image({0, -32778 * unit}).status(), Status::out_of_range);
    const Scale finest{LengthUnit::millimetre, min_units_per_pixel, min_units_per_pixel};
    for (const std::uint32_t turn : {0u, 0x20000000u, 0x40000000u, 0x9abcdef0u}) {
        const PartFrame close(fine(10, 10), FineAngle::from_raw(turn), finest);
        for (const std::int64_t x : {-max_part_coordinate, max_part_coordinate})
            EXPECT_EQ(close.to_image({x, max_part_coordinate}).status(), Status::out_of_range);
    }
}

TEST(PartPoint, IsAddedAndMeasuredAsAVector) {
    EXPECT_TRUE(same(PartPoint{1, 2} + PartPoint{30, -50}, {31, -48}));
    EXPECT_TRUE(same(PartPoint{1, 2} - PartPoint{30, -50}, {-29, 52}));
    EXPECT_EQ(length_of({3 * unit, -4 * unit}), 5 * unit);
}

TEST(PartPoint, HasAVectorSquareToItOfAnyLength) {
    EXPECT_TRUE(same(square_to({5 * unit, 0}, 7 * unit), {0, 7 * unit}));
    EXPECT_TRUE(same(square_to({0, 5 * unit}, 7 * unit), {-7 * unit, 0}));
    EXPECT_TRUE(same(square_to({3 * unit, 4 * unit}, 10 * unit), {-8 * unit, 6 * unit}));
    EXPECT_TRUE(same(square_to({}, 7 * unit), {}));
}

TEST(PartPoint, IsFoundBetweenTwoOthers) {
    EXPECT_TRUE(same(point_between({0, 0}, {8 * unit, -4 * unit}, 1, 4), {2 * unit, -unit}));
    EXPECT_TRUE(same(point_between({unit, 5}, {9 * unit, 7}, 0, 3), {unit, 5}));
    EXPECT_TRUE(same(point_between({unit, 5}, {9 * unit, 7}, 3, 3), {9 * unit, 7}));
}

}  // namespace
}  // namespace fovea::test
