// SPDX-License-Identifier: MIT
//
// Division of bytes by bytes, lane by lane: long division, one bit of the quotient a step.
#pragma once

#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

// ---- Interface --------------------------------------------------------------------

/// A quotient and what is left, both below 256.
struct Ratio {
    Bytes quotient;
    Bytes rest;
};

/// part * (2^Bits - 1) = quotient * whole + rest with rest < whole, for part <= whole and Bits up to 8. Any
/// values where whole is 0.
template <int Bits>
Ratio ratio_of(Bytes part, Bytes whole);

/// The same of twice the part. The quotient must fit a byte.
inline Ratio twice(const Ratio& ratio, Bytes whole);

// ---- Implementation ---------------------------------------------------------------

[[gnu::always_inline]] inline Ratio twice(const Ratio& ratio, Bytes whole) {
    // rest >= whole - rest says 2 rest >= whole without a ninth bit; the 9 bits of 2 rest - whole fit again.
    const Bytes fits = at_least(ratio.rest, whole - ratio.rest);
    return {ratio.quotient + ratio.quotient - fits, ratio.rest + ratio.rest - (whole & fits)};
}

template <int Bits>
[[gnu::always_inline]] inline Ratio ratio_of(Bytes part, Bytes whole) {
    static_assert(Bits >= 1 && Bits <= 8, "the quotient has a byte");
    // part * 2^Bits, one bit at a time. Of part = whole this gives 2^Bits - 1 with the rest whole.
    Ratio ratio{Bytes::all(0), part};
    for (int bit = 0; bit < Bits; ++bit) ratio = twice(ratio, whole);
    // Less part: borrow a whole where the rest is too small.
    const Bytes enough = at_least(ratio.rest, part);
    return {ratio.quotient + ~enough, ratio.rest + (whole & ~enough) - part};
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
