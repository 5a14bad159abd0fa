// SPDX-License-Identifier: MIT
//
// The built-in font: 5x9 pixels a glyph, in flash.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/draw/utf8.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Pixels of a glyph. Capitals and digits stand in rows 0..6, small letters without ascender in 2..6; rows 7
/// and 8 hold what hangs below the line.
inline constexpr int glyph_width = 5;
inline constexpr int glyph_height = 9;

/// From one glyph to the next, and from one line of text to the next.
inline constexpr int glyph_advance = glyph_width + 1;
inline constexpr int line_advance = glyph_height + 1;

/// ASCII 32..126, the replacement glyph, and six signs of measuring.
inline constexpr int glyph_count = 102;

/// The number of a code point's glyph: ASCII, the degree sign, plus-minus, superscript 2 and 3, micro (U+00B5
/// or the Greek letter U+03BC), and the diameter sign (U+2300 or the letter U+00D8). Anything else has the
/// replacement glyph, a question mark on a box.
///
/// Shapes  any value
/// Errors  none
/// Source  own drawing. 0 has a slash that stays inside it, the diameter sign one that does not; 1 has a
///         foot, l a tail, I two bars
constexpr int glyph_of(std::uint32_t code_point);

/// A row of a glyph: bit 4 is its leftmost pixel, bit 0 its rightmost.
///
/// Shapes  glyph 0..glyph_count - 1, row 0..glyph_height - 1
/// Errors  none
/// Source  as glyph_of()
constexpr std::uint32_t glyph_row(int glyph, int row);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int replacement_glyph = 95;

struct FontTable {
    std::uint8_t rows[glyph_count][glyph_height];
};

/// Reads the drawing below when the program is compiled. A drawing of another form does not compile.
constexpr FontTable read_font() {
    constexpr int glyphs_abreast = 16;
    constexpr int drawing_width = glyphs_abreast * glyph_advance;
    // clang-format off
    constexpr char drawing[] =
        // the blank to /
        "..... ..#.. .#.#. .#.#. ..#.. ##... .##.. ..#.. ...#. .#... ..... ..... ..... ..... ..... ....# "
        "..... ..#.. .#.#. .#.#. .#### ##..# #..#. ..#.. ..#.. ..#.. ..#.. ..#.. ..... ..... ..... ....# "
        "..... ..#.. .#.#. ##### #.#.. ...#. #.#.. ..#.. .#... ...#. #.#.# ..#.. ..... ..... ..... ...#. "
        "..... ..#.. ..... .#.#. .###. ..#.. .#... ..... .#... ...#. .###. ##### ..... ##### ..... ..#.. "
        "..... ..#.. ..... ##### ..#.# .#... #.#.# ..... .#... ...#. #.#.# ..#.. ..... ..... ..... .#... "
        "..... ..... ..... .#.#. ####. #..## #..#. ..... ..#.. ..#.. ..#.. ..#.. .##.. ..... .##.. #.... "
        "..... ..#.. ..... .#.#. ..#.. ...## .##.# ..... ...#. .#... ..... ..... .##.. ..... .##.. #.... "
        "..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..#.. ..... ..... ..... "
        "..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... .#... ..... ..... ..... "
        // 0 to ?
        ".###. ..#.. .###. .###. ...#. ##### ..##. ##### .###. .###. ..... ..... ...#. ..... .#... .###. "
        "#...# .##.. #...# #...# ..##. #.... .#... ....# #...# #...# ..... ..... ..#.. ..... ..#.. #...# "
        "#..## #.#.. ....# ....# .#.#. ####. #.... ...#. #...# #...# .##.. .##.. .#... ##### ...#. ....# "
        "#.#.# ..#.. ...#. ..##. #..#. ....# ####. ...#. .###. .#### .##.. .##.. #.... ..... ....# ...#. "
        "##..# ..#.. ..#.. ....# ##### ....# #...# ..#.. #...# ....# ..... ..... .#... ##### ...#. ..#.. "
        "#...# ..#.. .#... #...# ...#. #...# #...# ..#.. #...# ...#. .##.. .##.. ..#.. ..... ..#.. ..... "
        ".###. ##### ##### .###. ...#. .###. .###. ..#.. .###. .##.. .##.. .##.. ...#. ..... .#... ..#.. "
        "..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..#.. ..... ..... ..... ..... "
        "..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... .#... ..... ..... ..... ..... "
        // @ to O
        ".###. ..#.. ####. .###. ###.. ##### ##### .###. #...# .###. ..### #...# #.... #...# #...# .###. "
        "#...# .#.#. #...# #...# #..#. #.... #.... #...# #...# ..#.. ...#. #..#. #.... ##.## #...# #...# "
        "#.### #...# #...# #.... #...# #.... #.... #.... #...# ..#.. ...#. #.#.. #.... #.#.# ##..# #...# "
        "#.#.# #...# ####. #.... #...# ####. ####. #.### ##### ..#.. ...#. ##... #.... #.#.# #.#.# #...# "
        "#.### ##### #...# #.... #...# #.... #.... #...# #...# ..#.. ...#. #.#.. #.... #...# #..## #...# "
        "#.... #...# #...# #...# #..#. #.... #.... #...# #...# ..#.. #..#. #..#. #.... #...# #...# #...# "
        ".#### #...# ####. .###. ###.. ##### #.... .#### #...# .###. .##.. #...# ##### #...# #...# .###. "
        "..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... "
        "..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... "
        // P to _
        "####. .###. ####. .#### ##### #...# #...# #...# #...# #...# ##### .###. #.... .###. ..#.. ..... "
        "#...# #...# #...# #.... ..#.. #...# #...# #...# #...# #...# ....# .#... #.... ...#. .#.#. ..... "
        "#...# #...# #...# #.... ..#.. #...# #...# #...# .#.#. .#.#. ...#. .#... .#... ...#. #...# ..... "
        "####. #...# ####. .###. ..#.. #...# #...# #.#.# ..#.. ..#.. ..#.. .#... ..#.. ...#. ..... ..... "
        "#.... #.#.# #.#.. ....# ..#.. #...# .#.#. #.#.# .#.#. ..#.. .#... .#... ...#. ...#. ..... ..... "
        "#.... #..#. #..#. ....# ..#.. #...# .#.#. #.#.# #...# ..#.. #.... .#... ....# ...#. ..... ..... "
        "#.... .##.# #...# ####. ..#.. .###. ..#.. .#.#. #...# ..#.. ##### .###. ....# .###. ..... ..... "
        "..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ##### "
        "..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... "
        // ` to o
        ".#... ..... #.... ..... ....# ..... ..##. ..... #.... ..#.. ...#. #.... .##.. ..... ..... ..... "
        "..#.. ..... #.... ..... ....# ..... .#... ..... #.... ..... ..... #.... ..#.. ..... ..... ..... "
        "..... .###. #.##. .#### .##.# .###. ####. .#### #.##. .##.. ..##. #..#. ..#.. ##.#. #.##. .###. "
        "..... ....# ##..# #.... #..## #...# .#... #...# ##..# ..#.. ...#. #.#.. ..#.. #.#.# ##..# #...# "
        "..... .#### #...# #.... #...# ##### .#... #...# #...# ..#.. ...#. ##... ..#.. #.#.# #...# #...# "
        "..... #...# #...# #.... #...# #.... .#... #...# #...# ..#.. ...#. #.#.. ..#.. #.#.# #...# #...# "
        "..... .#### ####. .#### .#### .###. .#... .#### #...# .###. ...#. #..#. ...## #.#.# #...# .###. "
        "..... ..... ..... ..... ..... ..... ..... ....# ..... ..... #..#. ..... ..... ..... ..... ..... "
        "..... ..... ..... ..... ..... ..... ..... .###. ..... ..... .##.. ..... ..... ..... ..... ..... "
        // p to ~, and the replacement
        "..... ..... ..... ..... .#... ..... ..... ..... ..... ..... ..... ...## ..#.. ##... ..... ##### "
        "..... ..... ..... ..... .#... ..... ..... ..... ..... ..... ..... ..#.. ..#.. ..#.. ..... #...# "
        "#.##. .##.# #.##. .#### ####. #...# #...# #...# #...# #...# ##### ..#.. ..#.. ..#.. .#... ###.# "
        "##..# #..## ##..# #.... .#... #...# #...# #...# .#.#. #...# ...#. .#... ..#.. ...#. #.#.# ##..# "
        "#...# #...# #.... .###. .#... #...# #...# #.#.# ..#.. #...# ..#.. ..#.. ..#.. ..#.. ...#. ##### "
        "#...# #...# #.... ....# .#... #..## .#.#. #.#.# .#.#. #..## .#... ..#.. ..#.. ..#.. ..... ##.## "
        "####. .#### #.... ####. ..##. .##.# ..#.. .#.#. #...# .##.# ##### ...## ..#.. ##... ..... ##### "
        "#.... ....# ..... ..... ..... ..... ..... ..... ..... ....# ..... ..... ..#.. ..... ..... ..... "
        "#.... ....# ..... ..... ..... ..... ..... ..... ..... .###. ..... ..... ..#.. ..... ..... ..... "
        // ° ± ² ³ µ Ø
        ".##.. ..#.. .##.. .##.. ..... ....#                                                             "
        "#..#. ..#.. ...#. ...#. ..... .###.                                                             "
        "#..#. ##### ..#.. ..#.. #...# #..##                                                             "
        ".##.. ..#.. .###. ...#. #...# #.#.#                                                             "
        "..... ..#.. ..... .##.. #...# ##..#                                                             "
        "..... ..... ..... ..... ##..# .###.                                                             "
        "..... ##### ..... ..... #.##. #....                                                             "
        "..... ..... ..... ..... #.... .....                                                             "
        "..... ..... ..... ..... #.... .....                                                             ";
    // clang-format on
    constexpr int bands = (glyph_count + glyphs_abreast - 1) / glyphs_abreast;
    static_assert(sizeof(drawing) == bands * glyph_height * drawing_width + 1, "a row of the font is amiss");

    FontTable table{};
    for (int glyph = 0; glyph < glyph_count; ++glyph)
        for (int row = 0; row < glyph_height; ++row) {
            const int line = glyph / glyphs_abreast * glyph_height + row;
            const char* cell = drawing + line * drawing_width + glyph % glyphs_abreast * glyph_advance;
            std::uint32_t bits = 0;
            for (int x = 0; x < glyph_width; ++x) {
                if (cell[x] != '#' && cell[x] != '.') __builtin_trap();
                bits = bits << 1 | (cell[x] == '#' ? 1u : 0u);
            }
            if (cell[glyph_width] != ' ') __builtin_trap();
            table.rows[glyph][row] = static_cast<std::uint8_t>(bits);
        }
    return table;
}

inline constexpr FontTable font = read_font();
static_assert(sizeof(font) == 918, "the font is budgeted at less than 1 KiB of flash");

}  // namespace detail

constexpr int glyph_of(std::uint32_t code_point) {
    if (code_point >= 32 && code_point <= 126) return static_cast<int>(code_point) - 32;
    switch (code_point) {
        case 0x00b0: return detail::replacement_glyph + 1;
        case 0x00b1: return detail::replacement_glyph + 2;
        case 0x00b2: return detail::replacement_glyph + 3;
        case 0x00b3: return detail::replacement_glyph + 4;
        case 0x00b5:
        case 0x03bc: return detail::replacement_glyph + 5;
        case 0x00d8:
        case 0x2300: return detail::replacement_glyph + 6;
        default: return detail::replacement_glyph;
    }
}

constexpr std::uint32_t glyph_row(int glyph, int row) {
    FOVEA_ASSERT(glyph >= 0 && glyph < glyph_count && row >= 0 && row < glyph_height);
    return detail::font.rows[glyph][row];
}

}  // namespace fovea
