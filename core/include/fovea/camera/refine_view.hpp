// SPDX-License-Identifier: MIT
//
// Camera, lens and pose from one view of an object that is not flat, from a start that is not far off. Book
// sec. 2.2.3 and 2.2.4.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/calibration.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/fit_projection.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/projection_derivatives.hpp>
#include <fovea/camera/projection_matrix.hpp>
#include <fovea/camera/refine_pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/levenberg_marquardt.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/match/point_spread.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A camera and a pose, and how well they are known.
template <class Scalar = Real>
struct ViewFit {
    Camera<Scalar> camera;
    Pose<Scalar> pose;
    /// The root of the mean squared distance between where points are seen and where they should be, in px.
    Scalar rms = scalar_of<Scalar>(0);
    /// Standard deviations of the camera's terms; 0 for what was held, and where no equations are left over.
    Camera<Scalar> deviation{scalar_of<Scalar>(0), scalar_of<Scalar>(0)};
};

/// The camera and the pose with the least sum of squared distances in the image.
///
/// Shapes    as many points as pixels: 6 to 2^20, and no fewer equations than unknowns
/// Rounding  down to the last digits of Scalar, see levenberg_marquardt()
/// Errors    size_mismatch; bad_argument for too few or too many; out_of_range if the start has a point
///           behind the camera; degenerate for points on a plane, or where they leave a term open; undecided
///           if the least is not reached
/// Source    levenberg_marquardt() in place of the toolkit's hundreds of turns between a linear
///           camera and a linear lens
template <class Scalar = Real>
constexpr Result<ViewFit<Scalar>> refine_view(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                              const Camera<Scalar>& camera, const Pose<Scalar>& pose,
                                              const IntrinsicsOptions& options);

/// The same from nothing: fit_projection(), decompose(), refine_view().
///
/// Errors  those of the three
template <class Scalar = Real>
constexpr Result<ViewFit<Scalar>> fit_view(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                           const IntrinsicsOptions& options);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A turn, a place, and the terms of a camera.
inline constexpr int view_unknowns = 6 + camera_terms;

/// Points from their mean and their pixels: what levenberg_marquardt() asks for. Terms that are held keep
/// their place among the unknowns.
template <class Scalar>
class ViewProblem {
public:
    constexpr ViewProblem(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                          const FreeTerms& terms)
        : points_(points), pixels_(pixels), means_(points, pixels), terms_(terms) {}

    constexpr Vector<3, Scalar> mean() const {
        return Vector<3, Scalar>(scalar_of<Scalar>(means_.x[0]), scalar_of<Scalar>(means_.x[1]),
                                 scalar_of<Scalar>(means_.x[2]));
    }
    constexpr Status linearise(const CameraView<Scalar>& view,
                               NormalEquations<view_unknowns, Scalar>& equations) const {
        for (std::ptrdiff_t i = 0; i < points_.size(); ++i) {
            const Vector<3, Scalar> arm = view.pose.rotation * place(i);
            ProjectionDerivatives<Scalar> seen;
            const Status status = project_derivatives(view.camera, arm + view.pose.translation, seen);
            if (status != Status::ok) return status;
            const Vector<2, Scalar> error = seen.pixel - pixel_seen<Scalar>(pixels_[i]);
            for (int r = 0; r < 2; ++r) {
                const Vector<6, Scalar> part = by_pose(seen.by_point.row(r), arm);
                Vector<view_unknowns, Scalar> derivatives;
                for (int k = 0; k < 6; ++k) derivatives[k] = part[k];
                terms_.put(seen, r, &derivatives[6]);
                equations.add(derivatives, error[r]);
            }
        }
        // An equation of its own for each place that no term has: that it does not change.
        for (int k = 6 + terms_.count(); k < view_unknowns; ++k)
            equations.matrix(k, k) = scalar_of<Scalar>(1);
        return Status::ok;
    }
    constexpr Result<Scalar> cost(const CameraView<Scalar>& view) const {
        Scalar sum = scalar_of<Scalar>(0);
        for (std::ptrdiff_t i = 0; i < points_.size(); ++i) {
            const auto seen = project(view.camera, view.pose, place(i));
            if (!seen) return seen.status();
            const Vector<2, Scalar> error = *seen - pixel_seen<Scalar>(pixels_[i]);
            for (int r = 0; r < 2; ++r) sum = sum + error[r] * error[r];
        }
        return sum;
    }
    constexpr CameraView<Scalar> moved(CameraView<Scalar> view,
                                       const Vector<view_unknowns, Scalar>& step) const {
        Vector<6, Scalar> part;
        for (int k = 0; k < 6; ++k) part[k] = step[k];
        view.pose = fovea::moved(view.pose, part);
        view.camera = terms_.moved(view.camera, &step[6]);
        return view;
    }

private:
    constexpr Vector<3, Scalar> place(std::ptrdiff_t index) const {
        const SpacePoint point = points_[index];
        return Vector<3, Scalar>(scalar_of<Scalar>(point.x - means_.x[0]),
                                 scalar_of<Scalar>(point.y - means_.x[1]),
                                 scalar_of<Scalar>(point.z - means_.x[2]));
    }

    Span<const SpacePoint> points_;
    Span<const SubPixelPoint> pixels_;
    PairMeans means_;
    FreeTerms terms_;
};

}  // namespace detail

template <class Scalar>
constexpr Result<ViewFit<Scalar>> refine_view(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                              const Camera<Scalar>& camera, const Pose<Scalar>& pose,
                                              const IntrinsicsOptions& options) {
    const detail::FreeTerms terms(options);
    const int unknowns = 6 + terms.count();
    if (points.size() != pixels.size()) return Status::size_mismatch;
    if (2 * points.size() < unknowns || points.size() < 6 || points.size() > detail::most_space_pairs)
        return Status::bad_argument;
    const Result<PointSpread> spread = spread_of<Scalar>(points);
    if (!spread) return spread.status();
    if (*spread != PointSpread::space) return Status::degenerate;

    const detail::ViewProblem<Scalar> problem(points, pixels, terms);
    CameraView<Scalar> view{camera, {pose.rotation, pose(problem.mean())}, scalar_of<Scalar>(0)};
    const auto found = levenberg_marquardt<detail::view_unknowns, Scalar>(problem, view);
    if (!found) return found.status();
    if (!found->converged) return Status::undecided;
    NormalEquations<detail::view_unknowns, Scalar> equations;
    const Status status = problem.linearise(view, equations);
    if (status != Status::ok) return status;
    const auto covariance = equations.inverse();
    if (!covariance) return covariance.status();

    ViewFit<Scalar> fit;
    fit.camera = view.camera;
    fit.pose = {view.pose.rotation, view.pose.translation - view.pose.rotation * problem.mean()};
    fit.rms = square_root(found->cost / scalar_of<Scalar>(points.size()));
    const std::int64_t left_over = 2 * std::int64_t{points.size()} - unknowns;
    if (left_over == 0) return fit;
    const Scalar variance = found->cost / scalar_of<Scalar>(left_over);
    fit.deviation =
        terms.deviations<Scalar>([&](int index) { return variance * (*covariance)(6 + index, 6 + index); });
    return fit;
}

template <class Scalar>
constexpr Result<ViewFit<Scalar>> fit_view(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                           const IntrinsicsOptions& options) {
    const auto matrix = fit_projection<Scalar>(points, pixels);
    if (!matrix) return matrix.status();
    const auto view = decompose(*matrix);
    if (!view) return view.status();
    return refine_view(points, pixels, view->camera, view->pose, options);
}

}  // namespace fovea
