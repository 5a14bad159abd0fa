// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/gradient_direction.hpp>
#include <fovea/filter/sobel.hpp>

namespace fovea::test {
namespace {

constexpr double turn = 6.283185307179586476925286766559;

/// How far a direction is from the real angle of (x, y), in 1/65536 turn.
double error_of(std::uint16_t direction, int x, int y) {
    const double real = std::atan2(y, x) / turn * 65536;
    const double off = std::remainder(direction - real, 65536.0);
    return std::abs(off);
}

TEST(GradientDirection, PointsToWhereItIsBrighter) {
    const Size size{9, 9};
    const struct {
        int x, y, expected;
    } cases[] = {{1, 0, 0},      {1, 1, 8192},    {0, 1, 16384},  {-1, 1, 24576},
                 {-1, 0, 32768}, {-1, -1, 40960}, {0, -1, 49152}, {1, -1, 57344}};
    for (const auto& c : cases) {
        GuardedImage<Gray8> src(size);
        GuardedImage<Direction16> dst(size);
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 9; ++x)
                src(x, y) = static_cast<Gray8>(100 + 5 * (c.x * (x - 4) + c.y * (y - 4)));
        run_filter(gradient_direction, gradient_direction_scratch(size), src, Border::replicate, dst);
        for (int y = 1; y < 8; ++y)
            for (int x = 1; x < 8; ++x) EXPECT_EQ(dst(x, y), c.expected) << x << "," << y;
    }
}

TEST(GradientDirection, IsZeroWhereTheImageIsFlat) {
    const Size size{37, 5};
    GuardedImage<Gray8> src(size);
    GuardedImage<Direction16> dst(size);
    src.fill(Gray8{77});
    run_filter(gradient_direction, gradient_direction_scratch(size), src, Border::replicate, dst);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 37; ++x) EXPECT_EQ(dst(x, y), 0);
}

TEST(GradientDirection, IsWithinOneOfTheRealAngleForEveryPairOfDerivatives) {
    // The kernel's function on its own: 2041 * 2041 pairs.
    constexpr int most = 1020;
    double worst = 0;
    for (int y = -most; y <= most; ++y)
        for (int x = -most; x <= most; x += simd::lanes) {
            std::uint16_t xs[simd::lanes], ys[simd::lanes], directions[simd::lanes];
            for (int i = 0; i < simd::lanes; ++i) {
                xs[i] = static_cast<std::uint16_t>(std::min(x + i, most));
                ys[i] = static_cast<std::uint16_t>(y);
            }
            kernels::direction_of(simd::Words::load(xs), simd::Words::load(ys)).store(directions);
            for (int i = 0; i < simd::lanes && x + i <= most; ++i)
                if (x + i != 0 || y != 0) worst = std::max(worst, error_of(directions[i], x + i, y));
        }
    EXPECT_LT(worst, 1.0);
}

TEST(GradientDirection, IsTheAngleOfSobelOnEverySizeAndBorder) {
    Random random(95);
    for (const Size size : test_sizes())
        for (const Border border : all_borders) {
            GuardedImage<Gray8> src(size);
            GuardedImage<Direction16> dst(size);
            GuardedImage<Gradient16> dx(size), dy(size);
            src.fill(random);
            run_filter(gradient_direction, gradient_direction_scratch(size), src, border, dst);
            run_filter(sobel_x, derivative_scratch(size), src, border, dx);
            run_filter(sobel_y, derivative_scratch(size), src, border, dy);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    if (dx(x, y) == 0 && dy(x, y) == 0)
                        ASSERT_EQ(dst(x, y), 0);
                    else
                        ASSERT_LT(error_of(dst(x, y), dx(x, y), dy(x, y)), 1.0);
                }
        }
}

TEST(GradientDirection, TurnsWithTheImage) {
    Random random(96);
    const Size size{40, 40};
    GuardedImage<Gray8> src(size), turned(size);
    GuardedImage<Direction16> dst(size), other(size);
    src.fill(random);
    // A quarter of a turn clockwise: (x, y) goes to (39 - y, x).
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) turned(39 - y, x) = src(x, y);
    run_filter(gradient_direction, gradient_direction_scratch(size), src, Border::replicate, dst);
    run_filter(gradient_direction, gradient_direction_scratch(size), turned, Border::replicate, other);
    for (int y = 1; y < 39; ++y)
        for (int x = 1; x < 39; ++x)
            ASSERT_EQ(static_cast<std::uint16_t>(dst(x, y) + 16384), other(39 - y, x));
}

TEST(GradientDirection, SaysWhatIsWrong) {
    std::vector<std::uint8_t> bytes(10000);
    const Size size{40, 8};
    const auto needed = static_cast<std::ptrdiff_t>(gradient_direction_scratch(size));
    GuardedImage<Gray8> src(size);
    GuardedImage<Direction16> dst(size), small({39, 8});
    dst.fill(Direction16{3});
    EXPECT_EQ(gradient_direction({}, Border::zero, {bytes.data(), needed}, dst.view()), Status::empty_image);
    EXPECT_EQ(gradient_direction(src.view(), Border::zero, {bytes.data(), needed}, small.view()),
              Status::size_mismatch);
    EXPECT_EQ(gradient_direction(src.view(), Border::zero, {bytes.data(), needed - 1}, dst.view()),
              Status::scratch_too_small);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 40; ++x) EXPECT_EQ(dst(x, y), 3);
}

}  // namespace
}  // namespace fovea::test
