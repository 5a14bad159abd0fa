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

template <class Serial>
void print_number(Serial& serial, std::uint32_t number) {
    char digits[11] = {};
    int first = 10;
    do digits[--first] = static_cast<char>('0' + number % 10);
    while ((number /= 10) != 0);
    print(serial, digits + first);
}

}  // namespace fovea::target
