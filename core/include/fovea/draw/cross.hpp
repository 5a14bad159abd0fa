// SPDX-License-Identifier: MIT
//
// Crosses: marks for a place.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/run.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// An upright cross (+): lines from centre to the four places arm pixels left, right, above and below.
///
/// Shapes  any image; arm 0 or more, 0 being a point
/// Units   arm and thickness in px, thickness as draw_line()
/// Errors  empty_image; bad_argument, also when an arm ends beyond max_draw_coordinate
/// Source  own
template <class Pixel>
Status draw_cross(ImageView<Pixel> image, Point centre, int arm, NonDeduced<Pixel> colour, int thickness = 1);

/// A diagonal cross (x): its arms end arm pixels to the side of centre and arm pixels above or below. All
/// else as draw_cross().
template <class Pixel>
Status draw_diagonal_cross(ImageView<Pixel> image, Point centre, int arm, NonDeduced<Pixel> colour,
                           int thickness = 1);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Two lines through centre, which reach arm steps of first and second to both sides.
template <class Pixel>
Status draw_two_strokes(ImageView<Pixel> image, Point centre, int arm, Point first, Point second,
                        Pixel colour, int thickness) {
    if (image.empty()) return Status::empty_image;
    if (arm < 0 || thickness < 1 || thickness > max_line_thickness) return Status::bad_argument;
    const std::int64_t reach = arm;
    if (!drawable(centre.x - reach, centre.y - reach) || !drawable(centre.x + reach, centre.y + reach))
        return Status::bad_argument;

    const Point ways[] = {first, second};
    for (const Point way : ways) {
        const Point from{centre.x - way.x * arm, centre.y - way.y * arm};
        const Point to{centre.x + way.x * arm, centre.y + way.y * arm};
        if (Status s = draw_line(image, from, to, colour, thickness); s != Status::ok) return s;
    }
    return Status::ok;
}

}  // namespace detail

template <class Pixel>
Status draw_cross(ImageView<Pixel> image, Point centre, int arm, NonDeduced<Pixel> colour, int thickness) {
    return detail::draw_two_strokes(image, centre, arm, {1, 0}, {0, 1}, colour, thickness);
}

template <class Pixel>
Status draw_diagonal_cross(ImageView<Pixel> image, Point centre, int arm, NonDeduced<Pixel> colour,
                           int thickness) {
    return detail::draw_two_strokes(image, centre, arm, {1, 1}, {1, -1}, colour, thickness);
}

}  // namespace fovea
