// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/code/text_utf8.hpp>

namespace fovea::test {
namespace {

/// A text of pieces, each with its interpretation.
class Text {
public:
    Text& add(int eci, const std::string& bytes) {
        EXPECT_EQ(text_.begin_segment(eci), Status::ok);
        for (const char c : bytes) EXPECT_EQ(text_.push(static_cast<std::uint8_t>(c)), Status::ok);
        return *this;
    }
    std::string utf8(int first, int size) const {
        std::uint8_t room[400] = {};
        const Result<int> length = text_utf8(text_, first, size, room);
        return length ? std::string(room, room + *length) : describe(length.status());
    }
    std::string utf8() const { return utf8(0, text_.size()); }
    const CodeText& text() const { return text_; }

private:
    std::uint8_t room_[120] = {};
    CodeText text_{Span<std::uint8_t>(room_)};
};
std::string of(int eci, const std::string& bytes) { return Text().add(eci, bytes).utf8(); }
constexpr int unstated = TextSegment::not_stated;

TEST(TextUtf8, KnowsThePartsOfIso8859) {
    EXPECT_EQ(of(3, "caf\xE9"), "café");
    EXPECT_EQ(of(1, "\xFF"), "ÿ");
    EXPECT_EQ(of(4, "\xB1\xE9"), "ąé");
    EXPECT_EQ(of(7, "\xBF\xE0"), "Пр");
    EXPECT_EQ(of(9, "\xC1\xF9"), "Αω");
    EXPECT_EQ(of(10, "\xE0"), "א");
    EXPECT_EQ(of(11, "\xFD"), "ı");
    EXPECT_EQ(of(17, "\xA4"), "€");
    EXPECT_EQ(of(18, "\xAA"), "Ș");
    EXPECT_EQ(of(5, "\xA5"), "\xEF\xBF\xBD");
}

TEST(TextUtf8, KnowsTheSetsOfWindowsAndTheFirstComputers) {
    EXPECT_EQ(of(21, "\x8A"), "Š");
    EXPECT_EQ(of(22, "\xC6\xE8"), "Жи");
    EXPECT_EQ(of(23, "\x80\x93"), "€“");
    EXPECT_EQ(of(24, "\xC7"), "ا");
    EXPECT_EQ(of(2, "\x80\xE1"), "Çß");
}

TEST(TextUtf8, KnowsTheCharactersOfAsia) {
    EXPECT_EQ(of(20, "\x93\xFA\x96{\x8C\xEA \xB6\xC5 \x83\x65"), "日本語 ｶﾅ テ");
    EXPECT_EQ(of(20, "\x87\x40"), "①");
    EXPECT_EQ(of(29, "a\xD6\xD0\xB9\xFA"), "a中国");
}

TEST(TextUtf8, KnowsUnicode) {
    EXPECT_EQ(of(26, "h\xC3\xA9\xF0\x9F\x98\x80"), "hé😀");
    EXPECT_EQ(of(25, std::string("\0h\x20\xAC\xD8\x3D\xDE\x00", 8)), "h€😀");
    EXPECT_EQ(of(25, std::string("\0h\xDE\x00\0", 5)), "h\xEF\xBF\xBD\xEF\xBF\xBD");
    EXPECT_EQ(of(26, "\xC0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD");
    EXPECT_EQ(of(26, "\xED\xA0\x80").substr(0, 3), "\xEF\xBF\xBD");
}

TEST(TextUtf8, BytesAndAsciiAreWhatTheyAre) {
    EXPECT_EQ(of(899, std::string("\0\x1D\xE9", 3)), std::string("\0\x1D\xC3\xA9", 4));
    EXPECT_EQ(of(27, "A\n"), "A\n");
    EXPECT_EQ(of(170, "z"), "z");
}

TEST(TextUtf8, GuessesWhatIsNotStated) {
    EXPECT_EQ(of(unstated, "plain"), "plain");
    EXPECT_EQ(of(unstated, "caf\xC3\xA9"), "café");
    EXPECT_EQ(of(unstated, "caf\xE9"), "café");
    EXPECT_EQ(of(unstated, "\xC4\xD6\xDC"), "ﾄﾖﾜ");
    EXPECT_EQ(of(unstated,
                 "\xC4rger \xDC"
                 "ber"),
              "Ärger Über");
    EXPECT_EQ(of(unstated, "\xE9l\xE8ve"), "élève");
    EXPECT_EQ(of(unstated, "\x83\x65\x83\x58\x83\x67"), "テスト");
    EXPECT_EQ(of(unstated, "\xC3\xDE\xBB\xDE\xB2\xDD"), "ﾃﾞｻﾞｲﾝ");
}

TEST(TextUtf8, WritesEachPartByItsOwnMeaning) {
    Text text;
    text.add(unstated, "a\xE9").add(20, "\x93\xFA").add(26, "\xC3\xA9").add(3, "\xE9");
    EXPECT_EQ(text.utf8(), "aé日éé");
    EXPECT_EQ(text.utf8(2, 2), "日");
    EXPECT_EQ(text.utf8(3, 1), "\xEF\xBF\xBD");
    EXPECT_EQ(text.utf8(4, 3), "éé");
    EXPECT_EQ(text.utf8(7, 0), "");
}

TEST(TextUtf8, EveryByteOfEverySetFitsItsRoom) {
    Random random(141);
    for (int eci = -1; eci <= 30; ++eci) {
        for (int round = 0; round < 50; ++round) {
            std::string bytes;
            for (int i = 0; i < 60; ++i) bytes += static_cast<char>(random.between(0, 255));
            const std::string utf8 = of(eci, bytes);
            EXPECT_NE(utf8, describe(Status::buffer_too_small)) << eci;
            const bool known = eci <= 13 || (eci >= 15 && eci <= 18) || (eci >= 20 && eci <= 27) || eci == 29;
            EXPECT_EQ(utf8 == describe(Status::unsupported), !known) << eci;
        }
    }
}

TEST(TextUtf8, SaysWhatIsWrong) {
    Text text;
    text.add(3, "\xE9\xE9");
    std::uint8_t room[4] = {};
    EXPECT_EQ(text_utf8(text.text(), 0, 3, room).status(), Status::out_of_range);
    EXPECT_EQ(text_utf8(text.text(), -1, 1, room).status(), Status::out_of_range);
    EXPECT_EQ(text_utf8(text.text(), 0, -1, room).status(), Status::out_of_range);
    EXPECT_EQ(text_utf8(text.text(), 2147483647, 2147483647, room).status(), Status::out_of_range);
    EXPECT_EQ(text_utf8(text.text(), 0, 2, {room, 3}).status(), Status::buffer_too_small);
    EXPECT_EQ(*text_utf8(text.text(), 0, 2, room), 4);
    EXPECT_EQ(text_utf8(Text().add(900, "x").text(), 0, 1, room).status(), Status::unsupported);
    EXPECT_EQ(text_utf8(Text().add(14, "x").text(), 0, 1, room).status(), Status::unsupported);
    static_assert(text_utf8_room(10) == 30, "a byte becomes three at most");
}

}  // namespace
}  // namespace fovea::test
