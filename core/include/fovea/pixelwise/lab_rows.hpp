// SPDX-License-Identifier: MIT
//
// Rows of lab_of() and of rgb_of() in lanes of 32 and 64 bits. Tables are looked up one by one between.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/lab_curves.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/cells.hpp>
#include <fovea/simd/interleave.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/products.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace kernels {

#if FOVEA_BYTES >= 16

// ---- From RGB ----

/// Pixels on their way to Lab.
struct LabRun {
    static constexpr int size = 2 * simd::lanes;
    std::int32_t red_green[size] = {};  ///< light: red in the lower half, green in the upper one
    std::int32_t blue[size] = {};
    std::int32_t xyz[3][size] = {};      ///< light, then two neighbours of the table of roots
    std::int32_t between[3][size] = {};  ///< the shares of the two
};

/// Two neighbours of the table, the first one in the lower half.
[[gnu::always_inline]] inline std::int32_t two_roots(std::uint32_t index) {
    const std::uint16_t* from = detail::lab_tables.root + index;
    if constexpr (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__) {
        std::int32_t both;
        std::memcpy(&both, from, sizeof both);
        return both;
    }
    return static_cast<std::int32_t>(from[0] | static_cast<std::uint32_t>(from[1]) << 16);
}

[[gnu::always_inline]] inline simd::Ints factors(std::uint32_t low, std::uint32_t high) {
    return simd::all_ints(static_cast<std::int32_t>(low | high << 16));
}

/// Light to places in the table of roots. Lights less 32768 have a sign, as their products must; the shares
/// sum to 65536, so 2^31 is missing of every sum. A share that is too large for a sign is taken in halves.
inline void mix_lights(LabRun& run, int i) {
    using simd::Ints;
    using simd::pair_sums;
    using simd::Unsigned;
    constexpr auto& share = detail::xyz_from_rgb;
    static_assert(share[1][1] % 2 == 0 && share[2][2] % 2 == 0, "halves must be whole");
    const Ints flip = factors(0x8000, 0x8000);
    const Ints red_green = simd::load_ints(run.red_green + i) ^ flip;
    const Ints blue = simd::load_ints(run.blue + i) ^ factors(0x8000, 0);
    const Ints blue_green = (red_green & factors(0, 0xffff)) | blue;
    const Ints red_blue = (red_green & 0xffff) | (blue << 16);
    const Ints sum[3] = {
        pair_sums(red_green, factors(share[0][0], share[0][1])) +
            pair_sums(blue_green, factors(share[0][2], 0)),
        pair_sums(red_green, factors(share[1][0], share[1][1] / 2)) +
            pair_sums(blue_green, factors(share[1][2], share[1][1] / 2)),
        pair_sums(red_blue, factors(share[2][0], share[2][2] / 2)) +
            pair_sums(blue_green, factors(share[2][2] / 2, share[2][1])),
    };
    constexpr int bits = detail::LabTables::step_bits;
    for (int k = 0; k < 3; ++k) {
        const Unsigned light = (simd::bits_as<Unsigned>(sum[k]) + (0x80000000u + (1u << 15))) >> 16;
        const Unsigned past = light & ((1u << bits) - 1);
        simd::store_ints(simd::bits_as<Ints>(light >> bits), run.xyz[k] + i);
        simd::store_ints(simd::bits_as<Ints>(((1u << bits) - past) | (past << 16)), run.between[k] + i);
    }
}

/// One of the three roots less 32768, so that it fits 16 bits with a sign.
[[gnu::always_inline]] inline simd::Ints lowered_roots(const LabRun& run, int number, int i) {
    constexpr int bits = detail::LabTables::step_bits;
    const simd::Ints two = simd::load_ints(run.xyz[number] + i) ^ factors(0x8000, 0x8000);
    return (simd::pair_sums(two, simd::load_ints(run.between[number] + i)) + (1 << (bits - 1))) >> bits;
}

/// Lightness, a and b of one vector, as lab_of() has them.
struct LabLanes {
    simd::Ints lightness;
    simd::Ints a;
    simd::Ints b;
};
[[gnu::always_inline]] inline LabLanes lab_of_roots(const LabRun& run, int i) {
    using simd::pair_sums;
    const simd::Ints x = lowered_roots(run, 0, i);
    const simd::Ints y = lowered_roots(run, 1, i);
    const simd::Ints z = lowered_roots(run, 2, i);
    // Over 25 * 2^17: over 25 as 5243 / 2^17, which is exact below 43690.
    constexpr std::int32_t step = 100 * detail::root_one;
    constexpr std::int32_t all_white = (29580 - 4080) * detail::root_one + step / 2;
    const simd::Ints parts = (pair_sums(y, factors(29580, 0)) + all_white) >> 17;
    return {pair_sums(parts, factors(5243, 0)) >> 17,
            ((pair_sums(x - y, factors(500, 0)) + (1 << 14)) >> 15) + 128,
            ((pair_sums(y - z, factors(200, 0)) + (1 << 14)) >> 15) + 128};
}

[[gnu::always_inline]] inline simd::ByteTriples lab_lanes(const LabRun& run, int i) {
    const LabLanes part[4] = {lab_of_roots(run, i), lab_of_roots(run, i + simd::places),
                              lab_of_roots(run, i + 2 * simd::places),
                              lab_of_roots(run, i + 3 * simd::places)};
    const auto bytes = [&](simd::Ints LabLanes::*which) {
        return simd::Bytes{
            simd::lowest_bytes(part[0].*which, part[1].*which, part[2].*which, part[3].*which)};
    };
    return {bytes(&LabLanes::lightness), bytes(&LabLanes::a), bytes(&LabLanes::b)};
}

/// lab_of() of up to LabRun::size pixels.
inline void lab_of_run(const std::uint8_t* from, int count, LabRun& run, std::uint8_t* to) {
    for (int i = 0; i < count; ++i) {
        const auto& light = detail::lab_tables.light;
        run.red_green[i] = static_cast<std::int32_t>(
            light[from[3 * i]] | static_cast<std::uint32_t>(light[from[3 * i + 1]]) << 16);
        run.blue[i] = light[from[3 * i + 2]];
    }
    for (int i = 0; i < count; i += simd::places) mix_lights(run, i);
    for (auto& roots : run.xyz)
        for (int i = 0; i < count; ++i) roots[i] = two_roots(static_cast<std::uint32_t>(roots[i]));
    int i = 0;
    for (; i + simd::lanes <= count; i += simd::lanes) simd::store_triples(lab_lanes(run, i), to + 3 * i);
    if (i == count) return;
    std::uint8_t last[3 * simd::lanes];
    simd::store_triples(lab_lanes(run, i), last);
    std::memcpy(to + 3 * i, last, 3 * static_cast<std::size_t>(count - i));
}

/// lab_of() of a row.
inline void lab_in_lanes(const std::uint8_t* from, int width, std::uint8_t* to) {
    LabRun run;
    for (int x = 0; x < width; x += LabRun::size)
        lab_of_run(from + std::ptrdiff_t{3} * x, minimum(LabRun::size, width - x), run,
                   to + std::ptrdiff_t{3} * x);
}

// ---- To RGB ----

/// The last root on the line of light_of_root(), where the curve has the same light.
inline constexpr std::int32_t line_end = detail::fine_root_one * 6 / 29;
/// Light is raised by this, which is more than it can be below zero; and differences of two lights.
inline constexpr std::uint64_t light_raise = 1 << 17;
inline constexpr std::uint64_t difference_raise = 1 << 21;

/// light_of_root(), raised, of the roots in the lower halves. One of the two is the root and the other where
/// line and curve meet, so that curve and line add up to one of them and the light there.
[[gnu::always_inline]] inline simd::Longs lights_of_roots(simd::Longs on_curve, simd::Longs on_line) {
    using simd::all_longs;
    using simd::Longs;
    constexpr int bits = 30 - detail::finer_bits;
    const Longs square = simd::low_products(on_curve, on_curve) >> 10;
    const Longs cube = simd::low_products(square, on_curve) >> 20;
    const Longs curve = ((cube << 16) - cube + all_longs(1 << (bits - 1))) >> bits;
    // A product, which for all roots that occur is the quotient: 108 * 65535 * 16 / (29 * 841 * 2^20) by
    // 2^32.
    constexpr std::uint64_t slope = 551545053;
    constexpr auto where_they_meet = static_cast<std::uint64_t>(detail::light_of_root(line_end));
    constexpr std::uint64_t start = ((light_raise - where_they_meet) << 32) - 658105365855359u;
    const Longs line = simd::low_products(on_line + all_longs(1 << 20), all_longs(slope)) + all_longs(start);
    return curve + (line >> 32);
}

/// What lights and shares sum up to is raised by this, to have no sign.
inline constexpr std::uint64_t sum_raise = 1 << 26;
inline constexpr int share_bits = 20 + detail::finer_bits;

/// x less y and z less y, raised, and y by 2^20, raised.
struct Lights {
    simd::Longs x;
    simd::Longs y;
    simd::Longs z;
};

[[gnu::always_inline]] inline Lights lights_of(simd::Longs x, simd::Longs y, simd::Longs z) {
    const simd::Longs raise = simd::all_longs(difference_raise);
    return {x - y + raise, y << 20, z - y + raise};
}

/// One row of rgb_from_xyz. It sums to one, so that the share of y is what the other two leave.
template <int Row>
[[gnu::always_inline]] inline simd::Longs mixed_lights(const Lights& light) {
    using simd::all_longs;
    constexpr std::int64_t of_x = detail::rgb_from_xyz[Row][0];
    constexpr std::int64_t of_z = detail::rgb_from_xyz[Row][2];
    constexpr std::uint64_t start = (sum_raise << share_bits) + (std::uint64_t{1} << (share_bits - 1)) -
                                    (light_raise << 20) -
                                    static_cast<std::uint64_t>(of_x + of_z) * difference_raise;
    const simd::Longs x =
        simd::low_products(light.x, all_longs(static_cast<std::uint64_t>(of_x < 0 ? -of_x : of_x)));
    const simd::Longs z =
        simd::low_products(light.z, all_longs(static_cast<std::uint64_t>(of_z < 0 ? -of_z : of_z)));
    simd::Longs sum = light.y + all_longs(start);
    sum = of_x < 0 ? sum - x : sum + x;
    return of_z < 0 ? sum - z : sum + z;
}

/// The light of two colours each, less 32768.
template <int Row>
[[gnu::always_inline]] inline simd::Ints lowered_light(const Lights& low, const Lights& high) {
    const simd::Longs upper = (mixed_lights<Row>(high) << (32 - share_bits)) & ~simd::all_longs(0xffffffffu);
    const auto raised = simd::bits_as<simd::Unsigned>((mixed_lights<Row>(low) >> share_bits) | upper);
    return simd::bits_as<simd::Ints>(raised - static_cast<std::uint32_t>(sum_raise + 32768));
}

struct LevelLanes {
    simd::Ints red;
    simd::Ints green;
    simd::Ints blue;
};

[[gnu::always_inline]] inline LevelLanes lights_of_lab(simd::Unsigned lightness, simd::Ints a, simd::Ints b) {
    using simd::bits_as;
    using simd::Ints;
    using simd::Longs;
    using simd::Unsigned;
    // The quotients of rgb_of() as products, tried for their 256 numbers each.
    const Ints y = bits_as<Ints>(((lightness * 14519835u + 2797u) >> 12) + 144631u);
    const Ints x = y + (((a - 128) * 8589935 + 2047) >> 12);
    const Ints z = y - (((b - 128) * 10737418 + 1023) >> 11);
    const auto on_curve = [](Ints root) {
        const Ints first = simd::all_ints(line_end);
        return bits_as<Unsigned>(root > first ? root : first);
    };
    const auto on_line = [](Ints root) {
        const Ints last = simd::all_ints(line_end);
        return bits_as<Unsigned>(root < last ? root : last);
    };
    const Unsigned curve[3] = {on_curve(x), on_curve(y), on_curve(z)};
    const Unsigned line[3] = {on_line(x), on_line(y), on_line(z)};
    const auto low = [&](int i) {
        return lights_of_roots(simd::low_halves(curve[i]), simd::low_halves(line[i]));
    };
    const auto high = [&](int i) {
        return lights_of_roots(simd::high_halves(curve[i]), simd::high_halves(line[i]));
    };
    const Lights lower = lights_of(low(0), low(1), low(2));
    const Lights upper = lights_of(high(0), high(1), high(2));
    return {lowered_light<0>(lower, upper), lowered_light<1>(lower, upper), lowered_light<2>(lower, upper)};
}

/// One colour of lanes pixels, even columns first: the cell of its light, and what it is past the start of
/// the cell.
struct CellRun {
    std::uint16_t cell[simd::lanes];
    std::uint16_t past[simd::lanes];
};

/// Light less 32768 of every second column, in two times every fourth.
[[gnu::always_inline]] inline void put_cells(simd::Ints first, simd::Ints second, int at, CellRun& run) {
    using Cells = detail::LightCells;
    using simd::all_words;
    using simd::RawWords;
    const RawWords light = simd::held_pairs(first, second) ^ all_words(0x8000);
    // Where cells are small, they are the lower ones by number.
    const RawWords cell = simd::lower_words(light >> Cells::dark_bits,
                                            (light >> Cells::bright_bits) + all_words(Cells::first_bright));
    const RawWords bright = simd::bits_as<RawWords>(simd::bits_as<simd::RawSigned>(cell) >
                                                    static_cast<std::int16_t>(Cells::dark_cells - 1));
    const RawWords past =
        light & all_words((1 << Cells::bright_bits) - 1) & (bright | all_words((1 << Cells::dark_bits) - 1));
    std::memcpy(run.cell + at, &cell, sizeof cell);
    std::memcpy(run.past + at, &past, sizeof past);
}

/// The levels of a run whose cells were looked up.
[[gnu::always_inline]] inline simd::Bytes levels_of(const CellRun& run) {
    const auto levels = [&](int at) {
        simd::RawWords cell;
        simd::RawWords past;
        std::memcpy(&cell, run.cell + at, sizeof cell);
        std::memcpy(&past, run.past + at, sizeof past);
        return (cell + past) >> 8;
    };
    return simd::Words(levels(0), levels(simd::lanes / 2)).narrow();
}

/// rgb_of() of lanes pixels.
inline void rgb_from_lab_step(const std::uint8_t* from, std::uint8_t* to) {
    using simd::bits_as;
    using simd::Ints;
    using simd::Unsigned;
    const simd::ByteTriples lab = simd::load_triples(from);
    CellRun run[3];
    // Every fourth column, and every fourth from two later on, which share a vector of even or odd columns.
    for (int parity = 0; parity < 2; ++parity) {
        const auto lights = [&](int shift) {
            const auto part = [shift](simd::Bytes bytes) {
                return (bits_as<Unsigned>(bytes.raw) >> shift) & 255u;
            };
            return lights_of_lab(part(lab.first), bits_as<Ints>(part(lab.second)),
                                 bits_as<Ints>(part(lab.third)));
        };
        constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
        const int shift = (parity == 1) != big_endian ? 8 : 0;
        const LevelLanes first = lights(shift);
        const LevelLanes second = lights(shift + 16);
        const int at = parity * simd::lanes / 2;
        put_cells(first.red, second.red, at, run[0]);
        put_cells(first.green, second.green, at, run[1]);
        put_cells(first.blue, second.blue, at, run[2]);
    }
    for (CellRun& colour : run)
        for (std::uint16_t& cell : colour.cell) cell = detail::light_cells.level[cell];
    simd::store_triples({levels_of(run[0]), levels_of(run[1]), levels_of(run[2])}, to);
}

#endif

}  // namespace kernels
}  // namespace FOVEA_ISA
}  // namespace fovea
