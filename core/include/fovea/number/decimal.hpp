// SPDX-License-Identifier: MIT
//
// Decimal: lengths, angles and tolerances as people write them, exact to a millionth, without binary floating
// point.
#pragma once

#include <cstdint>
#include <limits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A number in millionths: 12.5 mm is 12500000, as are nanometres for millimetres.
struct Decimal {
    std::int64_t millionths = 0;

    static constexpr Decimal from_int(std::int64_t value) { return {value * 1000000}; }

    friend constexpr bool operator==(Decimal a, Decimal b) { return a.millionths == b.millionths; }
    friend constexpr bool operator!=(Decimal a, Decimal b) { return a.millionths != b.millionths; }
    friend constexpr bool operator<(Decimal a, Decimal b) { return a.millionths < b.millionths; }
    friend constexpr bool operator>(Decimal a, Decimal b) { return a.millionths > b.millionths; }
    friend constexpr bool operator<=(Decimal a, Decimal b) { return a.millionths <= b.millionths; }
    friend constexpr bool operator>=(Decimal a, Decimal b) { return a.millionths >= b.millionths; }
    friend constexpr Decimal operator+(Decimal a, Decimal b) { return {a.millionths + b.millionths}; }
    friend constexpr Decimal operator-(Decimal a, Decimal b) { return {a.millionths - b.millionths}; }
    friend constexpr Decimal operator-(Decimal a) { return {-a.millionths}; }
};

/// The largest magnitude parse_decimal() accepts: a hundred million whole units, so that sums of lengths in
/// millionths stay far inside 64 bits.
inline constexpr std::int64_t max_decimal_units = 100000000;

/// Reads [+-]digits[.digits], all of the text.
///
/// Errors  malformed for anything else (no digit on a side of the point, an exponent, blanks); out_of_range
///         beyond max_decimal_units or for more than six places that are not zero
constexpr Result<Decimal> parse_decimal(Span<const char> text);

/// Writes a number with the given places (0..6), rounded to the nearest with ties away from zero, and answers
/// the length. "-0.000" is written as "0.000".
///
/// Errors  bad_argument for the places; buffer_too_small below 22 + places characters of room
constexpr Result<int> print_decimal(Decimal value, int places, Span<char> buffer);

// ---- Implementation ---------------------------------------------------------------

constexpr Result<Decimal> parse_decimal(Span<const char> text) {
    std::ptrdiff_t at = 0;
    bool negative = false;
    if (!text.empty() && (text[0] == '+' || text[0] == '-')) negative = text[at++] == '-';

    std::int64_t value = 0;
    std::ptrdiff_t digits = 0;
    for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at, ++digits) {
        value = value * 10 + (text[at] - '0');
        if (value > max_decimal_units) return Status::out_of_range;
    }
    if (digits == 0) return Status::malformed;
    value *= 1000000;
    if (at < text.size() && text[at] == '.') {
        ++at;
        digits = 0;
        std::int64_t place = 100000;
        for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at, ++digits, place /= 10) {
            if (place == 0 && text[at] != '0') return Status::out_of_range;
            value += place * (text[at] - '0');
        }
        if (digits == 0) return Status::malformed;
    }
    if (at != text.size()) return Status::malformed;
    if (value > max_decimal_units * 1000000) return Status::out_of_range;
    return Decimal{negative ? -value : value};
}

constexpr Result<int> print_decimal(Decimal value, int places, Span<char> buffer) {
    if (places < 0 || places > 6) return Status::bad_argument;
    if (buffer.size() < 22 + places) return Status::buffer_too_small;
    std::uint64_t drop = 1;
    for (int i = places; i < 6; ++i) drop *= 10;
    std::uint64_t rest = (magnitude(value.millionths) + drop / 2) / drop;

    char reversed[24] = {};
    int length = 0;
    for (int i = 0; i < places; ++i, rest /= 10) reversed[length++] = static_cast<char>('0' + rest % 10);
    bool zero = rest == 0;
    for (int i = 0; i < length; ++i) zero = zero && reversed[i] == '0';
    if (places > 0) reversed[length++] = '.';
    do {
        reversed[length++] = static_cast<char>('0' + rest % 10);
        rest /= 10;
    } while (rest != 0);
    if (value.millionths < 0 && !zero) reversed[length++] = '-';
    for (int i = 0; i < length; ++i) buffer[i] = reversed[length - 1 - i];
    return length;
}

}  // namespace fovea
