// SPDX-License-Identifier: MIT
//
// The characters of Code 128. ISO/IEC 15417.
#pragma once

#include <cstdint>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Widths in modules of the three bars and spaces of a character by its value, the first in the highest
/// digit. Each is of eleven modules, an even number of them dark. ISO/IEC 15417, 4.3.2, table 1.
inline constexpr std::uint32_t code_128_widths[106] = {
    0x212222, 0x222122, 0x222221, 0x121223, 0x121322, 0x131222, 0x122213, 0x122312, 0x132212, 0x221213,
    0x221312, 0x231212, 0x112232, 0x122132, 0x122231, 0x113222, 0x123122, 0x123221, 0x223211, 0x221132,
    0x221231, 0x213212, 0x223112, 0x312131, 0x311222, 0x321122, 0x321221, 0x312212, 0x322112, 0x322211,
    0x212123, 0x212321, 0x232121, 0x111323, 0x131123, 0x131321, 0x112313, 0x132113, 0x132311, 0x211313,
    0x231113, 0x231311, 0x112133, 0x112331, 0x132131, 0x113123, 0x113321, 0x133121, 0x313121, 0x211331,
    0x231131, 0x213113, 0x213311, 0x213131, 0x311123, 0x311321, 0x331121, 0x312113, 0x312311, 0x332111,
    0x314111, 0x221411, 0x431111, 0x111224, 0x111422, 0x121124, 0x121421, 0x141122, 0x141221, 0x112214,
    0x112412, 0x122114, 0x122411, 0x142112, 0x142211, 0x241211, 0x221114, 0x413111, 0x241112, 0x134111,
    0x111242, 0x121142, 0x121241, 0x114212, 0x124112, 0x124211, 0x411212, 0x421112, 0x421211, 0x212141,
    0x214121, 0x412121, 0x111143, 0x111341, 0x131141, 0x114113, 0x114311, 0x411113, 0x411311, 0x113141,
    0x114131, 0x311141, 0x411131, 0x211412, 0x211214, 0x211232,
};

/// The stop character has one bar more, and thirteen modules. Without that bar it is of eleven as the others.
inline constexpr std::uint32_t code_128_stop_widths = 0x2331112;

/// The values that are no data. ISO/IEC 15417, 4.3.3.
namespace code_128 {
inline constexpr int fnc_3 = 96;    ///< in sets A and B
inline constexpr int fnc_2 = 97;    ///< in sets A and B
inline constexpr int shift = 98;    ///< the next character is of the other one of sets A and B
inline constexpr int code_c = 99;   ///< from sets A and B
inline constexpr int code_b = 100;  ///< from sets A and C; FNC4 in set B
inline constexpr int code_a = 101;  ///< from sets B and C; FNC4 in set A
inline constexpr int fnc_1 = 102;
inline constexpr int start_a = 103;
inline constexpr int start_b = 104;
inline constexpr int start_c = 105;
inline constexpr int stop = 106;
}  // namespace code_128

}  // namespace fovea
