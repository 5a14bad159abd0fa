// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>

#include <fovea/hal/pixel_format.hpp>

namespace fovea::hal {
namespace {

TEST(PixelFormat, HasRowsAsItsPixelsNeed) {
    EXPECT_EQ(row_bytes(PixelFormat::gray8, 0, 5), 5);
    EXPECT_EQ(row_bytes(PixelFormat::gray10, 0, 5), 10);
    EXPECT_EQ(row_bytes(PixelFormat::rgb24, 0, 5), 15);
    EXPECT_EQ(row_bytes(PixelFormat::rgb565, 0, 5), 10);
    // Two pixels share their colour differences, so an odd row has one more.
    EXPECT_EQ(row_bytes(PixelFormat::yuyv, 0, 5), 12);
    EXPECT_EQ(row_bytes(PixelFormat::nv12, 0, 5), 5);
    EXPECT_EQ(row_bytes(PixelFormat::nv12, 1, 5), 6);
    EXPECT_EQ(plane_rows(PixelFormat::nv12, 0, 7), 7);
    EXPECT_EQ(plane_rows(PixelFormat::nv12, 1, 7), 4);
    EXPECT_EQ(row_bytes(PixelFormat::mjpeg, 0, 5), 0);
    EXPECT_EQ(plane_rows(PixelFormat::mjpeg, 0, 7), 0);
}

TEST(PixelFormat, TellsColourFromGray) {
    EXPECT_FALSE(coloured(PixelFormat::gray8));
    EXPECT_FALSE(coloured(PixelFormat::gray16));
    EXPECT_FALSE(coloured(PixelFormat::none));
    EXPECT_TRUE(coloured(PixelFormat::yuyv));
    EXPECT_TRUE(coloured(PixelFormat::bayer_gbrg));
    EXPECT_TRUE(coloured(PixelFormat::mjpeg));
}

TEST(PixelFormat, HasANameOfItsOwnEach) {
    for (int a = 0; a < pixel_formats; ++a) {
        const char* const name = describe(static_cast<PixelFormat>(a));
        EXPECT_STRNE(name, "unknown");
        for (int b = 0; b < a; ++b) EXPECT_STRNE(name, describe(static_cast<PixelFormat>(b)));
        const int planes = plane_count(static_cast<PixelFormat>(a));
        EXPECT_LE(planes, max_planes);
        EXPECT_EQ(planes == 0, a == 0);
    }
    EXPECT_STREQ(describe(static_cast<PixelFormat>(pixel_formats)), "unknown");
}

}  // namespace
}  // namespace fovea::hal
