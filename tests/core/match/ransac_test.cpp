// SPDX-License-Identifier: MIT
#include <fovea/match/ransac.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include <fovea/match/ransac_transforms.hpp>
#include <support/scalars.hpp>

namespace fovea {
namespace {

using test::value_of;

TEST(RansacSamplesTest, IsTheSmallestPowerThatIsRareEnough) {
    // All agree, or none can.
    EXPECT_EQ(ransac_samples(10, 10, 3, 10, 1000), 1);
    EXPECT_EQ(ransac_samples(2, 10, 3, 10, 1000), 1000);
    // By hand: half of very many, samples of one: 2^-10 after 10 draws.
    EXPECT_EQ(ransac_samples(1, 2, 1, 10, 1000), 10);
    for (const int agreeing : {5, 12, 40, 77, 99}) {
        for (const int size : {1, 2, 4, 8}) {
            double good = 1;
            for (int i = 0; i < size; ++i) good *= double(agreeing - i) / (100 - i);
            const double exact = agreeing < size ? 1e9 : std::ceil(20 * std::log(0.5) / std::log(1 - good));
            const int most = 100000;
            EXPECT_EQ(ransac_samples(agreeing, 100, size, 20, most), std::min<double>(exact, most))
                << agreeing << " " << size;
        }
    }
}

TEST(RansacTest, FindsTheNumberThatMostAreNear) {
    const int data[12] = {7, 100, 3, 101, 55, 99, 100, -8, 102, 100, 31, 98};
    const auto make = [&](const std::ptrdiff_t(&chosen)[1]) { return Result<int>(data[chosen[0]]); };
    const auto agrees = [&](int model, std::ptrdiff_t i) { return std::abs(data[i] - model) <= 2; };
    const auto found = ransac<1, int>(12, {}, make, agrees);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->model, 100);
    EXPECT_EQ(found->agreeing, 7);
    EXPECT_TRUE(found->certain);
    EXPECT_LE(found->samples, 20);

    // Of equals, the first that is drawn: each agrees with itself alone.
    RansacOptions alone;
    alone.enough = 1;
    std::ptrdiff_t first = -1;
    const auto noted = [&](const std::ptrdiff_t(&chosen)[1]) {
        if (first < 0) first = chosen[0];
        return Result<std::ptrdiff_t>(chosen[0]);
    };
    const auto kept = ransac<1, std::ptrdiff_t>(
        12, alone, noted, [](std::ptrdiff_t model, std::ptrdiff_t i) { return model == i; });
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->model, first);

    RansacOptions options;
    options.enough = 7;
    EXPECT_TRUE((ransac<1, int>(12, options, make, agrees)));
    options.enough = 8;
    EXPECT_EQ((ransac<1, int>(12, options, make, agrees)).status(), Status::not_found);
}

TEST(RansacTest, DrawsWithinItsLimitsAndSaysWhatIsWrong) {
    int made = 0;
    std::set<std::ptrdiff_t> seen;
    const auto never = [&](const std::ptrdiff_t(&chosen)[3]) {
        ++made;
        EXPECT_LT(chosen[0], chosen[1]);
        EXPECT_LT(chosen[1], chosen[2]);
        for (const std::ptrdiff_t index : chosen) seen.insert(index);
        return Result<int>(Status::degenerate);
    };
    const auto agrees = [](int, std::ptrdiff_t) { return true; };
    RansacOptions options;
    options.most_samples = 50;
    EXPECT_EQ((ransac<3, int>(9, options, never, agrees)).status(), Status::degenerate);
    EXPECT_EQ(made, 50);
    EXPECT_EQ(seen.size(), 9u);

    // A single one that agrees among many: certainty is out of reach.
    const auto first = [](const std::ptrdiff_t(&chosen)[1]) { return Result<std::ptrdiff_t>(chosen[0]); };
    const auto itself = [](std::ptrdiff_t model, std::ptrdiff_t i) { return model == i; };
    options.enough = 1;
    const auto doubtful = ransac<1, std::ptrdiff_t>(1000, options, first, itself);
    ASSERT_TRUE(doubtful);
    EXPECT_FALSE(doubtful->certain);
    EXPECT_EQ(doubtful->samples, 50);

    for (const int bad : {0, 1, 2, 3, 4, 5}) {
        RansacOptions wrong;
        if (bad == 0) wrong.most_samples = 0;
        if (bad == 1) wrong.most_samples = (1 << 20) + 1;
        if (bad == 2) wrong.miss_bits = 0;
        if (bad == 3) wrong.miss_bits = 61;
        if (bad == 4) wrong.enough = -1;
        EXPECT_EQ((ransac<3, int>(bad == 5 ? 2 : 9, wrong, never, agrees)).status(), Status::bad_argument)
            << bad;
    }
}

struct Matches {
    std::vector<SubPixelPoint> from, to;
    std::vector<std::uint8_t> right, agrees;

    Span<const SubPixelPoint> sources() const {
        return {from.data(), static_cast<std::ptrdiff_t>(from.size())};
    }
    Span<const SubPixelPoint> targets() const { return {to.data(), static_cast<std::ptrdiff_t>(to.size())}; }
    Span<std::uint8_t> flags() {
        agrees.assign(from.size(), 7);
        return {agrees.data(), static_cast<std::ptrdiff_t>(agrees.size())};
    }
};

/// Pairs of a transform with up to a half pixel of noise, and some that are anything.
Matches matches(Random& random, const double (&h)[9], int count, int wrong) {
    Matches all;
    for (int i = 0; i < count; ++i) {
        const double x = random.between(0, 640);
        const double y = random.between(0, 480);
        const double weight = h[6] * x + h[7] * y + h[8];
        double u = (h[0] * x + h[1] * y + h[2]) / weight;
        double v = (h[3] * x + h[4] * y + h[5]) / weight;
        const bool is_right = i % count >= wrong;
        if (is_right) {
            u += random.between(-128, 128) / 256.0;
            v += random.between(-128, 128) / 256.0;
        } else {
            u = random.between(0, 640);
            v = random.between(0, 480);
        }
        const auto raw = [](double value) {
            return SubPixel::from_raw(static_cast<std::int32_t>(std::lround(value * 256)));
        };
        all.from.push_back({raw(x), raw(y)});
        all.to.push_back({raw(u), raw(v)});
        all.right.push_back(is_right ? 1 : 0);
    }
    return all;
}

constexpr double tilted[9] = {0.9, -0.2, 60, 0.15, 1.1, 30, 1e-3, 2e-3, 1};
constexpr double turned[9] = {0.9, -0.2, 60, 0.2, 0.9, -30, 0, 0, 1};

TEST(RansacTransformsTest, FindThePairsThatBelongTogether) {
    Random random(5);
    Matches all = matches(random, tilted, 120, 60);
    const SubPixel tolerance = SubPixel::from_int(1);
    const auto h = fit_homography_ransac(all.sources(), all.targets(), tolerance, {}, all.flags());
    ASSERT_TRUE(h);
    EXPECT_TRUE(h->certain);
    std::ptrdiff_t agreeing = 0;
    for (std::size_t i = 0; i < all.right.size(); ++i) {
        // One of the wrong pairs may be right by chance; none of the right ones is left out.
        EXPECT_GE(all.agrees[i], all.right[i]) << i;
        agreeing += all.agrees[i];
    }
    EXPECT_EQ(agreeing, h->agreeing);
    EXPECT_LE(agreeing, 62);
    for (const double x : {10.0, 600.0}) {
        for (const double y : {10.0, 450.0}) {
            const auto place = map_point(h->transform, Vector<2>(test::real_of(x), test::real_of(y)));
            ASSERT_TRUE(place);
            const double weight = tilted[6] * x + tilted[7] * y + tilted[8];
            const double u = (tilted[0] * x + tilted[1] * y + tilted[2]) / weight;
            const double v = (tilted[3] * x + tilted[4] * y + tilted[5]) / weight;
            EXPECT_NEAR(static_cast<double>(value_of((*place)[0])), u, 0.5);
            EXPECT_NEAR(static_cast<double>(value_of((*place)[1])), v, 0.5);
        }
    }

    Matches flat = matches(random, turned, 90, 60);
    const auto a = fit_affine_ransac(flat.sources(), flat.targets(), tolerance, {}, flat.flags());
    ASSERT_TRUE(a);
    EXPECT_GE(a->agreeing, 30);
    EXPECT_LE(a->agreeing, 33);
    for (int i = 0; i < 6; ++i) {
        EXPECT_NEAR(static_cast<double>(value_of(a->transform(i / 3, i % 3))), turned[i],
                    i % 3 == 2 ? 0.6 : 0.002);
    }
    // The same seed gives the same bits.
    const auto again = fit_affine_ransac(flat.sources(), flat.targets(), tolerance, {}, flat.flags());
    ASSERT_TRUE(again);
    EXPECT_EQ(again->transform, a->transform);
}

TEST(RansacTransformsTest, AreThoseOfTheRightPairsWhereNoneIsWrong) {
    Random random(6);
    Matches all = matches(random, tilted, 40, 0);
    const auto robust =
        fit_homography_ransac(all.sources(), all.targets(), SubPixel::from_int(2), {}, all.flags());
    const auto plain = fit_homography(all.sources(), all.targets());
    ASSERT_TRUE(robust && plain);
    EXPECT_EQ(robust->agreeing, 40);
    EXPECT_EQ(robust->transform, *plain);
}

TEST(RansacTransformsTest, ToleranceIsInPixelsWhateverTheDivisor) {
    // At the origin the divisor is half of what it is at the mean: an error of 1.5 px is no smaller there.
    Random random(8);
    Matches all = matches(random, tilted, 40, 0);
    const SubPixel off = SubPixel::from_ratio(3, 2);
    all.from[0] = {};
    all.to[0] = {SubPixel::from_int(60) + off, SubPixel::from_int(30)};
    const auto fit =
        fit_homography_ransac(all.sources(), all.targets(), SubPixel::from_int(1), {}, all.flags());
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->agreeing, 39);
    EXPECT_EQ(all.agrees[0], 0);
}

TEST(RansacTransformsTest, RefuseWhatIsNone) {
    Random random(7);
    Matches noise = matches(random, tilted, 60, 60);
    RansacOptions options;
    options.most_samples = 200;
    options.enough = 12;
    const SubPixel tolerance = SubPixel::from_int(1);
    EXPECT_EQ(
        fit_homography_ransac(noise.sources(), noise.targets(), tolerance, options, noise.flags()).status(),
        Status::not_found);
    // The caller's flags are as they were.
    for (const std::uint8_t flag : noise.agrees) EXPECT_EQ(flag, 7);
    EXPECT_EQ(fit_homography_ransac(noise.sources(), noise.targets().first(3), tolerance, {}, noise.flags())
                  .status(),
              Status::size_mismatch);
    EXPECT_EQ(
        fit_affine_ransac(noise.sources(), noise.targets(), tolerance, {}, noise.flags().first(3)).status(),
        Status::size_mismatch);
    EXPECT_EQ(fit_affine_ransac(noise.sources(), noise.targets(), SubPixel(), {}, noise.flags()).status(),
              Status::bad_argument);
    Matches few = matches(random, tilted, 3, 0);
    EXPECT_EQ(fit_homography_ransac(few.sources(), few.targets(), tolerance, {}, few.flags()).status(),
              Status::bad_argument);
    Matches line;
    for (int i = 0; i < 20; ++i) {
        const SubPixel side = SubPixel::from_int(i);
        line.from.push_back({side, side});
        line.to.push_back({side, side});
    }
    EXPECT_EQ(
        fit_homography_ransac(line.sources(), line.targets(), tolerance, options, line.flags()).status(),
        Status::degenerate);
}

}  // namespace
}  // namespace fovea
