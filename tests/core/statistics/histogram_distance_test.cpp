// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/statistics/colour_histogram.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/statistics/histogram_distance.hpp>

namespace fovea::test {
namespace {

using Counts = std::vector<std::uint32_t>;
Span<const std::uint32_t> bins(const Counts& counts) {
    return {counts.data(), static_cast<std::ptrdiff_t>(counts.size())};
}

TEST(HistogramDistance, IsKnownForTwoBins) {
    // Shares 1/4, 3/4 and 3/4, 1/4.
    const Counts a = {1, 3};
    const Counts b = {300, 100};
    EXPECT_EQ(*histogram_intersection(bins(a), bins(b)), Ratio::from_ratio(1, 2));
    EXPECT_EQ(*histogram_difference(bins(a), bins(b)), Ratio::from_int(1));
    EXPECT_EQ(*chi_square_distance(bins(a), bins(b)), Ratio::from_ratio(1, 2));
    // 1 - 2 sqrt(3) / 4 = 0.1339746, its root 0.3660254.
    EXPECT_NEAR(bhattacharyya_distance(bins(a), bins(b))->raw(), 0.3660254 * 65536, 2);
    EXPECT_EQ(*earth_movers_distance(bins(a), bins(b)), GrayLevel::from_ratio(1, 2));
}

TEST(HistogramDistance, IsNothingForEqualSharesAndMostForNoneInCommon) {
    Counts a(256), twice(256);
    Random random(181);
    for (std::size_t i = 0; i < 256; ++i) {
        a[i] = random.below(1000);
        twice[i] = 2 * a[i];
    }
    EXPECT_EQ(histogram_intersection(bins(a), bins(twice))->raw(), 65536);
    EXPECT_EQ(histogram_difference(bins(a), bins(twice))->raw(), 0);
    EXPECT_EQ(chi_square_distance(bins(a), bins(twice))->raw(), 0);
    EXPECT_EQ(bhattacharyya_distance(bins(a), bins(twice))->raw(), 0);
    EXPECT_EQ(earth_movers_distance(bins(a), bins(twice))->raw(), 0);
    const Counts first = {9, 0, 0, 0};
    const Counts last = {0, 0, 0, 5};
    EXPECT_EQ(histogram_intersection(bins(first), bins(last))->raw(), 0);
    EXPECT_EQ(histogram_difference(bins(first), bins(last))->raw(), 2 * 65536);
    EXPECT_EQ(chi_square_distance(bins(first), bins(last))->raw(), 2 * 65536);
    EXPECT_EQ(bhattacharyya_distance(bins(first), bins(last))->raw(), 65536);
    EXPECT_EQ(earth_movers_distance(bins(first), bins(last))->raw(), 3 * 65536);
}

TEST(HistogramDistance, IsTheRealOneWithinItsBoundAndTheSameBothWays) {
    Random random(182);
    for (int round = 0; round < 300; ++round) {
        const auto size = static_cast<std::size_t>(random.between(1, 600));
        const std::uint32_t most = 1u << random.between(1, 31);
        Counts a(size), b(size);
        for (std::size_t i = 0; i < size; ++i) {
            a[i] = random.below(3) == 0 ? 0 : random.below(most);
            b[i] = random.below(3) == 0 ? 0 : random.below(most);
        }
        ++a[0];
        ++b[size - 1];
        long double total_a = 0, total_b = 0;
        for (std::size_t i = 0; i < size; ++i) {
            total_a += a[i];
            total_b += b[i];
        }
        long double common = 0, difference = 0, chi = 0, roots = 0, moved = 0, up_a = 0, up_b = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const long double p = a[i] / total_a;
            const long double q = b[i] / total_b;
            common += std::min(p, q);
            difference += std::fabs(p - q);
            chi += p + q > 0 ? (p - q) * (p - q) / (p + q) : 0;
            roots += (std::sqrt(p) - std::sqrt(q)) * (std::sqrt(p) - std::sqrt(q));
            up_a += a[i];
            up_b += b[i];
            moved += std::fabs(up_a / total_a - up_b / total_b);
        }
        const auto near = [](std::int32_t raw, long double value, double bound) {
            EXPECT_NEAR(static_cast<double>(raw), static_cast<double>(value * 65536), bound);
        };
        // Half a unit of rounding, and a share's error times the bins: 600 * 2^-40, and 1200 * 2^-31 * 65536
        // of chi. Totals above 2^32 lose their lowest bits first, at most 2^-21 of a bin.
        near(histogram_intersection(bins(a), bins(b))->raw(), common, 0.6);
        near(histogram_difference(bins(a), bins(b))->raw(), difference, 0.6);
        near(chi_square_distance(bins(a), bins(b))->raw(), chi, 0.6);
        near(bhattacharyya_distance(bins(a), bins(b))->raw(), std::sqrt(roots / 2), 2);
        near(earth_movers_distance(bins(a), bins(b))->raw(), moved, 0.6);
        EXPECT_EQ(*chi_square_distance(bins(a), bins(b)), *chi_square_distance(bins(b), bins(a)));
        EXPECT_EQ(*earth_movers_distance(bins(a), bins(b)), *earth_movers_distance(bins(b), bins(a)));
        EXPECT_EQ(*bhattacharyya_distance(bins(a), bins(b)), *bhattacharyya_distance(bins(b), bins(a)));
    }
}

TEST(HistogramDistance, ComparesHistogramsOfEitherKind) {
    Histogram dark, bright;
    const Gray8 levels[] = {10, 20, 30, 200};
    dark.add_row(levels, 3);
    bright.add_row(levels + 1, 3);
    EXPECT_EQ(*histogram_intersection(dark, bright), Ratio::from_ratio(2, 3));
    EXPECT_EQ(*earth_movers_distance(dark, bright), GrayLevel::from_ratio(190, 3));
    HueSaturationHistogram<> red, blue;
    const Hsv888 colours[] = {{0, 255, 255}, {120, 255, 255}};
    red.add_row(colours, 1);
    blue.add_row(colours + 1, 1);
    EXPECT_EQ(*histogram_intersection(red, blue), Ratio::from_int(0));
    EXPECT_EQ(*chi_square_distance(red, red), Ratio::from_int(0));
}

TEST(HistogramDistance, SaysWhatIsWrong) {
    const Counts some = {1, 2}, none = {0, 0}, three = {1, 1, 1};
    const Counts huge(65537, 1), large(32769, 1);
    const auto all = [](const Counts& a, const Counts& b) {
        const Status statuses[] = {histogram_intersection(bins(a), bins(b)).status(),
                                   histogram_difference(bins(a), bins(b)).status(),
                                   chi_square_distance(bins(a), bins(b)).status(),
                                   bhattacharyya_distance(bins(a), bins(b)).status(),
                                   earth_movers_distance(bins(a), bins(b)).status()};
        for (const Status s : statuses) EXPECT_EQ(s, statuses[0]);
        return statuses[0];
    };
    EXPECT_EQ(all(some, none), Status::empty_image);
    EXPECT_EQ(all(none, some), Status::empty_image);
    EXPECT_EQ(all({}, some), Status::empty_image);
    EXPECT_EQ(all(some, three), Status::size_mismatch);
    EXPECT_EQ(all(huge, huge), Status::bad_argument);
    EXPECT_EQ(earth_movers_distance(bins(large), bins(large)).status(), Status::bad_argument);
    EXPECT_TRUE(histogram_intersection(bins(large), bins(large)).ok());
}

}  // namespace
}  // namespace fovea::test
