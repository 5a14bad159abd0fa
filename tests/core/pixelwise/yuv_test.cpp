// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/yuv.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

constexpr YuvRange ranges[] = {YuvRange::full, YuvRange::narrow};

TEST(RgbOfYuv, KeepsBlackWhiteAndGray) {
    EXPECT_EQ(rgb_of(0, 128, 128, YuvRange::full), (Rgb888{0, 0, 0}));
    EXPECT_EQ(rgb_of(100, 128, 128, YuvRange::full), (Rgb888{100, 100, 100}));
    EXPECT_EQ(rgb_of(255, 128, 128, YuvRange::full), (Rgb888{255, 255, 255}));
    EXPECT_EQ(rgb_of(16, 128, 128, YuvRange::narrow), (Rgb888{0, 0, 0}));
    EXPECT_EQ(rgb_of(235, 128, 128, YuvRange::narrow), (Rgb888{255, 255, 255}));
    // 298 * 110 / 256 = 128.05
    EXPECT_EQ(rgb_of(126, 128, 128, YuvRange::narrow), (Rgb888{128, 128, 128}));
}

TEST(RgbOfYuv, GivesThePureColoursThatTheStandardCodes) {
    // BT.601 narrow: red 81 90 240, green 145 54 34, blue 41 240 110.
    const auto near_to = [](Rgb888 colour, int red, int green, int blue) {
        EXPECT_NEAR(colour.red, red, 1);
        EXPECT_NEAR(colour.green, green, 1);
        EXPECT_NEAR(colour.blue, blue, 1);
    };
    near_to(rgb_of(81, 90, 240, YuvRange::narrow), 255, 0, 0);
    near_to(rgb_of(145, 54, 34, YuvRange::narrow), 0, 255, 0);
    near_to(rgb_of(41, 240, 110, YuvRange::narrow), 0, 0, 255);
    near_to(rgb_of(76, 85, 255, YuvRange::full), 254, 0, 0);
}

TEST(RgbOfYuv, IsWithinOneLevelOfTheRealFactors) {
    double worst = 0;
    for (int luma = 0; luma < 256; luma += 3)
        for (int u = 0; u < 256; u += 5)
            for (int v = 0; v < 256; v += 5)
                for (const YuvRange range : ranges) {
                    const bool full = range == YuvRange::full;
                    const double y = full ? luma : (luma - 16) * 255.0 / 219;
                    const double scale = full ? 1 : 255.0 / 224;
                    const double du = (u - 128) * scale;
                    const double dv = (v - 128) * scale;
                    const auto off = [&](std::uint8_t got, double real) {
                        worst = std::max(worst, std::abs(got - std::clamp(real, 0.0, 255.0)));
                    };
                    const Rgb888 colour =
                        rgb_of(static_cast<std::uint8_t>(luma), static_cast<std::uint8_t>(u),
                               static_cast<std::uint8_t>(v), range);
                    off(colour.red, y + 1.402 * dv);
                    off(colour.green, y - 0.344136 * du - 0.714136 * dv);
                    off(colour.blue, y + 1.772 * du);
                }
    // A half for the rounding, and each of at most two factors off by half of 1/256 over 128, luma's by 0.08
    // over its whole range.
    EXPECT_LT(worst, 1.0);
}

TEST(YuvToRgb, TakesEveryPixelOfEverySize) {
    Random random(321);
    for (const int padding : {0, 3})
        for (const YuvRange range : ranges)
            for (const Size size : test_sizes()) {
                GuardedImage<Yuyv> yuyv(size, padding);
                GuardedImage<Uyvy> uyvy(size, padding);
                GuardedImage<Gray8> luma(size, padding), gray(size, padding);
                GuardedImage<ChromaPair> chroma(chroma_size(size), padding);
                GuardedImage<Rgb888> dst(size, padding);
                yuyv.fill(random);
                uyvy.fill(random);
                luma.fill(random);
                chroma.fill(random);
                const auto check = [&](const auto& src) {
                    for (int y = 0; y < size.height; ++y)
                        for (int x = 0; x < size.width; ++x) {
                            const int even = x & ~1;
                            const bool alone = even + 1 == size.width;
                            const std::uint8_t v = !alone     ? src(even + 1, y).chroma
                                                   : even > 0 ? src(even - 1, y).chroma
                                                              : std::uint8_t{128};
                            ASSERT_EQ(dst(x, y), rgb_of(src(x, y).luma, src(even, y).chroma, v, range));
                            ASSERT_EQ(gray(x, y), rgb_of(src(x, y).luma, 128, 128, range).green);
                        }
                };
                ASSERT_EQ(to_rgb(yuyv.view(), range, dst.view()), Status::ok);
                ASSERT_EQ(to_gray(yuyv.view(), range, gray.view()), Status::ok);
                check(yuyv);
                ASSERT_EQ(to_rgb(uyvy.view(), range, dst.view()), Status::ok);
                ASSERT_EQ(to_gray(uyvy.view(), range, gray.view()), Status::ok);
                check(uyvy);
                ASSERT_EQ(to_rgb(luma.view(), chroma.view(), range, dst.view()), Status::ok);
                ASSERT_EQ(to_gray(luma.view(), range, gray.view()), Status::ok);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x) {
                        const ChromaPair c = chroma(x / 2, y / 2);
                        ASSERT_EQ(dst(x, y), rgb_of(luma(x, y), c.u, c.v, range));
                        ASSERT_EQ(gray(x, y), rgb_of(luma(x, y), 128, 128, range).green);
                    }
            }
}

TEST(YuvToRgb, IsRightForEveryColour) {
    // All lumas and u in one image, one v after the other.
    GuardedImage<Gray8> luma({256, 512});
    GuardedImage<ChromaPair> chroma({128, 256});
    GuardedImage<Rgb888> dst({256, 512});
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 256; ++x) luma(x, y) = static_cast<Gray8>(x);
    for (const YuvRange range : ranges)
        for (int v = 0; v < 256; v += v % 32 == 30 ? 1 : 5) {
            for (int y = 0; y < 256; ++y)
                for (int x = 0; x < 128; ++x)
                    chroma(x, y) = {static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(v)};
            ASSERT_EQ(to_rgb(luma.view(), chroma.view(), range, dst.view()), Status::ok);
            for (int y = 0; y < 512; y += 2)
                for (int x = 0; x < 256; ++x)
                    ASSERT_EQ(dst(x, y),
                              rgb_of(static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y / 2),
                                     static_cast<std::uint8_t>(v), range))
                        << x << " " << y / 2 << " " << v;
        }
}

TEST(YuvToRgb, SaysWhatIsWrongOfNv12AndLeavesTheOutput) {
    GuardedImage<Gray8> luma({5, 4});
    GuardedImage<ChromaPair> chroma({3, 2}), narrow({2, 2}), low({3, 1});
    GuardedImage<Rgb888> dst({5, 4}), other({4, 4});
    luma.fill(Gray8{1});
    chroma.fill(ChromaPair{1, 2});
    dst.fill(Rgb888{7, 7, 7});
    const auto full = YuvRange::full;
    EXPECT_EQ(to_rgb(ImageView<const Gray8>(), chroma.view(), full, dst.view()), Status::empty_image);
    EXPECT_EQ(to_rgb(luma.view(), ImageView<const ChromaPair>(), full, dst.view()), Status::size_mismatch);
    EXPECT_EQ(to_rgb(luma.view(), narrow.view(), full, dst.view()), Status::size_mismatch);
    EXPECT_EQ(to_rgb(luma.view(), low.view(), full, dst.view()), Status::size_mismatch);
    EXPECT_EQ(to_rgb(luma.view(), chroma.view(), full, other.view()), Status::size_mismatch);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x) EXPECT_EQ(dst(x, y), (Rgb888{7, 7, 7}));
}

}  // namespace
}  // namespace fovea::test
