// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/interleaved_2_of_5.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

std::string read(const std::vector<std::int32_t>& edges, const BarRules& rules = {}) {
    BarReading reading;
    const Status status = decode_interleaved(span_of(edges), 1, rules, reading);
    if (status != Status::ok) return describe(status);
    return std::string("I") + reading.aim_digit + " " + text_of(reading);
}
std::vector<std::int32_t> edges_of_text(const std::string& text) {
    return edges_of(bars_of(Symbology::interleaved_2_of_5, text), 512);
}

TEST(Interleaved2Of5, EveryDigitHasTwoWideElements) {
    for (const std::uint8_t wide : interleaved_wide) EXPECT_EQ(__builtin_popcount(wide), 2);
}

TEST(Interleaved2Of5, ReadsWhatTheEncoderDraws) {
    Random random(3131);
    for (int round = 0; round < 400; ++round) {
        std::string text;
        const auto size = 6 + 2 * random.below(10);
        while (text.size() < size) text += static_cast<char>('0' + random.below(10));
        TwoWidthOptions two;
        two.wide = random.between(2, 3);
        const int module = 200 + static_cast<int>(random.below(2000));
        const Bars bars = bars_of(Symbology::interleaved_2_of_5, text, two);
        EXPECT_EQ(read(edges_of(bars, module, 12, random.between(-module / 4, module / 4))), "I0 " + text);
    }
}

TEST(Interleaved2Of5, LengthsOutsideTheRulesAreNotRead) {
    BarRules rules;
    EXPECT_EQ(read(edges_of_text("1234"), rules), "nothing found");
    rules.interleaved_shortest = 4;
    EXPECT_EQ(read(edges_of_text("1234"), rules), "I0 1234");
    rules.interleaved_longest = 6;
    EXPECT_EQ(read(edges_of_text("12345678"), rules), "nothing found");
}

TEST(Interleaved2Of5, VerifiesAndRemovesTheCheckDigit) {
    BarRules rules;
    rules.interleaved_check = CheckCharacter::required;
    EXPECT_EQ(read(edges_of_text("30712345000010"), rules), "I1 30712345000010");
    EXPECT_EQ(read(edges_of_text("30712345000011"), rules), "nothing found");
    rules.interleaved_check = CheckCharacter::removed;
    EXPECT_EQ(read(edges_of_text("30712345000010"), rules), "I3 3071234500001");
}

TEST(Interleaved2Of5, APartOfALongerCodeIsReadOnlyWhereItIsCutBehindWhatLooksLikeTheStop) {
    // What a line sees that leaves the code through its side. The last pair, 1 and 0, begins with a wide bar,
    // a narrow space and a narrow bar.
    const std::vector<std::int32_t> edges = edges_of_text("30712345000010");
    for (std::size_t kept = 1; kept + 1 < edges.size(); ++kept) {
        std::vector<std::int32_t> part(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(kept));
        part.push_back(edges.back());
        EXPECT_EQ(read(part), kept == 1 + 4 + 60 + 4 ? "I0 307123450000" : "nothing found") << kept;
    }
}

// Each pair for itself has two wide bars and two wide spaces and is as wide as the others; but where its wide
// bars are of four modules those of the next are of two.
TEST(Interleaved2Of5, PairsThatAreNotAlikeAreNone) {
    const auto edges_with = [](int first, int second, int third) {
        Bars bars = bars_of(Symbology::interleaved_2_of_5, "123456");
        const int wide[] = {first, second, third};
        for (int i = 4; i < 34; ++i) {
            if (bars.widths[i] == 1) continue;
            const int of_pair = wide[(i - 4) / 10];
            bars.widths[i] = static_cast<std::uint8_t>(i % 2 == 0 ? of_pair : 6 - of_pair);
        }
        return edges_of(bars, 512);
    };
    EXPECT_EQ(read(edges_with(3, 3, 3)), "I0 123456");
    EXPECT_EQ(read(edges_with(4, 4, 4)), "I0 123456");
    EXPECT_EQ(read(edges_with(4, 2, 4)), "nothing found");
    EXPECT_EQ(read(edges_with(2, 4, 2)), "nothing found");
}

TEST(Interleaved2Of5, LeavesTheReadingOnErrors) {
    const std::vector<std::int32_t> still(60, 5);
    BarReading reading;
    reading.size = 77;
    EXPECT_EQ(decode_interleaved(span_of(still), 1, {}, reading), Status::not_found);
    EXPECT_EQ(decode_interleaved(span_of(still), 60, {}, reading), Status::out_of_range);
    EXPECT_EQ(reading.size, 77);
}

}  // namespace
}  // namespace fovea::test
