// SPDX-License-Identifier: MIT
//
// The pose in which an object is seen best by a known camera, from one that is not far off. Book sec. 2.2.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/calibration.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/camera/projection_derivatives.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/levenberg_marquardt.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/match/point_spread.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A pose and how well it is known.
template <class Scalar = Real>
struct PoseFit {
    Pose<Scalar> pose;
    /// The root of the mean squared distance between where points are seen and where they should be, in px.
    Scalar rms = scalar_of<Scalar>(0);
    /// Standard deviations: of a turn of the object about its mean, in radians about the axes of the camera,
    /// and of the mean's place. 0 for three points, which leave nothing over to tell by.
    Vector<3, Scalar> turn_deviation;
    Vector<3, Scalar> place_deviation;
    /// How many points it rests on.
    int used = 0;
};

/// The pose with the least sum of squared distances in the image, with the lens.
///
/// Shapes    as many points as pixels: 3 to 2^20
/// Rounding  down to the last digits of Scalar, see levenberg_marquardt()
/// Errors    size_mismatch; bad_argument for fewer than 3 or more than 2^20; out_of_range if the start has a
///           point behind the camera; degenerate for points on a line; undecided if the least is not reached
/// Source    levenberg_marquardt() over a turn about the mean of the points and its place
template <class Scalar = Real>
constexpr Result<PoseFit<Scalar>> refine_pose(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                              const Camera<Scalar>& camera, const Pose<Scalar>& start);
/// The same for places of a plane, whose z is 0.
template <class Scalar = Real>
constexpr Result<PoseFit<Scalar>> refine_pose(Span<const PlanePoint> points, Span<const SubPixelPoint> pixels,
                                              const Camera<Scalar>& camera, const Pose<Scalar>& start);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Points from their mean, their pixels, and the camera: what levenberg_marquardt() asks for.
template <class Scalar, class Point, class Use>
class PoseProblem {
public:
    constexpr PoseProblem(Span<const Point> points, Span<const SubPixelPoint> pixels,
                          const Camera<Scalar>& camera, Use use)
        : points_(points), pixels_(pixels), camera_(camera), use_(use) {
        std::int64_t sums[3] = {};
        for (std::ptrdiff_t i = 0; i < points.size(); ++i) {
            if (!use(i)) continue;
            ++used_;
            const SpacePoint point = in_space(points[i]);
            sums[0] += point.x;
            sums[1] += point.y;
            sums[2] += point.z;
        }
        for (int k = 0; k < 3; ++k) mean_[k] = floor_divide(sums[k], std::int64_t{maximum(used_, 1)});
    }

    constexpr int used() const { return used_; }
    constexpr Vector<3, Scalar> mean() const {
        return Vector<3, Scalar>(scalar_of<Scalar>(mean_[0]), scalar_of<Scalar>(mean_[1]),
                                 scalar_of<Scalar>(mean_[2]));
    }
    constexpr Status linearise(const Pose<Scalar>& pose, NormalEquations<6, Scalar>& equations) const {
        for (std::ptrdiff_t i = 0; i < points_.size(); ++i) {
            if (!use_(i)) continue;
            const Vector<3, Scalar> arm = pose.rotation * place(i);
            ProjectionDerivatives<Scalar> seen;
            const Status status = project_derivatives(camera_, arm + pose.translation, seen);
            if (status != Status::ok) return status;
            const Vector<2, Scalar> error = seen.pixel - pixel_seen<Scalar>(pixels_[i]);
            for (int r = 0; r < 2; ++r) equations.add(by_pose(seen.by_point.row(r), arm), error[r]);
        }
        return Status::ok;
    }
    constexpr Result<Scalar> cost(const Pose<Scalar>& pose) const {
        Scalar sum = scalar_of<Scalar>(0);
        for (std::ptrdiff_t i = 0; i < points_.size(); ++i) {
            if (!use_(i)) continue;
            const auto seen = project(camera_, pose, place(i));
            if (!seen) return seen.status();
            const Vector<2, Scalar> error = *seen - pixel_seen<Scalar>(pixels_[i]);
            for (int r = 0; r < 2; ++r) sum = sum + error[r] * error[r];
        }
        return sum;
    }
    constexpr Pose<Scalar> moved(const Pose<Scalar>& pose, const Vector<6, Scalar>& step) const {
        return fovea::moved(pose, step);
    }

private:
    constexpr Vector<3, Scalar> place(std::ptrdiff_t index) const {
        const SpacePoint point = in_space(points_[index]);
        return Vector<3, Scalar>(scalar_of<Scalar>(point.x - mean_[0]), scalar_of<Scalar>(point.y - mean_[1]),
                                 scalar_of<Scalar>(point.z - mean_[2]));
    }

    Span<const Point> points_;
    Span<const SubPixelPoint> pixels_;
    const Camera<Scalar>& camera_;
    Use use_;
    std::int64_t mean_[3] = {};
    int used_ = 0;
};

/// refine_pose() over the pairs for which use(index) holds.
template <class Scalar, class Point, class Use>
constexpr Result<PoseFit<Scalar>> refine_pose_to(Span<const Point> points, Span<const SubPixelPoint> pixels,
                                                 const Camera<Scalar>& camera, const Pose<Scalar>& start,
                                                 Use use) {
    const PoseProblem<Scalar, Point, Use> problem(points, pixels, camera, use);
    if (problem.used() < 3) return Status::bad_argument;
    Pose<Scalar> pose{start.rotation, start(problem.mean())};
    const auto found = levenberg_marquardt<6, Scalar>(problem, pose);
    if (!found) return found.status();
    if (!found->converged) return Status::undecided;
    NormalEquations<6, Scalar> equations;
    const Status status = problem.linearise(pose, equations);
    if (status != Status::ok) return status;
    const auto covariance = equations.inverse();
    if (!covariance) return covariance.status();

    PoseFit<Scalar> fit;
    fit.pose = {pose.rotation, pose.translation - pose.rotation * problem.mean()};
    fit.used = problem.used();
    fit.rms = square_root(found->cost / scalar_of<Scalar>(fit.used));
    if (fit.used == 3) return fit;
    const Scalar variance = found->cost / scalar_of<Scalar>(2 * fit.used - 6);
    for (int k = 0; k < 3; ++k) {
        fit.turn_deviation[k] = square_root(variance * (*covariance)(k, k));
        fit.place_deviation[k] = square_root(variance * (*covariance)(3 + k, 3 + k));
    }
    return fit;
}

/// refine_pose(), of either kind of points.
template <class Scalar, class Point>
constexpr Result<PoseFit<Scalar>> refine_pose_of(Span<const Point> points, Span<const SubPixelPoint> pixels,
                                                 const Camera<Scalar>& camera, const Pose<Scalar>& start) {
    if (points.size() != pixels.size()) return Status::size_mismatch;
    if (points.size() < 3 || points.size() > std::ptrdiff_t{1} << 20) return Status::bad_argument;
    const Result<PointSpread> spread = spread_of<Scalar>(points);
    if (!spread) return spread.status();
    if (*spread == PointSpread::point || *spread == PointSpread::line) return Status::degenerate;
    return refine_pose_to(points, pixels, camera, start, [](std::ptrdiff_t) { return true; });
}

}  // namespace detail

template <class Scalar>
constexpr Result<PoseFit<Scalar>> refine_pose(Span<const SpacePoint> points, Span<const SubPixelPoint> pixels,
                                              const Camera<Scalar>& camera, const Pose<Scalar>& start) {
    return detail::refine_pose_of(points, pixels, camera, start);
}
template <class Scalar>
constexpr Result<PoseFit<Scalar>> refine_pose(Span<const PlanePoint> points, Span<const SubPixelPoint> pixels,
                                              const Camera<Scalar>& camera, const Pose<Scalar>& start) {
    return detail::refine_pose_of(points, pixels, camera, start);
}

}  // namespace fovea
