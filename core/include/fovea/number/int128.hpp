// SPDX-License-Identifier: MIT
//
// Int128: exact sums and products beyond 64 bits, for moments and fits. Made of two 64-bit words, so that
// a chip gives the same bits.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/wide.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A two's complement number of 128 bits. Sums and products must fit: the user states why they do.
class Int128 {
public:
    constexpr Int128() = default;
    constexpr Int128(std::int64_t value)
        : high_(value < 0 ? ~std::uint64_t{0} : 0), low_(static_cast<std::uint64_t>(value)) {}

    /// The exact product of two 64-bit numbers.
    static constexpr Int128 product(std::int64_t a, std::int64_t b);
    /// The same made of words of 64 bits: what product() does where the compiler knows no longer numbers.
    static constexpr Int128 product_in_words(std::int64_t a, std::int64_t b);

    constexpr bool negative() const { return high_ >> 63 != 0; }
    constexpr bool fits_int64() const {
        return high_ == (low_ >> 63 != 0 ? ~std::uint64_t{0} : std::uint64_t{0});
    }
    /// The low word; the number itself when fits_int64().
    constexpr std::int64_t low_word() const { return static_cast<std::int64_t>(low_); }
    /// Bits that the magnitude needs: 0 for 0, 127 or 128 at most.
    constexpr int bit_length() const {
        const Int128 size = negative() ? -*this : *this;
        return size.high_ != 0 ? 128 - leading_zeros(size.high_) : 64 - leading_zeros(size.low_);
    }

    friend constexpr Int128 operator+(Int128 a, Int128 b) {
        const std::uint64_t low = a.low_ + b.low_;
        return Int128(a.high_ + b.high_ + (low < a.low_ ? 1u : 0u), low);
    }
    friend constexpr Int128 operator-(Int128 a) { return Int128(~a.high_, ~a.low_) + Int128(0, 1); }
    friend constexpr Int128 operator-(Int128 a, Int128 b) { return a + -b; }
    friend constexpr Int128 operator*(Int128 a, std::int64_t b) {
        const Int128 size = a.negative() ? -a : a;
        Int128 result = product_of(size.low_, magnitude(b));
        result.high_ += size.high_ * magnitude(b);
        return a.negative() != (b < 0) ? -result : result;
    }
    constexpr Int128& operator+=(Int128 b) { return *this = *this + b; }
    constexpr Int128& operator-=(Int128 b) { return *this = *this - b; }
    /// Toward minus infinity; bits 0..127.
    friend constexpr Int128 operator>>(Int128 a, int bits) {
        FOVEA_ASSERT(bits >= 0 && bits < 128);
        const std::uint64_t sign = a.negative() ? ~std::uint64_t{0} : 0;
        if (bits == 0) return a;
        if (bits == 64) return Int128(sign, a.high_);
        if (bits > 64) return Int128(sign, a.high_ >> (bits - 64) | sign << (128 - bits));
        return Int128(a.high_ >> bits | sign << (64 - bits), a.high_ << (64 - bits) | a.low_ >> bits);
    }
    friend constexpr Int128 operator<<(Int128 a, int bits) {
        FOVEA_ASSERT(bits >= 0 && bits < 128);
        if (bits == 0) return a;
        if (bits >= 64) return Int128(a.low_ << (bits - 64), 0);
        return Int128(a.high_ << bits | a.low_ >> (64 - bits), a.low_ << bits);
    }
    friend constexpr bool operator==(Int128 a, Int128 b) { return a.high_ == b.high_ && a.low_ == b.low_; }
    friend constexpr bool operator!=(Int128 a, Int128 b) { return !(a == b); }
    friend constexpr bool operator<(Int128 a, Int128 b) {
        if (a.high_ != b.high_)
            return static_cast<std::int64_t>(a.high_) < static_cast<std::int64_t>(b.high_);
        return a.low_ < b.low_;
    }

private:
    constexpr Int128(std::uint64_t high, std::uint64_t low) : high_(high), low_(low) {}
    static constexpr Int128 product_of(std::uint64_t x, std::uint64_t y);
    friend constexpr std::int64_t round_divide(Int128 value, Int128 divisor);

    std::uint64_t high_ = 0;
    std::uint64_t low_ = 0;
};

/// Quotient to the nearest, ties toward plus infinity, held at the ends of 64 bits. divisor not 0; both
/// magnitudes below 2^126.
constexpr std::int64_t round_divide(Int128 value, Int128 divisor);

/// a * b / divisor to the nearest, ties toward plus infinity, held at the ends of 64 bits. divisor not 0,
/// |a| and |b| below 2^63.
constexpr std::int64_t multiply_divide(std::int64_t a, std::int64_t b, std::int64_t divisor) {
    return round_divide(Int128::product(a, b), Int128(divisor));
}

// ---- Implementation ---------------------------------------------------------------

constexpr Int128 Int128::product_of(std::uint64_t x, std::uint64_t y) {
    const auto x_low = static_cast<std::uint32_t>(x);
    const auto y_low = static_cast<std::uint32_t>(y);
    const auto x_high = static_cast<std::uint32_t>(x >> 32);
    const auto y_high = static_cast<std::uint32_t>(y >> 32);
    const std::uint64_t bottom = multiply_words(x_low, y_low);
    // At most (2^32-1)^2 + 2^32-1 < 2^64, and the same once more for the second middle product.
    const std::uint64_t middle = multiply_words(x_high, y_low) + (bottom >> 32);
    const std::uint64_t second = multiply_words(x_low, y_high) + (middle & 0xffffffffu);
    return Int128(multiply_words(x_high, y_high) + (middle >> 32) + (second >> 32),
                  second << 32 | (bottom & 0xffffffffu));
}

constexpr Int128 Int128::product_in_words(std::int64_t a, std::int64_t b) {
    const Int128 size = product_of(magnitude(a), magnitude(b));
    return (a < 0) != (b < 0) ? -size : size;
}

#if defined(__SIZEOF_INT128__)

namespace detail {
__extension__ using SignedWord128 = __int128;
}  // namespace detail

constexpr Int128 Int128::product(std::int64_t a, std::int64_t b) {
    const detail::SignedWord128 whole = static_cast<detail::SignedWord128>(a) * b;
    return Int128(static_cast<std::uint64_t>(whole >> 64), static_cast<std::uint64_t>(whole));
}

#else

constexpr Int128 Int128::product(std::int64_t a, std::int64_t b) { return product_in_words(a, b); }

#endif

constexpr std::int64_t round_divide(Int128 value, Int128 divisor) {
    FOVEA_ASSERT(divisor != Int128(0));
    const bool negative = value.negative() != divisor.negative();
    const Int128 size = value.negative() ? -value : value;
    const Int128 by = divisor.negative() ? -divisor : divisor;
    FOVEA_ASSERT(size.bit_length() <= 126 && by.bit_length() <= 126);

    const std::uint64_t most = negative ? std::uint64_t{1} << 63 : ~std::uint64_t{0} >> 1;
    std::uint64_t quotient = 0;
    Int128 rest = size;
    if (size.high_ == 0 && by.high_ == 0) {
        quotient = size.low_ / by.low_;
        rest = Int128(0, size.low_ % by.low_);
    } else {
        // Long division, one bit a step, over the bits that the quotient can have.
        const int steps = size.bit_length() - by.bit_length() + 1;
        if (steps > 64) return static_cast<std::int64_t>(most);
        for (int i = steps - 1; i >= 0; --i) {
            const Int128 part = by << i;
            quotient <<= 1;
            if (!(rest < part)) {
                rest -= part;
                quotient |= 1;
            }
        }
    }
    const Int128 twice = rest << 1;
    const bool away = negative ? by < twice : !(twice < by);
    if (quotient >= most) return static_cast<std::int64_t>(most);
    quotient += away ? 1 : 0;
    return static_cast<std::int64_t>(negative ? 0u - quotient : quotient);
}

}  // namespace fovea
