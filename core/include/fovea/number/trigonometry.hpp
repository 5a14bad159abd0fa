// SPDX-License-Identifier: MIT
//
// Sine, cosine and the angle of a vector, in integers. Book appendix B; errors tested against long double.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A direction as a pair: x = cosine, y = sine.
struct UnitVector {
    Unit x;
    Unit y;
};

/// Cosine and sine of an angle.
///
/// Units   results in 2^-30
/// Error   at most 1.3 * 2^-30 each (all 2^32 angles were compared with long double; the tests take a sample)
/// Source  minimax polynomials in the square of the angle within an eighth of a turn
constexpr UnitVector unit_vector(FineAngle angle);

/// The direction of the vector (x, y), the angle that turns +x onto it. (0, 0) gives 0.
///
/// Error   at most 1.1 * 2^-32 turn
/// Source  minimax polynomials in eight intervals of the quotient of the smaller by the larger side
constexpr FineAngle angle_of(std::int32_t x, std::int32_t y);

/// The same for wide sides, which are shifted together until they fit: the error grows by 2^-30 turn at most.
constexpr FineAngle angle_of(std::int64_t x, std::int64_t y);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

// Coefficients c_k * 2^k in Q0.31 of sine (odd, divided by the angle) and cosine in the squared angle, the
// angle in units of an eighth of a turn.
inline constexpr std::int32_t sine_coefficients[5] = {1686629713, -346799333, 21392315, -628309, 10617};
inline constexpr std::int32_t cosine_coefficients[6] = {2147483647, -1324675879, 136187780,
                                                        -5600495,   123368,      -1668};

// arctan(t) in 2^-34 turn over eight intervals of t; the variable is the place within the interval, -1 to 1.
inline constexpr std::int32_t arctangent_coefficients[8][6] = {
    {170669324, 340452744, -2649416, -1738795, 40681, 15666},
    {506789689, 330174926, -7475610, -1435576, 104650, 9175},
    {828166313, 311374930, -11080914, -951677, 129192, 771},
    {1127637828, 286873296, -13167932, -448187, 116967, -5045},
    {1401006571, 259633102, -13867642, -39628, 85456, -6998},
    {1646810863, 232085823, -13543478, 232963, 51549, -6279},
    {1865631616, 205873777, -12594642, 381448, 24381, -4530},
    {2059312252, 181905105, -11345442, 439246, 6177, -2803}};

/// c[1] + v/2 * (c[2] + v/2 * (...)) for v in Q0.31; the caller adds the constant term.
template <std::size_t Count>
constexpr std::int32_t horner(const std::int32_t (&coefficients)[Count], std::int32_t variable) {
    std::int32_t sum = coefficients[Count - 1];
    for (std::size_t k = Count - 2; k >= 1; --k) sum = coefficients[k] + multiply_high(sum, variable);
    return sum;
}

}  // namespace detail

constexpr UnitVector unit_vector(FineAngle angle) {
    // Fold to -1/8..1/8 turn around the nearest quarter.
    const std::uint32_t quarter = (angle.raw() + 0x20000000u) >> 30;
    const std::int32_t z = static_cast<std::int32_t>((angle.raw() - (quarter << 30)) << 2);
    const std::uint32_t square = static_cast<std::uint32_t>(static_cast<std::int64_t>(z) * z >> 31);
    const std::int32_t w = static_cast<std::int32_t>(square - (square >> 31));

    const std::int32_t tail = detail::horner(detail::sine_coefficients, w);
    const std::int32_t ratio = detail::sine_coefficients[0] + multiply_high(tail, w);
    std::int32_t sine = static_cast<std::int32_t>(round_shift(static_cast<std::int64_t>(z) * ratio, 32));
    const std::int32_t bend = detail::horner(detail::cosine_coefficients, w);
    std::int32_t cosine =
        static_cast<std::int32_t>(Unit::one + round_shift(static_cast<std::int64_t>(bend) * w, 33));

    if (quarter & 1) {
        const std::int32_t swap = sine;
        sine = cosine;
        cosine = -swap;
    }
    if (quarter & 2) {
        sine = -sine;
        cosine = -cosine;
    }
    return {Unit::from_raw(cosine), Unit::from_raw(sine)};
}

constexpr FineAngle angle_of(std::int32_t x, std::int32_t y) {
    std::uint32_t large = magnitude(x);
    std::uint32_t small = magnitude(y);
    const bool steep = small > large;
    if (steep) {
        const std::uint32_t swap = large;
        large = small;
        small = swap;
    }
    if (large == 0) return FineAngle();

    std::uint32_t angle = 0x20000000u;
    if (small != large) {
        const std::uint32_t tangent =
            static_cast<std::uint32_t>((static_cast<std::uint64_t>(small) << 32) / large);
        const std::int32_t(&coefficients)[6] = detail::arctangent_coefficients[tangent >> 29];
        const std::int32_t place = static_cast<std::int32_t>(tangent << 3 ^ 0x80000000u);
        const std::int32_t bend = multiply_high(detail::horner(coefficients, place), place);
        angle = (static_cast<std::uint32_t>(coefficients[0] + bend) + 2) >> 2;
    }
    if (steep) angle = 0x40000000u - angle;
    if (x < 0) angle = 0x80000000u - angle;
    return FineAngle::from_raw(y < 0 ? 0u - angle : angle);
}

constexpr FineAngle angle_of(std::int64_t x, std::int64_t y) {
    const std::uint64_t widest = magnitude(x) | magnitude(y);
    const int excess = 33 - leading_zeros(widest);
    if (excess <= 0) return angle_of(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y));
    return angle_of(static_cast<std::int32_t>(x >> excess), static_cast<std::int32_t>(y >> excess));
}

}  // namespace fovea
