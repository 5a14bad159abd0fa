// SPDX-License-Identifier: MIT
//
// Camera, lens and pose from one view of an object that is not flat, from a start that is not far off. Book
// sec. 2.2.3 and 2.2.4.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/fit_projection.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/projection_matrix.hpp>
#include <fovea/camera/projection_slopes.hpp>
#include <fovea/camera/refine_pose.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/levenberg_marquardt.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/match/point_spread.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Which terms of the lens are found; the others stay as they are.
enum class LensTerms : std::uint8_t {
    none,                   ///< 10 unknowns: focal lengths, principal point, pose
    radial,                 ///< 12: k1 and k2 besides
    radial_and_tangential,  ///< 14: p1 and p2 besides
};

/// A camera and a pose, and how well they are known.
template <class Scalar = Real>
struct ViewFit {
    Camera<Scalar> camera;
    Pose<Scalar> pose;
    /// The root of the mean squared distance between where points are seen and where they should be, in px.
    Scalar rms = scalar_of<Scalar>(0);
    /// Standard deviations of the camera's terms; 0 for what was not found.
    Camera<Scalar> deviation{};
};

/// The camera and the pose with the least sum of squared distances in the image.
///
/// Shapes    as many points as pixels: 6 to 2^20, 7 with tangential terms
/// Rounding  down to the last digits of Scalar, see levenberg_marquardt()
/// Errors    size_mismatch; bad_argument for too few or too many; out_of_range if the start has a point
///           behind the camera; degenerate for points on a plane, or where they leave a term open; undecided
///           if the least is not reached
/// Source    levenberg_marquardt() in place of the toolkit's hundreds of turns between a linear camera and a linear
///           lens
template <class Scalar = Real>
constexpr Result<ViewFit<Scalar>> refine_view(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                              const Camera<Scalar>& camera, const Pose<Scalar>& pose,
                                              LensTerms terms);

/// The same from nothing: fit_projection(), decompose(), refine_view().
///
/// Errors  those of the three
template <class Scalar = Real>
constexpr Result<ViewFit<Scalar>> fit_view(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                           LensTerms terms);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The terms in the order of the unknowns, and their columns in ProjectionSlopes.
template <class Scalar>
using CameraTerm = Scalar Camera<Scalar>::*;
template <class Scalar>
inline constexpr CameraTerm<Scalar> view_terms[8] = {
    &Camera<Scalar>::fx, &Camera<Scalar>::fy, &Camera<Scalar>::cx, &Camera<Scalar>::cy,
    &Camera<Scalar>::k1, &Camera<Scalar>::k2, &Camera<Scalar>::p1, &Camera<Scalar>::p2};
inline constexpr int view_columns[8] = {0, 1, 2, 3, 4, 5, 7, 8};
inline constexpr int view_unknowns = 14;

/// Points from their mean and their pixels: what levenberg_marquardt() asks for. Terms that are held keep
/// their place among the unknowns.
template <class Scalar>
class ViewProblem {
public:
    constexpr ViewProblem(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels, int terms)
        : points_(points), pixels_(pixels), means_(points, pixels), terms_(terms) {}

    constexpr Vector<3, Scalar> mean() const {
        return Vector<3, Scalar>(scalar_of<Scalar>(means_.x[0]), scalar_of<Scalar>(means_.x[1]),
                                 scalar_of<Scalar>(means_.x[2]));
    }
    constexpr Status linearise(const CameraView<Scalar>& view,
                               NormalEquations<view_unknowns, Scalar>& equations) const {
        for (std::ptrdiff_t i = 0; i < points_.size(); ++i) {
            const auto seen = project_with_slopes(view.camera, view.pose, place(i));
            if (!seen) return seen.status();
            const Vector<2, Scalar> error = seen->pixel - vector_of<Scalar>(pixels_[i]);
            for (int r = 0; r < 2; ++r) {
                Vector<view_unknowns, Scalar> slopes;
                for (int k = 0; k < terms_; ++k) slopes[k] = seen->camera(r, view_columns[k]);
                for (int k = 0; k < 6; ++k) slopes[8 + k] = seen->pose(r, k);
                equations.add(slopes, error[r]);
            }
        }
        // An equation of its own for each term that is held: that it does not change.
        for (int k = terms_; k < 8; ++k) equations.matrix(k, k) = scalar_of<Scalar>(1);
        return Status::ok;
    }
    constexpr Result<Scalar> cost(const CameraView<Scalar>& view) const {
        Scalar sum = scalar_of<Scalar>(0);
        for (std::ptrdiff_t i = 0; i < points_.size(); ++i) {
            const auto seen = project(view.camera, view.pose, place(i));
            if (!seen) return seen.status();
            const Vector<2, Scalar> error = *seen - vector_of<Scalar>(pixels_[i]);
            for (int r = 0; r < 2; ++r) sum = sum + error[r] * error[r];
        }
        return sum;
    }
    constexpr CameraView<Scalar> moved(CameraView<Scalar> view,
                                       const Vector<view_unknowns, Scalar>& step) const {
        for (int k = 0; k < terms_; ++k) {
            Scalar& term = view.camera.*view_terms<Scalar>[k];
            term = term + step[k];
        }
        Vector<6, Scalar> part;
        for (int k = 0; k < 6; ++k) part[k] = step[8 + k];
        view.pose = fovea::moved(view.pose, part);
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
    int terms_;
};

}  // namespace detail

template <class Scalar>
constexpr Result<ViewFit<Scalar>> refine_view(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                              const Camera<Scalar>& camera, const Pose<Scalar>& pose,
                                              LensTerms terms) {
    const int found_terms = terms == LensTerms::none ? 4 : terms == LensTerms::radial ? 6 : 8;
    const int unknowns = found_terms + 6;
    if (points.size() != pixels.size()) return Status::size_mismatch;
    if (2 * points.size() < unknowns || points.size() < 6 || points.size() > detail::most_space_pairs)
        return Status::bad_argument;
    const Result<PointSpread> spread = spread_of<Scalar>(points);
    if (!spread) return spread.status();
    if (*spread != PointSpread::space) return Status::degenerate;

    const detail::ViewProblem<Scalar> problem(points, pixels, found_terms);
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
    fit.deviation.fx = fit.deviation.fy = scalar_of<Scalar>(0);
    const std::int64_t left_over = 2 * std::int64_t{points.size()} - unknowns;
    for (int k = 0; k < found_terms && left_over > 0; ++k)
        fit.deviation.*detail::view_terms<Scalar>[k] =
            square_root(found->cost / scalar_of<Scalar>(left_over) * (*covariance)(k, k));
    return fit;
}

template <class Scalar>
constexpr Result<ViewFit<Scalar>> fit_view(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                           LensTerms terms) {
    const auto matrix = fit_projection<Scalar>(points, pixels);
    if (!matrix) return matrix.status();
    const auto view = decompose(*matrix);
    if (!view) return view.status();
    return refine_view(points, pixels, view->camera, view->pose, terms);
}

}  // namespace fovea
