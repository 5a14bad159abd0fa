// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/code_39_decoder.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

std::string read(const Bars& bars, const BarRules& rules = {}, int module = 512, int gain = 0) {
    const std::vector<std::int32_t> edges = edges_of(bars, module, 12, gain);
    BarReading reading;
    const Status status = decode_code_39(span_of(edges), 1, rules, reading);
    if (status != Status::ok) return describe(status);
    return std::string("A") + reading.aim_digit + " " + text_of(reading);
}

TEST(Code39Decoder, ReadsWhatTheEncoderDraws) {
    Random random(3121);
    for (int round = 0; round < 400; ++round) {
        std::string text;
        const auto size = 1 + random.below(30);
        while (text.size() < size) text += code_39_characters[random.below(code_39_count)];
        TwoWidthOptions two;
        two.wide = random.between(2, 3);
        const int module = 200 + static_cast<int>(random.below(2000));
        const Bars bars = bars_of(Symbology::code_39, text, two);
        EXPECT_EQ(read(bars, {}, module, random.between(-module / 3, module / 3)), "A0 " + text);
    }
}

TEST(Code39Decoder, VerifiesAndRemovesTheCheckCharacter) {
    // 1 + 2 + 3 = 6
    TwoWidthOptions two;
    two.with_check = true;
    const Bars bars = bars_of(Symbology::code_39, "123", two);
    BarRules rules;
    EXPECT_EQ(read(bars, rules), "A0 1236");
    rules.code_39_check = CheckCharacter::required;
    EXPECT_EQ(read(bars, rules), "A1 1236");
    EXPECT_EQ(read(bars_of(Symbology::code_39, "1237"), rules), "nothing found");
    rules.code_39_check = CheckCharacter::removed;
    EXPECT_EQ(read(bars, rules), "A3 123");
}

TEST(Code39Decoder, SpreadsPairsToAscii) {
    Bars bars;
    const std::string text = "Fovea: \x01{~}";
    ASSERT_EQ(encode_code_39(bytes_of(text), Code39Text::full_ascii, {}, bars.view()), Status::ok);
    BarRules rules;
    rules.code_39_text = Code39Text::full_ascii;
    EXPECT_EQ(read(bars, rules), "A4 " + text);
    EXPECT_EQ(read(bars), "A0 F+O+V+E+A/Z $A%P%S%R");
    EXPECT_EQ(read(bars_of(Symbology::code_39, "A$"), rules), "nothing found");
}

TEST(Code39Decoder, LeavesTheReadingOnErrors) {
    const std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::code_39, "AB"), 512, 4);
    BarReading reading;
    reading.size = 77;
    EXPECT_EQ(decode_code_39(span_of(edges), 1, {}, reading), Status::not_found);
    EXPECT_EQ(decode_code_39(span_of(edges), 2, {}, reading), Status::out_of_range);
    const std::vector<std::int32_t> still(60, 5);
    EXPECT_EQ(decode_code_39(span_of(still), 1, {}, reading), Status::not_found);
    EXPECT_EQ(reading.size, 77);
}

}  // namespace
}  // namespace fovea::test
