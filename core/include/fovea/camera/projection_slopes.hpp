// SPDX-License-Identifier: MIT
//
// How the pixel of a point changes with camera and pose: what fits of cameras and poses are made of.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A pixel and its slopes.
template <class Scalar = Real>
struct ProjectionSlopes {
    Vector<2, Scalar> pixel;
    /// By fx, fy, cx, cy, k1, k2, k3, p1, p2.
    Matrix<2, 9, Scalar> camera;
    /// By a turn of the world about its origin, as an axis in camera coordinates, and by the translation.
    Matrix<2, 6, Scalar> pose;
};

/// The pixel of a point in world coordinates, and how it changes.
///
/// Errors  out_of_range for a point in the plane of the camera or behind it
/// Source  derivatives of book eq. 2.1 to 2.9
template <class Scalar>
constexpr Result<ProjectionSlopes<Scalar>> project_with_slopes(const Camera<Scalar>& camera,
                                                               const Pose<Scalar>& pose,
                                                               const Vector<3, Scalar>& world);

/// The pose after a small step: a turn about the axis of the first three, then a move by the last three.
template <class Scalar>
constexpr Pose<Scalar> moved(const Pose<Scalar>& pose, const Vector<6, Scalar>& step) {
    return {rotation_about(Vector<3, Scalar>(step[0], step[1], step[2])) * pose.rotation,
            pose.translation + Vector<3, Scalar>(step[3], step[4], step[5])};
}

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr Result<ProjectionSlopes<Scalar>> project_with_slopes(const Camera<Scalar>& camera,
                                                               const Pose<Scalar>& pose,
                                                               const Vector<3, Scalar>& world) {
    const Scalar one = scalar_of<Scalar>(1);
    const Scalar six = scalar_of<Scalar>(6);
    const Vector<3, Scalar> arm = pose.rotation * world;
    const Vector<3, Scalar> point = arm + pose.translation;
    if (!(scalar_of<Scalar>(0) < point[2])) return Status::out_of_range;
    const Scalar share = one / point[2];
    const Scalar x = point[0] * share;
    const Scalar y = point[1] * share;
    const Scalar xx = x * x;
    const Scalar yy = y * y;
    const Scalar xy = scale(x * y, 1);
    const Scalar square = xx + yy;
    const Scalar radial = one + square * (camera.k1 + square * (camera.k2 + square * camera.k3));
    const Scalar x3 = square + scale(xx, 1);
    const Scalar y3 = square + scale(yy, 1);
    const Vector<2, Scalar> seen(x * radial + camera.p1 * xy + camera.p2 * x3,
                                 y * radial + camera.p1 * y3 + camera.p2 * xy);
    ProjectionSlopes<Scalar> slopes;
    slopes.pixel = pixel_of(camera, seen);

    const Scalar fourth = square * square;
    const Scalar powers[3] = {square, fourth, fourth * square};
    for (int r = 0; r < 2; ++r) {
        const Scalar focal = r == 0 ? camera.fx : camera.fy;
        slopes.camera(r, r) = seen[r];
        slopes.camera(r, 2 + r) = one;
        for (int k = 0; k < 3; ++k) slopes.camera(r, 4 + k) = focal * (r == 0 ? x : y) * powers[k];
        slopes.camera(r, 7) = focal * (r == 0 ? xy : y3);
        slopes.camera(r, 8) = focal * (r == 0 ? x3 : xy);
    }

    // Twice the derivative of the radial factor by the square of the radius.
    const Scalar bend =
        scale(camera.k1 + square * (scale(camera.k2, 1) + square * scalar_of<Scalar>(3) * camera.k3), 1);
    const Scalar by_xx = radial + bend * xx + scale(camera.p1 * y, 1) + six * camera.p2 * x;
    const Scalar by_xy = scale(bend * xy, -1) + scale(camera.p1 * x + camera.p2 * y, 1);
    const Scalar by_yy = radial + bend * yy + six * camera.p1 * y + scale(camera.p2 * x, 1);
    for (int r = 0; r < 2; ++r) {
        const Scalar factor = (r == 0 ? camera.fx : camera.fy) * share;
        const Scalar by_x = factor * (r == 0 ? by_xx : by_xy);
        const Scalar by_y = factor * (r == 0 ? by_xy : by_yy);
        const Vector<3, Scalar> by_point(by_x, by_y, -(by_x * x + by_y * y));
        const Vector<3, Scalar> by_turn = cross(arm, by_point);
        for (int k = 0; k < 3; ++k) {
            slopes.pose(r, k) = by_turn[k];
            slopes.pose(r, 3 + k) = by_point[k];
        }
    }
    return slopes;
}

}  // namespace fovea
