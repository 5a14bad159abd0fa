// SPDX-License-Identifier: MIT
//
// The fundamental matrix of eight pairs of pixels or more. Book sec. 2.10.2.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/eigen.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/linear/svd.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>
#include <fovea/stereo/epipolar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// F with right^T F left = 0 as nearly as possible for all pairs, of rank 2, with a sum of squares of 1. The
/// sign is left to the calculation.
///
/// Shapes    as many left as right: 8 to 2^20
/// Range     no pixel is further than 2^16 px from the origin
/// Rounding  pixels are shifted to a whole mean and brought within 1 by a power of two, which rounds nothing;
///           then that of Scalar
/// Errors    size_mismatch; bad_argument for fewer than 8 pairs or more than 2^20; out_of_range beyond the
///           range; degenerate where the pairs leave more than one matrix open: those of a plane, of a line,
///           of the corners of a box, of cameras at one place. The eigenvalue before the least must be more
///           than errors of 1/16 px make, and a quarter more than the least; the one before that 16 + 512 / n
///           times, with n pairs. A plane whose pixels are wrong by more than 1/16 px is seen to be one from
///           about 16 pairs on; with fewer it may pass
/// Source    Hartley, "In Defense of the Eight-Point Algorithm", IEEE PAMI 19(6), 1997, with shifts in place
///           of the root of 2, and the nearest matrix of rank 2
template <class Scalar = Real>
constexpr Result<Matrix<3, 3, Scalar>> fit_fundamental(Span<const SubPixelPoint> left,
                                                       Span<const SubPixelPoint> right);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// What a pixel may be wrong by, in fit_fundamental().
template <class Scalar>
constexpr Scalar pixel_error() {
    return scalar_of<Scalar>(1, -4);
}

/// What puts the places of one image around the origin, none of them further than 1 in x or y.
template <class Scalar>
struct PlaceFrame {
    Vector<2, Scalar> origin;
    int bits = 0;

    constexpr Vector<2, Scalar> operator()(const Vector<2, Scalar>& place) const {
        return Vector<2, Scalar>(scale(place[0] - origin[0], -bits), scale(place[1] - origin[1], -bits));
    }
};

/// The frame of the places for which use(index) holds: place(index) tells them, the origin has a number of
/// bits behind the point.
template <class Scalar, class Place, class Use>
constexpr PlaceFrame<Scalar> frame_of_places(std::ptrdiff_t count, Place place, Use use, int fraction_bits) {
    PlaceFrame<Scalar> frame;
    std::int64_t used = 0;
    Vector<2, Scalar> sum;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        if (!use(i)) continue;
        ++used;
        sum += place(i);
    }
    if (used == 0) return frame;
    for (int side = 0; side < 2; ++side)
        frame.origin[side] = scalar_of<Scalar>(
            ScalarTraits<Scalar>::rounded(sum[side] / scalar_of<Scalar>(used), fraction_bits),
            -fraction_bits);
    Scalar most = scalar_of<Scalar>(0);
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        if (!use(i)) continue;
        const Vector<2, Scalar> off = place(i) - frame.origin;
        for (int side = 0; side < 2; ++side)
            if (most < absolute(off[side])) most = absolute(off[side]);
    }
    frame.bits = -40;
    while (frame.bits < 24 && scalar_of<Scalar>(1, frame.bits) < most) ++frame.bits;
    return frame;
}

/// Nine coefficients of the equation of a pair, in the order of the elements of F.
template <class Scalar>
constexpr Vector<9, Scalar> epipolar_equation(const Vector<2, Scalar>& left, const Vector<2, Scalar>& right) {
    return Vector<9, Scalar>(right[0] * left[0], right[0] * left[1], right[0], right[1] * left[0],
                             right[1] * left[1], right[1], left[0], left[1], scalar_of<Scalar>(1));
}

/// The eigenvector of the least eigenvalue; degenerate if the one before is not above a limit and a quarter
/// more than the least. Of a plane, three are alike: of 200 random ones with noise, one of a hundred had the
/// third more than 16 + 512 / n times the least, from 25 pairs on.
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> least_direction(Matrix<9, 9, Scalar>& sums, Scalar limit,
                                                       std::int64_t used) {
    Matrix<9, 9, Scalar> vectors;
    const Status status = symmetric_eigen(sums.view(), vectors.view());
    if (status != Status::ok) return status;
    const Scalar least = absolute(sums(8, 8));
    const Scalar times = scalar_of<Scalar>(16) + scalar_of<Scalar>(512) / scalar_of<Scalar>(used);
    if (!(limit < sums(7, 7)) || !(least + scale(least, -2) < sums(7, 7)) || !(least * times < sums(6, 6)))
        return Status::degenerate;
    Matrix<3, 3, Scalar> f;
    for (int i = 0; i < 9; ++i) f(i / 3, i % 3) = vectors(i, 8);
    return f;
}

/// The nearest matrix of rank 2; degenerate for one of rank 1.
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> nearest_of_rank_two(Matrix<3, 3, Scalar> a) {
    Matrix<3, 3, Scalar> v;
    Scalar values[3] = {};
    const Status status = svd(a.view(), v.view(), Span<Scalar>(values));
    if (status != Status::ok) return status;
    if (!(scale(values[0], -40) < values[1])) return Status::degenerate;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) a(r, c) = c < 2 ? a(r, c) * values[c] : scalar_of<Scalar>(0);
    return a * v.transposed();
}

/// F between places in frames, as one between places as they are.
template <class Scalar>
constexpr Matrix<3, 3, Scalar> without_frames(Matrix<3, 3, Scalar> f, const PlaceFrame<Scalar>& left,
                                              const PlaceFrame<Scalar>& right) {
    for (int r = 0; r < 3; ++r) {
        f(r, 0) = scale(f(r, 0), -left.bits);
        f(r, 1) = scale(f(r, 1), -left.bits);
        f(r, 2) = f(r, 2) - f(r, 0) * left.origin[0] - f(r, 1) * left.origin[1];
    }
    for (int c = 0; c < 3; ++c) {
        f(0, c) = scale(f(0, c), -right.bits);
        f(1, c) = scale(f(1, c), -right.bits);
        f(2, c) = f(2, c) - f(0, c) * right.origin[0] - f(1, c) * right.origin[1];
    }
    return f;
}

/// Eight points for places left(index) and right(index) for which use(index) holds. error is what a place may
/// be wrong by, in their units.
template <class Scalar, class Left, class Right, class Use>
constexpr Result<Matrix<3, 3, Scalar>> eight_point(std::ptrdiff_t count, Left left, Right right, Use use,
                                                   int fraction_bits, Scalar error) {
    const PlaceFrame<Scalar> from = frame_of_places<Scalar>(count, left, use, fraction_bits);
    const PlaceFrame<Scalar> to = frame_of_places<Scalar>(count, right, use, fraction_bits);
    Matrix<9, 9, Scalar> sums;
    std::int64_t used = 0;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        if (!use(i)) continue;
        ++used;
        const Vector<9, Scalar> row = epipolar_equation(from(left(i)), to(right(i)));
        for (int r = 0; r < 9; ++r)
            for (int c = r; c < 9; ++c) sums(r, c) = sums(r, c) + row[r] * row[c];
    }
    if (used < 8) return Status::bad_argument;
    for (int r = 1; r < 9; ++r)
        for (int c = 0; c < r; ++c) sums(r, c) = sums(c, r);
    const Scalar first = scale(error, -from.bits);
    const Scalar second = scale(error, -to.bits);
    const Result<Matrix<3, 3, Scalar>> full =
        least_direction(sums, scalar_of<Scalar>(used) * (first * first + second * second), used);
    if (!full) return full.status();
    const Result<Matrix<3, 3, Scalar>> f = nearest_of_rank_two(*full);
    if (!f) return f.status();
    return of_length_one(without_frames(*f, from, to));
}

constexpr bool far_from_origin(SubPixelPoint pixel) {
    constexpr SubPixel most = SubPixel::from_int(1 << 16);
    return pixel.x > most || pixel.x < -most || pixel.y > most || pixel.y < -most;
}

constexpr Status check_stereo_pairs(Span<const SubPixelPoint> left, Span<const SubPixelPoint> right) {
    if (left.size() != right.size()) return Status::size_mismatch;
    if (left.size() < 8 || left.size() > most_pairs) return Status::bad_argument;
    for (std::ptrdiff_t i = 0; i < left.size(); ++i)
        if (far_from_origin(left[i]) || far_from_origin(right[i])) return Status::out_of_range;
    return Status::ok;
}

/// fit_fundamental() of the pairs for which use(index) holds.
template <class Scalar, class Use>
constexpr Result<Matrix<3, 3, Scalar>> fit_fundamental_to(Span<const SubPixelPoint> left,
                                                          Span<const SubPixelPoint> right, Use use) {
    return eight_point<Scalar>(
        left.size(), [&](std::ptrdiff_t i) { return vector_of<Scalar>(left[i]); },
        [&](std::ptrdiff_t i) { return vector_of<Scalar>(right[i]); }, use, SubPixel::fraction_bits,
        pixel_error<Scalar>());
}

}  // namespace detail

template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> fit_fundamental(Span<const SubPixelPoint> left,
                                                       Span<const SubPixelPoint> right) {
    const Status status = detail::check_stereo_pairs(left, right);
    if (status != Status::ok) return status;
    return detail::fit_fundamental_to<Scalar>(left, right, [](std::ptrdiff_t) { return true; });
}

}  // namespace fovea
