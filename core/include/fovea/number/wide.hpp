// SPDX-License-Identifier: MIT
//
// Products, quotients and roots of 64-bit words that need 128 bits on the way. Processors without such
// instructions get them in words of 32 bits, with the same result to the last bit.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// high * 2^64 + low.
struct Wide {
    std::uint64_t high = 0;
    std::uint64_t low = 0;

    friend constexpr bool operator==(Wide a, Wide b) { return a.high == b.high && a.low == b.low; }
    friend constexpr bool operator!=(Wide a, Wide b) { return !(a == b); }
};

/// The exact product of two words of 32 bits.
constexpr std::uint64_t multiply_words(std::uint32_t a, std::uint32_t b);

/// The exact product of two words of 64 bits.
constexpr Wide multiply_wide(std::uint64_t a, std::uint64_t b);

/// floor(a * 2^63 / b) of two words whose top bits are set: above 2^62, below 2^64.
constexpr std::uint64_t divide_wide(std::uint64_t a, std::uint64_t b);

/// floor(sqrt(value * 2^64)) of a word in which one of the two top bits is set: 2^63 or more.
constexpr std::uint64_t isqrt_wide(std::uint64_t value);

// ---- Implementation ---------------------------------------------------------------

constexpr std::uint64_t multiply_words(std::uint32_t a, std::uint32_t b) {
#if defined(__ARM_ARCH_6M__)
    // No instruction for it: four products of halves are faster than the call that the compiler makes.
    const std::uint32_t a_low = a & 0xffff;
    const std::uint32_t b_low = b & 0xffff;
    const std::uint32_t bottom = a_low * b_low;
    const std::uint32_t middle = (a >> 16) * b_low + (bottom >> 16);
    const std::uint32_t second = a_low * (b >> 16) + (middle & 0xffff);
    const std::uint32_t top = (a >> 16) * (b >> 16) + (middle >> 16) + (second >> 16);
    return std::uint64_t{top} << 32 | (second << 16 | (bottom & 0xffff));
#else
    return std::uint64_t{a} * b;
#endif
}

/// The same in words of 32 bits, for processors that have no wider ones.
namespace narrow_words {

constexpr std::uint32_t low_word(std::uint64_t value) { return static_cast<std::uint32_t>(value); }
constexpr std::uint32_t high_word(std::uint64_t value) { return static_cast<std::uint32_t>(value >> 32); }

[[gnu::always_inline]] constexpr Wide multiply_wide(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t bottom = multiply_words(low_word(a), low_word(b));
    // At most (2^32-1)^2 + 2^32-1 < 2^64, and the same once more for the second middle product.
    const std::uint64_t middle = multiply_words(high_word(a), low_word(b)) + high_word(bottom);
    const std::uint64_t second = multiply_words(low_word(a), high_word(b)) + low_word(middle);
    return {multiply_words(high_word(a), high_word(b)) + high_word(middle) + high_word(second),
            second << 32 | low_word(bottom)};
}

/// 2^95 / b for b with its top bit set: within 1.2, held below 2^32.
///
/// Source  Newton's y (2 - y b) from the line 48/17 - 32/17 b, which is off by 1/17 at most: 2^-8.1, 2^-16.3
///         and, with all of b, 2^-32.6
constexpr std::uint32_t reciprocal(std::uint64_t b) {
    const std::uint32_t high = high_word(b);
    // 1 up to 2 in 2^-30; b is 1/2 up to 1.
    std::uint32_t y = 0xb4b4b4b4u - high_word(multiply_words(0x78787878u, high));
    for (int i = 0; i < 2; ++i)
        y = static_cast<std::uint32_t>(multiply_words(y, 0x80000000u - high_word(multiply_words(y, high))) >>
                                       30);
    // 1 - y b in 2^-62, below 2^46 in magnitude; the part of it that counts has 32 bits.
    const std::int64_t rest = (std::int64_t{1} << 62) - static_cast<std::int64_t>(multiply_words(y, high)) -
                              high_word(multiply_words(y, low_word(b)));
    const std::int32_t part = static_cast<std::int32_t>(rest >> 16);
    // y + y (1 - y b) in 2^-31, to the nearest.
    const std::uint64_t product = multiply_words(y, magnitude(part));  // in 2^-76
    const std::uint32_t step = static_cast<std::uint32_t>((product + (std::uint64_t{1} << 44)) >> 45);
    const std::uint64_t doubled = std::uint64_t{y} << 1;
    return static_cast<std::uint32_t>(
        minimum<std::uint64_t>(part < 0 ? doubled - step : doubled + step, 0xffffffffu));
}

constexpr std::uint64_t divide_wide(std::uint64_t a, std::uint64_t b) {
    const std::uint32_t y = reciprocal(b);
    // 2 - y b in 2^-63, rounded down, so that y (2 - y b) is never above 1 / b, and below it by 2^-61 at
    // most.
    const std::uint64_t rest = ~(multiply_words(y, high_word(b)) + high_word(multiply_words(y, low_word(b))));
    const std::uint64_t fine =
        (multiply_words(y, high_word(rest)) << 1) + (multiply_words(y, low_word(rest)) >> 31);
    std::uint64_t quotient = multiply_wide(a, fine).high;
    // What is missing is below 16: the remainder below 2^68.
    const Wide product = multiply_wide(quotient, b);
    std::uint64_t low = (a << 63) - product.low;
    std::uint64_t high = (a >> 1) - product.high - ((a << 63) < product.low ? 1 : 0);
    while (high != 0 || low >= b) {
        ++quotient;
        high -= low < b ? 1 : 0;
        low -= b;
    }
    return quotient;
}

constexpr std::uint64_t isqrt_wide(std::uint64_t value) {
    const std::uint32_t x = high_word(value);  // 1/4 up to 1 in 2^-32
    // 1 / sqrt(x) in 2^-30: 2.133 - 1.219 x is off by 0.09 at most, and three of Newton's steps
    // y (3 - x y^2) / 2 leave 2^-27.
    std::uint32_t y = 0x887f77afu - high_word(multiply_words(0x4dffac1du, x));
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t square = high_word(multiply_words(y, y));
        const std::uint32_t bend = high_word(multiply_words(square, x));  // in 2^-28
        y = static_cast<std::uint32_t>(multiply_words(y, 0x30000000u - bend) >> 29);
    }
    // The upper half of the root: x y, a step of Newton's with all of value, and what is left over.
    std::uint64_t root = minimum<std::uint64_t>(multiply_words(x, y) >> 30, 0xffffffffu);
    std::int64_t rest = static_cast<std::int64_t>(value - root * root);
    const std::int64_t part = (rest >> 32) * static_cast<std::int64_t>(y >> 1) >> 30;
    root = minimum<std::uint64_t>(root + static_cast<std::uint64_t>(part), 0xffffffffu);
    rest = static_cast<std::int64_t>(value - root * root);
    for (; rest < 0; rest += static_cast<std::int64_t>(2 * root + 1)) --root;
    for (; rest > static_cast<std::int64_t>(2 * root); ++root)
        rest -= static_cast<std::int64_t>(2 * root + 1);
    // The lower half is rest / (2 root), less what its own square takes.
    const auto upper = static_cast<std::uint32_t>(root);
    const std::uint64_t wanted = static_cast<std::uint64_t>(rest) << 31;
    std::uint64_t lower = multiply_words(high_word(wanted), reciprocal(std::uint64_t{upper} << 32)) >> 31;
    std::uint64_t left = wanted - lower * upper;
    for (; static_cast<std::int64_t>(left) < 0; left += upper) --lower;
    for (; left >= upper; left -= upper) ++lower;
    if (lower >> 32 != 0) return std::uint64_t{upper} << 32 | 0xffffffffu;
    // rest * 2^32 - lower * 2 * root is 2 * left.
    const std::uint64_t result = (std::uint64_t{upper} << 32) + lower;
    return (left << 33) < lower * lower && left >> 31 == 0 ? result - 1 : result;
}

}  // namespace narrow_words

#if defined(__SIZEOF_INT128__)

namespace detail {
__extension__ using Word128 = unsigned __int128;
}  // namespace detail

constexpr Wide multiply_wide(std::uint64_t a, std::uint64_t b) {
    const detail::Word128 product = static_cast<detail::Word128>(a) * b;
    return {static_cast<std::uint64_t>(product >> 64), static_cast<std::uint64_t>(product)};
}
constexpr std::uint64_t divide_wide(std::uint64_t a, std::uint64_t b) {
    FOVEA_ASSERT(a >> 63 != 0 && b >> 63 != 0);
    return static_cast<std::uint64_t>((static_cast<detail::Word128>(a) << 63) / b);
}
constexpr std::uint64_t isqrt_wide(std::uint64_t value) {
    FOVEA_ASSERT(value >> 62 != 0);
    const std::uint64_t upper = isqrt(value);
    const std::uint64_t wanted = (value - upper * upper) << 31;
    const std::uint64_t lower = wanted / upper;
    if (lower >> 32 != 0) return upper << 32 | 0xffffffffu;
    const std::uint64_t left = wanted % upper;
    const std::uint64_t result = (upper << 32) + lower;
    return (left << 33) < lower * lower && left >> 31 == 0 ? result - 1 : result;
}

#else

constexpr Wide multiply_wide(std::uint64_t a, std::uint64_t b) { return narrow_words::multiply_wide(a, b); }
constexpr std::uint64_t divide_wide(std::uint64_t a, std::uint64_t b) {
    FOVEA_ASSERT(a >> 63 != 0 && b >> 63 != 0);
    return narrow_words::divide_wide(a, b);
}
constexpr std::uint64_t isqrt_wide(std::uint64_t value) {
    FOVEA_ASSERT(value >> 62 != 0);
    return narrow_words::isqrt_wide(value);
}

#endif

}  // namespace fovea
