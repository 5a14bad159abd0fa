// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include <core/draw/draw_reference.hpp>
#include <fovea/base/random.hpp>
#include <fovea/draw/circle.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

constexpr int huge = max_circle_radius;

GuardedImage<Gray8> circle(Size size, Point centre, int radius, int thickness = 1) {
    GuardedImage<Gray8> image = black(size);
    EXPECT_EQ(draw_circle(image.view(), centre, radius, 255, thickness), Status::ok);
    return image;
}
GuardedImage<Gray8> disc(Size size, Point centre, int radius) {
    GuardedImage<Gray8> image = black(size);
    EXPECT_EQ(fill_circle(image.view(), centre, radius, 255), Status::ok);
    return image;
}

GuardedImage<Gray8> naive_circle(Size size, Point centre, int radius, int thickness) {
    return naive_shape(size, [&](int x, int y) {
        return in_disc(centre, std::int64_t{radius} + (thickness - 1) / 2, {x, y}) &&
               !enclosed_by_circle(centre, std::int64_t{radius} - thickness / 2, {x, y});
    });
}
GuardedImage<Gray8> naive_disc(Size size, Point centre, int radius) {
    return naive_shape(size, [&](int x, int y) { return in_disc(centre, radius, {x, y}); });
}

/// One octant with the nearest row found by trying all, mirrored seven times.
GuardedImage<Gray8> mirrored_octant(int radius) {
    const int middle = radius + 1;
    GuardedImage<Gray8> image = black({2 * middle + 1, 2 * middle + 1});
    for (int dx = 0; dx <= radius; ++dx) {
        const double exact = std::sqrt(double(radius) * radius - double(dx) * dx);
        int dy = 0;
        while (std::abs(dy + 1 - exact) < std::abs(dy - exact)) ++dy;
        if (dx > dy) break;
        for (const auto& [x, y] : {std::pair{dx, dy}, std::pair{dy, dx}})
            for (const int way_x : {-1, 1})
                for (const int way_y : {-1, 1}) image(middle + way_x * x, middle + way_y * y) = 255;
    }
    return image;
}

TEST(DrawCircle, OfSmallRadius) {
    GuardedImage<Gray8> point = circle({3, 3}, {1, 1}, 0);
    EXPECT_EQ(picture(point), (Picture{"...", ".#.", "..."}));
    GuardedImage<Gray8> one = circle({3, 3}, {1, 1}, 1);
    EXPECT_EQ(picture(one), (Picture{".#.", "#.#", ".#."}));
    // sqrt(4 - 1) = 1.7 is row 2.
    GuardedImage<Gray8> two = circle({5, 5}, {2, 2}, 2);
    EXPECT_EQ(picture(two), (Picture{".###.", "#...#", "#...#", "#...#", ".###."}));
    // sqrt(9 - 1) = 2.8 is row 3, sqrt(9 - 4) = 2.2 is row 2.
    GuardedImage<Gray8> three = circle({7, 7}, {3, 3}, 3);
    EXPECT_EQ(picture(three),
              (Picture{"..###..", ".#...#.", "#.....#", "#.....#", "#.....#", ".#...#.", "..###.."}));
}

TEST(FillCircle, OfSmallRadius) {
    GuardedImage<Gray8> point = disc({3, 3}, {1, 1}, 0);
    EXPECT_EQ(picture(point), (Picture{"...", ".#.", "..."}));
    GuardedImage<Gray8> one = disc({3, 3}, {1, 1}, 1);
    EXPECT_EQ(picture(one), (Picture{".#.", "###", ".#."}));
    GuardedImage<Gray8> three = disc({7, 7}, {3, 3}, 3);
    EXPECT_EQ(picture(three),
              (Picture{"..###..", ".#####.", "#######", "#######", "#######", ".#####.", "..###.."}));
}

TEST(DrawCircle, ThicknessGrowsBothWaysAndInwardFirst) {
    GuardedImage<Gray8> two = circle({7, 7}, {3, 3}, 3, 2);
    EXPECT_EQ(picture(two),
              (Picture{"..###..", ".#####.", "##...##", "##...##", "##...##", ".#####.", "..###.."}));
    GuardedImage<Gray8> three = circle({9, 9}, {4, 4}, 3, 3);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) {
            GuardedImage<Gray8> inner = circle({9, 9}, {4, 4}, 2);
            GuardedImage<Gray8> middle = circle({9, 9}, {4, 4}, 3);
            GuardedImage<Gray8> outer = circle({9, 9}, {4, 4}, 4);
            EXPECT_GE(three(x, y), std::max({inner(x, y), middle(x, y), outer(x, y)}));
        }
    // A ring as thick as its radius has no hole.
    GuardedImage<Gray8> full = circle({9, 9}, {4, 4}, 2, 5);
    EXPECT_TRUE(equal(full.view(), disc({9, 9}, {4, 4}, 4).view()));
}

TEST(DrawCircle, EqualsAMirroredOctantOfNearestPixels) {
    for (int radius = 0; radius <= 200; ++radius) {
        GuardedImage<Gray8> expected = mirrored_octant(radius);
        GuardedImage<Gray8> image = circle(expected.view().size(), {radius + 1, radius + 1}, radius);
        ASSERT_EQ(picture(image), picture(expected)) << radius;
    }
}

TEST(DrawCircle, HasNoGapAndTheDiscIsWhatItEncloses) {
    for (int radius = 0; radius <= 70; ++radius) {
        const int side = 2 * radius + 3;
        GuardedImage<Gray8> outline = circle({side, side}, {radius + 1, radius + 1}, radius);
        // Flood the ground from a corner, over edges only: a gap, even a diagonal one, would let it in.
        std::vector<Point> open = {{0, 0}};
        GuardedImage<Gray8> flooded = outline;
        while (!open.empty()) {
            const Point p = open.back();
            open.pop_back();
            if (!flooded.view().contains(p) || flooded(p.x, p.y) != 0) continue;
            flooded(p.x, p.y) = 1;
            for (const Point q : {Point{p.x + 1, p.y}, {p.x - 1, p.y}, {p.x, p.y + 1}, {p.x, p.y - 1}})
                open.push_back(q);
        }
        GuardedImage<Gray8> filled = disc({side, side}, {radius + 1, radius + 1}, radius);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) ASSERT_EQ(flooded(x, y) != 1, filled(x, y) == 255) << radius;
    }
}

TEST(Circles, EqualTheReferenceNearAndFar) {
    Random random(151);
    for (const Size size : drawing_sizes())
        for (const int reach : distances())
            for (int round = 0; round < 150; ++round) {
                const Point centre = random_point(random, size, reach);
                // A radius that passes the image: the distance of one of its pixels, more or less.
                const Point through = random_point(random, size, 0);
                const double distance =
                    std::hypot(double(centre.x) - through.x, double(centre.y) - through.y);
                const int slip = random.between(-3, 3);
                const int radius = static_cast<int>(std::clamp(distance + slip, 0.0, double(huge)));
                const int thickness = round % 3 == 0 ? random.between(1, 12) : 1;
                GuardedImage<Gray8> outline = circle(size, centre, radius, thickness);
                ASSERT_EQ(picture(outline), picture(naive_circle(size, centre, radius, thickness).view()))
                    << centre.x << "," << centre.y << " radius " << radius << " thickness " << thickness;
                GuardedImage<Gray8> filled = disc(size, centre, radius);
                ASSERT_EQ(picture(filled), picture(naive_disc(size, centre, radius).view()))
                    << centre.x << "," << centre.y << " radius " << radius;
            }
}

TEST(Circles, HoldAtTheEndsOfTheRange) {
    const Size size{9, 7};
    const int least = std::numeric_limits<int>::min();
    const int most = std::numeric_limits<int>::max();
    for (const int x : {least, -huge, -1, 4, 9, huge, most})
        for (const int y : {least, -huge + 1, 0, 3, huge, most})
            for (const int radius : {0, 1, 5, 32768, huge - 1, huge})
                for (const int thickness : {1, 2, 3, max_line_thickness}) {
                    GuardedImage<Gray8> outline = circle(size, {x, y}, radius, thickness);
                    ASSERT_EQ(picture(outline), picture(naive_circle(size, {x, y}, radius, thickness).view()))
                        << x << "," << y << " radius " << radius << " thickness " << thickness;
                    GuardedImage<Gray8> filled = disc(size, {x, y}, radius);
                    ASSERT_EQ(picture(filled), picture(naive_disc(size, {x, y}, radius).view()));
                }
}

// A walk around the whole circle would take days.
TEST(Circles, HugeOnesTakeNoTime) {
    GuardedImage<Gray8> image = black({64, 48});
    for (int i = 0; i < 20000; ++i) {
        ASSERT_EQ(draw_circle(image.view(), {32, -huge + i % 48}, huge, 255), Status::ok);
        ASSERT_EQ(image(32, i % 48), 255);
    }
}

TEST(Circles, DrawInColour) {
    GuardedImage<Rgb888> image({3, 3});
    image.fill(Rgb888{0, 0, 0});
    ASSERT_EQ(fill_circle(image.view(), {1, 1}, 1, Rgb888{1, 2, 3}), Status::ok);
    ASSERT_EQ(draw_circle(image.view(), {1, 1}, 1, Rgb888{4, 5, 6}), Status::ok);
    EXPECT_EQ(image(0, 0), (Rgb888{0, 0, 0}));
    EXPECT_EQ(image(1, 1), (Rgb888{1, 2, 3}));
    EXPECT_EQ(image(1, 0), (Rgb888{4, 5, 6}));
}

TEST(Circles, SayWhatIsWrongAndLeaveTheImage) {
    EXPECT_EQ(draw_circle(ImageView<Gray8>(), {0, 0}, -1, 255), Status::empty_image);
    EXPECT_EQ(fill_circle(ImageView<Gray8>(), {0, 0}, -1, 255), Status::empty_image);
    GuardedImage<Gray8> image = black({5, 5});
    for (const int radius : {-1, huge + 1, std::numeric_limits<int>::min()}) {
        EXPECT_EQ(draw_circle(image.view(), {2, 2}, radius, 255), Status::bad_argument);
        EXPECT_EQ(fill_circle(image.view(), {2, 2}, radius, 255), Status::bad_argument);
    }
    for (const int thickness : {-1, 0, max_line_thickness + 1})
        EXPECT_EQ(draw_circle(image.view(), {2, 2}, 2, 255, thickness), Status::bad_argument);
    EXPECT_EQ(picture(image), Picture(5, "....."));
}

}  // namespace
}  // namespace fovea::test
