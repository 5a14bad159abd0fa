// SPDX-License-Identifier: MIT
//
// The catalogue's entries of segment/adaptive_threshold.hpp.
#pragma once

#include <cstdint>

#include <fovea/catalogue/operator.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/segment/adaptive_threshold.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace catalogue {

inline constexpr OperatorParameter adaptive_side{"side", 1, max_adaptive_side,
                                                 15,     2, "of the window, pixels, odd"};

inline constexpr Operator adaptive[] = {
    {"adaptive_threshold",
     "255 where a pixel is at least the mean around it less offset, else 0",
     "2.8.1",
     {PixelKind::gray8},
     PixelKind::gray8,
     {adaptive_side, {"offset", -255, 255, 5, 1, "grey levels below the mean"}},
     nullptr,
     [](Size size, const int* values) { return adaptive_threshold_scratch(size, values[0]); },
     [](const OperatorCall& c) {
         return adaptive_threshold(c.input<Gray8>(), c.values[0], c.values[1], c.scratch, c.out<Gray8>());
     }},
    {"adaptive_threshold_inverse",
     "255 where a pixel is below the mean around it less offset, else 0",
     "2.8.1",
     {PixelKind::gray8},
     PixelKind::gray8,
     {adaptive_side, {"offset", -255, 255, 5, 1, "grey levels below the mean"}},
     nullptr,
     [](Size size, const int* values) { return adaptive_threshold_scratch(size, values[0]); },
     [](const OperatorCall& c) {
         return adaptive_threshold_inverse(c.input<Gray8>(), c.values[0], c.values[1], c.scratch,
                                           c.out<Gray8>());
     }},
    {"sauvola_threshold",
     "255 where a pixel is at least a threshold from mean and deviation around it, else 0",
     "2.8.1",
     {PixelKind::gray8},
     PixelKind::gray8,
     {adaptive_side, {"weight", 0, max_sauvola_weight, 51, 1, "of the deviation, 1/256"}},
     nullptr,
     [](Size size, const int* values) { return sauvola_threshold_scratch(size, values[0]); },
     [](const OperatorCall& c) {
         return sauvola_threshold(c.input<Gray8>(), c.values[0], c.values[1], c.scratch, c.out<Gray8>());
     }},
};

}  // namespace catalogue
}  // namespace FOVEA_ISA
}  // namespace fovea
