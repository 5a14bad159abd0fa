// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/laplacian.hpp>

namespace fovea::test {
namespace {

TEST(Laplacian4, EqualsTheReferenceOnEverySizeAndBorder) {
    const std::vector<int> weights = {0, 1, 0, 1, -4, 1, 0, 1, 0};
    expect_filter<Gradient16>(laplacian_4, laplacian_4_scratch, [&](auto src, Border border, int x, int y) {
        return naive_correlation(src, border, {3, 3}, weights, x, y);
    });
}

TEST(Laplacian8, EqualsTheReferenceOnEverySizeAndBorder) {
    const std::vector<int> weights = {1, 1, 1, 1, -8, 1, 1, 1, 1};
    expect_filter<Gradient16>(laplacian_8, laplacian_8_scratch, [&](auto src, Border border, int x, int y) {
        return naive_correlation(src, border, {3, 3}, weights, x, y);
    });
}

TEST(Laplacian, IsZeroOnASlopeAndItsWeightsOnASpike) {
    GuardedImage<Gray8> src({9, 9});
    GuardedImage<Gradient16> four({9, 9}), eight({9, 9});
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) src(x, y) = static_cast<Gray8>(3 * x + 5 * y);
    run_filter(laplacian_4, laplacian_4_scratch({9, 9}), src, Border::replicate, four);
    run_filter(laplacian_8, laplacian_8_scratch({9, 9}), src, Border::replicate, eight);
    for (int y = 1; y < 8; ++y)
        for (int x = 1; x < 8; ++x) {
            EXPECT_EQ(four(x, y), 0);
            EXPECT_EQ(eight(x, y), 0);
        }
    src.fill(Gray8{0});
    src(4, 4) = 255;
    run_filter(laplacian_8, laplacian_8_scratch({9, 9}), src, Border::replicate, eight);
    EXPECT_EQ(eight(4, 4), -2040);
    EXPECT_EQ(eight(3, 3), 255);
}

}  // namespace
}  // namespace fovea::test
