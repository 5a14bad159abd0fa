// SPDX-License-Identifier: MIT
//
// Products of 16-bit values, added up over a vector.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>

#if FOVEA_BYTES == 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

#if FOVEA_BYTES >= 8
/// Sums of 32 bits, modulo 2^32: a quarter as many as a vector has bytes.
using RawSums = RawQuads;
#else
using RawSums = std::uint32_t;
#endif
inline constexpr int sum_lanes = lanes / 4;

/// Of every two neighbours the sum of a times b. All values below 2^15.
[[gnu::always_inline]] inline RawSums pair_products(RawWords a, RawWords b) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    return bits_as<RawSums>(_mm256_madd_epi16(bits_as<__m256i>(a), bits_as<__m256i>(b)));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    return bits_as<RawSums>(_mm_madd_epi16(bits_as<__m128i>(a), bits_as<__m128i>(b)));
#else
    const auto first = bits_as<RawSums>(a);
    const auto second = bits_as<RawSums>(b);
    return (first & 0xffffu) * (second & 0xffffu) + (first >> 16) * (second >> 16);
#endif
}

/// The halves of a word, each times its half of weights, added up, by 2^16 to the nearest, ties up. The
/// weights add up to 256.
[[gnu::always_inline]] inline std::uint32_t blend_halves(std::uint32_t halves, std::uint32_t weights) {
    constexpr std::uint32_t half = 1 << 15;
#if defined(__ARM_FEATURE_SIMD32)
    // The instruction takes numbers with signs: 2^15 less of each is 2^15 times 256 less of the sum.
    std::uint32_t sum;
    asm("smlad %0, %1, %2, %3" : "=r"(sum) : "r"(halves ^ 0x80008000u), "r"(weights), "r"(half + half * 256));
    return sum >> 16;
#else
    return ((halves & 0xffffu) * (weights & 0xffffu) + (halves >> 16) * (weights >> 16) + half) >> 16;
#endif
}

/// The totals of four vectors of sums.
[[gnu::always_inline]] inline void totals_of(RawSums a, RawSums b, RawSums c, RawSums d,
                                             std::uint32_t* totals) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    const __m256i first = _mm256_hadd_epi32(bits_as<__m256i>(a), bits_as<__m256i>(b));
    const __m256i second = _mm256_hadd_epi32(bits_as<__m256i>(c), bits_as<__m256i>(d));
    const __m256i halves = _mm256_hadd_epi32(first, second);
    const __m128i sum = _mm_add_epi32(_mm256_castsi256_si128(halves), _mm256_extracti128_si256(halves, 1));
    std::memcpy(totals, &sum, sizeof sum);
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    const auto x = bits_as<__m128i>(a);
    const auto y = bits_as<__m128i>(b);
    const auto z = bits_as<__m128i>(c);
    const auto w = bits_as<__m128i>(d);
    const __m128i xy = _mm_add_epi32(_mm_unpacklo_epi32(x, y), _mm_unpackhi_epi32(x, y));
    const __m128i zw = _mm_add_epi32(_mm_unpacklo_epi32(z, w), _mm_unpackhi_epi32(z, w));
    const __m128i sum = _mm_add_epi32(_mm_unpacklo_epi64(xy, zw), _mm_unpackhi_epi64(xy, zw));
    std::memcpy(totals, &sum, sizeof sum);
#else
    const RawSums sums[4] = {a, b, c, d};
    for (int i = 0; i < 4; ++i) {
        std::uint32_t values[sum_lanes];
        std::memcpy(values, &sums[i], sizeof values);
        totals[i] = 0;
        for (const std::uint32_t value : values) totals[i] += value;
    }
#endif
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
