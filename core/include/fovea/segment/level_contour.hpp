// SPDX-License-Identifier: MIT
//
// Level contours: the line around a region on which brightness crosses the threshold, between the pixels.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/segment/connected_components.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Which pixels belong: those at or above a grey level, or those below it.
struct LevelSet {
    Gray8 level = 128;
    bool below = false;

    constexpr bool contains(Gray8 pixel) const { return (pixel < level) == below; }
    constexpr LevelSet complement() const { return {level, !below}; }
};

/// Walks once around a region, clockwise on screen, and shows every point where the line between two
/// neighbouring pixels, one inside and one outside, crosses the level.
///
/// Shapes    src 1x1 or larger. start belongs to the region and the pixel above it does not: Region::first is
///           such a pixel, and Hole::first with the complement of the set and the other connectivity
/// Units     visit(FinePoint) for every point; the last one is followed by the first
/// Rounding  to 1/65536 px, down, by linear interpolation; the level lies half a grey level below `level`
/// Border    beyond the image nothing belongs; there the point is half a pixel outside
/// Errors    empty_image; out_of_range if start is outside the image; bad_argument if it is no start
/// Source    crack following; Rosenfeld and Kak, "Digital Picture Processing", 1982, vol. 2, sec. 11.2.2.
///           With the points joined it is the contour of marching squares
template <class Visit>
Status trace_level_contour(ImageView<const Gray8> src, LevelSet set, Connectivity connectivity, Point start,
                           Visit visit);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A side of a pixel, 0 upper, 1 right, 2 lower, 3 left, seen as the step across it.
constexpr Point step_across(int side) { return {side % 2 == 0 ? 0 : 2 - side, side % 2 == 0 ? side - 1 : 0}; }
constexpr Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }

/// Where brightness crosses the level between a pixel inside and its neighbour outside.
inline FinePoint crossing(ImageView<const Gray8> src, LevelSet set, Point inside, Point step) {
    const Point outside = inside + step;
    std::int32_t way = FinePixel::one / 2;
    if (src.contains(outside)) {
        const std::int32_t a = src(inside.x, inside.y);
        const std::int32_t b = src(outside.x, outside.y);
        const std::int32_t limit = 2 * set.level - 1;            // twice the level between the two classes
        way = (2 * a - limit) * (FinePixel::one / 2) / (a - b);  // both factors have the same sign
    }
    return {FinePixel::from_raw(inside.x * FinePixel::one + step.x * way),
            FinePixel::from_raw(inside.y * FinePixel::one + step.y * way)};
}

}  // namespace detail

template <class Visit>
Status trace_level_contour(ImageView<const Gray8> src, LevelSet set, Connectivity connectivity, Point start,
                           Visit visit) {
    using detail::operator+;
    if (src.empty()) return Status::empty_image;
    if (!src.contains(start)) return Status::out_of_range;
    const auto belongs = [&](Point p) { return src.contains(p) && set.contains(src(p.x, p.y)); };
    if (!belongs(start) || belongs({start.x, start.y - 1})) return Status::bad_argument;

    Point pixel = start;
    int side = 0;
    do {
        const Point out = detail::step_across(side);
        visit(detail::crossing(src, set, pixel, out));
        // Ahead along the crack, clockwise, there may be a pixel beside it and one on the other side.
        const Point ahead = pixel + detail::step_across((side + 1) % 4);
        const Point beyond = ahead + out;
        const bool next = belongs(ahead);
        if ((next || connectivity == Connectivity::eight) && belongs(beyond)) {
            pixel = beyond;
            side = (side + 3) % 4;
        } else if (next) {
            pixel = ahead;
        } else {
            side = (side + 1) % 4;
        }
    } while (pixel != start || side != 0);
    return Status::ok;
}

}  // namespace fovea
