// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/draw/utf8.hpp>

namespace fovea::test {
namespace {

std::vector<std::uint32_t> read_all(const std::string& text) {
    std::vector<std::uint32_t> values;
    Span<const char> rest(text.data(), static_cast<std::ptrdiff_t>(text.size()));
    while (!rest.empty()) {
        const CodePoint read = first_code_point(rest);
        EXPECT_GE(read.bytes, 1);
        values.push_back(read.value);
        rest = rest.from(read.bytes);
    }
    return values;
}

std::string written(std::uint32_t value) {
    const auto byte = [](std::uint32_t bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
    if (value < 0x80) return {byte(value)};
    if (value < 0x800) return {byte(0xc0 | value >> 6), byte(0x80 | (value & 0x3f))};
    if (value < 0x10000)
        return {byte(0xe0 | value >> 12), byte(0x80 | (value >> 6 & 0x3f)), byte(0x80 | (value & 0x3f))};
    return {byte(0xf0 | value >> 18), byte(0x80 | (value >> 12 & 0x3f)), byte(0x80 | (value >> 6 & 0x3f)),
            byte(0x80 | (value & 0x3f))};
}

constexpr std::uint32_t bad = replacement_character;
using Values = std::vector<std::uint32_t>;

TEST(FirstCodePoint, ReadsTheSignsOfMeasuring) {
    EXPECT_EQ(read_all("5\xc2\xb0 \xc2\xb1\xce\xbcm \xe2\x8c\x80"),
              (Values{'5', 0xb0, ' ', 0xb1, 0x3bc, 'm', ' ', 0x2300}));
    static_assert(first_code_point(Span<const char>("\xc2\xb0", 2)).value == 0xb0);
}

TEST(FirstCodePoint, ReadsEveryCharacterThereIs) {
    for (std::uint32_t value = 0; value <= 0x10ffff; ++value) {
        const std::string text = written(value);
        const CodePoint read = first_code_point({text.data(), static_cast<std::ptrdiff_t>(text.size())});
        if (value >= 0xd800 && value <= 0xdfff) {
            ASSERT_EQ(read.value, bad) << value;
            ASSERT_EQ(read.bytes, 1);
        } else {
            ASSERT_EQ(read.value, value);
            ASSERT_EQ(read.bytes, static_cast<int>(text.size()));
        }
    }
}

TEST(FirstCodePoint, RefusesEveryFormThatIsTooLong) {
    for (std::uint32_t value = 0; value < 0x80; ++value) {
        const std::string two = {static_cast<char>(0xc0 | value >> 6),
                                 static_cast<char>(0x80 | (value & 0x3f))};
        EXPECT_EQ(read_all(two), (Values{bad, bad}));
    }
    EXPECT_EQ(read_all("\xe0\x9f\xbf"), (Values{bad, bad, bad}));
    EXPECT_EQ(read_all("\xf0\x8f\xbf\xbf"), (Values{bad, bad, bad, bad}));
}

// Tables 3-8 to 3-11 of the standard.
TEST(FirstCodePoint, ReplacesAsTheStandardShows) {
    EXPECT_EQ(read_all("\xc0\xaf\xe0\x80\xbf\xf0\x81\x82\x41"),
              (Values{bad, bad, bad, bad, bad, bad, bad, bad, 'A'}));
    EXPECT_EQ(read_all("\xed\xa0\x80\xed\xbf\xbf\xed\xaf\x41"),
              (Values{bad, bad, bad, bad, bad, bad, bad, bad, 'A'}));
    EXPECT_EQ(read_all("\xf4\x91\x92\x93\xff\x41\x80\xbf\x42"),
              (Values{bad, bad, bad, bad, bad, 'A', bad, bad, 'B'}));
    EXPECT_EQ(read_all("\xe1\x80\xe2\xf0\x91\x92\xf1\xbf\x41"), (Values{bad, bad, bad, bad, 'A'}));
}

TEST(FirstCodePoint, ReadsNoByteBeyondTheText) {
    for (const std::string& whole : std::vector<std::string>{"\xc2\xb0", "\xe2\x8c\x80", "\xf0\x9f\x98\x80"})
        for (std::size_t kept = 1; kept < whole.size(); ++kept) {
            const CodePoint read = first_code_point({whole.data(), static_cast<std::ptrdiff_t>(kept)});
            EXPECT_EQ(read.value, bad);
            EXPECT_EQ(read.bytes, static_cast<int>(kept));
        }
}

TEST(FirstCodePoint, EndsOnAnyBytes) {
    for (std::uint32_t a = 0; a < 256; ++a)
        for (std::uint32_t b = 0; b < 256; ++b)
            for (const std::uint32_t c : {0x00u, 0x41u, 0x7fu, 0x80u, 0x9fu, 0xa0u, 0xbfu, 0xc2u, 0xffu}) {
                const std::string text = {static_cast<char>(a), static_cast<char>(b), static_cast<char>(c)};
                const CodePoint read = first_code_point({text.data(), 3});
                ASSERT_TRUE(read.bytes >= 1 && read.bytes <= 3);
                ASSERT_TRUE(read.value == bad ||
                            written(read.value) == text.substr(0, std::size_t(read.bytes)));
            }
}

TEST(Utf8, IsPrintableWithoutControlCharactersAndForeignBytes) {
    const auto printable = [](const std::string& text) {
        return is_printable({text.data(), static_cast<std::ptrdiff_t>(text.size())});
    };
    EXPECT_TRUE(printable(""));
    EXPECT_TRUE(printable("\xc3\x98 12 \xc2\xb5m"));
    EXPECT_TRUE(printable("\xef\xbf\xbd"));  // the replacement character itself
    EXPECT_TRUE(printable("\xc2\xa0"));
    for (const char* text : {"a\n", "\x7f", "\xc2\x80", "\xc2\x9f", "a\xff", "\xef\xbf", "\xf0\x9f\x98"})
        EXPECT_FALSE(printable(text)) << text;
}

TEST(Utf8, TellsTheReplacementCharacterFromWhatItReplaces) {
    const auto replaced = [](const std::string& text) {
        const Span<const char> span(text.data(), static_cast<std::ptrdiff_t>(text.size()));
        return is_no_utf8(first_code_point(span), span);
    };
    EXPECT_FALSE(replaced("\xef\xbf\xbd"));
    EXPECT_FALSE(replaced("a"));
    EXPECT_TRUE(replaced("\xef\xbf"));
    EXPECT_TRUE(replaced("\xf0\x9f\x98"));  // three bytes of four
    EXPECT_TRUE(replaced("\x80"));
}

}  // namespace
}  // namespace fovea::test
