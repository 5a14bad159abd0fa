// SPDX-License-Identifier: MIT
//
// Polygons of whole pixels, as contours give them: length, area, and whether they are convex or hold a point.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The greatest distance along x or y between two points of a polygon: that of an image. Coordinates are at
/// most 2^24 in magnitude.
inline constexpr int max_polygon_extent = max_image_side;

/// Whether the last point is joined to the first.
enum class Closure : std::uint8_t { closed, open };

/// The length of a line of any number of points: 1/65536 px.
using PolygonLength = Fixed<std::int64_t, 16>;

/// The length of a polygon.
///
/// Rounding  steps along a row, a column or a diagonal are counted and summed without error; the sum of the
///           diagonals and each other step are rounded to 1/65536 px. One point is of length 0
/// Errors    bad_argument if the points are farther apart than max_polygon_extent
constexpr Result<PolygonLength> polygon_length(Span<const Point> points, Closure closure);

/// Twice the area that a closed polygon encloses, which is a whole number: positive where it runs clockwise
/// on screen. Where it crosses itself, parts that are surrounded twice count twice.
///
/// Units   of the line through the points: a contour encloses less than its region has pixels, by half its
///         points and one
/// Errors  bad_argument if the points are farther apart than max_polygon_extent
/// Source  the shoelace formula
constexpr Result<std::int64_t> doubled_area(Span<const Point> points);

enum class PointPlace : std::uint8_t { outside, on_line, inside };

/// Where a point lies. What a line surrounds twice is outside.
///
/// Errors  bad_argument if polygon and point are farther apart than max_polygon_extent
/// Source  even-odd rule: crossings of a ray to the right, with half-open edges
constexpr Result<PointPlace> place_in_polygon(Span<const Point> points, Point point);

enum class Convexity : std::uint8_t { convex, not_convex };

/// Whether a closed polygon turns one way only, and once around. Repeated points and points on an edge do not
/// matter; points on one line are convex.
///
/// Errors  bad_argument if the points are farther apart than max_polygon_extent
constexpr Result<Convexity> convexity(Span<const Point> points);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// True if differences of coordinates are at most max_polygon_extent, so that products of two of them and
/// their sums fit 32 bits with sign, and products of those fit 64.
constexpr bool polygon_fits(Span<const Point> points) {
    if (points.empty()) return true;
    constexpr int most = 1 << 24;
    Point low = points[0];
    Point high = points[0];
    for (const Point& p : points) {
        low = {minimum(low.x, p.x), minimum(low.y, p.y)};
        high = {maximum(high.x, p.x), maximum(high.y, p.y)};
    }
    return low.x >= -most && low.y >= -most && high.x <= most && high.y <= most &&
           high.x - low.x <= max_polygon_extent && high.y - low.y <= max_polygon_extent;
}

/// (a - o) x (b - o): positive if o, a, b turn clockwise on screen. Below 2^31 in magnitude.
constexpr std::int64_t turn_of(Point o, Point a, Point b) {
    return std::int64_t{a.x - o.x} * (b.y - o.y) - std::int64_t{a.y - o.y} * (b.x - o.x);
}
constexpr std::int64_t square_of_distance(Point a, Point b) {
    return std::int64_t{b.x - a.x} * (b.x - a.x) + std::int64_t{b.y - a.y} * (b.y - a.y);
}

/// Square root to the nearest.
constexpr std::int64_t rounded_root(std::uint64_t value) {
    const std::uint64_t root = isqrt(value);
    return static_cast<std::int64_t>(root + (value - root * root > root ? 1 : 0));
}

/// How often a number changes its sign around a closed sequence, zeros left out.
class SignChanges {
public:
    constexpr void add(int value) {
        const int sign = value > 0 ? 1 : value < 0 ? -1 : 0;
        if (sign == 0) return;
        if (first_ == 0) first_ = sign;
        changes_ += last_ != 0 && sign != last_ ? 1 : 0;
        last_ = sign;
    }
    constexpr int around() const { return changes_ + (first_ != last_ ? 1 : 0); }

private:
    int first_ = 0;
    int last_ = 0;
    int changes_ = 0;
};

}  // namespace detail

constexpr Result<PolygonLength> polygon_length(Span<const Point> points, Closure closure) {
    if (!detail::polygon_fits(points)) return Status::bad_argument;
    std::int64_t straight = 0;
    std::int64_t diagonal = 0;
    std::int64_t other = 0;  // 1/65536 px
    const std::ptrdiff_t count = points.size();
    const std::ptrdiff_t steps = closure == Closure::closed ? count : count - 1;
    for (std::ptrdiff_t i = 0; i < steps; ++i) {
        const Point a = points[i];
        const Point b = points[i + 1 < count ? i + 1 : 0];
        const std::uint32_t dx = magnitude(std::int32_t{b.x - a.x});
        const std::uint32_t dy = magnitude(std::int32_t{b.y - a.y});
        if (dx == 0 || dy == 0)
            straight += dx + dy;
        else if (dx == dy)
            diagonal += dx;
        else
            other += detail::rounded_root(static_cast<std::uint64_t>(detail::square_of_distance(a, b)) << 32);
    }
    constexpr std::int64_t root_of_2 = 1518500250;  // 2^30 times
    return PolygonLength::from_raw((straight << 16) + round_shift(diagonal * root_of_2, 14) + other);
}

constexpr Result<std::int64_t> doubled_area(Span<const Point> points) {
    if (!detail::polygon_fits(points)) return Status::bad_argument;
    // Below 2^31 a point, so that 2^32 of them fit.
    std::int64_t sum = 0;
    for (std::ptrdiff_t i = 2; i < points.size(); ++i)
        sum += detail::turn_of(points[0], points[i - 1], points[i]);
    return sum;
}

constexpr Result<PointPlace> place_in_polygon(Span<const Point> points, Point point) {
    const Point alone[] = {point};
    if (!detail::polygon_fits(points) || !detail::polygon_fits(alone)) return Status::bad_argument;
    bool inside = false;
    for (std::ptrdiff_t i = 0; i < points.size(); ++i) {
        const Point a = points[i];
        const Point b = points[i + 1 < points.size() ? i + 1 : 0];
        if (magnitude(std::int32_t{point.x - a.x}) > max_polygon_extent ||
            magnitude(std::int32_t{point.y - a.y}) > max_polygon_extent)
            return Status::bad_argument;
        const std::int64_t turn = detail::turn_of(a, b, point);
        const bool between = point.x >= minimum(a.x, b.x) && point.x <= maximum(a.x, b.x) &&
                             point.y >= minimum(a.y, b.y) && point.y <= maximum(a.y, b.y);
        if (turn == 0 && between) return PointPlace::on_line;
        if ((a.y <= point.y) != (b.y <= point.y) && (turn > 0) != (b.y <= point.y)) inside = !inside;
    }
    return inside ? PointPlace::inside : PointPlace::outside;
}

constexpr Result<Convexity> convexity(Span<const Point> points) {
    if (!detail::polygon_fits(points)) return Status::bad_argument;
    const std::ptrdiff_t count = points.size();
    bool left = false;
    bool right = false;
    bool back = false;
    detail::SignChanges along_x;
    detail::SignChanges along_y;
    Point before;  // the last step that led anywhere
    for (std::ptrdiff_t n = 0; n < 2 * count; ++n) {
        const Point a = points[n % count];
        const Point b = points[(n + 1) % count];
        const Point step{b.x - a.x, b.y - a.y};
        if (step == Point{}) continue;
        const std::int64_t turn = std::int64_t{before.x} * step.y - std::int64_t{before.y} * step.x;
        const std::int64_t along = std::int64_t{before.x} * step.x + std::int64_t{before.y} * step.y;
        before = step;
        // The first round finds the step before the first; the second one looks.
        if (n < count) continue;
        left = left || turn < 0;
        right = right || turn > 0;
        back = back || (turn == 0 && along < 0);
        along_x.add(step.x);
        along_y.add(step.y);
    }
    if (!left && !right) return Convexity::convex;
    const bool once = along_x.around() <= 2 && along_y.around() <= 2;
    return left != right && !back && once ? Convexity::convex : Convexity::not_convex;
}

}  // namespace fovea
