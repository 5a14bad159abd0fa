// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/rgb565.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

TEST(Rgb565, GivesThePureColours) {
    EXPECT_EQ(rgb_of_rgb565(0xf800), (Rgb888{255, 0, 0}));
    EXPECT_EQ(rgb_of_rgb565(0x07e0), (Rgb888{0, 255, 0}));
    EXPECT_EQ(rgb_of_rgb565(0x001f), (Rgb888{0, 0, 255}));
    EXPECT_EQ(rgb_of_rgb565(0xffff), (Rgb888{255, 255, 255}));
    // 10110, 100110 and 00101 with their highest bits again.
    EXPECT_EQ(rgb_of_rgb565(0xb4c5), (Rgb888{0xb5, 0x9a, 0x29}));
}

TEST(Rgb565, IsLessThanALevelFromTheExactShare) {
    for (int colour = 0; colour < 65536; ++colour) {
        const Rgb888 got = rgb_of_rgb565(static_cast<Rgb565>(colour));
        const double red = 255.0 / 31 * (colour >> 11);
        const double green = 255.0 / 63 * (colour >> 5 & 63);
        const double blue = 255.0 / 31 * (colour & 31);
        ASSERT_LT(std::abs(got.red - red), 1);
        ASSERT_LT(std::abs(got.green - green), 1);
        ASSERT_LT(std::abs(got.blue - blue), 1);
    }
}

TEST(Rgb565, TakesEveryPixelOfEverySize) {
    Random random(331);
    std::vector<Size> sizes = test_sizes();
    sizes.push_back({256, 256});
    for (const Size size : sizes) {
        GuardedImage<Rgb565> src(size);
        GuardedImage<Rgb888> colour(size);
        GuardedImage<Gray8> gray(size);
        src.fill(random);
        if (size.width == 256)
            for (int y = 0; y < 256; ++y)
                for (int x = 0; x < 256; ++x) src(x, y) = static_cast<Rgb565>(256 * y + x);
        ASSERT_EQ(rgb565_to_rgb(src.view(), colour.view()), Status::ok);
        ASSERT_EQ(rgb565_to_gray(src.view(), gray.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                ASSERT_EQ(colour(x, y), rgb_of_rgb565(src(x, y)));
                ASSERT_EQ(gray(x, y), gray_of(rgb_of_rgb565(src(x, y))));
            }
    }
}

}  // namespace
}  // namespace fovea::test
