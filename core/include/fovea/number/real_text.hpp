// SPDX-License-Identifier: MIT
//
// Real numbers as people and files write them: read and written exactly, without binary floating point.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/real.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Digits of a decimal number that count: from the first that is not 0.
inline constexpr int max_real_digits = 40;
/// Magnitudes beside 0 that are read: 10^-60 up to 10^60; a tenth less at both ends is written.
inline constexpr int max_real_power = 60;
/// Digits with which a number that was written is read as the same Real.
inline constexpr int whole_real_digits = 21;

/// Reads [+-]digits[.digits][e[+-]digits], all of the text; E too.
///
/// Rounding  the nearest Real, of two the one whose last digit is 0
/// Errors    malformed for anything else (no digit on a side of the point, blanks, "inf"); out_of_range for
///           more than max_real_digits, or a magnitude outside of 10^-60 up to 10^60 that is not 0
constexpr Result<Real> parse_real(Span<const char> text);

/// Writes a number with so many digits that count, 1 to whole_real_digits, and answers the length: "-0.25",
/// "536.454766207", "1.5e-09"; with an exponent below 10^-4 and from 10^digits on. Zeros at the end are left
/// out.
///
/// Rounding  the nearest decimal number, of two the one whose last digit is even
/// Errors    bad_argument for the digits; out_of_range for a magnitude outside of 10^-59 up to 10^59 that is
///           not 0; buffer_too_small below 8 + digits characters of room
constexpr Result<int> print_real(Real value, int digits, Span<char> buffer);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A whole number of up to 544 bits, lowest word first: 10^100 times 64 bits, shifted by 64, has 461.
class LongNumber {
public:
    static constexpr int words = 17;

    constexpr LongNumber() = default;
    constexpr explicit LongNumber(std::uint64_t value) {
        words_[0] = static_cast<std::uint32_t>(value);
        words_[1] = static_cast<std::uint32_t>(value >> 32);
    }

    /// times factor plus summand; both below 2^32.
    constexpr void multiply_add(std::uint32_t factor, std::uint32_t summand) {
        std::uint64_t carry = summand;
        for (std::uint32_t& word : words_) {
            carry += std::uint64_t{word} * factor;
            word = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        FOVEA_ASSERT(carry == 0);
    }
    constexpr void multiply_by_power_of_ten(int power) {
        for (; power >= 9; power -= 9) multiply_add(1000000000u, 0);
        for (; power > 0; --power) multiply_add(10, 0);
    }
    constexpr void shift_left(int bits) {
        const int whole = bits / 32;
        const int part = bits % 32;
        for (int i = words - 1; i >= 0; --i) {
            const std::uint64_t high = i - whole >= 0 ? words_[i - whole] : 0;
            const std::uint64_t low = i - whole - 1 >= 0 ? words_[i - whole - 1] : 0;
            words_[i] = static_cast<std::uint32_t>((high << 32 | low) << part >> 32);
        }
    }
    constexpr int bit_length() const {
        for (int i = words - 1; i >= 0; --i)
            if (words_[i] != 0) return 32 * i + 32 - leading_zeros(words_[i]);
        return 0;
    }
    friend constexpr bool operator<(const LongNumber& a, const LongNumber& b) {
        for (int i = words - 1; i >= 0; --i)
            if (a.words_[i] != b.words_[i]) return a.words_[i] < b.words_[i];
        return false;
    }
    friend constexpr bool operator==(const LongNumber& a, const LongNumber& b) {
        return !(a < b) && !(b < a);
    }
    constexpr void subtract(const LongNumber& b) {
        std::uint64_t borrow = 0;
        for (int i = 0; i < words; ++i) {
            const std::uint64_t difference = std::uint64_t{words_[i]} - b.words_[i] - borrow;
            words_[i] = static_cast<std::uint32_t>(difference);
            borrow = difference >> 63;
        }
    }

private:
    std::uint32_t words_[words] = {};
};

/// numerator / divisor as the nearest Real. Neither is 0; both below 2^400.
constexpr Real nearest_real(bool negative, LongNumber numerator, LongNumber divisor) {
    // One of both is shifted until the quotient is above 1/2 and below 2.
    const int raise = divisor.bit_length() - numerator.bit_length();
    (raise > 0 ? numerator : divisor).shift_left(raise > 0 ? raise : -raise);
    // Its 64 digits, and the next to round by. The first may be 0.
    const bool below_one = numerator < divisor;
    if (below_one) numerator.shift_left(1);
    std::uint64_t digits = 0;
    for (int i = 0; i < 64; ++i) {
        digits <<= 1;
        if (!(numerator < divisor)) {
            numerator.subtract(divisor);
            digits |= 1;
        }
        numerator.shift_left(1);
    }
    const int exponent = -raise - (below_one ? 1 : 0) - 63;
    const bool half = numerator == divisor;
    const bool up = half ? (digits & 1) != 0 : divisor < numerator;
    const std::int64_t last = static_cast<std::int64_t>(digits & 1) + (up ? 1 : 0);
    const Real size =
        Real::from_int(static_cast<std::int64_t>(digits >> 1), exponent + 1) + Real::from_int(last, exponent);
    return negative ? -size : size;
}

constexpr bool is_digit(char character) { return character >= '0' && character <= '9'; }

}  // namespace detail

constexpr Result<Real> parse_real(Span<const char> text) {
    std::ptrdiff_t at = 0;
    bool negative = false;
    if (!text.empty() && (text[0] == '+' || text[0] == '-')) negative = text[at++] == '-';

    detail::LongNumber number;
    int digits = 0;
    int power = 0;
    bool point = false;
    std::ptrdiff_t in_part = 0;
    bool too_long = false;
    for (; at < text.size(); ++at) {
        if (text[at] == '.' && !point && in_part > 0) {
            point = true;
            in_part = 0;
            continue;
        }
        if (!detail::is_digit(text[at])) break;
        ++in_part;
        const int digit = text[at] - '0';
        // Zeros in front do not count, but for the power.
        if (digits > 0 || digit != 0) ++digits;
        if (point) power = maximum(power - 1, -100000);
        // A number of which so much is 0 is out of range whatever its exponent says; 0 itself is not.
        too_long = too_long || digits > max_real_digits || (digits > 0 && power < -1000);
        if (too_long) {
            digits = 0;
            power = 0;
            continue;
        }
        number.multiply_add(10, static_cast<std::uint32_t>(digit));
    }
    if (in_part == 0) return Status::malformed;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        bool minus = false;
        if (at < text.size() && (text[at] == '+' || text[at] == '-')) minus = text[at++] == '-';
        int written = 0;
        std::ptrdiff_t count = 0;
        for (; at < text.size() && detail::is_digit(text[at]); ++at, ++count)
            written = minimum(written * 10 + (text[at] - '0'), 10000);
        if (count == 0) return Status::malformed;
        power += minus ? -written : written;
    }
    if (at != text.size()) return Status::malformed;
    if (too_long) return Status::out_of_range;
    if (digits == 0) return Real();
    // The first digit stands for 10^(power + digits - 1).
    const int first = power + digits - 1;
    if (first < -max_real_power || first >= max_real_power) return Status::out_of_range;
    detail::LongNumber divisor(1);
    if (power >= 0) number.multiply_by_power_of_ten(power);
    if (power < 0) divisor.multiply_by_power_of_ten(-power);
    return detail::nearest_real(negative, number, divisor);
}

constexpr Result<int> print_real(Real value, int digits, Span<char> buffer) {
    if (digits < 1 || digits > whole_real_digits) return Status::bad_argument;
    if (value.zero()) {
        if (buffer.size() < 8 + digits) return Status::buffer_too_small;
        buffer[0] = '0';
        return 1;
    }
    // 10^60 is below 2^200.
    const int exponent = value.exponent();
    if (exponent < -200 || exponent >= 200) return Status::out_of_range;

    // value / 10^power from 1 up to 10; the power is first taken from the exponent, and may be one too many.
    int power = floor_divide(exponent * 1233, 4096) + 1;
    detail::LongNumber numerator;
    detail::LongNumber divisor;
    for (bool right = false; !right; --power) {
        numerator = detail::LongNumber(value.mantissa());
        divisor = detail::LongNumber(1);
        if (power < 0) numerator.multiply_by_power_of_ten(-power);
        if (power > 0) divisor.multiply_by_power_of_ten(power);
        (exponent > 63 ? numerator : divisor).shift_left(exponent > 63 ? exponent - 63 : 63 - exponent);
        right = !(numerator < divisor);
    }
    ++power;
    if (power <= -max_real_power || power >= max_real_power - 1) return Status::out_of_range;

    char figures[whole_real_digits + 1] = {};
    for (int i = 0; i < digits; ++i) {
        figures[i] = '0';
        while (!(numerator < divisor)) {
            numerator.subtract(divisor);
            ++figures[i];
        }
        numerator.multiply_add(10, 0);
    }
    // What is left is ten times what the next digit would be made of.
    divisor.multiply_add(5, 0);
    const bool half = numerator == divisor;
    if (half ? (figures[digits - 1] - '0') % 2 != 0 : divisor < numerator) {
        int at = digits - 1;
        for (; at >= 0 && figures[at] == '9'; --at) figures[at] = '0';
        if (at >= 0) ++figures[at];
        if (at < 0) {
            figures[0] = '1';
            ++power;
        }
    }
    int count = digits;
    while (count > 1 && figures[count - 1] == '0') --count;

    if (buffer.size() < 8 + digits) return Status::buffer_too_small;
    int length = 0;
    const auto put = [&](char character) { buffer[length++] = character; };
    if (value.negative()) put('-');
    const bool plain = power >= -4 && power < digits;
    if (plain && power < 0) {
        put('0');
        put('.');
        for (int i = -1; i > power; --i) put('0');
    }
    // Of a plain number at least the digits before its point.
    for (int i = 0; i < count || (plain && i <= power); ++i) {
        if (i > 0 && i == (plain ? power + 1 : 1) && (!plain || power >= 0)) put('.');
        put(i < count ? figures[i] : '0');
    }
    if (!plain) {
        put('e');
        put(power < 0 ? '-' : '+');
        const int size = power < 0 ? -power : power;
        put(static_cast<char>('0' + size / 10));
        put(static_cast<char>('0' + size % 10));
    }
    return length;
}

}  // namespace fovea
