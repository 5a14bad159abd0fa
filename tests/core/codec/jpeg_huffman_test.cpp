// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <core/codec/jpeg_file.hpp>
#include <fovea/base/random.hpp>
#include <fovea/codec/jpeg_huffman.hpp>
#include <fovea/codec/jpeg_tables.hpp>

namespace fovea::test {
namespace {

/// The same bits one at a time: what peek() and skip() must give.
std::string naive_bits(const Bytes& bytes) {
    std::string bits;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (bytes[i] == 0xff) {
            if (i + 1 == bytes.size() || bytes[i + 1] != 0) break;
            bits += "11111111";
            ++i;
            continue;
        }
        for (int bit = 7; bit >= 0; --bit) bits += (bytes[i] >> bit & 1) != 0 ? '1' : '0';
    }
    return bits;
}

TEST(BitReader, TakesOutStuffedZerosAndStopsAtAMarker) {
    const Bytes bytes = {0xa5, 0xff, 0x00, 0x3c, 0xff, 0xd9, 0x12};
    jpeg::BitReader bits(span_of(bytes));
    bits.fill(16);
    EXPECT_EQ(bits.peek(16), 0xa5ffu);
    bits.skip(16);
    bits.fill(16);
    EXPECT_EQ(bits.peek(16), 0x3c00u);
    bits.skip(8);
    EXPECT_FALSE(bits.overrun());
    ASSERT_TRUE(bits.marker_behind());
    EXPECT_EQ(bits.marker_behind()->size(), 3);
    bits.skip(1);
    EXPECT_TRUE(bits.overrun());
    EXPECT_EQ(bits.overrun_status(), Status::malformed);
}

TEST(BitReader, SaysTruncatedWhereTheBytesEnd) {
    for (const Bytes& bytes : {Bytes{}, Bytes{0x12}, Bytes{0x12, 0xff}}) {
        jpeg::BitReader bits(span_of(bytes));
        bits.fill(16);
        bits.skip(16);
        EXPECT_TRUE(bits.overrun());
        EXPECT_EQ(bits.overrun_status(), Status::truncated);
    }
}

TEST(BitReader, WantsNoMoreThanPaddingInFrontOfAMarker) {
    const Bytes bytes = {0x12, 0x34, 0xff, 0xff, 0xd9};
    for (int used = 0; used <= 16; ++used) {
        jpeg::BitReader bits(span_of(bytes));
        if (used > 0) {
            bits.fill(16);
            bits.skip(used);
        }
        EXPECT_EQ(bits.marker_behind().ok(), used > 8) << used;
    }
}

TEST(BitReader, EqualsTheReferenceOnRandomBytesAndSteps) {
    Random random(43);
    for (int round = 0; round < 2000; ++round) {
        Bytes bytes(random.below(60));
        for (std::uint8_t& byte : bytes) {
            // Many 0xff and 0x00, so that stuffing and markers come at every place of a window.
            const std::uint32_t kind = random.below(6);
            byte = kind == 0 ? 0xff : kind == 1 ? 0 : static_cast<std::uint8_t>(random.next());
        }
        const std::string expected = naive_bits(bytes);
        jpeg::BitReader bits(span_of(bytes));
        std::size_t at = 0;
        while (at <= expected.size()) {
            const int step = random.between(1, 16);
            bits.fill(step);
            std::uint32_t value = 0;
            for (int i = 0; i < step; ++i, ++at)
                value = value << 1 | (at < expected.size() && expected[at] == '1' ? 1u : 0u);
            ASSERT_EQ(bits.peek(step), value) << "round " << round << " bit " << at;
            bits.skip(step);
            ASSERT_EQ(bits.overrun(), at > expected.size());
        }
    }
}

TEST(ReadCode, TakesTheBytesThatBelongToIt) {
    Bytes bytes(jpeg::standard_luma_ac, jpeg::standard_luma_ac + sizeof jpeg::standard_luma_ac);
    EXPECT_EQ(bytes.size(), 16u + 162);
    bytes.push_back(1);
    const Result<Span<const std::uint8_t>> code = jpeg::read_code(span_of(bytes));
    ASSERT_TRUE(code);
    EXPECT_EQ(code->size(), 16 + 162);
}

TEST(ReadCode, RefusesWhatIsNoCode) {
    EXPECT_EQ(jpeg::read_code(span_of(Bytes(15))).status(), Status::malformed);
    Bytes missing_symbol(16);
    missing_symbol[3] = 1;
    EXPECT_EQ(jpeg::read_code(span_of(missing_symbol)).status(), Status::malformed);
    Bytes three_of_one_bit(16 + 3);
    three_of_one_bit[0] = 3;
    EXPECT_EQ(jpeg::read_code(span_of(three_of_one_bit)).status(), Status::malformed);
    Bytes four_of_two_bits_behind_one(16 + 5);
    four_of_two_bits_behind_one[0] = 1;
    four_of_two_bits_behind_one[1] = 4;
    EXPECT_EQ(jpeg::read_code(span_of(four_of_two_bits_behind_one)).status(), Status::malformed);
    Bytes a_word_of_all_ones(16 + 2);
    a_word_of_all_ones[0] = 2;
    EXPECT_EQ(jpeg::read_code(span_of(a_word_of_all_ones)).status(), Status::malformed);
    Bytes symbols_257(16 + 257);
    symbols_257[14] = 255;
    symbols_257[15] = 2;
    EXPECT_EQ(jpeg::read_code(span_of(symbols_257)).status(), Status::malformed);
}

TEST(HuffmanTable, DecodesTheWordsOfTableK3) {
    // T.81 Table K.3: category 0 is 00, 1 is 010, 5 is 110, 11 is 111111110.
    JpegFile file;
    file.bytes.clear();
    file.bits("00 010 110 111111110").pad();
    jpeg::HuffmanTable table;
    table.build(jpeg::standard_dc_code[0]);
    jpeg::BitReader bits(span_of(file.bytes));
    for (const int category : {0, 1, 5, 11}) {
        bits.fill(jpeg::max_code_bits);
        EXPECT_EQ(table.decode(bits), category);
    }
}

/// Every word of a code, one after the other, as '0' and '1': T.81 Annex C.
std::vector<std::string> naive_words(Span<const std::uint8_t> code) {
    std::vector<std::string> words;
    unsigned word = 0;
    for (int length = 1; length <= 16; ++length, word <<= 1)
        for (int i = 0; i < code[length - 1]; ++i, ++word) {
            std::string text;
            for (int bit = length - 1; bit >= 0; --bit) text += (word >> bit & 1) != 0 ? '1' : '0';
            words.push_back(text);
        }
    return words;
}

void expect_every_word_decodes(Span<const std::uint8_t> code) {
    jpeg::HuffmanTable table;
    table.build(code);
    const std::vector<std::string> words = naive_words(code);
    for (std::size_t i = 0; i < words.size(); ++i)
        for (const char* tail : {"0000000000000000", "1111111111111111"}) {
            JpegFile file;
            file.bytes.clear();
            file.bits((words[i] + tail).c_str()).pad();
            jpeg::BitReader bits(span_of(file.bytes));
            bits.fill(jpeg::max_code_bits);
            ASSERT_EQ(table.decode(bits), code[16 + static_cast<std::ptrdiff_t>(i)]) << words[i];
            bits.fill(jpeg::max_code_bits);
            ASSERT_EQ(bits.peek(1), tail[0] == '1' ? 1u : 0u);
        }
}

TEST(HuffmanTable, DecodesEveryWordOfTheStandardCodes) {
    for (int i = 0; i < 2; ++i) {
        expect_every_word_decodes(jpeg::standard_dc_code[i]);
        expect_every_word_decodes(jpeg::standard_ac_code[i]);
    }
}

TEST(HuffmanTable, DecodesRandomCodesAndKnowsWhatIsNoWord) {
    Random random(44);
    for (int round = 0; round < 300; ++round) {
        Bytes code(16);
        int room = 1;
        int words = 0;
        for (std::size_t length = 0; length < 16; ++length) {
            room *= 2;
            const int most = std::min(std::min(room - 1, 255), 256 - words);
            code[length] = static_cast<std::uint8_t>(random.between(0, std::min(most, 20)));
            room -= code[length];
            words += code[length];
        }
        for (int i = 0; i < words; ++i) code.push_back(static_cast<std::uint8_t>(random.next()));
        ASSERT_TRUE(jpeg::read_code(span_of(code)));
        expect_every_word_decodes(span_of(code));
        // The word of all ones stays free, so sixteen ones are none.
        jpeg::HuffmanTable table;
        table.build(span_of(code));
        const Bytes ones = {0xff, 0x00, 0xff, 0x00};
        jpeg::BitReader bits(span_of(ones));
        bits.fill(jpeg::max_code_bits);
        ASSERT_EQ(table.decode(bits), -1);
    }
}

}  // namespace
}  // namespace fovea::test
