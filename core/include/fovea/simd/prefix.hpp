// SPDX-License-Identifier: MIT
//
// Prefix sums of rows: every element is the sum of those up to it. What integral images and running means are
// made of.
#pragma once

#include <cstdint>
#include <cstring>

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

#if FOVEA_BYTES >= 32 && defined(__AVX2__)

[[gnu::always_inline]] inline void add_above(const std::uint32_t* above, __m256i sums, std::uint32_t* to) {
    const __m256i over = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(above));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_add_epi32(over, sums));
}

/// The prefix sums of 32 bytes as words. Only one unit of the processor moves numbers between lanes, so few
/// steps do: pairs of columns are summed first, and four pairs by shifts within 64 bits.
struct PrefixOfBytes {
    __m256i first;   ///< columns 0 to 7 and 16 to 23
    __m256i second;  ///< columns 8 to 15 and 24 to 31
    __m256i all;     ///< in every 32 bits the sum of all

    [[gnu::always_inline]] explicit PrefixOfBytes(__m256i bytes) {
        const __m256i odd = _mm256_srli_epi16(bytes, 8);
        __m256i pairs = _mm256_add_epi16(_mm256_and_si256(bytes, _mm256_set1_epi16(255)), odd);
        pairs = _mm256_add_epi16(pairs, _mm256_slli_epi64(pairs, 16));
        pairs = _mm256_add_epi16(pairs, _mm256_slli_epi64(pairs, 32));
        const __m256i last_of_four = _mm256_broadcastsi128_si256(
            _mm_setr_epi8(-1, -1, -1, -1, -1, -1, -1, -1, 6, 7, 6, 7, 6, 7, 6, 7));
        pairs = _mm256_add_epi16(pairs, _mm256_shuffle_epi8(pairs, last_of_four));
        const __m256i ends = _mm256_shuffle_epi8(pairs, _mm256_set1_epi16(15 << 8 | 14));
        pairs = _mm256_add_epi16(pairs, _mm256_permute2x128_si256(ends, ends, 0x08));
        all = _mm256_and_si256(_mm256_add_epi16(ends, _mm256_permute2x128_si256(ends, ends, 0x01)),
                               _mm256_set1_epi32(0xffff));
        const __m256i even = _mm256_sub_epi16(pairs, odd);
        first = _mm256_unpacklo_epi16(even, pairs);
        second = _mm256_unpackhi_epi16(even, pairs);
    }
};

#endif

#if FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)

[[gnu::always_inline]] inline std::uint32_t sum_of_row(const std::uint8_t* row, int count) {
    std::uint32_t sum = 0;
    int x = 0;
    for (; x + 16 <= count; x += 16) sum = vaddvaq_u8(sum, vldrbq_u8(row + x));
    for (; x < count; ++x) sum += row[x];
    return sum;
}
[[gnu::always_inline]] inline std::uint32_t sum_of_row(const std::uint16_t* row, int count) {
    std::uint32_t sum = 0;
    int x = 0;
    for (; x + 8 <= count; x += 8) sum = vaddvaq_u16(sum, vldrhq_u16(row + x));
    for (; x < count; ++x) sum += row[x];
    return sum;
}
/// Prefix sums of the quarters of a row side by side: load(at) has the numbers there, store(at, sums) takes
/// their sums. A quarter begins with what total(i) says of the i before.
template <class Total, class Load, class Store>
[[gnu::always_inline]] inline void prefix_of_quarters(int quarter, Total total, Load load, Store store) {
    uint32x4_t at = vmulq_n_u32(vidupq_n_u32(0, 1), static_cast<std::uint32_t>(quarter));
    uint32x4_t sums = vdupq_n_u32(0);
    std::uint32_t before = 0;
    before += total(0);
    sums = vsetq_lane_u32(before, sums, 1);
    before += total(1);
    sums = vsetq_lane_u32(before, sums, 2);
    before += total(2);
    sums = vsetq_lane_u32(before, sums, 3);
    for (int x = 0; x < quarter; ++x) {
        sums = vaddq_u32(sums, load(at));
        store(at, sums);
        at = vaddq_n_u32(at, 1);
    }
}

#endif

#if FOVEA_BYTES == 4 && defined(__ARM_FEATURE_SIMD32) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__

/// Four sums of integral_row(), after sum. One instruction adds a byte out of a word.
[[gnu::always_inline]] inline std::uint32_t add_four_above(const std::uint8_t* src, std::uint32_t sum,
                                                           const std::uint32_t* above, std::uint32_t* dst) {
    std::uint32_t word;
    std::memcpy(&word, src, sizeof word);
    std::uint32_t sums[4];
    asm("uxtab %0, %1, %2" : "=r"(sums[0]) : "r"(sum), "r"(word));
    asm("uxtab %0, %1, %2, ror #8" : "=r"(sums[1]) : "r"(sums[0]), "r"(word));
    asm("uxtab %0, %1, %2, ror #16" : "=r"(sums[2]) : "r"(sums[1]), "r"(word));
    asm("uxtab %0, %1, %2, ror #24" : "=r"(sums[3]) : "r"(sums[2]), "r"(word));
    dst[0] = above[0] + sums[0];
    dst[1] = above[1] + sums[1];
    dst[2] = above[2] + sums[2];
    dst[3] = above[3] + sums[3];
    return sums[3];
}

#endif

/// dst[x] = above[x] + src[0] + ... + src[x], modulo 2^32.
inline void integral_row(const std::uint8_t* src, int count, const std::uint32_t* above, std::uint32_t* dst) {
    int x = 0;
    std::uint32_t sum = 0;
#if FOVEA_BYTES >= 32 && defined(__AVX2__)
    __m256i carry = _mm256_setzero_si256();
    for (; x + 32 <= count; x += 32) {
        const __m256i bytes = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(src + x));
        const PrefixOfBytes words(bytes);
        const auto add = [&](int column, __m128i sums) {
            add_above(above + x + column, _mm256_add_epi32(_mm256_cvtepu16_epi32(sums), carry),
                      dst + x + column);
        };
        add(0, _mm256_castsi256_si128(words.first));
        add(8, _mm256_castsi256_si128(words.second));
        add(16, _mm256_extracti128_si256(words.first, 1));
        add(24, _mm256_extracti128_si256(words.second, 1));
        carry = _mm256_add_epi32(carry, words.all);
    }
    sum = static_cast<std::uint32_t>(_mm256_cvtsi256_si32(carry));
#elif FOVEA_BYTES >= 16 && defined(__SSE2__)
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
#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
    const int quarter = count / 4;
    x = 4 * quarter;
    const auto total = [=](int i) { return sum_of_row(src + i * quarter, quarter); };
    prefix_of_quarters(
        quarter, total, [=](uint32x4_t at) { return vldrbq_gather_offset_u32(src, at); },
        [=](uint32x4_t at, uint32x4_t sums) {
            const uint32x4_t over = vldrwq_gather_shifted_offset_u32(above, at);
            vstrwq_scatter_shifted_offset_u32(dst, at, vaddq_u32(over, sums));
        });
    if (quarter > 0) sum = dst[x - 1] - above[x - 1];
#elif FOVEA_BYTES == 4 && defined(__ARM_FEATURE_SIMD32) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    for (; x + 8 <= count; x += 8) {
        sum = add_four_above(src + x, sum, above + x, dst + x);
        sum = add_four_above(src + x + 4, sum, above + x + 4, dst + x + 4);
    }
#endif
    for (; x < count; ++x) {
        sum += src[x];
        dst[x] = above[x] + sum;
    }
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
#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
    const int quarter = count / 4;
    x = 4 * quarter;
    const auto total = [=](int i) { return sum_of_row(src + i * quarter, quarter); };
    prefix_of_quarters(
        quarter, total, [=](uint32x4_t at) { return vldrhq_gather_shifted_offset_u32(src, at); },
        [=](uint32x4_t at, uint32x4_t sums) { vstrwq_scatter_shifted_offset_u32(dst, at, sums); });
    if (quarter > 0) sum = dst[x - 1];
#endif
    for (; x < count; ++x) {
        sum += src[x];
        dst[x] = sum;
    }
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
