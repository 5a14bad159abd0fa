// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/lookup_table.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

TEST(ApplyLut, LooksUpEveryPixelOnEverySize) {
    Random random(81);
    LookupTable table;
    for (Gray8& level : table.levels) level = static_cast<Gray8>(random.next() >> 9);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), dst(size);
        src.fill(random);
        ASSERT_EQ(apply_lut(src.view(), table, dst.view()), Status::ok);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst(x, y), table[src(x, y)]);
    }
}

TEST(AffineTable, RoundsTiesUpAndHoldsBothEnds) {
    constexpr LookupTable half = affine_table(Ratio::from_ratio(1, 2), GrayLevel::from_int(0));
    EXPECT_EQ(half[0], 0);
    EXPECT_EQ(half[1], 1) << "a half is rounded up";
    EXPECT_EQ(half[2], 1);
    EXPECT_EQ(half[255], 128);
    constexpr LookupTable steep = affine_table(Ratio::from_int(3), GrayLevel::from_int(-100));
    EXPECT_EQ(steep[33], 0) << "-1 is held at 0";
    EXPECT_EQ(steep[34], 2);
    EXPECT_EQ(steep[118], 254);
    EXPECT_EQ(steep[119], 255) << "257 is held at 255";
    constexpr LookupTable negative = affine_table(Ratio::from_int(-1), GrayLevel::from_int(255));
    for (int x = 0; x < 256; ++x) EXPECT_EQ(negative[x], 255 - x);
}

TEST(AffineTable, IsTheRealFunctionRounded) {
    Random random(82);
    for (int round = 0; round < 300; ++round) {
        const Ratio scale = Ratio::from_raw(random.between(-100 * 65536, 100 * 65536));
        const GrayLevel offset = GrayLevel::from_raw(random.between(-25500 * 65536, 25500 * 65536));
        const LookupTable table = affine_table(scale, offset);
        for (int x = 0; x < 256; ++x) {
            // Exact: 39 bits of product in 53.
            const double value =
                std::floor((static_cast<double>(scale.raw()) * x + offset.raw()) / 65536 + 0.5);
            ASSERT_EQ(table[x], std::fmin(std::fmax(value, 0), 255));
        }
    }
}

TEST(StretchTable, TakesTheEndsToBlackAndWhite) {
    constexpr LookupTable table = stretch_table(50, 60);
    EXPECT_EQ(table[0], 0);
    EXPECT_EQ(table[50], 0);
    EXPECT_EQ(table[51], 26) << "25.5 is rounded up";
    EXPECT_EQ(table[55], 128);
    EXPECT_EQ(table[60], 255);
    EXPECT_EQ(table[255], 255);
    constexpr LookupTable none = stretch_table(90, 90);
    EXPECT_EQ(none[90], 0);
    EXPECT_EQ(none[91], 255);
}

TEST(GammaTable, IsTheRealPowerRoundedForEveryExponent) {
    for (int gamma = min_gamma; gamma <= max_gamma; ++gamma) {
        const LookupTable table = gamma_table(gamma);
        for (int x = 0; x < 256; ++x) {
            const long double value = 255 * std::pow(x / 255.0L, gamma / 100.0L);
            ASSERT_EQ(table[x], static_cast<int>(std::floor(value + 0.5L))) << gamma << " " << x;
        }
    }
}

TEST(GammaTable, OfOneHundredIsNothingAndTheEndsStay) {
    for (int x = 0; x < 256; ++x) EXPECT_EQ(gamma_table(100)[x], x);
    for (const int gamma : {-7, 0, 1, 45, 220, 1000, 5000}) {
        EXPECT_EQ(gamma_table(gamma)[0], 0);
        EXPECT_EQ(gamma_table(gamma)[255], 255);
    }
}

TEST(LogarithmTable, IsTheRealLogarithmRounded) {
    constexpr LookupTable table = logarithm_table();
    for (int x = 0; x < 256; ++x)
        ASSERT_EQ(table[x], static_cast<int>(std::floor(255 * std::log2(1.0L + x) / 8 + 0.5L))) << x;
}

TEST(Log2, IsWithinItsBound) {
    for (std::uint32_t n = 1; n <= 510; ++n)
        ASSERT_NEAR(detail::log2_of(n) / 67108864.0, std::log2(n), 2.0 / 67108864) << n;
}

TEST(Affine, IsItsTableForScalesAndOffsetsOfAllSizes) {
    Random random(373);
    GuardedImage<Gray8> src({256, 1}), dst({256, 1});
    for (int x = 0; x < 256; ++x) src(x, 0) = static_cast<Gray8>(x);
    for (int run = 0; run < 20000; ++run) {
        const int bits = random.between(4, 23);
        const int most = minimum(max_affine_scale << 16, 1 << bits);
        const Ratio scale = Ratio::from_raw(random.between(-most, most));
        const int far = minimum(max_affine_offset << 16, 255 * most);
        const GrayLevel offset = GrayLevel::from_raw(random.between(-far, far));
        const LookupTable table = affine_table(scale, offset);
        ASSERT_EQ(affine(src.view(), scale, offset, dst.view()), Status::ok);
        for (int x = 0; x < 256; ++x) ASSERT_EQ(dst(x, 0), table[x]) << scale.raw() << ", " << offset.raw();
    }
}

TEST(Affine, RefusesWhatItsBoundsExclude) {
    GuardedImage<Gray8> src({4, 4}), dst({4, 4});
    src.fill(Gray8{1});
    dst.fill(Gray8{77});
    const Ratio one = Ratio::from_int(1);
    const Ratio too_large = Ratio::from_raw(max_affine_scale * 65536 + 1);
    const GrayLevel too_far = GrayLevel::from_raw(max_affine_offset * 65536 + 1);
    EXPECT_EQ(affine(src.view(), too_large, GrayLevel(), dst.view()), Status::bad_argument);
    EXPECT_EQ(affine(src.view(), -too_large, GrayLevel(), dst.view()), Status::bad_argument);
    EXPECT_EQ(affine(src.view(), one, too_far, dst.view()), Status::bad_argument);
    EXPECT_EQ(affine(src.view(), one, -too_far, dst.view()), Status::bad_argument);
    EXPECT_EQ(amplify(src.view(), too_large, dst.view()), Status::bad_argument);
    EXPECT_EQ(dst(0, 0), 77);
}

TEST(Affine, IsItsTableForEveryScaleAndOffset) {
    Random random(84);
    GuardedImage<Gray8> src({256, 1}), dst({256, 1});
    for (int x = 0; x < 256; ++x) src(x, 0) = static_cast<Gray8>(x);
    const auto compare = [&](int scale, int offset) {
        const Ratio factor = Ratio::from_raw(scale);
        const GrayLevel step = GrayLevel::from_raw(offset);
        ASSERT_EQ(affine(src.view(), factor, step, dst.view()), Status::ok);
        const LookupTable table = affine_table(factor, step);
        for (int x = 0; x < 256; ++x) ASSERT_EQ(dst(x, 0), table[x]) << scale << " " << offset << " " << x;
    };
    constexpr int one = 65536;
    for (const int scale :
         {0, 1, -1, one, 60 * one, 60 * one + 1, -60 * one, -60 * one - 1, 100 * one, -100 * one})
        for (const int offset : {0, 32767, -32768, -32769, 255 * one, 256 * one, -15300 * one, 15556 * one,
                                 25500 * one, -25500 * one})
            compare(scale, offset);
    for (int round = 0; round < 3000; ++round) {
        const int most = one << random.between(0, 6);
        const int scale = random.between(-most, most);
        compare(scale, random.between(-128, 128) * -scale + random.between(-most, most));
    }
}

TEST(Affine, AmplifiesWithoutAnOffset) {
    Random random(83);
    const Size size{41, 6};
    GuardedImage<Gray8> src(size), dst(size);
    src.fill(random);
    ASSERT_EQ(amplify(src.view(), Ratio::from_ratio(5, 4), dst.view()), Status::ok);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) ASSERT_EQ(dst(x, y), std::min((5 * src(x, y) + 2) / 4, 255));
}

}  // namespace
}  // namespace fovea::test
