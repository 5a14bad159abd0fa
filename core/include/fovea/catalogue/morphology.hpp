// SPDX-License-Identifier: MIT
//
// The catalogue's entries of morphology/.
#pragma once

#include <cstdint>

#include <fovea/catalogue/operator.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/morphology/distance_transform.hpp>
#include <fovea/morphology/hit_or_miss.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/morphology/shaped_morphology.hpp>
#include <fovea/morphology/structuring_element.hpp>
#include <fovea/morphology/thinning.hpp>
#include <fovea/morphology/top_hat.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace catalogue {

inline constexpr OperatorParameter element_width{"width", 1, max_element_side,
                                                 3,       2, "columns of the element, odd"};
inline constexpr OperatorParameter element_height{
    "height", 1, max_element_side, 3, 2, "rows of the element, odd", nullptr, true};

/// Shapes by number, with sides of the same length.
inline constexpr OperatorParameter shape{"shape", 0, 2, 0, 1, "of the element", "cross|disc|diagonal"};
inline constexpr OperatorParameter shape_side{"side", 3, max_shape_side, 5, 2, "of the element, odd"};

constexpr StructuringElement element_of(const int* values) {
    if (values[0] == 0) return StructuringElement::cross({values[1], values[1]});
    if (values[0] == 1) return StructuringElement::disc(values[1]);
    return StructuringElement::line({values[1] / 2, values[1] / 2});
}

/// Patterns by number: what must be set and what must not.
inline constexpr OperatorParameter pattern{
    "pattern", 0, 3, 1, 1, "what is looked for", "dot|corner|edge|end"};

constexpr StructuringElement hit_of(int number) {
    if (number == 0) return StructuringElement::from_text("...\n.#.\n...");
    if (number == 1) return StructuringElement::from_text("...\n.##\n.#.");
    if (number == 2) return StructuringElement::from_text("...\n.##\n...");
    return StructuringElement::from_text(".#.\n.#.\n...");
}
constexpr StructuringElement miss_of(int number) {
    if (number == 0) return StructuringElement::from_text("###\n#.#\n###");
    if (number == 1) return StructuringElement::from_text("##.\n#..\n...");
    if (number == 2) return StructuringElement::from_text("...\n#..\n...");
    return StructuringElement::from_text("...\n#.#\n###");
}

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
     true,
     "open"},
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
     true,
     "close"},
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
    {"squared_distance",
     "square of the distance to the nearest zero pixel, exactly",
     "",
     {PixelKind::gray8},
     PixelKind::sum32,
     {},
     nullptr,
     [](Size size, const int*) { return squared_distance_scratch(size); },
     [](const OperatorCall& c) { return squared_distance(c.input<Gray8>(), c.scratch, c.out<Sum32>()); }},
    {"chamfer_distance",
     "about three times the distance to the nearest zero pixel",
     "",
     {PixelKind::gray8},
     PixelKind::gray16,
     {},
     nullptr,
     [](Size size, const int*) { return chamfer_distance_scratch(size); },
     [](const OperatorCall& c) { return chamfer_distance(c.input<Gray8>(), c.scratch, c.out<Gray16>()); }},
    {"erode_shape",
     "smallest value under an element of any shape",
     "2.7.1",
     {PixelKind::gray8},
     PixelKind::gray8,
     {shape, shape_side},
     nullptr,
     [](Size size, const int* values) { return erode_scratch(size, element_of(values)); },
     [](const OperatorCall& c) {
         return erode(c.input<Gray8>(), element_of(c.values), c.scratch, c.out<Gray8>());
     }},
    {"dilate_shape",
     "largest value under an element of any shape",
     "2.7.1",
     {PixelKind::gray8},
     PixelKind::gray8,
     {shape, shape_side},
     nullptr,
     [](Size size, const int* values) { return dilate_scratch(size, element_of(values)); },
     [](const OperatorCall& c) {
         return dilate(c.input<Gray8>(), element_of(c.values), c.scratch, c.out<Gray8>());
     }},
    {"opening_shape",
     "removes what is bright and does not hold the element",
     "2.7.1",
     {PixelKind::gray8},
     PixelKind::gray8,
     {shape, shape_side},
     nullptr,
     [](Size size, const int* values) { return opening_scratch(size, element_of(values)); },
     [](const OperatorCall& c) {
         return opening(c.input<Gray8>(), element_of(c.values), c.scratch, c.out<Gray8>());
     },
     true},
    {"closing_shape",
     "removes what is dark and does not hold the element",
     "2.7.1",
     {PixelKind::gray8},
     PixelKind::gray8,
     {shape, shape_side},
     nullptr,
     [](Size size, const int* values) { return closing_scratch(size, element_of(values)); },
     [](const OperatorCall& c) {
         return closing(c.input<Gray8>(), element_of(c.values), c.scratch, c.out<Gray8>());
     },
     true},
    {"thin",
     "lines of one pixel in the middle of regions",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {{"rule", 0, 1, 0, 1, "which pixels go", "zhang_suen|guo_hall"},
      {"passes", 1, most_thinning_passes, most_thinning_passes, 1,
       "at most; a region is one pixel thinner all around after each"}},
     nullptr,
     [](Size size, const int*) { return thin_scratch(size); },
     [](const OperatorCall& c) {
         return thin(c.input<Gray8>(), c.values[0] == 0 ? ThinningRule::zhang_suen : ThinningRule::guo_hall,
                     c.values[1], c.scratch, c.out<Gray8>());
     },
     true},
    {"hit_or_miss",
     "finds a pattern of pixels that are not 0 and pixels that are",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {pattern},
     nullptr,
     [](Size size, const int* v) { return hit_or_miss_scratch(size, hit_of(v[0]), miss_of(v[0])); },
     [](const OperatorCall& c) {
         if (!pattern.allows(c.values[0])) return Status::bad_argument;
         return hit_or_miss(c.input<Gray8>(), hit_of(c.values[0]), miss_of(c.values[0]), c.scratch,
                            c.out<Gray8>());
     }},
};

}  // namespace catalogue
}  // namespace FOVEA_ISA
}  // namespace fovea
