// SPDX-License-Identifier: MIT
//
// Bytes looked up in four tables at once and blended by where they lie between them.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/simd/dots.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/unroll.hpp>

#if FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// Four tables of bytes at the corners of an area, made ready for blend_row(): in the halves of a word stand
/// the entries of the upper and of the lower table.
struct TableBlend {
    std::uint32_t left[256];  ///< both times 256
    std::uint32_t step[256];  ///< from the left to the right, modulo 2^32

    /// The tables on the left, and how far behind each that on the right begins.
    void join(const std::uint8_t* above, const std::uint8_t* below, std::ptrdiff_t right) {
#if FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
        for (int level = 0; level < 256; level += 4) {
            const auto both = [&](std::ptrdiff_t tile) {
                return vsliq_n_u32(vldrbq_u32(above + tile + level), vldrbq_u32(below + tile + level), 16);
            };
            const uint32x4_t from = both(0);
            vst1q_u32(left + level, vshlq_n_u32(from, 8));
            vst1q_u32(step + level, vsubq_u32(both(right), from));
        }
#else
        for (int first = 0; first < 256; first += 8)
            unroll<8>([&](auto i) {
                const int level = first + i;
                const std::uint32_t from = std::uint32_t{above[level]} | std::uint32_t{below[level]} << 16;
                const std::uint32_t to =
                    std::uint32_t{above[right + level]} | std::uint32_t{below[right + level]} << 16;
                left[level] = from << 8;
                step[level] = to - from;
            });
#endif
    }
};

/// dst[x] = the entries of src[x] in the four tables, blended: weights[x] in 1/256 for the right ones,
/// lower_weight for the lower ones; to the nearest, ties up. dst may be src.
inline void blend_row(const std::uint8_t* src, const std::uint16_t* weights, int count,
                      const TableBlend& joined, std::uint32_t lower_weight, std::uint8_t* dst) {
    const std::uint32_t down = (256 - lower_weight) | lower_weight << 16;
    int x = 0;
#if FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
    const uint16x8_t halves = vreinterpretq_u16_u32(vdupq_n_u32(down));
    for (; x + 4 <= count; x += 4) {
        const uint32x4_t levels = vldrbq_u32(src + x);
        const uint32x4_t step = vldrwq_gather_shifted_offset_u32(joined.step, levels);
        const uint16x8_t both = vreinterpretq_u16_u32(vaddq_u32(
            vldrwq_gather_shifted_offset_u32(joined.left, levels), vmulq_u32(step, vldrhq_u32(weights + x))));
        const uint32x4_t sum = vaddq_u32(vmullbq_int_u16(both, halves), vmulltq_int_u16(both, halves));
        vstrbq_u32(dst + x, vrshrq_n_u32(sum, 16));
    }
#endif
    const auto blend = [&] {
        // Both halves at once: each stays below 255 * 256 + 1.
        const int level = src[x];
        dst[x] = static_cast<std::uint8_t>(
            blend_halves(joined.left[level] + joined.step[level] * weights[x], down));
        ++x;
    };
    while (x + 4 <= count) unroll<4>([&](auto) { blend(); });
    while (x < count) blend();
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
