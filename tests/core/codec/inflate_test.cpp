// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "inflating.hpp"
#include "lossless_files.hpp"

namespace fovea::test {
namespace {

/// Bits as deflate packs them, first bit lowest.
class BitString {
public:
    /// A number, lowest bit first.
    BitString& number(std::uint32_t value, int count) {
        for (int i = 0; i < count; ++i) bits_.push_back(value >> i & 1);
        return *this;
    }
    /// A prefix code as it is written down, first bit first.
    BitString& code(const std::string& digits) {
        for (const char digit : digits) bits_.push_back(digit == '1');
        return *this;
    }
    /// Whole bytes from the next byte on.
    BitString& bytes(const Bytes& more) {
        while (bits_.size() % 8 != 0) bits_.push_back(false);
        for (const std::uint8_t byte : more) number(byte, 8);
        return *this;
    }
    /// The head of a block: the last one or not, and its kind.
    BitString& block(std::uint32_t last, std::uint32_t kind) { return number(last, 1).number(kind, 2); }
    /// A literal of the fixed code, below 144.
    BitString& fixed_literal(char literal) {
        const int code = 0x30 + literal;
        for (int bit = 7; bit >= 0; --bit) bits_.push_back((code >> bit & 1) != 0);
        return *this;
    }
    BitString& fixed_end() { return code("0000000"); }

    Bytes packed() const {
        Bytes result((bits_.size() + 7) / 8);
        for (std::size_t i = 0; i < bits_.size(); ++i)
            if (bits_[i]) result[i / 8] |= static_cast<std::uint8_t>(1 << i % 8);
        return result;
    }

private:
    std::vector<bool> bits_;
};

std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

// ---- Blocks by hand ---------------------------------------------------------------

TEST(Inflate, ReadsAStoredBlock) {
    const Inflated read =
        inflate_raw(BitString().block(1, 0).bytes({3, 0, 0xfc, 0xff, 'a', 'b', 'c'}).packed());
    EXPECT_EQ(read.status, Status::ok);
    EXPECT_EQ(text_of(read.data), "abc");
}

TEST(Inflate, ReadsTheFixedCode) {
    // "ab", then five bytes from a distance of 2: length symbol 259, distance symbol 1.
    const Bytes bytes = BitString()
                            .block(1, 1)
                            .fixed_literal('a')
                            .fixed_literal('b')
                            .code("0000011")
                            .code("00001")
                            .fixed_end()
                            .packed();
    const Inflated read = inflate_raw(bytes);
    EXPECT_EQ(read.status, Status::ok);
    EXPECT_EQ(text_of(read.data), "abababa");
}

TEST(Inflate, ReadsTheLongestMatchAndTheHighLiterals) {
    // Literal 255 has nine bits; symbol 285 is 258 bytes long and has no extra bits.
    const Bytes bytes =
        BitString().block(1, 1).code("111111111").code("11000101").code("00000").fixed_end().packed();
    const Inflated read = inflate_raw(bytes);
    EXPECT_EQ(read.status, Status::ok);
    EXPECT_EQ(read.data, Bytes(259, 255));
}

/// The head of a block with codes of its own: a 1, b 2, end of block 2 bits, and distance symbol 0 one bit.
BitString& own_codes(BitString& bits) {
    bits.block(1, 2).number(0, 5).number(0, 5).number(14, 4);
    // Lengths 1 and 2 get two bits, 18 one; in the order 16 17 18 0 8 7 9 6 10 5 11 4 12 3 13 2 14 1.
    for (const std::uint32_t length :
         {0u, 0u, 1u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 2u, 0u, 2u})
        bits.number(length, 3);
    const std::string one = "10";
    const std::string two = "11";
    const std::string gap = "0";
    // 97 zeros, a, b, 157 zeros in two runs, end of block; then the distance.
    bits.code(gap)
        .number(97 - 11, 7)
        .code(one)
        .code(two)
        .code(gap)
        .number(138 - 11, 7)
        .code(gap)
        .number(19 - 11, 7);
    return bits.code(two).code(one);
}

TEST(Inflate, ReadsABlockWithCodesOfItsOwn) {
    BitString bits;
    own_codes(bits).code("0").code("10").code("0").code("11");
    const Inflated read = inflate_raw(bits.packed());
    EXPECT_EQ(read.status, Status::ok);
    EXPECT_EQ(text_of(read.data), "aba");
}

TEST(Inflate, ReadsSeveralBlocksEmptyOnesToo) {
    BitString bits;
    bits.block(0, 0)
        .bytes({0, 0, 0xff, 0xff})
        .block(0, 1)
        .fixed_end()
        .block(0, 1)
        .fixed_literal('x')
        .fixed_end();
    own_codes(bits).code("0").code("11");
    const Inflated read = inflate_raw(bits.packed());
    EXPECT_EQ(read.status, Status::ok);
    EXPECT_EQ(text_of(read.data), "xa");
}

TEST(Inflate, RefusesWhatTheFormatForbids) {
    const auto status = [](BitString& bits) { return inflate_raw(bits.bytes(Bytes(8)).packed()).status; };
    BitString reserved_kind, wrong_length, symbol_286, distance_30, before_the_start;
    EXPECT_EQ(status(reserved_kind.block(1, 3)), Status::malformed);
    EXPECT_EQ(status(wrong_length.block(1, 0).bytes({3, 0, 0xfc, 0xfe})), Status::malformed);
    EXPECT_EQ(status(symbol_286.block(1, 1).code("11000110")), Status::malformed);
    EXPECT_EQ(status(distance_30.block(1, 1).fixed_literal('a').code("0000001").code("11110")),
              Status::malformed);
    EXPECT_EQ(status(before_the_start.block(1, 1).fixed_literal('a').code("0000001").code("00001")),
              Status::malformed);
}

/// A block with codes of its own whose lengths are sent with a code for all 19 symbols: 0 to 12 have four
/// bits, 13 to 18 have five, which is complete.
class LengthsBlock {
public:
    LengthsBlock(int literals, int distances) {
        bits_.block(1, 2);
        bits_.number(static_cast<std::uint32_t>(literals - 257), 5);
        bits_.number(static_cast<std::uint32_t>(distances - 1), 5).number(15, 4);
        for (const int symbol : {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15})
            bits_.number(symbol < 13 ? 4 : 5, 3);
    }
    LengthsBlock& length(int symbol) {
        // 13 codes of four bits from 0000 on, then six of five bits from 11010 on.
        const int code = symbol < 13 ? symbol : 26 + symbol - 13;
        for (int bit = symbol < 13 ? 3 : 4; bit >= 0; --bit) bits_.code((code >> bit & 1) != 0 ? "1" : "0");
        return *this;
    }
    LengthsBlock& zeros(int count) {
        for (int i = 0; i < count; ++i) length(0);
        return *this;
    }
    LengthsBlock& extra(std::uint32_t value, int count) {
        bits_.number(value, count);
        return *this;
    }
    Inflated inflated(const std::string& codes = "") {
        bits_.code(codes);
        return inflate_raw(bits_.bytes(Bytes(8)).packed());
    }

private:
    BitString bits_;
};

TEST(Inflate, RefusesCodesThatAreNotComplete) {
    // A literal and the end of block of one bit each are complete; two bits and one are not, nor three of
    // one.
    const auto status = [](int a, int b, int end) {
        LengthsBlock block(257, 1);
        return block.length(a).length(b).zeros(254).length(end).length(1).inflated("1").status;
    };
    EXPECT_EQ(status(1, 0, 1), Status::ok);
    EXPECT_EQ(status(2, 0, 1), Status::malformed);
    EXPECT_EQ(status(2, 0, 2), Status::malformed);
    EXPECT_EQ(status(1, 1, 1), Status::malformed);
    EXPECT_EQ(status(1, 1, 15), Status::malformed);
    // No end of block.
    EXPECT_EQ(status(1, 1, 0), Status::malformed);
}

TEST(Inflate, AllowsASingleCodeOfOneBitAndRefusesItsGap) {
    LengthsBlock whole(257, 1);
    EXPECT_EQ(whole.zeros(256).length(1).length(0).inflated("0").status, Status::ok);
    LengthsBlock gap(257, 1);
    EXPECT_EQ(gap.zeros(256).length(1).length(0).inflated("1").status, Status::malformed);
    LengthsBlock long_single(257, 1);
    EXPECT_EQ(long_single.zeros(256).length(2).length(0).inflated("00").status, Status::malformed);
}

TEST(Inflate, RefusesDistancesThatAreNotComplete) {
    const auto status = [](int first, int second, const std::string& codes) {
        // Literal 0 and a match of three bytes take two bits, end of block one.
        LengthsBlock block(258, 2);
        return block.length(2)
            .zeros(255)
            .length(1)
            .length(2)
            .length(first)
            .length(second)
            .inflated(codes)
            .status;
    };
    EXPECT_EQ(status(1, 1,
                     "10"
                     "11"
                     "0"
                     "0"),
              Status::ok);
    EXPECT_EQ(status(1, 0,
                     "10"
                     "11"
                     "0"
                     "0"),
              Status::ok);
    EXPECT_EQ(status(1, 0,
                     "10"
                     "11"
                     "1"
                     "0"),
              Status::malformed);
    EXPECT_EQ(status(0, 0,
                     "10"
                     "0"),
              Status::ok);
    EXPECT_EQ(status(0, 0,
                     "10"
                     "11"
                     "0"
                     "0"),
              Status::malformed);
    EXPECT_EQ(status(2, 1, "0"), Status::malformed);
    EXPECT_EQ(status(2, 0, "0"), Status::malformed);
}

TEST(Inflate, RefusesRunsOfLengthsThatHaveNoBeginningOrNoEnd) {
    LengthsBlock nothing_to_repeat(257, 1);
    EXPECT_EQ(nothing_to_repeat.length(16).extra(0, 2).zeros(300).inflated().status, Status::malformed);
    LengthsBlock too_long(257, 1);
    EXPECT_EQ(too_long.zeros(257).length(17).extra(0, 3).inflated().status, Status::malformed);
    LengthsBlock across(257, 2);
    EXPECT_EQ(across.zeros(255).length(1).length(1).length(16).extra(0, 2).inflated().status,
              Status::malformed);
    // A run may go on from the literals to the distances: here four of each have two bits.
    LengthsBlock both(257, 4);
    EXPECT_EQ(both.zeros(253).length(2).length(16).extra(3, 2).length(2).inflated("11").status, Status::ok);
    LengthsBlock right(257, 3);
    EXPECT_EQ(right.zeros(255).length(1).length(1).length(17).extra(0, 3).inflated("1").status, Status::ok);
}

TEST(Inflate, RefusesTooManySymbols) {
    EXPECT_EQ(LengthsBlock(287, 1).zeros(300).inflated().status, Status::malformed);
    EXPECT_EQ(LengthsBlock(257, 31).zeros(300).inflated().status, Status::malformed);
}

}  // namespace
}  // namespace fovea::test
