// SPDX-License-Identifier: MIT
//
// Where two cameras stand to each other, about: from boards that both see, each by itself.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/calibration.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/planar_start.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/projection_derivatives.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/levenberg_marquardt.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/fit_homography.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Points of a board and where two pictures of one moment show them, in the same order.
struct StereoView {
    Span<const PlanePoint> board;
    Span<const SubPixelPoint> left;
    Span<const SubPixelPoint> right;
};

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The pose of a board before a camera that is known, for levenberg_marquardt().
template <class Scalar>
struct BoardPoseProblem {
    const Camera<Scalar>& camera;
    Span<const PlanePoint> board;
    Span<const SubPixelPoint> seen;

    constexpr Status linearise(const Pose<Scalar>& pose, NormalEquations<6, Scalar>& equations) const {
        for (std::ptrdiff_t i = 0; i < board.size(); ++i) {
            const Vector<3, Scalar> arm = turned(pose.rotation, board[i]);
            ProjectionDerivatives<Scalar> derivatives;
            const Status status = project_derivatives(camera, arm + pose.translation, derivatives);
            if (status != Status::ok) return status;
            const Vector<2, Scalar> off = derivatives.pixel - pixel_seen<Scalar>(seen[i]);
            for (int row = 0; row < 2; ++row)
                equations.add(by_pose(derivatives.by_point.row(row), arm), off[row]);
        }
        return Status::ok;
    }
    constexpr Result<Scalar> cost(const Pose<Scalar>& pose) const {
        return cost_of_view(camera, pose, board, seen);
    }
    constexpr Pose<Scalar> moved(const Pose<Scalar>& pose, const Vector<6, Scalar>& step) const {
        return fovea::moved(pose, step);
    }
};

/// The pose of a board, from its homography and then with the lens.
template <class Scalar>
constexpr CalibrationProblem find_board_pose(const Camera<Scalar>& camera, Span<const PlanePoint> board,
                                             Span<const SubPixelPoint> seen, Pose<Scalar>& pose) {
    const auto homography = fit_homography<Scalar>(board, seen);
    if (!homography) return problem_of_homography(homography.status(), board);
    const auto start = pose_of_plane(camera, *homography);
    if (!start) return CalibrationProblem::collinear_points;
    pose = *start;
    LevenbergMarquardtOptions options;
    options.most_linearisations = 20;
    const auto refined =
        levenberg_marquardt<6, Scalar>(BoardPoseProblem<Scalar>{camera, board, seen}, pose, options);
    if (refined) return CalibrationProblem::none;
    return refined.status() == Status::out_of_range ? CalibrationProblem::board_behind
                                                    : CalibrationProblem::collinear_points;
}

/// The sum of all differences between two rotations.
template <class Scalar>
constexpr Scalar difference_of(const Matrix<3, 3, Scalar>& a, const Matrix<3, 3, Scalar>& b) {
    Scalar sum = scalar_of<Scalar>(0);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) sum = sum + absolute(a(r, c) - b(r, c));
    return sum;
}

/// The way from left to right of the view whose rotation differs least from those of all views: a board that
/// is seen from the front may have been taken for its mirror image in some. Of many views 32 are tried.
template <class Scalar>
constexpr Pose<Scalar> middle_way(Span<const Pose<Scalar>> left, Span<const Pose<Scalar>> right) {
    const auto way = [&](std::ptrdiff_t view) { return compose(right[view], inverse(left[view])); };
    const std::ptrdiff_t stride = (left.size() + 31) / 32;
    Pose<Scalar> best = way(0);
    Scalar least = scalar_of<Scalar>(0);
    for (std::ptrdiff_t view = 0; view < left.size(); view += stride) {
        const Pose<Scalar> one = way(view);
        Scalar sum = scalar_of<Scalar>(0);
        for (std::ptrdiff_t other = 0; other < left.size(); ++other)
            sum = sum + difference_of(one.rotation, way(other).rotation);
        if (view != 0 && !(sum < least)) continue;
        least = sum;
        best = one;
    }
    return best;
}

/// The sum of squares of what both cameras miss of a board; pose is that before the left one.
template <class Scalar>
constexpr Result<Scalar> cost_of_pair(const Camera<Scalar>& left, const Camera<Scalar>& right,
                                      const Pose<Scalar>& way, const Pose<Scalar>& pose,
                                      const StereoView& view) {
    const auto first = cost_of_view(left, pose, view.board, view.left);
    if (!first) return first;
    const auto second = cost_of_view(right, compose(way, pose), view.board, view.right);
    if (!second) return second;
    return *first + *second;
}

/// Poses before the left camera, and the way from left to right. Uses others up.
template <class Scalar>
constexpr CalibrationVerdict start_stereo(Span<const StereoView> views, const Camera<Scalar>& left,
                                          const Camera<Scalar>& right, Span<Pose<Scalar>> poses,
                                          Span<Pose<Scalar>> others, Pose<Scalar>& way) {
    for (int view = 0; view < views.size(); ++view) {
        const StereoView& points = views[view];
        auto problem = find_board_pose(left, points.board, points.left, poses[view]);
        if (problem == CalibrationProblem::none)
            problem = find_board_pose(right, points.board, points.right, others[view]);
        if (problem != CalibrationProblem::none) return {problem, view};
    }
    way = middle_way<Scalar>(poses, others);
    const Pose<Scalar> back = inverse(way);
    for (int view = 0; view < views.size(); ++view) {
        // The board as the left camera has it, or as the right one has it.
        const Pose<Scalar> other = compose(back, others[view]);
        const auto cost = cost_of_pair(left, right, way, poses[view], views[view]);
        const auto other_cost = cost_of_pair(left, right, way, other, views[view]);
        if (other_cost && (!cost || *other_cost < *cost))
            poses[view] = other;
        else if (!cost)
            return {CalibrationProblem::board_behind, view};
    }
    return {};
}

}  // namespace detail
}  // namespace fovea
