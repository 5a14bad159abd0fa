// SPDX-License-Identifier: MIT
//
// Other scalars than Real for the algorithms of geometry, and what a Real is as a floating-point number.
#pragma once

#include <cmath>
#include <cstdint>

#include <fovea/number/int128.hpp>
#include <fovea/number/real.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

template <>
struct ScalarTraits<double> {
    static double from_int(std::int64_t value, int exponent) {
        return std::ldexp(static_cast<double>(value), exponent);
    }
    static double from_int(Int128 value, int exponent) {
        // By the magnitude: the words of a negative number would cancel.
        const Int128 size = value.negative() ? -value : value;
        const double high = static_cast<double>((size >> 63).low_word());
        const double low = static_cast<double>((size - ((size >> 63) << 63)).low_word());
        const double both = std::ldexp(high, exponent + 63) + std::ldexp(low, exponent);
        return value.negative() ? -both : both;
    }
    static double square_root(double a) { return std::sqrt(std::abs(a)); }
    static double absolute(double a) { return std::abs(a); }
    static double scale(double a, int bits) { return std::ldexp(a, bits); }
    static std::int64_t rounded(double a, int bits) { return std::llround(std::ldexp(a, bits)); }
};

template <>
struct ScalarTraits<long double> {
    static long double from_int(std::int64_t value, int exponent) {
        return std::ldexp(static_cast<long double>(value), exponent);
    }
    static long double from_int(Int128 value, int exponent) {
        const Int128 size = value.negative() ? -value : value;
        const auto high = static_cast<long double>((size >> 63).low_word());
        const auto low = static_cast<long double>((size - ((size >> 63) << 63)).low_word());
        const long double both = std::ldexp(high, exponent + 63) + std::ldexp(low, exponent);
        return value.negative() ? -both : both;
    }
    static long double square_root(long double a) { return std::sqrt(std::abs(a)); }
    static long double absolute(long double a) { return std::abs(a); }
    static long double scale(long double a, int bits) { return std::ldexp(a, bits); }
    static std::int64_t rounded(long double a, int bits) { return std::llround(std::ldexp(a, bits)); }
};

namespace test {

inline long double value_of(Real number) {
    const long double size =
        std::ldexp(static_cast<long double>(number.mantissa()), number.zero() ? 0 : number.exponent() - 63);
    return number.negative() ? -size : size;
}
inline double value_of(double number) { return number; }
inline long double value_of(long double number) { return number; }

/// The Real of a double, exact.
inline Real real_of(double number) {
    int exponent = 0;
    const double part = std::frexp(number, &exponent);
    return Real::from_int(static_cast<std::int64_t>(std::ldexp(part, 53)), exponent - 53);
}

}  // namespace test
}  // namespace fovea
