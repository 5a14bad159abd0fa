// SPDX-License-Identifier: MIT
//
// Weighted sums of triples of bytes: brightness of packed colour, where the lanes of Bytes do not fit.
#pragma once

#include <cstdint>

#include <fovea/simd/isa.hpp>

#if FOVEA_BYTES >= 16 && defined(__SSE2__)
#include <emmintrin.h>
#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON)
#include <arm_neon.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// Factors of the three bytes in 1/32768, not negative; their sum is 32768, so that three equal bytes give
/// themselves.
struct TripleWeights {
    std::int16_t first;
    std::int16_t second;
    std::int16_t third;

    /// The weighted mean of one triple, to the nearest, ties up.
    constexpr std::uint8_t mean(std::uint8_t a, std::uint8_t b, std::uint8_t c) const {
        return static_cast<std::uint8_t>((first * a + second * b + third * c + (1 << 14)) >> 15);
    }
};

/// Triples in one step of weigh_triples(); 1 where there is no faster way than one by one.
#if FOVEA_BYTES >= 16 && (defined(__SSE2__) || defined(__ARM_NEON))
inline constexpr int triples_a_step = 16;
#else
inline constexpr int triples_a_step = 1;
#endif

#if FOVEA_BYTES >= 16 && defined(__SSE2__)

/// The means of 16 triples: they are dealt out to three vectors, then multiplied in pairs.
inline void weigh_step(const std::uint8_t* src, TripleWeights weights, std::uint8_t* dst) {
    const auto* from = reinterpret_cast<const __m128i*>(src);
    __m128i a = _mm_loadu_si128(from);
    __m128i b = _mm_loadu_si128(from + 1);
    __m128i c = _mm_loadu_si128(from + 2);
    // Each round puts bytes together that were half the 48 apart; after four, those that were 3 apart.
    for (int round = 0; round < 4; ++round) {
        const __m128i x = _mm_unpacklo_epi8(a, _mm_unpackhi_epi64(b, b));
        const __m128i y = _mm_unpacklo_epi8(_mm_unpackhi_epi64(a, a), c);
        c = _mm_unpacklo_epi8(b, _mm_unpackhi_epi64(c, c));
        a = x;
        b = y;
    }
    // first * a + second * b, and third * c + 2^14 * 1 for the rounding.
    const __m128i zero = _mm_setzero_si128();
    const __m128i one = _mm_set1_epi8(1);
    const __m128i pair = _mm_set1_epi32(weights.first | weights.second << 16);
    const __m128i last = _mm_set1_epi32(weights.third | 1 << 30);
    const auto means = [&](__m128i ab, __m128i c1) {
        const __m128i low = _mm_add_epi32(_mm_madd_epi16(_mm_unpacklo_epi8(ab, zero), pair),
                                          _mm_madd_epi16(_mm_unpacklo_epi8(c1, zero), last));
        const __m128i high = _mm_add_epi32(_mm_madd_epi16(_mm_unpackhi_epi8(ab, zero), pair),
                                           _mm_madd_epi16(_mm_unpackhi_epi8(c1, zero), last));
        return _mm_packs_epi32(_mm_srli_epi32(low, 15), _mm_srli_epi32(high, 15));
    };
    const __m128i lower = means(_mm_unpacklo_epi8(a, b), _mm_unpacklo_epi8(c, one));
    const __m128i upper = means(_mm_unpackhi_epi8(a, b), _mm_unpackhi_epi8(c, one));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(dst), _mm_packus_epi16(lower, upper));
}

#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON)

inline void weigh_step(const std::uint8_t* src, TripleWeights weights, std::uint8_t* dst) {
    const uint8x16x3_t triples = vld3q_u8(src);
    const auto means = [&](uint16x4_t a, uint16x4_t b, uint16x4_t c) {
        uint32x4_t sum = vmull_n_u16(a, static_cast<std::uint16_t>(weights.first));
        sum = vmlal_n_u16(sum, b, static_cast<std::uint16_t>(weights.second));
        sum = vmlal_n_u16(sum, c, static_cast<std::uint16_t>(weights.third));
        return vrshrn_n_u32(sum, 15);
    };
    const auto eight = [&](uint8x8_t a, uint8x8_t b, uint8x8_t c) {
        const uint16x8_t wide_a = vmovl_u8(a);
        const uint16x8_t wide_b = vmovl_u8(b);
        const uint16x8_t wide_c = vmovl_u8(c);
        return vmovn_u16(
            vcombine_u16(means(vget_low_u16(wide_a), vget_low_u16(wide_b), vget_low_u16(wide_c)),
                         means(vget_high_u16(wide_a), vget_high_u16(wide_b), vget_high_u16(wide_c))));
    };
    vst1q_u8(
        dst,
        vcombine_u8(
            eight(vget_low_u8(triples.val[0]), vget_low_u8(triples.val[1]), vget_low_u8(triples.val[2])),
            eight(vget_high_u8(triples.val[0]), vget_high_u8(triples.val[1]), vget_high_u8(triples.val[2]))));
}

#else

inline void weigh_step(const std::uint8_t* src, TripleWeights weights, std::uint8_t* dst) {
    *dst = weights.mean(src[0], src[1], src[2]);
}

#endif

/// The weighted mean of each of count triples.
inline void weigh_triples(const std::uint8_t* src, int count, TripleWeights weights, std::uint8_t* dst) {
    int i = 0;
    for (; i + triples_a_step <= count; i += triples_a_step) weigh_step(src + 3 * i, weights, dst + i);
    for (; i < count; ++i) dst[i] = weights.mean(src[3 * i], src[3 * i + 1], src[3 * i + 2]);
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
