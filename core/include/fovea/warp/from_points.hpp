// SPDX-License-Identifier: MIT
//
// The affine transform through three pairs of places, and the homography through four. Book sec. 2.9.4.
#pragma once

#include <cstdint>
#include <initializer_list>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/warp/affine.hpp>
#include <fovea/warp/homography.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The affine transform that takes each of three places to its partner.
///
/// Units     px; coefficients are right to 2^-41
/// Errors    degenerate where the three places lie on a line; out_of_range for a coefficient that does not
///           fit
/// Source    Cramer's rule, in 128 bits
constexpr Result<AffineTransform> affine_through(const FinePoint (&from)[3], const FinePoint (&to)[3]);

/// The homography that takes each of four places to its partner: a tilted rectangle made upright, a code or a
/// card rectified. As the map of a warp, from are the corners in the output and to those in the source.
///
/// Units     px; the four places are met to 2^-10 px where no three of a side span less than a sixteenth of
///           the square around them
/// Errors    degenerate where three of the places or of their partners lie on a line, or where the horizon
///           would pass between the places: one quadrilateral is convex and the other is not, or they turn
///           about differently
/// Source    Heckbert, Fundamentals of Texture Mapping, 1989: the unit square to a quadrilateral, for both
///           sides. Book sec. 2.9.4 has least squares for more than four pairs
constexpr Result<Homography> homography_through(const FinePoint (&from)[4], const FinePoint (&to)[4]);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The way between two places, in 1/65536 px: at most 33 bits with the sign.
struct Way {
    std::int64_t x;
    std::int64_t y;
};
constexpr Way way(FinePoint from, FinePoint to) {
    return {std::int64_t{to.x.raw()} - from.x.raw(), std::int64_t{to.y.raw()} - from.y.raw()};
}
/// At most 2^65.
constexpr Int128 cross(Way a, Way b) { return Int128::product(a.x, b.y) - Int128::product(a.y, b.x); }

constexpr Int128 shifted(Int128 value, int left) {
    if (left >= 0) return value << left;
    return (value + (Int128(1) << (-left - 1))) >> -left;
}

/// Three by three numbers, row by row.
struct Matrix128 {
    Int128 entry[9];

    /// Bits of the largest magnitude of entries first to last.
    constexpr int bits(int first, int last) const {
        int most = 0;
        for (int i = first; i <= last; ++i) most = maximum(most, entry[i].bit_length());
        return most;
    }
};
struct Matrix64 {
    std::int64_t entry[9];
};

/// All entries shifted alike, so that the largest has that many bits.
constexpr Matrix64 with_bits(const Matrix128& matrix, int bits) {
    Matrix64 result{};
    const int left = bits - matrix.bits(0, 8);
    for (int i = 0; i < 9; ++i) result.entry[i] = shifted(matrix.entry[i], left).low_word();
    return result;
}

/// The unit square to a quadrilateral whose first corner is the origin, in units of 2^scale / 65536 px.
struct SquareMap {
    Matrix64 matrix{};
    int scale = 0;
    bool there = false;
    /// The divisors at the four corners are positive, or negative.
    bool negative[4] = {};
};
constexpr SquareMap square_to(const FinePoint (&corner)[4]) {
    const Way p1 = way(corner[0], corner[1]);
    const Way p2 = way(corner[0], corner[2]);
    const Way p3 = way(corner[0], corner[3]);
    const Way d1 = way(corner[2], corner[1]);
    const Way d2 = way(corner[2], corner[3]);
    const Way sum{p2.x - p1.x - p3.x, p2.y - p1.y - p3.y};
    const Int128 zero(0);
    SquareMap map;
    map.there =
        cross(p1, p2) != zero && cross(p2, p3) != zero && cross(p1, p3) != zero && cross(d1, d2) != zero;
    if (!map.there) return map;
    // At most 2^67 each, and 2^68 together; below them the rows of x and y, at most 2^102, which are brought
    // to the same size by the scale.
    const Int128 w = cross(d1, d2);
    const Int128 g = cross(sum, d2);
    const Int128 h = cross(d1, sum);
    const Int128 at1 = w + g;
    const Int128 at3 = w + h;
    std::uint64_t longest = 0;
    for (const Way* p : {&p1, &p2, &p3}) longest |= magnitude(p->x) | magnitude(p->y);
    map.scale = 64 - leading_zeros(longest);
    const Matrix128 exact{{shifted(at1 * p1.x, -map.scale), shifted(at3 * p3.x, -map.scale), zero,
                           shifted(at1 * p1.y, -map.scale), shifted(at3 * p3.y, -map.scale), zero, g, h, w}};
    map.matrix = with_bits(exact, 60);
    const Int128 divisors[4] = {w, at1, at1 + h, at3};
    for (int i = 0; i < 4; ++i) {
        map.negative[i] = divisors[i].negative();
        map.there = map.there && divisors[i] != zero;
    }
    return map;
}

/// The matrix of cofactors, which is the inverse but for a factor; entries of 60 bits.
constexpr Matrix128 adjugate(const Matrix64& matrix) {
    const std::int64_t(&m)[9] = matrix.entry;
    const auto minor = [&m](int a, int b, int c, int d) {
        return Int128::product(m[a], m[d]) - Int128::product(m[b], m[c]);
    };
    return {{minor(4, 5, 7, 8), minor(2, 1, 8, 7), minor(1, 2, 4, 5), minor(5, 3, 8, 6), minor(0, 2, 6, 8),
             minor(2, 0, 5, 3), minor(3, 4, 6, 7), minor(1, 0, 7, 6), minor(0, 1, 3, 4)}};
}

constexpr Matrix128 product(const Matrix64& a, const Matrix64& b) {
    Matrix128 result{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            for (int k = 0; k < 3; ++k)
                result.entry[3 * row + column] +=
                    Int128::product(a.entry[3 * row + k], b.entry[3 * k + column]);
    return result;
}

}  // namespace detail

constexpr Result<AffineTransform> affine_through(const FinePoint (&from)[3], const FinePoint (&to)[3]) {
    const detail::Way a = detail::way(from[0], from[1]);
    const detail::Way b = detail::way(from[0], from[2]);
    const detail::Way u = detail::way(to[0], to[1]);
    const detail::Way v = detail::way(to[0], to[2]);
    const Int128 area = detail::cross(a, b);
    if (area == Int128(0)) return Status::degenerate;
    constexpr int bits = WarpCoefficient::fraction_bits;
    bool fits = true;
    // Numerators below 2^66 and 40 bits more.
    const auto over = [&](Int128 numerator) {
        const std::int64_t raw = round_divide(numerator << bits, area);
        fits = fits && raw < (std::int64_t{1} << 62) && raw > -(std::int64_t{1} << 62);
        return WarpCoefficient::from_raw(raw);
    };
    const auto offset = [&](FinePixel target, WarpCoefficient x, WarpCoefficient y) {
        const Int128 sum = (Int128(target.raw()) << bits) - Int128::product(x.raw(), from[0].x.raw()) -
                           Int128::product(y.raw(), from[0].y.raw());
        const Int128 rounded = detail::shifted(sum, -FinePixel::fraction_bits);
        fits = fits && rounded.fits_int64();
        return WarpCoefficient::from_raw(rounded.low_word());
    };
    AffineTransform t;
    t.xx = over(detail::cross({u.x, v.x}, {a.y, b.y}));
    t.xy = over(detail::cross({a.x, b.x}, {u.x, v.x}));
    t.yx = over(detail::cross({u.y, v.y}, {a.y, b.y}));
    t.yy = over(detail::cross({a.x, b.x}, {u.y, v.y}));
    t.x0 = offset(to[0].x, t.xx, t.xy);
    t.y0 = offset(to[0].y, t.yx, t.yy);
    if (!fits) return Status::out_of_range;
    return t;
}

constexpr Result<Homography> homography_through(const FinePoint (&from)[4], const FinePoint (&to)[4]) {
    using detail::shifted;
    const detail::SquareMap source = detail::square_to(from);
    const detail::SquareMap target = detail::square_to(to);
    if (!source.there || !target.there) return Status::degenerate;
    for (int i = 1; i < 4; ++i)
        if ((source.negative[i] != target.negative[i]) != (source.negative[0] != target.negative[0]))
            return Status::degenerate;
    // From (p - from[0]) / 2^s to (p' - to[0]) / 2^t: the square of one to that of the other. 59 bits, so
    // that sums of three products stay below 2^122; the result with 54.
    const detail::Matrix64 back = detail::with_bits(detail::adjugate(source.matrix), 59);
    const detail::Matrix64 core = detail::with_bits(detail::product(target.matrix, back), 54);
    const std::int64_t(&k)[9] = core.entry;
    const std::int64_t x0 = from[0].x.raw();
    const std::int64_t y0 = from[0].y.raw();
    // In px, all times 2^s: columns of at most 54 + 16 bits, the last one of 54 + 34.
    const auto row = [&](int i, Int128& x, Int128& y, Int128& zero) {
        x = Int128(k[i]) << 16;
        y = Int128(k[i + 1]) << 16;
        zero = (Int128(k[i + 2]) << source.scale) - Int128::product(k[i], x0) - Int128::product(k[i + 1], y0);
    };
    detail::Matrix128 m{};
    Int128(&e)[9] = m.entry;
    row(0, e[0], e[1], e[2]);
    row(3, e[3], e[4], e[5]);
    row(6, e[6], e[7], e[8]);
    // Rows of x and y: 2^t / 65536 of theirs and to[0] times the divisor's row, at most 2^106 and 2^119.
    for (int i = 0; i < 3; ++i) {
        e[i] = shifted(e[i], target.scale - 16) + shifted(e[6 + i] * to[0].x.raw(), -16);
        e[3 + i] = shifted(e[3 + i], target.scale - 16) + shifted(e[6 + i] * to[0].y.raw(), -16);
    }
    // The largest image may take the linear terms times 2^15, twice, and the constant one: below 2^62.
    int bits = 0;
    for (int i = 0; i < 9; i += 3)
        bits = maximum(bits, maximum(m.bits(i, i + 1) + 16, m.bits(i + 2, i + 2) + 1));
    // The divisor must be positive where the places are.
    const Int128 at = e[6] * x0 + e[7] * y0 + (e[8] << 16);
    Homography h;
    std::int64_t* const to_fill[9] = {&h.xx, &h.xy, &h.x0, &h.yx, &h.yy, &h.y0, &h.wx, &h.wy, &h.w0};
    for (int i = 0; i < 9; ++i) *to_fill[i] = shifted(at.negative() ? -e[i] : e[i], 61 - bits).low_word();
    return h;
}

}  // namespace fovea
