// SPDX-License-Identifier: MIT
//
// Points and runs: what all drawing is made of, and the rules that all of it keeps.
//
// Drawing writes one colour into pixels of an image and reads none. Lying outside is not an error: a shape is
// clipped pixel by pixel, so an image shows exactly what a larger one would show in its place. Nothing is
// blended, and a shape drawn twice is the shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How far from (0, 0) the ends and corners of lines and polygons may lie on either axis, so that their
/// products stay below 2^63. Far beyond any image: what a fit predicts for a place out of sight can be drawn.
inline constexpr int max_draw_coordinate = 1 << 30;

/// Whether a line may end here.
constexpr bool drawable(std::int64_t x, std::int64_t y);
constexpr bool drawable(Point p) { return drawable(p.x, p.y); }

/// One pixel.
///
/// Shapes  any image; any place, shown if it is inside
/// Errors  empty_image
/// Source  own
template <class Pixel>
Status draw_point(ImageView<Pixel> image, Point place, NonDeduced<Pixel> colour);

/// The pixels left..right of row y, both included, as far as they are inside; none if right is below left.
///
/// Shapes  any image, an empty one too
/// Errors  none
/// Source  the common step of every filled shape
template <class Pixel>
void fill_run(ImageView<Pixel> image, std::int64_t y, std::int64_t left, std::int64_t right,
              NonDeduced<Pixel> colour);

// ---- Implementation ---------------------------------------------------------------

constexpr bool drawable(std::int64_t x, std::int64_t y) {
    return x >= -max_draw_coordinate && x <= max_draw_coordinate && y >= -max_draw_coordinate &&
           y <= max_draw_coordinate;
}

template <class Pixel>
Status draw_point(ImageView<Pixel> image, Point place, NonDeduced<Pixel> colour) {
    if (image.empty()) return Status::empty_image;
    if (image.contains(place)) image(place.x, place.y) = colour;
    return Status::ok;
}

namespace detail {

/// A colour to fill many long runs with, in blocks of pixels: single ones of three bytes make no vectors.
template <class Pixel>
class Paint {
public:
    explicit Paint(Pixel colour) : colour_(colour) {
        Pixel pixels[size];
        for (Pixel& pixel : pixels) pixel = colour;
        std::memcpy(block_, pixels, sizeof block_);
    }
    void fill(Pixel* to, int count) const {
        if (count < size) {
            for (int x = 0; x < count; ++x) std::memcpy(to + x, &colour_, sizeof colour_);
            return;
        }
        Pixel* const last = to + (count - size);
        for (; to < last; to += size) put(to);
        put(last);
    }

private:
    static constexpr int size = 16;
    void put(Pixel* to) const {
        const auto bytes = reinterpret_cast<std::uint8_t*>(to);
        for (std::size_t i = 0; i < sizeof(Pixel); ++i) {
            const Bytes block = block_[i];
            std::memcpy(bytes + size * i, &block, sizeof block);
        }
    }

    Pixel colour_;
    /// Pixels as vectors: compilers take an array of pixels apart, and store them one by one.
    using Bytes [[gnu::vector_size(size)]] = std::uint8_t;
    Bytes block_[sizeof(Pixel)];
};

/// fill_run() with paint.
template <class Pixel>
void paint_run(ImageView<Pixel> image, std::int64_t y, std::int64_t left, std::int64_t right,
               const Paint<Pixel>& paint) {
    if (y < 0 || y >= image.height()) return;
    const auto first = static_cast<int>(clamp<std::int64_t>(left, 0, image.width()));
    const auto last = static_cast<int>(clamp<std::int64_t>(right, -1, image.width() - 1));
    paint.fill(image.row(static_cast<int>(y)) + first, last - first + 1);
}

}  // namespace detail

template <class Pixel>
void fill_run(ImageView<Pixel> image, std::int64_t y, std::int64_t left, std::int64_t right,
              NonDeduced<Pixel> colour) {
    if (y < 0 || y >= image.height()) return;
    const auto first = static_cast<int>(clamp<std::int64_t>(left, 0, image.width()));
    const auto last = static_cast<int>(clamp<std::int64_t>(right, -1, image.width() - 1));
    Pixel* row = image.row(static_cast<int>(y));
    for (int x = first; x <= last; ++x) row[x] = colour;
}

}  // namespace fovea
