// SPDX-License-Identifier: MIT
//
// Poses: where things stand before a camera. Book sec. 2.2.2.
#pragma once

#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The way from world to camera coordinates: rotation x + translation. The camera looks along +z; x and y run
/// as in the image.
///
/// Units   those of the world's coordinates, whatever they are
/// Source  book eq. 2.4
template <class Scalar = Real>
struct Pose {
    Matrix<3, 3, Scalar> rotation = Matrix<3, 3, Scalar>::identity();
    Vector<3, Scalar> translation;

    constexpr Vector<3, Scalar> operator()(const Vector<3, Scalar>& world) const {
        return rotation * world + translation;
    }
};

/// First b, then a.
template <class Scalar>
constexpr Pose<Scalar> compose(const Pose<Scalar>& a, const Pose<Scalar>& b) {
    return {a.rotation * b.rotation, a(b.translation)};
}

/// The way back.
template <class Scalar>
constexpr Pose<Scalar> inverse(const Pose<Scalar>& pose) {
    const Matrix<3, 3, Scalar> back = pose.rotation.transposed();
    return {back, -(back * pose.translation)};
}

/// Whether a matrix is a rotation, to 2^-20 in each product of two of its rows: as from a file.
template <class Scalar>
constexpr bool is_rotation(const Matrix<3, 3, Scalar>& matrix);

/// The rotation about an axis whose length is twice the tangent of half the angle: for small turns, the angle
/// in radians. Every vector gives a rotation; half a turn is out of reach.
///
/// Rounding  square to 2^-60
/// Source    the quaternion (1, axis / 2) at length 1: a quotient in place of sine and cosine; Cayley
template <class Scalar>
constexpr Matrix<3, 3, Scalar> rotation_about(const Vector<3, Scalar>& axis);

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr bool is_rotation(const Matrix<3, 3, Scalar>& matrix) {
    const Matrix<3, 3, Scalar> off = matrix * matrix.transposed() - Matrix<3, 3, Scalar>::identity();
    const Scalar most = scalar_of<Scalar>(1, -20);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            if (!(absolute(off(r, c)) < most)) return false;
    return scalar_of<Scalar>(0) < determinant(matrix);
}

template <class Scalar>
constexpr Matrix<3, 3, Scalar> rotation_about(const Vector<3, Scalar>& axis) {
    const Scalar one = scalar_of<Scalar>(1);
    const Scalar x = scale(axis[0], -1);
    const Scalar y = scale(axis[1], -1);
    const Scalar z = scale(axis[2], -1);
    const Scalar twice = scalar_of<Scalar>(2) / (one + x * x + y * y + z * z);
    return Matrix<3, 3, Scalar>(one - twice * (y * y + z * z), twice * (x * y - z), twice * (x * z + y),
                                twice * (x * y + z), one - twice * (x * x + z * z), twice * (y * z - x),
                                twice * (x * z - y), twice * (y * z + x), one - twice * (x * x + y * y));
}

}  // namespace fovea
