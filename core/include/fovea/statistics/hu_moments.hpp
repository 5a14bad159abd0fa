// SPDX-License-Identifier: MIT
//
// Moments that do not depend on where a region lies, how large it is, and how it is turned: normalised
// central moments and Hu's seven invariants.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/real.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Central moments mu_pq over area^(1 + (p + q) / 2): alike for the same shape at every place and size.
struct NormalizedMoments {
    Real eta20, eta11, eta02;
    Real eta30, eta21, eta12, eta03;
};

/// The normalised central moments of a region.
///
/// Rounding  from the exact central moments, to a relative 2^-59
/// Errors    empty_image for a region without pixels
/// Source    Hu, "Visual Pattern Recognition by Moment Invariants", IRE Trans. IT 8(2), 1962
constexpr Result<NormalizedMoments> normalized_moments(const Moments& moments);

/// Hu's seven invariants, from 1 on in their usual order: h[0] to h[6]. Alike for the same shape moved,
/// scaled and turned; mirrored, the last one changes its sign.
///
/// Units  numbers, many of them far below 1: compare their logarithms, log2_of(), and their signs
struct HuMoments {
    static constexpr int count = 7;
    Real h[count];
    constexpr const Real& operator[](int index) const { return h[index]; }
};

/// Hu's invariants of a region.
///
/// Rounding  from the exact central moments: the first four to a relative 2^-57, the others to 2^-57 of their
///           largest term, of which there are four. A region that is moved, turned by quarters or mirrored
///           gives the same digits
/// Errors    empty_image for a region without pixels
/// Source    Hu, 1962, eq. 57-58
constexpr Result<HuMoments> hu_moments(const Moments& moments);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Central moments times area (second order) and times area^2 (third order): whole numbers.
struct WholeCentralMoments {
    std::int64_t area = 0;
    Int128 mu20, mu11, mu02;
    Int128 mu30, mu21, mu12, mu03;
};

constexpr WholeCentralMoments whole_central_moments(const Moments& moments) {
    const std::int64_t a = moments.m00;
    // About the nearest pixel the first moments are at most a / 2, with a up to 2^26, and the third ones
    // below 2^62: the largest products have 114 bits.
    const Moments m = shifted(moments, round_divide(moments.m10, a), round_divide(moments.m01, a));
    const std::int64_t u = m.m10;
    const std::int64_t v = m.m01;
    WholeCentralMoments c;
    c.area = a;
    c.mu20 = Int128::product(a, m.m20) - Int128(u * u);
    c.mu11 = Int128::product(a, m.m11) - Int128(u * v);
    c.mu02 = Int128::product(a, m.m02) - Int128(v * v);
    c.mu30 =
        Int128::product(a * a, m.m30) - Int128::product(3 * a * u, m.m20) + Int128::product(2 * u * u, u);
    c.mu21 = Int128::product(a * a, m.m21) - Int128::product(a * v, m.m20) -
             Int128::product(2 * a * u, m.m11) + Int128::product(2 * u * u, v);
    c.mu12 = Int128::product(a * a, m.m12) - Int128::product(a * u, m.m02) -
             Int128::product(2 * a * v, m.m11) + Int128::product(2 * v * v, u);
    c.mu03 =
        Int128::product(a * a, m.m03) - Int128::product(3 * a * v, m.m02) + Int128::product(2 * v * v, v);
    return c;
}

}  // namespace detail

constexpr Result<NormalizedMoments> normalized_moments(const Moments& moments) {
    if (moments.m00 <= 0) return Status::empty_image;
    const detail::WholeCentralMoments c = detail::whole_central_moments(moments);
    const Real area = Real::from_int(c.area);
    const Real square = area * area;
    const Real second = square * area;
    const Real third = square * square * area.square_root();
    NormalizedMoments n;
    n.eta20 = Real::from_int(c.mu20) / second;
    n.eta11 = Real::from_int(c.mu11) / second;
    n.eta02 = Real::from_int(c.mu02) / second;
    n.eta30 = Real::from_int(c.mu30) / third;
    n.eta21 = Real::from_int(c.mu21) / third;
    n.eta12 = Real::from_int(c.mu12) / third;
    n.eta03 = Real::from_int(c.mu03) / third;
    return n;
}

constexpr Result<HuMoments> hu_moments(const Moments& moments) {
    if (moments.m00 <= 0) return Status::empty_image;
    const detail::WholeCentralMoments m = detail::whole_central_moments(moments);
    const Real sum = Real::from_int(m.mu20 + m.mu02);
    const Real difference = Real::from_int(m.mu20 - m.mu02);
    const Real twice = Real::from_int(m.mu11 * 2);
    const Real p = Real::from_int(m.mu30 - m.mu12 * 3);
    const Real q = Real::from_int(m.mu21 * 3 - m.mu03);
    const Real s = Real::from_int(m.mu30 + m.mu12);
    const Real t = Real::from_int(m.mu21 + m.mu03);
    const Real ss = s * s;
    const Real tt = t * t;
    const Real three = Real::from_int(3);
    const Real along = ss - three * tt;
    const Real across = three * ss - tt;

    // A second moment is over area^3, a third one over area^(9/2).
    const Real a = Real::from_int(m.area);
    const Real a3 = a * a * a;
    const Real a6 = a3 * a3;
    const Real a9 = a6 * a3;
    const Real a18 = a9 * a9;
    HuMoments hu;
    hu.h[0] = sum / a3;
    hu.h[1] = (difference * difference + twice * twice) / a6;
    hu.h[2] = (p * p + q * q) / a9;
    hu.h[3] = (ss + tt) / a9;
    hu.h[4] = (p * s * along + q * t * across) / a18;
    hu.h[5] = (difference * (ss - tt) + Real::from_int(2) * twice * (s * t)) / (a9 * a3);
    hu.h[6] = (q * s * along - p * t * across) / a18;
    return hu;
}

}  // namespace fovea
