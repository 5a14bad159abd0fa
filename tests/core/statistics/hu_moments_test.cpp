// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/number/logarithm.hpp>
#include <fovea/statistics/hu_moments.hpp>
#include <support/scalars.hpp>

namespace fovea::test {
namespace {

struct Pixel {
    int x, y;
};
using Pixels = std::vector<Pixel>;

Moments of(const Pixels& pixels) {
    Moments moments;
    for (const Pixel& p : pixels) moments.add_run(p.x, p.x + 1, p.y);
    return moments;
}
template <class Map>
Pixels mapped(const Pixels& pixels, Map map) {
    Pixels result;
    for (const Pixel& p : pixels) result.push_back(map(p));
    return result;
}

/// A comb that has no symmetry at all, with some of its pixels missing.
Pixels shape(Random& random, int side) {
    Pixels pixels;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            if ((2 * x < y || (y < side / 4 && x < 3 * side / 4)) && random.below(8) != 0)
                pixels.push_back({x, y});
    return pixels;
}

/// Hu's formulas as they stand, from sums over the pixels; and the largest term of each invariant.
struct Reference {
    long double eta[4][4] = {};
    long double h[7] = {};
    long double size[7] = {};

    explicit Reference(const Pixels& pixels) {
        // Times area^(p + q) the coordinates about the centroid are whole numbers: nothing is rounded yet.
        const auto a = static_cast<long double>(pixels.size());
        long double cx = 0;
        long double cy = 0;
        for (const Pixel& p : pixels) {
            cx += p.x;
            cy += p.y;
        }
        for (const Pixel& pixel : pixels)
            for (int p = 0; p < 4; ++p)
                for (int q = 0; p + q < 4; ++q)
                    eta[p][q] += std::pow(a * pixel.x - cx, p) * std::pow(a * pixel.y - cy, q);
        for (int p = 0; p < 4; ++p)
            for (int q = 0; p + q < 4; ++q) eta[p][q] /= std::pow(a, static_cast<long double>(p + q));
        for (int p = 0; p < 4; ++p)
            for (int q = 0; p + q < 4; ++q) eta[p][q] /= std::pow(a, 1 + static_cast<long double>(p + q) / 2);
        const long double d = eta[2][0] - eta[0][2];
        const long double p = eta[3][0] - 3 * eta[1][2];
        const long double q = 3 * eta[2][1] - eta[0][3];
        const long double s = eta[3][0] + eta[1][2];
        const long double t = eta[2][1] + eta[0][3];
        h[0] = eta[2][0] + eta[0][2];
        h[1] = d * d + 4 * eta[1][1] * eta[1][1];
        h[2] = p * p + q * q;
        h[3] = s * s + t * t;
        h[4] = p * s * (s * s - 3 * t * t) + q * t * (3 * s * s - t * t);
        h[5] = d * (s * s - t * t) + 4 * eta[1][1] * s * t;
        h[6] = q * s * (s * s - 3 * t * t) - p * t * (3 * s * s - t * t);
        for (int i = 0; i < 4; ++i) size[i] = h[i];
        const long double most = 3 * (std::abs(p) + std::abs(q)) * std::pow(std::abs(s) + std::abs(t), 3.0L);
        size[4] = size[6] = most;
        size[5] = (std::abs(d) + 4 * std::abs(eta[1][1])) * (s * s + t * t);
    }
};

/// 2^-55, or what the reference can tell.
constexpr long double share() {
    return 0x1p-55L > 256 * std::numeric_limits<long double>::epsilon()
               ? 0x1p-55L
               : 256 * std::numeric_limits<long double>::epsilon();
}

TEST(HuMoments, OfTwoPixelsByHand) {
    // About the middle mu20 is 1/2 and all others are 0: eta20 = 1/2 / 4.
    const HuMoments hu = *hu_moments(of({{3, 5}, {4, 5}}));
    EXPECT_EQ(hu[0], Real::from_int(1) / Real::from_int(8));
    EXPECT_EQ(hu[1], Real::from_int(1) / Real::from_int(64));
    for (int i = 2; i < HuMoments::count; ++i) EXPECT_TRUE(hu[i].zero());
    EXPECT_EQ(normalized_moments(of({{3, 5}, {4, 5}}))->eta20, hu[0]);
    EXPECT_EQ(log2_of(hu[1])->round(), -6);
}

TEST(HuMoments, EqualTheReference) {
    Random random(621);
    for (int round = 0; round < 60; ++round) {
        const Pixels pixels = shape(random, random.between(4, 60));
        const Reference real(pixels);
        const HuMoments hu = *hu_moments(of(pixels));
        for (int i = 0; i < HuMoments::count; ++i)
            ASSERT_LE(std::abs(value_of(hu[i]) - real.h[i]), share() * real.size[i]) << i;
        const NormalizedMoments n = *normalized_moments(of(pixels));
        const Real etas[] = {n.eta20, n.eta11, n.eta02, n.eta30, n.eta21, n.eta12, n.eta03};
        const long double reals[] = {real.eta[2][0], real.eta[1][1], real.eta[0][2], real.eta[3][0],
                                     real.eta[2][1], real.eta[1][2], real.eta[0][3]};
        const long double largest = std::pow(real.h[0], 1.5L);
        for (int i = 0; i < 7; ++i)
            ASSERT_LE(std::abs(value_of(etas[i]) - reals[i]), share() * (std::abs(reals[i]) + largest)) << i;
    }
}

TEST(HuMoments, KeepEveryDigitWhenARegionMovesOrTurnsByQuarters) {
    Random random(622);
    for (int round = 0; round < 30; ++round) {
        const Pixels pixels = shape(random, 50);
        const HuMoments hu = *hu_moments(of(pixels));
        const HuMoments moved = *hu_moments(of(mapped(pixels, [](Pixel p) {
            return Pixel{p.x + 8000, p.y + 4321};
        })));
        const HuMoments turned = *hu_moments(of(mapped(pixels, [](Pixel p) {
            return Pixel{60 - p.y, p.x};
        })));
        const HuMoments half = *hu_moments(of(mapped(pixels, [](Pixel p) {
            return Pixel{60 - p.x, 60 - p.y};
        })));
        const HuMoments mirrored = *hu_moments(of(mapped(pixels, [](Pixel p) {
            return Pixel{60 - p.x, p.y};
        })));
        for (int i = 0; i < HuMoments::count; ++i) {
            ASSERT_EQ(hu[i], moved[i]) << i;
            ASSERT_EQ(hu[i], turned[i]) << i;
            ASSERT_EQ(hu[i], half[i]) << i;
            ASSERT_EQ(i == 6 ? -hu[i] : hu[i], mirrored[i]) << i;
        }
    }
}

TEST(HuMoments, AreNearlyThoseOfALargerRegion) {
    Random random(623);
    const Pixels pixels = shape(random, 40);
    Pixels larger;
    for (const Pixel& p : pixels)
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) larger.push_back({16 * p.x + x, 16 * p.y + y});
    const HuMoments a = *hu_moments(of(pixels));
    const HuMoments b = *hu_moments(of(larger));
    // A pixel has no second moment of its own, the 16 x 16 that stand for it have (1 - 1/256) / 12 of its
    // area: so much more is eta20 + eta02, over the area, and the third moments are the same.
    const long double more = 2 * (1 - 1 / 256.0L) / 12 / static_cast<long double>(pixels.size());
    EXPECT_LE(std::abs(value_of(b[0]) - value_of(a[0]) - more), 1e-15L);
    for (int i = 1; i < HuMoments::count; ++i) {
        if (i == 5) continue;
        EXPECT_LE(std::abs(value_of(b[i]) / value_of(a[i]) - 1), 1e-12L) << i;
    }
}

TEST(HuMoments, OfTheLargestImageAreThoseOfASquare) {
    Moments moments;
    for (int y = 0; y < max_moment_side; ++y) moments.add_run(0, max_moment_side, y);
    const HuMoments hu = *hu_moments(moments);
    const long double n = max_moment_side;
    EXPECT_LE(std::abs(value_of(hu[0]) - (n * n - 1) / (6 * n * n)), 1e-17L);
    for (int i = 1; i < HuMoments::count; ++i) EXPECT_TRUE(hu[i].zero());
    // Two far corners of it: the largest third moments.
    Moments corner;
    for (int y = 0; y < max_moment_side; ++y) corner.add_run(0, y < 4096 ? max_moment_side : 1, y);
    const Result<HuMoments> found = hu_moments(corner);
    ASSERT_TRUE(found.ok());
    EXPECT_FALSE((*found)[2].negative());
}

TEST(HuMoments, NeedAPixel) {
    EXPECT_EQ(hu_moments(Moments()).status(), Status::empty_image);
    EXPECT_EQ(normalized_moments(Moments()).status(), Status::empty_image);
}

}  // namespace
}  // namespace fovea::test
