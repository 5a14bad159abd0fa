// SPDX-License-Identifier: MIT
//
// The convex hull of points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/segment/polygon.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that convex_hull() of count points needs.
constexpr std::int64_t convex_hull_scratch(std::int64_t count) { return arena_bytes<Point>(3 * count + 1); }

/// The corners of the smallest convex polygon that holds all points.
///
/// Shapes   any number of points in any order, some of them equal
/// Order    clockwise on screen from the leftmost, of several the uppermost; no corner lies on the line of
///          its neighbours. Equal points give one corner, points on a line its two ends
/// Scratch  convex_hull_scratch(points.size()) bytes, undefined afterwards
/// Cost     with the count where the points are as many as the columns they reach over, as those of a contour
///          are; else n log n
/// Errors   not_found if there are no points; bad_argument if they are farther apart than max_polygon_extent;
///          scratch_too_small; capacity_exceeded, with the list as it was
/// Source   Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979, over the ends of
///          each column where there is room for them
inline Status convex_hull(Span<const Point> points, Span<std::uint8_t> scratch, ListView<Point> hull);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Corners so far; a new one drops those that are not left of the way to it.
class HullChain {
public:
    explicit HullChain(Span<Point> room) : points_(room) {}

    int size() const { return size_; }
    /// Corners that are there stay: a new chain begins at the last of them.
    void keep() { kept_ = size_ - 1; }
    void add(Point p) {
        if (size_ > 0 && points_[size_ - 1] == p) return;
        while (size_ - kept_ >= 2 && turn_of(points_[size_ - 2], points_[size_ - 1], p) <= 0) --size_;
        points_[size_++] = p;
    }
    Span<Point> corners() const { return points_.first(size_); }

private:
    Span<Point> points_;
    int size_ = 0;
    int kept_ = 0;
};

/// The uppermost and lowest point of every column, as x and y of a point.
inline void hull_of_columns(Span<const Point> points, int left, Span<Point> columns, HullChain& chain) {
    constexpr int most = std::numeric_limits<int>::max();
    for (Point& column : columns) column = {most, -most};
    for (const Point& p : points) {
        Point& column = columns[p.x - left];
        column = {minimum(column.x, p.y), maximum(column.y, p.y)};
    }
    const auto last = static_cast<int>(columns.size()) - 1;
    for (int x = 0; x <= last; ++x)
        if (columns[x].x != most) chain.add({left + x, columns[x].x});
    chain.add({left + last, columns[last].y});
    chain.keep();
    for (int x = last; x >= 0; --x)
        if (columns[x].x != most) chain.add({left + x, columns[x].y});
    chain.add({left, columns[0].x});
}

inline void hull_of_sorted(Span<const Point> points, Span<Point> sorted, HullChain& chain) {
    for (std::ptrdiff_t i = 0; i < points.size(); ++i) sorted[i] = points[i];
    sort(sorted, [](const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    for (const Point& p : sorted) chain.add(p);
    chain.keep();
    for (std::ptrdiff_t i = sorted.size() - 1; i >= 0; --i) chain.add(sorted[i]);
}

}  // namespace detail

inline Status convex_hull(Span<const Point> points, Span<std::uint8_t> scratch, ListView<Point> hull) {
    if (points.empty()) return Status::not_found;
    if (!detail::polygon_fits(points)) return Status::bad_argument;
    if (scratch.size() < convex_hull_scratch(points.size())) return Status::scratch_too_small;
    int left = points[0].x;
    int right = points[0].x;
    for (const Point& p : points) {
        left = minimum(left, p.x);
        right = maximum(right, p.x);
    }
    Arena arena(scratch);
    detail::HullChain chain(arena.take<Point>(2 * points.size() + 1));
    const std::ptrdiff_t columns = right - left + 1;
    if (columns <= points.size())
        detail::hull_of_columns(points, left, arena.take<Point>(columns), chain);
    else
        detail::hull_of_sorted(points, arena.take<Point>(points.size()), chain);
    // Both ends of the way around are the first corner, but for a single one.
    const int count = maximum(chain.size() - 1, 1);
    if (count > hull.capacity()) return Status::capacity_exceeded;
    hull.clear();
    for (int i = 0; i < count; ++i) static_cast<void>(hull.push(chain.corners()[i]));
    return Status::ok;
}

}  // namespace fovea
