// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <fovea/base/random.hpp>

#include <read/code_rule.hpp>

namespace fovea::apps {
namespace {

bool fits(const std::string& pattern, const std::string& text) {
    CodePattern made;
    EXPECT_EQ(made.read(pattern), "") << pattern;
    return made.fits(span_of(text));
}

TEST(CodePattern, StandsForDigitsLettersAndAnything) {
    EXPECT_TRUE(fits("40######", "40123456"));
    EXPECT_FALSE(fits("40######", "4012345"));
    EXPECT_FALSE(fits("40######", "401234567"));
    EXPECT_FALSE(fits("40######", "4012345x"));
    EXPECT_TRUE(fits("LOT-@@#", "LOT-aZ9"));
    EXPECT_FALSE(fits("LOT-@@#", "LOT-a99"));
    EXPECT_TRUE(fits("a?c",
                     "a\xc3\xa9"
                     "c"))
        << "a character may have several bytes";
    EXPECT_FALSE(fits("a??c",
                      "a\xc3\xa9"
                      "c"));
    EXPECT_TRUE(fits("", ""));
    EXPECT_FALSE(fits("", "a"));
}

TEST(CodePattern, TakesAnyNumberOfCharactersForAStar) {
    EXPECT_TRUE(fits("978*", "9780905705712"));
    EXPECT_TRUE(fits("978*", "978"));
    EXPECT_FALSE(fits("978*", "979"));
    EXPECT_TRUE(fits("*", ""));
    EXPECT_TRUE(fits("*end", "an end end"));
    EXPECT_FALSE(fits("*end", "an end."));
    EXPECT_TRUE(fits("a*b*c", "a-b-b-c"));
    EXPECT_TRUE(fits("*#", "no. 7"));
    EXPECT_FALSE(fits("**#", "no. 7."));
}

TEST(CodePattern, HasEscapesForItsOwnSignsAndForBytes) {
    EXPECT_TRUE(fits("\\#\\@\\?\\*\\\\", "#@?*\\"));
    EXPECT_FALSE(fits("\\#", "1"));
    EXPECT_TRUE(fits("10*\\x1d21#*",
                     "10AB\x1d"
                     "2142"));
    EXPECT_FALSE(fits("10*\\x1d21#*", "10AB 2142"));
    EXPECT_TRUE(fits("a\\nb\\tc\\r", "a\nb\tc\r"));
    CodePattern made;
    for (const char* wrong : {"\\", "a\\q", "\\x", "\\x1", "\\x1g"})
        EXPECT_EQ(made.read(wrong), "after \\ comes one of n r t xNN \\ # @ ? *") << wrong;
}

/// By trying everything: what the loop over the text must answer.
bool fits_slowly(const std::string& pattern, const std::string& text) {
    if (pattern.empty()) return text.empty();
    const char kind = pattern[0];
    if (kind == '*')
        return fits_slowly(pattern.substr(1), text) ||
               (!text.empty() && fits_slowly(pattern, text.substr(1)));
    if (text.empty()) return false;
    const bool digit = text[0] >= '0' && text[0] <= '9';
    const bool same = kind == '?' || (kind == '#' ? digit : kind == '@' ? !digit : kind == text[0]);
    return same && fits_slowly(pattern.substr(1), text.substr(1));
}

TEST(CodePattern, AgreesWithTryingEverything) {
    Random random(3);
    int fitting = 0;
    for (int run = 0; run < 20000; ++run) {
        std::string pattern, text;
        for (std::uint32_t k = random.below(7); k > 0; --k) pattern += "ab1#@?**"[random.below(8)];
        for (std::uint32_t k = random.below(9); k > 0; --k) text += "ab12"[random.below(4)];
        const bool wanted = fits_slowly(pattern, text);
        ASSERT_EQ(fits(pattern, text), wanted) << pattern << " " << text;
        fitting += wanted ? 1 : 0;
    }
    EXPECT_GT(fitting, 2000);
}

TEST(CodeRule, AllowsAllUntilItIsToldOtherwise) {
    CodeRule rule;
    EXPECT_TRUE(rule.empty() && rule.allows(span_of("anything")));
    rule.allow("one");
    EXPECT_TRUE(rule.allows(span_of("one")));
    EXPECT_FALSE(rule.allows(span_of("on")) || rule.allows(span_of("ones")) || rule.allows(span_of("")));
    CodePattern pattern;
    ASSERT_EQ(pattern.read("t##"), "");
    rule.allow(pattern);
    EXPECT_TRUE(rule.allows(span_of("one")) && rule.allows(span_of("t12")));
    EXPECT_FALSE(rule.allows(span_of("t1")));
}

TEST(CodeEscape, IsReadAsItIsWritten) {
    std::string all;
    for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
    std::string line;
    for (const char letter : all) {
        if (letter == '\\')
            line += "\\\\";
        else if (letter > ' ' && letter < '\x7f')
            line += letter;
        else
            put_escaped(letter, [&](char each) { line += each; });
    }
    std::string text;
    EXPECT_EQ(read_code_text(line, text), "");
    EXPECT_EQ(text, all);
    EXPECT_EQ(read_code_text("a\\", text), "after \\ comes one of n r t xNN \\");
}

TEST(CodeEscape, KnowsWhatDisturbsALine) {
    const auto bytes = [](const char* text) { return disturbing_bytes(span_of(text)); };
    EXPECT_EQ(bytes("a"), 0);
    EXPECT_EQ(bytes("\xc3\xa9"), 0);
    EXPECT_EQ(bytes("\x1d"), 1);
    EXPECT_EQ(bytes("\x7f"), 1);
    EXPECT_EQ(bytes("\xc2\x85"), 2) << "NEL";
    EXPECT_EQ(bytes("\xe2\x80\xa8"), 3) << "LINE SEPARATOR";
    EXPECT_EQ(bytes("\xe2\x80\xa9"), 3) << "PARAGRAPH SEPARATOR";
    EXPECT_EQ(bytes("\xff"), 1);
    EXPECT_EQ(bytes("\xef\xbf\xbd"), 0) << "the replacement character itself";
}

}  // namespace
}  // namespace fovea::apps
