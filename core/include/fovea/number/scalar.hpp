// SPDX-License-Identifier: MIT
//
// What algorithms of geometry ask of the number that they calculate with. Real is their specification; tests
// give others, to see how far Real is from the truth.
#pragma once

#include <cstdint>

#include <fovea/number/int128.hpp>
#include <fovea/number/real.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How a scalar is made of integers, and what it can beside + - * / and comparisons. A scalar of your own
/// specialises it with the members that Real has here.
template <class Scalar>
struct ScalarTraits;

template <>
struct ScalarTraits<Real> {
    /// value * 2^exponent.
    static constexpr Real from_int(std::int64_t value, int exponent) {
        return Real::from_int(value, exponent);
    }
    static constexpr Real from_int(Int128 value, int exponent) { return Real::from_int(value, exponent); }
    static constexpr Real square_root(Real a) { return a.square_root(); }
    static constexpr Real absolute(Real a) { return a.absolute(); }
    /// a * 2^bits.
    static constexpr Real scale(Real a, int bits) { return a.scaled(bits); }
    /// a * 2^bits to the nearest integer, ties away from 0, held at the ends of 64 bits.
    static constexpr std::int64_t rounded(Real a, int bits) { return a.rounded(bits); }
};

/// value * 2^exponent.
template <class Scalar>
constexpr Scalar scalar_of(std::int64_t value, int exponent = 0) {
    return ScalarTraits<Scalar>::from_int(value, exponent);
}
/// The root of the magnitude.
template <class Scalar>
constexpr Scalar square_root(Scalar a) {
    return ScalarTraits<Scalar>::square_root(a);
}
template <class Scalar>
constexpr Scalar absolute(Scalar a) {
    return ScalarTraits<Scalar>::absolute(a);
}
/// a * 2^bits.
template <class Scalar>
constexpr Scalar scale(Scalar a, int bits) {
    return ScalarTraits<Scalar>::scale(a, bits);
}

}  // namespace fovea
