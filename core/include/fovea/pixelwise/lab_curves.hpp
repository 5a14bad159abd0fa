// SPDX-License-Identifier: MIT
//
// The curves of sRGB and of CIE L*a*b* in whole numbers: the tables and formulas behind lab.hpp.
#pragma once

#include <cstdint>

#include <fovea/number/integer.hpp>

namespace fovea {
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
    std::uint16_t root[steps + 1];  ///< at every 64 of light; off by 0.00007 between, at the knee
};

/// Light is cut into cells so small that no more than one boundary between levels lies in each: of 16 where a
/// level is little light, of 128 above.
struct LightCells {
    static constexpr std::uint32_t bright = 8192;
    static constexpr int dark_bits = 4;
    static constexpr int bright_bits = 7;
    static constexpr std::uint32_t dark_cells = bright >> dark_bits;
    static constexpr std::uint32_t first_bright = dark_cells - (bright >> bright_bits);
    static constexpr std::uint32_t count = first_bright + (1 << (16 - bright_bits));
    /// 256 times the level at the start of a cell, and so much that the light past the start carries into the
    /// next level from the boundary on.
    std::uint16_t level[count];

    constexpr std::uint8_t level_at(std::uint32_t cell, std::uint32_t past_start) const {
        return static_cast<std::uint8_t>((level[cell] + past_start) >> 8);
    }
};

constexpr LabTables make_lab_tables() {
    LabTables tables{};
    for (int level = 0; level < 256; ++level)
        tables.light[level] = static_cast<std::uint16_t>(light_of_half_level(2 * level));
    for (int i = 0; i <= LabTables::steps; ++i)
        tables.root[i] = static_cast<std::uint16_t>(root_of_light(i << LabTables::step_bits));
    return tables;
}
constexpr LightCells make_light_cells() {
    LightCells cells{};
    int level = 0;
    int boundary = light_of_half_level(1);  // the light from which on the nearest level is the next
    for (std::uint32_t i = 0; i < LightCells::count; ++i) {
        const bool dark = i < LightCells::dark_cells;
        const auto start = static_cast<int>(dark ? i << LightCells::dark_bits
                                                 : (i - LightCells::first_bright) << LightCells::bright_bits);
        const int size = 1 << (dark ? LightCells::dark_bits : LightCells::bright_bits);
        if (boundary == start) boundary = light_of_half_level(2 * ++level + 1);
        cells.level[i] = static_cast<std::uint16_t>(level << 8);
        if (level == 255 || boundary >= start + size) continue;
        cells.level[i] = static_cast<std::uint16_t>(cells.level[i] + 256 - (boundary - start));
        boundary = light_of_half_level(2 * ++level + 1);
    }
    return cells;
}
inline constexpr LabTables lab_tables = make_lab_tables();
inline constexpr LightCells light_cells = make_light_cells();

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
    const auto held = static_cast<std::uint32_t>(clamp<std::int64_t>(light, 0, full_light));
    const bool dark = held < LightCells::bright;
    const int bits = dark ? LightCells::dark_bits : LightCells::bright_bits;
    return light_cells.level_at((held >> bits) + (dark ? 0 : LightCells::first_bright),
                                held & ((1u << bits) - 1));
}

}  // namespace detail
}  // namespace fovea
