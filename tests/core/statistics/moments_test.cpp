// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea::test {
namespace {

struct Segment {
    int first, end, y;
};

Moments of(const std::vector<Segment>& runs) {
    Moments moments;
    for (const Segment& run : runs) moments.add_run(run.first, run.end, run.y);
    return moments;
}

/// Sum of (x - cx)^p (y - cy)^q over all pixels, one at a time.
long double naive_sum(const std::vector<Segment>& runs, int p, int q, long double cx, long double cy) {
    long double sum = 0;
    for (const Segment& run : runs)
        for (int x = run.first; x < run.end; ++x)
            sum += std::pow(x - cx, static_cast<long double>(p)) *
                   std::pow(run.y - cy, static_cast<long double>(q));
    return sum;
}

std::vector<Segment> random_region(Random& random, int side) {
    std::vector<Segment> runs;
    const int top = random.between(0, side - 2);
    const int bottom = random.between(top, std::min(top + 60, side - 1));
    for (int y = top; y <= bottom; ++y) {
        const int first = random.between(0, side - 1);
        runs.push_back({first, random.between(first + 1, std::min(first + 90, side)), y});
    }
    return runs;
}

double degrees(FineAngle angle) { return angle.microdegrees() * 1e-6; }

TEST(Moments, AddRunIsTheSumOverItsPixels) {
    const Moments moments = of({{2, 4, 3}});  // pixels (2, 3) and (3, 3)
    EXPECT_EQ(moments.m00, 2);
    EXPECT_EQ(moments.m10, 5);
    EXPECT_EQ(moments.m01, 6);
    EXPECT_EQ(moments.m20, 13);
    EXPECT_EQ(moments.m11, 15);
    EXPECT_EQ(moments.m02, 18);
    EXPECT_EQ(moments.m30, 35);
    EXPECT_EQ(moments.m21, 39);
    EXPECT_EQ(moments.m12, 45);
    EXPECT_EQ(moments.m03, 54);
}

TEST(Moments, EqualTheReferenceExactly) {
    Random random(61);
    for (int round = 0; round < 100; ++round) {
        const std::vector<Segment> runs = random_region(random, round % 2 == 0 ? 200 : max_moment_side);
        const Moments moments = of(runs);
        const std::int64_t sums[] = {moments.m00, moments.m10, moments.m01, moments.m20, moments.m11,
                                     moments.m02, moments.m30, moments.m21, moments.m12, moments.m03};
        const int orders[][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1},
                                 {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}};
        for (int i = 0; i < 10; ++i)
            ASSERT_EQ(static_cast<long double>(sums[i]), naive_sum(runs, orders[i][0], orders[i][1], 0, 0));
    }
}

TEST(CentralMoments, AreWithinTwoOfTheReference) {
    Random random(62);
    for (int round = 0; round < 100; ++round) {
        const std::vector<Segment> runs = random_region(random, round % 2 == 0 ? 200 : max_moment_side);
        const CentralMoments c = *central_moments(of(runs));
        const long double area = naive_sum(runs, 0, 0, 0, 0);
        const long double cx = naive_sum(runs, 1, 0, 0, 0) / area;
        const long double cy = naive_sum(runs, 0, 1, 0, 0) / area;
        EXPECT_NEAR(c.centroid.x.raw() / 65536.0, static_cast<double>(cx), 0.51 / 65536);
        EXPECT_NEAR(c.centroid.y.raw() / 65536.0, static_cast<double>(cy), 0.51 / 65536);
        const SecondMoment seconds[] = {c.mu20, c.mu11, c.mu02};
        const std::int64_t thirds[] = {c.mu30, c.mu21, c.mu12, c.mu03};
        // The reference itself rounds to 64 bits of the largest term.
        for (int i = 0; i < 3; ++i) {
            const long double real = naive_sum(runs, 2 - i, i, cx, cy);
            ASSERT_NEAR(static_cast<double>(seconds[i].raw() / 256.0L - real), 0,
                        0.51 / 256 + static_cast<double>(std::abs(real)) * 1e-15);
        }
        for (int i = 0; i < 4; ++i) {
            const long double real = naive_sum(runs, 3 - i, i, cx, cy);
            ASSERT_NEAR(static_cast<double>(thirds[i] - real), 0,
                        2 + static_cast<double>(std::abs(real)) * 1e-12);
        }
    }
}

TEST(CentralMoments, DoNotOverflowForTheLargestImage) {
    Moments moments;
    for (int y = 0; y < max_moment_side; ++y) moments.add_run(0, max_moment_side, y);
    const CentralMoments c = *central_moments(moments);
    const std::int64_t n = max_moment_side;
    EXPECT_EQ(c.centroid.x, FinePixel::from_int(4095));
    EXPECT_EQ(c.mu20.raw(), n * (n * (n * n - 1) / 12) * 256);
    EXPECT_EQ(c.mu11.raw(), 0);
    EXPECT_EQ(c.mu30, 0);
    EXPECT_EQ(c.mu21, 0);
}

TEST(CentralMoments, DoNotChangeWhenARegionMoves) {
    Random random(63);
    const std::vector<Segment> runs = random_region(random, 200);
    std::vector<Segment> moved = runs;
    for (Segment& run : moved) run = {run.first + 5000, run.end + 5000, run.y + 4321};
    const CentralMoments a = *central_moments(of(runs));
    const CentralMoments b = *central_moments(of(moved));
    EXPECT_EQ(a.mu20, b.mu20);
    EXPECT_EQ(a.mu11, b.mu11);
    EXPECT_EQ(a.mu30, b.mu30);
    EXPECT_EQ(a.mu12, b.mu12);
}

TEST(CentralMoments, TheOldCentroidOverflowIsGone) {
    // 3000 x 2000 full: the toolkit's 32-bit sums gave (67.8, 283.7).
    Moments moments;
    for (int y = 0; y < 2000; ++y) moments.add_run(0, 3000, y);
    const CentralMoments c = *central_moments(moments);
    EXPECT_EQ(c.centroid.x, FinePixel::from_ratio(2999, 2));
    EXPECT_EQ(c.centroid.y, FinePixel::from_ratio(1999, 2));
}

TEST(CentralMoments, NeedAPixel) { EXPECT_EQ(central_moments(Moments()).status(), Status::empty_image); }

TEST(Orientation, FollowsTheBooksTableWithNinetyAsPlusNinety) {
    EXPECT_EQ(degrees(orientation(*central_moments(of({{0, 9, 0}})))->axis), 0);
    EXPECT_EQ(degrees(orientation(*central_moments(of({{0, 1, 0}, {0, 1, 1}})))->axis), 90);
    EXPECT_EQ(degrees(orientation(*central_moments(of({{0, 1, 0}, {1, 2, 1}})))->axis), 45);
    EXPECT_EQ(degrees(orientation(*central_moments(of({{1, 2, 0}, {0, 1, 1}})))->axis), -45);
}

TEST(Orientation, IsRefusedForASquare) {
    EXPECT_EQ(orientation(*central_moments(of({{0, 2, 0}, {0, 2, 1}}))).status(), Status::degenerate);
}

TEST(Orientation, EqualsTheReference) {
    Random random(64);
    for (int round = 0; round < 200; ++round) {
        const std::vector<Segment> runs = random_region(random, 400);
        const CentralMoments c = *central_moments(of(runs));
        const Result<Orientation> result = orientation(c);
        ASSERT_TRUE(result.ok());
        const double along = static_cast<double>((c.mu20 - c.mu02).raw());
        const double across = 2.0 * static_cast<double>(c.mu11.raw());
        const double real = std::atan2(across, along) * 90 / std::acos(-1.0);
        EXPECT_NEAR(degrees(result->axis), real, 1e-6);
        EXPECT_GT(degrees(result->axis), -90);
        EXPECT_LE(degrees(result->axis), 90);
        EXPECT_NEAR(result->elongation.raw() / 65536.0,
                    std::hypot(along, across) / static_cast<double>((c.mu20 + c.mu02).raw()), 2.0 / 65536);
    }
}

TEST(Stretched, IsTheImageWithRowsFartherApart) {
    // Rows twice as far apart: every run stands in every second row.
    Random random(65);
    const std::vector<Segment> runs = random_region(random, 300);
    std::vector<Segment> apart = runs;
    for (Segment& run : apart) run.y *= 2;
    const CentralMoments real = *central_moments(of(apart));
    const CentralMoments made = stretched(*central_moments(of(runs)), PixelAspect::from_int(2));
    EXPECT_EQ(made.mu20, real.mu20);
    EXPECT_NEAR(static_cast<double>((made.mu11 - real.mu11).raw()), 0, 8);
    EXPECT_NEAR(static_cast<double>((made.mu02 - real.mu02).raw()), 0, 16);
    EXPECT_NEAR(static_cast<double>(made.mu21), static_cast<double>(real.mu21), 8);
    EXPECT_NEAR(static_cast<double>(made.mu12), static_cast<double>(real.mu12), 16);
    EXPECT_NEAR(static_cast<double>(made.mu03), static_cast<double>(real.mu03), 32);
}

}  // namespace
}  // namespace fovea::test
