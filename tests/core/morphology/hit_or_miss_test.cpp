// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/morphology/hit_or_miss.hpp>
#include <fovea/pixelwise/bits.hpp>
#include <support/guarded_bits.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

std::vector<std::uint8_t> scratch_for(Size size, const StructuringElement& hit,
                                      const StructuringElement& miss) {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(hit_or_miss_scratch(size, hit, miss)), 0xee);
}
Span<std::uint8_t> span_of(std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

/// Place by place; what lies outside the image is passed over.
bool naive(ImageView<const Gray8> src, const StructuringElement& element, int x, int y, bool set) {
    for (int j = 0; j < element.size().height; ++j)
        for (int i = 0; i < element.size().width; ++i) {
            const Point p{x + i - element.size().width / 2, y + j - element.size().height / 2};
            if (element.contains(i, j) && src.contains(p) && (src(p.x, p.y) != 0) != set) return false;
        }
    return true;
}

StructuringElement random_element(Random& random, Size size) {
    std::string text;
    for (int y = 0; y < size.height; ++y) {
        if (y > 0) text += '\n';
        for (int x = 0; x < size.width; ++x) text += random.below(3) == 0 ? '#' : '.';
    }
    return StructuringElement::from_text(text.c_str());
}

TEST(HitOrMiss, FindsAnUpperLeftCorner) {
    GuardedImage<Gray8> src({6, 5}), dst({6, 5});
    src.fill(0);
    for (int y = 1; y < 4; ++y)
        for (int x = 2; x < 5; ++x) src(x, y) = 200;
    const auto hit = StructuringElement::from_text("...\n.##\n.#.");
    const auto miss = StructuringElement::from_text("##.\n#..\n...");
    std::vector<std::uint8_t> scratch = scratch_for({6, 5}, hit, miss);
    ASSERT_EQ(hit_or_miss(src.view(), hit, miss, span_of(scratch), dst.view()), Status::ok);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 6; ++x) EXPECT_EQ(dst(x, y), x == 2 && y == 1 ? 255 : 0);
}

TEST(HitOrMiss, EqualsTheReferenceAndSoDoBits) {
    Random random(97);
    for (const Size size : bit_sizes())
        for (const Size shape : {Size{1, 1}, Size{3, 3}, Size{3, 1}, Size{1, 3}, Size{5, 7}})
            for (int round = 0; round < 6; ++round) {
                GuardedImage<Gray8> src(size), dst(size), expected(size);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        src(x, y) =
                            random.below(2) == 0 ? Gray8{0} : static_cast<Gray8>(random.between(1, 255));
                const StructuringElement hit =
                    round == 0 ? StructuringElement() : random_element(random, shape);
                const StructuringElement miss =
                    round == 1 ? StructuringElement() : random_element(random, shape);
                std::vector<std::uint8_t> scratch = scratch_for(size, hit, miss);
                const Status s = hit_or_miss(src.view(), hit, miss, span_of(scratch), dst.view());
                const bool none = hit.empty() && miss.empty();
                ASSERT_EQ(s, none ? Status::bad_argument : Status::ok);
                if (none) continue;
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        expected(x, y) =
                            naive(src.view(), hit, x, y, true) && naive(src.view(), miss, x, y, false) ? 255
                                                                                                       : 0;
                ASSERT_TRUE(equal(dst.view(), expected.view()));

                GuardedBits bits(size), found(size);
                ASSERT_EQ(pack_bits(src.view(), bits.view()), Status::ok);
                for (int y = 0; y < size.height; ++y)
                    bits.view().row(y)[bit_words(size.width) - 1] |= random.next() & ~last_bits(size.width);
                std::vector<BitWord> words(static_cast<std::size_t>(bit_hit_or_miss_scratch(size)));
                const Span<BitWord> room(words.data(), static_cast<std::ptrdiff_t>(words.size()));
                const bool small = shape.width <= 3 && shape.height <= 3;
                ASSERT_EQ(hit_or_miss(bits.view(), hit, miss, room, found.view()),
                          small ? Status::ok : Status::bad_argument);
                if (small) {
                    ASSERT_TRUE(equal(found, expected.view()));
                }
            }
}

TEST(HitOrMiss, OfAPatternThatContradictsItselfFindsNothing) {
    GuardedImage<Gray8> src({9, 9}), dst({9, 9});
    Random random(98);
    src.fill(random);
    const auto middle = StructuringElement::from_text("#");
    std::vector<std::uint8_t> scratch = scratch_for({9, 9}, middle, middle);
    ASSERT_EQ(hit_or_miss(src.view(), middle, middle, span_of(scratch), dst.view()), Status::ok);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) EXPECT_EQ(dst(x, y), 0);
}

TEST(HitOrMiss, LeavesTheOutputWhenItCannotRun) {
    GuardedImage<Gray8> src({5, 4}), dst({5, 4}), small({5, 3}), before({5, 4});
    src.fill(1);
    dst.fill(9);
    before.fill(9);
    const StructuringElement none;
    const auto hit = StructuringElement::cross({3, 3});
    std::vector<std::uint8_t> scratch = scratch_for({5, 4}, hit, none);
    EXPECT_EQ(hit_or_miss(ImageView<const Gray8>(), hit, none, span_of(scratch), dst.view()),
              Status::empty_image);
    EXPECT_EQ(hit_or_miss(src.view(), hit, none, span_of(scratch), ImageView<Gray8>()), Status::empty_image);
    EXPECT_EQ(hit_or_miss(src.view(), hit, none, span_of(scratch), small.view()), Status::size_mismatch);
    EXPECT_EQ(hit_or_miss(src.view(), none, none, span_of(scratch), dst.view()), Status::bad_argument);
    EXPECT_EQ(hit_or_miss(src.view(), hit, none, span_of(scratch).first(19), dst.view()),
              Status::scratch_too_small);
    EXPECT_TRUE(equal(dst.view(), before.view()));

    GuardedBits bits({5, 4}), found({5, 4}), smaller({5, 3}), as_it_was({5, 4});
    BitWord words[8];
    const Span<BitWord> room(words);
    EXPECT_EQ(hit_or_miss(BitView<const BitWord>(), hit, none, room, found.view()), Status::empty_image);
    EXPECT_EQ(hit_or_miss(bits.view(), hit, none, room, BitView<BitWord>()), Status::empty_image);
    EXPECT_EQ(hit_or_miss(bits.view(), hit, none, room, smaller.view()), Status::size_mismatch);
    EXPECT_EQ(hit_or_miss(bits.view(), none, none, room, found.view()), Status::bad_argument);
    EXPECT_EQ(hit_or_miss(bits.view(), hit, StructuringElement::disc(5), room, found.view()),
              Status::bad_argument);
    EXPECT_EQ(hit_or_miss(bits.view(), hit, none, room.first(2), found.view()), Status::scratch_too_small);
    EXPECT_TRUE(found == as_it_was);
}

}  // namespace
}  // namespace fovea::test
