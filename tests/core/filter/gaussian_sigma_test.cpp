// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/gaussian_sigma.hpp>

namespace fovea::test {
namespace {

/// The taps by the real formula.
std::vector<double> real_taps(double sigma, int reach) {
    std::vector<double> taps;
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) {
        taps.push_back(std::exp(-i * i / (2 * sigma * sigma)));
        sum += taps.back();
    }
    for (double& tap : taps) tap /= sum;
    return taps;
}

/// A sum as the operator makes it, one product at a time.
int weighed(const GaussianTaps& taps, const std::vector<int>& values) {
    const int reach = taps.reach;
    int sum = (reach + 1) / 2 + (values[static_cast<std::size_t>(reach)] * taps.weight[0] >> 16);
    for (int i = 1; i <= reach; ++i) {
        const std::int64_t pair =
            values[static_cast<std::size_t>(reach - i)] + values[static_cast<std::size_t>(reach + i)];
        sum += static_cast<int>(pair * taps.weight[i] >> 16);
    }
    return sum;
}

int slow(const GaussianTaps& taps, ImageView<const Gray8> src, Border border, int x, int y) {
    std::vector<int> columns;
    for (int i = -taps.reach; i <= taps.reach; ++i) {
        std::vector<int> rows;
        const int column = border_index(border, x + i, src.width());
        for (int j = -taps.reach; j <= taps.reach; ++j)
            rows.push_back(column == no_index ? 0 : bordered(src, border, column, y + j) << 7);
        // Beyond a border of zeros there is nothing, not even what rounding puts back.
        columns.push_back(column == no_index ? 0 : weighed(taps, rows));
    }
    return (weighed(taps, columns) + 64) >> 7;
}

TEST(GaussianTaps, SumToOneAndAreTheRealOnes) {
    for (int raw = min_gaussian_sigma.raw(); raw <= max_gaussian_sigma.raw(); raw += 13) {
        const Result<GaussianTaps> taps = gaussian_taps(SubPixel::from_raw(raw));
        ASSERT_TRUE(taps.ok());
        int sum = taps->weight[0];
        const std::vector<double> real = real_taps(raw / 256.0, taps->reach);
        for (int i = 1; i <= taps->reach; ++i) {
            sum += 2 * taps->weight[i];
            // Half a unit of rounding and what the exponentials are wrong by.
            EXPECT_NEAR(taps->weight[i], 65536 * real[static_cast<std::size_t>(taps->reach + i)], 0.51)
                << raw << " " << i;
        }
        EXPECT_EQ(sum, 65536) << raw;
        EXPECT_GE(taps->reach, 3.0 * raw / 256.0);
        EXPECT_LT(taps->reach, max_reach);
    }
    EXPECT_EQ(gaussian_taps(SubPixel::from_raw(min_gaussian_sigma.raw() - 1)).status(), Status::bad_argument);
    EXPECT_EQ(gaussian_taps(SubPixel::from_raw(max_gaussian_sigma.raw() + 1)).status(), Status::bad_argument);
    EXPECT_EQ(gaussian_taps(SubPixel::from_raw(-1)).status(), Status::bad_argument);
}

TEST(Gaussian, EqualsTheReferenceOnEverySizeAndBorder) {
    for (const int raw : {77, 200, 512, 1500}) {
        const GaussianTaps taps = *gaussian_taps(SubPixel::from_raw(raw));
        Random random(47);
        for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{5, 4}, Size{33, 7}, Size{131, 5}})
            for (const Border border : all_borders) {
                GuardedImage<Gray8> src(size), dst(size);
                src.fill(random);
                run_filter([&](auto from, Border b, Span<std::uint8_t> scratch,
                               auto to) { return gaussian(from, SubPixel::from_raw(raw), b, scratch, to); },
                           gaussian_scratch(size), src, border, dst);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        ASSERT_EQ(dst(x, y), slow(taps, src.view(), border, x, y))
                            << raw << " at " << x << "," << y << " of " << size.width << "x" << size.height;
            }
    }
}

TEST(Gaussian, IsWithinAQuarterOfALevelOfTheRealMean) {
    const Size size{80, 70};
    Random random(48);
    GuardedImage<Gray8> src(size), dst(size);
    src.fill(random);
    for (const int raw : {80, 256, 700, 2560}) {
        const int reach = gaussian_taps(SubPixel::from_raw(raw))->reach;
        const std::vector<double> real = real_taps(raw / 256.0, reach);
        run_filter([&](auto from, Border b, Span<std::uint8_t> scratch,
                       auto to) { return gaussian(from, SubPixel::from_raw(raw), b, scratch, to); },
                   gaussian_scratch(size), src, Border::replicate, dst);
        for (int y = 0; y < size.height; y += 7)
            for (int x = 0; x < size.width; x += 3) {
                double sum = 0;
                for (int j = -reach; j <= reach; ++j)
                    for (int i = -reach; i <= reach; ++i)
                        sum += real[static_cast<std::size_t>(i + reach)] *
                               real[static_cast<std::size_t>(j + reach)] *
                               bordered(src.view(), Border::replicate, x + i, y + j);
                ASSERT_NEAR(dst(x, y), sum, 0.75) << raw;  // 1/4, and half a level of the last rounding
            }
    }
}

TEST(Gaussian, LeavesAFlatImageToItsLastRow) {
    // The toolkit's form left out the last tap at the bottom: 145 in the last row of an image of 200.
    for (const int level : {0, 1, 127, 200, 254, 255})
        for (const int raw : {77, 256, 1111, 2560}) {
            GuardedImage<Gray8> src({41, 9}), dst({41, 9});
            src.fill(static_cast<Gray8>(level));
            run_filter([&](auto from, Border b, Span<std::uint8_t> scratch,
                           auto to) { return gaussian(from, SubPixel::from_raw(raw), b, scratch, to); },
                       gaussian_scratch({41, 9}), src, Border::replicate, dst);
            ASSERT_TRUE(equal(src.view(), dst.view())) << level << " " << raw;
        }
}

}  // namespace
}  // namespace fovea::test
