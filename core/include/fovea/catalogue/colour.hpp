// SPDX-License-Identifier: MIT
//
// The catalogue's entries of the colour conversions in pixelwise/.
#pragma once

#include <cstdint>

#include <fovea/catalogue/operator.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/hsv.hpp>
#include <fovea/pixelwise/planes.hpp>
#include <fovea/pixelwise/to_gray.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace catalogue {

inline constexpr Operator colour[] = {
    {"to_gray_fast",
     "a quarter of red, half of green, a quarter of blue",
     "2.3.5",
     {PixelKind::rgb888},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_gray_fast(c.input<Rgb888>(), c.out<Gray8>()); }},
    {"gray_from_uyvy",
     "brightness of a UYVY image",
     "2.3.5",
     {PixelKind::uyvy},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_gray(c.input<Uyvy>(), c.out<Gray8>()); }},
    {"rgb_from_gray",
     "every brightness as a colour without hue",
     "2.3.3",
     {PixelKind::gray8},
     PixelKind::rgb888,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_rgb(c.input<Gray8>(), c.out<Rgb888>()); }},
    {"extract_plane",
     "red, green or blue of a colour image",
     "2.3.3",
     {PixelKind::rgb888},
     PixelKind::gray8,
     {{"channel", 0, 2, 0, 1, "the colour", "red|green|blue"}},
     nullptr,
     nullptr,
     [](const OperatorCall& c) {
         return extract_plane(c.input<Rgb888>(), static_cast<ColourChannel>(c.values[0]), c.out<Gray8>());
     }},
    {"to_hsv",
     "hue, saturation and value of a colour image",
     "2.3.3",
     {PixelKind::rgb888},
     PixelKind::hsv888,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_hsv(c.input<Rgb888>(), c.out<Hsv888>()); }},
    {"rgb_from_hsv",
     "colours of hue, saturation and value",
     "2.3.3",
     {PixelKind::hsv888},
     PixelKind::rgb888,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_rgb(c.input<Hsv888>(), c.out<Rgb888>()); }},
    {"to_saturation",
     "how far colours are from gray",
     "2.3.3",
     {PixelKind::rgb888},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_saturation(c.input<Rgb888>(), c.out<Gray8>()); }},
};

}  // namespace catalogue
}  // namespace FOVEA_ISA
}  // namespace fovea
