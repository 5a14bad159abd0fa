// SPDX-License-Identifier: MIT
//
// How two cameras stand to each other, from views of a flat board that both saw at the same time.
#pragma once

#include <cstdint>
#include <initializer_list>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/calibration.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/projection_derivatives.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/block_equations.hpp>
#include <fovea/linear/levenberg_marquardt.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>
#include <fovea/stereo/stereo_start.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A camera as a calibration of its own has it, and the size of its pictures.
template <class Scalar = Real>
struct CalibratedCamera {
    Camera<Scalar> camera;
    Size picture;
};

struct StereoOptions {
    /// Whether the cameras stay as they are, or are estimated again together with all else: closer to the
    /// points by a little, where views cover both pictures well.
    enum class Intrinsics : std::uint8_t { held, estimated };
    Intrinsics intrinsics = Intrinsics::held;
    /// What is estimated of each of them; the rest stays as it is.
    IntrinsicsOptions estimated;
};

template <class Scalar = Real>
struct StereoCalibration {
    /// From left to right camera coordinates.
    Pose<Scalar> right_from_left;
    /// Standard deviations, the rotation's in radians about the axes of the right camera.
    Vector<3, Scalar> rotation_deviation;
    Vector<3, Scalar> translation_deviation;
    /// As they were given, or as they were estimated.
    Camera<Scalar> left;
    Camera<Scalar> right;
    Camera<Scalar> left_deviation;
    Camera<Scalar> right_deviation;
    /// Of the distances between points as they are seen and as the cameras would see them, in pixels, over
    /// the points of both.
    Scalar rms = scalar_of<Scalar>(0);
    Refinement<Scalar> refinement;
};

/// Bytes of scratch for calibrate_stereo().
template <class Scalar = Real>
constexpr std::int64_t calibrate_stereo_scratch(int views) {
    const int shared = 6 + 2 * camera_terms;
    const std::int64_t scalars = block_equations_scratch<6>(shared, views) + shared;
    return scalars * static_cast<int>(sizeof(Scalar)) + block_equations_words<6>(shared) * 8 + 8 +
           std::int64_t{2} * views * static_cast<int>(sizeof(Pose<Scalar>)) +
           3 * static_cast<int>(alignof(Scalar));
}

/// Rotation and translation between two cameras that saw a board from different sides, and where the board
/// was: those for which the points in both pictures miss where they were seen by the least sum of squares.
///
/// Shapes    as many fits as views or more; 4 to 2^20 points a view, up to 4096 views: one or more where the
///           cameras are held, two or more where they are estimated
/// Units     translations in those of the board; fits are poses before the left camera, their rms is over the
///           points of both pictures; all else in pixels
/// Rounding  that of Scalar, as calibrate_planar() has it
/// Time      bounded, see levenberg_marquardt()
/// Scratch   calibrate_stereo_scratch<Scalar>(views) bytes, undefined afterwards
/// Errors    see CalibrationProblem. parallel_views is answered where the views leave the way between the
///           cameras open, or a camera that is estimated. After an error fits and calibration are untouched
/// Source    book sec. 2.10; Levenberg-Marquardt over all unknowns, from the middle of the ways that the
///           views tell by themselves
template <class Scalar>
CalibrationVerdict calibrate_stereo(Span<const StereoView> views, const CalibratedCamera<Scalar>& left,
                                    const CalibratedCamera<Scalar>& right, const StereoOptions& options,
                                    Span<std::uint8_t> scratch, Span<CalibratedView<Scalar>> fits,
                                    StereoCalibration<Scalar>& calibration);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The terms that are estimated: none where the cameras are held.
constexpr FreeTerms stereo_terms(const StereoOptions& options) {
    return options.intrinsics == StereoOptions::Intrinsics::held ? FreeTerms() : FreeTerms(options.estimated);
}

/// The equations of two cameras and their views, for descend(). Shared unknowns are the way from left to
/// right, then the terms of the left camera, then those of the right one.
template <class Scalar>
class StereoSystem {
public:
    StereoSystem(Span<const StereoView> views, const FreeTerms& terms, Span<Pose<Scalar>> poses,
                 Span<Scalar> row, Span<Scalar> equations, Span<std::int64_t> words)
        : views_(views),
          terms_(terms),
          poses_(poses),
          row_(row.first(6 + 2 * terms.count())),
          equations_(6 + 2 * terms.count(), static_cast<int>(views.size()), equations, words) {}

    CalibrationVerdict start(const Camera<Scalar>& left, const Camera<Scalar>& right,
                             Span<Pose<Scalar>> others) {
        left_ = left;
        right_ = right;
        return start_stereo<Scalar>(views_, left, right, poses_, others, way_);
    }
    const Camera<Scalar>& left() const { return left_; }
    const Camera<Scalar>& right() const { return right_; }
    const Pose<Scalar>& way() const { return way_; }
    const Pose<Scalar>& pose(int view) const { return poses_[view]; }
    BlockEquations<6, Scalar>& equations() { return equations_; }
    Result<Scalar> cost_of(int view) const {
        return cost_of_pair(left_, right_, way_, poses_[view], views_[view]);
    }

    Status linearise();
    Scalar cost() const { return equations_.cost(); }
    Status solve(int damping, Scalar& gain) {
        const Status status = equations_.solve(damping, gain);
        if (status != Status::ok) return status;
        const Scalar* step = equations_.shared_step().data();
        way_ahead_ = moved(way_, Vector<6, Scalar>(step[0], step[1], step[2], step[3], step[4], step[5]));
        left_ahead_ = terms_.moved(left_, step + 6);
        right_ahead_ = terms_.moved(right_, step + 6 + terms_.count());
        return Status::ok;
    }
    Result<Scalar> cost_ahead() const;
    Result<Scalar> cost_here() const;
    void accept() {
        way_ = way_ahead_;
        left_ = left_ahead_;
        right_ = right_ahead_;
        for (int view = 0; view < equations_.views(); ++view) poses_[view] = pose_ahead(view);
    }

private:
    Pose<Scalar> pose_ahead(int view) const { return moved(poses_[view], equations_.own_step(view)); }
    Status add_left(int view, std::ptrdiff_t point, const Vector<3, Scalar>& arm);
    Status add_right(int view, std::ptrdiff_t point, const Vector<3, Scalar>& arm);

    Span<const StereoView> views_;
    FreeTerms terms_;
    Span<Pose<Scalar>> poses_;
    Span<Scalar> row_;
    BlockEquations<6, Scalar> equations_;
    Camera<Scalar> left_;
    Camera<Scalar> right_;
    Pose<Scalar> way_;
    Camera<Scalar> left_ahead_;
    Camera<Scalar> right_ahead_;
    Pose<Scalar> way_ahead_;
};

template <class Scalar>
Status StereoSystem<Scalar>::add_left(int view, std::ptrdiff_t point, const Vector<3, Scalar>& arm) {
    ProjectionDerivatives<Scalar> seen;
    const Status status = project_derivatives(left_, arm + poses_[view].translation, seen);
    if (status != Status::ok) return status;
    const Vector<2, Scalar> off = seen.pixel - pixel_seen<Scalar>(views_[view].left[point]);
    for (int row = 0; row < 2; ++row) {
        for (Scalar& value : row_) value = scalar_of<Scalar>(0);
        terms_.put(seen, row, row_.data() + 6);
        equations_.add(view, row_, by_pose(seen.by_point.row(row), arm), off[row]);
    }
    return Status::ok;
}

template <class Scalar>
Status StereoSystem<Scalar>::add_right(int view, std::ptrdiff_t point, const Vector<3, Scalar>& arm) {
    ProjectionDerivatives<Scalar> seen;
    const Vector<3, Scalar> far_arm = way_.rotation * (arm + poses_[view].translation);
    const Status status = project_derivatives(right_, far_arm + way_.translation, seen);
    if (status != Status::ok) return status;
    const Vector<2, Scalar> off = seen.pixel - pixel_seen<Scalar>(views_[view].right[point]);
    const Matrix<2, 3, Scalar> by_left_point = seen.by_point * way_.rotation;
    for (int row = 0; row < 2; ++row) {
        for (Scalar& value : row_) value = scalar_of<Scalar>(0);
        const Vector<6, Scalar> by_way = by_pose(seen.by_point.row(row), far_arm);
        for (int i = 0; i < 6; ++i) row_[i] = by_way[i];
        terms_.put(seen, row, row_.data() + 6 + terms_.count());
        equations_.add(view, row_, by_pose(by_left_point.row(row), arm), off[row]);
    }
    return Status::ok;
}

template <class Scalar>
Status StereoSystem<Scalar>::linearise() {
    equations_.clear();
    for (int view = 0; view < equations_.views(); ++view)
        for (std::ptrdiff_t i = 0; i < views_[view].board.size(); ++i) {
            const Vector<3, Scalar> arm = turned(poses_[view].rotation, views_[view].board[i]);
            Status status = add_left(view, i, arm);
            if (status == Status::ok) status = add_right(view, i, arm);
            if (status != Status::ok) return status;
        }
    equations_.finish();
    return Status::ok;
}

template <class Scalar>
Result<Scalar> StereoSystem<Scalar>::cost_ahead() const {
    Scalar cost = scalar_of<Scalar>(0);
    for (int view = 0; view < equations_.views(); ++view) {
        const auto part = cost_of_pair(left_ahead_, right_ahead_, way_ahead_, pose_ahead(view), views_[view]);
        if (!part) return part;
        cost = cost + *part;
    }
    return cost;
}
template <class Scalar>
Result<Scalar> StereoSystem<Scalar>::cost_here() const {
    Scalar cost = scalar_of<Scalar>(0);
    for (int view = 0; view < equations_.views(); ++view) {
        const auto part = cost_of(view);
        if (!part) return part;
        cost = cost + *part;
    }
    return cost;
}

/// What can be said against views without calculating; points are those of both pictures.
template <class Scalar>
constexpr CalibrationVerdict verdict_of(Span<const StereoView> views, const CalibratedCamera<Scalar>& left,
                                        const CalibratedCamera<Scalar>& right, const FreeTerms& terms,
                                        std::int64_t& points) {
    const Scalar zero = scalar_of<Scalar>(0);
    for (const CalibratedCamera<Scalar>& one : {left, right})
        if (one.picture.empty() || one.picture.width > max_image_side ||
            one.picture.height > max_image_side || !(zero < one.camera.fx) || !(zero < one.camera.fy))
            return {CalibrationProblem::bad_argument, -1};
    if (views.size() > most_calibration_views) return {CalibrationProblem::bad_argument, -1};
    if (views.empty() || 2 * views.size() < terms.of_pinhole())
        return {CalibrationProblem::too_few_views, -1};
    points = 0;
    for (int view = 0; view < views.size(); ++view) {
        const StereoView& seen = views[view];
        auto problem = problem_of_points(seen.board, seen.left, left.picture);
        if (problem == CalibrationProblem::none)
            problem = problem_of_points(seen.board, seen.right, right.picture);
        if (problem != CalibrationProblem::none) return {problem, view};
        points += 2 * seen.board.size();
    }
    if (2 * points <= 6 + 2 * terms.count() + 6 * views.size())
        return {CalibrationProblem::too_few_points, -1};
    return {};
}

}  // namespace detail

template <class Scalar>
CalibrationVerdict calibrate_stereo(Span<const StereoView> views, const CalibratedCamera<Scalar>& left,
                                    const CalibratedCamera<Scalar>& right, const StereoOptions& options,
                                    Span<std::uint8_t> scratch, Span<CalibratedView<Scalar>> fits,
                                    StereoCalibration<Scalar>& calibration) {
    const detail::FreeTerms terms = detail::stereo_terms(options);
    std::int64_t points = 0;
    CalibrationVerdict verdict = detail::verdict_of(views, left, right, terms, points);
    if (!verdict.ok()) return verdict;
    const int count = static_cast<int>(views.size());
    if (fits.size() < count || scratch.size() < calibrate_stereo_scratch<Scalar>(count))
        return {CalibrationProblem::scratch_too_small, -1};

    const int shared = 6 + 2 * terms.count();
    Arena arena(scratch);
    const auto poses = arena.take<Pose<Scalar>>(count);
    const auto others = arena.take<Pose<Scalar>>(count);
    const auto row = arena.take<Scalar>(shared);
    const auto words = arena.take<std::int64_t>(block_equations_words<6>(shared));
    const auto room = arena.take<Scalar>(block_equations_scratch<6>(shared, count));
    detail::StereoSystem<Scalar> system(views, terms, poses, row, room, words);
    verdict = system.start(left.camera, right.camera, others);
    if (!verdict.ok()) return verdict;

    Refinement<Scalar> refinement;
    const CalibrationProblem problem = detail::refine<Scalar>(system, terms, poses, refinement);
    if (problem != CalibrationProblem::none) return {problem, -1};
    const Scalar variance =
        refinement.cost / scalar_of<Scalar>(2 * points - shared - std::int64_t{6} * count);
    auto& equations = system.equations();
    equations.invert();
    const auto variance_of = [&](int i) { return equations.shared_variance(i) * variance; };
    const auto left_deviation = terms.deviations<Scalar>([&](int i) { return variance_of(6 + i); });
    const auto right_deviation =
        terms.deviations<Scalar>([&](int i) { return variance_of(6 + terms.count() + i); });
    bool open = !detail::FreeTerms::determined(system.left(), left_deviation) ||
                !detail::FreeTerms::determined(system.right(), right_deviation);
    for (int i = 0; i < 3; ++i)
        if (!(variance_of(i) < scalar_of<Scalar>(1, -6))) open = true;
    if (open) return {CalibrationProblem::parallel_views, -1};
    if (!refinement.converged) return {CalibrationProblem::no_convergence, -1};

    for (int i = 0; i < 3; ++i) {
        calibration.rotation_deviation[i] = square_root(variance_of(i));
        calibration.translation_deviation[i] = square_root(variance_of(i + 3));
    }
    calibration.right_from_left = system.way();
    calibration.left = system.left();
    calibration.right = system.right();
    calibration.left_deviation = left_deviation;
    calibration.right_deviation = right_deviation;
    calibration.rms = square_root(refinement.cost / scalar_of<Scalar>(points));
    calibration.refinement = refinement;
    for (int view = 0; view < count; ++view) {
        CalibratedView<Scalar>& fit = fits[view];
        fit.pose = system.pose(view);
        const Vector<6, Scalar> own = equations.own_variances(view);
        for (int i = 0; i < 3; ++i) {
            fit.rotation_deviation[i] = square_root(own[i] * variance);
            fit.translation_deviation[i] = square_root(own[i + 3] * variance);
        }
        // In front of both cameras: the costs of all were asked for.
        fit.rms = square_root(*system.cost_of(view) / scalar_of<Scalar>(2 * views[view].board.size()));
    }
    return {};
}

}  // namespace fovea
