// SPDX-License-Identifier: MIT
//
// The smallest rectangle around a convex polygon, in any direction.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>
#include <fovea/segment/polygon.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A rectangle that lies in any direction.
struct RotatedRectangle {
    FinePoint centre;
    FinePixel length;  ///< the longer side
    FinePixel width;   ///< the shorter side
    FineAngle axis;    ///< of the longer side, more than -90 up to 90 degrees; of a square 0 to below 90
};

/// The rectangle of the least area that holds all corners.
///
/// Shapes    the corners as convex_hull() lists them; one corner or two give a rectangle without area
/// Units     of the corners: around the centres of pixels it is smaller by one pixel than around the pixels
/// Rounding  which rectangle is decided exactly, of equal ones the first; its numbers to 1/65536 px. Sides
///           above 32767 px, which the diagonal of the largest image has, are held there
/// Errors    not_found if there are no corners; bad_argument if they are farther apart than
///           max_polygon_extent or no convex polygon clockwise on screen
/// Source    one side lies on an edge of the hull: Freeman and Shapira, "Determining the minimum-area
///           encasing rectangle for an arbitrary closed curve", 1975; rotating calipers after Toussaint, 1983
constexpr Result<RotatedRectangle> minimum_area_rectangle(Span<const Point> hull);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A rectangle with a side on an edge: the edge, and how far the hull reaches along and across it, both times
/// the edge's length.
struct EdgeRectangle {
    Point corner;
    Point edge;
    std::int64_t first = 0, last = 0;  // along, at most 2^31 in magnitude
    std::int64_t across = 0;           // at most 2^31

    constexpr std::int64_t square() const {
        return std::int64_t{edge.x} * edge.x + std::int64_t{edge.y} * edge.y;
    }
    /// Area times square(): below 2^63.
    constexpr std::int64_t area() const { return (last - first) * across; }
    constexpr bool smaller_than(const EdgeRectangle& other) const {
        return Int128::product(area(), other.square()) < Int128::product(other.area(), square());
    }
};

constexpr RotatedRectangle rectangle_of(const EdgeRectangle& r) {
    // The length of the edge with 31 bits: 2^shift times.
    const int shift = ((leading_zeros(static_cast<std::uint64_t>(r.square())) - 1) & ~1) / 2;
    const std::int64_t edge = rounded_root(static_cast<std::uint64_t>(r.square()) << 2 * shift);
    const auto length_of = [&](std::int64_t times_edge) {
        return FinePixel::from_raw(saturate_cast<std::int32_t>(
            multiply_divide(times_edge, std::int64_t{FinePixel::one} << shift, edge)));
    };
    // Twice the way from the corner to the centre, times the square of the edge.
    const std::int64_t along = r.first + r.last;
    const auto coordinate = [&](int corner, std::int64_t way) {
        return FinePixel::from_raw(saturate_cast<std::int32_t>(
            std::int64_t{corner} * FinePixel::one + multiply_divide(way, FinePixel::one / 2, r.square())));
    };
    RotatedRectangle result;
    result.centre.x = coordinate(r.corner.x, along * r.edge.x - r.across * r.edge.y);
    result.centre.y = coordinate(r.corner.y, along * r.edge.y + r.across * r.edge.x);
    result.length = length_of(r.last - r.first);
    result.width = length_of(r.across);
    std::uint32_t axis = angle_of(std::int32_t{r.edge.x}, std::int32_t{r.edge.y}).raw();
    const std::uint32_t quarter = FineAngle::quarter_turn().raw();
    if (r.across > r.last - r.first) {
        const FinePixel swap = result.length;
        result.length = result.width;
        result.width = swap;
        axis += quarter;
    }
    if (r.across == r.last - r.first)
        axis %= quarter;
    else if (axis > quarter && axis <= 3 * quarter)
        axis += 2 * quarter;
    result.axis = FineAngle::from_raw(axis);
    return result;
}

constexpr bool turns_clockwise(Span<const Point> hull) {
    const std::ptrdiff_t count = hull.size();
    for (std::ptrdiff_t i = 0; i < count; ++i)
        if (turn_of(hull[i], hull[(i + 1) % count], hull[(i + 2) % count]) <= 0) return false;
    return true;
}

}  // namespace detail

constexpr Result<RotatedRectangle> minimum_area_rectangle(Span<const Point> hull) {
    if (hull.empty()) return Status::not_found;
    if (!detail::polygon_fits(hull)) return Status::bad_argument;
    if (hull.size() == 1 || (hull.size() == 2 && hull[0] == hull[1])) {
        RotatedRectangle point;
        point.centre = {
            FinePixel::from_raw(saturate_cast<std::int32_t>(std::int64_t{hull[0].x} * FinePixel::one)),
            FinePixel::from_raw(saturate_cast<std::int32_t>(std::int64_t{hull[0].y} * FinePixel::one))};
        return point;
    }
    const auto edge_from = [&](std::ptrdiff_t i) {
        const Point a = hull[i];
        const Point b = hull[i + 1 < hull.size() ? i + 1 : 0];
        return Point{b.x - a.x, b.y - a.y};
    };
    if (hull.size() == 2) {
        detail::EdgeRectangle line;
        line.corner = hull[0];
        line.edge = edge_from(0);
        line.last = line.square();
        return detail::rectangle_of(line);
    }
    if (!detail::turns_clockwise(hull)) return Status::bad_argument;

    const std::ptrdiff_t count = hull.size();
    const auto along = [](Point a, Point b) { return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y; };
    const auto across = [](Point a, Point b) { return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x; };
    const auto next = [&](std::ptrdiff_t i) { return i + 1 < count ? i + 1 : 0; };
    // The corners that are farthest ahead, across and behind. They go around once with the edge; the steps of
    // each are counted, for a polygon that winds around twice.
    std::ptrdiff_t ahead = 1;
    std::ptrdiff_t beyond = 1;
    std::ptrdiff_t behind = 1;
    detail::EdgeRectangle best;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const Point edge = edge_from(i);
        for (std::ptrdiff_t n = 0; n < count && along(edge, edge_from(ahead)) > 0; ++n) ahead = next(ahead);
        if (i == 0) beyond = ahead;
        for (std::ptrdiff_t n = 0; n < count && across(edge, edge_from(beyond)) > 0; ++n)
            beyond = next(beyond);
        if (i == 0) behind = beyond;
        for (std::ptrdiff_t n = 0; n < count && along(edge, edge_from(behind)) < 0; ++n)
            behind = next(behind);
        const auto from_corner = [&](std::ptrdiff_t k) {
            return Point{hull[k].x - hull[i].x, hull[k].y - hull[i].y};
        };
        detail::EdgeRectangle rectangle;
        rectangle.corner = hull[i];
        rectangle.edge = edge;
        rectangle.first = along(edge, from_corner(behind));
        rectangle.last = along(edge, from_corner(ahead));
        rectangle.across = across(edge, from_corner(beyond));
        if (i == 0 || rectangle.smaller_than(best)) best = rectangle;
    }
    return detail::rectangle_of(best);
}

}  // namespace fovea
