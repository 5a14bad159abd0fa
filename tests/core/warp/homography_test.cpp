// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/warp/homography.hpp>
#include <support/guarded_image.hpp>

#include "warp_reference.hpp"

namespace fovea::test {
namespace {

Homography homography(double xx, double xy, double x0, double yx, double yy, double y0, double wx, double wy,
                      double w0 = 1) {
    const auto raw = [](double value) {
        return static_cast<std::int64_t>(std::llround(std::ldexp(value, 40)));
    };
    return {raw(xx), raw(xy), raw(x0), raw(yx), raw(yy), raw(y0), raw(wx), raw(wy), raw(w0)};
}

TEST(WarpHomography, EqualsTheAffineWarpWhereTheDivisorStays) {
    Random random(51);
    GuardedImage<Gray8> src({97, 61}), affine({130, 40}), projective({130, 40});
    src.fill(random);
    AffineTransform t;
    t.xx = WarpCoefficient::from_ratio(900, 1024);
    t.xy = WarpCoefficient::from_ratio(-200, 1024);
    t.yx = WarpCoefficient::from_ratio(150, 1024);
    t.x0 = WarpCoefficient::from_ratio(5, 4);
    for (const Sampling<Gray8>& sampling : samplings()) {
        ASSERT_EQ(warp_affine<Gray8>(src.view(), t, sampling, affine.view()), Status::ok);
        ASSERT_EQ(warp_homography<Gray8>(src.view(), homography_of(t), sampling, projective.view()),
                  Status::ok);
        EXPECT_TRUE(equal(affine.view(), projective.view()));
    }
}

TEST(WarpHomography, IsWithinItsBoundOfTheRealPlace) {
    // On ramps of 2 levels a pixel a place that is off by d px shows as 2 d levels, after the half of
    // rounding; 1/512 px of rounding and 1/300 px of the curve are allowed.
    GuardedImage<Gray8> along({128, 100}), down({128, 100}), x({200, 120}), y({200, 120});
    for (int v = 0; v < 100; ++v)
        for (int u = 0; u < 128; ++u) {
            along(u, v) = static_cast<Gray8>(2 * u);
            down(u, v) = static_cast<Gray8>(2 * v);
        }
    Random random(52);
    int seen = 0;
    for (int round = 0; round < 40; ++round) {
        const auto part = [&](double most) { return most * random.between(-1000, 1000) / 1000; };
        const double tilt = round % 2 == 0 ? 0.001 : 0.02;
        const Homography h = homography(0.7 + part(0.3), part(0.2), part(20), part(0.2), 0.7 + part(0.3),
                                        part(20), part(tilt), part(tilt));
        ASSERT_EQ(warp_homography<Gray8>(along.view(), h, {}, x.view()), Status::ok);
        ASSERT_EQ(warp_homography<Gray8>(down.view(), h, {}, y.view()), Status::ok);
        for (int v = 0; v < 120; ++v)
            for (int u = 0; u < 200; ++u) {
                if (divisor_of(h, u, v) <= 0) {
                    ASSERT_EQ(x(u, v), 0);
                    continue;
                }
                const Place p = place_of(h, u, v);
                if (p.x < 0 || p.x > 127 || p.y < 0 || p.y > 99) continue;
                // How far the place goes in 16 columns.
                const Place q = place_of(h, u + 16, v);
                const double reach = divisor_of(h, u + 16, v) > 0 ? std::hypot(q.x - p.x, q.y - p.y) : 1000;
                const double most = 0.5 + 2 * (1.0 / 512 + std::max(reach, 16.0) / 4000);
                ASSERT_NEAR(x(u, v), 2 * p.x, most) << round << " at " << u << "," << v;
                ASSERT_NEAR(y(u, v), 2 * p.y, most) << round << " at " << u << "," << v;
                ++seen;
            }
    }
    EXPECT_GT(seen, 100000);
}

TEST(WarpHomography, ShowsNothingBeyondTheHorizon) {
    GuardedImage<Gray8> src({20, 20}), dst({200, 3});
    src.fill(Gray8{200});
    // The divisor is 0 at column 100.
    const Homography h = homography(0, 0, 5, 0, 0, 5, -0.01, 0, 1);
    for (const Outside outside : {Outside::replicate, Outside::constant})
        for (const Interpolation interpolation : {Interpolation::nearest, Interpolation::bilinear}) {
            ASSERT_EQ(warp_homography<Gray8>(src.view(), h, {interpolation, outside, 33}, dst.view()),
                      Status::ok);
            EXPECT_EQ(dst(0, 1), 200);
            EXPECT_EQ(dst(99, 1), outside == Outside::replicate ? 200 : 33);
            for (int x = 100; x < 200; ++x) ASSERT_EQ(dst(x, 1), 33) << x;
        }
}

// Defect 16 of the IVT: its nearest mode took places from -1.5 to -0.5 for pixel 0.
TEST(WarpHomography, NearestDoesNotRepeatThePixelAtTheBorder) {
    GuardedImage<Gray8> src({4, 4}), dst({16, 16});
    src.fill(Gray8{200});
    const Homography h = homography(0.25, 0, -2, 0.25 * 0, 0.25, -2, 0, 0);
    Sampling<Gray8> sampling;
    sampling.interpolation = Interpolation::nearest;
    ASSERT_EQ(warp_homography<Gray8>(src.view(), h, sampling, dst.view()), Status::ok);
    for (int x = 0; x < 16; ++x) {
        const double place = 0.25 * x - 2;
        EXPECT_EQ(dst(x, 12), place >= -0.5 ? 200 : 0) << place;
        EXPECT_EQ(dst(12, x), place >= -0.5 ? 200 : 0) << place;
    }
}

// Defect 16: its nearest mode took 1 for the ninth coefficient.
TEST(WarpHomography, CountsTheNinthCoefficientInBothModes) {
    Random random(53);
    GuardedImage<Gray8> src({16, 16}), once({16, 16}), twice({16, 16});
    src.fill(random);
    for (const Sampling<Gray8>& sampling : samplings()) {
        const Homography h = homography(1, 0.25, 1, 0, 1, -1, 0.001, 0.002, 1);
        Homography doubled = h;
        for (std::int64_t* k : {&doubled.xx, &doubled.xy, &doubled.x0, &doubled.yx, &doubled.yy, &doubled.y0,
                                &doubled.wx, &doubled.wy, &doubled.w0})
            *k *= 2;
        ASSERT_EQ(warp_homography<Gray8>(src.view(), h, sampling, once.view()), Status::ok);
        ASSERT_EQ(warp_homography<Gray8>(src.view(), doubled, sampling, twice.view()), Status::ok);
        EXPECT_TRUE(equal(once.view(), twice.view()));
        doubled.w0 = h.w0;
        ASSERT_EQ(warp_homography<Gray8>(src.view(), doubled, sampling, twice.view()), Status::ok);
        EXPECT_FALSE(equal(once.view(), twice.view()));
    }
}

// Defect 16: its colour mode went over the size of the input.
TEST(WarpHomography, GoesOverTheOutputForColourToo) {
    Random random(54);
    GuardedImage<Rgb888> src({40, 30}), small({10, 7}), large({70, 55});
    src.fill(random);
    Sampling<Rgb888> sampling;
    sampling.level = {1, 2, 3};
    ASSERT_EQ(warp_homography<Rgb888>(src.view(), Homography(), sampling, small.view()), Status::ok);
    ASSERT_EQ(warp_homography<Rgb888>(src.view(), Homography(), sampling, large.view()), Status::ok);
    EXPECT_TRUE(equal(small.view(), src.view().crop({0, 0, 10, 7}).value()));
    EXPECT_TRUE(equal(src.view(), large.view().crop({0, 0, 40, 30}).value()));
    EXPECT_TRUE(large(40, 0) == sampling.level);
    EXPECT_TRUE(large(0, 30) == sampling.level);
}

// Defect 16: black bled into the border.
TEST(WarpHomography, MixesNothingFromOutsideIntoTheBorder) {
    GuardedImage<Gray8> src({9, 9}), dst({40, 40});
    src.fill(Gray8{200});
    const Homography h = homography(0.3, 0.1, -1, -0.1, 0.3, 1, 0.001, 0);
    for (const Outside outside : {Outside::replicate, Outside::constant}) {
        ASSERT_EQ(warp_homography<Gray8>(src.view(), h, {Interpolation::bilinear, outside, 0}, dst.view()),
                  Status::ok);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x)
                EXPECT_TRUE(dst(x, y) == 200 || (dst(x, y) == 0 && outside == Outside::constant))
                    << x << "," << y;
    }
}

TEST(WarpHomography, TakesTheLargestCoefficientsAndRefusesLarger) {
    GuardedImage<Gray8> src({8, 8}), dst({40, 8});
    src.fill(Gray8{5});
    dst.fill(Gray8{9});
    const std::int64_t most = (std::int64_t{1} << 62) - 1;
    Homography h{0, 0, most, 0, 0, -most, 0, 0, most};
    EXPECT_EQ(warp_homography<Gray8>(src.view(), h, {}, dst.view()), Status::ok);
    h = {most / 39, 0, 0, 0, -(most / 7), 0, -(most / 39), 0, 1};
    EXPECT_EQ(warp_homography<Gray8>(src.view(), h, {}, dst.view()), Status::ok);
    h = {most, most, 0, 0, 0, 0, 0, 0, 1};
    GuardedImage<Gray8> one({1, 1});
    one.fill(Gray8{9});
    EXPECT_EQ(warp_homography<Gray8>(src.view(), h, {}, one.view()), Status::bad_argument);
    h = {0, 0, std::numeric_limits<std::int64_t>::min(), 0, 0, 0, 0, 0, 1};
    EXPECT_EQ(warp_homography<Gray8>(src.view(), h, {}, one.view()), Status::bad_argument);
    EXPECT_EQ(one(0, 0), 9);
}

TEST(MapPoint, FollowsTheHomographyToTheHorizon) {
    const Homography h = homography(2, 0, 1, 0, 2, 0, 0.01, 0, 1);
    const auto at = [](int x, int y) { return FinePoint{FinePixel::from_int(x), FinePixel::from_int(y)}; };
    EXPECT_EQ(map_point(h, at(100, 50)).value(),
              (FinePoint{FinePixel::from_ratio(201, 2), FinePixel::from_int(50)}));
    EXPECT_EQ(map_point(h, at(-100, 0)).status(), Status::not_found);
    EXPECT_EQ(map_point(h, at(-101, 0)).status(), Status::not_found);
    EXPECT_EQ(map_point(homography(1, 0, 0, 0, 1, 0, 0, 0, 1e-4), at(9, 0)).status(), Status::out_of_range);
}

}  // namespace
}  // namespace fovea::test
