// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <fovea/base/random.hpp>
#include <fovea/warp/flip.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

template <class Pixel>
class Flip : public testing::Test {};
using Pixels = testing::Types<Gray8, Rgb888, Gray16>;
struct PixelNames {
    template <class Pixel>
    static std::string GetName(int number) {
        return std::string("OfPixel") + std::to_string(number);
    }
};
TYPED_TEST_SUITE(Flip, Pixels, PixelNames);

TEST(FlipByHand, TurnsTwoByThreePixels) {
    // a b      as numbers 1 2
    // c d                 3 4
    // e f                 5 6
    GuardedImage<Gray8> src({2, 3}), dst({3, 2});
    for (int i = 0; i < 6; ++i) src(i % 2, i / 2) = static_cast<Gray8>(i + 1);
    const auto expect = [&](int a, int b, int c, int d, int e, int f) {
        EXPECT_EQ(dst(0, 0), a);
        EXPECT_EQ(dst(1, 0), b);
        EXPECT_EQ(dst(2, 0), c);
        EXPECT_EQ(dst(0, 1), d);
        EXPECT_EQ(dst(1, 1), e);
        EXPECT_EQ(dst(2, 1), f);
    };
    ASSERT_EQ(transpose<Gray8>(src.view(), dst.view()), Status::ok);
    expect(1, 3, 5, 2, 4, 6);
    ASSERT_EQ(rotate_90_clockwise<Gray8>(src.view(), dst.view()), Status::ok);
    expect(5, 3, 1, 6, 4, 2);
    ASSERT_EQ(rotate_90_counterclockwise<Gray8>(src.view(), dst.view()), Status::ok);
    expect(2, 4, 6, 1, 3, 5);
}

TYPED_TEST(Flip, MovesEveryPixelWhereItBelongs) {
    using Pixel = TypeParam;
    Random random(31);
    for (const Size size : test_sizes()) {
        const int w = size.width;
        const int h = size.height;
        GuardedImage<Pixel> src(size), x(size), y(size), both(size), t({h, w}), cw({h, w}), ccw({h, w});
        src.fill(random);
        ASSERT_EQ(flip_x<Pixel>(src.view(), x.view()), Status::ok);
        ASSERT_EQ(flip_y<Pixel>(src.view(), y.view()), Status::ok);
        ASSERT_EQ(rotate_180<Pixel>(src.view(), both.view()), Status::ok);
        ASSERT_EQ(transpose<Pixel>(src.view(), t.view()), Status::ok);
        ASSERT_EQ(rotate_90_clockwise<Pixel>(src.view(), cw.view()), Status::ok);
        ASSERT_EQ(rotate_90_counterclockwise<Pixel>(src.view(), ccw.view()), Status::ok);
        for (int v = 0; v < h; ++v)
            for (int u = 0; u < w; ++u) {
                const Pixel pixel = src(u, v);
                ASSERT_TRUE(x(w - 1 - u, v) == pixel);
                ASSERT_TRUE(y(u, h - 1 - v) == pixel);
                ASSERT_TRUE(both(w - 1 - u, h - 1 - v) == pixel);
                ASSERT_TRUE(t(v, u) == pixel) << w << "x" << h << " at " << u << "," << v;
                ASSERT_TRUE(cw(h - 1 - v, u) == pixel);
                ASSERT_TRUE(ccw(v, w - 1 - u) == pixel);
            }
    }
}

TYPED_TEST(Flip, FourQuarterTurnsAreNone) {
    using Pixel = TypeParam;
    Random random(32);
    GuardedImage<Pixel> src({37, 50}), a({50, 37}), b({37, 50});
    src.fill(random);
    ASSERT_EQ(rotate_90_clockwise<Pixel>(src.view(), a.view()), Status::ok);
    ASSERT_EQ(rotate_90_clockwise<Pixel>(a.view(), b.view()), Status::ok);
    ASSERT_EQ(rotate_90_clockwise<Pixel>(b.view(), a.view()), Status::ok);
    ASSERT_EQ(rotate_90_clockwise<Pixel>(a.view(), b.view()), Status::ok);
    EXPECT_TRUE(equal(src.view(), b.view()));
}

TYPED_TEST(Flip, RefusesAnOutputOfAnotherShape) {
    using Pixel = TypeParam;
    GuardedImage<Pixel> src({4, 3}), same({4, 3}), turned({3, 4});
    EXPECT_EQ(transpose<Pixel>(src.view(), same.view()), Status::size_mismatch);
    EXPECT_EQ(rotate_90_clockwise<Pixel>(src.view(), same.view()), Status::size_mismatch);
    EXPECT_EQ(rotate_90_counterclockwise<Pixel>(src.view(), same.view()), Status::size_mismatch);
    EXPECT_EQ(flip_x<Pixel>(src.view(), turned.view()), Status::size_mismatch);
    EXPECT_EQ(rotate_180<Pixel>(src.view(), turned.view()), Status::size_mismatch);
}

}  // namespace
}  // namespace fovea::test
