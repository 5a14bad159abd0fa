// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/warp/area.hpp>
#include <fovea/warp/pyramid.hpp>
#include <fovea/warp/resize.hpp>
#include <support/guarded_image.hpp>
#include <support/naive_reference.hpp>

#include "warp_reference.hpp"

namespace fovea::test {
namespace {

using Resize = Status (*)(ImageView<const Gray8>, Span<std::uint8_t>, ImageView<Gray8>);

/// Runs with exactly the scratch that is asked for.
void run(Resize resize, std::int64_t scratch_bytes, GuardedImage<Gray8>& src, GuardedImage<Gray8>& dst) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(scratch_bytes), 0xee);
    ASSERT_EQ(resize(src.view(), {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, dst.view()),
              Status::ok);
}
void nearest(GuardedImage<Gray8>& src, GuardedImage<Gray8>& dst) {
    run(resize_nearest<Gray8>, resize_nearest_scratch(src.view().size(), dst.view().size()), src, dst);
}
void bilinear(GuardedImage<Gray8>& src, GuardedImage<Gray8>& dst) {
    run(resize_bilinear, resize_bilinear_scratch(src.view().size(), dst.view().size()), src, dst);
}
void bicubic(GuardedImage<Gray8>& src, GuardedImage<Gray8>& dst) {
    run(resize_bicubic, resize_bicubic_scratch(src.view().size(), dst.view().size()), src, dst);
}
void by_area(GuardedImage<Gray8>& src, GuardedImage<Gray8>& dst) {
    run(resize_area, resize_area_scratch(src.view().size(), dst.view().size()), src, dst);
}
void down(GuardedImage<Gray8>& src, GuardedImage<Gray8>& dst) {
    run(pyramid_down, pyramid_down_scratch(src.view().size()), src, dst);
}
void up(GuardedImage<Gray8>& src, GuardedImage<Gray8>& dst) {
    run(pyramid_up, pyramid_up_scratch(src.view().size()), src, dst);
}

const std::vector<Size>& output_sizes() {
    static const std::vector<Size> sizes = {{1, 1},  {3, 2},  {17, 9},  {63, 4},
                                            {64, 5}, {65, 3}, {128, 2}, {211, 7}};
    return sizes;
}
double centre(int x, int from, int to) { return (x + 0.5) * from / to - 0.5; }

TEST(ResizeNearest, TakesThePixelUnderTheCentre) {
    Random random(81);
    for (const Size size : test_sizes())
        for (const Size out : output_sizes()) {
            GuardedImage<Gray8> src(size), dst(out);
            src.fill(random);
            nearest(src, dst);
            for (int y = 0; y < out.height; ++y)
                for (int x = 0; x < out.width; ++x)
                    ASSERT_EQ(dst(x, y), src((2 * x + 1) * size.width / (2 * out.width),
                                             (2 * y + 1) * size.height / (2 * out.height)));
        }
}

TEST(ResizeBilinear, PutsPixelCentresOnAHalf) {
    GuardedImage<Gray8> src({2, 1}), dst({4, 1});
    src(0, 0) = 0;
    src(1, 0) = 100;
    bilinear(src, dst);
    EXPECT_EQ(dst(0, 0), 0);
    EXPECT_EQ(dst(1, 0), 25);
    EXPECT_EQ(dst(2, 0), 75);
    EXPECT_EQ(dst(3, 0), 100);
}

TEST(ResizeBilinear, EqualsTheReferenceOnEverySize) {
    Random random(82);
    for (const Size size : test_sizes())
        for (const Size out : output_sizes()) {
            GuardedImage<Gray8> src(size), dst(out);
            src.fill(random);
            bilinear(src, dst);
            const auto place = [](int x, int from, int to) {
                // The numerator is whole, so that a half of 1/256 px is exact.
                return std::floor(((2.0 * x + 1) * from - to) * 128 / to + 0.5) / 256;
            };
            for (int y = 0; y < out.height; ++y)
                for (int x = 0; x < out.width; ++x) {
                    const Place p{place(x, size.width, out.width), place(y, size.height, out.height)};
                    ASSERT_EQ(dst(x, y), std::floor(real_bilinear(src.view(), p) + 0.5))
                        << size.width << "x" << size.height << " to " << out.width << "x" << out.height;
                    // The place is off by 1/512 px in each direction.
                    const Place exact{centre(x, size.width, out.width), centre(y, size.height, out.height)};
                    ASSERT_LE(std::abs(dst(x, y) - real_bilinear(src.view(), exact)), 0.5 + 255.0 / 256);
                }
        }
}

TEST(ResizeBilinear, ToHalfOfBothSidesIsTheMeanOfFour) {
    Random random(83);
    for (const Size out : {Size{1, 1}, Size{7, 3}, Size{16, 2}, Size{33, 5}, Size{100, 1}}) {
        GuardedImage<Gray8> src({2 * out.width, 2 * out.height}), dst(out);
        src.fill(random);
        bilinear(src, dst);
        for (int y = 0; y < out.height; ++y)
            for (int x = 0; x < out.width; ++x)
                ASSERT_EQ(dst(x, y), (src(2 * x, 2 * y) + src(2 * x + 1, 2 * y) + src(2 * x, 2 * y + 1) +
                                      src(2 * x + 1, 2 * y + 1) + 2) /
                                         4);
    }
}

double cubic_weight(double distance) {
    const double d = std::abs(distance);
    if (d < 1) return 1.5 * d * d * d - 2.5 * d * d + 1;
    return d < 2 ? -0.5 * d * d * d + 2.5 * d * d - 4 * d + 2 : 0;
}

TEST(ResizeBicubic, IsWithinItsBoundOfTheRealValue) {
    // Places to 1/8192 px, weights to 2^-12 of 255 at most: over four taps less than 0.4 level in each
    // direction; 1.25 / 128 of the sums in between, and a half.
    Random random(83);
    for (const Size size : test_sizes())
        for (const Size out : output_sizes()) {
            GuardedImage<Gray8> src(size), dst(out);
            src.fill(random);
            bicubic(src, dst);
            for (int y = 0; y < out.height; ++y)
                for (int x = 0; x < out.width; ++x) {
                    const Place p{centre(x, size.width, out.width), centre(y, size.height, out.height)};
                    double sum = 0;
                    for (int v = -1; v <= 2; ++v)
                        for (int u = -1; u <= 2; ++u) {
                            const int column = static_cast<int>(std::floor(p.x)) + u;
                            const int row = static_cast<int>(std::floor(p.y)) + v;
                            sum += cubic_weight(p.x - column) * cubic_weight(p.y - row) *
                                   replicated(src.view(), column, row);
                        }
                    ASSERT_NEAR(dst(x, y), std::clamp(sum, 0.0, 255.0), 1.3)
                        << size.width << "x" << size.height << " to " << out.width << "x" << out.height;
                }
        }
}

TEST(Resize, KeepsAnEvenImageAndItsOwnSize) {
    Random random(84);
    const Size size{97, 40};
    GuardedImage<Gray8> src(size), same(size), even({50, 70}), flat(size);
    src.fill(random);
    flat.fill(Gray8{255});
    for (const auto resize : {nearest, bilinear, bicubic, by_area}) {
        resize(src, same);
        EXPECT_TRUE(equal(src.view(), same.view()));
        resize(flat, even);
        for (int y = 0; y < 70; ++y)
            for (int x = 0; x < 50; ++x) ASSERT_EQ(even(x, y), 255);
    }
}

TEST(ResizeArea, EqualsTheExactMeanOnEverySize) {
    Random random(85);
    for (const Size size : test_sizes())
        for (const Size out :
             {Size{1, 1}, Size{2, 3}, Size{16, 3}, Size{32, 2}, Size{13, 4}, Size{320, 2}, Size{97, 11}}) {
            GuardedImage<Gray8> src(size), dst(out);
            src.fill(random);
            by_area(src, dst);
            for (int y = 0; y < out.height; ++y)
                for (int x = 0; x < out.width; ++x) {
                    // Parts of pixels in 1 / (out.width * out.height) of a pixel: whole numbers.
                    const auto part = [](int i, int from, int x_out, int to) {
                        return std::max(
                            0, std::min((i + 1) * to, (x_out + 1) * from) - std::max(i * to, x_out * from));
                    };
                    std::int64_t sum = 0;
                    for (int v = 0; v < size.height; ++v)
                        for (int u = 0; u < size.width; ++u)
                            sum += std::int64_t{src(u, v)} * part(u, size.width, x, out.width) *
                                   part(v, size.height, y, out.height);
                    const std::int64_t count = size.area();
                    ASSERT_EQ(dst(x, y), (2 * sum + count) / (2 * count))
                        << size.width << "x" << size.height << " to " << out.width << "x" << out.height;
                }
        }
}

TEST(ResizeArea, SumsTheLargestImageOfWhitePixels) {
    GuardedImage<Gray8> src({max_image_side, 300}), one({1, 1}), cut({2, 7});
    src.fill(Gray8{255});
    by_area(src, one);
    EXPECT_EQ(one(0, 0), 255);
    by_area(src, cut);
    EXPECT_EQ(cut(1, 6), 255);
}

// Defect 17 of the IVT: a reduction by a whole factor took every second pixel and left out the others, with
// interpolation too: a ramp 0 4 8 .. gave 0 8 16 24.
TEST(Resize, CountsEveryPixelOfAReductionByAWholeFactor) {
    GuardedImage<Gray8> ramp({8, 2}), half({4, 1});
    for (int x = 0; x < 8; ++x) ramp(x, 0) = ramp(x, 1) = static_cast<Gray8>(4 * x);
    for (const auto resize : {by_area, bilinear}) {
        resize(ramp, half);
        for (int x = 0; x < 4; ++x) EXPECT_EQ(half(x, 0), 8 * x + 2);
    }
    // Stripes as fine as pixels become even grey and no coarser stripes.
    GuardedImage<Gray8> stripes({96, 32}), third({32, 8}), pyramid({48, 16});
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 96; ++x) stripes(x, y) = x % 2 == 0 ? 200 : 0;
    by_area(stripes, third);
    for (int x = 0; x < 32; ++x) EXPECT_NEAR(third(x, 3), 100, 34);
    down(stripes, pyramid);
    for (int x = 2; x < 46; ++x) EXPECT_EQ(pyramid(x, 5), 100);
}

// Defect 17: at equal sizes it ignored the region, and it read outside the region when it interpolated.
TEST(Resize, StaysInTheRegionThatItIsGiven) {
    GuardedImage<Gray8> src({60, 40}), dst({20, 15}), larger({31, 22});
    src.fill(Gray8{255});
    const ImageView<Gray8> region = src.view().crop({20, 10, 20, 15}).value();
    for (int y = 0; y < 15; ++y)
        for (int x = 0; x < 20; ++x) region(x, y) = 100;
    std::vector<std::uint8_t> scratch(4096);
    const Span<std::uint8_t> span(scratch.data(), 4096);
    for (const Resize resize : {Resize(resize_nearest<Gray8>), Resize(resize_bilinear),
                                Resize(resize_bicubic), Resize(resize_area)}) {
        ASSERT_EQ(resize(region, span, dst.view()), Status::ok);
        EXPECT_TRUE(equal(region, dst.view()));
        ASSERT_EQ(resize(region, span, larger.view()), Status::ok);
        for (int y = 0; y < 22; ++y)
            for (int x = 0; x < 31; ++x) ASSERT_EQ(larger(x, y), 100);
    }
}

TEST(Resize, SaysWhatIsWrongAndLeavesTheOutput) {
    GuardedImage<Gray8> src({40, 30}), dst({20, 15});
    dst.fill(Gray8{7});
    std::vector<std::uint8_t> scratch(4096);
    const Size from{40, 30};
    const Size to{20, 15};
    const std::pair<Resize, std::int64_t> all[] = {{resize_nearest<Gray8>, resize_nearest_scratch(from, to)},
                                                   {resize_bilinear, resize_bilinear_scratch(from, to)},
                                                   {resize_bicubic, resize_bicubic_scratch(from, to)},
                                                   {resize_area, resize_area_scratch(from, to)}};
    for (const auto& [resize, bytes] : all) {
        const Span<std::uint8_t> little(scratch.data(), static_cast<std::ptrdiff_t>(bytes) - 1);
        EXPECT_EQ(resize(src.view(), little, dst.view()), Status::scratch_too_small);
        EXPECT_EQ(resize(src.view(), little, ImageView<Gray8>()), Status::empty_image);
        EXPECT_EQ(resize({src.view().first(), {40000, 1}, 40000}, little, dst.view()),
                  Status::image_too_large);
    }
    EXPECT_EQ(dst(0, 0), 7);
}

TEST(PyramidDown, WeighsASpikeByTheBinomial) {
    GuardedImage<Gray8> src({8, 8}), dst({4, 4});
    src.fill(Gray8{0});
    src(4, 4) = 255;
    down(src, dst);
    EXPECT_EQ(dst(2, 2), (255 * 36 + 128) / 256);
    EXPECT_EQ(dst(1, 2), (255 * 6 + 128) / 256);
    EXPECT_EQ(dst(3, 3), (255 + 128) / 256);
    EXPECT_EQ(dst(0, 2), 0);
}

TEST(PyramidDown, EqualsTheReferenceOnEverySize) {
    Random random(86);
    const int weights[5] = {1, 4, 6, 4, 1};
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), dst(pyramid_down_size(size));
        src.fill(random);
        down(src, dst);
        for (int y = 0; y < dst.view().height(); ++y)
            for (int x = 0; x < dst.view().width(); ++x) {
                int sum = 128;
                for (int v = 0; v < 5; ++v)
                    for (int u = 0; u < 5; ++u)
                        sum += weights[u] * weights[v] * replicated(src.view(), 2 * x + u - 2, 2 * y + v - 2);
                ASSERT_EQ(dst(x, y), sum >> 8) << size.width << "x" << size.height << " at " << x << "," << y;
            }
    }
}

TEST(PyramidUp, EqualsTheReferenceOnEverySize) {
    Random random(87);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), dst({2 * size.width, 2 * size.height});
        src.fill(random);
        up(src, dst);
        const int on[3] = {1, 6, 1};
        const int between[3] = {0, 4, 4};
        for (int y = 0; y < 2 * size.height; ++y)
            for (int x = 0; x < 2 * size.width; ++x) {
                int sum = 32;
                for (int v = 0; v < 3; ++v)
                    for (int u = 0; u < 3; ++u)
                        sum += (x % 2 == 0 ? on : between)[u] * (y % 2 == 0 ? on : between)[v] *
                               replicated(src.view(), x / 2 + u - 1, y / 2 + v - 1);
                ASSERT_EQ(dst(x, y), sum >> 6) << size.width << "x" << size.height << " at " << x << "," << y;
            }
    }
}

TEST(Pyramid, KeepsBlackAndWhite) {
    const Size size{70, 9};
    for (const int level : {0, 255}) {
        GuardedImage<Gray8> src(size), half(pyramid_down_size(size)), twice({140, 18});
        src.fill(static_cast<Gray8>(level));
        down(src, half);
        up(src, twice);
        EXPECT_EQ(half(0, 0), level);
        EXPECT_EQ(half(34, 4), level);
        EXPECT_EQ(twice(139, 17), level);
    }
}

TEST(Pyramid, SaysWhatIsWrong) {
    GuardedImage<Gray8> src({9, 9}), dst({4, 5});
    std::vector<std::uint8_t> scratch(4096);
    const Span<std::uint8_t> span(scratch.data(), 4096);
    EXPECT_EQ(pyramid_down(src.view(), span, dst.view()), Status::size_mismatch);
    EXPECT_EQ(pyramid_up(src.view(), span, dst.view()), Status::size_mismatch);
    EXPECT_EQ(
        pyramid_up({src.view().first(), {16384, 1}, 16384}, span, {dst.view().first(), {32768, 2}, 32768}),
        Status::image_too_large);
}

}  // namespace
}  // namespace fovea::test
