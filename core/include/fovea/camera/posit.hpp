// SPDX-License-Identifier: MIT
//
// The pose of a known object that is not flat, from its pixels alone: no start is needed. Book sec. 2.2; the
// toolkit's POSIT.
#pragma once

#include <cstddef>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/match/point_spread.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The pose in which points are seen along their rays: the first point exactly, the others as least squares
/// of a scaled projection have them, which is exact where rays are. refine_pose() goes on from here.
///
/// Shapes    as many points as rays: 4 to 2^20, not on a plane
/// Units     rays are directions in camera coordinates, of any length, as LensInverse::ray() gives them
/// Rounding  until no point's distance changes by 2^-50 of the object's
/// Time      at most 200 rounds; 10 to 20 for an object at three times its size
/// Errors    size_mismatch; bad_argument for fewer than 4 or more than 2^20; out_of_range for a ray that does
///           not lead ahead; degenerate for points on a plane; undecided if 200 rounds do not settle, as when
///           the camera is nearer to the object than its size; irregular where a point would lie behind it
/// Source    DeMenthon and Davis, "Model-Based Object Pose in 25 Lines of Code", IJCV 15, 1995. Unlike the
///           toolkit's it has both focal lengths and the lens, by its rays, and ends by itself
template <class Scalar = Real>
constexpr Result<Pose<Scalar>> posit(Span<const SpacePoint> points,
                                     NonDeduced<Span<const Vector<3, Scalar>>> rays);

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr Result<Pose<Scalar>> posit(Span<const SpacePoint> points,
                                     NonDeduced<Span<const Vector<3, Scalar>>> rays) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar one = scalar_of<Scalar>(1);
    if (points.size() != rays.size()) return Status::size_mismatch;
    if (points.size() < 4 || points.size() > std::ptrdiff_t{1} << 20) return Status::bad_argument;
    for (const Vector<3, Scalar>& ray : rays)
        if (!(zero < ray[2])) return Status::out_of_range;
    const Result<PointSpread> spread = spread_of<Scalar>(points);
    if (!spread) return spread.status();
    if (*spread != PointSpread::space) return Status::degenerate;

    const Vector<3, Scalar> first = vector_of<Scalar>(points[0]);
    const Scalar x0 = rays[0][0] / rays[0][2];
    const Scalar y0 = rays[0][1] / rays[0][2];
    Matrix<3, 3, Scalar> products;
    for (const SpacePoint point : points) {
        const Vector<3, Scalar> arm = vector_of<Scalar>(point) - first;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) products(r, c) = products(r, c) + arm[r] * arm[c];
    }
    const auto back = inverse(products);
    if (!back) return back.status();

    Pose<Scalar> pose;
    // How much farther a point is than the first, in parts of the first's distance: axis times its arm.
    Vector<3, Scalar> axis;
    bool settled = false;
    for (int round = 0; round < 200 && !settled; ++round) {
        Vector<3, Scalar> across;
        Vector<3, Scalar> down;
        for (std::ptrdiff_t i = 1; i < points.size(); ++i) {
            const Vector<3, Scalar> arm = vector_of<Scalar>(points[i]) - first;
            const Scalar farther = (one + dot(axis, arm)) / rays[i][2];
            across += arm * (rays[i][0] * farther - x0);
            down += arm * (rays[i][1] * farther - y0);
        }
        across = *back * across;
        down = *back * down;
        const auto i = normalized(across);
        const auto k = normalized(cross(across, down));
        if (!i || !k) return Status::degenerate;
        const Vector<3, Scalar> j = cross(*k, *i);
        const Scalar size = scale(length_of(across) + length_of(down), -1);
        const Vector<3, Scalar> next = *k * size;
        const Vector<3, Scalar> change = next - axis;
        settled = !(scale(size, -50) < length_of(change));
        axis = next;
        pose.rotation =
            Matrix<3, 3, Scalar>((*i)[0], (*i)[1], (*i)[2], j[0], j[1], j[2], (*k)[0], (*k)[1], (*k)[2]);
        const Scalar distance = one / size;
        pose.translation = Vector<3, Scalar>(x0 * distance, y0 * distance, distance) - pose.rotation * first;
    }
    if (!settled) return Status::undecided;
    for (const SpacePoint point : points)
        if (!(zero < pose(vector_of<Scalar>(point))[2])) return Status::irregular;
    return pose;
}

}  // namespace fovea
