// SPDX-License-Identifier: MIT
//
// Pixels beside the means of windows around them, where the sums of the windows come from those of columns.
#pragma once

#include <cstdint>

#include <fovea/simd/isa.hpp>

#if FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// 255 where (pixel + offset) area is at least the sum between two prefix sums side apart, changed by flip.
inline void compare_with_means(const std::uint8_t* src, const std::uint32_t* sums, int width, int side,
                               int offset, std::uint8_t flip, std::uint8_t* dst) {
    const std::int32_t area = side * side;
    int x = 0;
#if FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
    const uint8x16_t white = vdupq_n_u8(static_cast<std::uint8_t>(255 ^ flip));
    const uint8x16_t black = vdupq_n_u8(flip);
    for (; x + 4 <= width; x += 4) {
        const uint32x4_t sum = vsubq_u32(vldrwq_u32(sums + x + side), vldrwq_u32(sums + x));
        const int32x4_t pixels = vaddq_n_s32(vreinterpretq_s32_u32(vldrbq_u32(src + x)), offset);
        const mve_pred16_t bright = vcmpgeq_s32(vmulq_n_s32(pixels, area), vreinterpretq_s32_u32(sum));
        vstrbq_u32(dst + x, vreinterpretq_u32_u8(vpselq_u8(white, black, bright)));
    }
#endif
    for (; x < width; ++x) {
        const auto sum = static_cast<std::int32_t>(sums[x + side] - sums[x]);
        dst[x] = static_cast<std::uint8_t>(((src[x] + offset) * area >= sum ? 255 : 0) ^ flip);
    }
}

/// The sums of columns, with the pixels of a row more and those of another less.
inline void slide_columns(const std::uint8_t* entering, const std::uint8_t* leaving, int width,
                          std::uint16_t* columns) {
    int x = 0;
#if FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
    for (; x + 8 <= width; x += 8)
        vstrhq_u16(columns + x, vsubq_u16(vaddq_u16(vldrhq_u16(columns + x), vldrbq_u16(entering + x)),
                                          vldrbq_u16(leaving + x)));
#endif
    for (; x < width; ++x) columns[x] = static_cast<std::uint16_t>(columns[x] + entering[x] - leaving[x]);
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
