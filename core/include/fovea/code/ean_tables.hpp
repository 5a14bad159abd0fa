// SPDX-License-Identifier: MIT
//
// The digits of EAN and UPC codes. ISO/IEC 15420.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Widths in modules of the space, bar, space, bar of a digit in set A. Set B is the same from behind; set C
/// is set A with bars and spaces exchanged. ISO/IEC 15420, 4.2.1, table 1.
inline constexpr std::uint8_t ean_widths[10][4] = {
    {3, 2, 1, 1}, {2, 2, 2, 1}, {2, 1, 2, 2}, {1, 4, 1, 1}, {1, 1, 3, 2},
    {1, 2, 3, 1}, {1, 1, 1, 4}, {1, 3, 1, 2}, {1, 2, 1, 3}, {3, 1, 1, 2},
};

/// Which of the six left digits of an EAN-13 are of set B, the leftmost in the highest bit: its first digit
/// is the place in this table. ISO/IEC 15420, 4.2.2, table 2.
inline constexpr std::uint8_t ean_13_parity[10] = {0b000000, 0b001011, 0b001101, 0b001110, 0b010011,
                                                   0b011001, 0b011100, 0b010101, 0b010110, 0b011010};

/// The same of the six digits of a UPC-E with number system 0: its check digit is the place in this table.
/// With number system 1 the sets are exchanged. ISO/IEC 15420, 4.2.5, table 4.
inline constexpr std::uint8_t upc_e_parity[10] = {0b111000, 0b110100, 0b110010, 0b110001, 0b101100,
                                                  0b100110, 0b100011, 0b101010, 0b101001, 0b100101};

/// The same of the five digits of an add-on; the place is its check value. ISO/IEC 15420, 4.2.6, table 6.
inline constexpr std::uint8_t add_on_5_parity[10] = {0b11000, 0b10100, 0b10010, 0b10001, 0b01100,
                                                     0b00110, 0b00011, 0b01010, 0b01001, 0b00101};

/// Modules, and the quiet zones on the left and on the right. ISO/IEC 15420, 4.3.
inline constexpr int ean_13_modules = 95;
inline constexpr int ean_8_modules = 67;
inline constexpr int upc_e_modules = 51;
inline constexpr int add_on_2_modules = 20;
inline constexpr int add_on_5_modules = 47;

/// The last digit that makes an EAN or UPC code right, of the digits before it: weights 3, 1, 3, ... from the
/// right. ISO/IEC 15420, annex A.
constexpr int ean_check_digit(Span<const std::uint8_t> digits) {
    int sum = 0;
    int weight = 3;
    for (std::ptrdiff_t i = digits.size(); i-- > 0; weight = 4 - weight) sum += weight * digits[i];
    return (10 - sum % 10) % 10;
}

/// The check value of an add-on of five digits. ISO/IEC 15420, 4.2.6.
constexpr int add_on_5_check(Span<const std::uint8_t> digits) {
    return (3 * (digits[0] + digits[2] + digits[4]) + 9 * (digits[1] + digits[3])) % 10;
}

/// The twelve digits of UPC-A that a UPC-E stands for, of its eight: number system, six digits, check digit.
/// ISO/IEC 15420, 4.2.5, table 5.
constexpr void upc_a_of_upc_e(const std::uint8_t (&upc_e)[8], std::uint8_t (&upc_a)[12]) {
    const std::uint8_t* d = upc_e + 1;
    for (std::uint8_t& digit : upc_a) digit = 0;
    upc_a[0] = upc_e[0];
    upc_a[1] = d[0];
    upc_a[2] = d[1];
    upc_a[11] = upc_e[7];
    if (d[5] <= 2) {
        upc_a[3] = d[5];
        upc_a[8] = d[2];
        upc_a[9] = d[3];
        upc_a[10] = d[4];
        return;
    }
    upc_a[3] = d[2];
    if (d[5] == 3) {
        upc_a[9] = d[3];
        upc_a[10] = d[4];
        return;
    }
    upc_a[4] = d[3];
    if (d[5] == 4) {
        upc_a[10] = d[4];
        return;
    }
    upc_a[5] = d[4];
    upc_a[10] = d[5];
}

}  // namespace fovea
