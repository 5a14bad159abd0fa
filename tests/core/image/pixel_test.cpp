// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/image/pixel.hpp>

namespace fovea::test {
namespace {

TEST(Pixel, LiesInMemoryAsFilesAndCamerasHaveIt) {
    static_assert(std::is_trivially_copyable_v<Rgb888> && std::is_trivially_copyable_v<Yuyv>);
    static_assert(alignof(Rgb888) == 1 && alignof(Yuyv) == 1);
    static_assert(sizeof(Gray8) == 1 && sizeof(Gray16) == 2 && sizeof(Gradient16) == 2 &&
                  sizeof(Label16) == 2);
    constexpr std::uint8_t bytes[] = {1, 2, 3};
    Rgb888 colour;
    std::memcpy(&colour, bytes, sizeof colour);
    EXPECT_EQ(colour.red, 1);
    EXPECT_EQ(colour.green, 2);
    EXPECT_EQ(colour.blue, 3);
    Yuyv half;
    std::memcpy(&half, bytes, sizeof half);
    EXPECT_EQ(half.luma, 1);
    EXPECT_EQ(half.chroma, 2);
}

TEST(Rgb888, IsEqualWhenEveryColourIs) {
    constexpr Rgb888 colour{1, 2, 3};
    static_assert(colour == Rgb888{1, 2, 3});
    EXPECT_NE(colour, (Rgb888{0, 2, 3}));
    EXPECT_NE(colour, (Rgb888{1, 0, 3}));
    EXPECT_NE(colour, (Rgb888{1, 2, 0}));
    EXPECT_FALSE(colour != colour);
}

}  // namespace
}  // namespace fovea::test
