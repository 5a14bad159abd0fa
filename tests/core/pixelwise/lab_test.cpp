// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/lab.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

struct Real {
    double first;
    double second;
    double third;
};

double light_of(double level) {
    const double c = level / 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double level_of(double light) {
    const double c = std::clamp(light, 0.0, 1.0);
    return 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

Real real_lab(Rgb888 colour) {
    const double r = light_of(colour.red);
    const double g = light_of(colour.green);
    const double b = light_of(colour.blue);
    const auto root = [](double t) {
        return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    };
    const double x = root((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
    const double y = root(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
    const double z = root((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
    return {2.55 * (116 * y - 16), 500 * (x - y) + 128, 200 * (y - z) + 128};
}

Real real_rgb(Lab888 colour) {
    const auto cube = [](double f) { return f > 6.0 / 29 ? f * f * f : 3 * 36.0 / 841 * (f - 4.0 / 29); };
    const double fy = (colour.lightness / 2.55 + 16) / 116;
    const double x = 0.95047 * cube(fy + (colour.a - 128) / 500.0);
    const double y = cube(fy);
    const double z = 1.08883 * cube(fy - (colour.b - 128) / 200.0);
    return {level_of(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
            level_of(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
            level_of(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

TEST(LabOf, GivesGrayNoColourAndWhiteFullLightness) {
    EXPECT_EQ(lab_of({0, 0, 0}), (Lab888{0, 128, 128}));
    EXPECT_EQ(lab_of({255, 255, 255}), (Lab888{255, 128, 128}));
    for (int level = 0; level < 256; ++level) {
        const auto byte = static_cast<std::uint8_t>(level);
        const Lab888 lab = lab_of({byte, byte, byte});
        EXPECT_EQ(lab.a, 128);
        EXPECT_EQ(lab.b, 128);
    }
}

TEST(LabOf, GivesThePrimariesTheirKnownPlaces) {
    // Red 53.24, 80.09, 67.20; green 87.73, -86.18, 83.18; blue 32.30, 79.19, -107.86.
    EXPECT_EQ(lab_of({255, 0, 0}), (Lab888{136, 208, 195}));
    EXPECT_EQ(lab_of({0, 255, 0}), (Lab888{224, 42, 211}));
    EXPECT_EQ(lab_of({0, 0, 255}), (Lab888{82, 207, 20}));
}

TEST(LabOf, IsWithinATenthOfBeingNearestToTheRealFormula) {
    double worst = 0;
    for (int red = 0; red < 256; red += red < 24 ? 1 : 3)
        for (int green = 0; green < 256; green += green < 24 ? 1 : 3)
            for (int blue = 0; blue < 256; blue += blue < 24 ? 1 : 5) {
                const Rgb888 colour{static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
                                    static_cast<std::uint8_t>(blue)};
                const Lab888 lab = lab_of(colour);
                const Real real = real_lab(colour);
                worst = std::max({worst, std::abs(lab.lightness - real.first), std::abs(lab.a - real.second),
                                  std::abs(lab.b - real.third)});
            }
    // Of the roots: 1/65536 for rounding, as much between two of the table, 0.00007 for the line between
    // them, and 7.8 / 65536 from the rounded light; a has the difference of two, times 500. What matters is
    // what is left of it where the roots are steep: a tenth.
    EXPECT_LT(worst, 0.6);
    RecordProperty("worst", std::to_string(worst));
}

TEST(RgbOfLab, IsWithinATenthOfBeingNearestToTheRealFormula) {
    double worst = 0;
    for (int lightness = 0; lightness < 256; lightness += lightness < 24 ? 1 : 3)
        for (int a = 0; a < 256; a += 5)
            for (int b = 0; b < 256; b += 5) {
                const Lab888 lab{static_cast<std::uint8_t>(lightness), static_cast<std::uint8_t>(a),
                                 static_cast<std::uint8_t>(b)};
                const Rgb888 colour = rgb_of(lab);
                const Real real = real_rgb(lab);
                worst = std::max({worst, std::abs(colour.red - real.first),
                                  std::abs(colour.green - real.second), std::abs(colour.blue - real.third)});
            }
    EXPECT_LT(worst, 0.6);
    RecordProperty("worst", std::to_string(worst));
}

TEST(RgbOfLab, BringsEveryGrayBackToALevel) {
    // Bright grays are 0.9 of a step of lightness apart, so some share one.
    for (int level = 0; level < 256; ++level) {
        const auto byte = static_cast<std::uint8_t>(level);
        const Rgb888 back = rgb_of(lab_of({byte, byte, byte}));
        EXPECT_EQ(back.red, back.green);
        EXPECT_EQ(back.red, back.blue);
        EXPECT_NEAR(back.red, level, 1);
    }
    EXPECT_EQ(rgb_of(lab_of({255, 255, 255})), (Rgb888{255, 255, 255}));
    EXPECT_EQ(rgb_of(lab_of({0, 0, 0})), (Rgb888{0, 0, 0}));
}

TEST(ToLab, TakesEveryPixelOfEverySize) {
    Random random(371);
    for (const Size size : test_sizes()) {
        GuardedImage<Rgb888> src(size), back(size);
        GuardedImage<Lab888> dst(size);
        src.fill(random);
        ASSERT_EQ(to_lab(src.view(), dst.view()), Status::ok);
        ASSERT_EQ(to_rgb(dst.view(), back.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                ASSERT_EQ(dst(x, y), lab_of(src(x, y)));
                ASSERT_EQ(back(x, y), rgb_of(dst(x, y)));
            }
    }
}

TEST(ToRgbOfLab, IsRgbOfForEveryLab) {
    // Rows of 250 colours, so that vectors start anywhere and the last one is not full.
    constexpr Size size{250, 1};
    GuardedImage<Lab888> src(size);
    GuardedImage<Rgb888> dst(size);
    for (int colour = 0; colour < 1 << 24; colour += size.width) {
        for (int x = 0; x < size.width; ++x)
            src(x, 0) = {static_cast<std::uint8_t>((colour + x) >> 16),
                         static_cast<std::uint8_t>((colour + x) >> 8), static_cast<std::uint8_t>(colour + x)};
        ASSERT_EQ(to_rgb(src.view(), dst.view()), Status::ok);
        for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst(x, 0), rgb_of(src(x, 0))) << colour + x;
    }
}

TEST(ToLab, IsLabOfForColoursOfAllKinds) {
    constexpr Size size{250, 1};
    GuardedImage<Rgb888> src(size);
    GuardedImage<Lab888> dst(size);
    for (int colour = 0; colour < 1 << 24; colour += 7 * size.width) {
        for (int x = 0; x < size.width; ++x)
            src(x, 0) = {static_cast<std::uint8_t>((colour + 7 * x) >> 16),
                         static_cast<std::uint8_t>((colour + 7 * x) >> 8),
                         static_cast<std::uint8_t>(colour + 7 * x)};
        ASSERT_EQ(to_lab(src.view(), dst.view()), Status::ok);
        for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst(x, 0), lab_of(src(x, 0))) << colour + 7 * x;
    }
}

}  // namespace
}  // namespace fovea::test
