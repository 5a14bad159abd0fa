// SPDX-License-Identifier: MIT
//
// Brightness of colour pixels. Book sec. 2.3.5.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>

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
inline Status to_gray(ImageView<const Rgb888> src, ImageView<Gray8> dst);

/// The brightness that a YUYV (YUY2) camera sends: its luma, unchanged.
///
/// All else as above. A camera that sends the narrow range keeps it: black 16, white 235.
inline Status to_gray(ImageView<const Yuyv> src, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int gray_weight_bits = 15;
inline constexpr std::int32_t red_weight = 9797;
inline constexpr std::int32_t green_weight = 19235;
inline constexpr std::int32_t blue_weight = 3736;
static_assert(red_weight + green_weight + blue_weight == 1 << gray_weight_bits, "white must stay white");

template <class Pixel, class Brightness>
Status gray_frame(ImageView<const Pixel> src, ImageView<Gray8> dst, Brightness brightness) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    for (int y = 0; y < src.height(); ++y) {
        const Pixel* from = src.row(y);
        Gray8* to = dst.row(y);
        for (int x = 0; x < src.width(); ++x) to[x] = brightness(from[x]);
    }
    return Status::ok;
}

}  // namespace detail

constexpr Gray8 gray_of(Rgb888 colour) {
    return static_cast<Gray8>(round_shift(detail::red_weight * colour.red +
                                              detail::green_weight * colour.green +
                                              detail::blue_weight * colour.blue,
                                          detail::gray_weight_bits));
}

inline Status to_gray(ImageView<const Rgb888> src, ImageView<Gray8> dst) {
    return detail::gray_frame(src, dst, [](Rgb888 colour) { return gray_of(colour); });
}

inline Status to_gray(ImageView<const Yuyv> src, ImageView<Gray8> dst) {
    return detail::gray_frame(src, dst, [](Yuyv half) { return half.luma; });
}

}  // namespace fovea
