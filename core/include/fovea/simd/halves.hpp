// SPDX-License-Identifier: MIT
//
// Bytes in their natural order as 16-bit values and back, a vector turned round, and squares of bytes
// transposed: what moves pixels to other columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

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

/// Pixels in half a vector: as many as RawWords has values.
inline constexpr int half_lanes = lanes / 2;

/// The first half of the pixels of a vector as values in order.
[[gnu::always_inline]] inline RawWords widened(const std::uint8_t* from) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    __m128i half;
    std::memcpy(&half, from, sizeof half);
    return bits_as<RawWords>(_mm256_cvtepu8_epi16(half));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    std::uint64_t half;
    std::memcpy(&half, from, sizeof half);
    return bits_as<RawWords>(
        _mm_unpacklo_epi8(_mm_cvtsi64_si128(static_cast<long long>(half)), _mm_setzero_si128()));
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
    return bits_as<RawWords>(vldrbq_u16(from));
#else
    std::uint16_t values[half_lanes];
    for (int i = 0; i < half_lanes; ++i) values[i] = from[i];
    return load_raw<RawWords>(values);
#endif
}

/// Values below 256, in order, back to pixels: first, then second.
[[gnu::always_inline]] inline Bytes narrowed(RawWords first, RawWords second) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    const __m256i both = _mm256_packus_epi16(bits_as<__m256i>(first), bits_as<__m256i>(second));
    return {bits_as<RawBytes>(_mm256_permute4x64_epi64(both, 0xd8))};
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    return {bits_as<RawBytes>(_mm_packus_epi16(bits_as<__m128i>(first), bits_as<__m128i>(second)))};
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
    // Narrow numbers lie in order in memory alone.
    std::uint8_t pixels[lanes];
    vstrbq_u16(pixels, bits_as<uint16x8_t>(first));
    vstrbq_u16(pixels + half_lanes, bits_as<uint16x8_t>(second));
    return Bytes::load(pixels);
#else
    std::uint16_t values[lanes];
    std::memcpy(values, &first, sizeof first);
    std::memcpy(values + half_lanes, &second, sizeof second);
    std::uint8_t pixels[lanes];
    for (int i = 0; i < lanes; ++i) pixels[i] = static_cast<std::uint8_t>(values[i]);
    return Bytes::load(pixels);
#endif
}

/// The pixels of a vector as values, in whatever order the processor gets them fastest.
struct SplitWords {
    RawWords first;
    RawWords second;
};
[[gnu::always_inline]] inline SplitWords split(Bytes bytes) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    const auto raw = bits_as<__m256i>(bytes.raw);
    const __m256i zero = _mm256_setzero_si256();
    return {bits_as<RawWords>(_mm256_unpacklo_epi8(raw, zero)),
            bits_as<RawWords>(_mm256_unpackhi_epi8(raw, zero))};
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    const auto raw = bits_as<__m128i>(bytes.raw);
    const __m128i zero = _mm_setzero_si128();
    return {bits_as<RawWords>(_mm_unpacklo_epi8(raw, zero)), bits_as<RawWords>(_mm_unpackhi_epi8(raw, zero))};
#else
    const Words words(bytes);
    return {words.even, words.odd};
#endif
}
/// Back to pixels: values of -32768 to 32767, held at 0 and 255.
[[gnu::always_inline]] inline Bytes joined_held(SplitWords words) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    return {bits_as<RawBytes>(
        _mm256_packus_epi16(bits_as<__m256i>(words.first), bits_as<__m256i>(words.second)))};
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    return {
        bits_as<RawBytes>(_mm_packus_epi16(bits_as<__m128i>(words.first), bits_as<__m128i>(words.second)))};
#else
    return Words(words.first, words.second).held();
#endif
}

/// The pixels in reverse order.
[[gnu::always_inline]] inline Bytes reversed(Bytes bytes) {
#if FOVEA_BYTES == 32
    return {__builtin_shufflevector(bytes.raw, bytes.raw, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19,
                                    18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0)};
#elif FOVEA_BYTES == 16 && defined(__SSE2__) && !defined(__SSSE3__)
    // Bytes within words, words within halves, halves.
    const auto words = bits_as<RawWords>(bytes.raw);
    __m128i turned = bits_as<__m128i>((words << 8) | (words >> 8));
    turned = _mm_shufflehi_epi16(_mm_shufflelo_epi16(turned, 0x1b), 0x1b);
    return {bits_as<RawBytes>(_mm_shuffle_epi32(turned, 0x4e))};
#elif FOVEA_BYTES == 16
    return {
        __builtin_shufflevector(bytes.raw, bytes.raw, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0)};
#elif FOVEA_BYTES == 4
    return {__builtin_bswap32(bytes.raw)};
#else
    std::uint8_t from[lanes];
    std::uint8_t to[lanes];
    bytes.store(from);
    for (int i = 0; i < lanes; ++i) to[i] = from[lanes - 1 - i];
    return Bytes::load(to);
#endif
}

/// The side of the squares that transpose_square() turns over.
#if FOVEA_BYTES >= 16
inline constexpr int square_side = 16;
#else
inline constexpr int square_side = 4;
#endif

/// The square of bytes at src with rows and columns exchanged.
inline void transpose_square(const std::uint8_t* src, std::ptrdiff_t src_stride, std::uint8_t* dst,
                             std::ptrdiff_t dst_stride) {
#if FOVEA_BYTES >= 16
    using Row [[gnu::vector_size(16)]] = std::uint8_t;
    Row a[16];
    Row b[16];
    for (int i = 0; i < 16; ++i) a[i] = load_raw<Row>(src + i * src_stride);
    // Four rounds of interleaving row i with row i + 8.
    const auto interleave = [](const Row* from, Row* to) {
        for (int i = 0; i < 8; ++i) {
            to[2 * i] = __builtin_shufflevector(from[i], from[i + 8], 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5,
                                                21, 6, 22, 7, 23);
            to[2 * i + 1] = __builtin_shufflevector(from[i], from[i + 8], 8, 24, 9, 25, 10, 26, 11, 27, 12,
                                                    28, 13, 29, 14, 30, 15, 31);
        }
    };
    interleave(a, b);
    interleave(b, a);
    interleave(a, b);
    interleave(b, a);
    for (int i = 0; i < 16; ++i) std::memcpy(dst + i * dst_stride, &a[i], sizeof a[i]);
#else
    for (int y = 0; y < square_side; ++y)
        for (int x = 0; x < square_side; ++x) dst[x * dst_stride + y] = src[y * src_stride + x];
#endif
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
