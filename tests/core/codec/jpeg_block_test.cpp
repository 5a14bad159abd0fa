// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include <core/codec/jpeg_file.hpp>
#include <fovea/base/random.hpp>
#include <fovea/codec/jpeg_block.hpp>
#include <fovea/codec/jpeg_huffman.hpp>
#include <fovea/codec/jpeg_tables.hpp>

namespace fovea::test {
namespace {

/// A quantiser of one step, the standard codes of luma, and what a test does with them.
struct Decoder {
    explicit Decoder(int step = 1) {
        dc_code.build(jpeg::standard_dc_code[0]);
        ac_code.build(jpeg::standard_ac_code[0]);
        quantiser.build(span_of(Bytes(64, static_cast<std::uint8_t>(step))));
    }
    Status decode(const Bytes& bytes) {
        jpeg::BitReader bits(span_of(bytes));
        return decode_block(bits, dc_code, ac_code, quantiser, dc, block);
    }
    /// What becomes of bits in front of the end of the image.
    Status decode_bits(const char* text) {
        JpegFile file;
        file.bytes.clear();
        return decode(file.bits(text).pad().marker(0xd9).bytes);
    }

    jpeg::HuffmanTable dc_code, ac_code;
    jpeg::Quantiser quantiser{};
    int dc = 0;
    jpeg::Block block{};
};

TEST(DecodeBlock, ReadsABlockWorkedByHand) {
    // T.81 Table K.3: 011 announces two bits, 10 is 2. Table K.5: 01 two bits at once, 00 is -3; 11111010 one
    // bit behind seven zeros, 1 is 1; 1010 ends the block.
    Decoder decoder(5);
    ASSERT_EQ(decoder.decode_bits("011 10  01 00  11111010 1  1010"), Status::ok);
    for (int i = 0; i < 64; ++i) {
        const int expected = i == 0 ? 10 : i == jpeg::zigzag[1] ? -15 : i == jpeg::zigzag[9] ? 5 : 0;
        EXPECT_EQ(decoder.block.coefficient[i], expected) << i;
    }
    EXPECT_EQ(decoder.dc, 2);
    EXPECT_EQ(decoder.block.used, jpeg::zigzag[1] | jpeg::zigzag[9]);
}

TEST(DecodeBlock, AddsTheDifferenceToTheBlockBefore) {
    Decoder decoder;
    decoder.dc = 40;
    ASSERT_EQ(decoder.decode_bits("010 0 1010"), Status::ok);  // 1 bit: 0 is -1
    EXPECT_EQ(decoder.block.coefficient[0], 39);
    EXPECT_EQ(decoder.block.used, 0);
}

TEST(DecodeBlock, ReadsWhatWasWritten) {
    Random random(49);
    for (int round = 0; round < 3000; ++round) {
        Decoder decoder(random.between(1, 3));
        Coefficients quantised(64);
        const std::uint32_t density = random.below(8) + 1;
        for (int& value : quantised)
            if (random.below(8) < density) value = random.between(-600, 600) >> random.below(10);
        decoder.dc = random.between(-300, 300);
        JpegFile file;
        file.bytes.clear();
        ASSERT_EQ(decoder.decode(file.block(quantised, decoder.dc, 0).pad().marker(0xd9).bytes), Status::ok);
        for (std::size_t k = 0; k < 64; ++k)
            ASSERT_EQ(decoder.block.coefficient[jpeg::zigzag[k]], quantised[k] * decoder.quantiser.step[k]);
        ASSERT_EQ(decoder.dc, quantised[0]);
    }
}

TEST(DecodeBlock, RefusesWhatCannotBeRight) {
    const char* const sixteen_zeros = "11111111001";
    const char* const dc_0 = "00";
    const auto text = [&](int runs, const char* behind) {
        std::string all = dc_0;
        for (int i = 0; i < runs; ++i) all += sixteen_zeros;
        return all + behind;
    };
    const auto status = [](const std::string& bits) { return Decoder().decode_bits(bits.c_str()); };
    // 00 is (0, 1), 1100 is (1, 1), 1111111111110101 is (15, 1).
    EXPECT_EQ(status(text(3, "1111111111110101 1")), Status::malformed) << "a coefficient behind the 63rd";
    EXPECT_EQ(status(text(3, "1111111111101011 1 00 1")), Status::ok) << "(14, 1) and the 63rd";
    EXPECT_EQ(status(text(3, sixteen_zeros)), Status::malformed)
        << "zeros to the end and nothing behind them";
    EXPECT_EQ(status("00 1111111111101011 1" + text(3, "").substr(2)), Status::malformed)
        << "(14, 1), and zeros that end with the 63rd";
    EXPECT_EQ(status(text(4, "")), Status::malformed);
    EXPECT_EQ(status("111111111 1111111"), Status::malformed) << "no word of the DC code";
    EXPECT_EQ(status("00 1111111111111111"), Status::malformed) << "no word of the AC code";
}

/// A code with one symbol, which is the word 0.
Bytes code_of(int symbol) {
    Bytes code(17);
    code[0] = 1;
    code[16] = static_cast<std::uint8_t>(symbol);
    return code;
}

TEST(DecodeBlock, RefusesValuesOfMoreBitsThanEightBitSamplesGive) {
    for (int size = 0; size < 16; ++size) {
        Decoder decoder;
        const Bytes code = code_of(size);
        decoder.dc_code.build(span_of(code));
        const std::string bits = "0" + std::string(static_cast<std::size_t>(size), '0') + "1010";
        EXPECT_EQ(decoder.decode_bits(bits.c_str()), size <= 11 ? Status::ok : Status::malformed) << size;
    }
    Decoder high;
    high.dc = 2000;
    const Bytes twelve_bits = code_of(12);
    high.dc_code.build(span_of(twelve_bits));
    EXPECT_EQ(high.decode_bits("0 011111111111 1010"), Status::malformed) << "-2048, though 2000 goes before";
    for (int symbol = 1; symbol < 256; ++symbol) {
        Decoder decoder;
        const Bytes code = code_of(symbol);
        decoder.ac_code.build(span_of(code));
        const int size = symbol & 15;
        const int places = (symbol >> 4) + 1;
        // A block of nothing but this symbol ends by itself if its places divide 63.
        const bool right = 63 % places == 0 && size >= 1 && size <= 10;
        std::string bits = "00";
        for (int i = 0; i < (right ? 63 / places : 64); ++i)
            bits += "0" + std::string(static_cast<std::size_t>(size), '1');
        EXPECT_EQ(decoder.decode_bits(bits.c_str()), right ? Status::ok : Status::malformed) << symbol;
    }
}

TEST(DecodeBlock, RefusesCoefficientsNoPictureHas) {
    // Quantised 8 (four bits) times a step; 2047 is the largest in range, -2048 the lowest.
    const auto ac = [](int step, int value) {
        Decoder decoder;
        Bytes steps(128);
        for (std::size_t k = 0; k < 64; ++k) steps[2 * k] = static_cast<std::uint8_t>(step >> 8);
        for (std::size_t k = 0; k < 64; ++k) steps[2 * k + 1] = static_cast<std::uint8_t>(step);
        decoder.quantiser.build(span_of(steps));
        JpegFile file;
        file.bytes.clear();
        Coefficients quantised(64);
        quantised[5] = value;
        return decoder.decode(file.block(quantised, 0, 0).pad().marker(0xd9).bytes);
    };
    EXPECT_EQ(ac(2047, 1), Status::ok);
    EXPECT_EQ(ac(2048, 1), Status::malformed);
    EXPECT_EQ(ac(2048, -1), Status::ok);
    EXPECT_EQ(ac(2049, -1), Status::malformed);
    EXPECT_EQ(ac(65535, 1023), Status::malformed);
    EXPECT_EQ(ac(65535, -1023), Status::malformed);
    const auto dc = [](int before, int step) {
        Decoder decoder(step);
        decoder.dc = before;
        return decoder.decode_bits("010 1 1010");  // 1 more than before
    };
    EXPECT_EQ(dc(2046, 1), Status::ok);
    EXPECT_EQ(dc(2047, 1), Status::malformed);
    EXPECT_EQ(dc(7, 255), Status::ok);
    EXPECT_EQ(dc(8, 255), Status::malformed);
}

TEST(DecodeBlock, SaysTruncatedOrMalformedWhereTheBitsEnd) {
    JpegFile file;
    file.bytes.clear();
    Coefficients quantised(64);
    for (std::size_t k = 0; k < 64; ++k) quantised[k] = static_cast<int>(k) - 30;
    const Bytes whole = file.block(quantised, 0, 0).pad().bytes;
    EXPECT_EQ(Decoder().decode(whole), Status::ok);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_EQ(Decoder().decode(cut), Status::truncated) << length;
        if (!cut.empty() && cut.back() == 0xff) continue;
        cut.insert(cut.end(), {0xff, 0xd9});
        EXPECT_EQ(Decoder().decode(cut), Status::malformed) << length;
    }
}

}  // namespace
}  // namespace fovea::test
