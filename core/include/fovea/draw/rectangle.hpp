// SPDX-License-Identifier: MIT
//
// Upright rectangles, framed and filled.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/draw/run.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The outermost pixels of area.
///
/// Shapes  any image; area anywhere, of any size; one without pixels draws none
/// Units   thickness in px, 1 or more; it grows inward, and fills the area when both sides meet
/// Time    grows with the rows inside the image
/// Errors  empty_image; bad_argument for a negative width or height or a thickness below 1
/// Source  own
template <class Pixel>
Status draw_rectangle(ImageView<Pixel> image, Rectangle area, NonDeduced<Pixel> colour, int thickness = 1);

/// All pixels of area.
///
/// Shapes  as draw_rectangle()
/// Errors  empty_image; bad_argument for a negative width or height
/// Source  own
template <class Pixel>
Status fill_rectangle(ImageView<Pixel> image, Rectangle area, NonDeduced<Pixel> colour);

// ---- Implementation ---------------------------------------------------------------

template <class Pixel>
Status draw_rectangle(ImageView<Pixel> image, Rectangle area, NonDeduced<Pixel> colour, int thickness) {
    if (image.empty()) return Status::empty_image;
    if (area.width < 0 || area.height < 0 || thickness < 1) return Status::bad_argument;
    if (area.empty()) return Status::ok;

    // In 64 bits, where an area at the far end of int has a right and a bottom too.
    const std::int64_t left = area.x;
    const std::int64_t right = left + area.width - 1;
    const std::int64_t top = area.y;
    const std::int64_t bottom = top + area.height - 1;
    const std::int64_t last = minimum<std::int64_t>(bottom, image.height() - 1);
    for (std::int64_t y = maximum<std::int64_t>(top, 0); y <= last; ++y) {
        if (y - top < thickness || bottom - y < thickness || area.width / 2 < thickness) {
            fill_run(image, y, left, right, colour);
        } else {
            fill_run(image, y, left, left + thickness - 1, colour);
            fill_run(image, y, right - thickness + 1, right, colour);
        }
    }
    return Status::ok;
}

template <class Pixel>
Status fill_rectangle(ImageView<Pixel> image, Rectangle area, NonDeduced<Pixel> colour) {
    return draw_rectangle(image, area, colour, maximum(1, area.height));
}

}  // namespace fovea
