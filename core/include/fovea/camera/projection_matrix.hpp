// SPDX-License-Identifier: MIT
//
// The projection matrix of a pinhole: camera and pose in one, taken apart, and the ray of a pixel. Book sec.
// 2.2.3.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A camera and where the world stands before it.
template <class Scalar = Real>
struct CameraView {
    Camera<Scalar> camera;
    Pose<Scalar> pose;
    /// The cosine of the angle between the axes of the pixels, which a camera has square: how far a matrix
    /// that was fitted is from a camera's.
    Scalar skew = scalar_of<Scalar>(0);
};

/// A straight way through the world: point + s direction.
template <class Scalar = Real>
struct Ray {
    Vector<3, Scalar> point;
    Vector<3, Scalar> direction;
};

/// K (R | t): pixels are (p0, p1) / p2 of the product with (x, y, z, 1), and p2 is the distance from the
/// plane of the camera. The lens is not part of it.
///
/// Source  book eq. 2.10 to 2.12
template <class Scalar>
constexpr Matrix<3, 4, Scalar> projection_matrix(const Camera<Scalar>& camera, const Pose<Scalar>& pose);

/// The pixel in which a point of the world is seen.
///
/// Errors  out_of_range for a point in the plane of the camera or behind it
template <class Scalar>
constexpr Result<Vector<2, Scalar>> project(const Matrix<3, 4, Scalar>& projection,
                                            const Vector<3, Scalar>& world);

/// The camera and the pose of a projection matrix, whatever its factor above 0.
///
/// Rounding  the rotation is square to 2^-60 and does not mirror
/// Errors    degenerate where the first three columns have no inverse; irregular where the matrix is that of
///           a mirrored camera, which no fx and fy above 0 make
/// Source    book eq. 2.21 and 2.22, with fx = |q1 - cx q3| / |q3| in place of a root of a difference. The
///           book's rows r1 and r2 are square only without skew: here they are the nearest two that are, and
///           the translation is the one that keeps the centre of the camera
template <class Scalar>
constexpr Result<CameraView<Scalar>> decompose(const Matrix<3, 4, Scalar>& projection);

/// All points of the world that are seen in a pixel: a point whose coordinate along the direction's largest
/// is 0, and the direction at length 1, away from the camera.
///
/// Errors  degenerate where the first three columns have no inverse
/// Source  book eq. 2.16 to 2.20, which take z as the parameter and divide by a and r, that may be 0: here
///         the parameter is the coordinate in which the ray runs fastest, and the only divisor is that part
///         of the direction
template <class Scalar>
constexpr Result<Ray<Scalar>> ray_of(const Matrix<3, 4, Scalar>& projection, const Vector<2, Scalar>& pixel);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The first three elements of a row.
template <class Scalar>
constexpr Vector<3, Scalar> head_of_row(const Matrix<3, 4, Scalar>& a, int row) {
    return Vector<3, Scalar>(a(row, 0), a(row, 1), a(row, 2));
}

}  // namespace detail

template <class Scalar>
constexpr Matrix<3, 4, Scalar> projection_matrix(const Camera<Scalar>& camera, const Pose<Scalar>& pose) {
    Matrix<3, 4, Scalar> result;
    for (int c = 0; c < 4; ++c) {
        const auto element = [&](int r) { return c < 3 ? pose.rotation(r, c) : pose.translation[r]; };
        result(0, c) = camera.fx * element(0) + camera.cx * element(2);
        result(1, c) = camera.fy * element(1) + camera.cy * element(2);
        result(2, c) = element(2);
    }
    return result;
}

template <class Scalar>
constexpr Result<Vector<2, Scalar>> project(const Matrix<3, 4, Scalar>& projection,
                                            const Vector<3, Scalar>& world) {
    Scalar image[3] = {};
    for (int r = 0; r < 3; ++r) image[r] = dot(detail::head_of_row(projection, r), world) + projection(r, 3);
    if (!(scalar_of<Scalar>(0) < image[2])) return Status::out_of_range;
    return Vector<2, Scalar>(image[0] / image[2], image[1] / image[2]);
}

template <class Scalar>
constexpr Result<CameraView<Scalar>> decompose(const Matrix<3, 4, Scalar>& projection) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar one = scalar_of<Scalar>(1);
    const Vector<3, Scalar> q1 = detail::head_of_row(projection, 0);
    const Vector<3, Scalar> q2 = detail::head_of_row(projection, 1);
    const Vector<3, Scalar> q3 = detail::head_of_row(projection, 2);
    const Scalar square = dot(q3, q3);
    if (!(zero < square)) return Status::degenerate;
    CameraView<Scalar> view;
    Camera<Scalar>& camera = view.camera;
    camera.cx = dot(q1, q3) / square;
    camera.cy = dot(q2, q3) / square;
    const Scalar share = one / square_root(square);
    const Vector<3, Scalar> across = (q1 - camera.cx * q3) * share;
    const Vector<3, Scalar> down = (q2 - camera.cy * q3) * share;
    camera.fx = length_of(across);
    camera.fy = length_of(down);
    if (!(zero < camera.fx && zero < camera.fy)) return Status::degenerate;
    const Vector<3, Scalar> r1 = across * (one / camera.fx);
    const Vector<3, Scalar> r2 = down * (one / camera.fy);
    // Half of the skew is taken off both rows, by the two directions between them.
    const auto sum = normalized(r1 + r2);
    const auto difference = normalized(r1 - r2);
    if (!sum || !difference) return Status::degenerate;
    const Vector<3, Scalar> third = cross(*sum, *difference);
    // Twice the area between r1 and r2 is that of the sum and the difference, turned the other way.
    const Scalar side = dot(third, q3);
    if (!(side < zero || zero < side)) return Status::degenerate;
    if (zero < side) return Status::irregular;
    view.skew = dot(r1, r2);
    const Scalar half = square_root(scalar_of<Scalar>(1, -1));
    Matrix<3, 3, Scalar>& rotation = view.pose.rotation;
    for (int c = 0; c < 3; ++c) {
        rotation(0, c) = ((*sum)[c] + (*difference)[c]) * half;
        rotation(1, c) = ((*sum)[c] - (*difference)[c]) * half;
    }
    const Vector<3, Scalar> axis = cross(rotation.row(0), rotation.row(1));
    for (int c = 0; c < 3; ++c) rotation(2, c) = axis[c];

    Matrix<3, 3, Scalar> left;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) left(r, c) = projection(r, c);
    const auto back = inverse(left);
    if (!back) return back.status();
    view.pose.translation = rotation * (*back * projection.column(3));
    return view;
}

template <class Scalar>
constexpr Result<Ray<Scalar>> ray_of(const Matrix<3, 4, Scalar>& projection, const Vector<2, Scalar>& pixel) {
    const Scalar zero = scalar_of<Scalar>(0);
    const Vector<3, Scalar> axis = detail::head_of_row(projection, 2);
    // Two planes through the camera: left x = -left_end, and the same of top.
    const Vector<3, Scalar> left = detail::head_of_row(projection, 0) - pixel[0] * axis;
    const Vector<3, Scalar> top = detail::head_of_row(projection, 1) - pixel[1] * axis;
    const Scalar left_end = projection(0, 3) - pixel[0] * projection(2, 3);
    const Scalar top_end = projection(1, 3) - pixel[1] * projection(2, 3);
    const Vector<3, Scalar> along = cross(left, top);
    int pivot = 0;
    for (int i = 1; i < 3; ++i)
        if (absolute(along[pivot]) < absolute(along[i])) pivot = i;
    const Scalar ahead = dot(along, axis);
    if (!(ahead < zero || zero < ahead)) return Status::degenerate;
    const int i = (pivot + 1) % 3;
    const int k = (pivot + 2) % 3;
    Ray<Scalar> ray;
    ray.point[i] = (top_end * left[k] - left_end * top[k]) / along[pivot];
    ray.point[k] = (left_end * top[i] - top_end * left[i]) / along[pivot];
    const Scalar share = scalar_of<Scalar>(1) / length_of(along);
    ray.direction = along * (ahead < zero ? -share : share);
    return ray;
}

}  // namespace fovea
