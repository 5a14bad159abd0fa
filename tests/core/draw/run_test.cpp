// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include <core/draw/draw_reference.hpp>
#include <fovea/draw/run.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();

TEST(DrawPoint, SetsOnePixel) {
    GuardedImage<Gray8> image = black({3, 2});
    ASSERT_EQ(draw_point(image.view(), {1, 0}, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{".#.", "..."}));
}

TEST(DrawPoint, OutsideIsNoErrorAndDrawsNothing) {
    GuardedImage<Gray8> image = black({3, 2});
    const int low = std::numeric_limits<int>::min();
    const int high = std::numeric_limits<int>::max();
    for (const Point p :
         {Point{-1, 0}, {3, 0}, {0, -1}, {0, 2}, {low, low}, {high, high}, {low, 1}, {1, high}})
        EXPECT_EQ(draw_point(image.view(), p, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"...", "..."}));
}

TEST(DrawPoint, NeedsAnImage) { EXPECT_EQ(draw_point(ImageView<Gray8>(), {0, 0}, 255), Status::empty_image); }

TEST(DrawPoint, DrawsInColour) {
    GuardedImage<Rgb888> image({2, 1});
    image.fill(Rgb888{0, 0, 0});
    ASSERT_EQ(draw_point(image.view(), {1, 0}, Rgb888{1, 2, 3}), Status::ok);
    EXPECT_EQ(image(0, 0), (Rgb888{0, 0, 0}));
    EXPECT_EQ(image(1, 0), (Rgb888{1, 2, 3}));
}

TEST(FillRun, SetsBothEndsAndAllBetween) {
    GuardedImage<Gray8> image = black({6, 2});
    fill_run(image.view(), 1, 2, 4, 255);
    EXPECT_EQ(picture(image), (Picture{"......", "..###."}));
}

TEST(FillRun, IsClippedAtBothSides) {
    for (const std::int64_t left : {std::int64_t{-1}, std::int64_t{-70000}, least})
        for (const std::int64_t right : {std::int64_t{6}, std::int64_t{70000}, most}) {
            GuardedImage<Gray8> image = black({6, 2});
            fill_run(image.view(), 0, left, right, 255);
            EXPECT_EQ(picture(image), (Picture{"######", "......"}));
            fill_run(image.view(), 1, left, 0, 255);
            EXPECT_EQ(picture(image), (Picture{"######", "#....."}));
            fill_run(image.view(), 1, 4, right, 255);
            EXPECT_EQ(picture(image), (Picture{"######", "#...##"}));
        }
}

TEST(FillRun, DrawsNothingOutsideOrBackwards) {
    GuardedImage<Gray8> image = black({6, 2});
    for (const std::int64_t y : {least, std::int64_t{-1}, std::int64_t{2}, most})
        fill_run(image.view(), y, 0, 5, 255);
    fill_run(image.view(), 0, 3, 2, 255);
    fill_run(image.view(), 0, most, least, 255);
    fill_run(image.view(), 0, least, -1, 255);
    fill_run(image.view(), 0, 6, most, 255);
    fill_run(ImageView<Gray8>(), 0, 0, 5, 255);
    EXPECT_EQ(picture(image), (Picture{"......", "......"}));
}

TEST(Drawable, EndsAtTheStatedCoordinate) {
    EXPECT_TRUE(drawable(Point{1 << 30, -(1 << 30)}));
    EXPECT_FALSE(drawable(Point{(1 << 30) + 1, 0}));
    EXPECT_FALSE(drawable(Point{0, -(1 << 30) - 1}));
    EXPECT_FALSE(drawable(most, 0));
    EXPECT_FALSE(drawable(0, least));
}

}  // namespace
}  // namespace fovea::test
