// SPDX-License-Identifier: MIT
//
// Pixel types: each names its content.
#pragma once

#include <cstdint>

namespace fovea {

using Gray8 = std::uint8_t;         ///< brightness 0..255; binary images hold 0 and 255
using Gray16 = std::uint16_t;       ///< brightness 0..65535
using Gradient16 = std::int16_t;    ///< derivative, -4080..4080 for 8-bit sources
using Direction16 = std::uint16_t;  ///< angle in 1/65536 turn, from +x towards +y, as Angle::raw()
using Label16 = std::uint16_t;      ///< number of a region, 0 is the ground
using Rgb565 = std::uint16_t;       ///< red in the 5 highest bits, green in 6, blue in the 5 lowest
using Sum32 = std::uint32_t;        ///< sum over a rectangle of 8-bit pixels
using Sum64 = std::uint64_t;        ///< sum over a rectangle of their squares
using Response32 = std::int32_t;    ///< how much of a feature stands at a pixel, of either sign

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

/// Colour as hue, saturation and value. Hue in steps of 2 degrees, 0..179, red at 0; saturation and value
/// 0..255.
struct Hsv888 {
    std::uint8_t hue;
    std::uint8_t saturation;
    std::uint8_t value;

    friend constexpr bool operator==(Hsv888 a, Hsv888 b) {
        return a.hue == b.hue && a.saturation == b.saturation && a.value == b.value;
    }
    friend constexpr bool operator!=(Hsv888 a, Hsv888 b) { return !(a == b); }
};

/// Colour as CIE lightness and two opponent colours: lightness 0..255 for 0..100, a and b with 128 at zero.
struct Lab888 {
    std::uint8_t lightness;
    std::uint8_t a;
    std::uint8_t b;

    friend constexpr bool operator==(Lab888 x, Lab888 y) {
        return x.lightness == y.lightness && x.a == y.a && x.b == y.b;
    }
    friend constexpr bool operator!=(Lab888 x, Lab888 y) { return !(x == y); }
};

/// Half of a YUYV (YUY2) pair: the brightness of one pixel and one of the two colour differences of the pair,
/// U in even columns, V in odd ones.
struct Yuyv {
    std::uint8_t luma;
    std::uint8_t chroma;
};

/// Half of a UYVY pair: the same with the colour difference first.
struct Uyvy {
    std::uint8_t chroma;
    std::uint8_t luma;
};

/// The two colour differences that four pixels of an NV12 image share.
struct ChromaPair {
    std::uint8_t u;
    std::uint8_t v;
};

static_assert(sizeof(Rgb888) == 3 && sizeof(Hsv888) == 3 && sizeof(Lab888) == 3 && sizeof(Yuyv) == 2 &&
                  sizeof(Uyvy) == 2 && sizeof(ChromaPair) == 2,
              "packed pixels have no padding");

}  // namespace fovea
