// SPDX-License-Identifier: MIT
//
// Two cameras that look at one scene. Book sec. 2.10.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/projection_matrix.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/linear/svd.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Two cameras and how they stand to each other. Which is called left does not matter to what is calculated:
/// it is the one in whose coordinates places in space are told.
///
/// Units  the translation's is that of all lengths: millimetres as a rule
template <class Scalar = Real>
struct StereoCamera {
    Camera<Scalar> left;
    Camera<Scalar> right;
    Pose<Scalar> right_from_left;  ///< from left to right camera coordinates
};

/// How the right camera stands to the left one, of two cameras whose poses in one world are known: rotation
/// Rr Rl^T, made square again, since files have few digits.
///
/// Errors  degenerate where that is no rotation
/// Source  the toolkit's option to make the left camera the world
template <class Scalar>
constexpr Result<Pose<Scalar>> right_from_left(const Pose<Scalar>& left, const Pose<Scalar>& right);

/// The same pair seen from the other camera.
template <class Scalar>
constexpr StereoCamera<Scalar> swapped(const StereoCamera<Scalar>& cameras) {
    return {cameras.right, cameras.left, inverse(cameras.right_from_left)};
}

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr Result<Pose<Scalar>> right_from_left(const Pose<Scalar>& left, const Pose<Scalar>& right) {
    const Result<Matrix<3, 3, Scalar>> rotation =
        nearest_rotation(right.rotation * left.rotation.transposed());
    if (!rotation) return rotation.status();
    return Pose<Scalar>{*rotation, right.translation - *rotation * left.translation};
}

}  // namespace fovea
