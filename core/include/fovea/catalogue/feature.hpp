// SPDX-License-Identifier: MIT
//
// The catalogue's entries of feature/.
#pragma once

#include <cstdint>

#include <fovea/catalogue/filter.hpp>
#include <fovea/catalogue/operator.hpp>
#include <fovea/feature/canny.hpp>
#include <fovea/feature/harris.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace catalogue {

inline constexpr Operator feature[] = {
    {"canny",
     "edges as lines one pixel wide",
     "2.8.4",
     {PixelKind::gray8},
     PixelKind::gray8,
     {{"low", 0, max_gradient_strength, 60, 1, "strength that continues an edge, |x| + |y| above it"},
      {"high", 0, max_gradient_strength, 150, 1, "strength that begins an edge, not below low"},
      border_choice},
     nullptr,
     [](Size size, const int*) { return canny_scratch(size); },
     [](const OperatorCall& c) {
         return canny(c.input<Gray8>(), c.values[0], c.values[1], border_of(c.values[2]), c.scratch,
                      c.out<Gray8>());
     }},
    {"harris_response",
     "how much a pixel is a corner, by Harris",
     "",
     {PixelKind::gray8},
     PixelKind::response32,
     {border_choice},
     nullptr,
     [](Size size, const int*) { return harris_scratch(size); },
     [](const OperatorCall& c) {
         return harris_response(c.input<Gray8>(), border_of(c.values[0]), c.scratch, c.out<Response32>());
     }},
};

}  // namespace catalogue
}  // namespace FOVEA_ISA
}  // namespace fovea
