// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/bilateral.hpp>
#include <fovea/stream/stream.hpp>

namespace fovea::test {
namespace {

BilateralOptions options_of(int radius, int hundredths, int sigma_range) {
    BilateralOptions options;
    options.radius = radius;
    options.sigma_space = SubPixel::from_ratio(hundredths, 100);
    options.sigma_range = sigma_range;
    return options;
}

Status run_bilateral(const GuardedImage<Gray8>& src, const BilateralOptions& options, Border border,
                     GuardedImage<Gray8>& dst) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(bilateral_scratch(src.view().size(), options)),
                                      0xee);
    return bilateral(src.view(), options, border,
                     {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, dst.view());
}

/// visit(difference from the middle, square of the distance) for the neighbours on the disc.
template <class Visit>
void for_each_neighbour(ImageView<const Gray8> src, Border border, int radius, int x, int y, Visit visit) {
    const std::vector<Gray8> pixels = naive_window(src, border, {2 * radius + 1, 2 * radius + 1}, x, y);
    const int middle = src(x, y);
    std::size_t at = 0;
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx, ++at)
            if (dx * dx + dy * dy <= radius * radius) visit(int{pixels[at]} - middle, dx * dx + dy * dy);
}

double real_mean(ImageView<const Gray8> src, const BilateralOptions& options, Border border, int x, int y) {
    const double space = options.sigma_space.raw() / 256.0;
    const double range = options.sigma_range;
    double weights = 0, moments = 0;
    for_each_neighbour(src, border, options.radius, x, y, [&](int step, int square) {
        const double weight = std::exp(-square / (2 * space * space) - step * step / (2 * range * range));
        weights += weight;
        moments += weight * step;
    });
    return src(x, y) + moments / weights;
}

/// The same in integers, as the header tells it.
int naive_mean(ImageView<const Gray8> src, const BilateralOptions& options, Border border, int x, int y) {
    const std::int64_t half_log = 96817625;
    const std::int64_t raw = options.sigma_space.raw();
    const std::int64_t range = std::int64_t{options.sigma_range} * options.sigma_range;
    const std::int64_t scale = (half_log + range / 2) / range;
    int raise = 0;
    while (scale >> raise > 65535) ++raise;
    std::int64_t weights = 0, moments = 0;
    for_each_neighbour(src, border, options.radius, x, y, [&](int step, int square) {
        const std::int64_t distance =
            std::min<std::int64_t>(65535, (square * half_log + raw * raw / 2) / (raw * raw));
        const std::int64_t raised = std::min<std::int64_t>(step * step, 65535 >> raise) << raise;
        const std::int64_t exponent =
            std::min<std::int64_t>(65535, (raised * (scale >> raise) >> 16) + distance);
        const std::int64_t part = exponent % 2048 * 32;
        const std::int64_t power = 32767 - (part * (simd::power_a - (part * simd::power_b >> 16)) >> 16);
        const std::int64_t weight = power >> (exponent / 2048);
        weights += weight;
        moments += weight * step;
    });
    const std::int64_t found = (std::abs(moments) + weights / 2) / weights;
    return static_cast<int>(src(x, y) + (moments < 0 ? -found : found));
}

/// Noise, an edge with noise, blocks.
void fill_kind(GuardedImage<Gray8>& src, int kind, Random& random) {
    src.fill(random);
    for (int y = 0; y < src.view().height(); ++y)
        for (int x = 0; x < src.view().width(); ++x) {
            if (kind == 1) src(x, y) = static_cast<Gray8>((x > y ? 180 : 60) + src(x, y) % 16);
            if (kind == 2) src(x, y) = static_cast<Gray8>((x / 4 + y / 3) * 37 + src(x, y) % 3);
            if (kind == 3) src(x, y) = (x + y) % 2 != 0 ? 255 : 0;
        }
}

TEST(Bilateral, OfThreePixelsWorkedByHand) {
    // One above and one below count exp(-1/2) = 0.6065 for the distance; their difference of 25 as much
    // again.
    GuardedImage<Gray8> src({1, 3}), dst({1, 3});
    src(0, 0) = 125;
    src(0, 1) = 100;
    src(0, 2) = 100;
    ASSERT_EQ(run_bilateral(src, options_of(1, 100, 25), Border::replicate, dst), Status::ok);
    // (25 * 0.3679) / (1 + 3 * 0.6065 + 0.3679) = 2.89
    EXPECT_EQ(dst(0, 1), 103);
}

TEST(Bilateral, EqualsTheReferenceOnEverySizeAndBorder) {
    Random random(111);
    for (const Size size : test_sizes())
        for (const Border border : all_borders)
            for (const auto& options :
                 {options_of(1, 100, 10), options_of(2, 200, 25), options_of(4, 300, 75),
                  options_of(7, 1000, 255), options_of(3, 30, 1)}) {
                if (options.radius > 3 && size.area() > 700) continue;
                GuardedImage<Gray8> src(size), dst(size);
                fill_kind(src, static_cast<int>(random.below(4)), random);
                ASSERT_EQ(run_bilateral(src, options, border, dst), Status::ok);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        ASSERT_EQ(int{dst(x, y)}, naive_mean(src.view(), options, border, x, y))
                            << size.width << "x" << size.height << " radius " << options.radius << " at " << x
                            << "," << y;
            }
}

TEST(Bilateral, IsWithinAFifthOfALevelOfRealNumbers) {
    Random random(112);
    const Size size{64, 40};
    double worst = 0;
    for (const int kind : {0, 1, 2, 3})
        for (const int radius : {1, 2, 4, 7})
            for (const int range : {1, 5, 10, 25, 38, 39, 75, 255}) {
                const BilateralOptions options = options_of(radius, radius * 70, range);
                GuardedImage<Gray8> src(size), dst(size);
                fill_kind(src, kind, random);
                ASSERT_EQ(run_bilateral(src, options, Border::replicate, dst), Status::ok);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        worst = std::max(worst, std::abs(dst(x, y) - real_mean(src.view(), options,
                                                                               Border::replicate, x, y)));
            }
    // Half a level of it is the rounding.
    EXPECT_LT(worst, 0.7);
}

TEST(Bilateral, IsWithinOneLevelOfRealNumbersForALonelyPixel) {
    // All neighbours differ alike from the middle: what small weights lose does not cancel.
    const Size size{15, 15};
    double worst = 0;
    for (const int radius : {1, 2, 4, 7})
        for (const int range : {2, 10, 25, 40, 60, 75, 120})
            for (int step = 1; step <= 255; ++step) {
                const BilateralOptions options = options_of(radius, 1000, range);
                GuardedImage<Gray8> src(size), dst(size);
                src.fill(Gray8{0});
                src(7, 7) = static_cast<Gray8>(step);
                ASSERT_EQ(run_bilateral(src, options, Border::replicate, dst), Status::ok);
                worst = std::max(
                    worst, std::abs(dst(7, 7) - real_mean(src.view(), options, Border::replicate, 7, 7)));
            }
    EXPECT_LT(worst, 1.05);
}

TEST(Bilateral, KeepsAStepThatIsHighForItsRangeAndSmoothsWhatIsLow) {
    const Size size{40, 9};
    GuardedImage<Gray8> src(size), dst(size);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 40; ++x) src(x, y) = static_cast<Gray8>((x < 20 ? 50 : 200) + (x + y) % 2);
    ASSERT_EQ(run_bilateral(src, options_of(2, 200, 20), Border::replicate, dst), Status::ok);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 40; ++x) {
            EXPECT_GE(dst(x, y), x < 20 ? 50 : 200);
            EXPECT_LE(dst(x, y), x < 20 ? 51 : 201);
        }
}

TEST(Bilateral, OfAnInvertedImageIsTheInvertedMean) {
    Random random(113);
    const Size size{70, 9};
    GuardedImage<Gray8> src(size), inverse(size), dst(size), other(size), flat(size);
    src.fill(random);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 70; ++x) inverse(x, y) = static_cast<Gray8>(255 - src(x, y));
    ASSERT_EQ(run_bilateral(src, options_of(3, 250, 60), Border::reflect_101, dst), Status::ok);
    ASSERT_EQ(run_bilateral(inverse, options_of(3, 250, 60), Border::reflect_101, other), Status::ok);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 70; ++x) ASSERT_EQ(dst(x, y), 255 - other(x, y));
    flat.fill(Gray8{201});
    ASSERT_EQ(run_bilateral(flat, options_of(7, 1000, 255), Border::replicate, dst), Status::ok);
    EXPECT_TRUE(equal(dst.view(), flat.view()));
}

TEST(Bilateral, IsAStage) {
    Random random(114);
    const Size size{61, 17};
    GuardedImage<Gray8> src(size), dst(size), streamed(size);
    src.fill(random);
    ASSERT_EQ(run_bilateral(src, options_of(2, 100, 50), Border::zero, dst), Status::ok);
    auto program = stream(stages::bilateral{options_of(2, 100, 50)}, into(streamed.view()));
    std::vector<std::uint8_t> scratch(20000);
    ASSERT_EQ(program.run(src.view(), Border::zero, {scratch.data(), 20000}), Status::ok);
    EXPECT_TRUE(equal(dst.view(), streamed.view()));
    EXPECT_FALSE((stages::bilateral{options_of(8, 100, 50)}.valid()));
}

TEST(Bilateral, SaysWhatIsWrong) {
    std::vector<std::uint8_t> bytes(100000);
    const Span<std::uint8_t> scratch(bytes.data(), 100000);
    GuardedImage<Gray8> src({40, 8}), dst({40, 8}), small({39, 8});
    dst.fill(Gray8{3});
    EXPECT_EQ(bilateral({}, {}, Border::zero, scratch, dst.view()), Status::empty_image);
    EXPECT_EQ(bilateral(src.view(), {}, Border::zero, scratch, small.view()), Status::size_mismatch);
    for (const auto& wrong :
         {options_of(0, 200, 25), options_of(-1, 200, 25), options_of(8, 200, 25), options_of(2, 29, 25),
          options_of(2, 1001, 25), options_of(2, 200, 0), options_of(2, 200, 256)}) {
        EXPECT_EQ(bilateral(src.view(), wrong, Border::zero, scratch, dst.view()), Status::bad_argument);
        EXPECT_EQ(bilateral_scratch({40, 8}, wrong), 0);
    }
    const auto needed = static_cast<std::ptrdiff_t>(bilateral_scratch({40, 8}, {}));
    EXPECT_EQ(bilateral(src.view(), {}, Border::zero, scratch.first(needed - 1), dst.view()),
              Status::scratch_too_small);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 40; ++x) EXPECT_EQ(dst(x, y), 3);
}

}  // namespace
}  // namespace fovea::test
