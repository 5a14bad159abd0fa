// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <core/draw/draw_reference.hpp>
#include <fovea/base/random.hpp>
#include <fovea/draw/line.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

constexpr int far = max_draw_coordinate;

GuardedImage<Gray8> line(Size size, Point a, Point b, int thickness = 1) {
    GuardedImage<Gray8> image = black(size);
    EXPECT_EQ(draw_line(image.view(), a, b, 255, thickness), Status::ok);
    return image;
}

GuardedImage<Gray8> naive_line(Size size, Point a, Point b, int thickness) {
    return naive_shape(size, [&](int x, int y) {
        return thickness == 1 ? on_thin_line(a, b, {x, y}) : on_thick_line(a, b, thickness, {x, y});
    });
}

/// Bresenham's loop as in the textbooks, over every pixel of the line, each shown if it is inside.
GuardedImage<Gray8> unclipped_line(Size size, Point a, Point b) {
    GuardedImage<Gray8> image = black(size);
    const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
    if (steep) {
        std::swap(a.x, a.y);
        std::swap(b.x, b.y);
    }
    if (b.x < a.x) std::swap(a, b);
    const int dx = b.x - a.x;
    const int dy = std::abs(b.y - a.y);
    const int way = b.y < a.y ? -1 : 1;
    int error = 0;  // twice dx times the distance below the pixel's centre, seen along way
    int y = a.y;
    for (int x = a.x; x <= b.x; ++x) {
        const Point p = steep ? Point{y, x} : Point{x, y};
        if (image.view().contains(p)) image(p.x, p.y) = 255;
        error += 2 * dy;
        // Ties go to larger y: with way 1 that is onward, with way -1 it is to stay.
        if (way > 0 ? error >= dx : error > dx) {
            y += way;
            error -= 2 * dx;
        }
    }
    return image;
}

TEST(DrawLine, ClimbsTwoInFive) {
    GuardedImage<Gray8> image = line({6, 3}, {0, 0}, {5, 2});
    EXPECT_EQ(picture(image), (Picture{"##....", "..##..", "....##"}));
}

TEST(DrawLine, TiesGoRightOrDown) {
    GuardedImage<Gray8> falling = line({3, 2}, {0, 0}, {2, 1});
    EXPECT_EQ(picture(falling), (Picture{"#..", ".##"}));
    GuardedImage<Gray8> rising = line({3, 2}, {0, 1}, {2, 0});
    EXPECT_EQ(picture(rising), (Picture{"..#", "##."}));
    GuardedImage<Gray8> steep = line({2, 3}, {0, 0}, {1, 2});
    EXPECT_EQ(picture(steep), (Picture{"#.", ".#", ".#"}));
    GuardedImage<Gray8> leftward = line({2, 3}, {1, 0}, {0, 2});
    EXPECT_EQ(picture(leftward), (Picture{".#", ".#", "#."}));
}

TEST(DrawLine, OfOnePointIsThePoint) {
    GuardedImage<Gray8> image = line({3, 3}, {1, 2}, {1, 2});
    EXPECT_EQ(picture(image), (Picture{"...", "...", ".#."}));
}

TEST(DrawLine, DrawsInColour) {
    GuardedImage<Rgb888> image({3, 1});
    image.fill(Rgb888{0, 0, 0});
    ASSERT_EQ(draw_line(image.view(), {1, 0}, {9, 0}, Rgb888{9, 8, 7}), Status::ok);
    EXPECT_EQ(image(0, 0), (Rgb888{0, 0, 0}));
    EXPECT_EQ(image(1, 0), (Rgb888{9, 8, 7}));
    EXPECT_EQ(image(2, 0), (Rgb888{9, 8, 7}));
}

TEST(DrawLine, EqualsTheUnclippedLoop) {
    Random random(111);
    for (const Size size : drawing_sizes())
        for (int round = 0; round < 1500; ++round) {
            const Point a = random_point(random, size, round % 60);
            const Point b = random_point(random, size, round % 60);
            GuardedImage<Gray8> image = line(size, a, b);
            ASSERT_EQ(picture(image), picture(unclipped_line(size, a, b).view()))
                << a.x << "," << a.y << " to " << b.x << "," << b.y;
        }
}

TEST(DrawLine, EqualsTheReferenceNearAndFar) {
    Random random(112);
    const std::vector<int> thicknesses = {1, 1, 2, 3, 4, 5, 16, 255};
    for (const Size size : drawing_sizes())
        for (const int reach : distances())
            for (const int thickness : thicknesses)
                for (int round = 0; round < 60; ++round) {
                    const Point a = random_point(random, size, reach);
                    const Point b = random_point(random, size, reach);
                    GuardedImage<Gray8> image = line(size, a, b, thickness);
                    ASSERT_EQ(picture(image), picture(naive_line(size, a, b, thickness).view()))
                        << a.x << "," << a.y << " to " << b.x << "," << b.y << " thickness " << thickness;
                }
}

TEST(DrawLine, EqualsTheReferenceForAllShortLines) {
    const Size size{13, 13};
    for (int y = 0; y < 13; ++y)
        for (int x = 0; x < 13; ++x)
            for (const int thickness : {1, 2, 3, 4, 7}) {
                GuardedImage<Gray8> image = line(size, {6, 6}, {x, y}, thickness);
                ASSERT_EQ(picture(image), picture(naive_line(size, {6, 6}, {x, y}, thickness).view()))
                    << "to " << x << "," << y << " thickness " << thickness;
            }
}

TEST(DrawLine, IsTheSameFromBothEnds) {
    Random random(113);
    const Size size{31, 22};
    for (int round = 0; round < 3000; ++round) {
        const int thickness = random.between(1, 6);
        const int reach = distances()[random.below(6)];
        const Point a = random_point(random, size, reach);
        const Point b = random_point(random, size, reach);
        GuardedImage<Gray8> there = line(size, a, b, thickness);
        GuardedImage<Gray8> back = line(size, b, a, thickness);
        ASSERT_EQ(picture(there), picture(back));
    }
}

TEST(DrawLine, ACropShowsWhatTheWholeImageShows) {
    Random random(114);
    for (int round = 0; round < 500; ++round) {
        const int thickness = random.between(1, 4);
        const Point a = random_point(random, {64, 48}, 40);
        const Point b = random_point(random, {64, 48}, 40);
        GuardedImage<Gray8> whole = line({64, 48}, a, b, thickness);
        GuardedImage<Gray8> part = line({20, 15}, {a.x - 22, a.y - 17}, {b.x - 22, b.y - 17}, thickness);
        const auto same_part = whole.view().crop({22, 17, 20, 15});
        ASSERT_TRUE(same_part.ok());
        ASSERT_TRUE(equal(*same_part, part.view()));
    }
}

// The original looped over every pixel of a line, inside or not: such an end point would keep it for hours.
// 40000 lines of 2^31 steps each would take days.
TEST(DrawLine, FarEndPointsTakeNoTime) {
    Random random(115);
    GuardedImage<Gray8> image = black({640, 480});
    for (int round = 0; round < 40000; ++round) {
        // One crosses the image from corner to corner, the next level: in the column 0 at half of slip.
        const int slip = random.between(0, 900);
        const Point a{-far, round % 2 == 0 ? -far + slip : 0};
        const Point b{far, round % 2 == 0 ? far : slip};
        ASSERT_EQ(draw_line(image.view(), a, b, 255), Status::ok);
        ASSERT_EQ(image(0, (slip + 1) / 2), 255);
    }
}

TEST(DrawLine, HoldsAtTheEndsOfTheRange) {
    const Size size{9, 7};
    const std::vector<int> places = {-far, -far + 1, -1, 0, 3, 7, 9, far - 1, far};
    for (const int ax : places)
        for (const int ay : places)
            for (const int bx : places)
                for (const int by : places)
                    for (const int thickness : {1, 2, 9, max_line_thickness}) {
                        GuardedImage<Gray8> image = line(size, {ax, ay}, {bx, by}, thickness);
                        ASSERT_EQ(picture(image),
                                  picture(naive_line(size, {ax, ay}, {bx, by}, thickness).view()))
                            << ax << "," << ay << " to " << bx << "," << by << " thickness " << thickness;
                    }
}

TEST(DrawLine, ThicknessThreeHasRoundEnds) {
    GuardedImage<Gray8> image = line({8, 5}, {2, 2}, {5, 2}, 3);
    EXPECT_EQ(picture(image), (Picture{"........", ".######.", ".######.", ".######.", "........"}));
    GuardedImage<Gray8> thick = line({10, 7}, {3, 3}, {6, 3}, 5);
    EXPECT_EQ(picture(thick), (Picture{"..........", "..######..", ".########.", ".########.", ".########.",
                                       "..######..", ".........."}));
}

TEST(DrawLine, ALevelLineHasAsManyRowsAsItIsThick) {
    for (int thickness = 1; thickness <= 20; ++thickness) {
        GuardedImage<Gray8> level = line({60, 41}, {-20, 20}, {80, 20}, thickness);
        GuardedImage<Gray8> upright = line({41, 60}, {20, -20}, {20, 80}, thickness);
        for (int i = 0; i < 41; ++i) {
            const bool inside = i >= 20 - thickness / 2 && i <= 20 + (thickness - 1) / 2;
            EXPECT_EQ(level(30, i), inside ? 255 : 0) << thickness;
            EXPECT_EQ(upright(i, 30), inside ? 255 : 0) << thickness;
        }
    }
}

TEST(DrawLine, AnOddThickLineCoversTheThinnerOnes) {
    Random random(116);
    const Size size{40, 30};
    for (int round = 0; round < 500; ++round) {
        const Point a = random_point(random, size, 10);
        const Point b = random_point(random, size, 10);
        GuardedImage<Gray8> thinner = line(size, a, b);
        for (const int thickness : {3, 5, 7}) {
            GuardedImage<Gray8> image = line(size, a, b, thickness);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) ASSERT_GE(image(x, y), thinner(x, y));
            thinner = image;
        }
    }
}

TEST(DrawLine, SaysWhatIsWrongAndLeavesTheImage) {
    EXPECT_EQ(draw_line(ImageView<Gray8>(), {0, 0}, {1, 1}, 255, 0), Status::empty_image);
    GuardedImage<Gray8> image = black({5, 5});
    for (const Point p : {Point{far + 1, 0}, {-far - 1, 0}, {0, far + 1}, {0, -far - 1}}) {
        EXPECT_EQ(draw_line(image.view(), {1, 1}, p, 255), Status::bad_argument);
        EXPECT_EQ(draw_line(image.view(), p, {1, 1}, 255), Status::bad_argument);
    }
    for (const int thickness : {-1, 0, max_line_thickness + 1})
        EXPECT_EQ(draw_line(image.view(), {1, 1}, {3, 3}, 255, thickness), Status::bad_argument);
    EXPECT_EQ(picture(image), Picture(5, "....."));
}

TEST(DrawPolyline, DrawsALineFromEachPointToTheNext) {
    GuardedImage<Gray8> image = black({5, 4});
    const Point points[] = {{0, 0}, {4, 0}, {4, 3}, {2, 3}};
    ASSERT_EQ(draw_polyline<Gray8>(image.view(), points, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"#####", "....#", "....#", "..###"}));
}

TEST(DrawPolyline, OfOnePointIsThePointAndOfNoneNothing) {
    GuardedImage<Gray8> image = black({5, 2});
    ASSERT_EQ(draw_polyline<Gray8>(image.view(), {}, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{".....", "....."}));
    const Point point[] = {{2, 1}};
    ASSERT_EQ(draw_polyline<Gray8>(image.view(), point, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{".....", "..#.."}));
}

TEST(DrawPolyline, ChecksEveryPointBeforeItDraws) {
    GuardedImage<Gray8> image = black({5, 2});
    const Point points[] = {{0, 0}, {4, 0}, {far + 1, 0}};
    EXPECT_EQ(draw_polyline<Gray8>(ImageView<Gray8>(), points, 255), Status::empty_image);
    EXPECT_EQ(draw_polyline<Gray8>(image.view(), points, 255), Status::bad_argument);
    EXPECT_EQ(draw_polyline<Gray8>(image.view(), {points, 2}, 255, 0), Status::bad_argument);
    EXPECT_EQ(draw_polyline<Gray8>(image.view(), {}, 255, 256), Status::bad_argument);
    EXPECT_EQ(picture(image), (Picture{".....", "....."}));
}

}  // namespace
}  // namespace fovea::test
