// SPDX-License-Identifier: MIT
//
// Scaled: a number of 62 binary digits at any scale, for products of many factors whose size is not known
// beforehand. Made of integers alone, so that every machine has the same digits.
#pragma once

#include <cstdint>
#include <limits>

#include <fovea/base/assert.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A logarithm to the base 2: 1/65536.
using Log2 = Fixed<std::int32_t, 16>;

/// mantissa * 2^exponent.
///
/// Range     mantissa 0, or 2^61 to 2^62 - 1 in magnitude; exponents of results must stay within 2^30: the
///           user states why they do
/// Rounding  to 62 digits: a product and a quotient to a relative 2^-60, a sum to 2^-60 of the larger number.
///           Digits do not depend on signs
class Scaled {
public:
    constexpr Scaled() = default;
    static constexpr Scaled from_int(std::int64_t value) {
        return normalised(value < 0, magnitude(value), 0);
    }
    static constexpr Scaled from_int(Int128 value);

    constexpr std::int64_t mantissa() const { return mantissa_; }
    constexpr int exponent() const { return exponent_; }
    constexpr bool negative() const { return mantissa_ < 0; }
    constexpr bool zero() const { return mantissa_ == 0; }
    /// The number times 2^bits to the nearest, ties away from 0, held at the ends of 64 bits.
    constexpr std::int64_t rounded(int bits) const;

    friend constexpr Scaled operator-(Scaled a) { return Scaled(-a.mantissa_, a.exponent_); }
    friend constexpr Scaled operator+(Scaled a, Scaled b);
    friend constexpr Scaled operator-(Scaled a, Scaled b) { return a + -b; }
    friend constexpr Scaled operator*(Scaled a, Scaled b);
    /// b not 0.
    friend constexpr Scaled operator/(Scaled a, Scaled b);
    friend constexpr bool operator==(Scaled a, Scaled b) {
        return a.mantissa_ == b.mantissa_ && a.exponent_ == b.exponent_;
    }
    friend constexpr bool operator!=(Scaled a, Scaled b) { return !(a == b); }

private:
    constexpr Scaled(std::int64_t mantissa, int exponent) : mantissa_(mantissa), exponent_(exponent) {}
    static constexpr Scaled normalised(bool negative, std::uint64_t size, int exponent);

    std::int64_t mantissa_ = 0;
    std::int32_t exponent_ = 0;
};

/// The root of a whole number, to a relative 2^-60. value below 2^62.
constexpr Scaled root_of(std::uint64_t value);

/// The logarithm of the magnitude.
///
/// Rounding  within 0.51 of 1/65536; held at the ends of Log2
/// Errors    degenerate for 0
constexpr Result<Log2> log2_of(Scaled value);

// ---- Implementation ---------------------------------------------------------------

constexpr Scaled Scaled::normalised(bool negative, std::uint64_t size, int exponent) {
    if (size == 0) return {};
    const int raise = leading_zeros(size) - 2;
    const auto mantissa = static_cast<std::int64_t>(raise >= 0 ? size << raise : size >> -raise);
    return {negative ? -mantissa : mantissa, exponent - raise};
}

constexpr Scaled Scaled::from_int(Int128 value) {
    const Int128 size = value.negative() ? -value : value;
    const int drop = maximum(size.bit_length() - 62, 0);
    return normalised(value.negative(), static_cast<std::uint64_t>((size >> drop).low_word()), drop);
}

constexpr std::int64_t Scaled::rounded(int bits) const {
    const int raise = exponent_ + bits;
    const std::uint64_t size = magnitude(mantissa_);
    if (size == 0 || raise < -62) return 0;
    if (raise >= 2)
        return negative() ? std::numeric_limits<std::int64_t>::min()
                          : std::numeric_limits<std::int64_t>::max();
    const std::uint64_t whole = raise >= 0 ? size << raise : (size >> -raise) + (size >> (-raise - 1) & 1);
    return negative() ? -static_cast<std::int64_t>(whole) : static_cast<std::int64_t>(whole);
}

constexpr Scaled operator+(Scaled a, Scaled b) {
    if (a.zero()) return b;
    if (b.zero()) return a;
    if (a.exponent_ < b.exponent_) {
        const Scaled swap = a;
        a = b;
        b = swap;
    }
    const int drop = a.exponent_ - b.exponent_;
    if (drop > 62) return a;
    const auto low = static_cast<std::int64_t>(magnitude(b.mantissa_) >> drop);
    const std::int64_t sum = a.mantissa_ + (b.negative() ? -low : low);
    return Scaled::normalised(sum < 0, magnitude(sum), a.exponent_);
}

constexpr Scaled operator*(Scaled a, Scaled b) {
    if (a.zero() || b.zero()) return {};
    const Int128 size = Int128::product(static_cast<std::int64_t>(magnitude(a.mantissa_)),
                                        static_cast<std::int64_t>(magnitude(b.mantissa_)));
    // 2^122 up to 2^124, so 62 or 63 digits are left.
    return Scaled::normalised(a.negative() != b.negative(),
                              static_cast<std::uint64_t>((size >> 61).low_word()),
                              a.exponent_ + b.exponent_ + 61);
}

constexpr Scaled operator/(Scaled a, Scaled b) {
    FOVEA_ASSERT(!b.zero());
    if (a.zero()) return {};
    // 2^123 up to 2^124 over 2^61 up to 2^62.
    const Int128 raised = Int128(static_cast<std::int64_t>(magnitude(a.mantissa_))) << 62;
    const std::int64_t size = round_divide(raised, Int128(static_cast<std::int64_t>(magnitude(b.mantissa_))));
    return Scaled::normalised(a.negative() != b.negative(), static_cast<std::uint64_t>(size),
                              a.exponent_ - b.exponent_ - 62);
}

constexpr Scaled root_of(std::uint64_t value) {
    FOVEA_ASSERT(value >> 62 == 0);
    if (value == 0) return {};
    // Right to a relative 2^-31, and to 2^-62 after one step of Newton's.
    const int raise = leading_zeros(value) & ~1;
    const Scaled shift = Scaled::from_int(std::int64_t{1} << raise / 2);
    const Scaled root = Scaled::from_int(std::int64_t{isqrt(value << raise)}) / shift;
    const Scaled sum = root + Scaled::from_int(static_cast<std::int64_t>(value)) / root;
    return sum / Scaled::from_int(2);
}

constexpr Result<Log2> log2_of(Scaled value) {
    if (value.zero()) return Status::degenerate;
    // 1 to 2 in 2^-31. Squaring doubles the logarithm: what passes 2 is a digit. An error of 2^-31 in a
    // square counts less with every digit, 2^-30 in all.
    std::uint64_t part = magnitude(value.mantissa()) >> 30;
    std::int64_t digits = std::int64_t{value.exponent()} + 61;
    for (int i = 0; i < 17; ++i) {
        part = part * part >> 31;
        const auto digit = static_cast<int>(part >> 32);
        part >>= digit;
        digits = digits * 2 + digit;
    }
    return Log2::from_raw(saturate_cast<std::int32_t>(round_shift(digits, 1)));
}

}  // namespace fovea
