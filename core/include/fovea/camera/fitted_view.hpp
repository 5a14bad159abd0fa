// SPDX-License-Identifier: MIT
//
// Views: which pinhole shows what a camera saw. Undistorted, an image is no rectangle any more; a view keeps
// all of it, or as much as leaves no pixel empty. Book sec. 2.10.3.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A rectangle at distance 1 before a camera.
template <class Scalar = Real>
struct ViewBounds {
    Scalar left{};
    Scalar top{};
    Scalar right{};
    Scalar bottom{};
};

/// What of a camera's image can be seen after a rotation: inner is all image, outer holds all of the image.
/// Where a side bends outwards, inner keeps to its ends, and could be a few pixels larger.
template <class Scalar = Real>
struct VisibleBounds {
    ViewBounds<Scalar> inner;
    ViewBounds<Scalar> outer;
};

/// Looks along the border of an image where its pixels come from.
///
/// Shapes    image 2x2 to 32767x32767
/// Units     rotation as for undistortion_map()
/// Rounding  64 places a side are looked at: between two of them a border may bend by a part of a pixel, for
///           which the half pixel that belongs to an image beyond its last centres has room
/// Errors    empty_image, image_too_large; bad_argument as undistortion_map(); out_of_range where the lens's
///           field ends inside of the image, or a part of the image is not in front of the view
/// Source    the idea of OpenCV's getOptimalNewCameraMatrix(), with rotation
template <class Scalar>
constexpr Result<VisibleBounds<Scalar>> visible_bounds(const LensInverse<Scalar>& lens,
                                                       const Matrix<3, 3, Scalar>& rotation, Size image);

/// The view with the camera's ratio of focal lengths that holds bounds exactly on two sides: within it are no
/// others (fill), or all of them (hold). They are in the middle of it.
///
/// Shapes  output 2x2 to 32767x32767
/// Errors  empty_image, image_too_large; bad_argument for focal lengths not above 0; degenerate for bounds
///         without a side
/// Source  one scale for both axes, so that angles stay
template <class Scalar>
constexpr Result<Camera<Scalar>> view_that_fills(const ViewBounds<Scalar>& bounds,
                                                 const Camera<Scalar>& camera, Size output);
template <class Scalar>
constexpr Result<Camera<Scalar>> view_that_holds(const ViewBounds<Scalar>& bounds,
                                                 const Camera<Scalar>& camera, Size output);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr Status check_view_size(Size size) {
    if (size.width < 2 || size.height < 2) return Status::empty_image;
    return size.width > max_image_side || size.height > max_image_side ? Status::image_too_large : Status::ok;
}

template <class Scalar>
constexpr Result<Camera<Scalar>> view_of_bounds(const ViewBounds<Scalar>& bounds,
                                                const Camera<Scalar>& camera, Size output, bool hold) {
    const Scalar zero = scalar_of<Scalar>(0);
    if (Status s = check_view_size(output); s != Status::ok) return s;
    if (!(zero < camera.fx && zero < camera.fy)) return Status::bad_argument;
    const Scalar width = bounds.right - bounds.left;
    const Scalar height = bounds.bottom - bounds.top;
    if (!(zero < width && zero < height)) return Status::degenerate;
    const Scalar across = scalar_of<Scalar>(output.width - 1);
    const Scalar down = scalar_of<Scalar>(output.height - 1);
    const Scalar by_width = across / (camera.fx * width);
    const Scalar by_height = down / (camera.fy * height);
    const Scalar zoom = (by_width < by_height) == hold ? by_width : by_height;
    Camera<Scalar> view;
    view.fx = camera.fx * zoom;
    view.fy = camera.fy * zoom;
    view.cx = scale(across - view.fx * (bounds.left + bounds.right), -1);
    view.cy = scale(down - view.fy * (bounds.top + bounds.bottom), -1);
    return view;
}

}  // namespace detail

template <class Scalar>
constexpr Result<VisibleBounds<Scalar>> visible_bounds(const LensInverse<Scalar>& lens,
                                                       const Matrix<3, 3, Scalar>& rotation, Size image) {
    const Scalar zero = scalar_of<Scalar>(0);
    if (Status s = detail::check_view_size(image); s != Status::ok) return s;
    if (!(zero < lens.camera().fx && zero < lens.camera().fy) || !is_rotation(rotation))
        return Status::bad_argument;
    constexpr int places = 64;
    VisibleBounds<Scalar> bounds;
    for (int side = 0; side < 4; ++side)
        for (int i = 0; i <= places; ++i) {
            // Sides: left, right, top, bottom.
            const bool upright = side < 2;
            const int along = (upright ? image.height : image.width) - 1;
            const Scalar moving = scalar_of<Scalar>(std::int64_t{along} * i, -6);
            const int last = side % 2 == 0 ? 0 : (upright ? image.width : image.height) - 1;
            const Scalar still = scalar_of<Scalar>(last);
            const Result<Vector<3, Scalar>> ray =
                lens.ray(upright ? Vector<2, Scalar>(still, moving) : Vector<2, Scalar>(moving, still));
            if (!ray) return ray.status();
            const Vector<3, Scalar> seen = rotation * *ray;
            // To 83 degrees off the axis, as far as the lens's field may reach.
            if (!(scalar_of<Scalar>(1, -3) * length_of(seen) < seen[2])) return Status::out_of_range;
            const Scalar x = seen[0] / seen[2];
            const Scalar y = seen[1] / seen[2];
            const bool first = side == 0 && i == 0;
            ViewBounds<Scalar>& outer = bounds.outer;
            if (first || x < outer.left) outer.left = x;
            if (first || outer.right < x) outer.right = x;
            if (first || y < outer.top) outer.top = y;
            if (first || outer.bottom < y) outer.bottom = y;
            ViewBounds<Scalar>& inner = bounds.inner;
            if (side == 0 && (i == 0 || inner.left < x)) inner.left = x;
            if (side == 1 && (i == 0 || x < inner.right)) inner.right = x;
            if (side == 2 && (i == 0 || inner.top < y)) inner.top = y;
            if (side == 3 && (i == 0 || y < inner.bottom)) inner.bottom = y;
        }
    return bounds;
}

template <class Scalar>
constexpr Result<Camera<Scalar>> view_that_fills(const ViewBounds<Scalar>& bounds,
                                                 const Camera<Scalar>& camera, Size output) {
    return detail::view_of_bounds(bounds, camera, output, false);
}
template <class Scalar>
constexpr Result<Camera<Scalar>> view_that_holds(const ViewBounds<Scalar>& bounds,
                                                 const Camera<Scalar>& camera, Size output) {
    return detail::view_of_bounds(bounds, camera, output, true);
}

}  // namespace fovea
