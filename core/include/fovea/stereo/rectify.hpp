// SPDX-License-Identifier: MIT
//
// Two calibrated cameras turned so that what one sees in a row, the other sees in the same row. Book sec.
// 2.10.3.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/linear/svd.hpp>
#include <fovea/number/scalar.hpp>
#include <fovea/stereo/rectified_view.hpp>
#include <fovea/stereo/stereo_camera.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Along which axis of the images the cameras stand beside each other.
enum class StereoAxis : std::uint8_t {
    x,  ///< side by side: what is seen in a row stays in it
    y,  ///< one above the other: columns in place of rows
};

struct RectifyOptions {
    enum class Method : std::uint8_t {
        bouguet,   ///< both cameras turn by half of what lies between them, then onto the baseline
        fusiello,  ///< the view keeps as much of the left camera's direction as the baseline allows
    };
    enum class Zoom : std::uint8_t {
        focal_length,  ///< that of the cameras, whatever falls out of the pictures
        valid,         ///< every pixel of both new pictures has been seen
        all,           ///< every pixel that was seen is in the new pictures
    };
    Method method = Method::bouguet;
    Zoom zoom = Zoom::focal_length;
    Size new_size;  ///< of the rectified pictures; empty: that of the cameras'
};

/// What makes a rectified pair of the pictures of two cameras.
template <class Scalar = Real>
struct Rectification {
    Matrix<3, 3, Scalar> left;   ///< rotates left camera coordinates to rectified ones
    Matrix<3, 3, Scalar> right;  ///< the same for the right camera
    Camera<Scalar> camera;       ///< of both new pictures; it has no lens
    Size size;                   ///< of both
    StereoAxis axis = StereoAxis::x;
    Scalar baseline;  ///< where the right camera stands along the axis, seen from the left one

    /// The rectified pair, as two cameras.
    constexpr StereoCamera<Scalar> cameras() const {
        StereoCamera<Scalar> pair{camera, camera, Pose<Scalar>()};
        pair.right_from_left.translation[axis == StereoAxis::x ? 0 : 1] = -baseline;
        return pair;
    }
    /// Q, which takes (u, v, disparity, 1) of the left picture to a place times its last coordinate. The
    /// disparity is u of the left less u of the right picture, or v for cameras above each other.
    constexpr Matrix<4, 4, Scalar> depth_matrix() const;
    /// The place in rectified left coordinates that is seen at a pixel of the left picture with a disparity.
    ///
    /// Errors  out_of_range for a disparity whose sign is not that of the baseline, or 0: behind or at
    ///         infinity
    constexpr Result<Vector<3, Scalar>> place(const Vector<2, Scalar>& pixel, const Scalar& disparity) const;
};

/// Rectifies a pair of cameras with pictures of a size.
///
/// Range     where the border of a picture is outside of the field of its lens, or would be behind the new
///           picture, it is drawn in toward the middle: what is not seen does not count
/// Rounding  rotations are square to 2^-58; zoom to 1/20 px at the border, for lenses that bend the border by
///           up to a tenth of its length: 64 places of a side are looked at, with straight lines between them
/// Errors    empty_image; image_too_large; bad_argument for focal lengths that are not above 0 or a rotation that
///           is none to 2^-16; degenerate for cameras at one place, one before the other, or turned by half a
///           turn; out_of_range where nothing between the middle of a picture and its border can be seen in
///           the new one, or, for a zoom, the middle of the new picture is not seen
/// Source    Bouguet's method as in his Camera Calibration Toolbox, with the half turn by quaternions, and the
///           new camera as there for common principal points; Fusiello, Trucco and Verri, "A compact algorithm
///           for rectification of stereo pairs", Machine Vision and Applications 12, 2000. Zooms are
///           those of the border's pixels, not of the rectangles in and around them
template <class Scalar>
constexpr Result<Rectification<Scalar>> rectify(const StereoCamera<Scalar>& cameras, Size size,
                                                const RectifyOptions& options = {});

/// Where a pixel of a rectified picture was before it, without lens: K R^T K'^-1.
///
/// Errors  bad_argument for a new camera without focal lengths
/// Source  book sec. 2.10.3
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> rectifying_homography(const Camera<Scalar>& camera,
                                                             const Matrix<3, 3, Scalar>& rotation,
                                                             const Camera<Scalar>& rectified);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The rotation that is a given one if done twice.
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> half_rotation(const Matrix<3, 3, Scalar>& r) {
    const Scalar one = scalar_of<Scalar>(1);
    // Four times the square of the cosine of half the angle.
    const Scalar square = one + r(0, 0) + r(1, 1) + r(2, 2);
    if (!(scalar_of<Scalar>(1, -20) < square)) return Status::degenerate;
    const Scalar twice_cosine = square_root(square);
    // The quaternion's vector, divided by 1 + its first element, is the axis times the tangent of a quarter.
    const Scalar share = one / (twice_cosine * (one + scale(twice_cosine, -1)));
    return rotation_about(Vector<3, Scalar>((r(2, 1) - r(1, 2)) * share, (r(0, 2) - r(2, 0)) * share,
                                            (r(1, 0) - r(0, 1)) * share));
}

/// The shortest rotation from one direction of length 1 to another, which is not opposite.
template <class Scalar>
constexpr Matrix<3, 3, Scalar> rotation_between(const Vector<3, Scalar>& from, const Vector<3, Scalar>& to) {
    const Scalar share = scalar_of<Scalar>(2) / (scalar_of<Scalar>(1) + dot(from, to));
    return rotation_about(cross(from, to) * share);
}

template <class Scalar>
constexpr Matrix<3, 3, Scalar> of_rows(const Vector<3, Scalar>& x, const Vector<3, Scalar>& y,
                                       const Vector<3, Scalar>& z) {
    Matrix<3, 3, Scalar> result;
    for (int c = 0; c < 3; ++c) {
        result(0, c) = x[c];
        result(1, c) = y[c];
        result(2, c) = z[c];
    }
    return result;
}

/// The axis along which a baseline runs; degenerate if that is forward.
template <class Scalar>
constexpr Result<StereoAxis> axis_of(const Vector<3, Scalar>& baseline) {
    const Scalar x = absolute(baseline[0]);
    const Scalar y = absolute(baseline[1]);
    const Scalar z = absolute(baseline[2]);
    if (!(z < x) && !(z < y)) return Status::degenerate;
    return x < y ? StereoAxis::y : StereoAxis::x;
}

template <class Scalar>
constexpr Status turn_bouguet(const Pose<Scalar>& pose, Rectification<Scalar>& found) {
    const Result<Matrix<3, 3, Scalar>> half = half_rotation(pose.rotation);
    if (!half) return half.status();
    const Matrix<3, 3, Scalar> back = half->transposed();
    const Result<Vector<3, Scalar>> way = normalized(back * pose.translation);
    if (!way) return way.status();
    const Result<StereoAxis> axis = axis_of(*way);
    if (!axis) return axis.status();
    const int side = *axis == StereoAxis::x ? 0 : 1;
    Vector<3, Scalar> onto;
    onto[side] = scalar_of<Scalar>((*way)[side] < scalar_of<Scalar>(0) ? -1 : 1);
    const Matrix<3, 3, Scalar> turn = rotation_between(*way, onto);
    found.axis = *axis;
    found.left = turn * *half;
    found.right = turn * back;
    return Status::ok;
}

template <class Scalar>
constexpr Status turn_fusiello(const Pose<Scalar>& pose, Rectification<Scalar>& found) {
    const Result<Vector<3, Scalar>> way = normalized(inverse(pose).translation);
    if (!way) return way.status();
    const Result<StereoAxis> axis = axis_of(*way);
    if (!axis) return axis.status();
    const int side = *axis == StereoAxis::x ? 0 : 1;
    const Vector<3, Scalar> along = (*way)[side] < scalar_of<Scalar>(0) ? -*way : *way;
    Vector<3, Scalar> forward;
    forward[2] = scalar_of<Scalar>(1);
    const Result<Vector<3, Scalar>> across =
        normalized(side == 0 ? cross(forward, along) : cross(along, forward));
    if (!across) return across.status();
    found.axis = *axis;
    found.left = side == 0 ? of_rows(along, *across, cross(along, *across))
                           : of_rows(*across, along, cross(*across, along));
    found.right = found.left * pose.rotation.transposed();
    return Status::ok;
}

template <class Scalar>
constexpr Status zoom(const StereoCamera<Scalar>& cameras, const LensInverse<Scalar>& left,
                      const LensInverse<Scalar>& right, Size size, bool valid, Rectification<Scalar>& found) {
    Camera<Scalar>& camera = found.camera;
    const Scalar zero = scalar_of<Scalar>(0);
    NewPicture<Scalar> picture;
    picture.least = Vector<2, Scalar>(-camera.cx, -camera.cy);
    picture.most = Vector<2, Scalar>(scalar_of<Scalar>(found.size.width - 1) - camera.cx,
                                     scalar_of<Scalar>(found.size.height - 1) - camera.cy);
    for (int side = 0; side < 2; ++side)
        if (!(picture.least[side] < zero) || !(zero < picture.most[side])) return Status::out_of_range;
    if (!sees_middle(cameras.left, found.left, size) || !sees_middle(cameras.right, found.right, size))
        return Status::out_of_range;
    Scalar least = zero;
    Scalar most = zero;
    Status status = add_border(left, found.left, size, picture, least, most);
    if (status == Status::ok) status = add_border(right, found.right, size, picture, least, most);
    if (status != Status::ok) return status;
    camera.fx = camera.fy = valid ? most : least;
    return camera.fx == zero ? Status::out_of_range : Status::ok;
}

/// Mean place of the corners of both pictures, at distance 1.
template <class Scalar>
constexpr Result<Vector<2, Scalar>> mean_of_corners(const LensInverse<Scalar>& left,
                                                    const LensInverse<Scalar>& right, Size size,
                                                    const Rectification<Scalar>& found) {
    Vector<2, Scalar> sum;
    for (int i = 0; i < 8; ++i) {
        const int corner = i % 4 * 64;
        const Result<Vector<2, Scalar>> place = i < 4 ? turned_border(left, found.left, size, corner)
                                                      : turned_border(right, found.right, size, corner);
        if (!place) return place;
        sum += *place;
    }
    return sum * scalar_of<Scalar>(1, -3);
}

template <class Scalar>
constexpr Status check_rectify(const StereoCamera<Scalar>& cameras, Size size, Size new_size) {
    if (size.empty()) return Status::empty_image;
    if (size.width > max_image_side || size.height > max_image_side || new_size.width > max_image_side ||
        new_size.height > max_image_side)
        return Status::image_too_large;
    const Scalar zero = scalar_of<Scalar>(0);
    if (!(zero < cameras.left.fx) || !(zero < cameras.left.fy) || !(zero < cameras.right.fx) ||
        !(zero < cameras.right.fy))
        return Status::bad_argument;
    return Status::ok;
}

/// The pose with a rotation that is square to all digits; bad_argument if it was none.
template <class Scalar>
constexpr Result<Pose<Scalar>> square_pose(const Pose<Scalar>& pose) {
    const Result<Matrix<3, 3, Scalar>> rotation = nearest_rotation(pose.rotation);
    if (!rotation) return Status::bad_argument;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            if (scalar_of<Scalar>(1, -16) < absolute((*rotation)(r, c) - pose.rotation(r, c)))
                return Status::bad_argument;
    return Pose<Scalar>{*rotation, pose.translation};
}

}  // namespace detail

template <class Scalar>
constexpr Matrix<4, 4, Scalar> Rectification<Scalar>::depth_matrix() const {
    Matrix<4, 4, Scalar> q;
    q(0, 0) = q(1, 1) = scalar_of<Scalar>(1);
    q(0, 3) = -camera.cx;
    q(1, 3) = -camera.cy;
    q(2, 3) = camera.fx;
    q(3, 2) = scalar_of<Scalar>(1) / baseline;
    return q;
}

template <class Scalar>
constexpr Result<Vector<3, Scalar>> Rectification<Scalar>::place(const Vector<2, Scalar>& pixel,
                                                                 const Scalar& disparity) const {
    if (disparity == scalar_of<Scalar>(0)) return Status::out_of_range;
    const Scalar share = baseline / disparity;
    if (!(scalar_of<Scalar>(0) < share)) return Status::out_of_range;
    return Vector<3, Scalar>((pixel[0] - camera.cx) * share, (pixel[1] - camera.cy) * share,
                             camera.fx * share);
}

template <class Scalar>
constexpr Result<Rectification<Scalar>> rectify(const StereoCamera<Scalar>& cameras, Size size,
                                                const RectifyOptions& options) {
    Status status = detail::check_rectify(cameras, size, options.new_size);
    if (status != Status::ok) return status;
    const Result<Pose<Scalar>> pose = detail::square_pose(cameras.right_from_left);
    if (!pose) return pose.status();
    Rectification<Scalar> found;
    found.size = options.new_size.empty() ? size : options.new_size;
    status = options.method == RectifyOptions::Method::bouguet ? detail::turn_bouguet(*pose, found)
                                                               : detail::turn_fusiello(*pose, found);
    if (status != Status::ok) return status;
    const bool x = found.axis == StereoAxis::x;
    found.baseline = -(found.right * pose->translation)[x ? 0 : 1];

    // The mean focal length across the axis, in which rows must agree, for pictures of another size.
    const Scalar sum = x ? cameras.left.fy + cameras.right.fy : cameras.left.fx + cameras.right.fx;
    const Scalar old_length = scalar_of<Scalar>(x ? size.height : size.width);
    const Scalar new_length = scalar_of<Scalar>(x ? found.size.height : found.size.width);
    Camera<Scalar>& camera = found.camera;
    camera.fx = camera.fy = scale(sum, -1) * new_length / old_length;
    const LensInverse<Scalar> left(cameras.left);
    const LensInverse<Scalar> right(cameras.right);
    const Result<Vector<2, Scalar>> mean = detail::mean_of_corners(left, right, size, found);
    if (!mean) return mean.status();
    camera.cx = scalar_of<Scalar>(found.size.width - 1, -1) - camera.fx * (*mean)[0];
    camera.cy = scalar_of<Scalar>(found.size.height - 1, -1) - camera.fy * (*mean)[1];
    if (options.zoom != RectifyOptions::Zoom::focal_length) {
        status = detail::zoom(cameras, left, right, size, options.zoom == RectifyOptions::Zoom::valid, found);
        if (status != Status::ok) return status;
    }
    return found;
}

template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> rectifying_homography(const Camera<Scalar>& camera,
                                                             const Matrix<3, 3, Scalar>& rotation,
                                                             const Camera<Scalar>& rectified) {
    const Scalar zero = scalar_of<Scalar>(0);
    if (rectified.fx == zero || rectified.fy == zero) return Status::bad_argument;
    Matrix<3, 3, Scalar> h = rotation.transposed();
    for (int r = 0; r < 3; ++r) {
        h(r, 0) = h(r, 0) / rectified.fx;
        h(r, 1) = h(r, 1) / rectified.fy;
        h(r, 2) = h(r, 2) - h(r, 0) * rectified.cx - h(r, 1) * rectified.cy;
    }
    for (int c = 0; c < 3; ++c) {
        h(0, c) = camera.fx * h(0, c) + camera.cx * h(2, c);
        h(1, c) = camera.fy * h(1, c) + camera.cy * h(2, c);
    }
    return h;
}

}  // namespace fovea
