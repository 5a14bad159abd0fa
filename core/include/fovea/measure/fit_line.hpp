// SPDX-License-Identifier: MIT
//
// Straight lines through measured points.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/measure/consensus.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A straight line through a point. direction is more than -90 up to 90 degrees when it was fitted.
struct Line {
    FinePoint point;
    FineAngle direction;
};

/// How far a point is from a line: positive on the side that direction turns to, clockwise on screen.
constexpr FinePixel distance_from(const Line& line, FinePoint point);

/// A fitted line, the root of the mean squared distance, and how many points it rests on.
struct LineFit {
    Line line;
    FinePixel rms;
    int used = 0;
};

/// The line with the least sum of squared distances.
///
/// Shapes    2..max_fit_points points
/// Rounding  sums are exact for points within 1024 px of their centre, and to a relative 2^-26 beyond; point
///           is the centre of the points
/// Errors    degenerate for fewer than two points, for points that are all alike or prefer no direction;
///           bad_argument above max_fit_points
/// Source    total least squares; Pearson, "On Lines and Planes of Closest Fit", 1901
constexpr Result<LineFit> fit_line(Span<const FinePoint> points);

/// The same for the points that a line through most of them agrees with, whatever the others are.
///
/// Scratch  one element a point, undefined afterwards
/// Errors   also scratch_too_small
/// Source   least_median(), then two fits to the points within its limit
inline Result<LineFit> fit_line_robust(Span<const FinePoint> points, Span<FinePixel> scratch);

// ---- Implementation ---------------------------------------------------------------

constexpr FinePixel distance_from(const Line& line, FinePoint point) {
    const UnitVector along = unit_vector(line.direction);
    const std::int64_t x = std::int64_t{point.x.raw()} - line.point.x.raw();
    const std::int64_t y = std::int64_t{point.y.raw()} - line.point.y.raw();
    return FinePixel::from_raw(
        saturate_cast<std::int32_t>(round_shift(y * along.x.raw() - x * along.y.raw(), 30)));
}

namespace detail {

/// Errors  degenerate for one and the same point
constexpr Result<Line> line_through(FinePoint a, FinePoint b) {
    if (a == b) return Status::degenerate;
    return Line{a, angle_of(std::int64_t{b.x.raw()} - a.x.raw(), std::int64_t{b.y.raw()} - a.y.raw())};
}

/// fit_line() over the points for which keep(point) holds.
template <class Keep>
constexpr Result<LineFit> fit_line_to(Span<const FinePoint> points, Keep keep) {
    std::int64_t count = 0;
    std::int64_t sum_x = 0;
    std::int64_t sum_y = 0;
    for (const FinePoint point : points) {
        if (!keep(point)) continue;
        ++count;
        sum_x += point.x.raw();
        sum_y += point.y.raw();
    }
    if (count < 2) return Status::degenerate;
    const std::int64_t x = round_divide(sum_x, count);
    const std::int64_t y = round_divide(sum_y, count);

    // Sides of 26 bits give squares of 52 and sums over 1024 points of 62.
    std::uint64_t widest = 0;
    for (const FinePoint point : points)
        if (keep(point)) widest |= magnitude(point.x.raw() - x) | magnitude(point.y.raw() - y);
    const int drop = maximum(38 - leading_zeros(widest), 0);
    std::int64_t uu = 0;
    std::int64_t uv = 0;
    std::int64_t vv = 0;
    for (const FinePoint point : points) {
        if (!keep(point)) continue;
        const std::int64_t u = round_shift(point.x.raw() - x, drop);
        const std::int64_t v = round_shift(point.y.raw() - y, drop);
        uu += u * u;
        uv += u * v;
        vv += v * v;
    }
    if (uu == vv && uv == 0) return Status::degenerate;

    LineFit fit;
    const std::uint32_t half = angle_of(uu - vv, 2 * uv).raw() >> 1;
    fit.line.direction =
        FineAngle::from_raw(half > FineAngle::quarter_turn().raw() ? half + 0x80000000u : half);
    fit.line.point = {FinePixel::from_raw(static_cast<std::int32_t>(x)),
                      FinePixel::from_raw(static_cast<std::int32_t>(y))};
    fit.used = static_cast<int>(count);
    std::uint64_t squares = 0;
    for (const FinePoint point : points) {
        if (!keep(point)) continue;
        const std::int64_t distance = distance_from(fit.line, point).raw() >> drop;
        squares += static_cast<std::uint64_t>(distance * distance);
    }
    fit.rms = FinePixel::from_raw(saturate_cast<std::int32_t>(
        std::int64_t{isqrt(squares / static_cast<std::uint64_t>(count))} << drop));
    return fit;
}

}  // namespace detail

constexpr Result<LineFit> fit_line(Span<const FinePoint> points) {
    if (points.size() > max_fit_points) return Status::bad_argument;
    return detail::fit_line_to(points, [](FinePoint) { return true; });
}

inline Result<LineFit> fit_line_robust(Span<const FinePoint> points, Span<FinePixel> scratch) {
    if (points.size() > max_fit_points) return Status::bad_argument;
    const auto through = [](Span<const FinePoint> two) { return detail::line_through(two[0], two[1]); };
    const auto distance = [](const Line& line, FinePoint point) {
        return detail::without_sign(distance_from(line, point));
    };
    const auto start = least_median<2, Line>(points, through, distance, scratch);
    if (!start) return start.status();
    Result<LineFit> fit = LineFit{start->model, FinePixel(), 0};
    for (int round = 0; round < 2 && fit; ++round) {
        const Line line = fit->line;
        fit = detail::fit_line_to(points,
                                  [&](FinePoint point) { return distance(line, point) <= start->limit; });
    }
    return fit;
}

}  // namespace fovea
