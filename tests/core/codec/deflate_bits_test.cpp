// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/codec/deflate_bits.hpp>

#include "lossless_files.hpp"

namespace fovea::test {
namespace {

TEST(DeflateBitWriter, PutsTheFirstBitLowest) {
    Bytes file(3, 0xa5);
    DeflateBitWriter out(room_in(file));
    out.put(1, 1);
    out.put(0b10, 2);
    EXPECT_EQ(out.begun_bits(), 3);
    out.put(0x1ff, 9);
    EXPECT_EQ(out.align(), 2);
    EXPECT_EQ(out.begun_bits(), 0);
    EXPECT_EQ(file, (Bytes{0b11111101, 0b00001111, 0xa5}));
}

TEST(DeflateBitWriter, KnowsToTheBitWhatFits) {
    Bytes file(2);
    DeflateBitWriter out(room_in(file));
    EXPECT_TRUE(out.has_room(16));
    EXPECT_FALSE(out.has_room(17));
    out.put(0, 3);
    EXPECT_TRUE(out.has_room(13));
    EXPECT_FALSE(out.has_room(14));
    EXPECT_EQ(out.align(), 1);
    EXPECT_TRUE(out.has_room(8));
    EXPECT_FALSE(out.has_room(9));
}

TEST(DeflateBits, AreReadAsTheyWereWritten) {
    Random random(1);
    for (int round = 0; round < 50; ++round) {
        std::vector<std::pair<std::uint32_t, int>> numbers(random.below(300));
        Bytes file(700);
        DeflateBitWriter out(room_in(file));
        for (auto& [value, count] : numbers) {
            count = random.between(0, 16);
            value = random.next() & ((1u << count) - 1);
            out.put(value, count);
        }
        file.resize(static_cast<std::size_t>(out.align()));
        OnePiece source(view_of(file));
        DeflateBitReader<OnePiece> in(source);
        for (const auto& [value, count] : numbers) {
            in.fill();
            ASSERT_GE(in.count(), count);
            ASSERT_EQ(in.take(count), value);
        }
        EXPECT_EQ(in.next_byte(), -1);
    }
}

TEST(DeflateBitReader, HandsOutWholeBytesBehindBits) {
    Bytes file(100);
    for (std::size_t i = 0; i < file.size(); ++i) file[i] = static_cast<std::uint8_t>(i + 1);
    for (int bits = 0; bits <= 9; ++bits) {
        OnePiece source(view_of(file));
        DeflateBitReader<OnePiece> in(source);
        in.fill();
        static_cast<void>(in.take(bits));
        const int first = (bits + 7) / 8 + 1;
        ASSERT_EQ(in.next_byte(), first);
        Bytes copied(200);
        ASSERT_EQ(in.copy_bytes(copied.data(), 2), 2);
        EXPECT_EQ(copied[0], first + 1);
        const int rest = 100 - first - 2;
        ASSERT_EQ(in.copy_bytes(copied.data(), 200), rest);
        EXPECT_EQ(copied[0], first + 3);
        EXPECT_EQ(copied[static_cast<std::size_t>(rest) - 1], 100);
        EXPECT_EQ(in.copy_bytes(copied.data(), 200), 0);
        EXPECT_EQ(in.next_byte(), -1);
    }
}

TEST(DeflateBitReader, GoesOnWithBitsAfterCopiedBytes) {
    Bytes file(60);
    for (std::size_t i = 0; i < file.size(); ++i) file[i] = static_cast<std::uint8_t>(7 * i);
    OnePiece source(view_of(file));
    DeflateBitReader<OnePiece> in(source);
    in.fill();
    EXPECT_EQ(in.next_byte(), 0);
    Bytes copied(30);
    ASSERT_EQ(in.copy_bytes(copied.data(), 30), 30);
    for (int at = 31; at < 60; ++at) {
        in.fill();
        ASSERT_EQ(in.take(8), static_cast<std::uint32_t>(7 * at & 0xff));
    }
}

}  // namespace
}  // namespace fovea::test
