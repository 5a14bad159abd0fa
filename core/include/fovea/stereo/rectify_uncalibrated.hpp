// SPDX-License-Identifier: MIT
//
// Rectification of two pictures whose cameras are not known: homographies from the fundamental matrix and
// pairs of pixels.
#pragma once

#include <cstddef>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/cholesky.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>
#include <fovea/stereo/eight_point.hpp>
#include <fovea/stereo/epipolar.hpp>
#include <fovea/stereo/rectify.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Homographies from pixels as they were to rectified ones; their divisors are above 0 in the whole picture.
template <class Scalar = Real>
struct RectifyingHomographies {
    Matrix<3, 3, Scalar> left;
    Matrix<3, 3, Scalar> right;
    StereoAxis axis = StereoAxis::x;
};

/// Makes the rows, or columns for cameras above each other, of two pictures agree. The right picture is
/// turned about its middle and bent as little as that takes; the left one follows, with disparities as small
/// as possible for the pairs.
///
/// Shapes    3 pairs or more; wrong ones are the caller's to leave out
/// Range     no pixel is further than 2^16 px from the origin
/// Errors    size_mismatch; empty_image; image_too_large; bad_argument for fewer than 3 pairs or more than
///           2^20; out_of_range for pixels beyond the range; degenerate for a matrix whose rank is not 2 as
///           epipoles() says, if an epipole is in its picture or its lines cannot be made parallel without
///           the horizon in a picture, if the left pixels are on a line, or if the pairs mirror
/// Source    Hartley, "Theory and Practice of Projective Rectification", IJCV 35(2), 1999; what that chooses
///           freely for the left picture changes its row of the axis alone, and the pairs fix that
template <class Scalar>
constexpr Result<RectifyingHomographies<Scalar>> rectify_uncalibrated(const Matrix<3, 3, Scalar>& fundamental,
                                                                      Span<const SubPixelPoint> left,
                                                                      Span<const SubPixelPoint> right,
                                                                      Size size);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Turns the right picture about its middle until the epipole is on the axis, and moves it to infinity.
template <class Scalar>
constexpr Result<RectifyingHomographies<Scalar>> epipole_to_infinity(const Vector<3, Scalar>& epipole,
                                                                     Size size) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar one = scalar_of<Scalar>(1);
    const Scalar cx = scalar_of<Scalar>(size.width - 1, -1);
    const Scalar cy = scalar_of<Scalar>(size.height - 1, -1);
    Scalar x = epipole[0] - cx * epipole[2];
    Scalar y = epipole[1] - cy * epipole[2];
    Scalar z = epipole[2];
    RectifyingHomographies<Scalar> found;
    found.axis = absolute(x) < absolute(y) ? StereoAxis::y : StereoAxis::x;
    const bool along_x = found.axis == StereoAxis::x;
    if ((along_x ? x : y) < zero) {
        x = -x;
        y = -y;
        z = -z;
    }
    const Scalar length = square_root(x * x + y * y);
    if (!(zero < length)) return Status::degenerate;
    const Scalar cosine = (along_x ? x : y) / length;
    const Scalar sine = (along_x ? y : -x) / length;
    const Scalar bend = -z / length;
    // To the middle, turned, bent, and back.
    Matrix<3, 3, Scalar> h(cosine, sine, -cosine * cx - sine * cy, -sine, cosine, sine * cx - cosine * cy,
                           zero, zero, one);
    for (int c = 0; c < 3; ++c) h(2, c) = h(2, c) + bend * h(along_x ? 0 : 1, c);
    for (int c = 0; c < 3; ++c) {
        h(0, c) = h(0, c) + cx * h(2, c);
        h(1, c) = h(1, c) + cy * h(2, c);
    }
    found.right = h;
    return found;
}

/// Whether the divisor of a homography is above 2^-8 of what it is in the middle at all corners of a picture.
template <class Scalar>
constexpr bool without_horizon(const Matrix<3, 3, Scalar>& h, Size size) {
    const auto divisor = [&](const Scalar& x, const Scalar& y) {
        return h(2, 0) * x + h(2, 1) * y + h(2, 2);
    };
    const Scalar right = scalar_of<Scalar>(size.width - 1);
    const Scalar bottom = scalar_of<Scalar>(size.height - 1);
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar least = scale(divisor(scale(right, -1), scale(bottom, -1)), -8);
    return zero < least && least < divisor(zero, zero) && least < divisor(right, zero) &&
           least < divisor(zero, bottom) && least < divisor(right, bottom);
}

/// The row of the left homography along the axis: least squares of what is left of the disparities.
template <class Scalar>
constexpr Status fit_along_axis(Span<const SubPixelPoint> left, Span<const SubPixelPoint> right,
                                RectifyingHomographies<Scalar>& found) {
    const int axis = found.axis == StereoAxis::x ? 0 : 1;
    const auto place = [&](std::ptrdiff_t i) { return vector_of<Scalar>(left[i]); };
    const PlaceFrame<Scalar> frame = frame_of_places<Scalar>(
        left.size(), place, [](std::ptrdiff_t) { return true; }, SubPixel::fraction_bits);
    const Scalar one = scalar_of<Scalar>(1);
    const Scalar zero = scalar_of<Scalar>(0);
    Matrix<3, 3, Scalar> sums;
    Vector<3, Scalar> rest;
    for (std::ptrdiff_t i = 0; i < left.size(); ++i) {
        const Vector<2, Scalar> from = place(i);
        const Vector<2, Scalar> to = vector_of<Scalar>(right[i]);
        const Scalar divisor = found.left(2, 0) * from[0] + found.left(2, 1) * from[1] + found.left(2, 2);
        const Vector<3, Scalar> seen = found.right * Vector<3, Scalar>(to[0], to[1], one);
        if (!(zero < divisor) || !(zero < seen[2])) return Status::degenerate;
        const Vector<2, Scalar> framed = frame(from);
        const Vector<3, Scalar> row(framed[0] / divisor, framed[1] / divisor, one / divisor);
        const Scalar wanted = seen[axis] / seen[2];
        for (int r = 0; r < 3; ++r) {
            for (int c = r; c < 3; ++c) sums(r, c) = sums(r, c) + row[r] * row[c];
            rest[r] = rest[r] + row[r] * wanted;
        }
    }
    const Matrix<3, 3, Scalar> whole = sums;
    Status status = factor_ldlt(sums.view());
    if (status != Status::ok) return status;
    // Pixels on a line leave what their rounding to 1/256 px made.
    for (int i = 0; i < 3; ++i)
        if (!(scale(whole(i, i), -24) < sums(i, i))) return Status::degenerate;
    status = solve_with_ldlt(sums.view(), Span<Scalar>(&rest[0], 3));
    if (status != Status::ok) return status;
    found.left(axis, 0) = scale(rest[0], -frame.bits);
    found.left(axis, 1) = scale(rest[1], -frame.bits);
    found.left(axis, 2) =
        rest[2] - found.left(axis, 0) * frame.origin[0] - found.left(axis, 1) * frame.origin[1];
    return Status::ok;
}

}  // namespace detail

template <class Scalar>
constexpr Result<RectifyingHomographies<Scalar>> rectify_uncalibrated(const Matrix<3, 3, Scalar>& fundamental,
                                                                      Span<const SubPixelPoint> left,
                                                                      Span<const SubPixelPoint> right,
                                                                      Size size) {
    if (size.empty()) return Status::empty_image;
    if (left.size() != right.size()) return Status::size_mismatch;
    if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
    if (left.size() < 3 || left.size() > detail::most_pairs) return Status::bad_argument;
    for (std::ptrdiff_t i = 0; i < left.size(); ++i)
        if (detail::far_from_origin(left[i]) || detail::far_from_origin(right[i]))
            return Status::out_of_range;
    const Result<Epipoles<Scalar>> ends = epipoles(fundamental);
    if (!ends) return ends.status();

    const Result<RectifyingHomographies<Scalar>> turned = detail::epipole_to_infinity(ends->right, size);
    if (!turned) return turned;
    RectifyingHomographies<Scalar> found = *turned;
    // The rows that must agree; that of the axis is fitted. An epipole in a picture is on its horizon.
    const Matrix<3, 3, Scalar> h = found.right * (cross_matrix(ends->right) * fundamental);
    const Scalar divisor = h(2, 0) * scalar_of<Scalar>(size.width - 1, -1) +
                           h(2, 1) * scalar_of<Scalar>(size.height - 1, -1) + h(2, 2);
    if (divisor == scalar_of<Scalar>(0)) return Status::degenerate;
    found.left = h * (scalar_of<Scalar>(1) / divisor);
    if (!detail::without_horizon(found.left, size) || !detail::without_horizon(found.right, size))
        return Status::degenerate;
    const Status status = detail::fit_along_axis(left, right, found);
    if (status != Status::ok) return status;
    if (!(scalar_of<Scalar>(0) < determinant(found.left))) return Status::degenerate;
    return found;
}

}  // namespace fovea
