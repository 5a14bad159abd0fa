// SPDX-License-Identifier: MIT
//
// Pixel types: each names its content.
#pragma once

#include <cstdint>

namespace fovea {

using Gray8 = std::uint8_t;       ///< brightness 0..255; binary images hold 0 and 255
using Gray16 = std::uint16_t;     ///< brightness 0..65535
using Gradient16 = std::int16_t;  ///< derivative, -4080..4080 for 8-bit sources
using Label16 = std::uint16_t;    ///< number of a region, 0 is the ground

/// Colour in the byte order of a PPM file.
struct Rgb888 {
    std::uint8_t red;
    std::uint8_t green;
    std::uint8_t blue;

    friend constexpr bool operator==(Rgb888 a, Rgb888 b) {
        return a.red == b.red && a.green == b.green && a.blue == b.blue;
    }
    friend constexpr bool operator!=(Rgb888 a, Rgb888 b) { return !(a == b); }
};

/// Half of a YUYV (YUY2) pair: the brightness of one pixel and one of the two colour differences of the pair,
/// U in even columns, V in odd ones.
struct Yuyv {
    std::uint8_t luma;
    std::uint8_t chroma;
};

static_assert(sizeof(Rgb888) == 3 && sizeof(Yuyv) == 2, "packed pixels have no padding");

}  // namespace fovea
