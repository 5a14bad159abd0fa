// SPDX-License-Identifier: MIT
//
// Whole products of 32 bits by 32 bits, in lanes of 64.
#pragma once

#include <cstdint>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/cells.hpp>
#include <fovea/simd/isa.hpp>

#if FOVEA_BYTES == 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
#include <emmintrin.h>
#elif FOVEA_BYTES == 16 && defined(__ARM_NEON)
#include <arm_neon.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

#if FOVEA_BYTES >= 16

using Longs [[gnu::vector_size(FOVEA_BYTES)]] = std::uint64_t;

[[gnu::always_inline]] inline Longs all_longs(std::uint64_t k) { return Longs{} + k; }

/// The products of the lower halves, without a sign; what the upper halves hold does not matter.
[[gnu::always_inline]] inline Longs low_products(Longs a, Longs b) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    return bits_as<Longs>(_mm256_mul_epu32(bits_as<__m256i>(a), bits_as<__m256i>(b)));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    return bits_as<Longs>(_mm_mul_epu32(bits_as<__m128i>(a), bits_as<__m128i>(b)));
#elif FOVEA_BYTES == 16 && defined(__ARM_NEON)
    return bits_as<Longs>(vmull_u32(vmovn_u64(bits_as<uint64x2_t>(a)), vmovn_u64(bits_as<uint64x2_t>(b))));
#else
    return (a & 0xffffffffu) * (b & 0xffffffffu);
#endif
}

/// Every second of the 32-bit numbers, in the lower half of a lane of 64 bits: those of the lower halves,
/// with the others above them, and those of the upper halves, with nothing above.
[[gnu::always_inline]] inline Longs low_halves(Unsigned a) { return bits_as<Longs>(a); }
[[gnu::always_inline]] inline Longs high_halves(Unsigned a) { return bits_as<Longs>(a) >> 32; }

/// In each lane of 32 bits, the lower half of it low and the upper one high, both held at -32768 and 32767.
[[gnu::always_inline]] inline RawWords held_pairs(Ints low, Ints high) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    const __m256i packed = _mm256_packs_epi32(bits_as<__m256i>(low), bits_as<__m256i>(high));
    const __m256i order =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15));
    return bits_as<RawWords>(_mm256_shuffle_epi8(packed, order));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    const __m128i packed = _mm_packs_epi32(bits_as<__m128i>(low), bits_as<__m128i>(high));
    return bits_as<RawWords>(_mm_unpacklo_epi16(packed, _mm_unpackhi_epi64(packed, packed)));
#else
    const auto held = [](Ints a) {
        a = a > -32768 ? a : all_ints(-32768);
        return bits_as<Unsigned>(a < 32767 ? a : all_ints(32767));
    };
    return bits_as<RawWords>((held(low) & 0xffffu) | (held(high) << 16));
#endif
}

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
