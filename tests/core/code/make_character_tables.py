#!/usr/bin/env python3
"""Makes the tables of core/include/fovea/code/character_tables.hpp from the codecs of Python.

usage: make_character_tables.py > core/include/fovea/code/character_tables.hpp
"""

HEAD = """// SPDX-License-Identifier: MIT
//
// What bytes above ASCII mean in the character sets that codes tell. Made by
// tests/core/code/make_character_tables.py.
#pragma once

#include <cstdint>

// ---- Interface --------------------------------------------------------------------

namespace fovea::detail {

/// Stands where a set has no character.
inline constexpr char16_t no_character = 0xFFFD;
"""


def decoded(data, codec):
    try:
        text = data.decode(codec)
    except UnicodeDecodeError:
        return 0xFFFD
    return ord(text) if len(text) == 1 and ord(text) < 0x10000 else 0xFFFD


def escaped(codes, a_line=16):
    lines = []
    for i in range(0, len(codes), a_line):
        lines.append('    u"' + "".join("\\u%04X" % code for code in codes[i : i + a_line]) + '"')
    return "\n".join(lines)


def high_half(name, codec, first, comment):
    codes = [decoded(bytes([byte]), codec) for byte in range(first, 256)]
    return f"/// {comment} from 0x{first:X} on.\ninline constexpr char16_t {name}[] =\n{escaped(codes)};\n"


def kanji_row(row):
    """The 94 characters of a row of JIS X 0208, by their two bytes in Shift JIS; row 13 is that of vendors."""
    lead = (row - 1) // 2 + (0x81 if row < 63 else 0xC1)
    codes = []
    for cell in range(94):
        trail = cell + 0x40 + (cell >= 63) if row % 2 == 1 else cell + 0x9F
        codes.append(decoded(bytes([lead, trail]), "cp932" if row == 13 else "shift_jis"))
    return codes


def main():
    print(HEAD)
    print("// clang-format off\n")
    for part in [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 14, 15, 16]:
        print(high_half(f"iso_8859_{part}", f"iso8859_{part}", 0xA0, f"ISO/IEC 8859-{part}"))
    for page in [1250, 1251, 1252, 1256]:
        print(high_half(f"windows_{page}", f"cp{page}", 0x80, f"Windows-{page}"))
    print(high_half("code_page_437", "cp437", 0x80, "Code page 437"))
    print("/// JIS X 0208 by rows of 94 cells: 1 to 8 and 13, the latter of NEC, then 16 to 84. In UTF-8, as a line")
    print("/// is a row that way.")
    print("inline constexpr char16_t jis_x_0208[] =")
    rows = [row for row in list(range(1, 9)) + [13] + list(range(16, 85))]
    lines = ['    u"' + "".join(map(chr, kanji_row(row))).replace("\\", "\\\\").replace('"', '\\"') + '"' for row in rows]
    print("\n".join(lines) + ";")
    print("/// GB 2312 by rows of 94 cells: 1 to 9, then 16 to 87.")
    print("inline constexpr char16_t gb_2312[] =")
    lines = []
    for row in list(range(1, 10)) + list(range(16, 88)):
        codes = [decoded(bytes([0xA0 + row, 0xA1 + cell]), "gb2312") for cell in range(94)]
        lines.append('    u"' + "".join(map(chr, codes)).replace("\\", "\\\\").replace('"', '\\"') + '"')
    print("\n".join(lines) + ";")
    print("// clang-format on\n")
    print("}  // namespace fovea::detail")


main()
