// SPDX-License-Identifier: MIT
//
// Pairs and triples of bytes, dealt out to one vector for each place and put together again: packed colour,
// and the two bytes of video pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

#if FOVEA_BYTES >= 32 && defined(__AVX2__)
#include <immintrin.h>
#define FOVEA_INTERLEAVE_AVX2
#elif FOVEA_BYTES >= 16 && defined(__SSE2__)
#if defined(__SSSE3__)
#include <immintrin.h>
#else
#include <emmintrin.h>
#endif
#define FOVEA_INTERLEAVE_SSE2
#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON)
#include <arm_neon.h>
#define FOVEA_INTERLEAVE_NEON
#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#define FOVEA_INTERLEAVE_MVE
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

// ---- Interface --------------------------------------------------------------------

/// The first and the second bytes of lanes pairs.
struct BytePairs {
    Bytes first;
    Bytes second;
};

/// The first, second and third bytes of lanes triples.
struct ByteTriples {
    Bytes first;
    Bytes second;
    Bytes third;
};

/// Reads 2 * lanes bytes.
inline BytePairs load_pairs(const std::uint8_t* from);

/// Reads 3 * lanes bytes.
inline ByteTriples load_triples(const std::uint8_t* from);

/// Writes 3 * lanes bytes: the inverse of load_triples().
inline void store_triples(const ByteTriples& triples, std::uint8_t* to);

/// step(from, to) for every lanes pixels of a row, each of which reads lanes pixels of InBytes and writes as
/// many of OutBytes. What is left at the end goes through a buffer, zeros behind it. dst may be src if a step
/// reads all it needs before it writes.
template <int InBytes, int OutBytes, class Step>
[[gnu::always_inline]] inline void for_each_step(const std::uint8_t* src, int width, std::uint8_t* dst,
                                                 Step step) {
    int x = 0;
    for (; x + lanes <= width; x += lanes)
        step(src + std::ptrdiff_t{x} * InBytes, dst + std::ptrdiff_t{x} * OutBytes);
    if (x == width) return;
    std::uint8_t in[static_cast<std::size_t>(lanes) * InBytes] = {};
    std::uint8_t out[static_cast<std::size_t>(lanes) * OutBytes];
    const auto rest = static_cast<std::size_t>(width - x);
    std::memcpy(in, src + std::ptrdiff_t{x} * InBytes, rest * InBytes);
    step(in, out);
    std::memcpy(dst + std::ptrdiff_t{x} * OutBytes, out, rest * OutBytes);
}

// ---- Implementation ---------------------------------------------------------------

#if defined(FOVEA_INTERLEAVE_AVX2)

using InterleavePiece = __m256i;

/// 16 bytes from either place, each in its half of a register.
[[gnu::always_inline]] inline __m256i two_halves(const std::uint8_t* low, const std::uint8_t* high) {
    const __m128i first = _mm_loadu_si128(reinterpret_cast<const __m128i*>(low));
    const __m128i second = _mm_loadu_si128(reinterpret_cast<const __m128i*>(high));
    return _mm256_inserti128_si256(_mm256_castsi128_si256(first), second, 1);
}

[[gnu::always_inline]] inline void deal_pairs(const std::uint8_t* from, InterleavePiece (&part)[2]) {
    const __m256i a = two_halves(from, from + 32);
    const __m256i b = two_halves(from + 16, from + 48);
    const __m256i low = _mm256_set1_epi16(255);
    part[0] = _mm256_packus_epi16(_mm256_and_si256(a, low), _mm256_and_si256(b, low));
    part[1] = _mm256_packus_epi16(_mm256_srli_epi16(a, 8), _mm256_srli_epi16(b, 8));
}

/// The same 16 bytes in both halves.
[[gnu::always_inline]] inline __m256i both_halves(__m128i bytes) {
    return _mm256_broadcastsi128_si256(bytes);
}

// Byte 3i + c of 48 stands in column (3i + c) mod 16 of its register, and no two i share a column. So the
// bytes of one place in the triple are picked from the three registers by masks and then put in order.
[[gnu::always_inline]] inline __m256i first_of_three() {
    return both_halves(_mm_setr_epi8(-1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1));
}
[[gnu::always_inline]] inline __m256i second_of_three() {
    return both_halves(_mm_setr_epi8(0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0));
}
[[gnu::always_inline]] inline __m256i pick(__m256i a, __m256i b, __m256i from_b) {
    return _mm256_blendv_epi8(a, b, from_b);
}

[[gnu::always_inline]] inline void deal_triples(const std::uint8_t* from, InterleavePiece (&part)[3]) {
    const __m256i a = two_halves(from, from + 48);
    const __m256i b = two_halves(from + 16, from + 64);
    const __m256i c = two_halves(from + 32, from + 80);
    const __m256i m0 = first_of_three();
    const __m256i m1 = second_of_three();
    const __m256i first = pick(pick(b, a, m0), c, m1);
    const __m256i second = pick(pick(c, a, m1), b, m0);
    const __m256i third = pick(pick(a, b, m1), c, m0);
    part[0] = _mm256_shuffle_epi8(
        first, both_halves(_mm_setr_epi8(0, 3, 6, 9, 12, 15, 2, 5, 8, 11, 14, 1, 4, 7, 10, 13)));
    part[1] = _mm256_shuffle_epi8(
        second, both_halves(_mm_setr_epi8(1, 4, 7, 10, 13, 0, 3, 6, 9, 12, 15, 2, 5, 8, 11, 14)));
    part[2] = _mm256_shuffle_epi8(
        third, both_halves(_mm_setr_epi8(2, 5, 8, 11, 14, 1, 4, 7, 10, 13, 0, 3, 6, 9, 12, 15)));
}

[[gnu::always_inline]] inline void join_triples(const InterleavePiece (&part)[3], std::uint8_t* to) {
    // Each byte to its column, then each column from the register that has it.
    const __m256i first = _mm256_shuffle_epi8(
        part[0], both_halves(_mm_setr_epi8(0, 11, 6, 1, 12, 7, 2, 13, 8, 3, 14, 9, 4, 15, 10, 5)));
    const __m256i second = _mm256_shuffle_epi8(
        part[1], both_halves(_mm_setr_epi8(5, 0, 11, 6, 1, 12, 7, 2, 13, 8, 3, 14, 9, 4, 15, 10)));
    const __m256i third = _mm256_shuffle_epi8(
        part[2], both_halves(_mm_setr_epi8(10, 5, 0, 11, 6, 1, 12, 7, 2, 13, 8, 3, 14, 9, 4, 15)));
    const __m256i m0 = first_of_three();
    const __m256i m1 = second_of_three();
    const __m256i a = pick(pick(third, first, m0), second, m1);
    const __m256i b = pick(pick(first, second, m0), third, m1);
    const __m256i c = pick(pick(second, third, m0), first, m1);
    auto* out = reinterpret_cast<__m256i*>(to);
    _mm256_storeu_si256(out, _mm256_permute2x128_si256(a, b, 0x20));
    _mm256_storeu_si256(out + 1, _mm256_blend_epi32(c, a, 0xf0));
    _mm256_storeu_si256(out + 2, _mm256_permute2x128_si256(b, c, 0x31));
}

#elif defined(FOVEA_INTERLEAVE_SSE2)

using InterleavePiece = __m128i;

[[gnu::always_inline]] inline void deal_pairs(const std::uint8_t* from, InterleavePiece (&part)[2]) {
    const __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    const __m128i b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from) + 1);
    const __m128i low = _mm_set1_epi16(255);
    part[0] = _mm_packus_epi16(_mm_and_si128(a, low), _mm_and_si128(b, low));
    part[1] = _mm_packus_epi16(_mm_srli_epi16(a, 8), _mm_srli_epi16(b, 8));
}

[[gnu::always_inline]] inline void deal_triples(const std::uint8_t* from, InterleavePiece (&part)[3]) {
    __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    __m128i b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from) + 1);
    __m128i c = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from) + 2);
    // Each round puts bytes together that were half the 48 apart; after four, those that were 3 apart.
    for (int round = 0; round < 4; ++round) {
        const __m128i x = _mm_unpacklo_epi8(a, _mm_unpackhi_epi64(b, b));
        const __m128i y = _mm_unpacklo_epi8(_mm_unpackhi_epi64(a, a), c);
        c = _mm_unpacklo_epi8(b, _mm_unpackhi_epi64(c, c));
        a = x;
        b = y;
    }
    part[0] = a;
    part[1] = b;
    part[2] = c;
}

[[gnu::always_inline]] inline void join_triples(const InterleavePiece (&part)[3], std::uint8_t* to) {
    __m128i a = part[0];
    __m128i b = part[1];
    __m128i c = part[2];
#if defined(__SSSE3__)
    // Byte 3i + c belongs into column (3i + c) mod 16 of its register: each byte to its column, then each
    // column from the register that has it.
    a = _mm_shuffle_epi8(a, _mm_setr_epi8(0, 11, 6, 1, 12, 7, 2, 13, 8, 3, 14, 9, 4, 15, 10, 5));
    b = _mm_shuffle_epi8(b, _mm_setr_epi8(5, 0, 11, 6, 1, 12, 7, 2, 13, 8, 3, 14, 9, 4, 15, 10));
    c = _mm_shuffle_epi8(c, _mm_setr_epi8(10, 5, 0, 11, 6, 1, 12, 7, 2, 13, 8, 3, 14, 9, 4, 15));
    const __m128i m0 = _mm_setr_epi8(-1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1);
    const __m128i m1 = _mm_setr_epi8(0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0);
    const __m128i m2 = _mm_setr_epi8(0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0);
    const auto merge = [&](__m128i x, __m128i y, __m128i z) {
        return _mm_or_si128(_mm_and_si128(x, m0), _mm_or_si128(_mm_and_si128(y, m1), _mm_and_si128(z, m2)));
    };
    const __m128i x = merge(a, b, c);
    const __m128i y = merge(b, c, a);
    c = merge(c, a, b);
    a = x;
    b = y;
#else
    // The rounds of deal_triples() backwards: even bytes into the first half, odd ones into the second.
    const __m128i low = _mm_set1_epi16(255);
    for (int round = 0; round < 4; ++round) {
        const __m128i x = _mm_packus_epi16(_mm_and_si128(a, low), _mm_and_si128(b, low));
        const __m128i y = _mm_packus_epi16(_mm_and_si128(c, low), _mm_srli_epi16(a, 8));
        c = _mm_packus_epi16(_mm_srli_epi16(b, 8), _mm_srli_epi16(c, 8));
        a = x;
        b = y;
    }
#endif
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), a);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to) + 1, b);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to) + 2, c);
}

#elif defined(FOVEA_INTERLEAVE_NEON)

using InterleavePiece = uint8x16_t;

[[gnu::always_inline]] inline void deal_pairs(const std::uint8_t* from, InterleavePiece (&part)[2]) {
    const uint8x16x2_t pairs = vld2q_u8(from);
    for (int i = 0; i < 2; ++i) part[i] = pairs.val[i];
}
[[gnu::always_inline]] inline void deal_triples(const std::uint8_t* from, InterleavePiece (&part)[3]) {
    const uint8x16x3_t triples = vld3q_u8(from);
    for (int i = 0; i < 3; ++i) part[i] = triples.val[i];
}
[[gnu::always_inline]] inline void join_triples(const InterleavePiece (&part)[3], std::uint8_t* to) {
    uint8x16x3_t triples;
    for (int i = 0; i < 3; ++i) triples.val[i] = part[i];
    vst3q_u8(to, triples);
}

#elif defined(FOVEA_INTERLEAVE_MVE)

using InterleavePiece = uint8x16_t;

/// Where the first bytes of 16 pairs or triples lie.
template <int Size>
[[gnu::always_inline]] inline uint8x16_t each() {
    return vmulq_n_u8(vidupq_n_u8(0, 1), Size);
}

[[gnu::always_inline]] inline void deal_pairs(const std::uint8_t* from, InterleavePiece (&part)[2]) {
    const uint8x16_t at = each<2>();
    for (int i = 0; i < 2; ++i) part[i] = vldrbq_gather_offset_u8(from + i, at);
}
[[gnu::always_inline]] inline void deal_triples(const std::uint8_t* from, InterleavePiece (&part)[3]) {
    const uint8x16_t at = each<3>();
    for (int i = 0; i < 3; ++i) part[i] = vldrbq_gather_offset_u8(from + i, at);
}
[[gnu::always_inline]] inline void join_triples(const InterleavePiece (&part)[3], std::uint8_t* to) {
    const uint8x16_t at = each<3>();
    for (int i = 0; i < 3; ++i) vstrbq_scatter_offset_u8(to + i, at, part[i]);
}

#else

/// No faster way than byte by byte: the body that all others equal.
struct InterleavePiece {
    std::uint8_t byte[lanes];
};

inline void deal_pairs(const std::uint8_t* from, InterleavePiece (&part)[2]) {
    for (int i = 0; i < lanes; ++i)
        for (int c = 0; c < 2; ++c) part[c].byte[i] = from[2 * i + c];
}
inline void deal_triples(const std::uint8_t* from, InterleavePiece (&part)[3]) {
    for (int i = 0; i < lanes; ++i)
        for (int c = 0; c < 3; ++c) part[c].byte[i] = from[3 * i + c];
}
inline void join_triples(const InterleavePiece (&part)[3], std::uint8_t* to) {
    for (int i = 0; i < lanes; ++i)
        for (int c = 0; c < 3; ++c) to[3 * i + c] = part[c].byte[i];
}

#endif

// A vector wider than a piece is made of several.
inline constexpr int interleave_bytes = static_cast<int>(sizeof(InterleavePiece));
static_assert(lanes % interleave_bytes == 0, "whole pieces make a vector");

[[gnu::always_inline]] inline void put_piece(int number, InterleavePiece piece, Bytes& bytes) {
    std::memcpy(reinterpret_cast<std::uint8_t*>(&bytes.raw) + number * interleave_bytes, &piece,
                sizeof piece);
}
[[gnu::always_inline]] inline InterleavePiece piece_of(const Bytes& bytes, int number) {
    InterleavePiece piece;
    std::memcpy(&piece, reinterpret_cast<const std::uint8_t*>(&bytes.raw) + number * interleave_bytes,
                sizeof piece);
    return piece;
}

[[gnu::always_inline]] inline BytePairs load_pairs(const std::uint8_t* from) {
    BytePairs pairs;
    for (int i = 0; i < lanes / interleave_bytes; ++i) {
        InterleavePiece part[2];
        deal_pairs(from + 2 * i * interleave_bytes, part);
        put_piece(i, part[0], pairs.first);
        put_piece(i, part[1], pairs.second);
    }
    return pairs;
}

[[gnu::always_inline]] inline ByteTriples load_triples(const std::uint8_t* from) {
    ByteTriples triples;
    for (int i = 0; i < lanes / interleave_bytes; ++i) {
        InterleavePiece part[3];
        deal_triples(from + 3 * i * interleave_bytes, part);
        put_piece(i, part[0], triples.first);
        put_piece(i, part[1], triples.second);
        put_piece(i, part[2], triples.third);
    }
    return triples;
}

[[gnu::always_inline]] inline void store_triples(const ByteTriples& triples, std::uint8_t* to) {
    for (int i = 0; i < lanes / interleave_bytes; ++i) {
        const InterleavePiece part[3] = {piece_of(triples.first, i), piece_of(triples.second, i),
                                         piece_of(triples.third, i)};
        join_triples(part, to + 3 * i * interleave_bytes);
    }
}

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
