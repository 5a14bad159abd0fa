// SPDX-License-Identifier: MIT
//
// Sums over the bytes of a row, and over their squares, where the processor adds many at once.
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
#elif FOVEA_BYTES == 4 && defined(__ARM_FEATURE_SIMD32)
#include <arm_acle.h>

#include <cstring>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// Sum of the bytes of a row and of their squares.
struct ByteSums {
    std::uint64_t sum = 0;
    std::uint64_t squares = 0;
};

/// The longest stretch whose sums fit 32 bits in every lane: 2^15 squares of 255 are below 2^31.
inline constexpr int sums_a_stretch = 1 << 15;

#if FOVEA_BYTES >= 32 && defined(__AVX2__)

inline constexpr int sums_a_step = 32;

[[gnu::always_inline]] inline std::uint64_t sum_of_lanes(__m256i quads) {
    alignas(32) std::uint64_t lanes_of[4];
    _mm256_store_si256(reinterpret_cast<__m256i*>(lanes_of), quads);
    return lanes_of[0] + lanes_of[1] + lanes_of[2] + lanes_of[3];
}
[[gnu::always_inline]] inline std::uint64_t add_steps(const std::uint8_t* row, int count) {
    const __m256i zero = _mm256_setzero_si256();
    __m256i sum = zero;
    for (int i = 0; i < count; i += 32)
        sum = _mm256_add_epi64(
            sum, _mm256_sad_epu8(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(row + i)), zero));
    return sum_of_lanes(sum);
}
[[gnu::always_inline]] inline ByteSums add_square_steps(const std::uint8_t* row, int count) {
    const __m256i zero = _mm256_setzero_si256();
    __m256i sum = zero;
    __m256i squares = zero;
    for (int i = 0; i < count; i += 32) {
        const __m256i bytes = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row + i));
        const __m256i low = _mm256_unpacklo_epi8(bytes, zero);
        const __m256i high = _mm256_unpackhi_epi8(bytes, zero);
        sum = _mm256_add_epi64(sum, _mm256_sad_epu8(bytes, zero));
        squares = _mm256_add_epi32(
            squares, _mm256_add_epi32(_mm256_madd_epi16(low, low), _mm256_madd_epi16(high, high)));
    }
    return {sum_of_lanes(sum), sum_of_lanes(_mm256_add_epi64(_mm256_unpacklo_epi32(squares, zero),
                                                             _mm256_unpackhi_epi32(squares, zero)))};
}

#elif FOVEA_BYTES >= 16 && defined(__SSE2__)

inline constexpr int sums_a_step = 16;

[[gnu::always_inline]] inline std::uint64_t sum_of_lanes(__m128i quads) {
    alignas(16) std::uint64_t lanes_of[2];
    _mm_store_si128(reinterpret_cast<__m128i*>(lanes_of), quads);
    return lanes_of[0] + lanes_of[1];
}
[[gnu::always_inline]] inline std::uint64_t add_steps(const std::uint8_t* row, int count) {
    const __m128i zero = _mm_setzero_si128();
    __m128i sum = zero;
    for (int i = 0; i < count; i += 16)
        sum = _mm_add_epi64(sum,
                            _mm_sad_epu8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(row + i)), zero));
    return sum_of_lanes(sum);
}
[[gnu::always_inline]] inline ByteSums add_square_steps(const std::uint8_t* row, int count) {
    const __m128i zero = _mm_setzero_si128();
    __m128i sum = zero;
    __m128i squares = zero;
    for (int i = 0; i < count; i += 16) {
        const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(row + i));
        const __m128i low = _mm_unpacklo_epi8(bytes, zero);
        const __m128i high = _mm_unpackhi_epi8(bytes, zero);
        sum = _mm_add_epi64(sum, _mm_sad_epu8(bytes, zero));
        squares = _mm_add_epi32(squares, _mm_add_epi32(_mm_madd_epi16(low, low), _mm_madd_epi16(high, high)));
    }
    return {sum_of_lanes(sum), sum_of_lanes(_mm_add_epi64(_mm_unpacklo_epi32(squares, zero),
                                                          _mm_unpackhi_epi32(squares, zero)))};
}

#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON)

inline constexpr int sums_a_step = 16;

[[gnu::always_inline]] inline std::uint64_t sum_of_lanes(uint32x4_t words) {
    const uint64x2_t quads = vpaddlq_u32(words);
    return vgetq_lane_u64(quads, 0) + vgetq_lane_u64(quads, 1);
}
[[gnu::always_inline]] inline std::uint64_t add_steps(const std::uint8_t* row, int count) {
    uint32x4_t sum = vdupq_n_u32(0);
    for (int i = 0; i < count; i += 16) sum = vpadalq_u16(sum, vpaddlq_u8(vld1q_u8(row + i)));
    return sum_of_lanes(sum);
}
[[gnu::always_inline]] inline ByteSums add_square_steps(const std::uint8_t* row, int count) {
    uint32x4_t sum = vdupq_n_u32(0);
    uint32x4_t squares = vdupq_n_u32(0);
    for (int i = 0; i < count; i += 16) {
        const uint8x16_t bytes = vld1q_u8(row + i);
        sum = vpadalq_u16(sum, vpaddlq_u8(bytes));
        squares = vpadalq_u16(squares, vmull_u8(vget_low_u8(bytes), vget_low_u8(bytes)));
        squares = vpadalq_u16(squares, vmull_u8(vget_high_u8(bytes), vget_high_u8(bytes)));
    }
    return {sum_of_lanes(sum), sum_of_lanes(squares)};
}

#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)

inline constexpr int sums_a_step = 16;

[[gnu::always_inline]] inline std::uint64_t add_steps(const std::uint8_t* row, int count) {
    std::uint32_t sum = 0;
    for (int i = 0; i < count; i += 16) sum = vaddvaq_u8(sum, vldrbq_u8(row + i));
    return sum;
}
[[gnu::always_inline]] inline ByteSums add_square_steps(const std::uint8_t* row, int count) {
    std::uint32_t sum = 0;
    std::uint32_t squares = 0;
    for (int i = 0; i < count; i += 16) {
        const uint8x16_t bytes = vldrbq_u8(row + i);
        sum = vaddvaq_u8(sum, bytes);
        squares = vmladavaq_u8(squares, bytes, bytes);
    }
    return {sum, squares};
}

#elif FOVEA_BYTES == 4 && defined(__ARM_FEATURE_SIMD32)

inline constexpr int sums_a_step = 8;

[[gnu::always_inline]] inline std::uint64_t add_steps(const std::uint8_t* row, int count) {
    std::uint32_t sum = 0;
    for (int i = 0; i < count; i += 8) {
        std::uint32_t words[2];
        std::memcpy(words, row + i, sizeof words);
        sum = __usada8(words[1], 0, __usada8(words[0], 0, sum));
    }
    return sum;
}
/// Adds a word's four bytes and their squares.
[[gnu::always_inline]] inline void add_four(std::uint32_t word, std::uint32_t& sum, std::uint32_t& squares) {
    std::uint32_t even;
    std::uint32_t odd;
    asm("uxtb16 %0, %1" : "=r"(even) : "r"(word));
    asm("uxtb16 %0, %1, ror #8" : "=r"(odd) : "r"(word));
    sum = __usada8(word, 0, sum);
    asm("smlad %0, %1, %1, %0" : "+r"(squares) : "r"(even) : "cc");
    asm("smlad %0, %1, %1, %0" : "+r"(squares) : "r"(odd) : "cc");
}
[[gnu::always_inline]] inline ByteSums add_square_steps(const std::uint8_t* row, int count) {
    std::uint32_t sum = 0;
    std::uint32_t squares = 0;
    for (int i = 0; i < count; i += 8) {
        std::uint32_t words[2];
        std::memcpy(words, row + i, sizeof words);
        add_four(words[0], sum, squares);
        add_four(words[1], sum, squares);
    }
    return {sum, squares};
}

#else

inline constexpr int sums_a_step = 1;

[[gnu::always_inline]] inline std::uint64_t add_steps(const std::uint8_t* row, int count) {
    std::uint32_t sum = 0;
    for (int i = 0; i < count; ++i) sum += row[i];
    return sum;
}
[[gnu::always_inline]] inline ByteSums add_square_steps(const std::uint8_t* row, int count) {
    std::uint32_t sum = 0;
    std::uint32_t squares = 0;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t value = row[i];
        sum += value;
        squares += value * value;
    }
    return {sum, squares};
}

#endif

/// The sum of count bytes.
inline std::uint64_t sum_of_bytes(const std::uint8_t* row, int count) {
    std::uint64_t sum = 0;
    while (count >= sums_a_step) {
        const int stretch = (count < sums_a_stretch ? count : sums_a_stretch) / sums_a_step * sums_a_step;
        sum += add_steps(row, stretch);
        row += stretch;
        count -= stretch;
    }
    for (int i = 0; i < count; ++i) sum += row[i];
    return sum;
}

/// The sums of count bytes and of their squares.
inline ByteSums square_sums_of_bytes(const std::uint8_t* row, int count) {
    ByteSums sums;
    while (count >= sums_a_step) {
        const int stretch = (count < sums_a_stretch ? count : sums_a_stretch) / sums_a_step * sums_a_step;
        const ByteSums part = add_square_steps(row, stretch);
        sums.sum += part.sum;
        sums.squares += part.squares;
        row += stretch;
        count -= stretch;
    }
    for (int i = 0; i < count; ++i) {
        const std::uint32_t value = row[i];
        sums.sum += value;
        sums.squares += value * value;
    }
    return sums;
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
