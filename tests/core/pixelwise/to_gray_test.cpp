// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/to_gray.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

TEST(GrayOf, KeepsWhiteAndWeighsThePrimaries) {
    EXPECT_EQ(gray_of({255, 255, 255}), 255);
    EXPECT_EQ(gray_of({255, 0, 0}), 76);
    EXPECT_EQ(gray_of({0, 255, 0}), 150);
    EXPECT_EQ(gray_of({0, 0, 255}), 29);
    EXPECT_EQ(gray_of({0, 0, 0}), 0);
}

TEST(GrayOf, KeepsEveryGrey) {
    for (int level = 0; level < 256; ++level) {
        const auto byte = static_cast<std::uint8_t>(level);
        EXPECT_EQ(gray_of({byte, byte, byte}), byte);
    }
}

TEST(GrayOf, IsWithinOneLevelOfTheRealWeights) {
    Random random(41);
    for (int i = 0; i < 100000; ++i) {
        const Rgb888 colour{static_cast<std::uint8_t>(random.below(256)),
                            static_cast<std::uint8_t>(random.below(256)),
                            static_cast<std::uint8_t>(random.below(256))};
        const double real = 0.299 * colour.red + 0.587 * colour.green + 0.114 * colour.blue;
        // Each weight is off by at most half of 2^-15, 255 * 3 of which is 0.012; rounding adds a half.
        ASSERT_LE(std::abs(gray_of(colour) - real), 0.512);
    }
}

TEST(ToGray, TakesEveryPixelOfEverySize) {
    Random random(42);
    for (const Size size : test_sizes()) {
        GuardedImage<Rgb888> colour(size);
        GuardedImage<Yuyv> packed(size);
        GuardedImage<Uyvy> swapped(size);
        GuardedImage<Gray8> dst(size);
        colour.fill(random);
        packed.fill(random);
        swapped.fill(random);
        ASSERT_EQ(to_gray(colour.view(), dst.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst(x, y), gray_of(colour(x, y)));
        ASSERT_EQ(to_gray(packed.view(), dst.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst(x, y), packed(x, y).luma);
        ASSERT_EQ(to_gray(swapped.view(), dst.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst(x, y), swapped(x, y).luma);
        ASSERT_EQ(to_gray_fast(colour.view(), dst.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const Rgb888 c = colour(x, y);
                ASSERT_EQ(dst(x, y), (c.red + 2 * c.green + c.blue + 2) / 4);
            }
    }
}

TEST(ToGrayFast, WeighsThePrimariesAsTheToolkitDoes) {
    GuardedImage<Rgb888> src({4, 1});
    GuardedImage<Gray8> dst({4, 1});
    src(0, 0) = {255, 0, 0};
    src(1, 0) = {0, 255, 0};
    src(2, 0) = {0, 0, 255};
    src(3, 0) = {255, 255, 255};
    ASSERT_EQ(to_gray_fast(src.view(), dst.view()), Status::ok);
    EXPECT_EQ(dst(0, 0), 64);
    EXPECT_EQ(dst(1, 0), 128);
    EXPECT_EQ(dst(2, 0), 64);
    EXPECT_EQ(dst(3, 0), 255);
}

TEST(ToGray, SaysWhatIsWrongAndLeavesTheOutput) {
    GuardedImage<Rgb888> src({4, 4});
    GuardedImage<Gray8> dst({4, 5});
    src.fill(Rgb888{1, 2, 3});
    dst.fill(Gray8{77});
    EXPECT_EQ(to_gray(ImageView<const Rgb888>(), dst.view()), Status::empty_image);
    EXPECT_EQ(to_gray(src.view(), dst.view()), Status::size_mismatch);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 4; ++x) EXPECT_EQ(dst(x, y), 77);
}

}  // namespace
}  // namespace fovea::test
