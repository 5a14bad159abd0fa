// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/histogram.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

Histogram of_levels(const std::vector<int>& levels) {
    Histogram histogram;
    for (const int level : levels) {
        const auto pixel = static_cast<Gray8>(level);
        histogram.add_row(&pixel, 1);
    }
    return histogram;
}

/// The between-class variance of eq. 18 when the dark class is below level; 0 where a class is empty.
long double naive_variance(const Histogram& histogram, int level) {
    long double count[2] = {0, 0};
    long double sum[2] = {0, 0};
    for (int i = 0; i < 256; ++i) {
        count[i >= level] += histogram[i];
        sum[i >= level] += static_cast<long double>(histogram[i]) * i;
    }
    if (count[0] == 0 || count[1] == 0) return 0;
    const long double step = sum[1] / count[1] - sum[0] / count[0];
    return count[0] * count[1] * step * step;
}

TEST(HistogramOf, CountsEveryPixelOnce) {
    Random random(51);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size);
        src.fill(random);
        Histogram histogram;
        ASSERT_EQ(histogram_of(src.view(), histogram), Status::ok);
        std::vector<std::uint32_t> counts(256);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) ++counts[src(x, y)];
        for (int level = 0; level < 256; ++level)
            ASSERT_EQ(histogram[level], counts[static_cast<std::size_t>(level)]);
        EXPECT_EQ(histogram.total(), static_cast<std::uint32_t>(size.area()));
    }
}

TEST(HistogramOf, LeavesTheHistogramWhenThereIsNoImage) {
    Histogram histogram = of_levels({5});
    EXPECT_EQ(histogram_of(ImageView<const Gray8>(), histogram), Status::empty_image);
    EXPECT_EQ(histogram[5], 1u);
}

TEST(Histogram, BeginsAnewUnlessThereIsNoImage) {
    Histogram histogram = of_levels({5, 6});
    EXPECT_EQ(histogram.begin({0, 4}), Status::empty_image);
    EXPECT_EQ(histogram.total(), 2u);
    Histogram other = of_levels({5});
    other.merge(histogram);
    EXPECT_EQ(other[5], 2u);
    EXPECT_EQ(other[6], 1u);
    EXPECT_EQ(histogram.begin({4, 4}), Status::ok);
    EXPECT_EQ(histogram.total(), 0u);
}

TEST(Histogram, JoinsItsTablesToOneThatMayBeChanged) {
    const std::vector<Gray8> row{3, 3, 3, 3, 3, 9, 255, 0, 3, 3, 3, 3};
    Histogram histogram;
    histogram.add_row(row.data(), static_cast<int>(row.size()));
    std::uint32_t* counts = histogram.counts();
    EXPECT_EQ(counts[0], 1u);
    EXPECT_EQ(counts[3], 9u);
    EXPECT_EQ(counts[9], 1u);
    EXPECT_EQ(counts[255], 1u);
    EXPECT_EQ(histogram.total(), 12u);
    EXPECT_EQ(histogram[3], 9u);
    for (int level = 0; level < Histogram::levels; ++level) counts[level] = 0;
    EXPECT_EQ(histogram.total(), 0u);
    histogram.add_row(row.data(), 5);
    EXPECT_EQ(histogram[3], 5u);
}

TEST(Histogram, IsTheSameWithOneTableAndWithFour) {
    Random random(231);
    HistogramOf<1> one;
    HistogramOf<4> four;
    for (std::size_t width = 0; width <= 70; ++width) {
        std::vector<Gray8> row(width);
        std::vector<Gray8> mask(width);
        for (Gray8& pixel : row) pixel = static_cast<Gray8>(random.below(4) == 0 ? random.next() >> 9 : 7);
        for (Gray8& pixel : mask) pixel = static_cast<Gray8>(random.below(3));
        one.add_row(row.data(), static_cast<int>(width));
        four.add_row(row.data(), static_cast<int>(width));
        one.add_row(row.data(), mask.data(), static_cast<int>(width));
        four.add_row(row.data(), mask.data(), static_cast<int>(width));
    }
    for (int level = 0; level < Histogram::levels; ++level) EXPECT_EQ(one[level], four[level]);
    EXPECT_EQ(one.total(), four.total());
}

TEST(HistogramOf, CountsOnlyWhereTheMaskIsSet) {
    Random random(54);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), mask(size);
        src.fill(random);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) mask(x, y) = static_cast<Gray8>(random.below(3) * 100);
        Histogram histogram = of_levels({1, 2, 3});
        ASSERT_EQ(histogram_of(src.view(), mask.view(), histogram), Status::ok);
        std::vector<std::uint32_t> counts(256);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) counts[src(x, y)] += mask(x, y) != 0 ? 1u : 0u;
        for (int level = 0; level < 256; ++level)
            ASSERT_EQ(histogram[level], counts[static_cast<std::size_t>(level)]);
    }
}

TEST(HistogramOf, OfACropCountsTheRegion) {
    GuardedImage<Gray8> src({9, 7});
    src.fill(Gray8{4});
    for (int y = 2; y < 5; ++y)
        for (int x = 3; x < 8; ++x) src(x, y) = 9;
    Histogram histogram;
    ASSERT_EQ(histogram_of(*src.view().crop({3, 2, 5, 3}), histogram), Status::ok);
    EXPECT_EQ(histogram[9], 15u);
    EXPECT_EQ(histogram.total(), 15u);
}

TEST(HistogramOf, SaysWhenTheMaskDoesNotFit) {
    GuardedImage<Gray8> src({4, 3}), mask({4, 2});
    src.fill(Gray8{1});
    mask.fill(Gray8{255});
    Histogram histogram = of_levels({5});
    EXPECT_EQ(histogram_of(src.view(), mask.view(), histogram), Status::size_mismatch);
    EXPECT_EQ(histogram_of(src.view(), ImageView<const Gray8>(), histogram), Status::empty_image);
    EXPECT_EQ(histogram[5], 1u);
}

TEST(Quantile, CountsPixelsThatAreNotBrighter) {
    const Histogram histogram = of_levels({10, 20, 30, 40});
    EXPECT_EQ(*quantile(histogram, 0), 10);
    EXPECT_EQ(*quantile(histogram, whole_share / 4), 10);
    EXPECT_EQ(*quantile(histogram, whole_share / 4 + 1), 20);
    EXPECT_EQ(*quantile(histogram, whole_share / 2), 20);
    EXPECT_EQ(*quantile(histogram, whole_share), 40);
    EXPECT_EQ(quantile(histogram, whole_share + 1).status(), Status::bad_argument);
    EXPECT_EQ(quantile(Histogram(), 1).status(), Status::empty_image);
}

TEST(Quantile, NeverFallsWithTheShare) {
    Random random(52);
    GuardedImage<Gray8> src({64, 64});
    src.fill(random);
    Histogram histogram;
    ASSERT_EQ(histogram_of(src.view(), histogram), Status::ok);
    Gray8 before = 0;
    for (std::uint32_t share = 0; share <= whole_share; share += 97) {
        const Gray8 now = *quantile(histogram, share);
        EXPECT_GE(now, before);
        before = now;
    }
}

TEST(Otsu, SplitsTwoClassesInTheMiddleOfTheGap) {
    EXPECT_EQ(*otsu(of_levels({50, 50, 200})), (51 + 200) / 2);
    EXPECT_EQ(*otsu(of_levels({0, 255})), 128);
    EXPECT_EQ(*otsu(of_levels({7, 8})), 8);
    EXPECT_EQ(otsu(of_levels({9, 9, 9})).status(), Status::degenerate);
    EXPECT_EQ(otsu(Histogram()).status(), Status::empty_image);
}

TEST(Otsu, FindsTheGreatestVarianceOfAnyHistogram) {
    Random random(53);
    for (int round = 0; round < 500; ++round) {
        // Few to very many pixels, so that the counts are also halved.
        const int most = 1 << random.between(0, 21);
        Histogram histogram;
        std::vector<Gray8> row;
        for (int peak = 0; peak < 3; ++peak) {
            const int centre = random.between(0, 255);
            const int count = random.between(1, most);
            row.assign(static_cast<std::size_t>(count), 0);
            for (Gray8& pixel : row)
                pixel = static_cast<Gray8>(std::clamp(centre + random.between(-20, 20), 0, 255));
            histogram.add_row(row.data(), count);
        }
        long double best = 0;
        for (int level = 1; level < 256; ++level) best = std::max(best, naive_variance(histogram, level));
        // The roots have 31 bits, so the variance found may be below the best by 2^-29 of it.
        EXPECT_GE(naive_variance(histogram, *otsu(histogram)), best * (1 - 2e-9L)) << round;
    }
}

TEST(Otsu, HalvesTheCountsOfHugeImages) {
    Histogram histogram;
    std::vector<Gray8> dark(1 << 20, 40);
    std::vector<Gray8> bright(1 << 20, 180);
    for (int i = 0; i < 512; ++i) histogram.add_row(dark.data(), 1 << 20);
    for (int i = 0; i < 512; ++i) histogram.add_row(bright.data(), 1 << 20);
    EXPECT_EQ(*otsu(histogram), (41 + 180) / 2);
}

}  // namespace
}  // namespace fovea::test
