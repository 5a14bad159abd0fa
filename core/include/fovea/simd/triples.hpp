// SPDX-License-Identifier: MIT
//
// Weighted sums of triples of bytes: brightness of packed colour, where the lanes of Bytes do not fit.
#pragma once

#include <cstdint>

#include <fovea/simd/isa.hpp>

#if FOVEA_BYTES >= 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES >= 16 && defined(__SSE2__)
#include <emmintrin.h>
#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON)
#include <arm_neon.h>
#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
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
#if FOVEA_BYTES >= 32 && defined(__AVX2__)
inline constexpr int triples_a_step = 32;
#elif FOVEA_BYTES >= 16 && (defined(__SSE2__) || defined(__ARM_NEON))
inline constexpr int triples_a_step = 16;
#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
inline constexpr int triples_a_step = 4;
#else
inline constexpr int triples_a_step = 1;
#endif

#if FOVEA_BYTES >= 32 && defined(__AVX2__)

/// The means of 32 triples. One shuffle takes the first and second byte of four triples in either half of a
/// register, another the third, each widened on the way, so that they are multiplied in pairs.
inline void weigh_step(const std::uint8_t* src, TripleWeights weights, std::uint8_t* dst) {
    const auto both = [](__m128i bytes) { return _mm256_broadcastsi128_si256(bytes); };
    constexpr char no = -128;  // a shuffle gives zero here, also where the shift below is added
    const __m256i pairs = both(_mm_setr_epi8(0, no, 1, no, 3, no, 4, no, 6, no, 7, no, 9, no, 10, no));
    const __m256i thirds = both(_mm_setr_epi8(2, no, no, no, 5, no, no, no, 8, no, no, no, 11, no, no, no));
    const __m256i pair_weights = _mm256_set1_epi32(weights.first | weights.second << 16);
    const __m256i third_weight = _mm256_set1_epi32(weights.third);
    const __m256i half = _mm256_set1_epi32(1 << 14);
    const auto means = [&](const std::uint8_t* low, const std::uint8_t* high, __m256i shift) {
        const __m128i first = _mm_loadu_si128(reinterpret_cast<const __m128i*>(low));
        const __m128i second = _mm_loadu_si128(reinterpret_cast<const __m128i*>(high));
        const __m256i bytes = _mm256_inserti128_si256(_mm256_castsi128_si256(first), second, 1);
        const __m256i ab = _mm256_shuffle_epi8(bytes, _mm256_add_epi8(pairs, shift));
        const __m256i c = _mm256_shuffle_epi8(bytes, _mm256_add_epi8(thirds, shift));
        const __m256i sum =
            _mm256_add_epi32(_mm256_madd_epi16(ab, pair_weights), _mm256_madd_epi16(c, third_weight));
        return _mm256_srli_epi32(_mm256_add_epi32(sum, half), 15);
    };
    // Triples 0 to 15 in the lower halves, 16 to 31 in the upper ones, so that packing keeps their order. The
    // last four are read from four bytes before, to end where the 96 bytes end.
    const __m256i none = _mm256_setzero_si256();
    const __m256i four_later = _mm256_inserti128_si256(none, _mm_set1_epi8(4), 1);
    const __m256i a = means(src, src + 48, none);
    const __m256i b = means(src + 12, src + 60, none);
    const __m256i c = means(src + 24, src + 72, none);
    const __m256i d = means(src + 36, src + 80, four_later);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(dst),
                        _mm256_packus_epi16(_mm256_packs_epi32(a, b), _mm256_packs_epi32(c, d)));
}

#elif FOVEA_BYTES >= 16 && defined(__SSE2__)

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

#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)

inline void weigh_step(const std::uint8_t* src, TripleWeights weights, std::uint8_t* dst) {
    const uint32x4_t at = vmulq_n_u32(vidupq_n_u32(0, 1), 3);
    uint32x4_t sum =
        vmulq_n_u32(vldrbq_gather_offset_u32(src, at), static_cast<std::uint32_t>(weights.first));
    sum = vmlaq_n_u32(sum, vldrbq_gather_offset_u32(src + 1, at), static_cast<std::uint32_t>(weights.second));
    sum = vmlaq_n_u32(sum, vldrbq_gather_offset_u32(src + 2, at), static_cast<std::uint32_t>(weights.third));
    vstrbq_u32(dst, vrshrq_n_u32(sum, 15));
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
