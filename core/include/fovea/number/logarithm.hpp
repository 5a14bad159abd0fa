// SPDX-License-Identifier: MIT
//
// The logarithm of a Real, to compare what differs by many powers of ten.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/real.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A logarithm to the base 2: 1/65536.
using Log2 = Fixed<std::int32_t, 16>;

/// The logarithm of the magnitude.
///
/// Rounding  within 0.51 of 1/65536; held at the ends of Log2
/// Errors    degenerate for 0
constexpr Result<Log2> log2_of(Real value);

// ---- Implementation ---------------------------------------------------------------

constexpr Result<Log2> log2_of(Real value) {
    if (value.zero()) return Status::degenerate;
    // 1 to 2 in 2^-31. Squaring doubles the logarithm: what passes 2 is a digit. An error of 2^-31 in a
    // square counts less with every digit, 2^-30 in all.
    std::uint64_t part = value.mantissa() >> 32;
    std::int64_t digits = value.exponent();
    for (int i = 0; i < 17; ++i) {
        part = part * part >> 31;
        const auto digit = static_cast<int>(part >> 32);
        part >>= digit;
        digits = digits * 2 + digit;
    }
    return Log2::from_raw(saturate_cast<std::int32_t>(round_shift(digits, 1)));
}

}  // namespace fovea
