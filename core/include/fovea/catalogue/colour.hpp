// SPDX-License-Identifier: MIT
//
// The catalogue's entries of the colour conversions in pixelwise/.
#pragma once

#include <cstdint>

#include <fovea/catalogue/operator.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/bayer.hpp>
#include <fovea/pixelwise/colour_class.hpp>
#include <fovea/pixelwise/hsv.hpp>
#include <fovea/pixelwise/lab.hpp>
#include <fovea/pixelwise/planes.hpp>
#include <fovea/pixelwise/rgb565.hpp>
#include <fovea/pixelwise/to_gray.hpp>
#include <fovea/pixelwise/yuv.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace catalogue {

inline constexpr OperatorParameter video_range{
    "range", 0, 1, 1, 1, "numbers for black and white: 0 and 255, or 16 and 235", "full|narrow"};
inline constexpr OperatorParameter bayer_pattern{
    "pattern", 0, 3, 0, 1, "colours of the first 2x2 pixels", "rggb|grbg|gbrg|bggr"};
inline constexpr OperatorParameter hue_first{
    "hue_first", 0, hue_turn - 1, 0, 1, "first hue in 2 degrees; above hue_last for a range through red"};
inline constexpr OperatorParameter hue_last{"hue_last", 0, hue_turn - 1, 30, 1, "last hue in 2 degrees"};
inline constexpr OperatorParameter saturation_low{"saturation_low", 0, 255, 64, 1, "lowest saturation"};
inline constexpr OperatorParameter saturation_high{
    "saturation_high", 0, 255, 255, 1, "highest saturation, not below the lowest"};
inline constexpr OperatorParameter value_low{"value_low", 0, 255, 32, 1, "lowest value"};
inline constexpr OperatorParameter value_high{"value_high", 0, 255,
                                              255,          1, "highest value, not below the lowest"};

inline YuvRange video_range_of(const OperatorCall& c) { return static_cast<YuvRange>(c.values[0]); }
inline HsvRange hsv_range_of(const OperatorCall& c) {
    return {c.level(0), c.level(1), c.level(2), c.level(3), c.level(4), c.level(5)};
}

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
    {"to_lab",
     "CIE L*a*b* of a colour image",
     "",
     {PixelKind::rgb888},
     PixelKind::lab888,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_lab(c.input<Rgb888>(), c.out<Lab888>()); }},
    {"rgb_from_lab",
     "colours of CIE L*a*b*",
     "",
     {PixelKind::lab888},
     PixelKind::rgb888,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_rgb(c.input<Lab888>(), c.out<Rgb888>()); }},
    {"rgb_from_yuyv",
     "colour of a YUYV image",
     "",
     {PixelKind::yuyv},
     PixelKind::rgb888,
     {video_range},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_rgb(c.input<Yuyv>(), video_range_of(c), c.out<Rgb888>()); }},
    {"rgb_from_uyvy",
     "colour of a UYVY image",
     "",
     {PixelKind::uyvy},
     PixelKind::rgb888,
     {video_range},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_rgb(c.input<Uyvy>(), video_range_of(c), c.out<Rgb888>()); }},
    {"stretched_gray_from_yuyv",
     "brightness of a YUYV image with black 0 and white 255",
     "",
     {PixelKind::yuyv},
     PixelKind::gray8,
     {video_range},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_gray(c.input<Yuyv>(), video_range_of(c), c.out<Gray8>()); }},
    {"stretched_gray_from_uyvy",
     "brightness of a UYVY image with black 0 and white 255",
     "",
     {PixelKind::uyvy},
     PixelKind::gray8,
     {video_range},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_gray(c.input<Uyvy>(), video_range_of(c), c.out<Gray8>()); }},
    {"stretched_gray_from_luma",
     "brightness of a plane of luma with black 0 and white 255",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {video_range},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return to_gray(c.input<Gray8>(), video_range_of(c), c.out<Gray8>()); },
     true},
    {"rgb565_to_rgb",
     "colour of a 16-bit image",
     "",
     {PixelKind::rgb565},
     PixelKind::rgb888,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return rgb565_to_rgb(c.input<Rgb565>(), c.out<Rgb888>()); }},
    {"rgb565_to_gray",
     "brightness of a 16-bit colour image",
     "",
     {PixelKind::rgb565},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return rgb565_to_gray(c.input<Rgb565>(), c.out<Gray8>()); }},
    {"demosaic",
     "colour from a Bayer mosaic, at full size",
     "",
     {PixelKind::gray8},
     PixelKind::rgb888,
     {bayer_pattern},
     nullptr,
     nullptr,
     [](const OperatorCall& c) {
         return demosaic(c.input<Gray8>(), static_cast<BayerPattern>(c.values[0]), c.out<Rgb888>());
     }},
    {"demosaic_half",
     "colour from a Bayer mosaic, one pixel of each 2x2",
     "",
     {PixelKind::gray8},
     PixelKind::rgb888,
     {bayer_pattern},
     [](Size size, const int*) { return half_size(size); },
     nullptr,
     [](const OperatorCall& c) {
         return demosaic_half(c.input<Gray8>(), static_cast<BayerPattern>(c.values[0]), c.out<Rgb888>());
     }},
    {"hsv_range",
     "255 where hue, saturation and value are within bounds, else 0",
     "2.8.2",
     {PixelKind::hsv888},
     PixelKind::gray8,
     {hue_first, hue_last, saturation_low, saturation_high, value_low, value_high},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return hsv_range(c.input<Hsv888>(), hsv_range_of(c), c.out<Gray8>()); }},
    {"hsv_range_of_rgb",
     "hsv_range of a colour image",
     "2.8.2",
     {PixelKind::rgb888},
     PixelKind::gray8,
     {hue_first, hue_last, saturation_low, saturation_high, value_low, value_high},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return hsv_range(c.input<Rgb888>(), hsv_range_of(c), c.out<Gray8>()); }},
    {"colour_class",
     "255 where a colour belongs to a class, else 0",
     "2.8.2",
     {PixelKind::rgb888},
     PixelKind::gray8,
     {{"class", 0, 6, 4, 1, "the class", "skin|yellow|orange|red|blue|green|white"}},
     nullptr,
     nullptr,
     [](const OperatorCall& c) {
         return hsv_range(c.input<Rgb888>(), colour_classes[c.values[0]].range(), c.out<Gray8>());
     }},
};

}  // namespace catalogue
}  // namespace FOVEA_ISA
}  // namespace fovea
