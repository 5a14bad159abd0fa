// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/camera/saddle_point.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

/// Four fields about a corner, turned by an angle: what a lens of a Gaussian makes of them.
GuardedImage<Gray8> saddle(Size size, double x, double y, double angle, double blur) {
    GuardedImage<Gray8> image(size);
    for (int row = 0; row < size.height; ++row)
        for (int column = 0; column < size.width; ++column) {
            const double dx = column - x;
            const double dy = row - y;
            const double u = dx * std::cos(angle) + dy * std::sin(angle);
            const double v = dy * std::cos(angle) - dx * std::sin(angle);
            const double share = std::erf(u / blur / std::sqrt(2.0)) * std::erf(v / blur / std::sqrt(2.0));
            image(column, row) = static_cast<Gray8>(std::lround(128 + 100 * share));
        }
    return image;
}
SubPixelPoint at(double x, double y) {
    return {SubPixel::from_raw(static_cast<std::int32_t>(std::lround(x * 256))),
            SubPixel::from_raw(static_cast<std::int32_t>(std::lround(y * 256)))};
}
double error(const Result<SubPixelPoint>& found, double x, double y) {
    return std::hypot(found->x.raw() / 256.0 - x, found->y.raw() / 256.0 - y);
}

TEST(SaddlePoint, IsTheMiddleOfFourSquares) {
    GuardedImage<Gray8> image({20, 18});
    image.fill(200);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 10; ++x) image(x, y) = image(x + 10, y + 9) = 50;
    // Between columns 9 and 10, and rows 8 and 9.
    const Result<SubPixelPoint> found =
        refine_saddle_point(image.view(), at(10.5, 7.75), SubPixel::from_int(7));
    ASSERT_TRUE(found.ok());
    EXPECT_EQ(*found, at(9.5, 8.5));
}

// Half a grey level of 200 and half of 1/256 px are 0.005 px in each direction; the last step may leave as
// much.
TEST(SaddlePoint, IsFoundWithinTwoHundredthsOfAPixel) {
    Random random(3);
    for (const double blur : {0.7, 1.0, 2.0, 4.0}) {
        double worst = 0;
        for (int i = 0; i < 30; ++i) {
            const double x = 20 + random.between(0, 255) / 256.0;
            const double y = 20 + random.between(0, 255) / 256.0;
            const double angle = random.between(0, 359) * 0.01745329;
            const double off = random.between(-100, 100) / 100.0;
            const GuardedImage<Gray8> image = saddle({41, 42}, x, y, angle, blur);
            const Result<SubPixelPoint> found =
                refine_saddle_point(image.view(), at(x + off, y - off), SubPixel::from_int(8));
            ASSERT_TRUE(found.ok()) << blur << ' ' << i;
            worst = std::max(worst, error(found, x, y));
        }
        EXPECT_LT(worst, 0.02) << blur;
    }
}

// Brightness that falls across the image moves the place of the mean gradient, but hardly that of edges,
// which cross at 60 degrees here so that products of both gradients count.
TEST(SaddlePoint, IsNotPulledByUnevenLight) {
    GuardedImage<Gray8> image({41, 41});
    const double x = 20.3;
    const double y = 19.6;
    for (int row = 0; row < 41; ++row)
        for (int column = 0; column < 41; ++column) {
            const double dx = column - x;
            const double dy = row - y;
            const double u = dy * std::cos(0.3) - dx * std::sin(0.3);
            const double v = dy * std::cos(1.347) - dx * std::sin(1.347);
            const double share = std::erf(u / 1.3) * std::erf(v / 1.3);
            image(column, row) = static_cast<Gray8>(std::lround((130 + 100 * share) * (1 - column / 800.0)));
        }
    const Result<SubPixelPoint> found = refine_saddle_point(image.view(), at(21, 20), SubPixel::from_int(12));
    ASSERT_TRUE(found.ok());
    EXPECT_LT(error(found, x, y), 0.04);
}

TEST(SaddlePoint, MovesWithTheImage) {
    const GuardedImage<Gray8> image = saddle({41, 42}, 20.3, 19.8, 0.4, 1);
    const ImageView<const Gray8> view = image.view();
    const ImageView<const Gray8> part = *view.crop({5, 7, 30, 30});
    const Result<SubPixelPoint> whole = refine_saddle_point(view, at(20, 20), SubPixel::from_int(6));
    const Result<SubPixelPoint> moved = refine_saddle_point(part, at(15, 13), SubPixel::from_int(6));
    ASSERT_TRUE(whole.ok() && moved.ok());
    EXPECT_EQ(whole->x.raw() - moved->x.raw(), 5 * 256);
    EXPECT_EQ(whole->y.raw() - moved->y.raw(), 7 * 256);
}

TEST(SaddlePoint, TakesALongWindow) {
    const GuardedImage<Gray8> image = saddle({81, 42}, 40.3, 19.8, 0, 1);
    const Result<SubPixelPoint> found = refine_saddle_point(image.view(), at(40, 20), {at(20, 0), at(0, 5)});
    ASSERT_TRUE(found.ok());
    EXPECT_LT(error(found, 40.3, 19.8), 0.01);
}

TEST(SaddlePoint, IsNoneOnAFlatImageAnEdgeOrAHill) {
    GuardedImage<Gray8> image({30, 30});
    image.fill(77);
    EXPECT_EQ(refine_saddle_point(image.view(), at(15, 15), SubPixel::from_int(5)).status(),
              Status::degenerate);
    for (int y = 0; y < 30; ++y)
        for (int x = 15; x < 30; ++x) image(x, y) = 177;
    EXPECT_EQ(refine_saddle_point(image.view(), at(15, 15), SubPixel::from_int(5)).status(),
              Status::degenerate);
    // A hill far from its top: edges of one direction, and the surface is no saddle.
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 30; ++x)
            image(x, y) = static_cast<Gray8>(250 - std::min(250, (x - 15) * (x - 15) + (y - 15) * (y - 15)));
    const Result<SubPixelPoint> hill = refine_saddle_point(image.view(), at(26, 15), SubPixel::from_int(3));
    EXPECT_FALSE(hill.ok());
}

TEST(SaddlePoint, IsNotFoundFartherThanHalfTheRadius) {
    const GuardedImage<Gray8> image = saddle({61, 61}, 30, 30, 0, 1);
    EXPECT_TRUE(refine_saddle_point(image.view(), at(33, 30), SubPixel::from_int(8)).ok());
    EXPECT_EQ(refine_saddle_point(image.view(), at(35, 30), SubPixel::from_int(8)).status(),
              Status::not_found);
}

TEST(SaddlePoint, RefusesWhatItCannotTake) {
    const GuardedImage<Gray8> image = saddle({20, 20}, 10, 10, 0, 1);
    const SubPixel radius = SubPixel::from_int(5);
    EXPECT_EQ(refine_saddle_point(ImageView<const Gray8>(), at(0, 0), radius).status(), Status::empty_image);
    for (const SubPixel bad :
         {SubPixel::from_int(1), SubPixel::from_int(65), SubPixel::from_int(-5), SubPixel()})
        EXPECT_EQ(refine_saddle_point(image.view(), at(10, 10), bad).status(), Status::bad_argument);
    EXPECT_EQ(refine_saddle_point(image.view(), at(10, 10), {at(5, 5), at(5.2, 5)}).status(),
              Status::bad_argument);
    const SubPixelPoint outside[] = {at(-0.1, 5),
                                     at(5, -1),
                                     at(19.1, 5),
                                     at(5, 20),
                                     {SubPixel::from_raw(INT32_MAX), SubPixel::from_raw(INT32_MIN)}};
    for (const SubPixelPoint p : outside)
        EXPECT_EQ(refine_saddle_point(image.view(), p, radius).status(), Status::out_of_range);
    // Too small for a gradient.
    for (const Size size : {Size{1, 1}, Size{4, 9}, Size{9, 4}})
        EXPECT_EQ(refine_saddle_point(GuardedImage<Gray8>(size).view(), at(0, 0), radius).status(),
                  Status::degenerate);
}

}  // namespace
}  // namespace fovea::test
