// SPDX-License-Identifier: MIT
//
// The camera: pinhole with a lens that distorts. Book sec. 2.2.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What a camera is by itself. Without distortion it is the pinhole.
///
/// Units   fx, fy and the principal point (cx, cy) in pixels, whose centres are whole; the lens in terms of
///         coordinates at distance 1: radial k1, k2, k3 with r^2, r^4, r^6, tangential p1, p2
/// Source  book eq. 2.1 to 2.9; Brown, "Decentering distortion of lenses", Photogrammetric Engineering 32(3),
///         1966. The toolkit's d1, d2, d3, d4 are k1, k2, p1, p2
template <class Scalar = Real>
struct Camera {
    Scalar fx = scalar_of<Scalar>(1);
    Scalar fy = scalar_of<Scalar>(1);
    Scalar cx = scalar_of<Scalar>(0);
    Scalar cy = scalar_of<Scalar>(0);
    Scalar k1 = scalar_of<Scalar>(0);
    Scalar k2 = scalar_of<Scalar>(0);
    Scalar k3 = scalar_of<Scalar>(0);
    Scalar p1 = scalar_of<Scalar>(0);
    Scalar p2 = scalar_of<Scalar>(0);
};

/// Where the lens puts a point at distance 1: (x, y) r + tangential part.
///
/// Source  book eq. 2.8 and 2.9
template <class Scalar>
constexpr Vector<2, Scalar> distort(const Camera<Scalar>& camera, const Vector<2, Scalar>& point);

/// The pixel of a point at distance 1, and back; the lens is not part of it. Back, focal lengths are not 0.
template <class Scalar>
constexpr Vector<2, Scalar> pixel_of(const Camera<Scalar>& camera, const Vector<2, Scalar>& point) {
    return Vector<2, Scalar>(camera.fx * point[0] + camera.cx, camera.fy * point[1] + camera.cy);
}
template <class Scalar>
constexpr Vector<2, Scalar> point_of(const Camera<Scalar>& camera, const Vector<2, Scalar>& pixel) {
    return Vector<2, Scalar>((pixel[0] - camera.cx) / camera.fx, (pixel[1] - camera.cy) / camera.fy);
}

/// The pixel in which the camera sees a point in camera coordinates.
///
/// Errors  out_of_range for a point in the plane of the camera or behind it
/// Source  book eq. 2.1 to 2.9
template <class Scalar>
constexpr Result<Vector<2, Scalar>> project(const Camera<Scalar>& camera, const Vector<3, Scalar>& point);

/// The same for a point in world coordinates.
template <class Scalar>
constexpr Result<Vector<2, Scalar>> project(const Camera<Scalar>& camera, const Pose<Scalar>& pose,
                                            const Vector<3, Scalar>& world) {
    return project(camera, pose(world));
}

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr Vector<2, Scalar> distort(const Camera<Scalar>& camera, const Vector<2, Scalar>& point) {
    const Scalar x = point[0];
    const Scalar y = point[1];
    const Scalar xx = x * x;
    const Scalar yy = y * y;
    const Scalar xy = scale(x * y, 1);
    const Scalar square = xx + yy;
    const Scalar radial =
        scalar_of<Scalar>(1) + square * (camera.k1 + square * (camera.k2 + square * camera.k3));
    return Vector<2, Scalar>(x * radial + camera.p1 * xy + camera.p2 * (square + scale(xx, 1)),
                             y * radial + camera.p1 * (square + scale(yy, 1)) + camera.p2 * xy);
}

template <class Scalar>
constexpr Result<Vector<2, Scalar>> project(const Camera<Scalar>& camera, const Vector<3, Scalar>& point) {
    if (!(scalar_of<Scalar>(0) < point[2])) return Status::out_of_range;
    const Scalar share = scalar_of<Scalar>(1) / point[2];
    return pixel_of(camera, distort(camera, Vector<2, Scalar>(point[0] * share, point[1] * share)));
}

}  // namespace fovea
