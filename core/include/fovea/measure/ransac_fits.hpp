// SPDX-License-Identifier: MIT
//
// Lines and circles of the points that lie within a tolerance, also where most points belong to neither.
#pragma once

#include <cstddef>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/match/ransac.hpp>
#include <fovea/measure/consensus.hpp>
#include <fovea/measure/fit_circle.hpp>
#include <fovea/measure/fit_line.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The line with most points within tolerance: through two of them, then fitted to those within, twice.
///
/// Shapes  2..max_fit_points points
/// Errors  bad_argument above max_fit_points, for a tolerance that is not above 0 or options out of range;
///         not_found if fewer than options.enough lie within; degenerate as fit_line()
inline Result<LineFit> fit_line_ransac(Span<const FinePoint> points, FinePixel tolerance,
                                       const RansacOptions& options = {});

/// The circle with most points within tolerance: through three of them, then fitted to those within, twice.
///
/// Shapes  3..max_fit_points points
/// Errors  as above; degenerate as fit_circle()
inline Result<CircleFit> fit_circle_ransac(Span<const FinePoint> points, FinePixel tolerance,
                                           const RansacOptions& options = {});

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr Line model_of(const LineFit& fit) { return fit.line; }
constexpr Circle model_of(const CircleFit& fit) { return fit.circle; }

template <int SampleSize, class Model, class Fit, class Make, class Refit>
Result<Fit> fit_ransac(Span<const FinePoint> points, FinePixel tolerance, const RansacOptions& options,
                       Make make, Refit refit) {
    if (points.size() > max_fit_points || tolerance.raw() <= 0) return Status::bad_argument;
    const auto within = [tolerance](const Model& model, FinePoint point) {
        return without_sign(distance_from(model, point)) <= tolerance;
    };
    const auto best = ransac<SampleSize, Model>(
        points.size(), options, make,
        [&](const Model& model, std::ptrdiff_t i) { return within(model, points[i]); });
    if (!best) return best.status();
    Model model = best->model;
    Result<Fit> fit = Status::degenerate;
    for (int round = 0; round < 2; ++round) {
        fit = refit(model, [&](FinePoint point) { return within(model, point); });
        if (!fit) return fit;
        model = model_of(*fit);
    }
    return fit;
}

}  // namespace detail

inline Result<LineFit> fit_line_ransac(Span<const FinePoint> points, FinePixel tolerance,
                                       const RansacOptions& options) {
    return detail::fit_ransac<2, Line, LineFit>(
        points, tolerance, options,
        [points](const std::ptrdiff_t(&chosen)[2]) {
            return detail::line_through(points[chosen[0]], points[chosen[1]]);
        },
        [points](const Line&, auto keep) { return detail::fit_line_to(points, keep); });
}

inline Result<CircleFit> fit_circle_ransac(Span<const FinePoint> points, FinePixel tolerance,
                                           const RansacOptions& options) {
    return detail::fit_ransac<3, Circle, CircleFit>(
        points, tolerance, options,
        [points](const std::ptrdiff_t(&chosen)[3]) {
            return circle_through(points[chosen[0]], points[chosen[1]], points[chosen[2]]);
        },
        [points](const Circle& start, auto keep) { return detail::fit_circle_to(points, start, keep); });
}

}  // namespace fovea
