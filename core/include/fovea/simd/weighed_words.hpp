// SPDX-License-Identifier: MIT
//
// Weighted means of three vectors of small 16-bit values: brightness of colour that was unpacked.
#pragma once

#include <cstdint>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/triples.hpp>

#if FOVEA_BYTES == 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
#include <emmintrin.h>
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

#if FOVEA_BYTES >= 8

/// TripleWeights::mean() of a, b and c, which are below 256. Where products come in pairs, the third one
/// stands beside the rounding, 1 * 2^14.
[[gnu::always_inline]] inline RawWords weigh_words(RawWords a, RawWords b, RawWords c,
                                                   TripleWeights weights) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    const __m256i pair = _mm256_set1_epi32(weights.first | weights.second << 16);
    const __m256i last = _mm256_set1_epi32(weights.third | 1 << 30);
    const auto means = [&](__m256i ab, __m256i c1) {
        return _mm256_srli_epi32(_mm256_add_epi32(_mm256_madd_epi16(ab, pair), _mm256_madd_epi16(c1, last)),
                                 15);
    };
    const auto x = bits_as<__m256i>(a);
    const auto y = bits_as<__m256i>(b);
    const auto z = bits_as<__m256i>(c);
    const __m256i one = _mm256_set1_epi16(1);
    return bits_as<RawWords>(
        _mm256_packs_epi32(means(_mm256_unpacklo_epi16(x, y), _mm256_unpacklo_epi16(z, one)),
                           means(_mm256_unpackhi_epi16(x, y), _mm256_unpackhi_epi16(z, one))));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    const __m128i pair = _mm_set1_epi32(weights.first | weights.second << 16);
    const __m128i last = _mm_set1_epi32(weights.third | 1 << 30);
    const auto means = [&](__m128i ab, __m128i c1) {
        return _mm_srli_epi32(_mm_add_epi32(_mm_madd_epi16(ab, pair), _mm_madd_epi16(c1, last)), 15);
    };
    const auto x = bits_as<__m128i>(a);
    const auto y = bits_as<__m128i>(b);
    const auto z = bits_as<__m128i>(c);
    const __m128i one = _mm_set1_epi16(1);
    return bits_as<RawWords>(_mm_packs_epi32(means(_mm_unpacklo_epi16(x, y), _mm_unpacklo_epi16(z, one)),
                                             means(_mm_unpackhi_epi16(x, y), _mm_unpackhi_epi16(z, one))));
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
    const auto x = bits_as<uint16x8_t>(a);
    const auto y = bits_as<uint16x8_t>(b);
    const auto z = bits_as<uint16x8_t>(c);
    const uint16x8_t of_a = vdupq_n_u16(static_cast<std::uint16_t>(weights.first));
    const uint16x8_t of_b = vdupq_n_u16(static_cast<std::uint16_t>(weights.second));
    const uint16x8_t of_c = vdupq_n_u16(static_cast<std::uint16_t>(weights.third));
    const uint32x4_t low =
        vaddq_u32(vaddq_u32(vmullbq_int_u16(x, of_a), vmullbq_int_u16(y, of_b)), vmullbq_int_u16(z, of_c));
    const uint32x4_t high =
        vaddq_u32(vaddq_u32(vmulltq_int_u16(x, of_a), vmulltq_int_u16(y, of_b)), vmulltq_int_u16(z, of_c));
    return bits_as<RawWords>(vrshrntq_n_u32(vrshrnbq_n_u32(vdupq_n_u16(0), low, 15), high, 15));
#else
    const auto x = bits_as<RawQuads>(a);
    const auto y = bits_as<RawQuads>(b);
    const auto z = bits_as<RawQuads>(c);
    const auto of_a = static_cast<std::uint32_t>(weights.first);
    const auto of_b = static_cast<std::uint32_t>(weights.second);
    const auto of_c = static_cast<std::uint32_t>(weights.third);
    constexpr std::uint32_t half = 1 << 14;
    const RawQuads low = ((x & 0xffffu) * of_a + (y & 0xffffu) * of_b + (z & 0xffffu) * of_c + half) >> 15;
    const RawQuads high = ((x >> 16) * of_a + (y >> 16) * of_b + (z >> 16) * of_c + half) >> 15;
    return bits_as<RawWords>(low | high << 16);
#endif
}

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
