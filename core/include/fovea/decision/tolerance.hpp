// SPDX-License-Identifier: MIT
//
// Tolerance and verdict: from a measured value to OK or not OK.
#pragma once

#include <cstdint>

#include <fovea/number/decimal.hpp>

namespace fovea {

/// The verdict on one value, or on a part as a whole (then low and high do not occur).
enum class Verdict : std::uint8_t {
    ok,
    low,         ///< below nominal - minus
    high,        ///< above nominal + plus
    not_ok,      ///< a part with at least one value low or high
    unmeasured,  ///< no value, so no judgement: neither OK nor not OK
};

/// nominal - minus <= value <= nominal + plus is OK, both ends included.
struct Tolerance {
    Decimal nominal;
    Decimal minus;  ///< not negative
    Decimal plus;   ///< not negative
};

constexpr Verdict judge(Decimal value, const Tolerance& tolerance) {
    if (value < tolerance.nominal - tolerance.minus) return Verdict::low;
    if (value > tolerance.nominal + tolerance.plus) return Verdict::high;
    return Verdict::ok;
}

/// A part is unmeasured if one of its values is, else not OK if one of its values is, else OK.
constexpr Verdict combine(Verdict part, Verdict value) {
    if (part == Verdict::unmeasured || value == Verdict::unmeasured) return Verdict::unmeasured;
    return part == Verdict::ok && value == Verdict::ok ? Verdict::ok : Verdict::not_ok;
}

}  // namespace fovea
