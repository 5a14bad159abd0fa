// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/warp/affine.hpp>
#include <fovea/warp/flip.hpp>
#include <support/guarded_image.hpp>

#include "warp_reference.hpp"

namespace fovea::test {
namespace {

WarpCoefficient coefficient(double value) {
    return WarpCoefficient::from_raw(static_cast<std::int64_t>(std::llround(std::ldexp(value, 40))));
}
AffineTransform transform(double xx, double xy, double x0, double yx, double yy, double y0) {
    return {coefficient(xx), coefficient(xy), coefficient(x0),
            coefficient(yx), coefficient(yy), coefficient(y0)};
}
AffineTransform random_transform(Random& random, Size size) {
    const auto factor = [&] { return random.between(-3000, 3000) / 1024.0; };
    return transform(factor(), factor(), random.between(-30, size.width + 30) + factor() / 3, factor(),
                     factor(), random.between(-30, size.height + 30) + factor() / 3);
}
FinePoint at(int x, int y) { return {FinePixel::from_int(x), FinePixel::from_int(y)}; }

TEST(WarpAffine, HalvesTheWayBetweenTwoPixels) {
    GuardedImage<Gray8> src({2, 2}), dst({3, 3});
    src(0, 0) = 10;
    src(1, 0) = 20;
    src(0, 1) = 30;
    src(1, 1) = 61;
    ASSERT_EQ(warp_affine<Gray8>(src.view(), transform(0.5, 0, 0, 0, 0.5, 0), {}, dst.view()), Status::ok);
    const int expected[3][3] = {{10, 15, 20}, {20, 30, 41}, {30, 46, 61}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) EXPECT_EQ(dst(x, y), expected[y][x]) << x << "," << y;
}

TEST(WarpAffine, EqualsTheReferenceOnEverySizeAndSampling) {
    Random random(41);
    for (const Size size : test_sizes())
        for (const Sampling<Gray8>& sampling : samplings())
            for (int round = 0; round < 3; ++round) {
                GuardedImage<Gray8> src(size), dst({random.between(1, 150), random.between(1, 9)});
                src.fill(random);
                // Coefficients of few bits, so that the reference has no error of its own.
                const AffineTransform t = random_transform(random, size);
                ASSERT_EQ(warp_affine<Gray8>(src.view(), t, sampling, dst.view()), Status::ok);
                for (int y = 0; y < dst.view().height(); ++y)
                    for (int x = 0; x < dst.view().width(); ++x)
                        ASSERT_EQ(dst(x, y), naive_sample(src.view(), place_of(t, x, y), sampling))
                            << size.width << "x" << size.height << " at " << x << "," << y;
            }
}

TEST(WarpAffine, IsWithinItsBoundOfTheRealValue) {
    // Between pixels that differ by 255 at most the place, rounded to 1/256 px, moves the value by 255 / 512
    // in each direction; the rounding adds a half.
    Random random(42);
    const Size size{97, 60};
    GuardedImage<Gray8> src(size), dst({160, 90});
    src.fill(random);
    double worst = 0;
    for (int round = 0; round < 20; ++round) {
        const AffineTransform t = rotation_about(at(random.between(0, 96), random.between(0, 59)),
                                                 FineAngle::from_raw(random.next()));
        Sampling<Gray8> sampling;
        sampling.outside = Outside::replicate;
        ASSERT_EQ(warp_affine<Gray8>(src.view(), t, sampling, dst.view()), Status::ok);
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 160; ++x)
                worst = std::max(worst, std::abs(dst(x, y) - real_bilinear(src.view(), place_of(t, x, y))));
    }
    EXPECT_LE(worst, 0.5 + 255.0 / 256);
    RecordProperty("worst", std::to_string(worst));
}

TEST(WarpAffine, StartsEveryRowExactlySoThatNoErrorGrows) {
    // A ramp of one level a pixel under a map whose steps are no round numbers.
    GuardedImage<Gray8> src({256, 2});
    for (int x = 0; x < 256; ++x) src(x, 0) = src(x, 1) = static_cast<Gray8>(x);
    const double third = 1.0 / 3;
    GuardedImage<Gray8> dst({max_image_side, 2});
    const AffineTransform t = transform(third / 43, 0, 0, 0, 0, 0);
    ASSERT_EQ(warp_affine<Gray8>(src.view(), t, {}, dst.view()), Status::ok);
    for (int x = 0; x < max_image_side; ++x)
        ASSERT_EQ(dst(x, 1), std::lround(std::floor(x * (third / 43) * 256 + 0.5) / 256 + 1e-9)) << x;
}

TEST(WarpAffine, GivesTheSameForARowOfAnyStrip) {
    Random random(43);
    GuardedImage<Gray8> src({70, 50}), whole({300, 20});
    src.fill(random);
    const AffineTransform t = random_transform(random, {70, 50});
    ASSERT_EQ(warp_affine<Gray8>(src.view(), t, {}, whole.view()), Status::ok);
    for (const int left : {1, 16, 63, 64, 100, 129, 255}) {
        AffineTransform moved = t;
        moved.x0 += t.xx * left;
        moved.y0 += t.yx * left;
        GuardedImage<Gray8> part({300 - left, 20});
        ASSERT_EQ(warp_affine<Gray8>(src.view(), moved, {}, part.view()), Status::ok);
        EXPECT_TRUE(equal(
            part.view(), whole.view().crop({left, 0, 300 - left, 20})->crop({0, 0, 300 - left, 20}).value()));
    }
}

TEST(WarpAffine, DoesColourChannelByChannel) {
    Random random(44);
    for (const Size size : test_sizes()) {
        GuardedImage<Rgb888> src(size), dst({50, 7});
        src.fill(random);
        GuardedImage<Gray8> plane(size), warped({50, 7});
        const AffineTransform t = random_transform(random, size);
        for (const Sampling<Gray8>& one : samplings()) {
            const Sampling<Rgb888> sampling{one.interpolation, one.outside, {1, 2, one.level}};
            ASSERT_EQ(warp_affine<Rgb888>(src.view(), t, sampling, dst.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) plane(x, y) = src(x, y).blue;
            ASSERT_EQ(warp_affine<Gray8>(plane.view(), t, one, warped.view()), Status::ok);
            for (int y = 0; y < 7; ++y)
                for (int x = 0; x < 50; ++x) ASSERT_EQ(dst(x, y).blue, warped(x, y));
        }
    }
}

TEST(WarpAffine, RefusesPlacesTooFarAway) {
    GuardedImage<Gray8> src({8, 8}), dst({8, 8});
    dst.fill(Gray8{9});
    const std::int64_t far = std::int64_t{1} << 22;
    AffineTransform t;
    t.x0 = WarpCoefficient::from_raw(far * WarpCoefficient::one - 8 * WarpCoefficient::one);
    EXPECT_EQ(warp_affine<Gray8>(src.view(), t, {}, dst.view()), Status::ok);
    dst.fill(Gray8{9});
    t.x0 = WarpCoefficient::from_raw(far * WarpCoefficient::one - 7 * WarpCoefficient::one);
    EXPECT_EQ(warp_affine<Gray8>(src.view(), t, {}, dst.view()), Status::bad_argument);
    t.x0 = WarpCoefficient::from_raw(std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(warp_affine<Gray8>(src.view(), t, {}, dst.view()), Status::bad_argument);
    EXPECT_EQ(dst(3, 3), 9);
    EXPECT_EQ(warp_affine<Gray8>(src.view(), {}, {}, ImageView<Gray8>()), Status::empty_image);
}

TEST(Rotate, BringsWhatLiesAlongTheAngleOntoTheXAxis) {
    // A bright line from the middle down to the right, at 45 degrees clockwise.
    GuardedImage<Gray8> src({41, 41}), dst({41, 41});
    src.fill(Gray8{0});
    for (int i = 0; i <= 20; ++i) src(20 + i, 20 + i) = 255;
    ASSERT_EQ(rotate<Gray8>(src.view(), at(20, 20), Angle::from_degrees(45), {}, dst.view()), Status::ok);
    for (int x = 21; x < 40; ++x) EXPECT_GT(dst(x, 20), 100) << x;
    for (int y = 22; y < 40; ++y) EXPECT_EQ(dst(20, y), 0) << y;
    EXPECT_EQ(dst(10, 20), 0);
}

TEST(Rotate, IsExactForQuarterTurns) {
    Random random(45);
    GuardedImage<Gray8> src({33, 33}), dst({33, 33}), turned({33, 33});
    src.fill(random);
    ASSERT_EQ(rotate<Gray8>(src.view(), at(16, 16), FineAngle::quarter_turn(), {}, dst.view()), Status::ok);
    ASSERT_EQ(rotate_90_counterclockwise<Gray8>(src.view(), turned.view()), Status::ok);
    EXPECT_TRUE(equal(dst.view(), turned.view()));
    ASSERT_EQ(rotate<Gray8>(src.view(), at(16, 16), FineAngle::half_turn(), {}, dst.view()), Status::ok);
    ASSERT_EQ(rotate_180<Gray8>(src.view(), turned.view()), Status::ok);
    EXPECT_TRUE(equal(dst.view(), turned.view()));
}

TEST(AffineTransform, ThereAndBackIsWhereItWas) {
    Random random(46);
    for (int round = 0; round < 200; ++round) {
        const AffineTransform t = random_transform(random, {640, 480});
        const Result<AffineTransform> back = inverse_of(t);
        if (!back) continue;
        const double determinant = real(t.xx) * real(t.yy) - real(t.xy) * real(t.yx);
        if (std::abs(determinant) < 0.1) continue;
        const Result<AffineTransform> same = chained(*back, t);
        ASSERT_TRUE(same.ok());
        EXPECT_NEAR(real(same->xx), 1, 1e-9);
        EXPECT_NEAR(real(same->xy), 0, 1e-9);
        EXPECT_NEAR(real(same->x0), 0, 1e-6);
        EXPECT_NEAR(real(same->y0), 0, 1e-6);
        const FinePoint place = at(random.between(0, 600), random.between(0, 400));
        const Result<FinePoint> there = map_point(t, place);
        ASSERT_TRUE(there.ok());
        const Place expected = place_of(t, place.x.raw() / 65536.0, place.y.raw() / 65536.0);
        EXPECT_NEAR(there->x.raw(), expected.x * 65536, 0.51);
        EXPECT_NEAR(there->y.raw(), expected.y * 65536, 0.51);
    }
}

TEST(AffineTransform, SaysWhereItHasNoAnswer) {
    EXPECT_EQ(inverse_of(transform(1, 2, 0, 2, 4, 0)).status(), Status::degenerate);
    EXPECT_EQ(map_point(transform(2, 0, 0, 0, 1, 0), at(20000, 0)).status(), Status::out_of_range);
    EXPECT_EQ(map_point(transform(-2, 0, 0, 0, 1, 0), at(20000, 0)).status(), Status::out_of_range);
    const AffineTransform wide = transform(4000000, 0, 0, 0, 1, 0);
    EXPECT_EQ(chained(wide, wide).status(), Status::out_of_range);
    EXPECT_EQ(inverse_of(transform(1e-6, 0, 4e6, 0, 1e-6, 0)).status(), Status::out_of_range);
}

TEST(AffineTransform, CountsTheRowsThatARowNeeds) {
    EXPECT_EQ(source_rows_of(AffineTransform(), 640), 3);
    EXPECT_EQ(source_rows_of(transform(1, 0, 0, -0.1, 1, 0), 641), 67);
    EXPECT_EQ(source_rows_of(transform(1, 0, 0, 4000, 1, 0), 641), max_image_side);
}

}  // namespace
}  // namespace fovea::test
