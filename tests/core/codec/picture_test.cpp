// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>

#include <fovea/codec/picture.hpp>

namespace fovea::test {
namespace {

TEST(PixelOfGray, ScalesByHand) {
    EXPECT_EQ(pixel_of_gray<Gray8>(1, 1), 255);
    EXPECT_EQ(pixel_of_gray<Gray8>(1, 2), 128) << "127.5, ties up";
    EXPECT_EQ(pixel_of_gray<Gray8>(7, 15), 119);
    EXPECT_EQ(pixel_of_gray<Gray8>(65535, 65535), 255);
    EXPECT_EQ(pixel_of_gray<Gray16>(7, 15), 30583);
    EXPECT_EQ(pixel_of_gray<Gray16>(200, 255), 200 * 257);
    EXPECT_EQ(pixel_of_gray<Rgb888>(7, 15), (Rgb888{119, 119, 119}));
}

TEST(PixelOfGray, IsTheNearestForEverySampleOfEveryDepth) {
    for (const std::uint32_t most : {1u, 3u, 15u, 100u, 255u, 1023u, 4095u, 65535u})
        for (std::uint32_t sample = 0; sample <= most; ++sample) {
            const double share = sample / static_cast<double>(most);
            ASSERT_EQ(pixel_of_gray<Gray8>(sample, most), static_cast<int>(share * 255 + 0.5)) << sample;
            ASSERT_EQ(pixel_of_gray<Gray16>(sample, most), static_cast<int>(share * 65535 + 0.5)) << sample;
        }
}

TEST(PixelOfGray, HoldsASampleThatIsTooLarge) {
    EXPECT_EQ(pixel_of_gray<Gray8>(16, 15), 255);
    EXPECT_EQ(pixel_of_gray<Gray16>(0xffffffffu, 65535), 65535);
}

TEST(PixelOfColour, IsTheColourOrItsBrightness) {
    const Rgb888 colour{200, 100, 50};
    EXPECT_EQ(pixel_of_colour<Rgb888>(colour), colour);
    EXPECT_EQ(pixel_of_colour<Gray8>(colour), gray_of(colour));
    EXPECT_EQ(pixel_of_colour<Gray16>(colour), gray_of(colour) * 257);
    for (int level = 0; level < 256; ++level) {
        const auto byte = static_cast<std::uint8_t>(level);
        EXPECT_EQ(pixel_of_colour<Gray8>({byte, byte, byte}), level);
    }
}

}  // namespace
}  // namespace fovea::test
