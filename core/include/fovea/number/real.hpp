// SPDX-License-Identifier: MIT
//
// Real: the number that geometry is calculated with. 64 binary digits at any scale, made of integers alone,
// so that every machine has the same digits.
#pragma once

#include <cstdint>
#include <limits>

#include <fovea/base/assert.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/wide.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

namespace detail {
/// 64 bits that want no more alignment than 32: three words make a number.
using Digits [[gnu::aligned(4)]] = std::uint64_t;
inline constexpr int real_bias = 1 << 28;
inline constexpr std::uint64_t real_top = std::uint64_t{1} << 63;
}  // namespace detail

/// -1 or 1 times mantissa * 2^(exponent - 63).
///
/// Range     mantissa 0, or 2^63 up to 2^64; exponents of results stay within 2^28: the user states why they
///           do. There is one zero, no infinity, and no state of error
/// Rounding  magnitudes are cut, which keeps every result within 2^-63 of the true one, roots within 1.5 *
///           2^-63: a product and a quotient are the true magnitude cut after 64 digits; so is a root, but of
///           an even exponent() the last digit is left out before; a sum shifts the smaller number right
///           until the exponents agree, keeps one digit more where signs differ, and then cuts. Digits do not
///           depend on signs or on the order of the operands
/// Layout    12 bytes; all of them 0 is 0
class Real {
public:
    constexpr Real() = default;
    /// value * 2^exponent, cut after 64 digits.
    static constexpr Real from_int(std::int64_t value, int exponent = 0) {
        return normalised(value < 0, magnitude(value), exponent + 63);
    }
    static constexpr Real from_int(Int128 value, int exponent = 0);
    /// numerator / denominator; 0 for a denominator of 0.
    static constexpr Real from_ratio(std::int64_t numerator, std::int64_t denominator) {
        return from_int(numerator) / from_int(denominator);
    }
    template <class Rep, int FractionBits>
    static constexpr Real from_fixed(Fixed<Rep, FractionBits> value) {
        return from_int(std::int64_t{value.raw()}, -FractionBits);
    }
    static constexpr Real one() { return make(false, detail::real_top, 0); }

    constexpr bool zero() const { return mantissa_ == 0; }
    constexpr bool negative() const { return (scale_ & 1) != 0; }
    constexpr bool positive() const { return mantissa_ != 0 && (scale_ & 1) == 0; }
    constexpr std::uint64_t mantissa() const { return mantissa_; }
    /// Of a number that is not 0: 2^exponent() is at most its magnitude, and twice as much is not.
    constexpr int exponent() const { return static_cast<int>(scale_ >> 1) - detail::real_bias; }

    /// The number times 2^bits to the nearest, ties away from 0, held at the ends of 64 bits.
    constexpr std::int64_t rounded(int bits) const;
    /// The nearest number of a format, ties away from 0, held at its ends.
    template <class To>
    constexpr To to_fixed() const {
        return To::from_raw(saturate_cast<decltype(To().raw())>(rounded(To::fraction_bits)));
    }

    friend constexpr Real operator-(Real a) {
        a.scale_ ^= a.zero() ? 0u : 1u;
        return a;
    }
    friend constexpr Real operator+(const Real& a, const Real& b) { return sum(a, b); }
    friend constexpr Real operator-(const Real& a, const Real& b) {
        Real negative = b;
        negative.scale_ ^= 1u;
        return sum(a, negative);
    }
    friend constexpr Real operator*(const Real& a, const Real& b);
    /// 0 for a divisor of 0: who divides looks at the divisor before.
    friend constexpr Real operator/(const Real& a, const Real& b);
    constexpr Real& operator+=(const Real& b) { return *this = *this + b; }
    constexpr Real& operator-=(const Real& b) { return *this = *this - b; }
    constexpr Real& operator*=(const Real& b) { return *this = *this * b; }
    constexpr Real& operator/=(const Real& b) { return *this = *this / b; }

    friend constexpr bool operator==(const Real& a, const Real& b) {
        return a.mantissa_ == b.mantissa_ && a.scale_ == b.scale_;
    }
    friend constexpr bool operator!=(const Real& a, const Real& b) { return !(a == b); }
    friend constexpr bool operator<(const Real& a, const Real& b);
    friend constexpr bool operator>(const Real& a, const Real& b) { return b < a; }
    friend constexpr bool operator<=(const Real& a, const Real& b) { return !(b < a); }
    friend constexpr bool operator>=(const Real& a, const Real& b) { return !(a < b); }

    constexpr Real absolute() const {
        Real result = *this;
        result.scale_ &= ~1u;
        return result;
    }
    /// The number times 2^bits, exact.
    constexpr Real scaled(int bits) const {
        Real result = *this;
        if (!zero()) result.scale_ += static_cast<std::uint32_t>(bits) << 1;
        FOVEA_ASSERT(result.exponent() > -detail::real_bias || zero());
        return result;
    }
    /// The root of the magnitude.
    constexpr Real square_root() const;

    /// Sums in two ways that give the same: short for chips, and without a branch for processors that guess
    /// them. The operators choose.
    static constexpr Real sum_with_branches(const Real& a, const Real& b);
    static constexpr Real sum_without_branches(Real a, Real b);

private:
    constexpr Real(std::uint64_t mantissa, std::uint32_t scale) : mantissa_(mantissa), scale_(scale) {}
    static constexpr Real make(bool negative, std::uint64_t mantissa, int exponent) {
        FOVEA_ASSERT(exponent > -detail::real_bias && exponent < detail::real_bias);
        return {mantissa,
                static_cast<std::uint32_t>(exponent + detail::real_bias) << 1 | (negative ? 1u : 0u)};
    }
    /// mantissa * 2^(exponent - 63), whatever bits the mantissa has.
    static constexpr Real normalised(bool negative, std::uint64_t mantissa, int exponent) {
        if (mantissa == 0) return {};
        const int raise = leading_zeros(mantissa);
        return make(negative, mantissa << raise, exponent - raise);
    }
    static constexpr Real sum(const Real& a, const Real& b) {
        return sizeof(void*) > 4 ? sum_without_branches(a, b) : sum_with_branches(a, b);
    }

    detail::Digits mantissa_ = 0;
    // Twice the exponent, kept as an unsigned number, so that 0 has the smallest; 1 more if negative.
    std::uint32_t scale_ = 0;
};

// ---- Implementation ---------------------------------------------------------------

constexpr Real Real::from_int(Int128 value, int exponent) {
    const Int128 size = value.negative() ? -value : value;
    const int drop = maximum(size.bit_length() - 64, 0);
    return normalised(value.negative(), static_cast<std::uint64_t>((size >> drop).low_word()),
                      exponent + drop + 63);
}

constexpr std::int64_t Real::rounded(int bits) const {
    const std::int64_t drop = std::int64_t{63} - exponent() - bits;
    if (zero() || drop > 64) return 0;
    if (drop < 1)
        return negative() ? std::numeric_limits<std::int64_t>::min()
                          : std::numeric_limits<std::int64_t>::max();
    const std::uint64_t half = mantissa() >> (drop - 1);
    const std::uint64_t size = (half >> 1) + (half & 1);
    if (size >= detail::real_top)
        return negative() ? std::numeric_limits<std::int64_t>::min()
                          : std::numeric_limits<std::int64_t>::max();
    return negative() ? -static_cast<std::int64_t>(size) : static_cast<std::int64_t>(size);
}

constexpr Real Real::sum_with_branches(const Real& a, const Real& b) {
    const bool swap = a.scale_ >> 1 < b.scale_ >> 1;
    const Real& large = swap ? b : a;
    const Real& small = swap ? a : b;
    const std::uint32_t drop = (large.scale_ >> 1) - (small.scale_ >> 1);
    if (drop > 63) return large;
    if (((large.scale_ ^ small.scale_) & 1) == 0) {
        const std::uint64_t total = large.mantissa_ + (small.mantissa_ >> drop);
        const bool carry = total < large.mantissa_;
        return carry ? Real(total >> 1 | detail::real_top, large.scale_ + 2) : Real(total, large.scale_);
    }
    if (drop == 0) {
        if (large.mantissa_ >= small.mantissa_)
            return normalised(large.negative(), large.mantissa_ - small.mantissa_, large.exponent());
        return normalised(small.negative(), small.mantissa_ - large.mantissa_, large.exponent());
    }
    const std::uint64_t aligned = small.mantissa_ >> (drop - 1);
    const std::uint64_t guard = aligned & 1;
    const std::uint64_t total = large.mantissa_ - (aligned >> 1) - guard;
    if (total >> 63 == 0) return normalised(large.negative(), total << 1 | guard, large.exponent() - 1);
    return {total, large.scale_};
}

constexpr Real Real::sum_without_branches(Real a, Real b) {
    // Which is larger, and the signs, are as good as random: processors that guess branches guess them wrong.
    const std::uint32_t a_size = a.scale_ >> 1;
    const std::uint32_t b_size = b.scale_ >> 1;
    const std::uint32_t swap =
        (a_size < b_size ? 1u : 0u) | ((a_size == b_size ? 1u : 0u) & (a.mantissa_ < b.mantissa_ ? 1u : 0u));
    const std::uint64_t mantissas = (a.mantissa_ ^ b.mantissa_) & (0 - std::uint64_t{swap});
    const std::uint32_t scales = (a.scale_ ^ b.scale_) & (0u - swap);
    const std::uint64_t large = a.mantissa_ ^ mantissas;
    const std::uint64_t small = b.mantissa_ ^ mantissas;
    const std::uint32_t scale = a.scale_ ^ scales;
    const std::uint32_t small_scale = b.scale_ ^ scales;
    const std::uint32_t drop = (scale >> 1) - (small_scale >> 1);
    if (drop > 63) return {large, scale};

    const std::uint64_t differ = 0 - std::uint64_t{(scale ^ small_scale) & 1};
    const std::uint64_t aligned = small >> drop;
    const std::uint64_t guard = (small << 1) >> drop & 1 & differ;
    // The sum; or the difference rounded down, with the guard digit behind it.
    const std::uint64_t total = large + (aligned ^ differ) + (differ & 1) - guard;
    const std::uint32_t carry = (total < large ? 1u : 0u) & ~static_cast<std::uint32_t>(differ);
    if ((total | carry) == 0)
        return guard == 0 ? Real()
                          : make((scale & 1) != 0, detail::real_top,
                                 static_cast<int>(scale >> 1) - detail::real_bias - 64);
    const int raise = leading_zeros(total | carry) & ~(0 - static_cast<int>(carry));
    const std::uint64_t digits = (total << raise | (guard << raise) >> 1) >> carry | std::uint64_t{carry}
                                                                                         << 63;
    return {digits, scale + 2 * carry - 2 * static_cast<std::uint32_t>(raise)};
}

constexpr Real operator*(const Real& a, const Real& b) {
    const Wide product = multiply_wide(a.mantissa_, b.mantissa_);
    // The sum of both scales, in which two signs would carry.
    const std::uint32_t scale =
        a.scale_ + b.scale_ - 2 * (a.scale_ & b.scale_ & 1) - 2 * std::uint32_t{detail::real_bias};
    FOVEA_ASSERT(product.high == 0 || (a.exponent() + b.exponent() > -detail::real_bias &&
                                       a.exponent() + b.exponent() < detail::real_bias - 1));
    if (product.high >> 63 != 0) return {product.high, scale + 2};
    if (product.high == 0) return {};
    return {product.high << 1 | product.low >> 63, scale};
}

constexpr Real operator/(const Real& a, const Real& b) {
    if (a.zero() || b.zero()) return {};
    const std::uint64_t quotient = divide_wide(a.mantissa_, b.mantissa_);
    const bool full = quotient >> 63 != 0;
    // One digit more where the first is 0: the remainder is below b, but twice it may not fit.
    const std::uint64_t rest = (a.mantissa_ << 63) - quotient * b.mantissa_;
    const bool next = rest >> 63 != 0 || rest << 1 >= b.mantissa_;
    return Real::make(a.negative() != b.negative(), full ? quotient : quotient << 1 | (next ? 1u : 0u),
                      a.exponent() - b.exponent() - (full ? 0 : 1));
}

constexpr bool operator<(const Real& a, const Real& b) {
    if (a.negative() != b.negative()) return a.negative();
    const bool less = a.scale_ != b.scale_ ? a.scale_ < b.scale_ : a.mantissa_ < b.mantissa_;
    return a.negative() ? !less && a != b : less;
}

constexpr Real Real::square_root() const {
    if (zero()) return {};
    // The mantissa as a part of 1, so that its exponent is one more; that must be even.
    const int above = exponent() + 1;
    const int odd = above & 1;
    return make(false, isqrt_wide(mantissa_ >> odd), (above + odd) / 2 - 1);
}

}  // namespace fovea
