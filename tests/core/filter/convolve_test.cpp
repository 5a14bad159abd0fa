// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/convolve.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/stream/stream.hpp>

namespace fovea::test {
namespace {

/// A kernel with weights of its own.
struct Weights {
    std::vector<std::int16_t> weights;
    Size size{3, 3};
    int divisor = 1;
    int offset = 0;

    ConvolutionKernel kernel() const {
        return {{weights.data(), static_cast<std::ptrdiff_t>(weights.size())}, size, divisor, offset};
    }
};

Weights random_weights(Random& random, Size size, int magnitude, int divisor, int offset) {
    Weights w{{}, size, divisor, offset};
    for (int i = 0; i < size.area(); ++i)
        w.weights.push_back(static_cast<std::int16_t>(random.between(-magnitude, magnitude)));
    return w;
}

/// floor((2 sum + divisor) / (2 divisor)), and so to the nearest, ties up.
std::int64_t naive_sum(ImageView<const Gray8> src, Border border, const Weights& w, int x, int y) {
    const std::vector<Gray8> pixels = naive_window(src, border, w.size, x, y);
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) sum += std::int64_t{pixels[i]} * w.weights[i];
    const std::int64_t above = 2 * sum + w.divisor;
    const std::int64_t below = 2 * std::int64_t{w.divisor};
    const std::int64_t quotient = above >= 0 ? above / below : -((-above + below - 1) / below);
    return quotient + w.offset;
}

template <class Pixel>
Status run_convolve(const GuardedImage<Gray8>& src, const Weights& w, Border border,
                    GuardedImage<Pixel>& dst) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(convolve_scratch(src.view().size(), w.size)),
                                      0xee);
    return convolve(src.view(), w.kernel(), border,
                    {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, dst.view());
}

template <class Pixel>
void expect_sums(const GuardedImage<Gray8>& src, const Weights& w, Border border, int low, int high) {
    GuardedImage<Pixel> dst(src.view().size());
    ASSERT_EQ(run_convolve(src, w, border, dst), Status::ok);
    for (int y = 0; y < src.view().height(); ++y)
        for (int x = 0; x < src.view().width(); ++x) {
            const std::int64_t sum = naive_sum(src.view(), border, w, x, y);
            ASSERT_EQ(std::int64_t{dst(x, y)}, std::clamp<std::int64_t>(sum, low, high))
                << src.view().width() << "x" << src.view().height() << " kernel " << w.size.width << "x"
                << w.size.height << " divisor " << w.divisor << " at " << x << "," << y;
        }
}
void expect_both(const GuardedImage<Gray8>& src, const Weights& w, Border border) {
    expect_sums<Gray8>(src, w, border, 0, 255);
    expect_sums<Gradient16>(src, w, border, -32768, 32767);
}

TEST(Convolve, IsNotTurnedRound) {
    GuardedImage<Gray8> src({3, 3}), dst({3, 3});
    src.fill(Gray8{0});
    src(1, 1) = 10;
    const Weights w{{1, 2, 3, 4, 5, 6, 7, 8, 9}};
    ASSERT_EQ(run_convolve(src, w, Border::zero, dst), Status::ok);
    // The middle stands below on the right of the first pixel: that sees it with the last weight.
    const int expected[3][3] = {{90, 80, 70}, {60, 50, 40}, {30, 20, 10}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) EXPECT_EQ(dst(x, y), expected[y][x]);
}

TEST(Convolve, EqualsTheReferenceForKernelsOfEveryKind) {
    Random random(91);
    const Size kernels[] = {{3, 3}, {1, 1}, {5, 5}, {7, 3}, {3, 7}, {9, 1}, {1, 9}, {15, 15}};
    for (const Size size : test_sizes())
        for (const Border border : all_borders) {
            GuardedImage<Gray8> src(size);
            src.fill(random);
            for (const Size kernel : kernels) {
                if (kernel.area() > 100 && size.area() > 400) continue;
                for (const int magnitude : {1, 9, 300, 32767}) {
                    const int divisor =
                        random.below(2) != 0 ? 1 << random.below(9) : 1 + int(random.below(999));
                    expect_both(src,
                                random_weights(random, kernel, magnitude, divisor, random.between(-255, 255)),
                                border);
                }
            }
        }
}

TEST(Convolve, HoldsAtTheEndsForTheLargestSums) {
    const Size size{37, 20};
    for (const int level : {0, 255})
        for (const int weight : {-32768, 32767})
            for (const Size kernel : {Size{3, 3}, Size{15, 15}})
                for (const int divisor : {1, 2, 3, 32768, 65521, 65535}) {
                    GuardedImage<Gray8> src(size);
                    src.fill(static_cast<Gray8>(level));
                    const std::vector<std::int16_t> weights(static_cast<std::size_t>(kernel.area()),
                                                            static_cast<std::int16_t>(weight));
                    expect_both(src, {weights, kernel, divisor, -255}, Border::replicate);
                    expect_both(src, {weights, kernel, divisor, 255}, Border::zero);
                }
}

TEST(Convolve, IsExactOnBothSidesOfTheLimitOf16Bits) {
    Random random(92);
    GuardedImage<Gray8> src({45, 7});
    src.fill(random);
    for (int x = 0; x < 45; ++x) src(x, 3) = 255;
    for (const int divisor : {1, 2, 7, 256, 300})
        for (int centre = 120; centre <= 260; ++centre)
            for (const int side : {0, -1, -centre}) {
                const auto s = static_cast<std::int16_t>(side);
                expect_both(src,
                            {{0, 0, 0, s, static_cast<std::int16_t>(centre), 0, 0, 0, 0}, {3, 3}, divisor, 0},
                            Border::replicate);
            }
}

TEST(Convolve, IsExactForAnyDivisorOfWideSums) {
    // Divisors whose reciprocal is exact for these sums, and others.
    Random random(504);
    GuardedImage<Gray8> src({256, 2});
    for (int x = 0; x < 256; ++x) src(x, 0) = src(x, 1) = static_cast<Gray8>(x);
    for (int round = 0; round < 400; ++round) {
        const int most = round % 2 == 0 ? 32767 : 1000;
        const auto weight = static_cast<std::int16_t>(random.between(258, most) * (round % 4 < 2 ? 1 : -1));
        const int divisor = random.between(1, round % 3 == 0 ? 65535 : 1000);
        expect_both(src, {{weight}, {1, 1}, divisor, random.between(-255, 255)}, Border::replicate);
    }
}

TEST(Convolve, WithTheWeightsOfAnotherFilterIsThatFilter) {
    Random random(93);
    const Size size{71, 13};
    GuardedImage<Gray8> src(size), mean(size), other(size);
    GuardedImage<Gradient16> slope(size), sobel(size);
    src.fill(random);
    ASSERT_EQ(run_convolve(src, {{1, 2, 1, 2, 4, 2, 1, 2, 1}, {3, 3}, 16}, Border::reflect_101, mean),
              Status::ok);
    run_filter(gaussian_3x3, gaussian_3x3_scratch(size), src, Border::reflect_101, other);
    EXPECT_TRUE(equal(mean.view(), other.view()));
    ASSERT_EQ(run_convolve(src, {{-1, 0, 1, -2, 0, 2, -1, 0, 1}}, Border::replicate, slope), Status::ok);
    run_filter(sobel_x, derivative_scratch(size), src, Border::replicate, sobel);
    EXPECT_TRUE(equal(slope.view(), sobel.view()));
}

TEST(Convolve, OfBytesHoldsAt255WhereTheToolkitWrapped) {
    GuardedImage<Gray8> src({9, 5}), dst({9, 5});
    src.fill(Gray8{200});
    ASSERT_EQ(run_convolve(src, {{0, 0, 0, 0, 2, 0, 0, 0, 0}}, Border::replicate, dst), Status::ok);
    EXPECT_EQ(dst(4, 2), 255);
    ASSERT_EQ(run_convolve(src, {{0, 0, 0, 0, -2, 0, 0, 0, 0}}, Border::replicate, dst), Status::ok);
    EXPECT_EQ(dst(4, 2), 0);
}

TEST(Convolve, RoundsToTheNearestWhereTheToolkitCut) {
    GuardedImage<Gray8> src({9, 5}), dst({9, 5});
    src.fill(Gray8{15});
    ASSERT_EQ(run_convolve(src, {{0, 0, 0, 0, 1, 0, 0, 0, 0}, {3, 3}, 8}, Border::replicate, dst),
              Status::ok);
    EXPECT_EQ(dst(4, 2), 2);
    ASSERT_EQ(run_convolve(src, {{0, 0, 0, 0, 1, 0, 0, 0, 0}, {3, 3}, 10}, Border::replicate, dst),
              Status::ok);
    EXPECT_EQ(dst(4, 2), 2);
    GuardedImage<Gradient16> slope({9, 5});
    ASSERT_EQ(run_convolve(src, {{0, 0, 0, 0, -1, 0, 0, 0, 0}, {3, 3}, 10}, Border::replicate, slope),
              Status::ok);
    EXPECT_EQ(slope(4, 2), -1);
}

TEST(Convolve, FillsTheBorderWhereTheToolkitLeftZeros) {
    GuardedImage<Gray8> src({9, 5}), dst({9, 5});
    src.fill(Gray8{90});
    const std::vector<std::int16_t> ones(25, 1);
    ASSERT_EQ(run_convolve(src, {ones, {5, 5}, 25}, Border::replicate, dst), Status::ok);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) EXPECT_EQ(dst(x, y), 90);
}

TEST(Convolve, IsAStage) {
    Random random(94);
    const Size size{61, 17};
    GuardedImage<Gray8> src(size), dst(size), streamed(size);
    src.fill(random);
    const Weights w = random_weights(random, {5, 3}, 9, 11, 20);
    ASSERT_EQ(run_convolve(src, w, Border::zero, dst), Status::ok);
    auto program = stream(stages::convolve<Gray8>{w.kernel()}, into(streamed.view()));
    std::vector<std::uint8_t> scratch(20000);
    ASSERT_EQ(program.run(src.view(), Border::zero, {scratch.data(), 20000}), Status::ok);
    EXPECT_TRUE(equal(dst.view(), streamed.view()));
    EXPECT_FALSE((stages::convolve<Gray8>{{w.kernel().weights, {3, 3}}}.valid()));
}

TEST(Convolve, SaysWhatIsWrong) {
    std::vector<std::uint8_t> bytes(100000);
    const Span<std::uint8_t> scratch(bytes.data(), 100000);
    GuardedImage<Gray8> src({40, 8}), dst({40, 8}), small({39, 8});
    dst.fill(Gray8{3});
    const Weights good{{1, 2, 1, 2, 4, 2, 1, 2, 1}};
    const auto answer = [&](const Weights& w) {
        return convolve(src.view(), w.kernel(), Border::zero, scratch, dst.view());
    };
    EXPECT_EQ(convolve({}, good.kernel(), Border::zero, scratch, dst.view()), Status::empty_image);
    EXPECT_EQ(convolve(src.view(), good.kernel(), Border::zero, scratch, small.view()),
              Status::size_mismatch);
    for (const Size size :
         {Size{0, 3}, Size{3, 0}, Size{-3, -3}, Size{2, 3}, Size{3, 4}, Size{17, 3}, Size{5, 3}}) {
        Weights wrong = good;
        wrong.size = size;
        EXPECT_EQ(answer(wrong), Status::bad_argument) << size.width << "x" << size.height;
    }
    for (const int divisor : {0, -1, 65536}) {
        Weights wrong = good;
        wrong.divisor = divisor;
        EXPECT_EQ(answer(wrong), Status::bad_argument);
    }
    for (const int offset : {-256, 256}) {
        Weights wrong = good;
        wrong.offset = offset;
        EXPECT_EQ(answer(wrong), Status::bad_argument);
    }
    EXPECT_EQ(convolve_scratch({40, 8}, {2, 3}), 0);
    EXPECT_EQ(convolve(src.view(), good.kernel(), Border::zero,
                       scratch.first(static_cast<std::ptrdiff_t>(convolve_scratch({40, 8}, {3, 3}) - 1)),
                       dst.view()),
              Status::scratch_too_small);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 40; ++x) EXPECT_EQ(dst(x, y), 3);
}

}  // namespace
}  // namespace fovea::test
