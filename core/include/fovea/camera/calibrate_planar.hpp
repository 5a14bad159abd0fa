// SPDX-License-Identifier: MIT
//
// A camera from views of a flat board: focal lengths, principal point, lens, and where the board was.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/calibration.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/planar_start.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/projection_derivatives.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/block_equations.hpp>
#include <fovea/linear/levenberg_marquardt.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/fit_homography.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Points of a board and where a picture shows them, in the same order. Views may share the board, or show
/// parts of it.
struct PlanarView {
    Span<const PlanePoint> board;
    Span<const SubPixelPoint> seen;
};

template <class Scalar = Real>
struct PlanarCalibration {
    Camera<Scalar> camera;
    /// Of every term of the camera; 0 of those that are held.
    Camera<Scalar> deviation;
    /// Of the distances between points as they are seen and as the camera would see them, in pixels.
    Scalar rms = scalar_of<Scalar>(0);
    Refinement<Scalar> refinement;
};

/// Bytes of scratch for calibrate_planar().
template <class Scalar = Real>
constexpr std::int64_t calibrate_planar_scratch(int views) {
    const std::int64_t scalars = block_equations_scratch<6>(camera_terms, views) + camera_terms;
    return scalars * static_cast<int>(sizeof(Scalar)) + block_equations_words<6>(camera_terms) * 8 + 8 +
           std::int64_t{views} * static_cast<int>(sizeof(Pose<Scalar>)) +
           2 * static_cast<int>(alignof(Scalar));
}

/// The camera that a board was seen by, in some views from different directions: the one for which the points
/// miss where they were seen by the least sum of squares.
///
/// Shapes    as many fits as views or more; 4 to 2^20 points a view, up to 4096 views. Two views are enough
///           where the principal point is estimated, and one where it is held; ten or more with the board
///           tilted by 20 degrees and more, in all corners of the picture, give a good camera
/// Units     fits and poses in those of the board; all else in pixels
/// Rounding  that of Scalar: with Real the answer is within 2^-33 standard deviations of the least sum
/// Time      bounded, see levenberg_marquardt(); 8 to 12 times all points for a usual camera
/// Scratch   calibrate_planar_scratch<Scalar>(views) bytes, undefined afterwards
/// Errors    see CalibrationProblem. parallel_views is answered where a focal length or the principal point
///           has a standard deviation of more than an eighth of the focal length, and, if more than two of
///           the four are estimated, where no board is tilted by 3.6 degrees to the first: only the lens, or
///           noise, would decide then. After an error fits and calibration are untouched
/// Source    Zhang, "A flexible new technique for camera calibration", IEEE PAMI 22(11), 2000; the start by
///           FocalStart in place of the closed form for five unknowns. Deviations from the inverse of the
///           normal equations times the variance that the residuals show
template <class Scalar>
CalibrationVerdict calibrate_planar(Span<const PlanarView> views, Size picture,
                                    const IntrinsicsOptions& options, Span<std::uint8_t> scratch,
                                    Span<CalibratedView<Scalar>> fits,
                                    PlanarCalibration<Scalar>& calibration);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The equations of a camera and its views, for descend().
template <class Scalar>
class PlanarSystem {
public:
    PlanarSystem(Span<const PlanarView> views, const IntrinsicsOptions& options, Span<Pose<Scalar>> poses,
                 Span<Scalar> row, Span<Scalar> equations, Span<std::int64_t> words)
        : views_(views),
          terms_(options),
          poses_(poses),
          row_(row.first(terms_.count())),
          equations_(terms_.count(), static_cast<int>(views.size()), equations, words) {}

    /// The state to start from.
    CalibrationVerdict start(Size picture);
    const Camera<Scalar>& camera() const { return camera_; }
    const FreeTerms& terms() const { return terms_; }
    BlockEquations<6, Scalar>& equations() { return equations_; }
    const Pose<Scalar>& pose(int view) const { return poses_[view]; }
    Result<Scalar> cost_of(int view) const {
        return cost_of_view(camera_, poses_[view], views_[view].board, views_[view].seen);
    }
    std::int64_t points() const {
        std::int64_t count = 0;
        for (const PlanarView& view : views_) count += view.board.size();
        return count;
    }

    Status linearise();
    Scalar cost() const { return equations_.cost(); }
    Status solve(int damping, Scalar& gain) { return equations_.solve(damping, gain); }
    Result<Scalar> cost_ahead() const { return cost_with(true); }
    Result<Scalar> cost_here() const { return cost_with(false); }
    void accept() {
        camera_ = camera_ahead();
        for (int view = 0; view < equations_.views(); ++view) poses_[view] = pose_ahead(view);
    }

private:
    Camera<Scalar> camera_ahead() const { return terms_.moved(camera_, equations_.shared_step().data()); }
    Pose<Scalar> pose_ahead(int view) const { return moved(poses_[view], equations_.own_step(view)); }
    Result<Scalar> cost_with(bool step) const;

    Span<const PlanarView> views_;
    FreeTerms terms_;
    Span<Pose<Scalar>> poses_;
    Span<Scalar> row_;
    BlockEquations<6, Scalar> equations_;
    Camera<Scalar> camera_;
};

template <class Scalar>
CalibrationVerdict PlanarSystem<Scalar>::start(Size picture) {
    FocalStart<Scalar> focal(picture);
    for (int view = 0; view < equations_.views(); ++view) {
        const auto homography = fit_homography<Scalar>(views_[view].board, views_[view].seen);
        if (!homography) return {problem_of_homography(homography.status(), views_[view].board), view};
        focal.add(*homography);
        // Kept where the pose will stand.
        poses_[view].rotation = *homography;
    }
    camera_ = focal.camera();
    if (terms_.square()) camera_.fy = camera_.fx;
    for (int view = 0; view < equations_.views(); ++view) {
        const auto pose = pose_of_plane(camera_, poses_[view].rotation);
        if (!pose) return {CalibrationProblem::collinear_points, view};
        poses_[view] = *pose;
        if (!cost_of(view)) return {CalibrationProblem::board_behind, view};
    }
    return {};
}

template <class Scalar>
Status PlanarSystem<Scalar>::linearise() {
    equations_.clear();
    for (int view = 0; view < equations_.views(); ++view) {
        const PlanarView& points = views_[view];
        for (std::ptrdiff_t i = 0; i < points.board.size(); ++i) {
            const Vector<3, Scalar> arm = turned(poses_[view].rotation, points.board[i]);
            ProjectionDerivatives<Scalar> seen;
            const Status status = project_derivatives(camera_, arm + poses_[view].translation, seen);
            if (status != Status::ok) return status;
            const Vector<2, Scalar> off = seen.pixel - pixel_seen<Scalar>(points.seen[i]);
            for (int row = 0; row < 2; ++row) {
                terms_.put(seen, row, row_.data());
                equations_.add(view, row_, by_pose(seen.by_point.row(row), arm), off[row]);
            }
        }
    }
    equations_.finish();
    return Status::ok;
}

template <class Scalar>
Result<Scalar> PlanarSystem<Scalar>::cost_with(bool step) const {
    const Camera<Scalar> camera = step ? camera_ahead() : camera_;
    Scalar cost = scalar_of<Scalar>(0);
    for (int view = 0; view < equations_.views(); ++view) {
        const auto part = cost_of_view(camera, step ? pose_ahead(view) : poses_[view], views_[view].board,
                                       views_[view].seen);
        if (!part) return part.status();
        cost = cost + *part;
    }
    return cost;
}

/// What can be said against views without calculating.
constexpr CalibrationVerdict verdict_of(Span<const PlanarView> views, Size picture, const FreeTerms& terms) {
    if (picture.empty() || picture.width > max_image_side || picture.height > max_image_side ||
        views.size() > most_calibration_views)
        return {CalibrationProblem::bad_argument, -1};
    // A view of a plane tells two numbers of a pinhole.
    if (2 * views.size() < terms.of_pinhole()) return {CalibrationProblem::too_few_views, -1};
    std::int64_t equations = 0;
    for (int view = 0; view < views.size(); ++view) {
        const CalibrationProblem problem = problem_of_points(views[view].board, views[view].seen, picture);
        if (problem != CalibrationProblem::none) return {problem, view};
        equations += 2 * views[view].board.size();
    }
    if (equations <= terms.count() + 6 * views.size()) return {CalibrationProblem::too_few_points, -1};
    return {};
}

}  // namespace detail

template <class Scalar>
CalibrationVerdict calibrate_planar(Span<const PlanarView> views, Size picture,
                                    const IntrinsicsOptions& options, Span<std::uint8_t> scratch,
                                    Span<CalibratedView<Scalar>> fits,
                                    PlanarCalibration<Scalar>& calibration) {
    const detail::FreeTerms terms(options);
    CalibrationVerdict verdict = detail::verdict_of(views, picture, terms);
    if (!verdict.ok()) return verdict;
    const int count = static_cast<int>(views.size());
    if (fits.size() < count || scratch.size() < calibrate_planar_scratch<Scalar>(count))
        return {CalibrationProblem::scratch_too_small, -1};

    Arena arena(scratch);
    const auto poses = arena.take<Pose<Scalar>>(count);
    const auto row = arena.take<Scalar>(camera_terms);
    const auto words = arena.take<std::int64_t>(block_equations_words<6>(terms.count()));
    const auto room = arena.take<Scalar>(block_equations_scratch<6>(terms.count(), count));
    detail::PlanarSystem<Scalar> system(views, options, poses, row, room, words);
    verdict = system.start(picture);
    if (!verdict.ok()) return verdict;

    PlanarCalibration<Scalar> result;
    const CalibrationProblem problem = detail::refine<Scalar>(system, terms, poses, result.refinement);
    if (problem != CalibrationProblem::none) return {problem, -1};
    const std::int64_t points = system.points();
    const std::int64_t spare = 2 * points - terms.count() - std::int64_t{6} * count;
    const Scalar variance = result.refinement.cost / scalar_of<Scalar>(spare);
    auto& equations = system.equations();
    equations.invert();
    result.camera = system.camera();
    result.deviation =
        terms.deviations<Scalar>([&](int i) { return equations.shared_variance(i) * variance; });
    result.rms = square_root(result.refinement.cost / scalar_of<Scalar>(points));
    if (!detail::FreeTerms::determined(result.camera, result.deviation))
        return {CalibrationProblem::parallel_views, -1};
    if (!result.refinement.converged) return {CalibrationProblem::no_convergence, -1};

    for (int view = 0; view < count; ++view) {
        CalibratedView<Scalar>& fit = fits[view];
        fit.pose = system.pose(view);
        const Vector<6, Scalar> own = equations.own_variances(view);
        for (int i = 0; i < 3; ++i) {
            fit.rotation_deviation[i] = square_root(own[i] * variance);
            fit.translation_deviation[i] = square_root(own[i + 3] * variance);
        }
        // In front of the camera: the costs of all were asked for.
        fit.rms = square_root(*system.cost_of(view) / scalar_of<Scalar>(views[view].board.size()));
    }
    calibration = result;
    return {};
}

}  // namespace fovea
