// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <core/draw/draw_reference.hpp>
#include <fovea/base/random.hpp>
#include <fovea/draw/cross.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

constexpr int far = max_draw_coordinate;

TEST(DrawCross, HasFourArms) {
    GuardedImage<Gray8> image = black({5, 5});
    ASSERT_EQ(draw_cross(image.view(), {2, 2}, 2, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"..#..", "..#..", "#####", "..#..", "..#.."}));
}

TEST(DrawDiagonalCross, HasFourArms) {
    GuardedImage<Gray8> image = black({5, 5});
    ASSERT_EQ(draw_diagonal_cross(image.view(), {2, 2}, 1, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{".....", ".#.#.", "..#..", ".#.#.", "....."}));
}

TEST(Crosses, WithoutArmsArePoints) {
    GuardedImage<Gray8> image = black({3, 1});
    ASSERT_EQ(draw_cross(image.view(), {0, 0}, 0, 255), Status::ok);
    ASSERT_EQ(draw_diagonal_cross(image.view(), {2, 0}, 0, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"#.#"}));
}

TEST(Crosses, EqualTheReference) {
    Random random(141);
    for (const Size size : drawing_sizes())
        for (const int reach : {0, 20, 300, 70000, 1 << 29})
            for (int round = 0; round < 100; ++round) {
                const Point c = random_point(random, size, reach);
                const int arm = random.between(0, reach + 10);
                GuardedImage<Gray8> upright = black(size);
                ASSERT_EQ(draw_cross(upright.view(), c, arm, 255), Status::ok);
                ASSERT_EQ(picture(upright), picture(naive_shape(size, [&](int x, int y) {
                                                        const int dx = std::abs(x - c.x);
                                                        const int dy = std::abs(y - c.y);
                                                        return (dx == 0 || dy == 0) && dx <= arm && dy <= arm;
                                                    }).view()));
                GuardedImage<Gray8> diagonal = black(size);
                ASSERT_EQ(draw_diagonal_cross(diagonal.view(), c, arm, 255), Status::ok);
                ASSERT_EQ(picture(diagonal), picture(naive_shape(size, [&](int x, int y) {
                                                         const int dx = std::abs(x - c.x);
                                                         return dx == std::abs(y - c.y) && dx <= arm;
                                                     }).view()));
            }
}

TEST(Crosses, MayBeThick) {
    GuardedImage<Gray8> image = black({5, 5});
    ASSERT_EQ(draw_cross(image.view(), {2, 2}, 1, 255, 3), Status::ok);
    EXPECT_EQ(picture(image), (Picture{".###.", "#####", "#####", "#####", ".###."}));
}

TEST(Crosses, SayWhatIsWrongAndLeaveTheImage) {
    EXPECT_EQ(draw_cross(ImageView<Gray8>(), {0, 0}, -1, 255), Status::empty_image);
    EXPECT_EQ(draw_diagonal_cross(ImageView<Gray8>(), {0, 0}, -1, 255), Status::empty_image);
    GuardedImage<Gray8> image = black({3, 3});
    const auto expect_bad = [&](Point centre, int arm, int thickness) {
        EXPECT_EQ(draw_cross(image.view(), centre, arm, 255, thickness), Status::bad_argument);
        EXPECT_EQ(draw_diagonal_cross(image.view(), centre, arm, 255, thickness), Status::bad_argument);
    };
    expect_bad({1, 1}, -1, 1);
    expect_bad({1, 1}, 1, 0);
    expect_bad({1, 1}, 1, max_line_thickness + 1);
    expect_bad({1, 1}, far, 1);
    expect_bad({far, 1}, 1, 1);
    expect_bad({1, -far}, 1, 1);
    EXPECT_EQ(picture(image), Picture(3, "..."));
    EXPECT_EQ(draw_cross(image.view(), {0, 0}, far, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"###", "#..", "#.."}));
}

}  // namespace
}  // namespace fovea::test
