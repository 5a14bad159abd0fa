// SPDX-License-Identifier: MIT
//
// PixelFormat: how a camera packs its pixels, and which rows of bytes a frame of them has.
#pragma once

#include <cstdint>

#include <fovea/image/geometry.hpp>

namespace fovea::hal {

/// Samples of 10 and 12 bits lie in the low bits of 16, the lower byte first, as those of 16 do.
enum class PixelFormat : std::uint8_t {
    none,
    gray8,
    gray10,
    gray12,
    gray16,
    yuyv,
    uyvy,
    nv12,    ///< a plane of luma, then one of pairs of colour differences for two by two pixels
    rgb24,   ///< red first
    bgr24,   ///< blue first
    rgb565,  ///< the lower byte first
    bayer_rggb,
    bayer_grbg,
    bayer_gbrg,
    bayer_bggr,
    mjpeg,  ///< a JPEG picture, without tables of its own in many cameras
};
inline constexpr int pixel_formats = 16;
inline constexpr int max_planes = 2;

constexpr const char* describe(PixelFormat format) {
    switch (format) {
        case PixelFormat::none: return "none";
        case PixelFormat::gray8: return "gray8";
        case PixelFormat::gray10: return "gray10";
        case PixelFormat::gray12: return "gray12";
        case PixelFormat::gray16: return "gray16";
        case PixelFormat::yuyv: return "yuyv";
        case PixelFormat::uyvy: return "uyvy";
        case PixelFormat::nv12: return "nv12";
        case PixelFormat::rgb24: return "rgb24";
        case PixelFormat::bgr24: return "bgr24";
        case PixelFormat::rgb565: return "rgb565";
        case PixelFormat::bayer_rggb: return "bayer-rggb";
        case PixelFormat::bayer_grbg: return "bayer-grbg";
        case PixelFormat::bayer_gbrg: return "bayer-gbrg";
        case PixelFormat::bayer_bggr: return "bayer-bggr";
        case PixelFormat::mjpeg: return "mjpeg";
    }
    return "unknown";
}

/// Frames of it differ in length and hold no rows.
constexpr bool compressed(PixelFormat format) { return format == PixelFormat::mjpeg; }

/// True if frames of it hold colour, which Bayer mosaics do.
constexpr bool coloured(PixelFormat format) {
    return format != PixelFormat::none && format != PixelFormat::gray8 && format != PixelFormat::gray10 &&
           format != PixelFormat::gray12 && format != PixelFormat::gray16;
}

constexpr int plane_count(PixelFormat format) {
    return format == PixelFormat::none ? 0 : format == PixelFormat::nv12 ? 2 : 1;
}

/// Bytes of pixels in a row of a plane, without padding; 0 for what is compressed. At most 3 * 65535.
constexpr int row_bytes(PixelFormat format, int plane, int width) {
    switch (format) {
        case PixelFormat::none:
        case PixelFormat::mjpeg: return 0;
        case PixelFormat::gray8:
        case PixelFormat::bayer_rggb:
        case PixelFormat::bayer_grbg:
        case PixelFormat::bayer_gbrg:
        case PixelFormat::bayer_bggr: return width;
        case PixelFormat::nv12: return plane == 0 ? width : (width + 1) / 2 * 2;
        case PixelFormat::rgb24:
        case PixelFormat::bgr24: return 3 * width;
        case PixelFormat::yuyv:
        case PixelFormat::uyvy: return (width + 1) / 2 * 4;
        case PixelFormat::gray10:
        case PixelFormat::gray12:
        case PixelFormat::gray16:
        case PixelFormat::rgb565: return 2 * width;
    }
    return 0;
}

/// Rows of a plane.
constexpr int plane_rows(PixelFormat format, int plane, int height) {
    if (format == PixelFormat::none || compressed(format)) return 0;
    return plane == 1 ? (height + 1) / 2 : height;
}

}  // namespace fovea::hal
