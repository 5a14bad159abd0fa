// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/image/bit_view.hpp>

namespace fovea::test {
namespace {

TEST(BitView, PixelXIsBitXOfItsWord) {
    BitStorage<70, 2> storage;
    const BitView<BitWord> bits = storage.view();
    EXPECT_EQ(bits.stride_words(), 3);
    bits.set(0, 0, true);
    bits.set(31, 0, true);
    bits.set(33, 1, true);
    EXPECT_EQ(bits.row(0)[0], 0x80000001u);
    EXPECT_EQ(bits.row(1)[1], 2u);
    EXPECT_TRUE(bits(33, 1));
    EXPECT_FALSE(bits(32, 1));
    bits.set(31, 0, false);
    EXPECT_EQ(bits.row(0)[0], 1u);
    const BitView<const BitWord> read = bits;
    EXPECT_TRUE(read(0, 0));
    const auto& same = storage;
    EXPECT_EQ(same.view().first(), bits.first());
    EXPECT_TRUE(BitView<BitWord>().empty());
}

TEST(BitView, OfWordsCountsThem) {
    static_assert(bit_words(1) == 1 && bit_words(32) == 1 && bit_words(33) == 2 && bit_words(640) == 20);
    static_assert(last_bits(32) == 0xffffffffu && last_bits(33) == 1 && last_bits(31) == 0x7fffffffu);
    static_assert(sizeof(BitStorage<640, 480>) == 38400, "an eighth of the bytes");
}

TEST(BitViewOver, SaysWhatDoesNotFit) {
    std::vector<BitWord> words(10);
    const Span<BitWord> span(words.data(), 10);
    EXPECT_TRUE(bit_view_over<BitWord>(span, {33, 5}, 2).ok());
    EXPECT_TRUE(bit_view_over<BitWord>(span, {33, 3}, 4).ok());
    EXPECT_EQ(bit_view_over<BitWord>(span, {33, 6}, 2).status(), Status::truncated);
    EXPECT_EQ(bit_view_over<BitWord>(span, {33, 3}, PTRDIFF_MAX).status(), Status::truncated);
    EXPECT_EQ(bit_view_over<BitWord>(span, {33, 3}, 1).status(), Status::bad_argument);
    EXPECT_EQ(bit_view_over<BitWord>(span, {0, 3}, 1).status(), Status::empty_image);
    EXPECT_EQ(bit_view_over<BitWord>(span, {1, 32768}, 1).status(), Status::image_too_large);
}

}  // namespace
}  // namespace fovea::test
