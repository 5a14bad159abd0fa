// SPDX-License-Identifier: MIT
//
// Integer helpers: the only ways in which fovea narrows, shifts and divides with rounding.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include <fovea/base/assert.hpp>

namespace fovea {

static_assert((-1 >> 1) == -1, "fovea needs an arithmetic right shift of negative numbers");

template <class T>
constexpr T minimum(T a, T b) {
    return b < a ? b : a;
}
template <class T>
constexpr T maximum(T a, T b) {
    return a < b ? b : a;
}
template <class T>
constexpr T clamp(T value, T low, T high) {
    return value < low ? low : value > high ? high : value;
}

/// The absolute value as unsigned, right for the most negative number too.
constexpr std::uint32_t magnitude(std::int32_t value) {
    return value < 0 ? 0u - static_cast<std::uint32_t>(value) : static_cast<std::uint32_t>(value);
}
constexpr std::uint64_t magnitude(std::int64_t value) {
    return value < 0 ? 0u - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
}

/// Narrows to To, held at To's ends.
template <class To, class From>
constexpr To saturate_cast(From value) {
    static_assert(std::is_integral_v<To> && std::is_integral_v<From>, "saturate_cast works on integers");
    static_assert(sizeof(To) < sizeof(std::int64_t) || std::is_signed_v<To>, "the target must fit int64");
    static_assert(sizeof(From) < sizeof(std::int64_t) || std::is_signed_v<From>, "the source must fit int64");
    const std::int64_t wide = static_cast<std::int64_t>(value);
    const std::int64_t low = static_cast<std::int64_t>(std::numeric_limits<To>::min());
    const std::int64_t high = static_cast<std::int64_t>(std::numeric_limits<To>::max());
    return static_cast<To>(clamp(wide, low, high));
}

/// value / 2^bits to the nearest, ties toward plus infinity. value + 2^(bits-1) must not overflow.
template <class T>
constexpr T round_shift(T value, int bits) {
    if (bits <= 0) return value;
    return static_cast<T>((value + (static_cast<T>(1) << (bits - 1))) >> bits);
}

/// Quotient toward minus infinity. divisor > 0.
template <class T>
constexpr T floor_divide(T value, T divisor) {
    FOVEA_ASSERT(divisor > 0);
    const T quotient = static_cast<T>(value / divisor);
    return static_cast<T>(value % divisor < 0 ? quotient - 1 : quotient);
}

/// value less its floor_divide() times divisor: 0..divisor-1. divisor > 0.
template <class T>
constexpr T floor_modulo(T value, T divisor) {
    FOVEA_ASSERT(divisor > 0);
    const T remainder = static_cast<T>(value % divisor);
    return static_cast<T>(remainder < 0 ? remainder + divisor : remainder);
}

/// Quotient to the nearest, ties toward plus infinity. divisor > 0.
template <class T>
constexpr T round_divide(T value, T divisor) {
    const T quotient = floor_divide(value, divisor);
    const T remainder = floor_modulo(value, divisor);
    return static_cast<T>(remainder >= divisor - remainder ? quotient + 1 : quotient);
}

/// Leading zero bits; 32 and 64 for zero.
constexpr int leading_zeros(std::uint32_t value) { return value == 0 ? 32 : __builtin_clz(value); }
constexpr int leading_zeros(std::uint64_t value) { return value == 0 ? 64 : __builtin_clzll(value); }

/// Trailing zero bits of what is not zero.
constexpr int trailing_zeros(std::uint32_t value) { return __builtin_ctz(value); }
constexpr int trailing_zeros(std::uint64_t value) { return __builtin_ctzll(value); }

/// The largest integer whose square is not above value.
///
/// Time    three divisions of 32 bits, or four with the last of 64
/// Source  Newton's iteration, each step with as many bits as will be right; Dickinson's proof for math.isqrt
///         of CPython: before the last correction the root is less than 1 off. All 2^32 values were tried,
///         and the neighbours of all 2^32 squares
constexpr std::uint32_t isqrt(std::uint32_t value) {
    if (value == 0) return 0;
    const int raise = leading_zeros(value) & ~1;
    const std::uint32_t n = value << raise;  // 2^30 up to 2^32
    std::uint32_t root = 1 + (n >> 30);
    root = (root << 1) + (n >> 27) / root;
    root = (root << 3) + (n >> 21) / root;
    root = minimum<std::uint32_t>((root << 7) + (n >> 9) / root, 0xffff);
    root -= root * root > n ? 1 : 0;
    return root >> raise / 2;
}
constexpr std::uint32_t isqrt(std::uint64_t value) {
    if (value == 0) return 0;
    const int raise = leading_zeros(value) & ~1;
    const std::uint64_t n = value << raise;  // 2^62 up to 2^64
    std::uint32_t root = 1 + static_cast<std::uint32_t>(n >> 62);
    root = (root << 1) + static_cast<std::uint32_t>(n >> 59) / root;
    root = (root << 3) + static_cast<std::uint32_t>(n >> 53) / root;
    root = (root << 7) + static_cast<std::uint32_t>(n >> 41) / root;
    const std::uint64_t last =
        minimum<std::uint64_t>((std::uint64_t{root} << 15) + (n >> 17) / root, 0xffffffff);
    return static_cast<std::uint32_t>((last - (last * last > n ? 1 : 0)) >> raise / 2);
}

/// The length of the vector (x, y), rounded down; to a relative 2^-28 where a side needs more than 31 bits.
/// The result must fit: sides below 2^62.
constexpr std::int64_t hypotenuse(std::int64_t x, std::int64_t y) {
    const std::uint64_t a = magnitude(x);
    const std::uint64_t b = magnitude(y);
    const int drop = maximum(33 - leading_zeros(a | b), 0);
    const std::uint64_t square = (a >> drop) * (a >> drop) + (b >> drop) * (b >> drop);
    return static_cast<std::int64_t>(std::uint64_t{isqrt(square)} << drop);
}

/// The high 32 bits of a 64-bit product, rounded down.
constexpr std::int32_t multiply_high(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::int64_t>(a) * b >> 32);
}

}  // namespace fovea
