// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/draw/font.hpp>

namespace fovea::test {
namespace {

std::vector<std::string> drawing(int glyph) {
    std::vector<std::string> rows;
    for (int row = 0; row < glyph_height; ++row) {
        rows.emplace_back();
        for (int x = 0; x < glyph_width; ++x)
            rows.back() += (glyph_row(glyph, row) >> (4 - x) & 1) != 0 ? '#' : '.';
    }
    return rows;
}

int differing_pixels(int a, int b) {
    int count = 0;
    for (int row = 0; row < glyph_height; ++row)
        for (std::uint32_t bits = glyph_row(a, row) ^ glyph_row(b, row); bits != 0; bits &= bits - 1) ++count;
    return count;
}

/// The lowest row with a pixel, -1 for none.
int lowest_row(int glyph) {
    int lowest = -1;
    for (int row = 0; row < glyph_height; ++row)
        if (glyph_row(glyph, row) != 0) lowest = row;
    return lowest;
}
int highest_row(int glyph) {
    int row = 0;
    while (row < glyph_height && glyph_row(glyph, row) == 0) ++row;
    return row;
}

TEST(Font, DrawsTheLetterA) {
    EXPECT_EQ(drawing(glyph_of('A')), (std::vector<std::string>{"..#..", ".#.#.", "#...#", "#...#", "#####",
                                                                "#...#", "#...#", ".....", "....."}));
    EXPECT_EQ(drawing(glyph_of(' ')), std::vector<std::string>(9, "....."));
    static_assert(glyph_row(glyph_of('A'), 4) == 0b11111);
}

TEST(Font, HasAGlyphOfItsOwnForEverySupportedCharacter) {
    std::vector<bool> taken(glyph_count, false);
    taken[static_cast<std::size_t>(glyph_of(0xfffd))] = true;
    std::vector<std::uint32_t> characters = {0xb0, 0xb1, 0xb2, 0xb3, 0xb5, 0x2300};
    for (std::uint32_t c = 32; c <= 126; ++c) characters.push_back(c);
    for (const std::uint32_t c : characters) {
        const int glyph = glyph_of(c);
        ASSERT_TRUE(glyph >= 0 && glyph < glyph_count);
        EXPECT_FALSE(taken[static_cast<std::size_t>(glyph)]) << c;
        taken[static_cast<std::size_t>(glyph)] = true;
    }
    EXPECT_EQ(std::vector<bool>(glyph_count, true), taken);
    EXPECT_EQ(glyph_of(0x3bc), glyph_of(0xb5));
    EXPECT_EQ(glyph_of(0xd8), glyph_of(0x2300));
}

TEST(Font, ShowsTheReplacementForAllElse) {
    const int replacement = glyph_of(0xfffd);
    for (const std::uint32_t c : {0u, 9u, 10u, 31u, 127u, 0x80u, 0xa0u, 0xb4u, 0xd6u, 0x20acu, 0x1f600u, ~0u})
        EXPECT_EQ(glyph_of(c), replacement) << c;
    EXPECT_GT(differing_pixels(replacement, glyph_of(' ')), 20);
}

TEST(Font, NoTwoGlyphsAreAlike) {
    for (int a = 0; a < glyph_count; ++a)
        for (int b = 0; b < a; ++b) EXPECT_GE(differing_pixels(a, b), 2) << a << " and " << b;
}

TEST(Font, KeepsApartWhatIsEasilyMistaken) {
    const auto apart = [](char a, char b) {
        return differing_pixels(glyph_of(static_cast<unsigned char>(a)),
                                glyph_of(static_cast<unsigned char>(b)));
    };
    EXPECT_EQ(drawing(glyph_of('0'))[3], "#.#.#");
    EXPECT_EQ(drawing(glyph_of('O'))[3], "#...#");
    for (const char* pair :
         {"0O", "1l", "1I", "lI", "l|", "I|", "5S", "2Z", "8B", "6G", "6b", "9g", "9q", "uv", "co", "ce"})
        EXPECT_GE(apart(pair[0], pair[1]), 3) << pair;
}

TEST(Font, StandsOnTheLine) {
    const std::string standing = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789abcdefhiklmnorstuvwxz!#$%&./:?@";
    for (const char c : standing) EXPECT_EQ(lowest_row(glyph_of(static_cast<unsigned char>(c))), 6) << c;
    for (const char c : std::string("gjpqy,;|"))
        EXPECT_EQ(lowest_row(glyph_of(static_cast<unsigned char>(c))), 8) << c;
    for (const char c : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789bdfhklt"))
        EXPECT_EQ(highest_row(glyph_of(static_cast<unsigned char>(c))), 0) << c;
    for (const char c : std::string("acegmnopqrsuvwxyz"))
        EXPECT_EQ(highest_row(glyph_of(static_cast<unsigned char>(c))), 2) << c;
}

}  // namespace
}  // namespace fovea::test
