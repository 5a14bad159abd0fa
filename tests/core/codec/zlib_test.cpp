// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/zlib.hpp>

#include "lossless_files.hpp"

namespace fovea::test {
namespace {

std::uint32_t adler_of(const Bytes& bytes) {
    Adler32 sum;
    sum.add(view_of(bytes));
    return sum.value();
}

TEST(Adler32, EqualsKnownValues) {
    EXPECT_EQ(adler_of({}), 1u);
    EXPECT_EQ(adler_of(bytes_of("a")), 0x00620062u);
    EXPECT_EQ(adler_of(bytes_of("Wikipedia")), 0x11e60398u);
}

TEST(Adler32, DoesNotOverflowOnLongRunsOfTheLargestByte) {
    const Bytes bytes(1000003, 255);
    std::uint64_t first = 1;
    std::uint64_t second = 0;
    for (const std::uint8_t byte : bytes) {
        first = (first + byte) % 65521;
        second = (second + first) % 65521;
    }
    EXPECT_EQ(adler_of(bytes), second << 16 | first);
}

TEST(Adler32, DoesNotCareHowTheBytesAreCut) {
    Random random(1);
    Bytes bytes(20000);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.below(256));
    Adler32 sum;
    for (std::ptrdiff_t at = 0; at < 20000;) {
        const std::ptrdiff_t run = minimum<std::ptrdiff_t>(random.between(0, 7000), 20000 - at);
        sum.add(view_of(bytes).from(at).first(run));
        at += run;
    }
    EXPECT_EQ(sum.value(), adler_of(bytes));
}

TEST(PackedNumbers, StandInBytesOfAnyAlignmentTheLowerByteFirst) {
    std::uint8_t bytes[8] = {};
    const PackedNumbers numbers(bytes + 1);
    numbers.put(0, 0x1234);
    numbers.put(2, 0xffff);
    EXPECT_EQ(numbers[0], 0x1234u);
    EXPECT_EQ(numbers[1], 0u);
    EXPECT_EQ(numbers[2], 0xffffu);
    EXPECT_EQ(bytes[1], 0x34);
    EXPECT_EQ(bytes[2], 0x12);
}

TEST(Deflate, EveryLengthAndDistanceFallsIntoTheRangeOfItsSymbol) {
    for (int length = 0; length <= Deflate::longest_match - Deflate::shortest_match; ++length) {
        const int symbol = Deflate::length_symbol(length);
        ASSERT_LT(symbol, Deflate::length_codes);
        const int extra = length - Deflate::length_base[symbol];
        ASSERT_GE(extra, 0) << length;
        ASSERT_LT(extra, 1 << Deflate::length_bits[symbol]) << length;
    }
    EXPECT_EQ(Deflate::length_symbol(255), 28);
    for (int distance = 0; distance < Deflate::window_bytes; ++distance) {
        const int symbol = Deflate::distance_symbol(distance);
        ASSERT_LT(symbol, Deflate::distances);
        const int extra = distance - Deflate::distance_base[symbol];
        ASSERT_GE(extra, 0) << distance;
        ASSERT_LT(extra, 1 << Deflate::distance_bits(symbol)) << distance;
    }
}

}  // namespace
}  // namespace fovea::test
