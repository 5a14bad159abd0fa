// SPDX-License-Identifier: MIT
//
// The catalogue's entries of statistics/.
#pragma once

#include <cstdint>

#include <fovea/catalogue/operator.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/statistics/clahe.hpp>
#include <fovea/statistics/equalize.hpp>
#include <fovea/statistics/integral_image.hpp>
#include <fovea/statistics/otsu_threshold.hpp>
#include <fovea/statistics/stretch.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace catalogue {

inline constexpr Operator statistics[] = {
    {"spread",
     "darkest level becomes 0, brightest 255",
     "2.4",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return spread(c.input<Gray8>(), c.out<Gray8>()); },
     true},
    {"histogram_stretching",
     "two quantiles become 0 and 255",
     "2.5.3",
     {PixelKind::gray8},
     PixelKind::gray8,
     {{"low", 0, 65536, 6554, 1, "share of the pixels, 1/65536"},
      {"high", 0, 65536, 58982, 1, "share of the pixels, 1/65536, not below low"}},
     nullptr,
     [](Size, const int*) { return histogram_stretching_scratch(); },
     [](const OperatorCall& c) {
         return histogram_stretching(c.input<Gray8>(), static_cast<std::uint32_t>(c.values[0]),
                                     static_cast<std::uint32_t>(c.values[1]), c.scratch, c.out<Gray8>());
     },
     true},
    {"otsu_threshold",
     "255 where a pixel belongs to the bright one of two classes, else 0",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     nullptr,
     [](Size, const int*) { return otsu_threshold_scratch(); },
     [](const OperatorCall& c) { return otsu_threshold(c.input<Gray8>(), c.scratch, c.out<Gray8>()); },
     true,
     "otsu",
     Status::degenerate},
    {"otsu_threshold_inverse",
     "255 where a pixel belongs to the dark one of two classes, else 0",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     nullptr,
     [](Size, const int*) { return otsu_threshold_scratch(); },
     [](const OperatorCall& c) {
         return otsu_threshold_inverse(c.input<Gray8>(), c.scratch, c.out<Gray8>());
     },
     true,
     nullptr,
     Status::degenerate},
    {"auto_scale_gray16",
     "smallest value becomes 0, largest 255",
     "",
     {PixelKind::gray16},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return auto_scale(c.input<Gray16>(), c.out<Gray8>()); }},
    {"auto_scale_gradient16",
     "smallest value becomes 0, largest 255",
     "",
     {PixelKind::gradient16},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return auto_scale(c.input<Gradient16>(), c.out<Gray8>()); }},
    {"auto_scale_sum32",
     "smallest value becomes 0, largest 255",
     "",
     {PixelKind::sum32},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return auto_scale(c.input<Sum32>(), c.out<Gray8>()); }},
    {"equalize",
     "all grey levels equally often, the darkest becomes 0",
     "2.5.4",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     nullptr,
     [](Size, const int*) { return equalize_scratch(); },
     [](const OperatorCall& c) { return equalize(c.input<Gray8>(), c.scratch, c.out<Gray8>()); },
     true},
    {"equalize_by_share",
     "each grey level becomes the share of pixels that are not brighter",
     "2.5.4",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     nullptr,
     [](Size, const int*) { return equalize_scratch(); },
     [](const OperatorCall& c) { return equalize_by_share(c.input<Gray8>(), c.scratch, c.out<Gray8>()); },
     true},
    {"normalize_colour",
     "each channel equalized by share on its own",
     "2.5.4",
     {PixelKind::rgb888},
     PixelKind::rgb888,
     {},
     nullptr,
     [](Size, const int*) { return normalize_colour_scratch(); },
     [](const OperatorCall& c) { return normalize_colour(c.input<Rgb888>(), c.scratch, c.out<Rgb888>()); },
     true},
    {"clahe",
     "equalized tile by tile, with bounded contrast",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {{"tiles_x", 1, max_clahe_tiles, 8, 1, "tiles across"},
      {"tiles_y", 1, max_clahe_tiles, 8, 1, "tiles down"},
      {"clip", min_clahe_clip, max_clahe_clip, 200, 1, "most of a level, 1/100 of the mean"}},
     nullptr,
     [](Size size, const int* values) {
         return clahe_scratch(size, {values[0], values[1]});
     },
     [](const OperatorCall& c) {
         return clahe(c.input<Gray8>(), {c.values[0], c.values[1]}, c.values[2], c.scratch, c.out<Gray8>());
     },
     true},
    {"integral_image",
     "sum of all pixels to the left and above",
     "",
     {PixelKind::gray8},
     PixelKind::sum32,
     {},
     [](Size size, const int*) { return integral_size(size); },
     nullptr,
     [](const OperatorCall& c) { return integral_image(c.input<Gray8>(), c.out<Sum32>()); }},
    {"integral_of_binary",
     "count of all pixels that are not 0 to the left and above",
     "",
     {PixelKind::gray8},
     PixelKind::sum32,
     {},
     [](Size size, const int*) { return integral_size(size); },
     nullptr,
     [](const OperatorCall& c) { return integral_of_binary(c.input<Gray8>(), c.out<Sum32>()); }},
    {"image_of_integral",
     "image that an integral image was made from",
     "",
     {PixelKind::sum32},
     PixelKind::gray8,
     {},
     [](Size size, const int*) {
         return Size{size.width - 1, size.height - 1};
     },
     nullptr,
     [](const OperatorCall& c) { return image_of_integral(c.input<Sum32>(), c.out<Gray8>()); }},
};

}  // namespace catalogue
}  // namespace FOVEA_ISA
}  // namespace fovea
