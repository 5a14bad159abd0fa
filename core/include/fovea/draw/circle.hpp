// SPDX-License-Identifier: MIT
//
// Circles and discs.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/run.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The largest radius of a circle.
inline constexpr int max_circle_radius = max_draw_coordinate;

/// The pixels nearest to a circle: along the axis on which a pixel is farther from centre, it is less than
/// half a pixel off the circle. The outline has no gaps and the eight symmetries of a square. Radius 0 is a
/// point.
///
/// Shapes    any image, any centre; radius 0..max_circle_radius; thickness 1..max_line_thickness
/// Units     radius and thickness in px. A thick circle reaches from the outer rim of the outline of radius
///           + (thickness - 1) / 2 to the inner rim of that of radius - thickness / 2
/// Rounding  nearest; an integer circle never passes half-way between two pixels, so there are no ties
/// Time      grows with the rows inside the image and the pixels drawn, however large the circle
/// Errors    empty_image, bad_argument
/// Source    the pixels of J. E. Bresenham, "A linear algorithm for incremental digital display of circular
///           arcs", Communications of the ACM 20(2), 1977; found row by row, so clipping is cheap
template <class Pixel>
Status draw_circle(ImageView<Pixel> image, Point centre, int radius, NonDeduced<Pixel> colour,
                   int thickness = 1);

/// A disc: the outline that draw_circle() draws, and all that it encloses.
///
/// Shapes  as draw_circle()
/// Errors  empty_image, bad_argument
/// Source  as draw_circle()
template <class Pixel>
Status fill_circle(ImageView<Pixel> image, Point centre, int radius, NonDeduced<Pixel> colour);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Let a pixel be far and near from the centre, far >= near. It belongs to the disc of the outline when it
/// lies inside the circle after half a pixel's move inward along the far axis: (far - 1/2)^2 + near^2 <
/// radius^2, which for integers is far^2 - far + near^2 < radius^2. It lies strictly inside the outline when
/// even half a pixel's move outward leaves it inside: far^2 + far + near^2 < radius^2. move is -1 for the
/// first and 1 for the second.
///
/// The largest dx with that property in the row dy, -1 if there is none. With |dy| and radius at most
/// 2^30 + 2^7 no term reaches 2^62.
constexpr std::int64_t circle_half_width(std::int64_t dy, std::int64_t radius, int move) {
    const auto row = static_cast<std::int64_t>(magnitude(dy));
    const std::int64_t square = radius * radius - row * row;
    const std::int64_t steep = square - move * row - 1;  // of dx^2, as long as |dy| is the far one
    if (steep < 0) return -1;
    if (steep < row * row) return isqrt(static_cast<std::uint64_t>(steep));
    // dx is the far one: dx * (dx + move) < square. For move -1 that is the root rounded to the nearest.
    const std::int64_t root = isqrt(static_cast<std::uint64_t>(square));
    const std::int64_t nearest = square - root * root > root ? root + 1 : root;
    return move < 0 ? nearest : nearest - 1;
}

/// The same from that of a row nearer to the centre, which is not smaller. dy is not negative. Near the top
/// and the bottom, where it differs by much, and far outside an image a few steps would not reach it.
constexpr std::int64_t circle_half_width_from(std::int64_t dx, std::int64_t dy, std::int64_t radius,
                                              int move) {
    const auto belongs = [&](std::int64_t width) {
        const std::int64_t far = maximum(width, dy);
        const std::int64_t near = minimum(width, dy);
        return far * (far + move) + near * near < radius * radius;
    };
    for (int steps = 0; steps < 8; ++steps, --dx)
        if (dx < 0 || belongs(dx)) return dx;
    return circle_half_width(dy, radius, move);
}

/// The disc of the outline of radius outer without what lies strictly inside the outline of radius inner.
template <class Pixel>
void fill_ring(ImageView<Pixel> image, Point centre, std::int64_t outer, std::int64_t inner, Pixel colour) {
    if (outer == 0) return fill_run(image, centre.y, centre.x, centre.x, colour);
    const std::int64_t x = centre.x;
    const std::int64_t y = centre.y;
    const std::int64_t last_row = image.height() - 1;
    // Rows as far above the centre as below it are alike, so both are drawn at once, from the nearest inside
    // the image to the farthest.
    const std::int64_t nearest = maximum<std::int64_t>(maximum(-y, y - last_row), 0);
    const std::int64_t farthest = minimum(outer, maximum(y, last_row - y));
    std::int64_t reach = outer;
    std::int64_t hole = inner - 1;
    for (std::int64_t away = nearest; away <= farthest; ++away) {
        reach = circle_half_width_from(reach, away, outer, -1);
        hole = inner > 0 ? circle_half_width_from(hole, away, inner, 1) : -1;
        const auto draw = [&](std::int64_t row) {
            if (hole < 0) return fill_run(image, row, x - reach, x + reach, colour);
            fill_run(image, row, x - reach, x - hole - 1, colour);
            fill_run(image, row, x + hole + 1, x + reach, colour);
        };
        draw(y - away);
        if (away > 0) draw(y + away);
    }
}

/// The outline of a circle of radius 1 or more that lies wholly inside an image: an octant, and its mirror
/// images.
template <class Pixel>
void draw_octants(ImageView<Pixel> image, Point centre, int radius, Pixel colour) {
    // Of a column dx the outline has the farthest row with dy * (dy - 1) + dx * dx < radius * radius. excess
    // is what the left side has more. Up to the diagonal dy falls by at most 1 from one column to the next.
    std::int64_t excess = -std::int64_t{radius};
    int dy = radius;
    for (int dx = 0; dx <= dy; ++dx) {
        for (int side = -1; side <= 1; side += 2) {
            Pixel* const far = image.row(centre.y + side * dy) + centre.x;
            Pixel* const near = image.row(centre.y + side * dx) + centre.x;
            far[-dx] = far[dx] = colour;
            near[-dy] = near[dy] = colour;
        }
        excess += 2 * dx + 1;
        if (excess >= 0) excess -= 2 * --dy;
    }
}

constexpr bool circle_inside(Size size, Point centre, std::int64_t radius) {
    return centre.x - radius >= 0 && centre.x + radius < size.width && centre.y - radius >= 0 &&
           centre.y + radius < size.height;
}

}  // namespace detail

template <class Pixel>
Status draw_circle(ImageView<Pixel> image, Point centre, int radius, NonDeduced<Pixel> colour,
                   int thickness) {
    if (image.empty()) return Status::empty_image;
    if (radius < 0 || radius > max_circle_radius) return Status::bad_argument;
    if (thickness < 1 || thickness > max_line_thickness) return Status::bad_argument;
    if (thickness == 1 && radius > 0 && detail::circle_inside(image.size(), centre, radius)) {
        detail::draw_octants<Pixel>(image, centre, radius, colour);
        return Status::ok;
    }
    detail::fill_ring<Pixel>(image, centre, std::int64_t{radius} + (thickness - 1) / 2,
                             std::int64_t{radius} - thickness / 2, colour);
    return Status::ok;
}

template <class Pixel>
Status fill_circle(ImageView<Pixel> image, Point centre, int radius, NonDeduced<Pixel> colour) {
    if (image.empty()) return Status::empty_image;
    if (radius < 0 || radius > max_circle_radius) return Status::bad_argument;
    detail::fill_ring<Pixel>(image, centre, radius, 0, colour);
    return Status::ok;
}

}  // namespace fovea
