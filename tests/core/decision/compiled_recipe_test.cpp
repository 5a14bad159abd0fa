// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fovea/base/crc32.hpp>
#include <fovea/base/random.hpp>
#include <fovea/decision/compiled_recipe.hpp>
#include <support/recipes.hpp>

namespace fovea::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

Span<const std::uint8_t> span(const Bytes& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

template <int Capacity>
Bytes encoded(const RecipeOf<Capacity>& recipe) {
    Bytes bytes(static_cast<std::size_t>(compiled_recipe_bytes(Capacity)));
    const Result<std::ptrdiff_t> size =
        encode_recipe(recipe, {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())});
    EXPECT_TRUE(size.ok());
    bytes.resize(static_cast<std::size_t>(size.ok() ? *size : 0));
    return bytes;
}

/// With the checksum that the bytes should have.
Bytes summed(Bytes bytes) {
    const std::uint32_t sum = crc32({bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()) - 4});
    for (std::size_t i = 0; i < 4; ++i) bytes[bytes.size() - 4 + i] = static_cast<std::uint8_t>(sum >> 8 * i);
    return bytes;
}

RecipeOf<2> small_recipe() {
    RecipeOf<2> recipe;
    set_name(recipe.name, "ab");
    Feature feature;
    set_name(feature.name, "w");
    feature.from = {-2, 0};
    feature.to = {64, 1};
    feature.tolerance = {{100}, {0}, {5}};
    EXPECT_EQ(recipe.features.push(feature), Status::ok);
    return recipe;
}

TEST(CompiledRecipe, IsWrittenAsByHand) {
    const Bytes bytes = encoded(small_recipe());
    const Bytes by_hand = {
        'F',  'V',  'R',  'C',  1,    0,    0,         // the length is filled in below
        4,    'a',  'b',                               // two letters
        0,    0x80, 0x89, 0x7a, 0x80, 0x89, 0x7a,      // px, 1000000 twice
        2,    2,    0x80, 2,                           // dark, otsu, 128
        0xc0, 0xb8, 2,    0xc0, 0xd0, 0x77,            // 20000, 980000
        2,    0xc8, 1,    0x82, 0x80, 0xfe, 0x3f, 40,  // opening 1, areas 100 and 67092481, 20
        0,    0,    0,    0,    0,    0,    0,    8,   // border, pose, orientation, ends, symmetry of 4
        2,                                             // one feature
        2,    'w',  2,                                 // its name, width
        3,    0,    0x80, 1,    2,    0,    0,    0,  0, 0, 0,  // from -2, 0 to 64, 1; the other places
        0,    0,    30,   96,   8,    2,    0,    2,  1,  // radius, search, lines 15, 48, 4, 1, 0, 1, -1
        0xc8, 1,    0,    10};                            // 100 - 0 + 5
    Bytes wanted = by_hand;
    wanted[5] = static_cast<std::uint8_t>(wanted.size() + 4);
    wanted.resize(wanted.size() + 4);
    EXPECT_EQ(bytes, summed(wanted));
}

TEST(CompiledRecipe, EveryRecipeComesBackAsItWas) {
    Random random(902);
    for (int i = 0; i < 500; ++i) {
        const auto recipe = std::make_unique<Recipe>(random_recipe(random));
        const Bytes bytes = encoded(*recipe);
        EXPECT_LE(static_cast<std::ptrdiff_t>(bytes.size()), compiled_recipe_bytes(recipe->features.size()));
        const auto back = std::make_unique<Recipe>(random_recipe(random));
        ASSERT_EQ(decode_recipe(span(bytes), *back), Status::ok);
        // The same bytes again: no field is lost.
        EXPECT_EQ(encoded(*back), bytes);
        EXPECT_TRUE(same(*back, *recipe));
    }
}

TEST(CompiledRecipe, EveryBitCountsAndEveryEndIsMissed) {
    const RecipeOf<2> recipe = small_recipe();
    const Bytes good = encoded(recipe);
    RecipeOf<2> read = recipe;
    set_name(read.name, "kept");
    for (std::size_t i = 0; i < good.size(); ++i) {
        EXPECT_EQ(decode_recipe({good.data(), static_cast<std::ptrdiff_t>(i)}, read), Status::truncated) << i;
        for (int bit = 0; bit < 8; ++bit) {
            Bytes bytes = good;
            bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ 1 << bit);
            const Status status = decode_recipe(span(bytes), read);
            EXPECT_TRUE(status == (i == 4 ? Status::unsupported : Status::malformed) ||
                        ((i == 5 || i == 6) && status == Status::truncated))
                << i << " " << bit;
        }
    }
    Bytes longer = good;
    longer.push_back(0);
    EXPECT_EQ(decode_recipe(span(longer), read), Status::malformed);
    EXPECT_EQ(name_text(read.name), "kept");
}

TEST(CompiledRecipe, AValueThatNoRecipeHasIsRefusedThoughTheChecksumIsRight) {
    const Bytes good = encoded(small_recipe());
    RecipeOf<2> read;
    // Place of a byte -> what stands there.
    const std::vector<std::pair<std::size_t, int>> wrong = {
        {7, 6},     // a name longer than its letters: the fields are shifted
        {8, 0},     // a zero in a name
        {8, 0x1b},  // a control character
        {8, 0xff},  // no UTF-8
        {10, 4},    // a unit of length that does not exist
        {17, 4},    // dark: 2
        {18, 6},    // threshold: 3
        {27, 0},    // opening: 0
        {37, 0xff}};
    for (const auto& [place, value] : wrong) {
        Bytes bytes = good;
        bytes[place] = static_cast<std::uint8_t>(value);
        EXPECT_EQ(decode_recipe(span(summed(bytes)), read), Status::malformed) << place;
    }
    EXPECT_TRUE(read.features.empty());
}

TEST(CompiledRecipe, ANumberOfMoreThan64BitsIsNone) {
    Bytes bytes = encoded(small_recipe());
    const Bytes endless(12, 0x80);
    bytes.insert(bytes.begin() + 11, endless.begin(), endless.end());
    bytes[5] = static_cast<std::uint8_t>(bytes.size());
    RecipeOf<2> read;
    EXPECT_EQ(decode_recipe(span(summed(bytes)), read), Status::malformed);
}

TEST(CompiledRecipe, TakesNoMoreFeaturesThanThereIsRoomFor) {
    RecipeOf<2> two = small_recipe();
    EXPECT_EQ(two.features.push(two.features[0]), Status::ok);
    const Bytes bytes = encoded(two);
    RecipeOf<1> one;
    EXPECT_EQ(decode_recipe(span(bytes), one), Status::capacity_exceeded);
    EXPECT_TRUE(one.features.empty());
    EXPECT_EQ(decode_recipe(span(bytes), two), Status::ok);
}

TEST(CompiledRecipe, WritesOnlyWhatCanBeMeasuredWith) {
    Bytes out(200, 0x55);
    const Span<std::uint8_t> room(out.data(), 200);
    RecipeOf<2> recipe = small_recipe();
    recipe.features[0].lines = 0;
    EXPECT_EQ(encode_recipe(recipe, room).status(), Status::bad_argument);
    recipe = small_recipe();
    recipe.scale.x_per_pixel = 1;
    EXPECT_EQ(encode_recipe(recipe, room).status(), Status::bad_argument);
    recipe = small_recipe();
    set_name(recipe.features[0].name, "\x07");
    EXPECT_EQ(encode_recipe(recipe, room).status(), Status::bad_argument);
    recipe = small_recipe();
    EXPECT_EQ(
        encode_recipe(recipe, room.first(static_cast<std::ptrdiff_t>(encoded(recipe).size()) - 1)).status(),
        Status::buffer_too_small);
    EXPECT_EQ(out, Bytes(200, 0x55));
}

}  // namespace
}  // namespace fovea::test
