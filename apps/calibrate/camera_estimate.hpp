// SPDX-License-Identifier: MIT
//
// The calibration of one camera, and of a pair, from the boards that were seen; and how far off each of their
// corners is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/camera/calibrate_planar.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/stereo/calibrate_stereo.hpp>

#include <calibrate/board.hpp>
#include <calibrate/seen_board.hpp>

namespace fovea::apps {

template <class T>
Span<T> span_over(std::vector<T>& elements) {
    return {elements.data(), static_cast<std::ptrdiff_t>(elements.size())};
}
template <class T>
Span<const T> span_over(const std::vector<T>& elements) {
    return {elements.data(), static_cast<std::ptrdiff_t>(elements.size())};
}

/// How a view fits.
struct ViewFit {
    std::size_t seen = 0;  ///< which of the boards
    CalibratedView<> fit;
    /// From where each corner was seen to where the calibrated camera sees it, in pixels.
    std::vector<Vector<2>> residuals;
    Real worst;        ///< the length of the longest
    Vector<3> middle;  ///< of the board, in micrometres before the camera
};

struct CameraEstimate {
    CalibrationVerdict verdict;
    Size picture;
    PlanarCalibration<> calibration;
    std::vector<ViewFit> views;

    /// The name of the picture that a verdict is about, "" if it is about none.
    std::string blamed(const std::vector<SeenBoard>& boards) const {
        return verdict.view < 0 ? "" : boards[views[static_cast<std::size_t>(verdict.view)].seen].name;
    }
};

/// Where the middle of a board is, of which a pose tells the first corner.
inline Vector<3> middle_of(const Board& board, const Pose<>& pose) {
    const PlanePoint last = board.points().back();
    return pose(Vector<3>(Real::from_int(last.x, -1), Real::from_int(last.y, -1), Real()));
}

/// From where corners of a board were seen to where a camera sees them.
inline void measure_residuals(const Camera<>& camera, const Pose<>& pose, Span<const PlanePoint> board,
                              Span<const SubPixelPoint> seen, ViewFit& view) {
    for (std::ptrdiff_t i = 0; i < board.size(); ++i) {
        const Vector<3> place(Real::from_int(board[i].x), Real::from_int(board[i].y), Real());
        const Result<Vector<2>> pixel = project(camera, pose, place);
        const Vector<2> at(Real::from_fixed(seen[i].x), Real::from_fixed(seen[i].y));
        view.residuals.push_back(pixel ? *pixel - at : Vector<2>());
        view.worst = std::max(view.worst, length_of(view.residuals.back()));
    }
}

/// Calibrates a camera from all boards that are used.
inline CameraEstimate estimate_camera(const std::vector<SeenBoard>& boards, const Board& board,
                                      const IntrinsicsOptions& options) {
    CameraEstimate estimate;
    const std::vector<PlanePoint> points = board.points();
    std::vector<PlanarView> views;
    for (std::size_t i = 0; i < boards.size(); ++i) {
        if (!boards[i].used) continue;
        estimate.picture = boards[i].picture;
        estimate.views.emplace_back().seen = i;
        views.push_back({span_over(points), boards[i].span()});
    }
    std::vector<CalibratedView<>> fits(views.size());
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(calibrate_planar_scratch(static_cast<int>(views.size()))));
    estimate.verdict = calibrate_planar<Real>(span_over(std::as_const(views)), estimate.picture, options,
                                              span_over(scratch), span_over(fits), estimate.calibration);
    for (std::size_t i = 0; i < views.size() && estimate.verdict.ok(); ++i) {
        estimate.views[i].fit = fits[i];
        estimate.views[i].middle = middle_of(board, fits[i].pose);
        measure_residuals(estimate.calibration.camera, fits[i].pose, views[i].board, views[i].seen,
                          estimate.views[i]);
    }
    return estimate;
}

struct PairEstimate {
    CalibrationVerdict verdict;
    StereoCalibration<> calibration;
    /// One a pair of pictures in which both cameras saw the board: seen counts pairs of pictures.
    std::vector<ViewFit> views;
};

/// Corners of a board that was taken for turned by half: from the last to the first.
inline void turn_by_half(std::vector<SubPixelPoint>& corners) {
    std::reverse(corners.begin(), corners.end());
}

/// Whether two cameras that see a board so stand to each other more upright if the second saw it turned by
/// half about its middle.
inline bool better_turned(const Pose<>& left, const Pose<>& right) {
    Matrix<3, 3> half = Matrix<3, 3>::identity();
    half(0, 0) = half(1, 1) = -Real::one();
    const Matrix<3, 3> back = left.rotation.transposed();
    const auto trace = [](const Matrix<3, 3>& m) { return m(0, 0) + m(1, 1) + m(2, 2); };
    return trace(right.rotation * half * back) > trace(right.rotation * back);
}

/// Calibrates a pair from the pictures with the same number in which both cameras saw the board.
inline PairEstimate estimate_pair(const std::vector<SeenBoard>& left_boards,
                                  std::vector<SeenBoard> right_boards, const CameraEstimate& left,
                                  const CameraEstimate& right, const Board& board,
                                  const StereoOptions& options) {
    PairEstimate estimate;
    const std::vector<PlanePoint> points = board.points();
    std::vector<StereoView> views;
    for (const ViewFit& one : left.views)
        for (const ViewFit& other : right.views) {
            if (one.seen != other.seen) continue;
            SeenBoard& turned = right_boards[other.seen];
            if (board.symmetric() && better_turned(one.fit.pose, other.fit.pose))
                turn_by_half(turned.corners);
            estimate.views.emplace_back().seen = one.seen;
            views.push_back({span_over(points), left_boards[one.seen].span(), turned.span()});
        }
    std::vector<CalibratedView<>> fits(views.size());
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(calibrate_stereo_scratch(static_cast<int>(views.size()))));
    estimate.verdict =
        calibrate_stereo<Real>(span_over(std::as_const(views)), {left.calibration.camera, left.picture},
                               {right.calibration.camera, right.picture}, options, span_over(scratch),
                               span_over(fits), estimate.calibration);
    for (std::size_t i = 0; i < views.size() && estimate.verdict.ok(); ++i) {
        const StereoCalibration<>& found = estimate.calibration;
        estimate.views[i].fit = fits[i];
        estimate.views[i].middle = middle_of(board, fits[i].pose);
        measure_residuals(found.left, fits[i].pose, views[i].board, views[i].left, estimate.views[i]);
        measure_residuals(found.right, compose(found.right_from_left, fits[i].pose), views[i].board,
                          views[i].right, estimate.views[i]);
    }
    return estimate;
}

/// What to try where there is no calibration.
inline std::string advice_on(CalibrationProblem problem) {
    switch (problem) {
        case CalibrationProblem::too_few_views:
            return "take more pictures, ten or more, with the board tilted to different sides; or hold the "
                   "principal point with --fixed-centre";
        case CalibrationProblem::parallel_views:
            return "tilt the board by 20 degrees and more, to different sides, and take the pictures again";
        case CalibrationProblem::no_convergence:
            return "look at the corners with --explain; is the board flat, and --lens what the lens needs?";
        case CalibrationProblem::board_behind:
        case CalibrationProblem::collinear_points:
        case CalibrationProblem::outside_picture:
            return "look at the corners with --explain, and leave out a picture where they are wrong";
        case CalibrationProblem::too_few_points: return "use a board with more corners, or more pictures";
        case CalibrationProblem::bad_argument: return "at most 4096 pictures of 32767 px a side";
        case CalibrationProblem::none:
        case CalibrationProblem::scratch_too_small:
        case CalibrationProblem::size_mismatch: break;
    }
    return "please report it with the pictures";
}

/// One line on why there is no calibration: of what, why, and what to try.
inline std::string no_calibration(const std::string& what, const std::string& picture,
                                  CalibrationProblem problem) {
    return what + ": " + describe(problem) + (picture.empty() ? "" : " (" + picture + ")") + "; " +
           advice_on(problem);
}

}  // namespace fovea::apps
