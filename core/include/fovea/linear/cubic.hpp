// SPDX-License-Identifier: MIT
//
// A real root of a cubic polynomial, without complex numbers and without a cube root.
#pragma once

#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The real x with x^3 + a x^2 + b x + c = 0: the only one, or of three the one that is farthest from the
/// other two.
///
/// Rounding  to the last digits of Scalar, as far as the polynomial tells: a threefold root to a third of
///           them
/// Time      at most 80 steps; 5 to 12 as a rule
/// Source    Newton's steps from outside of all roots, on the side of the root that stands alone, where each
///           step stays outside
template <class Scalar>
constexpr Scalar cubic_root_alone(Scalar a, Scalar b, Scalar c);

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr Scalar cubic_root_alone(Scalar a, Scalar b, Scalar c) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar three = scalar_of<Scalar>(3);
    const auto value = [&](Scalar x) { return c + x * (b + x * (a + x)); };
    // From the point of inflection: y^3 - bend y + middle, odd but for the middle. The root that stands alone
    // is on the side where the middle leads.
    const Scalar inflection = -(a / three);
    const Scalar middle = value(inflection);
    const Scalar bend = a * a / three - b;
    const Scalar height = absolute(middle);
    // Its distance is at most twice that of the turning points, and the cube root of the height more: the
    // fourth, sixteenth and further roots multiply to nearly that, and twice as much is not below it.
    Scalar distance = zero;
    if (zero < height) {
        Scalar root = height;
        distance = scalar_of<Scalar>(2);
        for (int i = 0; i < 4; ++i) {
            root = square_root(square_root(root));
            distance = distance * root;
        }
    }
    if (zero < bend) distance = distance + scale(square_root(bend / three), 1);
    for (int i = 0; i < 80; ++i) {
        const Scalar slope = three * distance * distance - bend;
        if (!(zero < slope)) break;
        const Scalar next = distance - (distance * (distance * distance - bend) - height) / slope;
        if (!(next < distance)) break;
        distance = next;
    }
    Scalar x = zero < middle ? inflection - distance : inflection + distance;
    // The coefficients as they were given have the last digits.
    Scalar rest = absolute(value(x));
    for (int i = 0; i < 3; ++i) {
        const Scalar slope = b + x * (scale(a, 1) + x * three);
        if (slope == zero) break;
        const Scalar next = x - value(x) / slope;
        const Scalar left = absolute(value(next));
        if (!(left < rest)) break;
        x = next;
        rest = left;
    }
    return x;
}

}  // namespace fovea
