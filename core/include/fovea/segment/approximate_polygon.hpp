// SPDX-License-Identifier: MIT
//
// Fewer corners for a line or a contour, none of whose points is left farther away than a tolerance.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/segment/polygon.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that approximate_polygon() of count points needs.
constexpr std::int64_t approximate_polygon_scratch(std::int64_t count) { return count; }

/// Keeps those points of a line that the others lie close to: every point that goes is at most tolerance away
/// from the piece that replaces it.
///
/// A closed line is cut in two at its first point and the one farthest from it; both stay.
///
/// Units    tolerance in 1/256 px, 0 to max_polygon_extent; 0 drops only points on a straight piece
/// Order    that of the points; of points equally far from a piece the first stays
/// Scratch  approximate_polygon_scratch(points.size()) bytes, undefined afterwards
/// Cost     n log n as a rule; n^2 for a spiral, where every piece loses one point at its end. The stack is
///          bounded: the shorter part is done first
/// Errors   not_found if there are no points; bad_argument for a tolerance out of range, or points farther
///          apart than max_polygon_extent; scratch_too_small; capacity_exceeded, with the list as it was
/// Source   Ramer, "An iterative procedure for the polygonal approximation of plane curves", 1972; Douglas
///          and Peucker, 1973. Distances are from the piece, not from the line through it; they are compared
///          exactly
inline Status approximate_polygon(Span<const Point> points, Closure closure, SubPixel tolerance,
                                  Span<std::uint8_t> scratch, ListView<Point> corners);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A stretch of points; end may be the count, which stands for the first point of a closed line.
struct Stretch {
    std::ptrdiff_t first;
    std::ptrdiff_t end;
};

/// The point of a stretch that is farthest from the piece between its ends, if it is farther than the
/// tolerance; else first.
inline std::ptrdiff_t farthest_in(Span<const Point> points, Stretch stretch, SubPixel tolerance) {
    const Point a = points[stretch.first];
    const Point b = points[stretch.end < points.size() ? stretch.end : 0];
    const std::int64_t dx = b.x - a.x;
    const std::int64_t dy = b.y - a.y;
    const std::int64_t square = dx * dx + dy * dy;  // below 2^31
    // Squares of distances times square, below 2^62; as they are where both ends are one point.
    std::int64_t greatest = 0;
    std::ptrdiff_t farthest = stretch.first;
    const auto look = [&](std::ptrdiff_t i, std::int64_t distance) {
        if (distance <= greatest) return;
        greatest = distance;
        farthest = i;
    };
    if (square == 0) {
        for (std::ptrdiff_t i = stretch.first + 1; i < stretch.end; ++i)
            look(i, square_of_distance(a, points[i]));
    } else {
        for (std::ptrdiff_t i = stretch.first + 1; i < stretch.end; ++i) {
            const std::int64_t px = points[i].x - a.x;
            const std::int64_t py = points[i].y - a.y;
            const std::int64_t along = dx * px + dy * py;
            const std::int64_t across = dx * py - dy * px;
            if (along >= 0 && along <= square)
                look(i, across * across);
            else
                look(i, square * square_of_distance(along < 0 ? a : b, points[i]));
        }
    }
    const std::int64_t limit = std::int64_t{tolerance.raw()} * tolerance.raw();  // 1/65536 px^2, below 2^46
    const bool too_far =
        Int128::product(limit, maximum<std::int64_t>(square, 1)) < Int128::product(greatest, 65536);
    return too_far ? farthest : stretch.first;
}

/// Marks the points that stay between the ends of a stretch.
inline void mark_corners(Span<const Point> points, Stretch whole, SubPixel tolerance,
                         Span<std::uint8_t> marks) {
    // A stretch that waits is at least as long as the one that is worked on, so each is at most half of the
    // one below it.
    Stretch waiting[32];
    int count = 0;
    Stretch stretch = whole;
    for (;;) {
        const std::ptrdiff_t corner = farthest_in(points, stretch, tolerance);
        if (corner != stretch.first) {
            marks[corner] = 1;
            const Stretch before{stretch.first, corner};
            const Stretch behind{corner, stretch.end};
            const bool before_is_short = corner - stretch.first <= stretch.end - corner;
            waiting[count++] = before_is_short ? behind : before;
            stretch = before_is_short ? before : behind;
        } else if (count > 0) {
            stretch = waiting[--count];
        } else {
            return;
        }
    }
}

}  // namespace detail

inline Status approximate_polygon(Span<const Point> points, Closure closure, SubPixel tolerance,
                                  Span<std::uint8_t> scratch, ListView<Point> corners) {
    if (points.empty()) return Status::not_found;
    if (tolerance.raw() < 0 || tolerance > SubPixel::from_int(max_polygon_extent) ||
        !detail::polygon_fits(points))
        return Status::bad_argument;
    const std::ptrdiff_t count = points.size();
    if (scratch.size() < approximate_polygon_scratch(count)) return Status::scratch_too_small;
    const Span<std::uint8_t> marks = scratch.first(count);
    for (std::uint8_t& mark : marks) mark = 0;
    marks[0] = 1;
    if (closure == Closure::closed) {
        std::ptrdiff_t opposite = 0;
        for (std::ptrdiff_t i = 1; i < count; ++i)
            if (detail::square_of_distance(points[0], points[i]) >
                detail::square_of_distance(points[0], points[opposite]))
                opposite = i;
        if (opposite != 0) {
            marks[opposite] = 1;
            detail::mark_corners(points, {0, opposite}, tolerance, marks);
            detail::mark_corners(points, {opposite, count}, tolerance, marks);
        }
    } else {
        marks[count - 1] = 1;
        detail::mark_corners(points, {0, count - 1}, tolerance, marks);
    }
    std::ptrdiff_t kept = 0;
    for (const std::uint8_t mark : marks) kept += mark;
    if (kept > corners.capacity()) return Status::capacity_exceeded;
    corners.clear();
    for (std::ptrdiff_t i = 0; i < count; ++i)
        if (marks[i] != 0) static_cast<void>(corners.push(points[i]));
    return Status::ok;
}

}  // namespace fovea
