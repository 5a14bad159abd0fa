// SPDX-License-Identifier: MIT
//
// Weighted sums over two or four rows, and over two or four neighbours that stand anywhere in a line: what
// resizing is made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/number/integer.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/cells.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// Two values of 16 bits, as they lie one after the other in a line.
struct Pair {
    std::int16_t first;
    std::int16_t second;
};

/// Pixels of one call of the functions across a line.
inline constexpr int taps_length = 64;

/// line[x] = a[x] * (256 - weight) + b[x] * weight - 32768, for weights 0..256.
inline void blend_rows(const std::uint8_t* a, const std::uint8_t* b, int weight, int width,
                       std::int16_t* line) {
    int x = 0;
#if FOVEA_BYTES >= 16
    const RawWords by = all_words(static_cast<std::uint16_t>(weight));
    for (; x + half_lanes <= width; x += half_lanes) {
        const RawWords upper = widened(a + x);
        const RawWords sum = ((upper << 8) + (widened(b + x) - upper) * by) ^ 0x8000;
        std::memcpy(line + x, &sum, sizeof sum);
    }
#endif
    for (; x < width; ++x) line[x] = static_cast<std::int16_t>(a[x] * (256 - weight) + b[x] * weight - 32768);
}

/// line[x] = the sum of four rows with weights of 11 fraction bits, rounded to 6 fraction bits. The sum of
/// the weights' magnitudes is at most 1.25, so that it stays within 20400.
inline void weigh_rows(const std::uint8_t* const (&rows)[4], const std::int16_t (&weights)[4], int width,
                       std::int16_t* line) {
    int x = 0;
#if FOVEA_BYTES >= 16
    const auto pair = [](std::int16_t low, std::int16_t high) {
        return all_ints(
            static_cast<std::int32_t>(static_cast<std::uint16_t>(low) |
                                      static_cast<std::uint32_t>(static_cast<std::uint16_t>(high)) << 16));
    };
    const Ints upper = pair(weights[0], weights[1]);
    const Ints lower = pair(weights[2], weights[3]);
    for (; x + half_lanes <= width; x += half_lanes) {
        const auto a = bits_as<Unsigned>(widened(rows[0] + x));
        const auto b = bits_as<Unsigned>(widened(rows[1] + x));
        const auto c = bits_as<Unsigned>(widened(rows[2] + x));
        const auto d = bits_as<Unsigned>(widened(rows[3] + x));
        // Columns in the lower halves of the lanes, then those in the upper halves.
        const Ints low = pair_sums(bits_as<Ints>((a & 0xffff) | (b << 16)), upper) +
                         pair_sums(bits_as<Ints>((c & 0xffff) | (d << 16)), lower);
        const Ints high = pair_sums(bits_as<Ints>((a >> 16) | (b & 0xffff0000u)), upper) +
                          pair_sums(bits_as<Ints>((c >> 16) | (d & 0xffff0000u)), lower);
        const Ints sum = (((low + 16) >> 5) & 0xffff) | (((high + 16) >> 5) << 16);
        std::memcpy(line + x, &sum, sizeof sum);
    }
#endif
    for (; x < width; ++x) {
        int sum = 16;
        for (int k = 0; k < 4; ++k) sum += rows[k][x] * weights[k];
        line[x] = static_cast<std::int16_t>(sum >> 5);
    }
}

/// dst[i] = (line[at[i]] * w.first + line[at[i] + 1] * w.second) / 2^16 to the nearest, for a line of
/// blend_rows() and weights whose sum is 256; count up to taps_length.
inline void blend_pairs(const std::int16_t* line, const std::int32_t* at, const Pair* weights, int count,
                        std::uint8_t* dst) {
#if FOVEA_BYTES >= 16
    if (count == taps_length) {
        std::int32_t cells[taps_length];
        for (int i = 0; i < taps_length; ++i) std::memcpy(cells + i, line + at[i], sizeof cells[i]);
        for (int i = 0; i < taps_length; i += FOVEA_BYTES) {
            const auto lanes_from = [&](int k) {
                return (pair_sums(load_ints(cells + k), load_raw<Ints>(weights + k)) + 32768 * 257) >> 16;
            };
            const RawBytes pixels = lowest_bytes(lanes_from(i), lanes_from(i + places),
                                                 lanes_from(i + 2 * places), lanes_from(i + 3 * places));
            std::memcpy(dst + i, &pixels, sizeof pixels);
        }
        return;
    }
#endif
    for (int i = 0; i < count; ++i) {
        const std::int16_t* from = line + at[i];
        const int sum = from[0] * weights[i].first + from[1] * weights[i].second;
        dst[i] = static_cast<std::uint8_t>((sum + 32768 * 257) >> 16);
    }
}

/// dst[i] = the sum of line[at[i]] and the three values behind it with weights of 11 fraction bits, for a
/// line of weigh_rows(): to the nearest, held at 0 and 255; count up to taps_length. The sums stay below
/// 2^26.
inline void weigh_fours(const std::int16_t* line, const std::int32_t* at, const Pair* first_weights,
                        const Pair* last_weights, int count, std::uint8_t* dst) {
#if FOVEA_BYTES >= 16
    if (count == taps_length) {
        std::int32_t first[taps_length];
        std::int32_t last[taps_length];
        for (int i = 0; i < taps_length; ++i) {
            std::memcpy(first + i, line + at[i], sizeof first[i]);
            std::memcpy(last + i, line + at[i] + 2, sizeof last[i]);
        }
        for (int i = 0; i < taps_length; i += FOVEA_BYTES) {
            const auto lanes_from = [&](int k) {
                const auto a = load_raw<Ints>(first_weights + k);
                const auto b = load_raw<Ints>(last_weights + k);
                const Ints sum = pair_sums(load_ints(first + k), a) + pair_sums(load_ints(last + k), b);
                return held((sum + (1 << 16)) >> 17, all_ints(255));
            };
            const RawBytes pixels = lowest_bytes(lanes_from(i), lanes_from(i + places),
                                                 lanes_from(i + 2 * places), lanes_from(i + 3 * places));
            std::memcpy(dst + i, &pixels, sizeof pixels);
        }
        return;
    }
#endif
    for (int i = 0; i < count; ++i) {
        const std::int16_t* from = line + at[i];
        const int sum = from[0] * first_weights[i].first + from[1] * first_weights[i].second +
                        from[2] * last_weights[i].first + from[3] * last_weights[i].second;
        dst[i] = static_cast<std::uint8_t>(clamp((sum + (1 << 16)) >> 17, 0, 255));
    }
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
