// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/code_field.hpp>

namespace fovea::test {
namespace {

using detail::CodeField;
using detail::PassedSides;

TEST(CodeField, SamplesLieBetweenThePixels) {
    const std::uint8_t pixels[4] = {0, 100, 200, 40};
    const CodeField field(ImageView<const Gray8>(pixels, {2, 2}, 2), false);
    EXPECT_EQ(field.sample(0, 0), 0);
    EXPECT_EQ(field.sample(128, 0), 16 * 50);
    EXPECT_EQ(field.sample(128, 128), 16 * 85);
    // Beyond the sides all is light, whichever way the image is taken.
    EXPECT_EQ(field.sample(-5000, 0), 4080);
    const CodeField inverted(ImageView<const Gray8>(pixels, {2, 2}, 2), true);
    EXPECT_EQ(inverted.sample(128, 0), 16 * 205);
    EXPECT_EQ(inverted.sample(0, 5000), 4080);
}

TEST(CodeField, RemembersWhichSidesWerePassed) {
    const Size size{70, 3};
    std::vector<BitWord> words(static_cast<std::size_t>(PassedSides::words(size)));
    const PassedSides passed({words.data(), static_cast<std::ptrdiff_t>(words.size())}, size);
    passed.pass_left(65, 1);
    passed.pass_right(0, 2);
    EXPECT_TRUE(passed.left(65, 1));
    EXPECT_FALSE(passed.right(65, 1));
    EXPECT_FALSE(passed.left(64, 1));
    EXPECT_TRUE(passed.right(0, 2));
    passed.clear();
    EXPECT_FALSE(passed.left(65, 1));
    EXPECT_FALSE(passed.right(0, 2));
}

TEST(CodeField, StepsAlongALineSeeWhatSamplesTell) {
    Random random(31);
    std::uint8_t pixels[20 * 14];
    for (std::uint8_t& pixel : pixels) pixel = static_cast<std::uint8_t>(random.between(0, 255));
    for (const bool inverted : {false, true}) {
        const CodeField field(ImageView<const Gray8>(pixels, {20, 14}, 20), inverted);
        for (int round = 0; round < 200; ++round) {
            // From beside the image, across it and out of it.
            constexpr int pixel = 1 << 22;
            const std::int64_t x = random.between(-4 * pixel, 24 * pixel);
            const std::int64_t y = random.between(-4 * pixel, 18 * pixel);
            const std::int64_t step_x = random.between(-pixel, pixel);
            const std::int64_t step_y = random.between(-pixel, pixel);
            detail::FieldSteps steps(field, x, y, step_x, step_y);
            for (int i = 0; i < 30; ++i)
                ASSERT_EQ(steps.next(), field.sample(static_cast<std::int32_t>((x + i * step_x) >> 14),
                                                     static_cast<std::int32_t>((y + i * step_y) >> 14)))
                    << round << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace fovea::test
