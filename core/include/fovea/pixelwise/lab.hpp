// SPDX-License-Identifier: MIT
//
// Colour as the eye tells it apart: CIE L*a*b*, from sRGB and back.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/convert_frame.hpp>
#include <fovea/pixelwise/lab_curves.hpp>
#include <fovea/pixelwise/lab_rows.hpp>
#include <fovea/simd/interleave.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Lightness and two opponent colours: a from green to red, b from blue to yellow. Equal distances look about
/// equally different.
///
/// Units     lightness 0..255 for 0..100; a and b in steps of one with 128 at zero
/// Rounding  nearest; within 0.6 of the real formula, so at most one step off
/// Source    IEC 61966-2-1 (sRGB) and CIE 15, white D65
constexpr Lab888 lab_of(Rgb888 colour);

/// The inverse of lab_of(). Colours that a screen cannot show are held at its ends.
///
/// Rounding  nearest; within 0.6 of the real formula
constexpr Rgb888 rgb_of(Lab888 colour);

inline namespace FOVEA_ISA {

/// lab_of() of every pixel.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch
/// Source   as lab_of()
inline Status to_lab(ImageView<const Rgb888> src, ImageView<Lab888> dst);

/// rgb_of() of every pixel. All else as to_lab().
inline Status to_rgb(ImageView<const Lab888> src, ImageView<Rgb888> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

constexpr Lab888 lab_of(Rgb888 colour) {
    const std::uint32_t red = detail::lab_tables.light[colour.red];
    const std::uint32_t green = detail::lab_tables.light[colour.green];
    const std::uint32_t blue = detail::lab_tables.light[colour.blue];
    const std::int32_t x = detail::mixed_root(red, green, blue, detail::xyz_from_rgb[0]);
    const std::int32_t y = detail::mixed_root(red, green, blue, detail::xyz_from_rgb[1]);
    const std::int32_t z = detail::mixed_root(red, green, blue, detail::xyz_from_rgb[2]);
    // 2.55 (116 y - 16), 500 (x - y) and 200 (y - z), the first below 2^30.
    // Never negative: the smallest root is 16/116.
    constexpr std::uint32_t step = 100 * detail::root_one;
    const auto lightness = static_cast<std::uint32_t>(29580 * y - 4080 * detail::root_one);
    return {static_cast<std::uint8_t>((lightness + step / 2) / step),
            static_cast<std::uint8_t>(128 + round_shift(500 * (x - y), 15)),
            static_cast<std::uint8_t>(128 + round_shift(200 * (y - z), 15))};
}

constexpr Rgb888 rgb_of(Lab888 colour) {
    constexpr std::int64_t one = detail::fine_root_one;
    const std::int64_t y = round_divide((colour.lightness * 100 + 4080) * one, std::int64_t{29580});
    const std::int64_t x = y + round_divide((colour.a - 128) * one, std::int64_t{500});
    const std::int64_t z = y - round_divide((colour.b - 128) * one, std::int64_t{200});
    const std::int64_t light[3] = {detail::light_of_root(x), detail::light_of_root(y),
                                   detail::light_of_root(z)};
    std::uint8_t level[3] = {};
    for (int i = 0; i < 3; ++i) {
        const auto& share = detail::rgb_from_xyz[i];
        level[i] = detail::level_of_light(round_shift(
            share[0] * light[0] + share[1] * light[1] + share[2] * light[2], 20 + detail::finer_bits));
    }
    return {level[0], level[1], level[2]};
}

inline namespace FOVEA_ISA {

namespace kernels {

/// to_lab() of one row.
inline void lab_row(const Rgb888* src, int width, Lab888* dst) {
#if FOVEA_BYTES >= 16
    lab_in_lanes(&src->red, width, &dst->lightness);
#else
    for (int x = 0; x < width; ++x) dst[x] = lab_of(src[x]);
#endif
}

/// to_rgb() of one row.
inline void rgb_from_lab_row(const Lab888* src, int width, Rgb888* dst) {
#if FOVEA_BYTES >= 16
    simd::for_each_step<3, 3>(&src->lightness, width, &dst->red, rgb_from_lab_step);
#else
    for (int x = 0; x < width; ++x) dst[x] = rgb_of(src[x]);
#endif
}

}  // namespace kernels

inline Status to_lab(ImageView<const Rgb888> src, ImageView<Lab888> dst) {
    return detail::convert_frame(src, dst, kernels::lab_row);
}

inline Status to_rgb(ImageView<const Lab888> src, ImageView<Rgb888> dst) {
    return detail::convert_frame(src, dst, kernels::rgb_from_lab_row);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
