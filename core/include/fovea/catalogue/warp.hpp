// SPDX-License-Identifier: MIT
//
// The catalogue's entries of warp/.
#pragma once

#include <cstdint>

#include <fovea/catalogue/operator.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/warp/affine.hpp>
#include <fovea/warp/area.hpp>
#include <fovea/warp/flip.hpp>
#include <fovea/warp/homography.hpp>
#include <fovea/warp/polar.hpp>
#include <fovea/warp/pyramid.hpp>
#include <fovea/warp/resize.hpp>
#include <fovea/warp/sampling.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace catalogue {

inline constexpr OperatorParameter turn_angle{"angle", 0, 359, 30, 1, "degrees, clockwise on screen"};
inline constexpr OperatorParameter interpolation_choice{
    "interpolation", 0, 1, 1, 1, "what is made of the pixels around a place", "nearest|bilinear"};
inline constexpr OperatorParameter outside_choice{
    "outside", 0, 1, 1, 1, "what stands where the source does not reach", "replicate|constant"};
inline constexpr OperatorParameter outside_level{"level", 0, 255, 0, 1, "grey level of constant"};
inline constexpr OperatorParameter new_width{"width", 1, max_image_side, 48, 1, "columns of the output"};
inline constexpr OperatorParameter new_height{"height", 1, max_image_side, 40, 1, "rows of the output"};

constexpr OperatorParameter shift_of(const char* name) { return {name, -1000, 1000, 2, 1, "px"}; }
/// A coefficient in 1/1024.
constexpr OperatorParameter factor_of(const char* name, int preset) {
    return {name, -4096, 4096, preset, 1, "1/1024"};
}
/// A coefficient of the divisor.
constexpr OperatorParameter tilt_of(const char* name) { return {name, -4096, 4096, 300, 1, "2^-20 per px"}; }
constexpr std::int64_t coefficient_of(int factor) {
    return std::int64_t{factor} * (WarpCoefficient::one / 1024);
}
/// Whether four coefficients and the two shifts behind them are in range.
constexpr bool all_in_range(const OperatorCall& c) {
    for (int i = 0; i < 6; ++i) {
        const OperatorParameter parameter = i < 4 ? factor_of("", 0) : shift_of("");
        if (!parameter.allows(c.values[i])) return false;
    }
    return true;
}

constexpr Size turned(Size size, const int* /*values*/) { return {size.height, size.width}; }
constexpr Size same(Size size, const int* /*values*/) { return size; }
constexpr Size wanted(Size /*size*/, const int* values) { return {values[0], values[1]}; }

/// A resizing operator takes its parameters from the output.
template <class Resize>
Status resized(const OperatorCall& c, Resize resize) {
    if (c.output.size != wanted({}, c.values)) return Status::bad_argument;
    return resize(c.input<Gray8>(), c.scratch, c.out<Gray8>());
}

template <class Pixel>
Sampling<Pixel> sampling_of(const OperatorCall& c, int first, Pixel level) {
    return {static_cast<Interpolation>(c.values[first]), static_cast<Outside>(c.values[first + 1]), level};
}

template <class Pixel>
Status turn_about_middle(const OperatorCall& c, Pixel level) {
    if (c.values[0] < turn_angle.least || c.values[0] > turn_angle.most) return Status::bad_argument;
    const auto middle = [](int side) { return FinePixel::from_raw((side - 1) * (FinePixel::one / 2)); };
    const Size size = c.inputs[0].size;
    return rotate<Pixel>(c.input<Pixel>(), {middle(size.width), middle(size.height)},
                         Angle::from_degrees(c.values[0]), sampling_of<Pixel>(c, 1, level), c.out<Pixel>());
}

inline constexpr OperatorParameter inner_radius{"inner", 1, 30000, 2, 1, "px, of column 0"};
inline constexpr OperatorParameter outer_radius{"outer", 2, 32000, 40, 1, "px, behind the last column"};

constexpr std::int64_t polar_scratch(Size /*size*/, const int* values) {
    return warp_polar_scratch({values[0], values[1]});
}
/// About the middle of the input; no ring where a parameter is out of its range.
constexpr PolarFrame ring_about_middle(const OperatorCall& c, RadiusScale scale) {
    PolarFrame frame;
    if (c.output.size != wanted({}, c.values)) return frame;
    if (!inner_radius.allows(c.values[2]) || !outer_radius.allows(c.values[3])) return frame;
    const auto middle = [](int side) { return FinePixel::from_raw((side - 1) * (FinePixel::one / 2)); };
    frame.centre = {middle(c.inputs[0].size.width), middle(c.inputs[0].size.height)};
    frame.inner = FinePixel::from_int(c.values[2]);
    frame.outer = FinePixel::from_int(c.values[3]);
    frame.scale = scale;
    return frame;
}

inline constexpr Operator warp[] = {
    {"flip_x",
     "left and right exchanged",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return flip_x<Gray8>(c.input<Gray8>(), c.out<Gray8>()); }},
    {"flip_x_rgb",
     "left and right of a colour image exchanged",
     "",
     {PixelKind::rgb888},
     PixelKind::rgb888,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return flip_x<Rgb888>(c.input<Rgb888>(), c.out<Rgb888>()); }},
    {"flip_y",
     "top and bottom exchanged",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return flip_y<Gray8>(c.input<Gray8>(), c.out<Gray8>()); }},
    {"rotate_180",
     "half a turn",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     nullptr,
     nullptr,
     [](const OperatorCall& c) { return rotate_180<Gray8>(c.input<Gray8>(), c.out<Gray8>()); }},
    {"transpose",
     "rows become columns",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     turned,
     nullptr,
     [](const OperatorCall& c) { return transpose<Gray8>(c.input<Gray8>(), c.out<Gray8>()); }},
    {"transpose_rgb",
     "rows of a colour image become columns",
     "",
     {PixelKind::rgb888},
     PixelKind::rgb888,
     {},
     turned,
     nullptr,
     [](const OperatorCall& c) { return transpose<Rgb888>(c.input<Rgb888>(), c.out<Rgb888>()); }},
    {"rotate_90_clockwise",
     "a quarter turn clockwise",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     turned,
     nullptr,
     [](const OperatorCall& c) { return rotate_90_clockwise<Gray8>(c.input<Gray8>(), c.out<Gray8>()); }},
    {"rotate_90_counterclockwise",
     "a quarter turn counterclockwise",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     turned,
     nullptr,
     [](const OperatorCall& c) {
         return rotate_90_counterclockwise<Gray8>(c.input<Gray8>(), c.out<Gray8>());
     }},
    {"resize_nearest",
     "another size, by the nearest pixel",
     "2.9",
     {PixelKind::gray8},
     PixelKind::gray8,
     {new_width, new_height},
     wanted,
     [](Size size, const int* v) {
         return resize_nearest_scratch(size, {v[0], v[1]});
     },
     [](const OperatorCall& c) { return resized(c, resize_nearest<Gray8>); }},
    {"resize_bilinear",
     "another size, between four pixels",
     "2.9.2",
     {PixelKind::gray8},
     PixelKind::gray8,
     {new_width, new_height},
     wanted,
     [](Size size, const int* v) {
         return resize_bilinear_scratch(size, {v[0], v[1]});
     },
     [](const OperatorCall& c) { return resized(c, resize_bilinear); }},
    {"resize_bicubic",
     "another size, between sixteen pixels",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {new_width, new_height},
     wanted,
     [](Size size, const int* v) {
         return resize_bicubic_scratch(size, {v[0], v[1]});
     },
     [](const OperatorCall& c) { return resized(c, resize_bicubic); }},
    {"resize_area",
     "another size, by the mean over the area of every pixel",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {new_width, new_height},
     wanted,
     [](Size size, const int* v) {
         return resize_area_scratch(size, {v[0], v[1]});
     },
     [](const OperatorCall& c) { return resized(c, resize_area); }},
    {"pyramid_down",
     "half the size after a low-pass",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     [](Size size, const int*) { return pyramid_down_size(size); },
     [](Size size, const int*) { return pyramid_down_scratch(size); },
     [](const OperatorCall& c) { return pyramid_down(c.input<Gray8>(), c.scratch, c.out<Gray8>()); }},
    {"pyramid_up",
     "twice the size, interpolated",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {},
     [](Size size, const int*) {
         return Size{2 * size.width, 2 * size.height};
     },
     [](Size size, const int*) { return pyramid_up_scratch(size); },
     [](const OperatorCall& c) { return pyramid_up(c.input<Gray8>(), c.scratch, c.out<Gray8>()); }},
    {"rotate",
     "turns what lies along an angle onto the x axis, about the middle of the image",
     "2.9.3",
     {PixelKind::gray8},
     PixelKind::gray8,
     {turn_angle, interpolation_choice, outside_choice, outside_level},
     same,
     nullptr,
     [](const OperatorCall& c) { return turn_about_middle<Gray8>(c, c.level(3)); }},
    {"rotate_rgb",
     "the same with a colour image",
     "2.9.3",
     {PixelKind::rgb888},
     PixelKind::rgb888,
     {turn_angle, interpolation_choice, outside_choice, outside_level},
     same,
     nullptr,
     [](const OperatorCall& c) {
         return turn_about_middle<Rgb888>(c, {c.level(3), c.level(3), c.level(3)});
     }},
    {"warp_affine",
     "output (x, y) comes from (xx x + xy y + x0, yx x + yy y + y0)",
     "2.9.3",
     {PixelKind::gray8},
     PixelKind::gray8,
     {factor_of("xx", 900), factor_of("xy", 200), factor_of("yx", -100), factor_of("yy", 1100),
      shift_of("x0"), shift_of("y0"), interpolation_choice, outside_choice},
     same,
     nullptr,
     [](const OperatorCall& c) {
         if (!all_in_range(c)) return Status::bad_argument;
         const auto factor = [&](int i) { return WarpCoefficient::from_raw(coefficient_of(c.values[i])); };
         const auto shift = [&](int i) { return WarpCoefficient::from_int(c.values[i]); };
         const AffineTransform t{factor(0), factor(1), shift(4), factor(2), factor(3), shift(5)};
         return warp_affine<Gray8>(c.input<Gray8>(), t, sampling_of<Gray8>(c, 6, 0), c.out<Gray8>());
     }},
    {"warp_homography",
     "output (x, y) comes from (x + xy y + x0, yx x + y + y0) / (wx x + wy y + 1)",
     "2.9",
     {PixelKind::gray8},
     PixelKind::gray8,
     {tilt_of("wx"), tilt_of("wy"), factor_of("xy", 100), factor_of("yx", -50), shift_of("x0"),
      shift_of("y0"), interpolation_choice, outside_choice},
     same,
     nullptr,
     [](const OperatorCall& c) {
         if (!all_in_range(c)) return Status::bad_argument;
         Homography h;
         h.xy = coefficient_of(c.values[2]);
         h.x0 = WarpCoefficient::from_int(c.values[4]).raw();
         h.yx = coefficient_of(c.values[3]);
         h.y0 = WarpCoefficient::from_int(c.values[5]).raw();
         h.wx = std::int64_t{c.values[0]} * (1 << 20);
         h.wy = std::int64_t{c.values[1]} * (1 << 20);
         return warp_homography<Gray8>(c.input<Gray8>(), h, sampling_of<Gray8>(c, 6, 0), c.out<Gray8>());
     }},
    {"polar",
     "rings about the middle become columns, one turn the height",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {new_width, new_height, inner_radius, outer_radius, interpolation_choice, outside_choice, outside_level},
     wanted,
     polar_scratch,
     [](const OperatorCall& c) {
         return warp_polar<Gray8>(c.input<Gray8>(), ring_about_middle(c, RadiusScale::linear),
                                  sampling_of<Gray8>(c, 4, c.level(6)), c.scratch, c.out<Gray8>());
     }},
    {"log_polar",
     "the same with radii that grow by a factor with every column",
     "",
     {PixelKind::gray8},
     PixelKind::gray8,
     {new_width, new_height, inner_radius, outer_radius, interpolation_choice, outside_choice, outside_level},
     wanted,
     polar_scratch,
     [](const OperatorCall& c) {
         return warp_polar<Gray8>(c.input<Gray8>(), ring_about_middle(c, RadiusScale::logarithmic),
                                  sampling_of<Gray8>(c, 4, c.level(6)), c.scratch, c.out<Gray8>());
     }},
};

}  // namespace catalogue
}  // namespace FOVEA_ISA
}  // namespace fovea
