// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/sobel.hpp>

namespace fovea::test {
namespace {

/// Weights of a derivative to the right, smoothed down by side middle side; and the same turned.
std::vector<int> right(int side, int middle) { return {-side, 0, side, -middle, 0, middle, -side, 0, side}; }
std::vector<int> downwards(int side, int middle) {
    return {-side, -middle, -side, 0, 0, 0, side, middle, side};
}

using Derivative = Status (*)(ImageView<const Gray8>, Border, Span<std::uint8_t>, ImageView<Gradient16>);

void expect_derivative(Derivative derivative, const std::vector<int>& weights) {
    expect_filter<Gradient16>(derivative, derivative_scratch, [&](auto src, Border border, int x, int y) {
        return naive_correlation(src, border, {3, 3}, weights, x, y);
    });
}

TEST(Derivative, EqualsTheReferenceOnEverySizeAndBorder) {
    expect_derivative(sobel_x, right(1, 2));
    expect_derivative(sobel_y, downwards(1, 2));
    expect_derivative(prewitt_x, right(1, 1));
    expect_derivative(prewitt_y, downwards(1, 1));
    expect_derivative(scharr_x, right(3, 10));
    expect_derivative(scharr_y, downwards(3, 10));
    expect_derivative(difference_x, right(0, 1));
    expect_derivative(difference_y, downwards(0, 1));
}

TEST(Sobel, IsEightForOneLevelAPixelAndPointsRightAndDown) {
    GuardedImage<Gray8> src({7, 5});
    GuardedImage<Gradient16> dst({7, 5});
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) src(x, y) = static_cast<Gray8>(10 + x + 3 * y);
    run_filter(sobel_x, derivative_scratch({7, 5}), src, Border::replicate, dst);
    EXPECT_EQ(dst(3, 2), 8);
    EXPECT_EQ(dst(0, 2), 4);  // the first column repeats
    run_filter(sobel_y, derivative_scratch({7, 5}), src, Border::replicate, dst);
    EXPECT_EQ(dst(3, 2), 24);
}

TEST(Sobel, TurnsWithItsImage) {
    Random random(46);
    GuardedImage<Gray8> src({13, 13}), turned({13, 13});
    GuardedImage<Gradient16> x_of({13, 13}), y_of_turned({13, 13});
    src.fill(random);
    for (int y = 0; y < 13; ++y)
        for (int x = 0; x < 13; ++x) turned(y, x) = src(x, y);
    run_filter(sobel_x, derivative_scratch({13, 13}), src, Border::reflect_101, x_of);
    run_filter(sobel_y, derivative_scratch({13, 13}), turned, Border::reflect_101, y_of_turned);
    for (int y = 0; y < 13; ++y)
        for (int x = 0; x < 13; ++x) ASSERT_EQ(x_of(x, y), y_of_turned(y, x));
}

TEST(Difference, WritesTheLastRowWhichTheToolkitForgot) {
    GuardedImage<Gray8> src({4, 4});
    GuardedImage<Gradient16> dst({4, 4});
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) src(x, y) = static_cast<Gray8>(50 * y);
    dst.fill(Gradient16{1234});
    run_filter(difference_y, derivative_scratch({4, 4}), src, Border::replicate, dst);
    for (int x = 0; x < 4; ++x) EXPECT_EQ(dst(x, 3), 50);
}

using Strength = Status (*)(ImageView<const Gray8>, Border, Span<std::uint8_t>, ImageView<Gray8>);

void expect_strength(Strength strength, int side, int middle, bool sum) {
    expect_filter<Gray8>(strength, gradient_scratch, [&](auto src, Border border, int x, int y) {
        const int a = std::abs(naive_correlation(src, border, {3, 3}, right(side, middle), x, y));
        const int b = std::abs(naive_correlation(src, border, {3, 3}, downwards(side, middle), x, y));
        return std::min(255, sum ? a + b : std::max(a, b));
    });
}

TEST(GradientStrength, EqualsTheReferenceOnEverySizeAndBorder) {
    expect_strength(sobel_magnitude, 1, 2, true);
    expect_strength(sobel_maximum, 1, 2, false);
    expect_strength(prewitt_maximum, 1, 1, false);
    expect_strength(difference_maximum, 0, 1, false);
}

TEST(GradientStrength, LiesWhereTheEdgeIs) {
    // The toolkit's gradient of colour images was written one pixel up and to the left.
    GuardedImage<Gray8> src({9, 9}), dst({9, 9});
    src.fill(Gray8{0});
    src(4, 4) = 30;
    run_filter(sobel_magnitude, gradient_scratch({9, 9}), src, Border::replicate, dst);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) {
            const int distance = std::max(std::abs(x - 4), std::abs(y - 4));
            EXPECT_EQ(dst(x, y), distance == 1 ? 60 : 0) << x << "," << y;
        }
}

}  // namespace
}  // namespace fovea::test
