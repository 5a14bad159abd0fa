// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <vector>

#include <core/filter/filter_check.hpp>
#include <fovea/filter/difference_of_gaussians.hpp>
#include <fovea/stream/stream.hpp>

namespace fovea::test {
namespace {

constexpr SubPixel px(int hundredths) { return SubPixel::from_ratio(hundredths, 100); }

auto difference_of(SubPixel fine, SubPixel coarse) {
    return [=](ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
        return difference_of_gaussians(src, fine, coarse, border, scratch, dst);
    };
}

TEST(DifferenceOfGaussians, OfASpikeIsWhatTheGaussianTookFromIt) {
    const Size size{9, 9};
    GuardedImage<Gray8> src(size), dst(size);
    src.fill(Gray8{0});
    src(4, 4) = 200;
    run_filter(difference_of({}, px(100)), difference_of_gaussians_scratch(size), src, Border::replicate,
               dst);
    // The middle tap of sigma 1 is 0.399: 200 - 200 * 0.399^2 = 168; beside it 200 * 0.399 * 0.242 = 19.
    EXPECT_EQ(dst(4, 4), 168);
    EXPECT_EQ(dst(5, 4), 19);
    EXPECT_EQ(dst(0, 0), 0);
}

TEST(DifferenceOfGaussians, IsTheDifferenceOfTheTwoFiltersOnEverySizeAndBorder) {
    Random random(121);
    const SubPixel pairs[][2] = {{px(0), px(30)}, {px(0), px(212)}, {px(100), px(160)}, {px(30), px(1000)}};
    for (const Size size : test_sizes())
        for (const Border border : all_borders)
            for (const auto& pair : pairs) {
                GuardedImage<Gray8> src(size), dst(size), fine(size), coarse(size);
                src.fill(random);
                run_filter(difference_of(pair[0], pair[1]), difference_of_gaussians_scratch(size), src,
                           border, dst);
                const auto smoothed = [&](SubPixel sigma, GuardedImage<Gray8>& to) {
                    run_filter([=](ImageView<const Gray8> from, Border b, Span<std::uint8_t> scratch,
                                   ImageView<Gray8> out) { return gaussian(from, sigma, b, scratch, out); },
                               gaussian_scratch(size), src, border, to);
                };
                smoothed(pair[1], coarse);
                if (pair[0] != SubPixel()) smoothed(pair[0], fine);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x) {
                        const int from = pair[0] == SubPixel() ? src(x, y) : fine(x, y);
                        ASSERT_EQ(dst(x, y), std::abs(from - coarse(x, y))) << x << "," << y;
                    }
            }
}

TEST(DifferenceOfGaussians, DoesNotChangeWithTheLevelOfTheGround) {
    const Size size{50, 20};
    GuardedImage<Gray8> dark(size), bright(size), dst(size), other(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            dark(x, y) = static_cast<Gray8>((x * 7 + y * 13) % 50);
            bright(x, y) = static_cast<Gray8>(dark(x, y) + 150);
        }
    const auto filter = difference_of(px(50), px(300));
    run_filter(filter, difference_of_gaussians_scratch(size), dark, Border::replicate, dst);
    run_filter(filter, difference_of_gaussians_scratch(size), bright, Border::replicate, other);
    // Rounding of either Gaussian may differ by one.
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) ASSERT_LE(std::abs(dst(x, y) - other(x, y)), 2);
}

TEST(DifferenceOfGaussians, IsAStage) {
    Random random(122);
    const Size size{61, 17};
    GuardedImage<Gray8> src(size), dst(size), streamed(size);
    src.fill(random);
    run_filter(difference_of(px(80), px(200)), difference_of_gaussians_scratch(size), src, Border::zero, dst);
    auto program = stream(stages::difference_of_gaussians{*gaussian_taps(px(80)), *gaussian_taps(px(200))},
                          into(streamed.view()));
    std::vector<std::uint8_t> scratch(20000);
    ASSERT_EQ(program.run(src.view(), Border::zero, {scratch.data(), 20000}), Status::ok);
    EXPECT_TRUE(equal(dst.view(), streamed.view()));
    EXPECT_FALSE((stages::difference_of_gaussians{*gaussian_taps(px(200)), *gaussian_taps(px(80))}.valid()));
}

TEST(DifferenceOfGaussians, SaysWhatIsWrong) {
    std::vector<std::uint8_t> bytes(10000);
    const auto needed = static_cast<std::ptrdiff_t>(difference_of_gaussians_scratch({40, 8}));
    const Span<std::uint8_t> scratch(bytes.data(), needed);
    GuardedImage<Gray8> src({40, 8}), dst({40, 8}), small({39, 8});
    dst.fill(Gray8{3});
    const auto answer = [&](SubPixel fine, SubPixel coarse) {
        return difference_of_gaussians(src.view(), fine, coarse, Border::zero, scratch, dst.view());
    };
    EXPECT_EQ(difference_of_gaussians({}, px(0), px(200), Border::zero, scratch, dst.view()),
              Status::empty_image);
    EXPECT_EQ(difference_of_gaussians(src.view(), px(0), px(200), Border::zero, scratch, small.view()),
              Status::size_mismatch);
    EXPECT_EQ(answer(px(200), px(200)), Status::bad_argument);
    EXPECT_EQ(answer(px(300), px(200)), Status::bad_argument);
    EXPECT_EQ(answer(px(20), px(200)), Status::bad_argument);
    EXPECT_EQ(answer(px(-100), px(200)), Status::bad_argument);
    EXPECT_EQ(answer(px(0), px(20)), Status::bad_argument);
    EXPECT_EQ(answer(px(0), px(1001)), Status::bad_argument);
    EXPECT_EQ(difference_of_gaussians(src.view(), px(0), px(200), Border::zero, scratch.first(needed - 1),
                                      dst.view()),
              Status::scratch_too_small);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 40; ++x) EXPECT_EQ(dst(x, y), 3);
}

}  // namespace
}  // namespace fovea::test
