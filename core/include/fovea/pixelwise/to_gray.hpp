// SPDX-License-Identifier: MIT
//
// Brightness of colour pixels. Book sec. 2.3.5.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/convert_frame.hpp>
#include <fovea/simd/interleave.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/triples.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The brightness of one colour: 0.299 red + 0.587 green + 0.114 blue.
///
/// Rounding  nearest, ties up; the weights are 15-bit and sum to 32768, so white stays 255
/// Source    ITU-R BT.601-7 sec. 2.5.1; book sec. 2.3.5
constexpr Gray8 gray_of(Rgb888 colour);

inline namespace FOVEA_ISA {

/// Brightness of every pixel.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Units    0..255 in and out, rounded as gray_of()
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch
/// Source   book sec. 2.3.5
inline Status to_gray(ImageView<const Rgb888> src, ImageView<Gray8> dst);

/// A quarter of red, half of green and a quarter of blue, for processors without a multiplier.
///
/// Rounding  nearest, ties up: (red + 2 green + blue + 2) / 4; the largest sum is 4 * 255 + 2
/// Others    as to_gray()
/// Source    the toolkit's fast conversion, which its demonstrations use
inline Status to_gray_fast(ImageView<const Rgb888> src, ImageView<Gray8> dst);

/// The brightness that a YUYV (YUY2) or UYVY camera sends: its luma, unchanged.
///
/// All else as to_gray() of RGB. A camera that sends the narrow range keeps it: black 16, white 235;
/// pixelwise/yuv.hpp widens it.
inline Status to_gray(ImageView<const Yuyv> src, ImageView<Gray8> dst);
inline Status to_gray(ImageView<const Uyvy> src, ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr simd::TripleWeights gray_weights{9797, 19235, 3736};
static_assert(gray_weights.first + gray_weights.second + gray_weights.third == 1 << 15,
              "white must stay white");

}  // namespace detail

constexpr Gray8 gray_of(Rgb888 colour) {
    return detail::gray_weights.mean(colour.red, colour.green, colour.blue);
}

inline namespace FOVEA_ISA {

namespace kernels {

/// to_gray() of one row.
inline void gray_row(const Rgb888* src, int width, Gray8* dst) {
    simd::weigh_triples(&src->red, width, detail::gray_weights, dst);
}

/// to_gray_fast() of one row.
inline void fast_gray_row(const Rgb888* src, int width, Gray8* dst) {
    using simd::Words;
    simd::for_each_step<3, 1>(&src->red, width, dst, [](const std::uint8_t* from, std::uint8_t* to) {
        const simd::ByteTriples colour = simd::load_triples(from);
        const Words sum = Words(colour.first) + (Words(colour.second) << 1) + Words(colour.third);
        ((sum + Words::all(2)) >> 2).narrow().store(to);
    });
}

/// The first or the second byte of every pair.
inline void first_of_pairs_row(const std::uint8_t* src, int width, Gray8* dst) {
    simd::for_each_step<2, 1>(src, width, dst, [](const std::uint8_t* from, std::uint8_t* to) {
        simd::load_pairs(from).first.store(to);
    });
}
inline void second_of_pairs_row(const std::uint8_t* src, int width, Gray8* dst) {
    simd::for_each_step<2, 1>(src, width, dst, [](const std::uint8_t* from, std::uint8_t* to) {
        simd::load_pairs(from).second.store(to);
    });
}

}  // namespace kernels

inline Status to_gray(ImageView<const Rgb888> src, ImageView<Gray8> dst) {
    return detail::convert_frame(src, dst, kernels::gray_row);
}

inline Status to_gray_fast(ImageView<const Rgb888> src, ImageView<Gray8> dst) {
    return detail::convert_frame(src, dst, kernels::fast_gray_row);
}

inline Status to_gray(ImageView<const Yuyv> src, ImageView<Gray8> dst) {
    return detail::convert_frame(src, dst, [](const Yuyv* from, int width, Gray8* to) {
        kernels::first_of_pairs_row(&from->luma, width, to);
    });
}

inline Status to_gray(ImageView<const Uyvy> src, ImageView<Gray8> dst) {
    return detail::convert_frame(src, dst, [](const Uyvy* from, int width, Gray8* to) {
        kernels::second_of_pairs_row(&from->chroma, width, to);
    });
}

}  // namespace FOVEA_ISA
}  // namespace fovea
