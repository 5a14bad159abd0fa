// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

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

}  // namespace
}  // namespace fovea::test
