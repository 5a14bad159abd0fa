// SPDX-License-Identifier: MIT
//
// Planes through points in space.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linear/eigen.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/match/point_spread.hpp>
#include <fovea/match/ransac.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The points p with normal * p = offset; the normal has length 1, and its largest component is above 0.
template <class Scalar = Real>
struct Plane {
    Vector<3, Scalar> normal;
    Scalar offset{};
};

/// How far a point is from a plane: positive on the side to which the normal points.
template <class Scalar>
constexpr Scalar distance_from(const Plane<Scalar>& plane, const Vector<3, Scalar>& point) {
    return dot(plane.normal, point) - plane.offset;
}

/// A fitted plane, the root of the mean squared distance, and how many points it rests on.
template <class Scalar = Real>
struct PlaneFit {
    Plane<Scalar> plane;
    Scalar rms{};
    std::ptrdiff_t used = 0;
};

/// The plane with the least sum of squared distances.
///
/// Shapes    3 to 2^20 points
/// Units     those of the points
/// Rounding  sums are exact; then that of symmetric_eigen()
/// Errors    bad_argument for fewer than 3 points or more than 2^20; degenerate for points on a line, or
///           that spread as far square to the plane as along it
/// Source    total least squares; Pearson, "On Lines and Planes of Closest Fit", 1901
template <class Scalar = Real>
constexpr Result<PlaneFit<Scalar>> fit_plane(Span<const SpacePoint> points);

/// The plane with most points within tolerance: through three of them, then fitted to those within, twice.
///
/// Errors  also bad_argument for a tolerance that is not above 0 or options out of range; not_found if fewer
///         than options.enough lie within
template <class Scalar = Real>
constexpr Result<PlaneFit<Scalar>> fit_plane_ransac(Span<const SpacePoint> points,
                                                    NonDeduced<Scalar> tolerance,
                                                    const RansacOptions& options = {});

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The plane through a place, square to a direction that is not 0.
template <class Scalar>
constexpr Plane<Scalar> plane_at(const Vector<3, Scalar>& place, const Vector<3, Scalar>& direction) {
    Plane<Scalar> plane;
    plane.normal = direction * (scalar_of<Scalar>(1) / length_of(direction));
    int largest = 0;
    for (int i = 1; i < 3; ++i)
        if (absolute(plane.normal[largest]) < absolute(plane.normal[i])) largest = i;
    if (plane.normal[largest] < scalar_of<Scalar>(0)) plane.normal = -plane.normal;
    plane.offset = dot(plane.normal, place);
    return plane;
}

/// fit_plane() over the points for which keep(point) holds.
template <class Scalar, class Keep>
constexpr Result<PlaneFit<Scalar>> fit_plane_to(Span<const SpacePoint> points, Keep keep) {
    if (points.size() > std::ptrdiff_t{1} << 20) return Status::bad_argument;
    std::int64_t count = 0;
    std::int64_t sum[3] = {};
    for (const SpacePoint point : points) {
        if (!keep(point)) continue;
        ++count;
        sum[0] += point.x;
        sum[1] += point.y;
        sum[2] += point.z;
    }
    if (count < 3) return Status::bad_argument;
    // From the mean to the next whole place: sides are below 2^32, sums of products below 2^84, and count
    // times as much below 2^104.
    std::int64_t origin[3] = {};
    for (int i = 0; i < 3; ++i) origin[i] = floor_divide(sum[i], count);
    std::int64_t rest[3] = {};
    Int128 products[3][3];
    for (const SpacePoint point : points) {
        if (!keep(point)) continue;
        const std::int64_t side[3] = {point.x - origin[0], point.y - origin[1], point.z - origin[2]};
        for (int i = 0; i < 3; ++i) {
            rest[i] += side[i];
            for (int k = i; k < 3; ++k) products[i][k] += Int128::product(side[i], side[k]);
        }
    }
    Matrix<3, 3, Scalar> spread;
    for (int i = 0; i < 3; ++i) {
        for (int k = i; k < 3; ++k) {
            const Int128 about = products[i][k] * count - Int128::product(rest[i], rest[k]);
            spread(i, k) = ScalarTraits<Scalar>::from_int(about, 0);
            spread(k, i) = spread(i, k);
        }
    }
    Matrix<3, 3, Scalar> axes;
    const Status status = symmetric_eigen(spread.view(), axes.view());
    if (status != Status::ok) return status;
    // On a line, or alike across: which of the axes is the normal is not determined.
    if (!(scale(spread(0, 0), -48) < spread(1, 1))) return Status::degenerate;
    if (!(spread(2, 2) < spread(1, 1) - scale(spread(1, 1), -32))) return Status::degenerate;

    PlaneFit<Scalar> fit;
    const Scalar number = scalar_of<Scalar>(count);
    Vector<3, Scalar> centre;
    for (int i = 0; i < 3; ++i)
        centre[i] = scalar_of<Scalar>(origin[i]) + scalar_of<Scalar>(rest[i]) / number;
    fit.plane = plane_at(centre, axes.column(2));
    // What rounding leaves below 0 is 0.
    const Scalar least = spread(2, 2) < scalar_of<Scalar>(0) ? scalar_of<Scalar>(0) : spread(2, 2);
    fit.rms = square_root(least) / number;
    fit.used = static_cast<std::ptrdiff_t>(count);
    return fit;
}

}  // namespace detail

template <class Scalar>
constexpr Result<PlaneFit<Scalar>> fit_plane(Span<const SpacePoint> points) {
    return detail::fit_plane_to<Scalar>(points, [](SpacePoint) { return true; });
}

template <class Scalar>
constexpr Result<PlaneFit<Scalar>> fit_plane_ransac(Span<const SpacePoint> points,
                                                    NonDeduced<Scalar> tolerance,
                                                    const RansacOptions& options) {
    if (!(scalar_of<Scalar>(0) < tolerance)) return Status::bad_argument;
    const auto within = [&](const Plane<Scalar>& plane, SpacePoint point) {
        return absolute(distance_from(plane, vector_of<Scalar>(point))) <= tolerance;
    };
    const auto best = ransac<3, Plane<Scalar>>(
        points.size(), options,
        [&](const std::ptrdiff_t(&chosen)[3]) -> Result<Plane<Scalar>> {
            const Vector<3, Scalar> a = vector_of<Scalar>(points[chosen[0]]);
            const Vector<3, Scalar> b = vector_of<Scalar>(points[chosen[1]]) - a;
            const Vector<3, Scalar> c = vector_of<Scalar>(points[chosen[2]]) - a;
            const Vector<3, Scalar> normal = cross(b, c);
            // Sides that differ in direction by less than 2^-20 make no plane.
            if (dot(normal, normal) <= scale(dot(b, b) * dot(c, c), -40)) return Status::degenerate;
            return detail::plane_at(a, normal);
        },
        [&](const Plane<Scalar>& plane, std::ptrdiff_t i) { return within(plane, points[i]); });
    if (!best) return best.status();
    Plane<Scalar> plane = best->model;
    Result<PlaneFit<Scalar>> fit = Status::degenerate;
    for (int round = 0; round < 2; ++round) {
        fit = detail::fit_plane_to<Scalar>(points, [&](SpacePoint point) { return within(plane, point); });
        if (!fit) return fit;
        plane = fit->plane;
    }
    return fit;
}

}  // namespace fovea
