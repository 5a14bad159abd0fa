// SPDX-License-Identifier: MIT
//
// The catalogue's entries of morphology/.
#pragma once

#include <cstdint>

#include <fovea/catalogue/operator.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/morphology/top_hat.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace catalogue {

inline constexpr OperatorParameter element_width{"width", 1, max_element_side,
                                                 3,       2, "columns of the element, odd"};
inline constexpr OperatorParameter element_height{"height", 1, max_element_side,
                                                  3,        2, "rows of the element, odd"};

inline constexpr Operator morphology[] = {
    {"erode",
     "the smallest value under a rectangle: bright things shrink",
     "2.7.2",
     {PixelKind::gray8},
     PixelKind::gray8,
     {element_width, element_height},
     nullptr,
     [](Size size, const int*) { return erode_scratch(size); },
     [](const OperatorCall& c) {
         return erode(c.input<Gray8>(), {c.values[0], c.values[1]}, c.scratch, c.out<Gray8>());
     }},
    {"dilate",
     "the largest value under a rectangle: bright things grow",
     "2.7.2",
     {PixelKind::gray8},
     PixelKind::gray8,
     {element_width, element_height},
     nullptr,
     [](Size size, const int*) { return dilate_scratch(size); },
     [](const OperatorCall& c) {
         return dilate(c.input<Gray8>(), {c.values[0], c.values[1]}, c.scratch, c.out<Gray8>());
     }},
    {"opening",
     "erosion, then dilation: removes what is bright and smaller than the rectangle",
     "2.7.3",
     {PixelKind::gray8},
     PixelKind::gray8,
     {element_width, element_height},
     nullptr,
     [](Size size, const int*) { return opening_scratch(size); },
     [](const OperatorCall& c) {
         return opening(c.input<Gray8>(), {c.values[0], c.values[1]}, c.scratch, c.out<Gray8>());
     },
     true},
    {"closing",
     "dilation, then erosion: removes what is dark and smaller than the rectangle",
     "2.7.3",
     {PixelKind::gray8},
     PixelKind::gray8,
     {element_width, element_height},
     nullptr,
     [](Size size, const int*) { return closing_scratch(size); },
     [](const OperatorCall& c) {
         return closing(c.input<Gray8>(), {c.values[0], c.values[1]}, c.scratch, c.out<Gray8>());
     },
     true},
    {"top_hat",
     "what is bright and smaller than a rectangle, on any ground",
     "2.7.3",
     {PixelKind::gray8},
     PixelKind::gray8,
     {element_width, element_height},
     nullptr,
     [](Size size, const int*) { return top_hat_scratch(size); },
     [](const OperatorCall& c) {
         return top_hat(c.input<Gray8>(), {c.values[0], c.values[1]}, c.scratch, c.out<Gray8>());
     },
     true},
    {"black_hat",
     "what is dark and smaller than a rectangle, on any ground",
     "2.7.3",
     {PixelKind::gray8},
     PixelKind::gray8,
     {element_width, element_height},
     nullptr,
     [](Size size, const int*) { return black_hat_scratch(size); },
     [](const OperatorCall& c) {
         return black_hat(c.input<Gray8>(), {c.values[0], c.values[1]}, c.scratch, c.out<Gray8>());
     },
     true},
    {"morphological_gradient",
     "dilation less erosion: the outline of things",
     "2.7.2",
     {PixelKind::gray8},
     PixelKind::gray8,
     {element_width, element_height},
     nullptr,
     [](Size size, const int*) { return morphological_gradient_scratch(size); },
     [](const OperatorCall& c) {
         return morphological_gradient(c.input<Gray8>(), {c.values[0], c.values[1]}, c.scratch,
                                       c.out<Gray8>());
     }},
};

}  // namespace catalogue
}  // namespace FOVEA_ISA
}  // namespace fovea
