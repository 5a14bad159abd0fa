// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include <fovea/base/random.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/halves.hpp>

namespace fovea::test {
namespace {

TEST(SplitWords, AreAllPixelsAndComeBackInOrder) {
    Random random(45);
    std::uint8_t pixels[simd::lanes];
    for (std::uint8_t& pixel : pixels) pixel = static_cast<std::uint8_t>(random.below(256));
    std::uint8_t back[simd::lanes];
    simd::joined_held(simd::split(simd::Bytes::load(pixels))).store(back);
    for (int i = 0; i < simd::lanes; ++i) EXPECT_EQ(back[i], pixels[i]);
}

TEST(SplitWords, AreHeldAtBothEnds) {
    for (const int value : {-32768, -257, -256, -1, 0, 1, 254, 255, 256, 257, 32767}) {
        const simd::RawWords all = simd::all_words(static_cast<std::uint16_t>(value));
        std::uint8_t pixels[simd::lanes];
        simd::joined_held({all, all}).store(pixels);
        for (const std::uint8_t pixel : pixels) EXPECT_EQ(pixel, clamp(value, 0, 255)) << value;
    }
}

}  // namespace
}  // namespace fovea::test
