// SPDX-License-Identifier: MIT
//
// Four bytes counted at once, each in a table of its own, so that equal ones do not meet.
#pragma once

#include <cstdint>

#include <fovea/simd/isa.hpp>

#if FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

#if FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)

inline constexpr bool counts_four_bytes = true;

/// Counts the bytes of a row and returns how many it has done; the rest is less than four. Elsewhere none.
inline int count_bytes(const std::uint8_t* row, int width, std::uint32_t (&tables)[4][256]) {
    const uint32x4_t own = vmulq_n_u32(vidupq_n_u32(0, 1), 256);
    std::uint32_t* const counts = tables[0];
    int x = 0;
    for (; x + 4 <= width; x += 4) {
        const uint32x4_t at = vaddq_u32(vldrbq_u32(row + x), own);
        const uint32x4_t found = vldrwq_gather_shifted_offset_u32(counts, at);
        vstrwq_scatter_shifted_offset_u32(counts, at, vaddq_n_u32(found, 1));
    }
    return x;
}

#else

inline constexpr bool counts_four_bytes = false;

inline int count_bytes(const std::uint8_t* /*row*/, int /*width*/, std::uint32_t (&/*tables*/)[4][256]) {
    return 0;
}

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
