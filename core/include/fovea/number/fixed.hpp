// SPDX-License-Identifier: MIT
//
// Fixed: a number with a fixed count of fraction bits, and the formats that fovea's interfaces use.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include <fovea/base/assert.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

/// raw / 2^FractionBits, with no implicit conversion in or out.
///
/// Overflow  sums and differences must fit Rep: the interface that uses a format states why they do
/// Rounding  to the nearest, ties toward plus infinity, wherever bits are dropped
template <class Rep, int FractionBits>
class Fixed {
public:
    static_assert(std::is_integral_v<Rep> && std::is_signed_v<Rep>, "Fixed is made of a signed integer");
    static_assert(FractionBits >= 0 && FractionBits < static_cast<int>(sizeof(Rep) * 8) - 1,
                  "too many fraction bits: 1 itself must fit");

    static constexpr int fraction_bits = FractionBits;
    static constexpr Rep one = static_cast<Rep>(static_cast<Rep>(1) << FractionBits);

    constexpr Fixed() = default;
    static constexpr Fixed from_raw(Rep raw) {
        Fixed number;
        number.raw_ = raw;
        return number;
    }
    static constexpr Fixed from_int(int value) {
        return from_raw(static_cast<Rep>(static_cast<Rep>(value) * one));
    }
    /// numerator / denominator, rounded, saturated at the ends of the format. denominator > 0, |numerator| <
    /// 2^62 / one.
    static constexpr Fixed from_ratio(std::int64_t numerator, std::int64_t denominator) {
        return from_raw(saturate_cast<Rep>(round_divide(numerator * one, denominator)));
    }

    constexpr Rep raw() const { return raw_; }
    constexpr int floor() const { return static_cast<int>(raw_ >> FractionBits); }
    constexpr int round() const { return static_cast<int>(shifted_down(raw_, FractionBits)); }

    /// The same number in another format, rounded and saturated.
    template <class To>
    constexpr To convert() const {
        using ToRep = decltype(To().raw());
        constexpr int drop = FractionBits - To::fraction_bits;
        if constexpr (drop >= 0) {
            return To::from_raw(saturate_cast<ToRep>(shifted_down(raw_, drop)));
        } else {
            constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() >> -drop;
            if (raw_ > most) return To::from_raw(std::numeric_limits<ToRep>::max());
            if (raw_ < -most - 1) return To::from_raw(std::numeric_limits<ToRep>::min());
            return To::from_raw(saturate_cast<ToRep>(std::int64_t{raw_} * (std::int64_t{1} << -drop)));
        }
    }

    friend constexpr Fixed operator+(Fixed a, Fixed b) { return from_raw(static_cast<Rep>(a.raw_ + b.raw_)); }
    friend constexpr Fixed operator-(Fixed a, Fixed b) { return from_raw(static_cast<Rep>(a.raw_ - b.raw_)); }
    friend constexpr Fixed operator-(Fixed a) { return from_raw(static_cast<Rep>(-a.raw_)); }
    friend constexpr Fixed operator*(Fixed a, int b) { return from_raw(static_cast<Rep>(a.raw_ * b)); }
    constexpr Fixed& operator+=(Fixed b) { return *this = *this + b; }
    constexpr Fixed& operator-=(Fixed b) { return *this = *this - b; }
    friend constexpr bool operator==(Fixed a, Fixed b) { return a.raw_ == b.raw_; }
    friend constexpr bool operator!=(Fixed a, Fixed b) { return a.raw_ != b.raw_; }
    friend constexpr bool operator<(Fixed a, Fixed b) { return a.raw_ < b.raw_; }
    friend constexpr bool operator>(Fixed a, Fixed b) { return a.raw_ > b.raw_; }
    friend constexpr bool operator<=(Fixed a, Fixed b) { return a.raw_ <= b.raw_; }
    friend constexpr bool operator>=(Fixed a, Fixed b) { return a.raw_ >= b.raw_; }

private:
    /// round_shift() for numbers of 64 bits too: the half is added after the shift, as the bit that decides.
    static constexpr std::int64_t shifted_down(std::int64_t value, int bits) {
        return bits == 0 ? value : (value >> bits) + (value >> (bits - 1) & 1);
    }

    Rep raw_ = 0;
};

/// A sub-pixel coordinate or length in an image: 1/256 px, up to 8 million px.
using SubPixel = Fixed<std::int32_t, 8>;

/// A place or length that was measured: 1/65536 px, up to 32767 px.
using FinePixel = Fixed<std::int32_t, 16>;

/// A brightness between the grey levels, or a step of it: 1/65536 level.
using GrayLevel = Fixed<std::int32_t, 16>;

/// A share, a margin, a score: 1/65536.
using Ratio = Fixed<std::int32_t, 16>;

/// A sine, a cosine, a component of a unit vector: 2^-30, from -2 to just below 2.
using Unit = Fixed<std::int32_t, 30>;

}  // namespace fovea
