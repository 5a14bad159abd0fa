// SPDX-License-Identifier: MIT
//
// The colours of a Bayer mosaic in words and by Helium: each sum is made for those pixels alone that want it.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/interleave.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

#if FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

// ---- Interface --------------------------------------------------------------------

/// A row of a mosaic between its neighbours, from a pixel on that is not green.
struct MosaicRows {
    const std::uint8_t* above;
    const std::uint8_t* here;
    const std::uint8_t* below;
};

/// Whether demosaic_run() is there.
#if (FOVEA_BYTES == 4 && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__) || \
    (FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE))
inline constexpr bool mosaic_runs = true;
#else
inline constexpr bool mosaic_runs = false;
#endif

/// Red, green and blue of count pixels, a multiple of lanes, of a row that shows red, or blue. Reads one
/// pixel before them, and one behind.
template <bool Red>
void demosaic_run(const MosaicRows& rows, int count, std::uint8_t* dst);

// ---- Implementation ---------------------------------------------------------------

#if FOVEA_BYTES == 4

/// sum and the bytes 0 and 2, or 1 and 3, as halves.
[[gnu::always_inline]] inline RawWords plus_even_bytes(RawWords sum, RawBytes bytes) {
#if defined(__ARM_FEATURE_SIMD32)
    asm("uxtab16 %0, %1, %2" : "=r"(sum) : "r"(sum), "r"(bytes));
    return sum;
#else
    return sum + (bytes & 0x00ff00ffu);
#endif
}
[[gnu::always_inline]] inline RawWords plus_odd_bytes(RawWords sum, RawBytes bytes) {
#if defined(__ARM_FEATURE_SIMD32)
    asm("uxtab16 %0, %1, %2, ror #8" : "=r"(sum) : "r"(sum), "r"(bytes));
    return sum;
#else
    return sum + (bytes >> 8 & 0x00ff00ffu);
#endif
}

/// The lower half of a and the upper half of b.
[[gnu::always_inline]] inline RawWords lower_and_upper(RawWords a, RawWords b) {
#if defined(__ARM_FEATURE_SIMD32)
    RawWords both;
    asm("pkhbt %0, %1, %2" : "=r"(both) : "r"(a), "r"(b));
    return both;
#else
    return (a & 0x0000ffffu) | (b & 0xffff0000u);
#endif
}

template <bool Red>
void demosaic_run(const MosaicRows& rows, int count, std::uint8_t* dst) {
    const std::uint8_t* above = rows.above;
    const std::uint8_t* here = rows.here;
    const std::uint8_t* below = rows.below;
    const std::uint8_t* const end = here + count;
    RawWords bytes = 0x00ff00ff;
#if defined(__thumb2__)
    // In a register, where an instruction that masks shifts too.
    asm("" : "+r"(bytes));
#endif
    // Pixels 0 and 2 are coloured, 1 and 3 green: even and odd. Sums begin with what rounds them.
    std::uint32_t before = 1u + above[-1] + below[-1];
    for (; here != end; above += 4, here += 4, below += 4, dst += 12) {
        const auto upper = load_raw<RawBytes>(above);
        const auto lower = load_raw<RawBytes>(below);
        const auto middle = load_raw<RawBytes>(here);
        const RawWords even_upright = plus_even_bytes(plus_even_bytes(all_words(1), upper), lower);
        const RawWords odd_upright = plus_odd_bytes(plus_odd_bytes(all_words(1), upper), lower);
        const RawWords even_sides = plus_even_bytes(all_words(1), load_raw<RawBytes>(here - 1));
        const RawWords cross = plus_odd_bytes(even_sides, middle) + even_upright;
        const RawWords odd_sides = plus_even_bytes(all_words(1), middle);
        const RawWords across = plus_odd_bytes(odd_sides, load_raw<RawBytes>(here + 1));
        const RawWords corners = before + odd_upright + (odd_upright << 16);
        before = odd_upright >> 16;

        const RawWords even_own = middle & bytes;
        const RawWords even_green = cross >> 2 & bytes;
        const RawWords even_other = corners >> 2 & bytes;
        const RawWords odd_own = across >> 1 & bytes;
        const RawWords odd_green = middle >> 8 & bytes;
        const RawWords odd_other = odd_upright >> 1 & bytes;
        // In each half two bytes that follow one another.
        const RawWords red_green = (Red ? even_own : even_other) | even_green << 8;
        const RawWords blue_red = (Red ? even_other : even_own) | (Red ? odd_own : odd_other) << 8;
        const RawWords green_blue = odd_green | (Red ? odd_other : odd_own) << 8;
        const RawWords first = interleave_first(red_green, blue_red);
        const RawWords second = lower_and_upper(green_blue, red_green);
        const RawWords third = interleave_second(blue_red, green_blue);
        std::memcpy(dst, &first, sizeof first);
        std::memcpy(dst + 4, &second, sizeof second);
        std::memcpy(dst + 8, &third, sizeof third);
    }
}

#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)

template <bool Red>
void demosaic_run(const MosaicRows& rows, int count, std::uint8_t* dst) {
    const std::uint8_t* above = rows.above;
    const std::uint8_t* here = rows.here;
    const std::uint8_t* below = rows.below;
    const std::uint8_t* const end = here + count;
    // Even pixels are coloured, odd ones green.
    std::uint32_t before = std::uint32_t{above[-1]} + below[-1];
    for (; here != end; above += lanes, here += lanes, below += lanes, dst += 3 * lanes) {
        const uint8x16_t upper = vldrbq_u8(above);
        const uint8x16_t lower = vldrbq_u8(below);
        const uint8x16_t middle = vldrbq_u8(here);
        const uint8x16_t left = vldrbq_u8(here - 1);
        const uint8x16_t right = vldrbq_u8(here + 1);
        const uint16x8_t even_upright = vaddq_u16(vmovlbq_u8(upper), vmovlbq_u8(lower));
        const uint16x8_t even_sides = vaddq_u16(vmovlbq_u8(left), vmovltq_u8(middle));
        const uint16x8_t odd_upright = vaddq_u16(vmovltq_u8(upper), vmovltq_u8(lower));
        // The sum of the column before comes in, the last one goes out for the next vector.
        const uint16x8_t corners = vaddq_u16(odd_upright, vshlcq_u16(odd_upright, &before, 16));
        const uint8x16_t green = vrshrnbq_n_u16(middle, vaddq_u16(even_sides, even_upright), 2);
        const uint8x16_t other = vrshrnbq_n_u16(vrhaddq_u8(upper, lower), corners, 2);
        const uint8x16_t own = vpselq_u8(middle, vrhaddq_u8(left, right), 0x5555);
        const Bytes red{bits_as<RawBytes>(Red ? own : other)};
        const Bytes blue{bits_as<RawBytes>(Red ? other : own)};
        store_triples({red, {bits_as<RawBytes>(green)}, blue}, dst);
    }
}

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
