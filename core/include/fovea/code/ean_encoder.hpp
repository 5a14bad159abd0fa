// SPDX-License-Identifier: MIT
//
// EAN and UPC codes as bars and spaces. ISO/IEC 15420.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/ean_tables.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Bars and spaces in turn, the first is a bar: their widths in modules.
using BarWidths = ListView<std::uint8_t>;

/// The bars of a code, of its digits in ASCII. The check digit is added where it is left out, and verified
/// where it is there; the 8 digits of a UPC-E begin with its number system, 0 or 1.
///
/// Shapes  12 or 13 digits for EAN-13, 7 or 8 for EAN-8, 11 or 12 for UPC-A, 7 or 8 for UPC-E, 2 or 5 for
///         an add-on, which stands 7 to 12 modules behind its code
/// Errors  bad_argument for other counts, what is no digit and a wrong check digit; buffer_too_small, with
///         the list untouched. The list is appended to
/// Source  ISO/IEC 15420, 4.2
constexpr Status encode_ean_13(Span<const std::uint8_t> text, BarWidths widths);
constexpr Status encode_ean_8(Span<const std::uint8_t> text, BarWidths widths);
constexpr Status encode_upc_a(Span<const std::uint8_t> text, BarWidths widths);
constexpr Status encode_upc_e(Span<const std::uint8_t> text, BarWidths widths);
constexpr Status encode_add_on(Span<const std::uint8_t> text, BarWidths widths);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Widths that are added one by one, once there is room for all of them.
class BarWriter {
public:
    explicit constexpr BarWriter(BarWidths widths) : widths_(widths) {}
    constexpr void add(int width) { static_cast<void>(widths_.push(static_cast<std::uint8_t>(width))); }
    constexpr void guard(int runs) {
        for (int i = 0; i < runs; ++i) add(1);
    }
    constexpr void digit(int value, bool set_b) {
        for (int i = 0; i < 4; ++i) add(ean_widths[value][set_b ? 3 - i : i]);
    }

private:
    BarWidths widths_;
};

constexpr bool has_room(const BarWidths& widths, int runs) {
    return widths.capacity() - widths.size() >= runs;
}

/// The digits of the text, and the check digit behind them. False where they are none.
template <std::size_t Count>
constexpr bool take_digits(Span<const std::uint8_t> text, std::uint8_t (&digits)[Count]) {
    constexpr auto count = static_cast<std::ptrdiff_t>(Count);
    if (text.size() != count && text.size() != count - 1) return false;
    for (std::ptrdiff_t i = 0; i < text.size(); ++i) {
        if (text[i] < '0' || text[i] > '9') return false;
        digits[i] = static_cast<std::uint8_t>(text[i] - '0');
    }
    return true;
}

}  // namespace detail

constexpr Status encode_ean_13(Span<const std::uint8_t> text, BarWidths widths) {
    std::uint8_t digits[13] = {};
    if (!detail::take_digits(text, digits)) return Status::bad_argument;
    const int check = ean_check_digit({digits, 12});
    if (text.size() == 13 && digits[12] != check) return Status::bad_argument;
    digits[12] = static_cast<std::uint8_t>(check);
    if (!detail::has_room(widths, 59)) return Status::buffer_too_small;
    detail::BarWriter writer(widths);
    writer.guard(3);
    for (int i = 1; i <= 6; ++i) writer.digit(digits[i], (ean_13_parity[digits[0]] >> (6 - i) & 1) != 0);
    writer.guard(5);
    for (int i = 7; i <= 12; ++i) writer.digit(digits[i], false);
    writer.guard(3);
    return Status::ok;
}

constexpr Status encode_upc_a(Span<const std::uint8_t> text, BarWidths widths) {
    if (text.size() != 11 && text.size() != 12) return Status::bad_argument;
    std::uint8_t digits[13] = {'0'};
    for (std::ptrdiff_t i = 0; i < text.size(); ++i) digits[i + 1] = text[i];
    return encode_ean_13({digits, text.size() + 1}, widths);
}

constexpr Status encode_ean_8(Span<const std::uint8_t> text, BarWidths widths) {
    std::uint8_t digits[8] = {};
    if (!detail::take_digits(text, digits)) return Status::bad_argument;
    const int check = ean_check_digit({digits, 7});
    if (text.size() == 8 && digits[7] != check) return Status::bad_argument;
    digits[7] = static_cast<std::uint8_t>(check);
    if (!detail::has_room(widths, 43)) return Status::buffer_too_small;
    detail::BarWriter writer(widths);
    writer.guard(3);
    for (int i = 0; i < 4; ++i) writer.digit(digits[i], false);
    writer.guard(5);
    for (int i = 4; i < 8; ++i) writer.digit(digits[i], false);
    writer.guard(3);
    return Status::ok;
}

constexpr Status encode_upc_e(Span<const std::uint8_t> text, BarWidths widths) {
    std::uint8_t digits[8] = {};
    if (!detail::take_digits(text, digits) || digits[0] > 1) return Status::bad_argument;
    std::uint8_t upc_a[12] = {};
    upc_a_of_upc_e(digits, upc_a);
    const int check = ean_check_digit({upc_a, 11});
    if (text.size() == 8 && digits[7] != check) return Status::bad_argument;
    if (!detail::has_room(widths, 33)) return Status::buffer_too_small;
    const int parity = upc_e_parity[check] ^ (digits[0] == 1 ? 0b111111 : 0);
    detail::BarWriter writer(widths);
    writer.guard(3);
    for (int i = 1; i <= 6; ++i) writer.digit(digits[i], (parity >> (6 - i) & 1) != 0);
    writer.guard(6);
    return Status::ok;
}

constexpr Status encode_add_on(Span<const std::uint8_t> text, BarWidths widths) {
    const auto count = static_cast<int>(text.size());
    if (count != 2 && count != 5) return Status::bad_argument;
    std::uint8_t digits[5] = {};
    for (int i = 0; i < count; ++i) {
        if (text[i] < '0' || text[i] > '9') return Status::bad_argument;
        digits[i] = static_cast<std::uint8_t>(text[i] - '0');
    }
    if (!detail::has_room(widths, 6 * count + 1)) return Status::buffer_too_small;
    const int parity =
        count == 2 ? (digits[0] * 10 + digits[1]) % 4 : add_on_5_parity[add_on_5_check({digits, 5})];
    detail::BarWriter writer(widths);
    writer.add(1);
    writer.add(1);
    writer.add(2);
    for (int i = 0; i < count; ++i) {
        if (i > 0) writer.guard(2);
        writer.digit(digits[i], (parity >> (count - 1 - i) & 1) != 0);
    }
    return Status::ok;
}

}  // namespace fovea
