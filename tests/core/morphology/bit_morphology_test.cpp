// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/morphology/bit_morphology.hpp>
#include <fovea/morphology/shaped_morphology.hpp>
#include <fovea/pixelwise/bits.hpp>
#include <support/guarded_bits.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

/// Room between two words that must survive.
struct Scratch {
    std::vector<BitWord> words;

    explicit Scratch(Size size) : words(static_cast<std::size_t>(bit_erode_scratch(size)) + 1, 0xdeadbeefu) {}
    ~Scratch() { EXPECT_EQ(words.back(), 0xdeadbeefu); }
    Span<BitWord> span() { return {words.data(), static_cast<std::ptrdiff_t>(words.size()) - 1}; }
};

TEST(ErodeBits, ByHand) {
    GuardedBits src({6, 3}), dst({6, 3});
    Scratch scratch({6, 3});
    for (int y = 0; y < 3; ++y) src.view().row(y)[0] = 0b111101u;
    ASSERT_EQ(erode(src.view(), {3, 3}, scratch.span(), dst.view()), Status::ok);
    for (int y = 0; y < 3; ++y)
        EXPECT_EQ(dst.view().row(y)[0], 0b111000u);  // the left end of the row counts not
    ASSERT_EQ(dilate(src.view(), {3, 1}, scratch.span(), dst.view()), Status::ok);
    EXPECT_EQ(dst.view().row(1)[0], 0b111111u);
    src.view().row(1)[0] = 0b010000u;
    ASSERT_EQ(erode_cross(src.view(), {1, 3}, scratch.span(), dst.view()), Status::ok);
    EXPECT_EQ(dst.view().row(0)[0], 0b010000u);
}

TEST(ErodeBits, EqualsTheBytesBitForBit) {
    Random random(94);
    for (const Size size : bit_sizes())
        for (const Size element : {Size{1, 1}, Size{3, 3}, Size{5, 3}, Size{7, 1}, Size{1, 5}, Size{9, 9},
                                   Size{15, 15}, Size{31, 33}, Size{33, 5}, Size{61, 3}, Size{63, 63}})
            for (const std::uint32_t share : {0u, 6u, 128u, 250u, 256u}) {
                GuardedBits src(size), dst(size);
                GuardedImage<Gray8> wide(size), expected(size);
                src.fill(random, share);
                ASSERT_EQ(unpack_bits(src.view(), wide.view()), Status::ok);
                std::vector<std::uint8_t> bytes(static_cast<std::size_t>(erode_scratch(size)));
                const Span<std::uint8_t> room(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()));
                Scratch scratch(size);
                ASSERT_EQ(erode(src.view(), element, scratch.span(), dst.view()), Status::ok);
                ASSERT_EQ(erode(wide.view(), element, room, expected.view()), Status::ok);
                ASSERT_TRUE(equal(dst, expected.view())) << size.width << " by " << element.width;
                ASSERT_EQ(dilate(src.view(), element, scratch.span(), dst.view()), Status::ok);
                ASSERT_EQ(dilate(wide.view(), element, room, expected.view()), Status::ok);
                ASSERT_TRUE(equal(dst, expected.view())) << size.width << " by " << element.width;
            }
}

TEST(ErodeCross, EqualsTheBytesBitForBit) {
    Random random(95);
    for (const Size size : bit_sizes())
        for (const Size side : {Size{1, 1}, Size{3, 3}, Size{5, 1}, Size{31, 9}}) {
            const StructuringElement element = StructuringElement::cross(side);
            GuardedBits src(size), dst(size);
            GuardedImage<Gray8> wide(size), expected(size);
            src.fill(random, 170);
            ASSERT_EQ(unpack_bits(src.view(), wide.view()), Status::ok);
            std::vector<std::uint8_t> bytes(static_cast<std::size_t>(erode_scratch(size, element)));
            const Span<std::uint8_t> room(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()));
            Scratch scratch(size);
            ASSERT_EQ(erode_cross(src.view(), side, scratch.span(), dst.view()), Status::ok);
            ASSERT_EQ(erode(wide.view(), element, room, expected.view()), Status::ok);
            ASSERT_TRUE(equal(dst, expected.view()));
            ASSERT_EQ(dilate_cross(src.view(), side, scratch.span(), dst.view()), Status::ok);
            ASSERT_EQ(dilate(wide.view(), element, room, expected.view()), Status::ok);
            ASSERT_TRUE(equal(dst, expected.view()));
        }
}

TEST(ErodeBits, IsTheInverseOfDilationOfTheInverse) {
    Random random(96);
    const Size size{131, 40};
    GuardedBits src(size), inverse(size), eroded(size), dilated(size);
    src.fill(random, 220);
    Scratch scratch(size);
    ASSERT_EQ(invert(src.view(), inverse.view()), Status::ok);
    ASSERT_EQ(erode(src.view(), {5, 3}, scratch.span(), eroded.view()), Status::ok);
    ASSERT_EQ(dilate(inverse.view(), {5, 3}, scratch.span(), dilated.view()), Status::ok);
    ASSERT_EQ(invert(dilated.view(), dilated.view()), Status::ok);
    EXPECT_TRUE(eroded == dilated);
}

TEST(ErodeBits, LeavesTheOutputWhenItCannotRun) {
    GuardedBits src({5, 4}), dst({5, 4}), small({5, 3}), before({5, 4});
    Scratch scratch({5, 4});
    using Operator = Status (*)(BitView<const BitWord>, Size, Span<BitWord>, BitView<BitWord>);
    for (const Operator op :
         {Operator(erode), Operator(dilate), Operator(erode_cross), Operator(dilate_cross)}) {
        EXPECT_EQ(op({}, {3, 3}, scratch.span(), dst.view()), Status::empty_image);
        EXPECT_EQ(op(src.view(), {3, 3}, scratch.span(), {}), Status::empty_image);
        EXPECT_EQ(op(src.view(), {3, 3}, scratch.span(), small.view()), Status::size_mismatch);
        for (const Size element : {Size{2, 3}, Size{3, 4}, Size{0, 3}, Size{-1, 3}, Size{65, 1}, Size{1, 65}})
            EXPECT_EQ(op(src.view(), element, scratch.span(), dst.view()), Status::bad_argument);
        EXPECT_EQ(op(src.view(), {3, 3}, scratch.span().first(2), dst.view()), Status::scratch_too_small);
    }
    EXPECT_TRUE(dst == before);
}

}  // namespace
}  // namespace fovea::test
