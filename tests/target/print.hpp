// SPDX-License-Identifier: MIT
//
// Text on a serial line, waiting until it is gone: for programs that have nothing else to do.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>

namespace fovea::target {

template <class Serial>
void print(Serial& serial, const char* text) {
    for (; *text != '\0'; ++text) {
        const auto byte = static_cast<std::uint8_t>(*text);
        while (*serial.write({&byte, 1}) == 0) {
        }
    }
}

/// Eight digits.
template <class Serial>
void print_hexadecimal(Serial& serial, std::uint32_t number) {
    char digits[9] = {};
    for (int i = 0; i < 8; ++i) digits[i] = "0123456789abcdef"[number >> (28 - 4 * i) & 15];
    print(serial, digits);
}

/// A whole number of 64 bits.
template <class Serial>
void print_long(Serial& serial, std::int64_t number) {
    char digits[21] = {};
    int first = 20;
    auto rest = number < 0 ? 0 - static_cast<std::uint64_t>(number) : static_cast<std::uint64_t>(number);
    do digits[--first] = static_cast<char>('0' + rest % 10);
    while ((rest /= 10) != 0);
    if (number < 0) digits[--first] = '-';
    print(serial, digits + first);
}

}  // namespace fovea::target
