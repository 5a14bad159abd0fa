// SPDX-License-Identifier: MIT
//
// Gray to colour, and colour as one image or as three planes. Book sec. 2.3.3.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/convert_frame.hpp>
#include <fovea/simd/interleave.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

enum class ColourChannel : std::uint8_t { red, green, blue };

inline namespace FOVEA_ISA {

/// Every brightness as a colour without hue: red, green and blue are the gray pixel.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch
/// Source   book sec. 2.3.3
inline Status to_rgb(ImageView<const Gray8> src, ImageView<Rgb888> dst);

/// The three colours of an image in images of their own.
///
/// Shapes   src, red, green and blue equal, 1x1 or larger
/// Overlap  none: no two of the images share pixels
/// Errors   empty_image, size_mismatch
/// Source   book sec. 2.3.3; a part of an image is a crop() of the views
inline Status split_planes(ImageView<const Rgb888> src, ImageView<Gray8> red, ImageView<Gray8> green,
                           ImageView<Gray8> blue);

/// The inverse of split_planes(). All else as there.
inline Status merge_planes(ImageView<const Gray8> red, ImageView<const Gray8> green,
                           ImageView<const Gray8> blue, ImageView<Rgb888> dst);

/// One colour of an image, as a plane. All else as split_planes().
inline Status extract_plane(ImageView<const Rgb888> src, ColourChannel channel, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// to_rgb() of one row of gray.
inline void rgb_from_gray_row(const Gray8* src, int width, Rgb888* dst) {
    simd::for_each_step<1, 3>(src, width, &dst->red, [](const std::uint8_t* from, std::uint8_t* to) {
        const auto level = simd::Bytes::load(from);
        simd::store_triples({level, level, level}, to);
    });
}

/// split_planes() of one row.
inline void split_row(const Rgb888* src, int width, Gray8* red, Gray8* green, Gray8* blue) {
    constexpr int lanes = simd::lanes;
    const std::uint8_t* from = &src->red;
    int x = 0;
    for (; x + lanes <= width; x += lanes, from += 3 * lanes) {
        const simd::ByteTriples colour = simd::load_triples(from);
        colour.first.store(red + x);
        colour.second.store(green + x);
        colour.third.store(blue + x);
    }
    for (; x < width; ++x) {
        red[x] = src[x].red;
        green[x] = src[x].green;
        blue[x] = src[x].blue;
    }
}

/// merge_planes() of one row.
inline void merge_row(const Gray8* red, const Gray8* green, const Gray8* blue, int width, Rgb888* dst) {
    constexpr int lanes = simd::lanes;
    std::uint8_t* to = &dst->red;
    int x = 0;
    for (; x + lanes <= width; x += lanes, to += 3 * lanes)
        simd::store_triples(
            {simd::Bytes::load(red + x), simd::Bytes::load(green + x), simd::Bytes::load(blue + x)}, to);
    for (; x < width; ++x) dst[x] = {red[x], green[x], blue[x]};
}

constexpr bool is_channel(ColourChannel channel) {
    return channel == ColourChannel::red || channel == ColourChannel::green || channel == ColourChannel::blue;
}

/// extract_plane() of one row.
inline void plane_row(const Rgb888* src, int width, ColourChannel channel, Gray8* dst) {
    const auto row = [=](auto plane) {
        simd::for_each_step<3, 1>(&src->red, width, dst, [=](const std::uint8_t* in, std::uint8_t* out) {
            plane(simd::load_triples(in)).store(out);
        });
    };
    switch (channel) {
        case ColourChannel::red: return row([](const simd::ByteTriples& t) { return t.first; });
        case ColourChannel::green: return row([](const simd::ByteTriples& t) { return t.second; });
        case ColourChannel::blue: return row([](const simd::ByteTriples& t) { return t.third; });
    }
}

/// row(y, width) for every row of four images of one size, joined as in convert_frame().
template <class Colour, class Plane, class Row>
Status planes_frame(ImageView<Colour> colour, ImageView<Plane> red, ImageView<Plane> green,
                    ImageView<Plane> blue, Row row) {
    const bool gaps = detail::has_gaps(colour) || detail::has_gaps(red) || detail::has_gaps(green) ||
                      detail::has_gaps(blue);
    const std::int64_t area = colour.size().area();
    if (!gaps && area <= detail::most_joined_pixels) {
        row(0, static_cast<int>(area));
        return Status::ok;
    }
    for (int y = 0; y < colour.height(); ++y) row(y, colour.width());
    return Status::ok;
}

}  // namespace kernels

inline Status to_rgb(ImageView<const Gray8> src, ImageView<Rgb888> dst) {
    return detail::convert_frame(src, dst, kernels::rgb_from_gray_row);
}

inline Status split_planes(ImageView<const Rgb888> src, ImageView<Gray8> red, ImageView<Gray8> green,
                           ImageView<Gray8> blue) {
    if (src.empty()) return Status::empty_image;
    if (red.size() != src.size() || green.size() != src.size() || blue.size() != src.size())
        return Status::size_mismatch;
    return kernels::planes_frame(src, red, green, blue, [&](int y, int width) {
        kernels::split_row(src.row(y), width, red.row(y), green.row(y), blue.row(y));
    });
}

inline Status merge_planes(ImageView<const Gray8> red, ImageView<const Gray8> green,
                           ImageView<const Gray8> blue, ImageView<Rgb888> dst) {
    if (red.empty()) return Status::empty_image;
    if (green.size() != red.size() || blue.size() != red.size() || dst.size() != red.size())
        return Status::size_mismatch;
    return kernels::planes_frame(dst, red, green, blue, [&](int y, int width) {
        kernels::merge_row(red.row(y), green.row(y), blue.row(y), width, dst.row(y));
    });
}

inline Status extract_plane(ImageView<const Rgb888> src, ColourChannel channel, ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (!kernels::is_channel(channel)) return Status::bad_argument;
    return detail::convert_frame(src, dst, [=](const Rgb888* from, int width, Gray8* to) {
        kernels::plane_row(from, width, channel, to);
    });
}

}  // namespace FOVEA_ISA
}  // namespace fovea
