// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/data_matrix_text.hpp>

namespace fovea::test {
namespace {

struct Read {
    Status status = Status::ok;
    DataMatrixMessage message;
    std::string text;
    std::vector<TextSegment> segments;
};
Read read(const std::vector<std::uint8_t>& codewords, int room = 4000) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(room));
    CodeText text({bytes.data(), room});
    const auto message =
        data_matrix_text({codewords.data(), static_cast<std::ptrdiff_t>(codewords.size())}, text);
    Read result;
    result.status = message.status();
    if (message) result.message = *message;
    result.text.assign(reinterpret_cast<const char*>(bytes.data()), static_cast<std::size_t>(text.size()));
    for (const TextSegment segment : text.segments()) result.segments.push_back(segment);
    return result;
}

TEST(DataMatrixText, ReadsAsciiDigitsAndUpperShift) {
    const Read digits = read({142, 164, 186});
    EXPECT_EQ(digits.text, "123456");
    EXPECT_EQ(digits.message.aim_digit, '1');
    EXPECT_EQ(read({66, 235, 101, 131, 129, 70}).text,
              "A\xe4"
              "01");
}

TEST(DataMatrixText, ReadsC40) {
    // ISO/IEC 16022, 5.2.5: "AIM" is 14 22 26, in codewords 91 11.
    EXPECT_EQ(read({230, 91, 11, 91, 11, 91, 11, 254}).text, "AIMAIMAIM");
    EXPECT_EQ(read({230, 91, 11}).text, "AIM");
    // A last codeword alone is ASCII.
    EXPECT_EQ(read({230, 91, 11, 66}).text, "AIMA");
}

TEST(DataMatrixText, ReadsTextWithLetterCasesTurned) {
    EXPECT_EQ(read({239, 91, 11, 254, 66}).text, "aimA");
    // Shift 3 and 1: 1600 * 2 + 40 * 1 + 14 + 1 = 3255.
    EXPECT_EQ(read({239, 12, 183, 254}).text, "Aa");
}

TEST(DataMatrixText, ReadsX12) {
    // CR * > are 0 1 2: 0 + 40 + 2 + 1 = 43.
    EXPECT_EQ(read({238, 0, 43, 254, 50}).text, "\r*>1");
}

TEST(DataMatrixText, ReadsEdifactAndItsEnd) {
    // D A T A: 4 1 20 1 in six bits each; then the unlatch 31 and zeros.
    const std::vector<std::uint8_t> codewords = {240, 0x10, 0x15, 0x01, 0x7c, 66, 67, 129};
    EXPECT_EQ(read(codewords).text, "DATAAB");
    // The last two codewords of a symbol are ASCII.
    EXPECT_EQ(read({240, 0x10, 0x15, 0x01, 66, 67}).text, "DATAAB");
}

TEST(DataMatrixText, ReadsBase256) {
    const auto noisy = [](int value, int place) {
        return static_cast<std::uint8_t>((value + 149 * place % 255 + 1) & 255);
    };
    EXPECT_EQ(read({231, noisy(2, 2), noisy(0xfe, 3), noisy(0x41, 4), 67}).text,
              "\xfe"
              "AB");
    // Length 0: to the end.
    EXPECT_EQ(read({231, noisy(0, 2), noisy('x', 3), noisy('y', 4)}).text, "xy");
    std::vector<std::uint8_t> longer = {231, noisy(250, 2), noisy(50, 3)};
    for (int i = 0; i < 300; ++i) longer.push_back(noisy('z', 4 + i));
    EXPECT_EQ(read(longer).text, std::string(300, 'z'));
    longer.pop_back();
    EXPECT_EQ(read(longer).status, Status::malformed);
}

TEST(DataMatrixText, TellsOfGs1AndOfFnc1InSecondPlace) {
    const Read gs1 = read({232, 131, 232, 50});
    EXPECT_EQ(gs1.text,
              "01\x1d"
              "1");
    EXPECT_EQ(gs1.message.aim_digit, '2');
    EXPECT_EQ(read({66, 232, 50}).message.aim_digit, '3');
    EXPECT_EQ(read({66, 232, 50}).text, "A1");
    EXPECT_EQ(read({66, 66, 232, 50}).text,
              "AA\x1d"
              "1");
    EXPECT_EQ(read({232, 241, 27, 50}).message.aim_digit, '5');
}

TEST(DataMatrixText, TellsOfInterpretations) {
    const Read one = read({66, 241, 27, 67, 241, 128, 2, 68});
    EXPECT_EQ(one.text, "ABC");
    ASSERT_EQ(one.segments.size(), 2U);
    EXPECT_EQ(one.segments[0].first, 1);
    EXPECT_EQ(one.segments[0].eci, 26);
    EXPECT_EQ(one.segments[1].eci, 128);
    EXPECT_EQ(one.message.aim_digit, '4');
    EXPECT_EQ(read({241, 192, 1, 2, 66}).segments[0].eci, 16384);
    EXPECT_EQ(read({241, 0, 66}).status, Status::malformed);
    EXPECT_EQ(read({241, 208, 1, 1}).status, Status::malformed);
    EXPECT_EQ(read({241, 130}).status, Status::malformed);
}

TEST(DataMatrixText, WritesOutMacros) {
    EXPECT_EQ(read({236, 66}).text, std::string("[)>\x1e"
                                                "05\x1d"
                                                "A\x1e\x04"));
    EXPECT_EQ(read({237, 66}).text.substr(4, 2), "06");
    EXPECT_EQ(read({66, 236}).status, Status::malformed);
}

TEST(DataMatrixText, TellsOfReaderProgrammingAndStructuredAppend) {
    EXPECT_TRUE(read({234, 66}).message.reader_programming);
    // The third of seven: 2 and 10.
    const Read part = read({233, 2 << 4 | 10, 1, 2, 66});
    EXPECT_EQ(part.text, "A");
    EXPECT_EQ(part.message.append_position, 3);
    EXPECT_EQ(part.message.append_count, 7);
    EXPECT_EQ(part.message.append_file, 258);
    EXPECT_EQ(read({233, 8 << 4 | 10, 1, 2, 66}).status, Status::malformed);
    EXPECT_EQ(read({233, 26}).status, Status::malformed);
}

TEST(DataMatrixText, RefusesWhatMeansNothing) {
    EXPECT_EQ(read({0}).status, Status::malformed);
    EXPECT_EQ(read({250}).status, Status::malformed);
    EXPECT_EQ(read({254, 66}).status, Status::malformed);
    EXPECT_EQ(read({66, 254}).text, "A");
    EXPECT_EQ(read({235}).status, Status::malformed);
    EXPECT_EQ(read({235, 131}).status, Status::malformed);
    EXPECT_EQ(read({230, 0, 0}).status, Status::malformed);
    EXPECT_EQ(read({230, 255, 255}).status, Status::malformed);
    EXPECT_EQ(read({231}).status, Status::malformed);
}

TEST(DataMatrixText, LeavesTheTextAsItWasAfterAnError) {
    std::uint8_t bytes[4] = {};
    CodeText text(bytes);
    ASSERT_EQ(text.begin_segment(3), Status::ok);
    ASSERT_EQ(text.push('x'), Status::ok);
    const std::uint8_t too_long[] = {66, 241, 27, 67, 68, 69};
    EXPECT_EQ(data_matrix_text(too_long, text).status(), Status::buffer_too_small);
    const std::uint8_t wrong[] = {66, 250};
    EXPECT_EQ(data_matrix_text(wrong, text).status(), Status::malformed);
    EXPECT_EQ(text.size(), 1);
    ASSERT_EQ(text.segments().size(), 1);
    EXPECT_EQ(text.segments()[0].eci, 3);
}

TEST(DataMatrixText, EndsWithAStatusWhateverTheCodewords) {
    Random random(9);
    for (int round = 0; round < 50000; ++round) {
        std::vector<std::uint8_t> codewords(static_cast<std::size_t>(random.between(1, 60)));
        for (std::uint8_t& codeword : codewords)
            codeword = static_cast<std::uint8_t>(random.between(round % 2 == 0 ? 0 : 225, 255));
        const Read result = read(codewords, 100);
        if (result.status != Status::ok) {
            ASSERT_EQ(result.text, "");
        }
    }
}

}  // namespace
}  // namespace fovea::test
