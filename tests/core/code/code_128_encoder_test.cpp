// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/code_128_encoder.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

std::size_t characters(const std::string& text, Code128Kind kind = Code128Kind::plain) {
    Bars bars;
    EXPECT_EQ(encode_code_128(bytes_of(text), kind, bars.view()), Status::ok) << text;
    return (bars.modules().size() - 13) / 11;
}

TEST(Code128Encoder, DrawsStartACharacterCheckAndStop) {
    // Start B, "A" (33), check (104 + 33) mod 103 = 34, stop.
    EXPECT_EQ(bars_of(Symbology::code_128, "A").modules(),
              "11010010000"
              "10100011000"
              "10001011000"
              "1100011101011");
}

TEST(Code128Encoder, TakesTheCodeSetsThatMakeItShort) {
    EXPECT_EQ(characters("12"), 3U);        // C 12 check
    EXPECT_EQ(characters("123456"), 5U);    // C 12 34 56 check
    EXPECT_EQ(characters("12345"), 6U);     // C 12 34, B 5, check
    EXPECT_EQ(characters("AB123456"), 8U);  // B A B, C 12 34 56, check
    EXPECT_EQ(characters("A12B"), 6U);      // no digits pay a change
    EXPECT_EQ(characters("\x01\x02"), 4U);  // A 1 2 check
    EXPECT_EQ(characters("\xe9"), 4U);      // B FNC4 e check
    EXPECT_EQ(characters("0112345678901231", Code128Kind::gs1), 11U);
}

TEST(Code128Encoder, RefusesNoTextAndTooMuchAndLeavesTheList) {
    Bars bars;
    EXPECT_EQ(encode_code_128({}, Code128Kind::plain, bars.view()), Status::bad_argument);
    EXPECT_EQ(encode_code_128(bytes_of(std::string(most_bar_text + 1, 'a')), Code128Kind::plain, bars.view()),
              Status::bad_argument);
    std::uint8_t room[24] = {};
    int count = 0;
    EXPECT_EQ(encode_code_128(bytes_of("A"), Code128Kind::plain, {room, 24, &count}),
              Status::buffer_too_small);
    EXPECT_EQ(bars.count + count, 0);
}

TEST(Code128Encoder, TakesTheLongestText) {
    // Small letters, control characters and the upper half in turn change the set at every byte.
    std::string text;
    while (text.size() < most_bar_text) text += text.size() % 2 == 0 ? "\xe9" : "\x81";
    Bars bars;
    EXPECT_EQ(encode_code_128(bytes_of(text), Code128Kind::plain, bars.view()), Status::ok);
}

}  // namespace
}  // namespace fovea::test
