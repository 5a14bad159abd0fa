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

/// lab_of() of every pixel.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch
/// Source   as lab_of()
inline Status to_lab(ImageView<const Rgb888> src, ImageView<Lab888> dst);

/// rgb_of() of every pixel. All else as to_lab().
inline Status to_rgb(ImageView<const Lab888> src, ImageView<Rgb888> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Light of 1 in all that follows, and the cube root of 1.
inline constexpr std::int32_t full_light = 65535;
inline constexpr std::int32_t root_one = 1 << 15;
/// The light of half a level of sRGB, 0..510: ((level + 0.055) / 1.055)^2.4 of it, the square times the fifth
/// root of the square; or level / 12.92 near black. In 1/2^30 inside, off by less than 2^-27.
constexpr std::int32_t light_of_half_level(int halves) {
    if (halves <= 20) {
        // halves / 510 / 12.92
        return static_cast<std::int32_t>(
            round_divide<std::int64_t>(std::int64_t{halves} * full_light * 100, 510 * 1292));
    }
    constexpr int bits = 30;
    const std::uint64_t level =
        ((std::uint64_t{500} * static_cast<unsigned>(halves) + 14025) << bits) / 269025;
    const std::uint64_t square = (level * level) >> bits;
    std::uint64_t root = 0;
    for (std::uint64_t bit = std::uint64_t{1} << bits; bit != 0; bit >>= 1) {
        const std::uint64_t more = root | bit;
        const std::uint64_t second = (more * more) >> bits;
        const std::uint64_t fifth = (((second * second) >> bits) * more) >> bits;
        if (fifth <= square) root = more;
    }
    const std::uint64_t light = (square * root) >> bits;
    return static_cast<std::int32_t>(round_shift(light * full_light, bits));
}

/// The cube root of a share of full_light, to the nearest 1/32768; below (6/29)^3 the line that touches it.
constexpr std::int32_t root_of_light(std::int32_t light) {
    // (6/29)^3 = 216/24389
    if (std::int64_t{light} * 24389 <= std::int64_t{full_light} * 216)
        return static_cast<std::int32_t>(round_divide<std::int64_t>(
            root_one * (std::int64_t{24389} * light + 432 * full_light), std::int64_t{3132} * full_light));
    // The largest root whose middle to the one below is not above: (2 root - 1)^3 full_light <= light 2^48.
    const std::uint64_t bound =
        light > full_light ? ~std::uint64_t{0} : static_cast<std::uint64_t>(light) << 48;
    std::uint64_t root = 0;
    for (std::uint64_t bit = root_one; bit != 0; bit >>= 1) {
        const std::uint64_t odd = 2 * (root | bit) - 1;
        if (root + bit <= root_one && odd * odd * odd * full_light <= bound) root |= bit;
    }
    return static_cast<std::int32_t>(root);
}

struct LabTables {
    static constexpr int step_bits = 6;
    static constexpr int steps = 1 << (16 - step_bits);
    std::uint16_t light[256];       ///< of every level
    std::uint16_t boundary[256];    ///< the light from which on the nearest level is the next
    std::uint8_t first_level[256];  ///< the nearest level of 0, 256, 512 ... of light
    std::uint16_t root[steps + 1];  ///< at every 64 of light; off by 0.00007 between, at the knee
};

constexpr LabTables make_lab_tables() {
    LabTables tables{};
    for (int level = 0; level < 256; ++level) {
        tables.light[level] = static_cast<std::uint16_t>(light_of_half_level(2 * level));
        tables.boundary[level] =
            static_cast<std::uint16_t>(level == 255 ? full_light : light_of_half_level(2 * level + 1));
    }
    for (int i = 0, level = 0; i < 256; ++i) {
        while (level < 255 && 256 * i >= tables.boundary[level]) ++level;
        tables.first_level[i] = static_cast<std::uint8_t>(level);
    }
    for (int i = 0; i <= LabTables::steps; ++i)
        tables.root[i] = static_cast<std::uint16_t>(root_of_light(i << LabTables::step_bits));
    return tables;
}
inline constexpr LabTables lab_tables = make_lab_tables();

// Shares of red, green and blue in X, Y and Z of white, in 1/65536, and back, in 1/2^20; each row sums to 1,
// so that gray has no colour.
inline constexpr std::uint32_t xyz_from_rgb[3][3] = {
    {28439, 24655, 12442}, {13938, 46868, 4730}, {1164, 7174, 57198}};
inline constexpr std::int32_t rgb_from_xyz[3][3] = {
    {3229566, -1611806, -569184}, {-966009, 1967140, 47445}, {55456, -213937, 1207057}};

/// The root of a mixture of lights. The products sum up to 65535 * 65536.
constexpr std::int32_t mixed_root(std::uint32_t red, std::uint32_t green, std::uint32_t blue,
                                  const std::uint32_t (&share)[3]) {
    const std::uint32_t light = (red * share[0] + green * share[1] + blue * share[2] + (1u << 15)) >> 16;
    const std::uint32_t index = light >> LabTables::step_bits;
    const std::int32_t here = lab_tables.root[index];
    const std::int32_t next = lab_tables.root[index + 1];
    const auto between = static_cast<std::int32_t>(light & ((1u << LabTables::step_bits) - 1));
    return here + round_shift((next - here) * between, LabTables::step_bits);
}

/// Roots on the way back have 1/2^20, because two bright lights may cancel to a dark one, where a level is
/// little light.
inline constexpr std::int64_t fine_root_one = 1 << 20;

/// The light of a fine root of up to 2, in 1/16 of full_light's unit.
inline constexpr int finer_bits = 4;
constexpr std::int64_t light_of_root(std::int64_t root) {
    constexpr std::int64_t one = fine_root_one;
    if (root * 29 <= one * 6)
        return round_divide((root * 29 - 4 * one) * 108 * (full_light << finer_bits), 29 * 841 * one);
    // The square has 42 bits, of which 32 stay, the cube 53, of which 33 stay, their product with
    // full_light 49.
    return round_shift((((root * root >> 10) * root) >> 20) * full_light, 30 - finer_bits);
}

constexpr std::uint8_t level_of_light(std::int64_t light) {
    if (light <= 0) return 0;
    if (light >= full_light) return 255;
    int level = lab_tables.first_level[light >> 8];
    while (light >= lab_tables.boundary[level]) ++level;
    return static_cast<std::uint8_t>(level);
}

}  // namespace detail

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

inline Status to_lab(ImageView<const Rgb888> src, ImageView<Lab888> dst) {
    return detail::convert_frame(src, dst, [](const Rgb888* from, int width, Lab888* to) {
        for (int x = 0; x < width; ++x) to[x] = lab_of(from[x]);
    });
}

inline Status to_rgb(ImageView<const Lab888> src, ImageView<Rgb888> dst) {
    return detail::convert_frame(src, dst, [](const Lab888* from, int width, Rgb888* to) {
        for (int x = 0; x < width; ++x) to[x] = rgb_of(from[x]);
    });
}

}  // namespace fovea
