// SPDX-License-Identifier: MIT
//
// How the pixel of a point moves when the camera, or the point, is changed a little.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The terms of a Camera, in its order.
enum class CameraTerm : int { fx, fy, cx, cy, k1, k2, k3, p1, p2 };
inline constexpr int camera_terms = 9;

template <class Scalar>
constexpr Scalar& term_of(Camera<Scalar>& camera, CameraTerm term);
template <class Scalar>
constexpr const Scalar& term_of(const Camera<Scalar>& camera, CameraTerm term);

/// A pixel, and its derivatives. Row 0 is u, row 1 is v.
template <class Scalar = Real>
struct ProjectionDerivatives {
    Vector<2, Scalar> pixel;
    /// By the terms of the camera, in their order.
    Matrix<2, camera_terms, Scalar> by_camera;
    /// By the point in camera coordinates.
    Matrix<2, 3, Scalar> by_point;
};

/// The pixel of a point in camera coordinates, as project() has it, with its derivatives.
///
/// Errors  out_of_range for a point in the plane of the camera or behind it: then result is untouched
/// Source  the derivatives of book eq. 2.1 to 2.9
template <class Scalar>
constexpr Status project_derivatives(const Camera<Scalar>& camera, const Vector<3, Scalar>& point,
                                     ProjectionDerivatives<Scalar>& result);

/// A row by the pose of the point, from the row by the point: by the axis of a rotation_about() in front of
/// the pose's, then by its translation. turned is what the pose's rotation makes of the world's point.
template <class Scalar>
constexpr Vector<6, Scalar> by_pose(const Vector<3, Scalar>& by_point, const Vector<3, Scalar>& turned) {
    const Vector<3, Scalar> by_axis = cross(turned, by_point);
    return Vector<6, Scalar>(by_axis[0], by_axis[1], by_axis[2], by_point[0], by_point[1], by_point[2]);
}

/// A pose after a step of the six unknowns of by_pose().
template <class Scalar>
constexpr Pose<Scalar> moved(const Pose<Scalar>& pose, const Vector<6, Scalar>& step) {
    return {rotation_about(Vector<3, Scalar>(step[0], step[1], step[2])) * pose.rotation,
            pose.translation + Vector<3, Scalar>(step[3], step[4], step[5])};
}

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr const Scalar& term_of(const Camera<Scalar>& camera, CameraTerm term) {
    switch (term) {
        case CameraTerm::fx: return camera.fx;
        case CameraTerm::fy: return camera.fy;
        case CameraTerm::cx: return camera.cx;
        case CameraTerm::cy: return camera.cy;
        case CameraTerm::k1: return camera.k1;
        case CameraTerm::k2: return camera.k2;
        case CameraTerm::k3: return camera.k3;
        case CameraTerm::p1: return camera.p1;
        case CameraTerm::p2: break;
    }
    return camera.p2;
}
template <class Scalar>
constexpr Scalar& term_of(Camera<Scalar>& camera, CameraTerm term) {
    return const_cast<Scalar&>(term_of(static_cast<const Camera<Scalar>&>(camera), term));
}

template <class Scalar>
constexpr Status project_derivatives(const Camera<Scalar>& camera, const Vector<3, Scalar>& point,
                                     ProjectionDerivatives<Scalar>& result) {
    const Scalar one = scalar_of<Scalar>(1);
    const Scalar zero = scalar_of<Scalar>(0);
    if (!(zero < point[2])) return Status::out_of_range;
    const Scalar share = one / point[2];
    const Scalar x = point[0] * share;
    const Scalar y = point[1] * share;
    const Scalar xx = x * x;
    const Scalar yy = y * y;
    const Scalar xy = scale(x * y, 1);
    const Scalar square = xx + yy;
    const Scalar radial = one + square * (camera.k1 + square * (camera.k2 + square * camera.k3));
    const Scalar tilt_x = square + scale(xx, 1);
    const Scalar tilt_y = square + scale(yy, 1);
    const Vector<2, Scalar> place(x * radial + camera.p1 * xy + camera.p2 * tilt_x,
                                  y * radial + camera.p1 * tilt_y + camera.p2 * xy);
    result.pixel = pixel_of(camera, place);

    const Scalar k1_x = camera.fx * x * square;
    const Scalar k1_y = camera.fy * y * square;
    const Scalar k2_x = k1_x * square;
    const Scalar k2_y = k1_y * square;
    result.by_camera = Matrix<2, camera_terms, Scalar>(
        place[0], zero, one, zero, k1_x, k2_x, k2_x * square, camera.fx * xy, camera.fx * tilt_x, zero,
        place[1], zero, one, k1_y, k2_y, k2_y * square, camera.fy * tilt_y, camera.fy * xy);

    // By the point at distance 1; bend is the derivative of the radial factor by the square of the radius.
    const Scalar six = scalar_of<Scalar>(6);
    const Scalar bend =
        camera.k1 + square * (scale(camera.k2, 1) + scalar_of<Scalar>(3) * square * camera.k3);
    const Scalar across = bend * xy + scale(camera.p1 * x + camera.p2 * y, 1);
    const Scalar along_x = radial + scale(bend * xx + camera.p1 * y, 1) + six * camera.p2 * x;
    const Scalar along_y = radial + scale(bend * yy + camera.p2 * x, 1) + six * camera.p1 * y;
    const Scalar u_x = camera.fx * share * along_x;
    const Scalar u_y = camera.fx * share * across;
    const Scalar v_x = camera.fy * share * across;
    const Scalar v_y = camera.fy * share * along_y;
    result.by_point = Matrix<2, 3, Scalar>(u_x, u_y, -(u_x * x + u_y * y), v_x, v_y, -(v_x * x + v_y * y));
    return Status::ok;
}

}  // namespace fovea
