// SPDX-License-Identifier: MIT
//
// Brightness of colour pixels. Book sec. 2.3.5.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/triples.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The brightness of one colour: 0.299 red + 0.587 green + 0.114 blue.
///
/// Rounding  nearest, ties up; the weights are 15-bit and sum to 32768, so white stays 255
/// Source    ITU-R BT.601-7 sec. 2.5.1; book sec. 2.3.5
constexpr Gray8 gray_of(Rgb888 colour);

/// Brightness of every pixel.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Units    0..255 in and out, rounded as gray_of()
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch
/// Source   book sec. 2.3.5
inline namespace FOVEA_ISA {
inline Status to_gray(ImageView<const Rgb888> src, ImageView<Gray8> dst);
}  // namespace FOVEA_ISA

/// The brightness that a YUYV (YUY2) camera sends: its luma, unchanged.
///
/// All else as above. A camera that sends the narrow range keeps it: black 16, white 235.
inline Status to_gray(ImageView<const Yuyv> src, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr simd::TripleWeights gray_weights{9797, 19235, 3736};
static_assert(gray_weights.first + gray_weights.second + gray_weights.third == 1 << 15,
              "white must stay white");

/// row(src, width, dst) for every row.
template <class Pixel, class Row>
Status gray_frame(ImageView<const Pixel> src, ImageView<Gray8> dst, Row row) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    for (int y = 0; y < src.height(); ++y) row(src.row(y), src.width(), dst.row(y));
    return Status::ok;
}

}  // namespace detail

constexpr Gray8 gray_of(Rgb888 colour) {
    return detail::gray_weights.mean(colour.red, colour.green, colour.blue);
}

inline namespace FOVEA_ISA {

inline Status to_gray(ImageView<const Rgb888> src, ImageView<Gray8> dst) {
    return detail::gray_frame(src, dst, [](const Rgb888* from, int width, Gray8* to) {
        simd::weigh_triples(&from->red, width, detail::gray_weights, to);
    });
}

}  // namespace FOVEA_ISA

inline Status to_gray(ImageView<const Yuyv> src, ImageView<Gray8> dst) {
    return detail::gray_frame(src, dst, [](const Yuyv* from, int width, Gray8* to) {
        for (int x = 0; x < width; ++x) to[x] = from[x].luma;
    });
}

}  // namespace fovea
