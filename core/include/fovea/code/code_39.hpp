// SPDX-License-Identifier: MIT
//
// The characters of Code 39. ISO/IEC 16388.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline constexpr int code_39_count = 43;
/// The characters by their value. ISO/IEC 16388, annex A, table A.1.
inline constexpr char code_39_characters[code_39_count + 1] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ-. $/+%";

/// Which of the nine bars and spaces are wide, the first in the highest bit. ISO/IEC 16388, 4.3.1, table 1.
inline constexpr std::uint16_t code_39_wide[code_39_count] = {
    0x034, 0x121, 0x061, 0x160, 0x031, 0x130, 0x070, 0x025, 0x124, 0x064, 0x109, 0x049, 0x148, 0x019, 0x118,
    0x058, 0x00D, 0x10C, 0x04C, 0x01C, 0x103, 0x043, 0x142, 0x013, 0x112, 0x052, 0x007, 0x106, 0x046, 0x016,
    0x181, 0x0C1, 0x1C0, 0x091, 0x190, 0x0D0, 0x085, 0x184, 0x0C4, 0x0A8, 0x0A2, 0x08A, 0x02A};
/// The asterisk that starts and stops.
inline constexpr std::uint16_t code_39_asterisk = 0x094;

/// The value of a sign, -1 if it is none of them.
constexpr int code_39_value(int sign) {
    for (int value = 0; value < code_39_count; ++value)
        if (code_39_characters[value] == sign) return value;
    return -1;
}

/// The pair of characters that stands for an ASCII sign in full ASCII mode; 0 instead of the first where it
/// stands for itself. ISO/IEC 16388, annex A, table A.2.
struct Code39Pair {
    char first = 0;
    char second = 0;
};
constexpr Code39Pair code_39_pair(int ascii) {
    const auto letter = [](int n) { return static_cast<char>('A' + n); };
    if (ascii == 0) return {'%', 'U'};
    if (ascii < 27) return {'$', letter(ascii - 1)};
    if (ascii < 32) return {'%', letter(ascii - 27)};
    if (ascii == ' ' || ascii == '-' || ascii == '.') return {0, static_cast<char>(ascii)};
    if (ascii < '0') return {'/', letter(ascii - '!')};
    if (ascii <= '9') return {0, static_cast<char>(ascii)};
    if (ascii == ':') return {'/', 'Z'};
    if (ascii < '@') return {'%', letter(ascii - ';' + 5)};
    if (ascii == '@') return {'%', 'V'};
    if (ascii <= 'Z') return {0, static_cast<char>(ascii)};
    if (ascii < '`') return {'%', letter(ascii - '[' + 10)};
    if (ascii == '`') return {'%', 'W'};
    if (ascii <= 'z') return {'+', letter(ascii - 'a')};
    return {'%', letter(ascii - '{' + 15)};
}

/// The ASCII sign of such a pair, -1 if there is none.
constexpr int code_39_ascii(int first, int second) {
    for (int ascii = 0; ascii < 128; ++ascii) {
        const Code39Pair pair = code_39_pair(ascii);
        if (pair.first != 0 && pair.first == first && pair.second == second) return ascii;
    }
    // DEL has three more names.
    if (first == '%' && (second == 'X' || second == 'Y' || second == 'Z')) return 127;
    return -1;
}

}  // namespace fovea
