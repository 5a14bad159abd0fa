// SPDX-License-Identifier: MIT
//
// The pose of a flat object that a known camera sees, and the other one that looks nearly like it.
#pragma once

#include <cstddef>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/calibration.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/refine_pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/fit_homography.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// One or two poses, the one that fits better first. Where the second has nearly the rms of the first, the
/// picture does not tell which of them it is: a small or distant plane may as well be tilted the other way.
template <class Scalar = Real>
struct PlanarPoses {
    PoseFit<Scalar> fits[2];
    int count = 0;
};

/// Two poses of a plane.
template <class Scalar = Real>
struct PlaneTilts {
    Pose<Scalar> poses[2];
};

/// The two tilts of a plane that a homography leaves, from the homography's slopes at one place: they agree
/// in these slopes exactly, and differ in how these change.
///
/// homography  of places to coordinates at distance 1, with a divisor above 0 at the place
/// place       a place of the plane
/// Errors      degenerate where the homography has no inverse there, or a divisor that is not above 0
/// Source      Collins and Bartoli, "Infinitesimal Plane-Based Pose Estimation", IJCV 109, 2014
template <class Scalar>
constexpr Result<PlaneTilts<Scalar>> poses_of_plane(const Matrix<3, 3, Scalar>& homography,
                                                    const Vector<2, Scalar>& place);

/// Scratch elements that planar_pose() needs.
constexpr std::ptrdiff_t planar_pose_scratch(std::ptrdiff_t points) { return points; }

/// The poses of a flat object, each with the least sum of squared distances near it.
///
/// Shapes    as many points as pixels: 4 to 2^20; z is 0
/// Scratch   planar_pose_scratch(points.size()) pixels, undefined afterwards
/// Rounding  as refine_pose(); a second pose that runs into the first is not told
/// Errors    size_mismatch, bad_argument, out_of_range, degenerate as fit_homography() and LensInverse::ray()
///           have them; scratch_too_small; undecided if no least is reached
/// Source    fit_homography() without the lens, poses_of_plane() at the mean of the points, refine_pose()
template <class Scalar = Real>
constexpr Result<PlanarPoses<Scalar>> planar_pose(Span<const PlanePoint> points,
                                                  Span<const SubPixelPoint> pixels,
                                                  const Camera<Scalar>& camera, Span<SubPixelPoint> scratch);

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr Result<PlaneTilts<Scalar>> poses_of_plane(const Matrix<3, 3, Scalar>& homography,
                                                    const Vector<2, Scalar>& place) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar one = scalar_of<Scalar>(1);
    const Vector<3, Scalar> at = homography * Vector<3, Scalar>(place[0], place[1], one);
    if (!(zero < at[2])) return Status::degenerate;
    const Scalar share = one / at[2];
    const Scalar u = at[0] * share;
    const Scalar v = at[1] * share;
    // The slopes of u and v by the two axes of the plane.
    Scalar slopes[2][2] = {};
    for (int c = 0; c < 2; ++c) {
        slopes[0][c] = (homography(0, c) - u * homography(2, c)) * share;
        slopes[1][c] = (homography(1, c) - v * homography(2, c)) * share;
    }
    // A turn that takes the axis of the camera to the ray of the place: the slopes are the upper left part of
    // the plane's rotation behind it, seen by b, and divided by the distance.
    const Scalar length = square_root(u * u + v * v + one);
    const Scalar x = u / length;
    const Scalar y = v / length;
    const Scalar z = one / length;
    const Scalar fall = one / (one + z);
    const Matrix<3, 3, Scalar> turn(one - x * x * fall, -(x * y * fall), x, -(x * y * fall),
                                    one - y * y * fall, y, -x, -y, z);
    const Scalar b[2][2] = {{turn(0, 0) - u * turn(2, 0), turn(0, 1) - u * turn(2, 1)},
                            {turn(1, 0) - v * turn(2, 0), turn(1, 1) - v * turn(2, 1)}};
    const Scalar size = b[0][0] * b[1][1] - b[0][1] * b[1][0];
    Scalar a[2][2] = {};
    for (int c = 0; c < 2; ++c) {
        a[0][c] = (b[1][1] * slopes[0][c] - b[0][1] * slopes[1][c]) / size;
        a[1][c] = (b[0][0] * slopes[1][c] - b[1][0] * slopes[0][c]) / size;
    }
    // The larger singular value of that part of a rotation is 1, so that of a is one over the distance.
    const Scalar squares = a[0][0] * a[0][0] + a[0][1] * a[0][1] + a[1][0] * a[1][0] + a[1][1] * a[1][1];
    const Scalar area = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    const Scalar spread = squares * squares - scale(area * area, 2);
    const Scalar largest = scale(squares + (zero < spread ? square_root(spread) : zero), -1);
    if (!(zero < largest) || !(scale(largest, -40) < absolute(area))) return Status::degenerate;
    const Scalar distance = one / square_root(largest);
    Vector<3, Scalar> columns[2];
    for (int c = 0; c < 2; ++c) {
        columns[c][0] = a[0][c] * distance;
        columns[c][1] = a[1][c] * distance;
    }
    // What the columns lack to length 1, and to be square to each other.
    const auto lacking = [&](int i, int k) {
        const Scalar sum = columns[i][0] * columns[k][0] + columns[i][1] * columns[k][1];
        return i == k ? one - sum : -sum;
    };
    const int more = lacking(0, 0) < lacking(1, 1) ? 1 : 0;
    if (zero < lacking(more, more)) {
        columns[more][2] = square_root(lacking(more, more));
        columns[1 - more][2] = lacking(0, 1) / columns[more][2];
    }
    PlaneTilts<Scalar> found;
    for (int i = 0; i < 2; ++i) {
        // Rounding aside the columns are square: the third and the second follow from the first.
        const auto first = normalized(columns[0]);
        const auto third = normalized(cross(columns[0], columns[1]));
        if (!first || !third) return Status::degenerate;
        const Vector<3, Scalar> second = cross(*third, *first);
        Matrix<3, 3, Scalar> rotation;
        for (int r = 0; r < 3; ++r) {
            rotation(r, 0) = (*first)[r];
            rotation(r, 1) = second[r];
            rotation(r, 2) = (*third)[r];
        }
        Pose<Scalar>& pose = found.poses[i];
        pose.rotation = turn * rotation;
        pose.translation = Vector<3, Scalar>(u, v, one) * distance -
                           pose.rotation * Vector<3, Scalar>(place[0], place[1], zero);
        for (Vector<3, Scalar>& column : columns) column[2] = -column[2];
    }
    return found;
}

namespace detail {

/// Whether two poses are one: alike to 2^-20 of a turn and of the distance.
template <class Scalar>
constexpr bool alike(const Pose<Scalar>& a, const Pose<Scalar>& b) {
    const Scalar limit = scalar_of<Scalar>(1, -20);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            if (limit < absolute(a.rotation(r, c) - b.rotation(r, c))) return false;
    return !(limit * length_of(a.translation) < length_of(a.translation - b.translation));
}

/// A pixel as a camera without lens would see it, to 1/256 px.
template <class Scalar>
constexpr Result<SubPixelPoint> without_lens(const LensInverse<Scalar>& lens, const Camera<Scalar>& camera,
                                             SubPixelPoint pixel) {
    const Result<Vector<3, Scalar>> ray = lens.ray(pixel_seen<Scalar>(pixel));
    if (!ray) return ray.status();
    const Vector<2, Scalar> ideal = pixel_of(camera, Vector<2, Scalar>((*ray)[0], (*ray)[1]));
    const auto fixed = [](Scalar value) {
        return SubPixel::from_raw(
            saturate_cast<std::int32_t>(ScalarTraits<Scalar>::rounded(value, SubPixel::fraction_bits)));
    };
    return SubPixelPoint{fixed(ideal[0]), fixed(ideal[1])};
}

}  // namespace detail

template <class Scalar>
constexpr Result<PlanarPoses<Scalar>> planar_pose(Span<const PlanePoint> points,
                                                  Span<const SubPixelPoint> pixels,
                                                  const Camera<Scalar>& camera, Span<SubPixelPoint> scratch) {
    if (points.size() != pixels.size()) return Status::size_mismatch;
    if (points.size() < 4 || points.size() > std::ptrdiff_t{1} << 20) return Status::bad_argument;
    if (scratch.size() < planar_pose_scratch(points.size())) return Status::scratch_too_small;
    const LensInverse<Scalar> lens(camera);
    std::int64_t sum_x = 0;
    std::int64_t sum_y = 0;
    for (std::ptrdiff_t i = 0; i < points.size(); ++i) {
        const Result<SubPixelPoint> ideal = detail::without_lens(lens, camera, pixels[i]);
        if (!ideal) return ideal.status();
        scratch[i] = *ideal;
        sum_x += points[i].x;
        sum_y += points[i].y;
    }
    const auto map = fit_homography<Scalar>(points, Span<const SubPixelPoint>(scratch.data(), points.size()));
    if (!map) return map.status();
    Matrix<3, 3, Scalar> homography = *map;
    for (int c = 0; c < 3; ++c) {
        homography(0, c) = (homography(0, c) - camera.cx * homography(2, c)) / camera.fx;
        homography(1, c) = (homography(1, c) - camera.cy * homography(2, c)) / camera.fy;
    }
    const Scalar share = scalar_of<Scalar>(1) / scalar_of<Scalar>(points.size());
    const auto tilts = poses_of_plane(
        homography, Vector<2, Scalar>(scalar_of<Scalar>(sum_x) * share, scalar_of<Scalar>(sum_y) * share));
    if (!tilts) return tilts.status();

    PlanarPoses<Scalar> found;
    Status status = Status::ok;
    for (const Pose<Scalar>& start : tilts->poses) {
        const Result<PoseFit<Scalar>> fit = refine_pose(points, pixels, camera, start);
        if (!fit) {
            status = fit.status();
            continue;
        }
        if (found.count == 1 && detail::alike(found.fits[0].pose, fit->pose)) continue;
        found.fits[found.count++] = *fit;
    }
    if (found.count == 0) return status;
    if (found.count == 2 && found.fits[1].rms < found.fits[0].rms) {
        const PoseFit<Scalar> kept = found.fits[0];
        found.fits[0] = found.fits[1];
        found.fits[1] = kept;
    }
    return found;
}

}  // namespace fovea
