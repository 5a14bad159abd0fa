// SPDX-License-Identifier: MIT
//
// The catalogue's entries of pixelwise/.
#pragma once

#include <cstdint>

#include <fovea/catalogue/operator.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/pixelwise/to_gray.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace catalogue {

inline constexpr Operator pixelwise[] = {
    {"threshold",
     "255 where a pixel is at least level, else 0",
     "2.4",
     {PixelKind::gray8},
     PixelKind::gray8,
     {{"level", 0, 255, 128, 1, "grey level"}},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return threshold(c.input<Gray8>(), c.level(0), c.out<Gray8>()); },
     true},
    {"threshold_inverse",
     "255 where a pixel is below level, else 0",
     "2.4",
     {PixelKind::gray8},
     PixelKind::gray8,
     {{"level", 0, 255, 128, 1, "grey level"}},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return threshold_inverse(c.input<Gray8>(), c.level(0), c.out<Gray8>()); },
     true},
    {"threshold_range",
     "255 where a pixel is low to high, else 0",
     "2.4",
     {PixelKind::gray8},
     PixelKind::gray8,
     {{"low", 0, 255, 64, 1, "lowest grey level"},
      {"high", 0, 255, 192, 1, "highest grey level, not below low"}},
     nullptr,
     nullptr,
     [](const OperatorCall& c) {
         return threshold_range(c.input<Gray8>(), c.level(0), c.level(1), c.out<Gray8>());
     },
     true},
    {"to_gray",
     "brightness of a colour image",
     "2.3.5",
     {PixelKind::rgb888},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_gray(c.input<Rgb888>(), c.out<Gray8>()); }},
    {"gray_from_yuyv",
     "brightness of a YUYV image",
     "2.3.5",
     {PixelKind::yuyv},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_gray(c.input<Yuyv>(), c.out<Gray8>()); }},
};

}  // namespace catalogue
}  // namespace FOVEA_ISA
}  // namespace fovea
