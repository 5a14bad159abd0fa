// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include <core/draw/draw_reference.hpp>
#include <fovea/base/random.hpp>
#include <fovea/draw/rectangle.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

constexpr int least = std::numeric_limits<int>::min();
constexpr int most = std::numeric_limits<int>::max();

bool in_area(Rectangle area, std::int64_t inset, int x, int y) {
    return x >= area.x + inset && x < std::int64_t{area.x} + area.width - inset && y >= area.y + inset &&
           y < std::int64_t{area.y} + area.height - inset;
}

void expect_naive(Size size, Rectangle area, int thickness) {
    GuardedImage<Gray8> framed = black(size);
    ASSERT_EQ(draw_rectangle(framed.view(), area, 255, thickness), Status::ok);
    ASSERT_EQ(picture(framed), picture(naive_shape(size,
                                                   [&](int x, int y) {
                                                       return in_area(area, 0, x, y) &&
                                                              !in_area(area, thickness, x, y);
                                                   })
                                           .view()))
        << area.x << "," << area.y << " " << area.width << "x" << area.height << " thickness " << thickness;
    GuardedImage<Gray8> filled = black(size);
    ASSERT_EQ(fill_rectangle(filled.view(), area, 255), Status::ok);
    ASSERT_EQ(picture(filled),
              picture(naive_shape(size, [&](int x, int y) { return in_area(area, 0, x, y); }).view()))
        << area.x << "," << area.y << " " << area.width << "x" << area.height;
}

TEST(DrawRectangle, SetsTheOutermostPixels) {
    GuardedImage<Gray8> image = black({7, 5});
    ASSERT_EQ(draw_rectangle(image.view(), {1, 1, 5, 3}, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{".......", ".#####.", ".#...#.", ".#####.", "......."}));
}

TEST(DrawRectangle, GrowsInward) {
    GuardedImage<Gray8> image = black({8, 7});
    ASSERT_EQ(draw_rectangle(image.view(), {1, 0, 7, 7}, 255, 3), Status::ok);
    EXPECT_EQ(picture(image),
              (Picture{".#######", ".#######", ".#######", ".###.###", ".#######", ".#######", ".#######"}));
}

TEST(DrawRectangle, IsOpenWhereItIsClipped) {
    GuardedImage<Gray8> image = black({5, 4});
    ASSERT_EQ(draw_rectangle(image.view(), {-3, -2, 6, 5}, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"..#..", "..#..", "###..", "....."}));
}

TEST(FillRectangle, SetsEveryPixel) {
    GuardedImage<Gray8> image = black({5, 4});
    ASSERT_EQ(fill_rectangle(image.view(), {3, 1, 9, 2}, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{".....", "...##", "...##", "....."}));
}

TEST(Rectangles, EqualTheReference) {
    Random random(131);
    for (const Size size : drawing_sizes())
        for (int round = 0; round < 400; ++round) {
            const int x = random.between(-20, size.width + 20);
            const int y = random.between(-20, size.height + 20);
            const int width = random.between(0, 50);
            const int height = random.between(0, 50);
            const int thickness = random.between(1, 30);
            expect_naive(size, {x, y, width, height}, thickness);
        }
}

TEST(Rectangles, HoldAtTheEndsOfInt) {
    const std::vector<int> places = {least, -1, 0, 3, most};
    const std::vector<int> sides = {0, 1, 2, 7, most - 1, most};
    for (const int x : places)
        for (const int y : places)
            for (const int width : sides)
                for (const int height : sides)
                    for (const int thickness : {1, 2, most})
                        expect_naive({8, 6}, {x, y, width, height}, thickness);
}

TEST(Rectangles, WithoutPixelsDrawNone) {
    GuardedImage<Gray8> image = black({3, 2});
    for (const Rectangle area : {Rectangle{0, 0, 0, 2}, Rectangle{0, 0, 2, 0}, Rectangle{}}) {
        EXPECT_EQ(draw_rectangle(image.view(), area, 255), Status::ok);
        EXPECT_EQ(fill_rectangle(image.view(), area, 255), Status::ok);
    }
    EXPECT_EQ(picture(image), (Picture{"...", "..."}));
}

TEST(Rectangles, DrawInColour) {
    GuardedImage<Rgb888> image({2, 1});
    image.fill(Rgb888{0, 0, 0});
    ASSERT_EQ(fill_rectangle(image.view(), {1, 0, 1, 1}, Rgb888{1, 2, 3}), Status::ok);
    EXPECT_EQ(image(0, 0), (Rgb888{0, 0, 0}));
    EXPECT_EQ(image(1, 0), (Rgb888{1, 2, 3}));
}

TEST(Rectangles, SayWhatIsWrongAndLeaveTheImage) {
    EXPECT_EQ(draw_rectangle(ImageView<Gray8>(), {0, 0, 1, 1}, 255, 0), Status::empty_image);
    EXPECT_EQ(fill_rectangle(ImageView<Gray8>(), {0, 0, -1, 1}, 255), Status::empty_image);
    GuardedImage<Gray8> image = black({3, 2});
    for (const Rectangle area :
         {Rectangle{0, 0, -1, 2}, Rectangle{0, 0, 2, -1}, Rectangle{0, 0, least, least}}) {
        EXPECT_EQ(draw_rectangle(image.view(), area, 255), Status::bad_argument);
        EXPECT_EQ(fill_rectangle(image.view(), area, 255), Status::bad_argument);
    }
    EXPECT_EQ(draw_rectangle(image.view(), {0, 0, 2, 2}, 255, 0), Status::bad_argument);
    EXPECT_EQ(draw_rectangle(image.view(), {0, 0, 2, 2}, 255, -1), Status::bad_argument);
    EXPECT_EQ(picture(image), (Picture{"...", "..."}));
}

}  // namespace
}  // namespace fovea::test
