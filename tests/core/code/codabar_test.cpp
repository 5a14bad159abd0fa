// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/codabar.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

std::string read(const std::vector<std::int32_t>& edges, const BarRules& rules = {}) {
    BarReading reading;
    const Status status = decode_codabar(span_of(edges), 1, rules, reading);
    if (status != Status::ok) return describe(status);
    return std::string("F") + reading.aim_digit + " " + text_of(reading);
}

TEST(Codabar, CharactersAreDifferent) {
    for (int i = 0; i < codabar_count; ++i) {
        EXPECT_EQ(codabar_value(codabar_characters[i]), i);
        for (int k = 0; k < i; ++k) EXPECT_NE(codabar_wide[i], codabar_wide[k]);
    }
    EXPECT_EQ(codabar_value('E'), -1);
}

TEST(Codabar, ReadsWhatTheEncoderDraws) {
    Random random(3141);
    for (int round = 0; round < 400; ++round) {
        std::string text;
        const auto size = 3 + random.below(20);
        while (text.size() < size) text += codabar_characters[random.below(16)];
        const std::string whole = std::string(1, static_cast<char>('A' + random.below(4))) + text +
                                  static_cast<char>('A' + random.below(4));
        TwoWidthOptions two;
        two.wide = random.between(2, 3);
        const int module = 200 + static_cast<int>(random.below(2000));
        const Bars bars = bars_of(Symbology::codabar, whole, two);
        EXPECT_EQ(read(edges_of(bars, module, 12, random.between(-module / 4, module / 4))), "F0 " + text);
    }
}

TEST(Codabar, VerifiesAndRemovesTheCheckCharacter) {
    TwoWidthOptions two;
    two.with_check = true;
    // A is 16, so that the sum is 16 + 1 + 2 + 3 + 4 + 16 = 42 and the check character 6.
    const std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::codabar, "1234", two), 512);
    BarRules rules;
    EXPECT_EQ(read(edges, rules), "F0 12346");
    rules.codabar_check = CheckCharacter::required;
    EXPECT_EQ(read(edges, rules), "F2 12346");
    EXPECT_EQ(read(edges_of(bars_of(Symbology::codabar, "12345"), 512), rules), "nothing found");
    rules.codabar_check = CheckCharacter::removed;
    EXPECT_EQ(read(edges, rules), "F4 1234");
}

TEST(Codabar, FewerThanThreeCharactersAreNotRead) {
    EXPECT_EQ(read(edges_of(bars_of(Symbology::codabar, "12"), 512)), "nothing found");
    EXPECT_EQ(read(edges_of(bars_of(Symbology::codabar, "123"), 512)), "F0 123");
}

TEST(Codabar, LeavesTheReadingOnErrors) {
    const std::vector<std::int32_t> still(60, 5);
    BarReading reading;
    reading.size = 77;
    EXPECT_EQ(decode_codabar(span_of(still), 1, {}, reading), Status::not_found);
    EXPECT_EQ(decode_codabar(span_of(still), 2, {}, reading), Status::out_of_range);
    EXPECT_EQ(reading.size, 77);
}

}  // namespace
}  // namespace fovea::test
