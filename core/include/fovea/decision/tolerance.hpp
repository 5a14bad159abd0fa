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
    not_ok,      ///< a part with at least one value low or high, whatever else could not be measured
    unmeasured,  ///< no value, or not of all that is asked for and none bad: neither OK nor not OK
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

/// A part is not OK if one of its values is, else unmeasured if one of them is, else OK.
constexpr Verdict combine(Verdict part, Verdict value) {
    const auto bad = [](Verdict each) { return each != Verdict::ok && each != Verdict::unmeasured; };
    if (bad(part) || bad(value)) return Verdict::not_ok;
    return part == Verdict::ok ? value : part;
}

}  // namespace fovea
