// SPDX-License-Identifier: MIT
//
// Arrows: a direction, a displacement, the side a gauge measures to.
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

/// A line from tail to tip with two strokes at the tip. Each stroke ends head_length back along the line and
/// half of that aside (27 degrees). An arrow without length is a point.
///
/// Shapes    as draw_line(); head_length 0..max_image_side
/// Units     head_length and thickness in px
/// Rounding  the ends of the strokes to the nearest pixel, from a length good to 2^-31 of itself
/// Errors    empty_image; bad_argument, also when a stroke would end beyond max_draw_coordinate
/// Source    own
template <class Pixel>
Status draw_arrow(ImageView<Pixel> image, Point tail, Point tip, NonDeduced<Pixel> colour, int head_length,
                  int thickness = 1);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Where a stroke of an arrow (dx, dy) ends, seen from its tip; side is 1 or -1.
struct ArrowStroke {
    std::int64_t dx;
    std::int64_t dy;
};
constexpr ArrowStroke arrow_stroke(std::int64_t dx, std::int64_t dy, std::int64_t head_length, int side) {
    const std::uint64_t square = magnitude(dx) * magnitude(dx) + magnitude(dy) * magnitude(dy);
    // The length with as many bits behind the point as 32 bits hold: head_length * 3 * length < 2^49.
    const int places = leading_zeros(square) / 2;
    const auto length = static_cast<std::int64_t>(isqrt(square << 2 * places));
    const std::int64_t scale = head_length * (std::int64_t{1} << places);
    return {round_divide((-2 * dx - side * dy) * scale, 2 * length),
            round_divide((-2 * dy + side * dx) * scale, 2 * length)};
}

}  // namespace detail

template <class Pixel>
Status draw_arrow(ImageView<Pixel> image, Point tail, Point tip, NonDeduced<Pixel> colour, int head_length,
                  int thickness) {
    if (image.empty()) return Status::empty_image;
    if (!drawable(tail) || !drawable(tip)) return Status::bad_argument;
    if (head_length < 0 || head_length > max_image_side) return Status::bad_argument;
    if (thickness < 1 || thickness > max_line_thickness) return Status::bad_argument;
    if (tail == tip) return draw_line(image, tail, tip, colour, thickness);

    Point ends[2];
    for (int i = 0; i < 2; ++i) {
        const detail::ArrowStroke stroke = detail::arrow_stroke(
            std::int64_t{tip.x} - tail.x, std::int64_t{tip.y} - tail.y, head_length, i == 0 ? 1 : -1);
        if (!drawable(tip.x + stroke.dx, tip.y + stroke.dy)) return Status::bad_argument;
        ends[i] = {static_cast<int>(tip.x + stroke.dx), static_cast<int>(tip.y + stroke.dy)};
    }
    if (Status s = draw_line(image, tail, tip, colour, thickness); s != Status::ok) return s;
    if (Status s = draw_line(image, ends[0], tip, colour, thickness); s != Status::ok) return s;
    return draw_line(image, ends[1], tip, colour, thickness);
}

}  // namespace fovea
