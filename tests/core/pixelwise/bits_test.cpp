// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/pixelwise/arithmetic.hpp>
#include <fovea/pixelwise/bits.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <support/guarded_bits.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

TEST(PackBits, ByHand) {
    GuardedImage<Gray8> src({5, 1});
    const Gray8 row[] = {0, 1, 100, 99, 255};
    for (int x = 0; x < 5; ++x) src(x, 0) = row[x];
    GuardedBits bits({5, 1});
    ASSERT_EQ(pack_bits(src.view(), bits.view()), Status::ok);
    EXPECT_EQ(bits.view().row(0)[0], 0b11110u);
    ASSERT_EQ(pack_bits(src.view(), 100, bits.view()), Status::ok);
    EXPECT_EQ(bits.view().row(0)[0], 0b10100u);
    ASSERT_EQ(pack_bits(src.view(), 0, bits.view()), Status::ok);
    EXPECT_EQ(bits.view().row(0)[0], 0b11111u);
}

TEST(PackBits, IsThresholdAndUnpackBitsBringsItBack) {
    Random random(91);
    for (const Size size : bit_sizes()) {
        GuardedImage<Gray8> src(size), binary(size), back(size);
        src.fill(random);
        GuardedBits bits(size);
        for (const int level : {0, 1, 128, 255}) {
            const auto limit = static_cast<Gray8>(level);
            ASSERT_EQ(threshold(src.view(), limit, binary.view()), Status::ok);
            ASSERT_EQ(pack_bits(src.view(), limit, bits.view()), Status::ok);
            ASSERT_TRUE(equal(bits, binary.view()));
            ASSERT_EQ(unpack_bits(bits.view(), back.view()), Status::ok);
            ASSERT_TRUE(equal(back.view(), binary.view()));
        }
    }
}

TEST(BitwiseOfBits, AreThoseOfBytes) {
    Random random(92);
    for (const Size size : bit_sizes()) {
        GuardedBits a(size), b(size), dst(size);
        GuardedImage<Gray8> wide_a(size), wide_b(size), wide(size), inverse(size);
        a.fill(random, 128);
        b.fill(random, 200);
        ASSERT_EQ(unpack_bits(a.view(), wide_a.view()), Status::ok);
        ASSERT_EQ(unpack_bits(b.view(), wide_b.view()), Status::ok);
        ASSERT_EQ(bitwise_and(a.view(), b.view(), dst.view()), Status::ok);
        ASSERT_EQ(bitwise_and(wide_a.view(), wide_b.view(), wide.view()), Status::ok);
        ASSERT_TRUE(equal(dst, wide.view()));
        ASSERT_EQ(bitwise_or(a.view(), b.view(), dst.view()), Status::ok);
        ASSERT_EQ(bitwise_or(wide_a.view(), wide_b.view(), wide.view()), Status::ok);
        ASSERT_TRUE(equal(dst, wide.view()));
        ASSERT_EQ(bitwise_xor(a.view(), b.view(), dst.view()), Status::ok);
        ASSERT_EQ(bitwise_xor(wide_a.view(), wide_b.view(), wide.view()), Status::ok);
        ASSERT_TRUE(equal(dst, wide.view()));
        ASSERT_EQ(invert(b.view(), dst.view()), Status::ok);
        ASSERT_EQ(invert(wide_b.view(), inverse.view()), Status::ok);
        ASSERT_TRUE(equal(dst, inverse.view()));
        ASSERT_EQ(bitwise_and_not(a.view(), b.view(), a.view()), Status::ok);
        ASSERT_EQ(bitwise_and(wide_a.view(), inverse.view(), wide.view()), Status::ok);
        ASSERT_TRUE(equal(a, wide.view()));
    }
}

TEST(CountBits, CountsPixelsAlone) {
    Random random(93);
    for (const Size size : bit_sizes()) {
        GuardedBits bits(size);
        bits.fill(random, 100);
        std::int64_t count = 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) count += bits(x, y) ? 1 : 0;
        ASSERT_EQ(*count_bits(bits.view()), count);
    }
    EXPECT_EQ(count_bits({}).status(), Status::empty_image);
    const std::vector<BitWord> row(1024, ~BitWord{0});
    EXPECT_EQ(*count_bits({row.data(), {32767, 32767}, 0}), std::int64_t{32767} * 32767);
}

TEST(BitOperators, LeaveTheOutputWhenTheyCannotRun) {
    GuardedBits bits({5, 4}), dst({5, 3}), before({5, 3});
    GuardedImage<Gray8> src({5, 4}), small({5, 3});
    src.fill(7);
    small.fill(9);
    const BitView<BitWord> none;
    EXPECT_EQ(pack_bits(src.view(), dst.view()), Status::size_mismatch);
    EXPECT_EQ(pack_bits(src.view(), none), Status::empty_image);
    EXPECT_EQ(pack_bits(ImageView<const Gray8>(), dst.view()), Status::empty_image);
    EXPECT_EQ(unpack_bits(bits.view(), small.view()), Status::size_mismatch);
    EXPECT_EQ(unpack_bits(none, small.view()), Status::empty_image);
    EXPECT_EQ(unpack_bits(bits.view(), ImageView<Gray8>()), Status::empty_image);
    EXPECT_EQ(bitwise_and(bits.view(), bits.view(), dst.view()), Status::size_mismatch);
    EXPECT_EQ(bitwise_or(bits.view(), dst.view(), bits.view()), Status::size_mismatch);
    EXPECT_EQ(bitwise_xor(none, bits.view(), dst.view()), Status::empty_image);
    EXPECT_EQ(invert(bits.view(), none), Status::empty_image);
    EXPECT_TRUE(dst == before);
}

}  // namespace
}  // namespace fovea::test
