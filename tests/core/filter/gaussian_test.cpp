// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/gaussian.hpp>

namespace fovea::test {
namespace {

const std::vector<int> three = {1, 2, 1, 2, 4, 2, 1, 2, 1};

std::vector<int> outer_product(const std::vector<int>& row) {
    std::vector<int> square;
    for (const int a : row)
        for (const int b : row) square.push_back(a * b);
    return square;
}

TEST(Gaussian3x3, SpreadsASpikeByItsWeights) {
    GuardedImage<Gray8> src({5, 5}), dst({5, 5});
    src.fill(Gray8{0});
    src(2, 2) = 160;
    run_filter(gaussian_3x3, gaussian_3x3_scratch({5, 5}), src, Border::replicate, dst);
    const int expected[5][5] = {
        {0, 0, 0, 0, 0}, {0, 10, 20, 10, 0}, {0, 20, 40, 20, 0}, {0, 10, 20, 10, 0}, {0, 0, 0, 0, 0}};
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x) EXPECT_EQ(dst(x, y), expected[y][x]);
}

TEST(Gaussian3x3, EqualsTheReferenceOnEverySizeAndBorder) {
    expect_filter<Gray8>(gaussian_3x3, gaussian_3x3_scratch, [](auto src, Border border, int x, int y) {
        return (naive_correlation(src, border, {3, 3}, three, x, y) + 8) >> 4;
    });
}

TEST(Gaussian5x5, EqualsTheReferenceOnEverySizeAndBorder) {
    const std::vector<int> five = outer_product({1, 4, 6, 4, 1});
    expect_filter<Gray8>(gaussian_5x5, gaussian_5x5_scratch, [&](auto src, Border border, int x, int y) {
        return (naive_correlation(src, border, {5, 5}, five, x, y) + 128) >> 8;
    });
}

TEST(Gaussian5x5, RoundsOnceWhereTheToolkitRoundedTwice) {
    // A row of 20s in zeros: 6 * 20 / 16 = 7.5, twice rounded 8 across and 8 down; once it is 7.5, which goes
    // up. With 4s beside: the toolkit's intermediate lost what makes 2.53 of the sum 648 / 256.
    GuardedImage<Gray8> src({5, 5}), dst({5, 5});
    src.fill(Gray8{0});
    src(2, 2) = 18;
    run_filter(gaussian_5x5, gaussian_5x5_scratch({5, 5}), src, Border::zero, dst);
    EXPECT_EQ(dst(2, 2), 3);  // 36 * 18 / 256 = 2.53; twice rounded: 6.75 is 7, and 7 * 6 / 16 = 2.6
    EXPECT_EQ(dst(0, 2), 0);  // 6 * 18 / 256 = 0.42; twice rounded: 18 / 16 = 1.1 is 1, and 6 / 16 is 0.4
    EXPECT_EQ(dst(1, 1), 1);  // 16 * 18 / 256 = 1.125
    EXPECT_EQ(dst(2, 0), 0);  // twice rounded: 6.75 is 7, and 7 / 16 = 0.44
}

TEST(Gaussian, LeavesAFlatImageAndShiftsWithItsInput) {
    for (const int level : {0, 1, 128, 254, 255}) {
        GuardedImage<Gray8> src({37, 6}), dst({37, 6});
        src.fill(static_cast<Gray8>(level));
        for (const Border border : {Border::replicate, Border::reflect_101}) {
            run_filter(gaussian_3x3, gaussian_3x3_scratch({37, 6}), src, border, dst);
            EXPECT_TRUE(equal(src.view(), dst.view()));
            run_filter(gaussian_5x5, gaussian_5x5_scratch({37, 6}), src, border, dst);
            EXPECT_TRUE(equal(src.view(), dst.view()));
        }
    }
}

TEST(Gaussian, DarkensNoRowAtTheBottom) {
    // The toolkit's general form left out the last tap there: 145 in the last row of an image of 200.
    GuardedImage<Gray8> src({9, 9}), dst({9, 9});
    src.fill(Gray8{200});
    run_filter(gaussian_5x5, gaussian_5x5_scratch({9, 9}), src, Border::replicate, dst);
    for (int x = 0; x < 9; ++x) EXPECT_EQ(dst(x, 8), 200);
}

}  // namespace
}  // namespace fovea::test
