// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <common/text.hpp>
#include <fovea/base/random.hpp>
#include <support/json.hpp>

namespace fovea::test {
namespace {

using apps::edit_distance;
using apps::hint;
using apps::json_string;
using apps::listed;
using apps::nearest_name;
using apps::number;
using apps::shortest;
using apps::split;

TEST(Number, ShowsTheAskedPlacesRoundedAwayFromZeroAtTies) {
    EXPECT_EQ(number(Decimal{12345678}, 6), "12.345678");
    EXPECT_EQ(number(Decimal{12345678}, 3), "12.346");
    EXPECT_EQ(number(Decimal{12500000}, 0), "13");
    EXPECT_EQ(number(Decimal{-12500000}, 0), "-13");
    EXPECT_EQ(number(Decimal{-499}, 3), "0.000");
    EXPECT_EQ(number(Decimal{-500}, 3), "-0.001");
    EXPECT_EQ(number(Decimal{0}, 2), "0.00");
    EXPECT_EQ(number(Decimal::from_int(-7), 1), "-7.0");
}

TEST(Number, HasRoomForTheLongestOne) {
    EXPECT_EQ(number(Decimal{INT64_MAX}, 6), "9223372036854.775807");
    EXPECT_EQ(number(Decimal{INT64_MIN}, 6), "-9223372036854.775808");
}

TEST(Number, IsAQuestionMarkForPlacesThereAreNot) {
    EXPECT_EQ(number(Decimal{1}, 7), "?");
    EXPECT_EQ(number(Decimal{1}, -1), "?");
}

TEST(DecimalOf, ConvertsPixelsAndAnglesToMillionths) {
    EXPECT_EQ(apps::decimal_of(FinePixel::from_raw(32768)), Decimal{500000});
    EXPECT_EQ(apps::decimal_of(FinePixel::from_raw(-65536 * 3)), Decimal{-3000000});
    EXPECT_EQ(apps::decimal_of(FinePixel::from_raw(1)), Decimal{15});
    EXPECT_EQ(apps::decimal_of(FineAngle::from_microdegrees(-45500000)), Decimal{-45500000});
}

TEST(Shortest, DropsZerosButKeepsAWholeNumber) {
    EXPECT_EQ(shortest(Decimal{12500000}), "12.5");
    EXPECT_EQ(shortest(Decimal{12000000}), "12");
    EXPECT_EQ(shortest(Decimal{100000000}), "100");
    EXPECT_EQ(shortest(Decimal{0}), "0");
    EXPECT_EQ(shortest(Decimal{1}), "0.000001");
    EXPECT_EQ(shortest(Decimal{-1}), "-0.000001");
}

TEST(Shortest, ReadsBackAsTheSameNumber) {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const int digits = random.between(0, 46);
        const std::int64_t size = (std::int64_t{1} << digits) - 1;
        const std::int64_t value = static_cast<std::int64_t>(std::uint64_t{random.next()} << 15) & size;
        const Decimal decimal{random.below(2) == 0 ? value : -value};
        const Result<Decimal> read = parse_decimal(apps::span_of(shortest(decimal)));
        ASSERT_TRUE(read.ok()) << shortest(decimal);
        EXPECT_EQ(*read, decimal) << shortest(decimal);
    }
}

TEST(JsonString, KeepsPlainTextAndEscapesQuotesAndBackslashes) {
    EXPECT_EQ(json_string(""), "\"\"");
    EXPECT_EQ(json_string("a/b c.png"), "\"a/b c.png\"");
    EXPECT_EQ(json_string("say \"hi\""), "\"say \\\"hi\\\"\"");
    EXPECT_EQ(json_string("a\\x"), "\"a\\\\x\"");
}

TEST(JsonString, EscapesEveryControlCharacter) {
    for (int c = 0; c < 0x20; ++c) {
        const std::string text(1, static_cast<char>(c));
        const std::string json = json_string(text);
        const char* digits = "0123456789abcdef";
        EXPECT_EQ(json, std::string("\"\\u00") + digits[c / 16] + digits[c % 16] + "\"");
        const auto read = parse_json(json);
        ASSERT_TRUE(read.has_value()) << c;
        EXPECT_EQ(read->text, text);
    }
    EXPECT_EQ(json_string("\x7f"), "\"\\u007f\"");
    // Of Latin 1, and what separates lines in Unicode.
    EXPECT_EQ(json_string("\xc2\x80\xc2\x85\xc2\x9f"), "\"\\u0080\\u0085\\u009f\"");
    EXPECT_EQ(json_string("\xe2\x80\xa8\xe2\x80\xa9"), "\"\\u2028\\u2029\"");
}

TEST(JsonString, KeepsEveryWellFormedCharacter) {
    // The first and the last code points of every length that are no control characters, and around the
    // surrogates.
    for (const std::string& text :
         {std::string("\xc2\xa0"), std::string("\xdf\xbf"), std::string("\xe0\xa0\x80"),
          std::string("\xed\x9f\xbf"), std::string("\xee\x80\x80"), std::string("\xef\xbf\xbf"),
          std::string("\xf0\x90\x80\x80"), std::string("\xf4\x8f\xbf\xbf"),
          std::string("\xc3\x98 12 \xc2\xb5m")})
        EXPECT_EQ(json_string(text), "\"" + text + "\"");
}

TEST(JsonString, PutsReplacementCharactersForWhatIsNoUtf8) {
    struct Case {
        const char* what;
        std::string bytes;
        int replaced;
    };
    const std::vector<Case> cases = {
        {"a stray continuation", "\x80", 1},
        {"overlong of one byte", "\xc0\x80", 2},
        {"overlong slash", "\xc1\xaf", 2},
        {"overlong of two bytes", "\xe0\x9f\xbf", 3},
        {"overlong of three bytes", "\xf0\x8f\xbf\xbf", 4},
        {"the first surrogate", "\xed\xa0\x80", 3},
        {"the last surrogate", "\xed\xbf\xbf", 3},
        {"beyond U+10FFFF", "\xf4\x90\x80\x80", 4},
        {"a lead byte of five", "\xf8\x88\x80\x80\x80", 5},
        {"bytes that are never used", "\xfe\xff", 2},
        {"a lead byte at the end", "\xc3", 1},
        // What could have begun a character is one replacement.
        {"two of three bytes", "\xe2\x82", 1},
        {"three of four bytes", "\xf0\x9f\x98", 1},
    };
    for (const Case& each : cases) {
        std::string expected = "\"a";
        for (int i = 0; i < each.replaced; ++i) expected += "\\ufffd";
        EXPECT_EQ(json_string("a" + each.bytes), expected + "\"") << each.what;
        // What stands behind survives, a quote too.
        EXPECT_EQ(json_string("a" + each.bytes + "\"z"), expected + "\\\"z\"") << each.what;
    }
}

TEST(JsonString, IsValidJsonForAnyBytes) {
    Random random(2);
    for (int i = 0; i < 5000; ++i) {
        std::string text;
        for (int k = random.between(0, 12); k > 0; --k)
            // Half of the bytes are such as lead and continue characters.
            text += static_cast<char>(random.below(2) == 0 ? random.below(256) : 0x80 + random.below(128));
        ASSERT_TRUE(parse_json(json_string(text)).has_value()) << i;
    }
}

TEST(EditDistance, CountsInsertionsDeletionsAndExchanges) {
    EXPECT_EQ(edit_distance("", ""), 0u);
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
    EXPECT_EQ(edit_distance("flaw", "lawn"), 2u);
    EXPECT_EQ(edit_distance("radius", "raduis"), 2u);
    EXPECT_EQ(edit_distance("same", "same"), 0u);
    EXPECT_EQ(edit_distance("sunday", "saturday"), 3u);
}

TEST(NearestName, TakesTheNearestAndTheFirstOfEquals) {
    const std::vector<std::string> names = {"centre", "search", "nominal", "minus"};
    EXPECT_EQ(nearest_name("center", names), "centre");
    EXPECT_EQ(nearest_name("serch", names), "search");
    EXPECT_EQ(nearest_name("nominal", names), "nominal");
    EXPECT_EQ(nearest_name("ab", {"ac", "ad"}), "ac");
}

TEST(NearestName, IsSilentWhereNothingIsNear) {
    EXPECT_EQ(nearest_name("banana", {"centre", "search"}), "");
    EXPECT_EQ(nearest_name("", {"a"}), "");
    EXPECT_EQ(nearest_name("x", {}), "");
    // Half of the characters may differ, not more.
    EXPECT_EQ(nearest_name("abcd", {"abxy"}), "abxy");
    EXPECT_EQ(nearest_name("abcd", {"axyz"}), "");
}

TEST(NearestName, DoesNotCareForCapitals) { EXPECT_EQ(nearest_name("MM", {"px", "mm"}), "mm"); }

TEST(Hint, AsksOrIsEmpty) {
    EXPECT_EQ(hint("radius"), "; did you mean radius?");
    EXPECT_EQ(hint(""), "");
}

TEST(Listed, PutsCommasAndAnAnd) {
    EXPECT_EQ(listed({}), "");
    EXPECT_EQ(listed({"a"}), "a");
    EXPECT_EQ(listed({"a", "b"}), "a and b");
    EXPECT_EQ(listed({"a", "b", "c"}), "a, b and c");
}

TEST(Listed, TakesAnotherWordForTheLast) { EXPECT_EQ(listed({"a", "b", "c"}, "or"), "a, b or c"); }

TEST(Split, KeepsEmptyWords) {
    EXPECT_EQ(split("a|b|c", '|'), (std::vector<std::string>{"a", "b", "c"}));
    EXPECT_EQ(split("", '|'), (std::vector<std::string>{""}));
    EXPECT_EQ(split("|a|", '|'), (std::vector<std::string>{"", "a", ""}));
    EXPECT_EQ(split("abc", '|'), (std::vector<std::string>{"abc"}));
}

TEST(Printable, TakesTextAndRefusesControlCharactersAndWhatIsNoUtf8) {
    EXPECT_TRUE(apps::printable(""));
    EXPECT_TRUE(apps::printable("\xc3\x98 12 \xc2\xb5m"));
    EXPECT_TRUE(apps::printable("\xef\xbf\xbd"));  // the replacement character itself
    for (int c = 0; c < 0x20; ++c)
        EXPECT_FALSE(apps::printable("a" + std::string(1, static_cast<char>(c)))) << c;
    EXPECT_FALSE(apps::printable("\x7f"));
    EXPECT_FALSE(apps::printable("\xc2\x85"));  // C1: next line
    EXPECT_FALSE(apps::printable("\xff"));
    EXPECT_FALSE(apps::printable("\xed\xa0\x80"));
    EXPECT_FALSE(apps::printable("\xe2\x82"));
}

TEST(Shortened, CutsBetweenCharacters) {
    EXPECT_EQ(apps::shortened("abc", 3), "abc");
    EXPECT_EQ(apps::shortened("abcd", 3), "abc...");
    EXPECT_EQ(apps::shortened("ab\xe2\x82\xac"
                              "d",
                              3),
              "ab...");
    EXPECT_EQ(apps::shortened("ab\xe2\x82\xac"
                              "d",
                              5),
              "ab\xe2\x82\xac...");
    EXPECT_EQ(apps::shortened("\x80\x80\x80", 1), "...");
}

TEST(OneLine, ShowsTextAsItIsAndControlCharactersAsQuestionMarks) {
    EXPECT_EQ(apps::one_line("a/b c.png"), "a/b c.png");
    EXPECT_EQ(apps::one_line("a\nb\x1b[31m"), "a?b?[31m");
    EXPECT_EQ(apps::one_line("\xc2\xb5m \xc2\x98 \x7f"), "\xc2\xb5m ? ?");  // C1: start of string
    EXPECT_EQ(apps::one_line("a\xff\xe2\x82z"), "a??z");  // one for a sequence that ends early
    EXPECT_EQ(apps::one_line(""), "");
}

}  // namespace
}  // namespace fovea::test
