// SPDX-License-Identifier: MIT
//
// The four-character codes by which V4L2 names pixel formats.
#pragma once

#include <linux/videodev2.h>

#include <cstdint>

#include <fovea/hal/pixel_format.hpp>

namespace fovea::linux_port {

/// A format as V4L2 names it.
struct VideoFormat {
    std::uint32_t code;
    hal::PixelFormat format;
    /// Planes that lie in memory of their own: those of NV12 do in its multi-planar form.
    int memory_planes;
};

/// All that the camera reads. The first of a format is the one asked for.
///
/// Source  linux/videodev2.h and the kernel's documentation of V4L2, "Image Formats"
inline constexpr VideoFormat video_formats[] = {
    {V4L2_PIX_FMT_GREY, hal::PixelFormat::gray8, 1},
    {V4L2_PIX_FMT_Y10, hal::PixelFormat::gray10, 1},
    {V4L2_PIX_FMT_Y12, hal::PixelFormat::gray12, 1},
    {V4L2_PIX_FMT_Y16, hal::PixelFormat::gray16, 1},
    {V4L2_PIX_FMT_YUYV, hal::PixelFormat::yuyv, 1},
    {V4L2_PIX_FMT_UYVY, hal::PixelFormat::uyvy, 1},
    {V4L2_PIX_FMT_NV12, hal::PixelFormat::nv12, 1},
    {V4L2_PIX_FMT_NV12M, hal::PixelFormat::nv12, 2},
    {V4L2_PIX_FMT_RGB24, hal::PixelFormat::rgb24, 1},
    {V4L2_PIX_FMT_BGR24, hal::PixelFormat::bgr24, 1},
    {V4L2_PIX_FMT_RGB565, hal::PixelFormat::rgb565, 1},
    {V4L2_PIX_FMT_SRGGB8, hal::PixelFormat::bayer_rggb, 1},
    {V4L2_PIX_FMT_SGRBG8, hal::PixelFormat::bayer_grbg, 1},
    {V4L2_PIX_FMT_SGBRG8, hal::PixelFormat::bayer_gbrg, 1},
    {V4L2_PIX_FMT_SBGGR8, hal::PixelFormat::bayer_bggr, 1},
    {V4L2_PIX_FMT_MJPEG, hal::PixelFormat::mjpeg, 1},
    {V4L2_PIX_FMT_JPEG, hal::PixelFormat::mjpeg, 1},
};

/// The format of a code; nullptr for one that the camera does not read.
constexpr const VideoFormat* find_video_format(std::uint32_t code) {
    for (const VideoFormat& known : video_formats)
        if (known.code == code) return &known;
    return nullptr;
}

/// True if frames are told to hold luma of 16..235. What the driver leaves open is settled as V4L2 does:
/// narrow for luma and colour differences, but full where they are those of JPEG; full for red, green and
/// blue and for gray.
constexpr bool narrow_range(hal::PixelFormat format, std::uint32_t quantization, std::uint32_t colorspace) {
    const bool luma_and_differences = format == hal::PixelFormat::yuyv || format == hal::PixelFormat::uyvy ||
                                      format == hal::PixelFormat::nv12;
    if (!luma_and_differences) return false;
    if (quantization != V4L2_QUANTIZATION_DEFAULT) return quantization == V4L2_QUANTIZATION_LIM_RANGE;
    return colorspace != V4L2_COLORSPACE_JPEG;
}

}  // namespace fovea::linux_port
