// SPDX-License-Identifier: MIT
//
// Prefix sums of rows: every element is the sum of those up to it. What integral images and running means are
// made of.
#pragma once

#include <cstdint>

#include <fovea/simd/isa.hpp>

#if FOVEA_BYTES >= 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES >= 16 && defined(__SSE2__)
#include <emmintrin.h>
#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON)
#include <arm_neon.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// Rows that integral_rows() takes at once.
#if FOVEA_BYTES >= 32 && defined(__AVX2__)
inline constexpr int integral_rows_a_step = 8;
#else
inline constexpr int integral_rows_a_step = 1;
#endif

#if FOVEA_BYTES >= 16 && defined(__SSE2__)

/// The prefix sums of eight words, each below 2^16.
[[gnu::always_inline]] inline __m128i prefix_of_words(__m128i words) {
    words = _mm_add_epi16(words, _mm_slli_si128(words, 2));
    words = _mm_add_epi16(words, _mm_slli_si128(words, 4));
    return _mm_add_epi16(words, _mm_slli_si128(words, 8));
}
[[gnu::always_inline]] inline __m128i prefix_of_dwords(__m128i sums) {
    sums = _mm_add_epi32(sums, _mm_slli_si128(sums, 4));
    return _mm_add_epi32(sums, _mm_slli_si128(sums, 8));
}
[[gnu::always_inline]] inline __m128i load_sums(const void* from) {
    return _mm_loadu_si128(static_cast<const __m128i*>(from));
}
[[gnu::always_inline]] inline void store_sums(std::uint32_t* to, __m128i sums) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), sums);
}

#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON)

[[gnu::always_inline]] inline uint16x8_t prefix_of_words(uint16x8_t words) {
    const uint16x8_t zero = vdupq_n_u16(0);
    words = vaddq_u16(words, vextq_u16(zero, words, 7));
    words = vaddq_u16(words, vextq_u16(zero, words, 6));
    return vaddq_u16(words, vextq_u16(zero, words, 4));
}
[[gnu::always_inline]] inline uint32x4_t prefix_of_dwords(uint32x4_t sums) {
    const uint32x4_t zero = vdupq_n_u32(0);
    sums = vaddq_u32(sums, vextq_u32(zero, sums, 3));
    return vaddq_u32(sums, vextq_u32(zero, sums, 2));
}

#endif

/// dst[x] = above[x] + src[0] + ... + src[x], modulo 2^32.
inline void integral_row(const std::uint8_t* src, int count, const std::uint32_t* above, std::uint32_t* dst) {
    int x = 0;
    std::uint32_t sum = 0;
#if FOVEA_BYTES >= 16 && defined(__SSE2__)
    const __m128i zero = _mm_setzero_si128();
    __m128i carry = zero;
    for (; x + 8 <= count; x += 8) {
        const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(src + x));
        const __m128i words = prefix_of_words(_mm_unpacklo_epi8(bytes, zero));
        const __m128i low = _mm_add_epi32(_mm_unpacklo_epi16(words, zero), carry);
        const __m128i high = _mm_add_epi32(_mm_unpackhi_epi16(words, zero), carry);
        carry = _mm_shuffle_epi32(high, 0xff);
        store_sums(dst + x, _mm_add_epi32(load_sums(above + x), low));
        store_sums(dst + x + 4, _mm_add_epi32(load_sums(above + x + 4), high));
    }
    sum = static_cast<std::uint32_t>(_mm_cvtsi128_si32(carry));
#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON)
    uint32x4_t carry = vdupq_n_u32(0);
    for (; x + 8 <= count; x += 8) {
        const uint16x8_t words = prefix_of_words(vmovl_u8(vld1_u8(src + x)));
        const uint32x4_t low = vaddw_u16(carry, vget_low_u16(words));
        const uint32x4_t high = vaddw_u16(carry, vget_high_u16(words));
        carry = vdupq_n_u32(vgetq_lane_u32(high, 3));
        vst1q_u32(dst + x, vaddq_u32(vld1q_u32(above + x), low));
        vst1q_u32(dst + x + 4, vaddq_u32(vld1q_u32(above + x + 4), high));
    }
    sum = vgetq_lane_u32(carry, 0);
#endif
    for (; x < count; ++x) {
        sum += src[x];
        dst[x] = above[x] + sum;
    }
}

/// The integral rows of integral_rows_a_step rows, one below the other: what is above the first is at above.
inline void integral_rows(const std::uint8_t* const* src, int count, const std::uint32_t* above,
                          std::uint32_t* const* dst) {
    constexpr int rows = integral_rows_a_step;
#if FOVEA_BYTES >= 32 && defined(__AVX2__)
    // Each half of a vector holds a row, so that the sum to the left is carried on within the half. Four
    // bytes make four sums by products with 0 and 1. Below 16 columns at a time all rows are done, so that
    // what is above them is read once.
    constexpr int pairs = rows / 2;
    const __m256i which =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 1, 0, 1, 1, 1, 1));
    const __m256i one = _mm256_set1_epi16(1);
    const auto sums_of = [&](__m256i groups) {
        return _mm256_madd_epi16(_mm256_maddubs_epi16(groups, which), one);
    };
    __m256i carry[pairs];
    for (__m256i& c : carry) c = _mm256_setzero_si256();
    int x = 0;
    for (; x + 16 <= count; x += 16) {
        __m256i bytes[pairs];
        for (int p = 0; p < pairs; ++p)
            bytes[p] = _mm256_inserti128_si256(_mm256_castsi128_si256(load_sums(src[2 * p] + x)),
                                               load_sums(src[2 * p + 1] + x), 1);
        const auto eight_columns = [&](int at, auto first, auto second) {
            __m256i sums = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(above + at));
#pragma GCC unroll 4
            for (int p = 0; p < pairs; ++p) {
                const __m256i low = _mm256_add_epi32(sums_of(first(bytes[p])), carry[p]);
                const __m256i high =
                    _mm256_add_epi32(sums_of(second(bytes[p])), _mm256_shuffle_epi32(low, 0xff));
                carry[p] = _mm256_shuffle_epi32(high, 0xff);
                sums = _mm256_add_epi32(sums, _mm256_permute2x128_si256(low, high, 0x20));
                _mm256_storeu_si256(reinterpret_cast<__m256i*>(dst[2 * p] + at), sums);
                sums = _mm256_add_epi32(sums, _mm256_permute2x128_si256(low, high, 0x31));
                _mm256_storeu_si256(reinterpret_cast<__m256i*>(dst[2 * p + 1] + at), sums);
            }
        };
        eight_columns(
            x, [](__m256i row) { return _mm256_shuffle_epi32(row, 0x00); },
            [](__m256i row) { return _mm256_shuffle_epi32(row, 0x55); });
        eight_columns(
            x + 8, [](__m256i row) { return _mm256_shuffle_epi32(row, 0xaa); },
            [](__m256i row) { return _mm256_shuffle_epi32(row, 0xff); });
    }
    for (int r = 0; r < rows; ++r) {
        const std::uint32_t* over = r == 0 ? above : dst[r - 1];
        std::uint32_t sum = x == 0 ? 0 : dst[r][x - 1] - over[x - 1];
        for (int i = x; i < count; ++i) {
            sum += src[r][i];
            dst[r][i] = over[i] + sum;
        }
    }
#else
    for (int r = 0; r < rows; ++r) integral_row(src[r], count, r == 0 ? above : dst[r - 1], dst[r]);
#endif
}

/// dst[x] = src[0] + ... + src[x], modulo 2^32.
inline void prefix_row(const std::uint16_t* src, int count, std::uint32_t* dst) {
    int x = 0;
    std::uint32_t sum = 0;
#if FOVEA_BYTES >= 16 && defined(__SSE2__)
    const __m128i zero = _mm_setzero_si128();
    __m128i carry = zero;
    for (; x + 8 <= count; x += 8) {
        const __m128i words = load_sums(src + x);
        const __m128i low = _mm_add_epi32(prefix_of_dwords(_mm_unpacklo_epi16(words, zero)), carry);
        const __m128i high =
            _mm_add_epi32(prefix_of_dwords(_mm_unpackhi_epi16(words, zero)), _mm_shuffle_epi32(low, 0xff));
        carry = _mm_shuffle_epi32(high, 0xff);
        store_sums(dst + x, low);
        store_sums(dst + x + 4, high);
    }
    sum = static_cast<std::uint32_t>(_mm_cvtsi128_si32(carry));
#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON)
    uint32x4_t carry = vdupq_n_u32(0);
    for (; x + 8 <= count; x += 8) {
        const uint16x8_t words = vld1q_u16(src + x);
        const uint32x4_t low = vaddq_u32(prefix_of_dwords(vmovl_u16(vget_low_u16(words))), carry);
        carry = vdupq_n_u32(vgetq_lane_u32(low, 3));
        const uint32x4_t high = vaddq_u32(prefix_of_dwords(vmovl_u16(vget_high_u16(words))), carry);
        carry = vdupq_n_u32(vgetq_lane_u32(high, 3));
        vst1q_u32(dst + x, low);
        vst1q_u32(dst + x + 4, high);
    }
    sum = vgetq_lane_u32(carry, 0);
#endif
    for (; x < count; ++x) {
        sum += src[x];
        dst[x] = sum;
    }
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
