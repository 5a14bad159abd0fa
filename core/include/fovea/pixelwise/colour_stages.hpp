// SPDX-License-Identifier: MIT
//
// Colour conversions as stages of a stream. Colour to gray is in pixelwise/point_stages.hpp.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/colour_class.hpp>
#include <fovea/pixelwise/hsv.hpp>
#include <fovea/pixelwise/planes.hpp>
#include <fovea/pixelwise/rgb565.hpp>
#include <fovea/pixelwise/yuv.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace stages {

/// A conversion of rows that has no parameters.
template <class In, class Out, void (*Row)(const In* src, int width, Out* dst)>
struct ConversionStage {
    using Input = In;
    using Output = Out;
    static void row(const In* src, int width, Out* dst) { Row(src, width, dst); }
};

/// to_rgb() of gray, of hues and of 16-bit colour; to_hsv() and to_saturation(); rgb565_to_gray().
inline constexpr ConversionStage<Gray8, Rgb888, kernels::rgb_from_gray_row> rgb_from_gray;
inline constexpr ConversionStage<Hsv888, Rgb888, kernels::rgb_from_hsv_row> rgb_from_hsv;
inline constexpr ConversionStage<Rgb565, Rgb888, kernels::rgb_from_rgb565_row> rgb_from_rgb565;
inline constexpr ConversionStage<Rgb888, Hsv888, kernels::hsv_row> hsv_from_rgb;
inline constexpr ConversionStage<Rgb888, Gray8, kernels::saturation_row> saturation_from_rgb;
inline constexpr ConversionStage<Rgb565, Gray8, kernels::gray_from_rgb565_row> gray_from_rgb565;

/// extract_plane(): one colour of an image.
struct extract_plane {
    using Input = Rgb888;
    using Output = Gray8;
    ColourChannel channel;
    constexpr bool valid() const { return kernels::is_channel(channel); }
    void row(const Rgb888* src, int width, Gray8* dst) const { kernels::plane_row(src, width, channel, dst); }
};

/// hsv_range() of Rgb888 or of Hsv888.
template <class Pixel>
struct hsv_range {
    using Input = Pixel;
    using Output = Gray8;
    HsvRange range;
    constexpr bool valid() const { return range.valid(); }
    void row(const Pixel* src, int width, Gray8* dst) const {
        kernels::hsv_range_row(src, width, range, dst);
    }
};

/// to_rgb() of a camera's pixels by the range of its numbers.
struct rgb_from_yuyv {
    using Input = Yuyv;
    using Output = Rgb888;
    YuvRange range;
    constexpr bool valid() const { return kernels::is_range(range); }
    void row(const Yuyv* src, int width, Rgb888* dst) const {
        if (range == YuvRange::full)
            kernels::rgb_from_yuyv_row<YuvRange::full>(src, width, dst);
        else
            kernels::rgb_from_yuyv_row<YuvRange::narrow>(src, width, dst);
    }
};
struct rgb_from_uyvy {
    using Input = Uyvy;
    using Output = Rgb888;
    YuvRange range;
    constexpr bool valid() const { return kernels::is_range(range); }
    void row(const Uyvy* src, int width, Rgb888* dst) const {
        if (range == YuvRange::full)
            kernels::rgb_from_uyvy_row<YuvRange::full>(src, width, dst);
        else
            kernels::rgb_from_uyvy_row<YuvRange::narrow>(src, width, dst);
    }
};

/// to_gray() of a camera's luma by the range of its numbers; behind gray_from_yuyv or gray_from_uyvy that of
/// its pixels.
struct gray_from_luma {
    using Input = Gray8;
    using Output = Gray8;
    YuvRange range;
    constexpr bool valid() const { return kernels::is_range(range); }
    void row(const Gray8* src, int width, Gray8* dst) const {
        if (range == YuvRange::full)
            kernels::gray_from_luma_row(src, width, kernels::YuvLanes<YuvRange::full>(), dst);
        else
            kernels::gray_from_luma_row(src, width, kernels::YuvLanes<YuvRange::narrow>(), dst);
    }
};

}  // namespace stages
}  // namespace FOVEA_ISA
}  // namespace fovea
