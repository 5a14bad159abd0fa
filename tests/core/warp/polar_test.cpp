// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/warp/polar.hpp>
#include <support/guarded_image.hpp>

#include "warp_reference.hpp"

namespace fovea::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes scratch_for(Size size) { return Bytes(static_cast<std::size_t>(warp_polar_scratch(size)), 0xee); }
Span<std::uint8_t> span_of(Bytes& bytes) { return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}; }

double real(FinePixel k) { return k.raw() / 65536.0; }

Place real_place(const PolarFrame& frame, Size size, int x, int y) {
    const double pi = std::acos(-1.0);
    const double angle = 2 * pi * (frame.start.raw() / 4294967296.0 + static_cast<double>(y) / size.height);
    const double inner = real(frame.inner);
    const double outer = real(frame.outer);
    const double share = static_cast<double>(x) / size.width;
    const double radius = frame.scale == RadiusScale::linear ? inner + (outer - inner) * share
                                                             : inner * std::pow(outer / inner, share);
    return {real(frame.centre.x) + radius * std::cos(angle), real(frame.centre.y) + radius * std::sin(angle)};
}
/// What polar_place() promises.
double reach_of(const PolarFrame& frame) { return std::ldexp(real(frame.outer), -25) + 1 / 65536.0; }

PolarFrame random_frame(Random& random, int most) {
    PolarFrame frame;
    frame.centre = {FinePixel::from_raw(random.between(-65536, 65536 * most)),
                    FinePixel::from_raw(random.between(-65536, 65536 * most))};
    frame.inner = FinePixel::from_raw(random.between(1, 65536 * 4));
    frame.outer = FinePixel::from_raw(random.between(65536 * 5, 65536 * most));
    frame.scale = random.below(2) == 0 ? RadiusScale::linear : RadiusScale::logarithmic;
    frame.start = FineAngle::from_raw(random.next());
    return frame;
}

TEST(PolarPlace, ByHand) {
    PolarFrame frame;
    frame.centre = {FinePixel::from_int(100), FinePixel::from_int(50)};
    frame.inner = FinePixel::from_int(2);
    frame.outer = FinePixel::from_int(32);
    // Radii 2, 4, 8, 16, directions right, down, left, up.
    const int radii[] = {2, 4, 8, 16};
    for (int x = 0; x < 4; ++x) {
        const int r = radii[x];
        EXPECT_EQ(polar_place(frame, {4, 4}, {x, 0})->x, FinePixel::from_int(100 + r));
        EXPECT_EQ(polar_place(frame, {4, 4}, {x, 1})->y, FinePixel::from_int(50 + r));
        EXPECT_EQ(polar_place(frame, {4, 4}, {x, 2})->x, FinePixel::from_int(100 - r));
        EXPECT_EQ(polar_place(frame, {4, 4}, {x, 3})->y, FinePixel::from_int(50 - r));
        EXPECT_EQ(polar_place(frame, {4, 4}, {x, 3})->x, FinePixel::from_int(100));
    }
    frame.scale = RadiusScale::linear;
    EXPECT_EQ(polar_place(frame, {5, 4}, {3, 0})->x, FinePixel::from_int(120));
}

TEST(PolarPlace, IsAsNearAsItPromises) {
    Random random(81);
    for (int round = 0; round < 3000; ++round) {
        const PolarFrame frame = random_frame(random, round % 2 == 0 ? 300 : 16000);
        const Size size{random.between(1, 2000), random.between(1, 2000)};
        const Point pixel{random.between(0, size.width - 1), random.between(0, size.height - 1)};
        const Place p = real_place(frame, size, pixel.x, pixel.y);
        const Result<FinePoint> place = polar_place(frame, size, pixel);
        if (!place) {
            ASSERT_EQ(place.status(), Status::out_of_range);
            ASSERT_GT(std::max(std::abs(p.x), std::abs(p.y)), 32767);
            continue;
        }
        ASSERT_NEAR(real(place->x), p.x, reach_of(frame));
        ASSERT_NEAR(real(place->y), p.y, reach_of(frame));
    }
}

TEST(PolarPlace, OfTheWidestRing) {
    PolarFrame frame;
    frame.inner = FinePixel::from_raw(1);
    frame.outer = FinePixel::from_raw(2147483647);
    const Size size{32767, 1};
    for (int x = 0; x < size.width; x += 31)
        ASSERT_NEAR(real(polar_place(frame, size, {x, 0})->x), real_place(frame, size, x, 0).x,
                    reach_of(frame));
}

TEST(PolarPlace, SaysWhatItCannotTake) {
    PolarFrame frame;
    frame.outer = FinePixel::from_int(10);
    EXPECT_EQ(polar_place(frame, {0, 4}, {0, 0}).status(), Status::empty_image);
    for (const Point p : {Point{-1, 0}, Point{0, -1}, Point{4, 0}, Point{0, 4}})
        EXPECT_EQ(polar_place(frame, {4, 4}, p).status(), Status::out_of_range);
    frame.centre.x = FinePixel::from_int(32767);
    EXPECT_EQ(polar_place(frame, {4, 4}, {0, 0}).status(), Status::out_of_range);
    frame.inner = FinePixel();
    EXPECT_EQ(polar_place(frame, {4, 4}, {0, 1}).status(), Status::bad_argument);
    frame.scale = RadiusScale::linear;
    EXPECT_TRUE(polar_place(frame, {4, 4}, {0, 1}).ok());
}

/// One of the pixels that the naive warp makes of places within the promise.
bool is_near(ImageView<const Gray8> src, Place p, double reach, const Sampling<Gray8>& sampling,
             Gray8 found) {
    for (const double dx : {-reach, 0.0, reach})
        for (const double dy : {-reach, 0.0, reach})
            if (naive_sample(src, {p.x + dx, p.y + dy}, sampling) == found) return true;
    return false;
}

TEST(WarpPolar, EqualsTheReference) {
    Random random(82);
    for (const Size size : test_sizes())
        for (const Sampling<Gray8>& sampling : samplings()) {
            GuardedImage<Gray8> src({random.between(1, 90), random.between(1, 90)});
            GuardedImage<Gray8> dst(size);
            src.fill(random);
            const PolarFrame frame = random_frame(random, 60);
            Bytes scratch = scratch_for(size);
            ASSERT_EQ(warp_polar<Gray8>(src.view(), frame, sampling, span_of(scratch), dst.view()),
                      Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    ASSERT_TRUE(is_near(src.view(), real_place(frame, size, x, y), reach_of(frame), sampling,
                                        dst(x, y)))
                        << x << ", " << y;
        }
}

TEST(WarpPolar, TreatsTheChannelsOfColourAlike) {
    Random random(83);
    GuardedImage<Gray8> src({50, 40});
    GuardedImage<Rgb888> colour({50, 40});
    src.fill(random);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 50; ++x) colour(x, y) = {src(x, y), src(49 - x, y), src(x, 39 - y)};
    const Size size{70, 33};
    const PolarFrame frame = random_frame(random, 40);
    GuardedImage<Gray8> dst(size);
    GuardedImage<Rgb888> dst_colour(size);
    Bytes scratch = scratch_for(size);
    ASSERT_EQ(warp_polar<Gray8>(src.view(), frame, {}, span_of(scratch), dst.view()), Status::ok);
    ASSERT_EQ(warp_polar<Rgb888>(colour.view(), frame, {}, span_of(scratch), dst_colour.view()), Status::ok);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst_colour(x, y).red, dst(x, y));
}

/// Waves about the middle, once as they are and once twice as large.
GuardedImage<Gray8> waves(double scale) {
    GuardedImage<Gray8> image({321, 321});
    for (int y = 0; y < 321; ++y)
        for (int x = 0; x < 321; ++x) {
            const double u = (x - 160) / scale;
            const double v = (y - 160) / scale;
            image(x, y) =
                static_cast<Gray8>(std::lround(128 + 60 * std::sin(u / 9) + 60 * std::cos(v / 7 + u / 30)));
        }
    return image;
}

TEST(WarpPolar, TurnsAreShiftsAndSoAreScales) {
    const Size size{64, 48};
    PolarFrame frame;
    frame.centre = {FinePixel::from_int(160), FinePixel::from_int(160)};
    frame.inner = FinePixel::from_int(8);
    frame.outer = FinePixel::from_int(128);  // 16 columns an octave
    GuardedImage<Gray8> plain(size);
    GuardedImage<Gray8> turned(size);
    GuardedImage<Gray8> large(size);
    Bytes scratch = scratch_for(size);
    const GuardedImage<Gray8> src = waves(1);
    ASSERT_EQ(warp_polar<Gray8>(src.view(), frame, {}, span_of(scratch), plain.view()), Status::ok);
    ASSERT_EQ(warp_polar<Gray8>(waves(2).view(), frame, {}, span_of(scratch), large.view()), Status::ok);
    frame.start = FineAngle::quarter_turn();
    ASSERT_EQ(warp_polar<Gray8>(src.view(), frame, {}, span_of(scratch), turned.view()), Status::ok);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            ASSERT_EQ(turned(x, y), plain(x, (y + 12) % 48));
            // Slopes of 15 levels a px and curvatures of 2: pixels and what lies between them, twice.
            if (x >= 16) {
                ASSERT_NEAR(large(x, y), plain(x - 16, y), 2);
            }
        }
}

TEST(WarpPolar, LeavesTheOutputWhenItCannotRun) {
    GuardedImage<Gray8> src({5, 4}), dst({6, 3}), before({6, 3});
    src.fill(9);
    dst.fill(17);
    before.fill(17);
    PolarFrame frame;
    frame.outer = FinePixel::from_int(10);
    Bytes scratch = scratch_for({6, 3});
    const ImageView<Gray8> none;
    EXPECT_EQ(warp_polar<Gray8>(none, frame, {}, span_of(scratch), dst.view()), Status::empty_image);
    EXPECT_EQ(warp_polar<Gray8>(src.view(), frame, {}, span_of(scratch), none), Status::empty_image);
    EXPECT_EQ(warp_polar<Gray8>(src.view(), frame, {}, span_of(scratch),
                                ImageView<Gray8>(dst.view().first(), {32768, 1}, 32768)),
              Status::image_too_large);
    EXPECT_EQ(warp_polar<Gray8>(src.view(), frame, {}, span_of(scratch).first(3), dst.view()),
              Status::scratch_too_small);
    frame.inner = frame.outer;
    EXPECT_EQ(warp_polar<Gray8>(src.view(), frame, {}, span_of(scratch), dst.view()), Status::bad_argument);
    EXPECT_TRUE(equal(dst.view(), before.view()));
}

}  // namespace
}  // namespace fovea::test
