// SPDX-License-Identifier: MIT
//
// How points of an object lie: what can be told from them depends on it.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linear/eigen.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The least that holds all points.
enum class PointSpread : std::uint8_t {
    point,  ///< all in one place
    line,
    plane,
    space,
};

/// How points lie. What is thinner than 2^-16 of the longest extent, as deviations, counts as flat.
///
/// Shapes    1 to 2^20 points, anywhere
/// Rounding  sums are exact
/// Errors    bad_argument for no point, or more than 2^20
/// Source    eigenvalues of the covariance
template <class Scalar = Real>
constexpr Result<PointSpread> spread_of(Span<const SpacePoint> points);
template <class Scalar = Real>
constexpr Result<PointSpread> spread_of(Span<const PlanePoint> points);

/// A place of a plane in space, at z = 0.
constexpr SpacePoint in_space(PlanePoint point) { return {point.x, point.y, 0}; }
constexpr SpacePoint in_space(SpacePoint point) { return point; }

/// A place in space as a vector.
template <class Scalar = Real>
constexpr Vector<3, Scalar> vector_of(SpacePoint point) {
    return Vector<3, Scalar>(scalar_of<Scalar>(point.x), scalar_of<Scalar>(point.y),
                             scalar_of<Scalar>(point.z));
}

// ---- Implementation ---------------------------------------------------------------

namespace detail {

template <class Scalar, class Point>
constexpr Result<PointSpread> spread_of_points(Span<const Point> points) {
    const std::int64_t count = points.size();
    if (count < 1 || count > std::int64_t{1} << 20) return Status::bad_argument;
    // From the first point, sides are below 2^32, sums below 2^52, products below 2^104.
    const SpacePoint first = in_space(points[0]);
    std::int64_t sums[3] = {};
    Int128 products[3][3];
    for (const Point whole : points) {
        const SpacePoint point = in_space(whole);
        const std::int64_t side[3] = {std::int64_t{point.x} - first.x, std::int64_t{point.y} - first.y,
                                      std::int64_t{point.z} - first.z};
        for (int r = 0; r < 3; ++r) {
            sums[r] += side[r];
            for (int c = r; c < 3; ++c) products[r][c] += Int128::product(side[r], side[c]);
        }
    }
    Matrix<3, 3, Scalar> covariance;
    for (int r = 0; r < 3; ++r)
        for (int c = r; c < 3; ++c) {
            const Int128 sum = products[r][c] * count - Int128::product(sums[r], sums[c]);
            covariance(r, c) = covariance(c, r) = ScalarTraits<Scalar>::from_int(sum, 0);
        }
    Matrix<3, 3, Scalar> vectors;
    const Status status = symmetric_eigen(covariance.view(), vectors.view());
    if (status != Status::ok) return status;
    if (!(scalar_of<Scalar>(0) < covariance(0, 0))) return PointSpread::point;
    const Scalar thin = scale(covariance(0, 0), -32);
    if (!(thin < covariance(1, 1))) return PointSpread::line;
    return thin < covariance(2, 2) ? PointSpread::space : PointSpread::plane;
}

}  // namespace detail

template <class Scalar>
constexpr Result<PointSpread> spread_of(Span<const SpacePoint> points) {
    return detail::spread_of_points<Scalar>(points);
}
template <class Scalar>
constexpr Result<PointSpread> spread_of(Span<const PlanePoint> points) {
    return detail::spread_of_points<Scalar>(points);
}

}  // namespace fovea
