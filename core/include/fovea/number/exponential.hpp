// SPDX-License-Identifier: MIT
//
// The exponential function of negative numbers, in integers.
#pragma once

#include <cstdint>

#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// e^-x as a share of 2^31, for x in 1/2^32.
///
/// Rounding  within 8 of the true value: each of 32 factors is right to a half, and so is each product
/// Source    the binary digits of x log2(e) choose among the factors 2^(-1/2), 2^(-1/4) ...
constexpr std::uint32_t exponential_of_minus(std::uint64_t x);

// ---- Implementation ---------------------------------------------------------------

constexpr std::uint32_t exponential_of_minus(std::uint64_t x) {
    // 22 ln 2 and more leave nothing of 31 bits; 2^37 keeps the product below 2^63.
    if (x >= std::uint64_t{1} << 37) return 0;
    // log2(e) = 1.442695041 in 1/2^26 keeps x's whole part and 32 binary digits.
    constexpr std::uint64_t log2_e = 96817625;
    const std::uint64_t exponent = (x * log2_e + (1u << 25)) >> 26;
    const int halvings = static_cast<int>(exponent >> 32);
    if (halvings > 31) return 0;
    std::uint64_t value = std::uint64_t{1} << 31;
    std::uint64_t factor = std::uint64_t{1} << 30;
    for (int digit = 31; digit >= 0; --digit) {
        // The root of a number in 1/2^31 is in 1/2^31 after raising it by 31 bits; to the nearest.
        const std::uint64_t raised = factor << 31;
        factor = isqrt(raised);
        factor += raised - factor * factor > factor ? 1 : 0;
        if ((exponent >> digit & 1) != 0) value = (value * factor + (1u << 30)) >> 31;
    }
    return static_cast<std::uint32_t>(
        halvings == 0 ? value : (value + (std::uint64_t{1} << (halvings - 1))) >> halvings);
}

}  // namespace fovea
