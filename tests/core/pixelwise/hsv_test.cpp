// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/hsv.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

Rgb888 rgb(int red, int green, int blue) {
    return {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
            static_cast<std::uint8_t>(blue)};
}

/// a / b to the nearest, ties up, with nothing but a division.
int nearest(int a, int b) {
    const int twice = 2 * a + b;
    return twice >= 0 ? twice / (2 * b) : -((-twice + 2 * b - 1) / (2 * b));
}

Hsv888 plain_hsv(Rgb888 c) {
    const int value = std::max({c.red, c.green, c.blue});
    const int range = value - std::min({c.red, c.green, c.blue});
    int hue = 0;
    if (range != 0) {
        if (c.red == value)
            hue = nearest(30 * (c.green - c.blue), range);
        else if (c.green == value)
            hue = 60 + nearest(30 * (c.blue - c.red), range);
        else
            hue = 120 + nearest(30 * (c.red - c.green), range);
    }
    const int saturation = value == 0 ? 0 : nearest(255 * range, value);
    return {static_cast<std::uint8_t>((hue + 180) % 180), static_cast<std::uint8_t>(saturation),
            static_cast<std::uint8_t>(value)};
}

TEST(HsvOf, GivesTheSixPureColoursTheirPlacesOnTheCircle) {
    EXPECT_EQ(hsv_of(rgb(255, 0, 0)), (Hsv888{0, 255, 255}));
    EXPECT_EQ(hsv_of(rgb(255, 255, 0)), (Hsv888{30, 255, 255}));
    EXPECT_EQ(hsv_of(rgb(0, 255, 0)), (Hsv888{60, 255, 255}));
    EXPECT_EQ(hsv_of(rgb(0, 255, 255)), (Hsv888{90, 255, 255}));
    EXPECT_EQ(hsv_of(rgb(0, 0, 255)), (Hsv888{120, 255, 255}));
    EXPECT_EQ(hsv_of(rgb(255, 0, 255)), (Hsv888{150, 255, 255}));
}

TEST(HsvOf, RoundsByHand) {
    // Range 150: 30 * 50 / 150 = 10; 255 * 150 / 200 = 191.25.
    EXPECT_EQ(hsv_of(rgb(200, 100, 50)), (Hsv888{10, 191, 200}));
    // -30 * 50 / 150 = -10.
    EXPECT_EQ(hsv_of(rgb(200, 50, 100)), (Hsv888{170, 191, 200}));
    // 30 * 1 / 60 = 0.5 is 1; -0.5 is 0, not 180.
    EXPECT_EQ(hsv_of(rgb(60, 1, 0)).hue, 1);
    EXPECT_EQ(hsv_of(rgb(60, 0, 1)).hue, 0);
    EXPECT_EQ(hsv_of(rgb(60, 0, 3)).hue, 179);
}

TEST(HsvOf, GivesGrayNoHueAndBlackNoSaturation) {
    for (int level = 0; level < 256; ++level)
        EXPECT_EQ(hsv_of(rgb(level, level, level)), (Hsv888{0, 0, static_cast<std::uint8_t>(level)}));
}

// The toolkit's truncated reciprocals: 254 for 247 of the 255 brightnesses, and yellow 29.
TEST(HsvOf, GivesEverySaturatedColourSaturation255AtEveryBrightness) {
    for (int level = 1; level < 256; ++level) {
        EXPECT_EQ(hsv_of(rgb(level, 0, 0)).saturation, 255);
        EXPECT_EQ(hsv_of(rgb(0, level, level)).saturation, 255);
    }
}
TEST(HsvOf, GivesYellowCyanAndMagentaTheirExactHueAtEveryBrightness) {
    for (int level = 1; level < 256; ++level) {
        EXPECT_EQ(hsv_of(rgb(level, level, 0)).hue, 30);
        EXPECT_EQ(hsv_of(rgb(0, level, level)).hue, 90);
        EXPECT_EQ(hsv_of(rgb(level, 0, level)).hue, 150);
    }
}

TEST(HsvOf, IsExactForEveryPairOfRangeAndValue) {
    for (int value = 0; value < 256; ++value)
        for (int low = 0; low <= value; ++low)
            for (const int between : {low, low + (value - low) / 3, (low + value) / 2, value}) {
                for (const Rgb888 colour : {rgb(value, between, low), rgb(value, low, between),
                                            rgb(low, value, between), rgb(between, low, value)})
                    ASSERT_EQ(hsv_of(colour), plain_hsv(colour))
                        << int{colour.red} << " " << int{colour.green} << " " << int{colour.blue};
            }
    // Every hue of every range.
    for (int range = 1; range < 256; ++range)
        for (int step = 0; step <= range; ++step)
            for (const Rgb888 colour : {rgb(range, step, 0), rgb(range, 0, step)})
                ASSERT_EQ(hsv_of(colour), plain_hsv(colour)) << range << " " << step;
}

TEST(HsvOf, OfAColourInRgbAndBackIsNear) {
    Random random(301);
    int worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const Rgb888 colour = rgb(static_cast<int>(random.below(256)), static_cast<int>(random.below(256)),
                                  static_cast<int>(random.below(256)));
        const Rgb888 back = rgb_of(hsv_of(colour));
        worst = std::max({worst, std::abs(colour.red - back.red), std::abs(colour.green - back.green),
                          std::abs(colour.blue - back.blue)});
    }
    // Half a step of hue is 1/60 of the range, 255 / 60 = 4.25 at most, where saturation is exact.
    EXPECT_LE(worst, 4);
    for (int level = 0; level < 256; ++level)
        for (int pure = 0; pure < 8; ++pure) {
            const Rgb888 colour =
                rgb((pure & 1) != 0 ? level : 0, (pure & 2) != 0 ? level : 0, (pure & 4) != 0 ? level : 0);
            ASSERT_EQ(rgb_of(hsv_of(colour)), colour);
        }
}

TEST(RgbOf, IsWithinOneLevelOfTheRealFormula) {
    for (int hue = 0; hue < 256; ++hue)
        for (int saturation = 0; saturation < 256; saturation += 3)
            for (int value = 0; value < 256; value += 5) {
                const double turns = (hue % 180) / 30.0;
                const auto channel = [&](double n) {
                    const double k = std::fmod(n + turns, 6);
                    return value - value * saturation / 255.0 * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
                };
                const Rgb888 colour =
                    rgb_of({static_cast<std::uint8_t>(hue), static_cast<std::uint8_t>(saturation),
                            static_cast<std::uint8_t>(value)});
                // The range is rounded, and a share of at most all of it once more.
                ASSERT_NEAR(colour.red, channel(5), 1 + 1e-9) << hue << " " << saturation << " " << value;
                ASSERT_NEAR(colour.green, channel(3), 1 + 1e-9);
                ASSERT_NEAR(colour.blue, channel(1), 1 + 1e-9);
            }
}

TEST(ToHsv, TakesEveryPixelOfEverySize) {
    Random random(302);
    for (const Size size : test_sizes())
        for (int round = 0; round < 4; ++round) {
            GuardedImage<Rgb888> src(size);
            GuardedImage<Hsv888> dst(size);
            GuardedImage<Rgb888> back(size);
            GuardedImage<Gray8> saturation(size);
            src.fill(random);
            if (round > 0)
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x) {
                        // Few different levels: equal ones, black, saturated.
                        Rgb888& c = src(x, y);
                        const int step = round == 1 ? 255 : 37;
                        c = rgb(c.red / step * step, c.green / step * step, c.blue / step * step);
                    }
            ASSERT_EQ(to_hsv(src.view(), dst.view()), Status::ok);
            ASSERT_EQ(to_saturation(src.view(), saturation.view()), Status::ok);
            ASSERT_EQ(to_rgb(dst.view(), back.view()), Status::ok);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    ASSERT_EQ(dst(x, y), plain_hsv(src(x, y)))
                        << int{src(x, y).red} << " " << int{src(x, y).green} << " " << int{src(x, y).blue};
                    ASSERT_EQ(saturation(x, y), dst(x, y).saturation);
                    ASSERT_EQ(back(x, y), rgb_of(dst(x, y)));
                }
        }
}

TEST(ToHsv, IsRightForEveryHueOfEveryRange) {
    GuardedImage<Rgb888> src({257, 256});
    GuardedImage<Hsv888> dst({257, 256});
    for (int turn = 0; turn < 6; ++turn) {
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 257; ++x) {
                const int step = std::min(x, y);
                const int order[6][3] = {{y, step, 0}, {y, 0, step}, {step, y, 0},
                                         {0, y, step}, {step, 0, y}, {0, step, y}};
                src(x, y) = rgb(order[turn][0], order[turn][1], order[turn][2]);
            }
        ASSERT_EQ(to_hsv(src.view(), dst.view()), Status::ok);
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 257; ++x) ASSERT_EQ(dst(x, y), plain_hsv(src(x, y))) << x << " " << y;
    }
    // Every saturation.
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 257; ++x) src(x, y) = rgb(y, std::min(x, y), y);
    ASSERT_EQ(to_hsv(src.view(), dst.view()), Status::ok);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 257; ++x) ASSERT_EQ(dst(x, y), plain_hsv(src(x, y))) << x << " " << y;
}

TEST(ToRgb, OfHsvIsRightForEveryHueSaturationAndValue) {
    GuardedImage<Hsv888> src({256, 256});
    GuardedImage<Rgb888> dst({256, 256});
    for (int saturation = 0; saturation < 256; saturation += saturation % 16 == 14 ? 1 : 7) {
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x)
                src(x, y) = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(saturation),
                             static_cast<std::uint8_t>(y)};
        ASSERT_EQ(to_rgb(src.view(), dst.view()), Status::ok);
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x) ASSERT_EQ(dst(x, y), rgb_of(src(x, y))) << x << " " << y;
    }
}

}  // namespace
}  // namespace fovea::test
