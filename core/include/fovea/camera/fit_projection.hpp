// SPDX-License-Identifier: MIT
//
// The projection matrix that fits points of space and their pixels best: the direct linear transform. Book
// sec. 2.2.3.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/projection_matrix.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/least_squares.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/match/point_spread.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The projection matrix that takes points to pixels. Its third row has length 1, so that it tells distances
/// from the plane of the camera.
///
/// Shapes    as many points as pixels: 6 to 2^20
/// Range     no point is further than 2^26 of its units, no pixel further than 2^26 / 256, from the mean
/// Rounding  sums are exact; then that of Scalar
/// Errors    size_mismatch; bad_argument for fewer than 6 pairs or more than 2^20; out_of_range beyond the
///           range; degenerate for points on a plane, or on any other surface or curve that leaves the matrix
///           open: all but one on a plane, or a twisted cubic through the camera; irregular where points
///           would lie behind the camera, or the pixels are those of a mirror
/// Source    book eq. 2.10 to 2.15, by exact sums; with the origins shifted to the means, so that L12 is the
///           distance of the mean and the equations weigh alike wherever the world has its origin. Lengths
///           are not made alike, as 64 digits have no need of it
template <class Scalar = Real>
constexpr Result<Matrix<3, 4, Scalar>> fit_projection(Span<const SpacePoint> points,
                                                      Span<const SubPixelPoint> pixels);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr std::int64_t most_space_pairs = std::int64_t{1} << 20;
inline constexpr std::int64_t most_from_centre = std::int64_t{1} << 26;

/// The sums that the means are made of.
struct PairMeans {
    std::int64_t x[3] = {};
    std::int64_t u[2] = {};

    constexpr PairMeans(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels) {
        for (std::ptrdiff_t i = 0; i < points.size(); ++i) {
            const SpacePoint point = points[i];
            x[0] += point.x;
            x[1] += point.y;
            x[2] += point.z;
            u[0] += pixels[i].x.raw();
            u[1] += pixels[i].y.raw();
        }
        for (std::int64_t& sum : x) sum = floor_divide(sum, std::int64_t{points.size()});
        for (std::int64_t& sum : u) sum = floor_divide(sum, std::int64_t{points.size()});
    }
};

/// The matrix between coordinates from the means, as one between coordinates as they are.
template <class Scalar>
constexpr Matrix<3, 4, Scalar> uncentred(Matrix<3, 4, Scalar> matrix, const PairMeans& means) {
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            matrix(r, 3) = matrix(r, 3) - matrix(r, c) * scalar_of<Scalar>(means.x[c]);
    for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 4; ++c)
            matrix(r, c) =
                scale(matrix(r, c) + matrix(2, c) * scalar_of<Scalar>(means.u[r]), -SubPixel::fraction_bits);
    return matrix;
}

}  // namespace detail

template <class Scalar>
constexpr Result<Matrix<3, 4, Scalar>> fit_projection(Span<const SpacePoint> points,
                                                      Span<const SubPixelPoint> pixels) {
    if (points.size() != pixels.size()) return Status::size_mismatch;
    if (points.size() < 6 || points.size() > detail::most_space_pairs) return Status::bad_argument;
    const detail::PairMeans means(points, pixels);
    // Coefficients reach 2^52, so that 2^20 squares reach 2^125.
    ExactLeastSquares<11> equations;
    for (std::ptrdiff_t i = 0; i < points.size(); ++i) {
        const std::int64_t x = points[i].x - means.x[0];
        const std::int64_t y = points[i].y - means.x[1];
        const std::int64_t z = points[i].z - means.x[2];
        const std::int64_t u = pixels[i].x.raw() - means.u[0];
        const std::int64_t v = pixels[i].y.raw() - means.u[1];
        const std::int64_t sides[5] = {x, y, z, u, v};
        for (const std::int64_t side : sides)
            if (side > detail::most_from_centre || side < -detail::most_from_centre)
                return Status::out_of_range;
        equations.add({x, y, z, 1, 0, 0, 0, 0, -u * x, -u * y, -u * z}, u);
        equations.add({0, 0, 0, 0, x, y, z, 1, -v * x, -v * y, -v * z}, v);
    }
    const Result<PointSpread> spread = spread_of<Scalar>(points);
    if (!spread) return spread.status();
    if (*spread != PointSpread::space) return Status::degenerate;
    Vector<11, Scalar> l;
    const Status status = equations.solve(Span<Scalar>(&l[0], 11));
    if (status != Status::ok) return status;

    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar one = scalar_of<Scalar>(1);
    Matrix<3, 4, Scalar> matrix;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c) matrix(r, c) = r == 2 && c == 3 ? one : l[4 * r + c];
    matrix = detail::uncentred(matrix, means);
    const Scalar length = length_of(detail::head_of_row(matrix, 2));
    if (!(zero < length)) return Status::degenerate;
    matrix = matrix * (one / length);
    const auto distance = [&](SpacePoint point) {
        return dot(detail::head_of_row(matrix, 2), vector_of<Scalar>(point)) + matrix(2, 3);
    };
    Scalar farthest = zero;
    for (const SpacePoint point : points)
        if (farthest < absolute(distance(point))) farthest = absolute(distance(point));
    bool behind = false;
    for (const SpacePoint point : points) {
        // With all but one point on a plane, that plane as the camera's fits without any error.
        if (absolute(distance(point)) < scale(farthest, -24)) return Status::degenerate;
        behind = behind || distance(point) < zero;
    }
    if (behind) return Status::irregular;
    const Vector<3, Scalar> across = detail::head_of_row(matrix, 0);
    const Vector<3, Scalar> down = detail::head_of_row(matrix, 1);
    if (!(zero < dot(cross(across, down), detail::head_of_row(matrix, 2)))) return Status::irregular;
    return matrix;
}

}  // namespace fovea
