// SPDX-License-Identifier: MIT
//
// The essential matrix, and how two cameras stand to each other as far as their pictures tell: all but the
// length of the baseline.
#pragma once

#include <cstddef>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/linear/svd.hpp>
#include <fovea/number/scalar.hpp>
#include <fovea/stereo/eight_point.hpp>
#include <fovea/stereo/triangulate.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The places at distance 1 from which pixels are seen: their rays, without the third coordinate.
///
/// Shapes  as many rays as pixels
/// Errors  size_mismatch; those of LensInverse::ray() for any of the pixels
template <class Scalar>
constexpr Status rays_of(const LensInverse<Scalar>& lens, Span<const SubPixelPoint> pixels,
                         Span<Vector<2, NonDeduced<Scalar>>> rays);

/// The matrix with singular values 1, 1, 0 that is nearest to one times a factor.
///
/// Errors  degenerate where more than one is as near: the second singular value is less than 2^-40 of the
///         first
/// Source  Hartley and Zisserman, "Multiple View Geometry", sec. 11.7.3
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> nearest_essential(const Matrix<3, 3, Scalar>& a);

/// E with r'^T E r = 0 as nearly as possible for all pairs of rays, with singular values 1, 1, 0.
///
/// Shapes    as many left as right: 8 to 2^20; places at distance 1, as rays_of() makes them
/// Range     coordinates within 16
/// Rounding  places are shifted to a mean in 2^-40 and brought within 1 by a power of two; then that of
///           Scalar
/// Errors    as fit_fundamental(), with 2^-13 in place of 1/16 px, which is that at a focal length of 512 px
/// Source    the eight-point algorithm of fit_fundamental(), and the nearest essential matrix
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> fit_essential(Span<const Vector<2, Scalar>> left,
                                                     Span<const Vector<2, Scalar>> right);

/// The four poses, right from left, that have the same essential matrix, but for its sign and length. The
/// baseline has length 1. The second and fourth have the baseline of the first and third the other way round;
/// the last two are the first two with the right camera turned by half a turn about the baseline.
template <class Scalar = Real>
struct EssentialPoses {
    Pose<Scalar> poses[4];
};

/// Errors  degenerate as nearest_essential()
/// Source  Hartley and Zisserman, sec. 9.6.2
template <class Scalar>
constexpr Result<EssentialPoses<Scalar>> decompose_essential(const Matrix<3, 3, Scalar>& essential);

/// One of the four.
template <class Scalar = Real>
struct RecoveredPose {
    Pose<Scalar> right_from_left;
    std::ptrdiff_t in_front = 0;  ///< of the pairs, those that are seen in front of both cameras
};

/// The pose for which the rays of the pairs meet in front of both cameras.
///
/// Errors  size_mismatch; bad_argument for no pairs; degenerate as above; undecided if less than three
///         quarters of the pairs meet in front of both for any of the poses: wrong pairs, or all so far away
///         that either direction of the baseline will do
/// Source  the same
template <class Scalar>
constexpr Result<RecoveredPose<Scalar>> recover_pose(const Matrix<3, 3, Scalar>& essential,
                                                     Span<const Vector<2, Scalar>> left,
                                                     Span<const Vector<2, Scalar>> right);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int ray_bits = 40;
/// What a ray may be wrong by, in fit_essential().
template <class Scalar>
constexpr Scalar ray_error() {
    return scalar_of<Scalar>(1, -13);
}

template <class Scalar>
constexpr Status check_ray_pairs(Span<const Vector<2, Scalar>> left, Span<const Vector<2, Scalar>> right) {
    if (left.size() != right.size()) return Status::size_mismatch;
    if (left.size() < 8 || left.size() > most_pairs) return Status::bad_argument;
    const Scalar most = scalar_of<Scalar>(16);
    for (std::ptrdiff_t i = 0; i < left.size(); ++i)
        for (int side = 0; side < 2; ++side)
            if (most < absolute(left[i][side]) || most < absolute(right[i][side]))
                return Status::out_of_range;
    return Status::ok;
}

template <class Scalar>
constexpr Vector<3, Scalar> ray_through(const Vector<2, Scalar>& place) {
    return Vector<3, Scalar>(place[0], place[1], scalar_of<Scalar>(1));
}

}  // namespace detail

template <class Scalar>
constexpr Status rays_of(const LensInverse<Scalar>& lens, Span<const SubPixelPoint> pixels,
                         Span<Vector<2, NonDeduced<Scalar>>> rays) {
    if (rays.size() != pixels.size()) return Status::size_mismatch;
    // Once to see that all of them have rays, so that nothing is written if one has none.
    for (int write = 0; write < 2; ++write)
        for (std::ptrdiff_t i = 0; i < pixels.size(); ++i) {
            const Result<Vector<3, Scalar>> ray = lens.ray(vector_of<Scalar>(pixels[i]));
            if (!ray) return ray.status();
            if (write != 0) rays[i] = Vector<2, Scalar>((*ray)[0], (*ray)[1]);
        }
    return Status::ok;
}

template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> nearest_essential(const Matrix<3, 3, Scalar>& a) {
    Matrix<3, 3, Scalar> u = a;
    Matrix<3, 3, Scalar> v;
    Scalar values[3] = {};
    const Status status = svd(u.view(), v.view(), Span<Scalar>(values));
    if (status != Status::ok) return status;
    if (!(scale(values[0], -40) < values[1])) return Status::degenerate;
    for (int r = 0; r < 3; ++r) u(r, 2) = scalar_of<Scalar>(0);
    return u * v.transposed();
}

template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> fit_essential(Span<const Vector<2, Scalar>> left,
                                                     Span<const Vector<2, Scalar>> right) {
    const Status status = detail::check_ray_pairs(left, right);
    if (status != Status::ok) return status;
    const Result<Matrix<3, 3, Scalar>> e = detail::eight_point<Scalar>(
        left.size(), [&](std::ptrdiff_t i) { return left[i]; }, [&](std::ptrdiff_t i) { return right[i]; },
        [](std::ptrdiff_t) { return true; }, detail::ray_bits, detail::ray_error<Scalar>());
    return e ? nearest_essential(*e) : e;
}

template <class Scalar>
constexpr Result<EssentialPoses<Scalar>> decompose_essential(const Matrix<3, 3, Scalar>& essential) {
    Matrix<3, 3, Scalar> u = essential;
    Matrix<3, 3, Scalar> v;
    Scalar values[3] = {};
    const Status status = svd(u.view(), v.view(), Span<Scalar>(values));
    if (status != Status::ok) return status;
    if (!(scale(values[0], -40) < values[1])) return Status::degenerate;
    // The third columns are fixed by the others, so that neither mirrors.
    const Vector<3, Scalar> baseline = cross(u.column(0), u.column(1));
    const Vector<3, Scalar> third = cross(v.column(0), v.column(1));
    EssentialPoses<Scalar> found;
    for (int turn = 0; turn < 2; ++turn) {
        // U W V^T with W the quarter turn about the third axis, or back.
        Matrix<3, 3, Scalar> quarter;
        Matrix<3, 3, Scalar> other;
        for (int r = 0; r < 3; ++r) {
            quarter(r, 0) = turn == 0 ? u(r, 1) : -u(r, 1);
            quarter(r, 1) = turn == 0 ? -u(r, 0) : u(r, 0);
            quarter(r, 2) = baseline[r];
            other(r, 0) = v(r, 0);
            other(r, 1) = v(r, 1);
            other(r, 2) = third[r];
        }
        const Matrix<3, 3, Scalar> rotation = quarter * other.transposed();
        found.poses[2 * turn] = {rotation, baseline};
        found.poses[2 * turn + 1] = {rotation, -baseline};
    }
    return found;
}

template <class Scalar>
constexpr Result<RecoveredPose<Scalar>> recover_pose(const Matrix<3, 3, Scalar>& essential,
                                                     Span<const Vector<2, Scalar>> left,
                                                     Span<const Vector<2, Scalar>> right) {
    if (left.size() != right.size()) return Status::size_mismatch;
    if (left.empty()) return Status::bad_argument;
    const Result<EssentialPoses<Scalar>> found = decompose_essential(essential);
    if (!found) return found.status();
    RecoveredPose<Scalar> best;
    for (const Pose<Scalar>& pose : found->poses) {
        std::ptrdiff_t in_front = 0;
        for (std::ptrdiff_t i = 0; i < left.size(); ++i)
            if (triangulate_rays(pose, detail::ray_through(left[i]), detail::ray_through(right[i])))
                ++in_front;
        if (in_front > best.in_front) best = {pose, in_front};
    }
    if (best.in_front < left.size() - left.size() / 4) return Status::undecided;
    return best;
}

}  // namespace fovea
