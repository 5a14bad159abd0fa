// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/median.hpp>

namespace fovea::test {
namespace {

Gray8 naive_median(ImageView<const Gray8> src, Border border, Size size, int x, int y) {
    std::vector<Gray8> pixels = naive_window(src, border, size, x, y);
    const auto middle = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() / 2);
    std::nth_element(pixels.begin(), middle, pixels.end());
    return *middle;
}

TEST(Median3x3, TakesOutASpeckAndKeepsAnEdge) {
    GuardedImage<Gray8> src({8, 6}), dst({8, 6});
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) src(x, y) = x < 4 ? 20 : 200;
    src(1, 2) = 255;
    src(6, 3) = 0;
    run_filter(median_3x3, median_3x3_scratch({8, 6}), src, Border::replicate, dst);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_EQ(dst(x, y), x < 4 ? 20 : 200);
}

TEST(Median3x3, EqualsTheReferenceOnEverySizeAndBorder) {
    expect_filter<Gray8>(median_3x3, median_3x3_scratch, [](auto src, Border border, int x, int y) {
        return naive_median(src, border, {3, 3}, x, y);
    });
}

TEST(Median5x5, EqualsTheReferenceOnEverySizeAndBorder) {
    expect_filter<Gray8>(median_5x5, median_5x5_scratch, [](auto src, Border border, int x, int y) {
        return naive_median(src, border, {5, 5}, x, y);
    });
}

TEST(Median5x5, FindsTheMiddleOfZerosAndOnesInAllTheirOrders) {
    // A network that finds the middle of any zeros and ones finds the middle of any numbers. 2^25 windows are
    // too many for a test; here is every pattern of one column beside random columns, a million windows.
    Random random(44);
    const Size size{640, 5};
    for (int round = 0; round < 300; ++round) {
        GuardedImage<Gray8> src(size, 0), dst(size, 0);
        const std::uint32_t density = 1 + random.below(31);
        for (int x = 0; x < size.width; ++x)
            for (int y = 0; y < 5; ++y) {
                const bool pattern = ((x / 3 + round) >> y & 1) != 0;
                src(x, y) = (x % 3 == 0 ? pattern : random.below(32) < density) ? 255 : 0;
            }
        run_filter(median_5x5, median_5x5_scratch(size), src, Border::replicate, dst);
        int column[640] = {};
        for (int x = 0; x < size.width; ++x)
            for (int y = 0; y < 5; ++y) column[x] += src(x, y) != 0 ? 1 : 0;
        for (int x = 2; x < size.width - 2; ++x) {
            const int ones = column[x - 2] + column[x - 1] + column[x] + column[x + 1] + column[x + 2];
            ASSERT_EQ(dst(x, 2), ones >= 13 ? 255 : 0);
        }
    }
}

TEST(Median, IsTheSameForAnInvertedImage) {
    Random random(45);
    GuardedImage<Gray8> src({70, 9}), inverse({70, 9}), dst({70, 9}), other({70, 9});
    src.fill(random);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 70; ++x) inverse(x, y) = static_cast<Gray8>(255 - src(x, y));
    run_filter(median_5x5, median_5x5_scratch({70, 9}), src, Border::reflect_101, dst);
    run_filter(median_5x5, median_5x5_scratch({70, 9}), inverse, Border::reflect_101, other);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 70; ++x) ASSERT_EQ(dst(x, y), 255 - other(x, y));
}

}  // namespace
}  // namespace fovea::test
