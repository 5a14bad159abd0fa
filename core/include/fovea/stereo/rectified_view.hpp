// SPDX-License-Identifier: MIT
//
// What a turned camera sees in its new picture: rectify() asks where the border of the old one comes to lie.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea::detail {

/// Where a pixel is seen at distance 1 after a rotation.
template <class Scalar>
constexpr Result<Vector<2, Scalar>> turned_place(const LensInverse<Scalar>& lens,
                                                 const Matrix<3, 3, Scalar>& rotation,
                                                 const Vector<2, Scalar>& pixel) {
    const Result<Vector<3, Scalar>> ray = lens.ray(pixel);
    if (!ray) return ray.status();
    const Vector<3, Scalar> turned = rotation * *ray;
    // A direction within a degree of the new picture's plane is as good as behind it.
    if (!(scalar_of<Scalar>(1, -6) < turned[2])) return Status::out_of_range;
    return Vector<2, Scalar>(turned[0] / turned[2], turned[1] / turned[2]);
}

/// A place of the border of a picture: 64 to a side, clockwise from (0, 0).
template <class Scalar>
constexpr Vector<2, Scalar> border_pixel(Size size, int index) {
    const int side = index / 64 % 4;
    const int step = index % 64;
    const auto part = [&](int length, int steps) {
        return scalar_of<Scalar>(std::int64_t{length - 1} * steps, -6);
    };
    if (side == 0) return Vector<2, Scalar>(part(size.width, step), scalar_of<Scalar>(0));
    if (side == 1) return Vector<2, Scalar>(part(size.width, 64), part(size.height, step));
    if (side == 2) return Vector<2, Scalar>(part(size.width, 64 - step), part(size.height, 64));
    return Vector<2, Scalar>(scalar_of<Scalar>(0), part(size.height, 64 - step));
}

/// turned_place() of a pixel of the border. If it is not seen, that of one on the way to the middle of the
/// picture which is, and from which 1/32 of the way on there is one that is not.
template <class Scalar>
constexpr Result<Vector<2, Scalar>> turned_border(const LensInverse<Scalar>& lens,
                                                  const Matrix<3, 3, Scalar>& rotation, Size size,
                                                  int index) {
    const Vector<2, Scalar> pixel = border_pixel<Scalar>(size, index);
    Result<Vector<2, Scalar>> found = turned_place(lens, rotation, pixel);
    if (found) return found;
    const Vector<2, Scalar> middle(scalar_of<Scalar>(size.width - 1, -1),
                                   scalar_of<Scalar>(size.height - 1, -1));
    int seen = 0;
    for (int stride = 16; stride > 0; stride /= 2) {
        const Result<Vector<2, Scalar>> nearer =
            turned_place(lens, rotation, middle + (pixel - middle) * scalar_of<Scalar>(seen + stride, -5));
        if (!nearer) continue;
        seen += stride;
        found = nearer;
    }
    return found;
}

/// A new picture, whose focal length is looked for: its corners as seen from the principal point.
template <class Scalar>
struct NewPicture {
    Vector<2, Scalar> least;  ///< of the corner (0, 0): both below 0
    Vector<2, Scalar> most;   ///< of the opposite one: both above

    /// The focal length that puts a place on the edge of the picture; 0 for the place in the middle, which
    /// none does.
    constexpr Scalar focal_length(const Vector<2, Scalar>& place) const {
        const Scalar zero = scalar_of<Scalar>(0);
        Scalar least_length = zero;
        for (int side = 0; side < 2; ++side) {
            if (place[side] == zero) continue;
            const Scalar length = (place[side] < zero ? least[side] : most[side]) / place[side];
            if (least_length == zero || length < least_length) least_length = length;
        }
        return least_length;
    }
    constexpr Vector<2, Scalar> corner(int index) const {
        return Vector<2, Scalar>(index % 2 == 0 ? least[0] : most[0], index / 2 == 0 ? least[1] : most[1]);
    }
};

/// Least and most focal lengths that put a place of a border on the edge of the new picture, taken together
/// with what there is already. The corners of the new picture are looked for between the border's places.
template <class Scalar>
constexpr Status add_border(const LensInverse<Scalar>& lens, const Matrix<3, 3, Scalar>& rotation, Size size,
                            const NewPicture<Scalar>& picture, Scalar& least, Scalar& most) {
    const Scalar zero = scalar_of<Scalar>(0);
    Vector<2, Scalar> last;
    for (int i = 0; i <= 256; ++i) {
        const Result<Vector<2, Scalar>> place = turned_border(lens, rotation, size, i);
        if (!place) return place.status();
        const auto take = [&](const Vector<2, Scalar>& at) {
            const Scalar length = picture.focal_length(at);
            if (least == zero || length < least) least = length;
            if (most < length) most = length;
        };
        take(*place);
        for (int k = 0; k < 4 && i > 0; ++k) {
            const Vector<2, Scalar> corner = picture.corner(k);
            const Scalar before = corner[0] * last[1] - corner[1] * last[0];
            const Scalar after = corner[0] * (*place)[1] - corner[1] * (*place)[0];
            if ((before < zero) == (after < zero)) continue;
            const Vector<2, Scalar> between = last + (*place - last) * (before / (before - after));
            if (zero < dot(between, corner)) take(between);
        }
        last = *place;
    }
    return Status::ok;
}

/// Whether a camera sees the direction straight ahead of the new picture.
template <class Scalar>
constexpr bool sees_middle(const Camera<Scalar>& camera, const Matrix<3, 3, Scalar>& rotation, Size size) {
    const Result<Vector<2, Scalar>> seen = project(camera, rotation.row(2));
    const Scalar zero = scalar_of<Scalar>(0);
    return seen && !((*seen)[0] < zero) && !((*seen)[1] < zero) &&
           !(scalar_of<Scalar>(size.width - 1) < (*seen)[0]) &&
           !(scalar_of<Scalar>(size.height - 1) < (*seen)[1]);
}

}  // namespace fovea::detail
