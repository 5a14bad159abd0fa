// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <fovea/base/random.hpp>
#include <fovea/warp/from_points.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

FinePoint at(int x, int y) { return {FinePixel::from_int(x), FinePixel::from_int(y)}; }
FinePoint random_place(Random& random, std::int32_t most) {
    return {FinePixel::from_raw(random.between(0, most)), FinePixel::from_raw(random.between(0, most))};
}
double area(FinePoint a, FinePoint b, FinePoint c) {
    const auto x = [](FinePoint p) { return static_cast<double>(p.x.raw()); };
    const auto y = [](FinePoint p) { return static_cast<double>(p.y.raw()); };
    return (x(b) - x(a)) * (y(c) - y(a)) - (y(b) - y(a)) * (x(c) - x(a));
}
/// The smallest triangle of three corners, as a part of the square they may fill.
double thinnest(const FinePoint (&q)[4], double most) {
    double least = 1;
    for (int i = 0; i < 4; ++i)
        least = std::min(least, std::abs(area(q[i], q[(i + 1) % 4], q[(i + 2) % 4])) / (most * most));
    return least;
}

TEST(AffineThrough, TakesARightAngleToAnother) {
    // Twice as large, a quarter turn clockwise, and moved by (10, 20).
    const Result<AffineTransform> t =
        affine_through({at(0, 0), at(1, 0), at(0, 1)}, {at(10, 20), at(10, 22), at(8, 20)});
    ASSERT_TRUE(t.ok());
    EXPECT_EQ(t->xx.raw(), 0);
    EXPECT_EQ(t->xy, WarpCoefficient::from_int(-2));
    EXPECT_EQ(t->x0, WarpCoefficient::from_int(10));
    EXPECT_EQ(t->yx, WarpCoefficient::from_int(2));
    EXPECT_EQ(t->yy.raw(), 0);
    EXPECT_EQ(t->y0, WarpCoefficient::from_int(20));
}

TEST(AffineThrough, MeetsItsThreePlaces) {
    Random random(71);
    for (int round = 0; round < 2000; ++round) {
        FinePoint from[3], to[3];
        for (int i = 0; i < 3; ++i) {
            from[i] = random_place(random, 640 * 65536);
            to[i] = random_place(random, 640 * 65536);
        }
        if (std::abs(area(from[0], from[1], from[2])) < 1e10) continue;
        const Result<AffineTransform> t = affine_through(from, to);
        ASSERT_TRUE(t.ok());
        for (int i = 0; i < 3; ++i) EXPECT_EQ(map_point(*t, from[i]).value(), to[i]);
    }
}

TEST(AffineThrough, SaysWhereThereIsNone) {
    EXPECT_EQ(affine_through({at(0, 0), at(1, 1), at(5, 5)}, {at(0, 0), at(1, 0), at(0, 1)}).status(),
              Status::degenerate);
    const FinePoint near[3] = {at(0, 0), {FinePixel::from_raw(1), {}}, {{}, FinePixel::from_raw(1)}};
    EXPECT_EQ(affine_through(near, {at(0, 0), at(30000, 0), at(0, 30000)}).status(), Status::out_of_range);
}

TEST(HomographyThrough, SeesARectangleUpright) {
    // A square seen at a slant: the far side is half as long.
    const FinePoint card[4] = {at(0, 0), at(100, 0), at(100, 100), at(0, 100)};
    const FinePoint seen[4] = {at(25, 0), at(75, 0), at(100, 60), at(0, 60)};
    const Result<Homography> h = homography_through(card, seen);
    ASSERT_TRUE(h.ok());
    for (int i = 0; i < 4; ++i) EXPECT_EQ(map_point(*h, card[i]).value(), seen[i]);
    // The diagonals meet in the middle of the card, and in the picture at a third of its height.
    EXPECT_EQ(map_point(*h, at(50, 50)).value(), at(50, 20));
}

TEST(HomographyThrough, MeetsItsFourPlaces) {
    Random random(72);
    int done = 0;
    for (int round = 0; round < 20000; ++round) {
        const std::int32_t most = round % 2 == 0 ? 640 * 65536 : max_image_side * 65536;
        FinePoint from[4], to[4];
        for (int i = 0; i < 4; ++i) {
            from[i] = random_place(random, most);
            to[i] = random_place(random, most);
        }
        if (thinnest(from, most) < 1.0 / 16 || thinnest(to, most) < 1.0 / 16) continue;
        const Result<Homography> h = homography_through(from, to);
        if (!h) {
            ASSERT_EQ(h.status(), Status::degenerate);
            continue;
        }
        for (int i = 0; i < 4; ++i) {
            const Result<FinePoint> p = map_point(*h, from[i]);
            ASSERT_TRUE(p.ok());
            // 2^-10 px.
            EXPECT_LE(std::abs(p->x.raw() - to[i].x.raw()), 64);
            EXPECT_LE(std::abs(p->y.raw() - to[i].y.raw()), 64);
        }
        ++done;
    }
    EXPECT_GT(done, 300);
}

TEST(HomographyThrough, HasTheCoefficientsOfAnAffineTransformForParallelograms) {
    const Result<Homography> h = homography_through({at(0, 0), at(10, 0), at(10, 10), at(0, 10)},
                                                    {at(5, 5), at(15, 7), at(13, 17), at(3, 15)});
    ASSERT_TRUE(h.ok());
    EXPECT_EQ(h->wx, 0);
    EXPECT_EQ(h->wy, 0);
    EXPECT_NEAR(static_cast<double>(h->xx) / static_cast<double>(h->w0), 1, 1e-9);
    EXPECT_NEAR(static_cast<double>(h->xy) / static_cast<double>(h->w0), -0.2, 1e-9);
    EXPECT_NEAR(static_cast<double>(h->yx) / static_cast<double>(h->w0), 0.2, 1e-9);
    EXPECT_NEAR(static_cast<double>(h->x0) / static_cast<double>(h->w0), 5, 1e-9);
}

TEST(HomographyThrough, WarpsAnImageOfTheLargestSize) {
    const int last = max_image_side - 1;
    const Result<Homography> h = homography_through({at(0, 0), at(last, 0), at(last, last), at(0, last)},
                                                    {at(10, 0), at(20, 3), at(31, 30), at(0, 28)});
    ASSERT_TRUE(h.ok());
    GuardedImage<Gray8> src({32, 31}), dst({max_image_side, 1});
    src.fill(Gray8{50});
    EXPECT_EQ(warp_homography<Gray8>(src.view(), *h, {}, dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), 50);
    EXPECT_EQ(dst(last, 0), 50);
}

TEST(HomographyThrough, SaysWhereThereIsNone) {
    const FinePoint square[4] = {at(0, 0), at(10, 0), at(10, 10), at(0, 10)};
    // Three on a line, two alike, one inside the other three, and crossed sides.
    EXPECT_EQ(homography_through(square, {at(0, 0), at(5, 0), at(10, 0), at(0, 10)}).status(),
              Status::degenerate);
    EXPECT_EQ(homography_through({at(0, 0), at(0, 0), at(10, 10), at(0, 10)}, square).status(),
              Status::degenerate);
    EXPECT_EQ(homography_through(square, {at(0, 0), at(10, 0), at(3, 3), at(0, 10)}).status(),
              Status::degenerate);
    EXPECT_EQ(homography_through(square, {at(0, 0), at(10, 10), at(10, 0), at(0, 10)}).status(),
              Status::degenerate);
    // Mirrored is fine.
    EXPECT_TRUE(homography_through(square, {at(10, 0), at(0, 0), at(0, 10), at(10, 10)}).ok());
}

}  // namespace
}  // namespace fovea::test
