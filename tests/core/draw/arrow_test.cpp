// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <core/draw/draw_reference.hpp>
#include <fovea/base/random.hpp>
#include <fovea/draw/arrow.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

constexpr int far = max_draw_coordinate;

GuardedImage<Gray8> arrow(Size size, Point tail, Point tip, int head_length, int thickness = 1) {
    GuardedImage<Gray8> image = black(size);
    EXPECT_EQ(draw_arrow(image.view(), tail, tip, 255, head_length, thickness), Status::ok);
    return image;
}

TEST(DrawArrow, HasStrokesHalfAsFarAsideAsBack) {
    // From (4, 0) and (4, 4) to (8, 2): the half rows at x 5 and 7 are ties and go down.
    GuardedImage<Gray8> image = arrow({9, 5}, {0, 2}, {8, 2}, 4);
    EXPECT_EQ(picture(image), (Picture{"....#....", ".....##..", "#########", "......##.", "....##..."}));
    GuardedImage<Gray8> down = arrow({5, 7}, {2, 0}, {2, 6}, 2);
    EXPECT_EQ(picture(down), (Picture{"..#..", "..#..", "..#..", "..#..", ".###.", "..##.", "..#.."}));
}

TEST(DrawArrow, EqualsThreeLines) {
    Random random(121);
    const Size size{60, 50};
    for (int round = 0; round < 1000; ++round) {
        const Point tail = random_point(random, size, 200);
        const Point tip = random_point(random, size, 200);
        if (tail == tip) continue;
        const int head = random.between(0, 30);
        const int thickness = random.between(1, 4);
        GuardedImage<Gray8> expected = black(size);
        ASSERT_EQ(draw_line(expected.view(), tail, tip, 255, thickness), Status::ok);
        const double dx = tip.x - tail.x;
        const double dy = tip.y - tail.y;
        const double length = std::hypot(dx, dy);
        for (const double side : {0.5, -0.5}) {
            const double x = tip.x - head * (dx + side * dy) / length;
            const double y = tip.y - head * (dy - side * dx) / length;
            // No multiple of 1/2 pixel that is not exact comes closer than this to a tie.
            const Point end{static_cast<int>(std::floor(x + 0.5 + 1e-9)),
                            static_cast<int>(std::floor(y + 0.5 + 1e-9))};
            ASSERT_EQ(draw_line(expected.view(), end, tip, 255, thickness), Status::ok);
        }
        GuardedImage<Gray8> image = arrow(size, tail, tip, head, thickness);
        ASSERT_EQ(picture(image), picture(expected));
    }
}

TEST(DrawArrow, StrokesOfTheLongestArrowsEndWhereTheyShould) {
    for (const int head : {1, 100, max_image_side}) {
        // 45 degrees: back by head / sqrt(2) * (1 -+ 1/2).
        const detail::ArrowStroke stroke =
            detail::arrow_stroke(std::int64_t{1} << 31, std::int64_t{1} << 31, head, 1);
        EXPECT_EQ(stroke.dx, std::llround(-head * 1.5 / std::sqrt(2.0)));
        EXPECT_EQ(stroke.dy, std::llround(-head * 0.5 / std::sqrt(2.0)));
        const detail::ArrowStroke level = detail::arrow_stroke(-(std::int64_t{1} << 31), 0, head, -1);
        EXPECT_EQ(level.dx, head);
        EXPECT_EQ(level.dy, (head + 1) / 2);
    }
}

TEST(DrawArrow, WithoutLengthIsAPoint) {
    GuardedImage<Gray8> image = arrow({3, 3}, {1, 1}, {1, 1}, 5);
    EXPECT_EQ(picture(image), (Picture{"...", ".#.", "..."}));
}

TEST(DrawArrow, MayLieFarOutside) {
    GuardedImage<Gray8> image = arrow({4, 3}, {-far, 1}, {far, 1}, 7);
    EXPECT_EQ(picture(image), (Picture{"....", "####", "...."}));
}

TEST(DrawArrow, SaysWhatIsWrongAndLeavesTheImage) {
    EXPECT_EQ(draw_arrow(ImageView<Gray8>(), {0, 0}, {1, 1}, 255, 3), Status::empty_image);
    GuardedImage<Gray8> image = black({5, 5});
    EXPECT_EQ(draw_arrow(image.view(), {0, 0}, {far + 1, 0}, 255, 3), Status::bad_argument);
    EXPECT_EQ(draw_arrow(image.view(), {0, -far - 1}, {1, 1}, 255, 3), Status::bad_argument);
    EXPECT_EQ(draw_arrow(image.view(), {0, 0}, {4, 4}, 255, -1), Status::bad_argument);
    EXPECT_EQ(draw_arrow(image.view(), {0, 0}, {4, 4}, 255, max_image_side + 1), Status::bad_argument);
    EXPECT_EQ(draw_arrow(image.view(), {0, 0}, {4, 4}, 255, 3, 0), Status::bad_argument);
    EXPECT_EQ(draw_arrow(image.view(), {0, 0}, {4, 4}, 255, 3, 256), Status::bad_argument);
    // The stroke of a head at the end of the range ends beyond it.
    EXPECT_EQ(draw_arrow(image.view(), {0, 0}, {far, far - 1}, 255, 300), Status::ok);
    GuardedImage<Gray8> other = black({5, 5});
    EXPECT_EQ(draw_arrow(other.view(), {0, far}, {9, far}, 255, 9), Status::bad_argument);
    EXPECT_EQ(picture(other), Picture(5, "....."));
}

}  // namespace
}  // namespace fovea::test
