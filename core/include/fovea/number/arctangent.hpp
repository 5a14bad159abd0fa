// SPDX-License-Identifier: MIT
//
// The arctangent, sine and cosine of numbers of 64 digits, in radians.
#pragma once

#include <cstdint>

#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// pi / 2^bits.
template <class Scalar = Real>
constexpr Scalar pi(int bits = 0) {
    return scalar_of<Scalar>(7244019458077122842LL, -61 - bits);
}

/// The angle whose tangent is y / x, between -pi and pi: the angle that turns +x onto (x, y). (0, 0) gives 0.
///
/// Error   at most 2^-60.5 of the angle, for Real
/// Source  arctan a = arctan c + arctan((a - c) / (1 + a c)) with the nearest eighth c, and the series of
///         powers of what is left, at most 1/16
template <class Scalar>
constexpr Scalar arctangent(Scalar y, Scalar x);

/// Cosine and sine of an angle from -2 pi to 2 pi.
///
/// Error   at most 2^-60.5, for Real
/// Source  the series of powers within an eighth of a turn about the nearest quarter
template <class Scalar>
struct CosineAndSine {
    Scalar cosine = scalar_of<Scalar>(1);
    Scalar sine = scalar_of<Scalar>(0);

    constexpr explicit CosineAndSine(Scalar angle);
};

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// arctan(i / 8) in 2^-63.
inline constexpr std::int64_t arctangents_of_eighths[9] = {0LL,
                                                           1146972379345827555LL,
                                                           2259529351110384995LL,
                                                           3309075367817240861LL,
                                                           4276394391812611793LL,
                                                           5152169304946036686LL,
                                                           5935250132529022098LL,
                                                           6630036517762420538LL,
                                                           7244019458077122842LL};

/// Of a number from 0 to 1.
template <class Scalar>
constexpr Scalar arctangent_of_part(Scalar a) {
    const std::int64_t eighth = ScalarTraits<Scalar>::rounded(a, 3);
    const Scalar near = scalar_of<Scalar>(eighth, -3);
    const Scalar rest = (a - near) / (scalar_of<Scalar>(1) + a * near);
    const Scalar square = rest * rest;
    // Nine terms: what is left out is below 2^-80 of the first.
    Scalar sum = scalar_of<Scalar>(0);
    for (int k = 8; k >= 1; --k) sum = square * (scalar_of<Scalar>(1) / scalar_of<Scalar>(2 * k + 1) - sum);
    return scalar_of<Scalar>(arctangents_of_eighths[eighth], -63) + (rest - rest * sum);
}

}  // namespace detail

template <class Scalar>
constexpr Scalar arctangent(Scalar y, Scalar x) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar across = absolute(x);
    const Scalar up = absolute(y);
    const bool steep = across < up;
    if (across == zero && up == zero) return zero;
    Scalar angle = detail::arctangent_of_part(steep ? across / up : up / across);
    if (steep) angle = pi<Scalar>(1) - angle;
    if (x < zero) angle = pi<Scalar>() - angle;
    return y < zero ? -angle : angle;
}

template <class Scalar>
constexpr CosineAndSine<Scalar>::CosineAndSine(Scalar angle) {
    const std::int64_t quarter = ScalarTraits<Scalar>::rounded(angle / pi<Scalar>(1), 0);
    const Scalar rest = angle - scalar_of<Scalar>(quarter) * pi<Scalar>(1);
    const Scalar square = rest * rest;
    // Up to the powers 20 and 21 of at most pi / 4: what is left out is below 2^-76.
    Scalar even = scalar_of<Scalar>(0);
    Scalar odd = scalar_of<Scalar>(0);
    for (int k = 20; k >= 2; k -= 2) {
        even = square / scalar_of<Scalar>(k * (k - 1)) * (scalar_of<Scalar>(1) - even);
        odd = square / scalar_of<Scalar>(k * (k + 1)) * (scalar_of<Scalar>(1) - odd);
    }
    const Scalar near_cosine = scalar_of<Scalar>(1) - even;
    const Scalar near_sine = rest - rest * odd;
    const bool turned = (quarter & 1) != 0;
    cosine = turned ? near_sine : near_cosine;
    sine = turned ? near_cosine : near_sine;
    if (((quarter + 1) & 2) != 0) cosine = -cosine;
    if ((quarter & 2) != 0) sine = -sine;
}

}  // namespace fovea
