// SPDX-License-Identifier: MIT
//
// 32 bytes as 32 bits and back: bit i of the word is that of byte i, on every machine. And as many words of
// bits as fit a vector.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/unroll.hpp>

#if FOVEA_BYTES >= 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES >= 16 && defined(__SSE2__)
#include <emmintrin.h>
#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

#if FOVEA_BYTES >= 8
using WordPiece = RawQuads;
#else
using WordPiece = std::uint32_t;
#endif
inline constexpr int piece_words = FOVEA_BYTES / 4;

/// Words from a place on: a piece of them, or one.
template <class Piece>
[[gnu::always_inline]] inline Piece load_piece(const std::uint32_t* from) {
    Piece piece;
    std::memcpy(&piece, from, sizeof piece);
    return piece;
}
/// to[i] = make(i, kind) for words first to end - 1, a piece at a time and then one by one: kind has the type
/// of what is to be made of the words from i on. What is made may stand where something behind it was read.
template <class Make>
[[gnu::always_inline]] inline void make_words(int first, int end, std::uint32_t* to, Make make) {
    int i = first;
    for (; i + piece_words <= end; i += piece_words) {
        const WordPiece piece = make(i, WordPiece{});
        std::memcpy(to + i, &piece, sizeof piece);
    }
    for (; i < end; ++i) to[i] = make(i, std::uint32_t{});
}

#if FOVEA_BYTES >= 32 && defined(__AVX2__)

/// Bit i is set where byte i of 32 is level or more.
[[gnu::always_inline]] inline std::uint32_t bits_at_least(const std::uint8_t* from, std::uint8_t level) {
    const __m256i bytes = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    const __m256i limit = _mm256_set1_epi8(static_cast<char>(level));
    return static_cast<std::uint32_t>(
        _mm256_movemask_epi8(_mm256_cmpeq_epi8(_mm256_max_epu8(bytes, limit), bytes)));
}
/// Byte i of 32 becomes 255 where bit i is set, 0 elsewhere.
[[gnu::always_inline]] inline void spread_bits(std::uint32_t bits, std::uint8_t* to) {
    const __m256i word = _mm256_set1_epi32(static_cast<int>(bits));
    const __m256i which = _mm256_setr_epi64x(0, 0x0101010101010101, 0x0202020202020202, 0x0303030303030303);
    const __m256i bit = _mm256_set1_epi64x(static_cast<long long>(0x8040201008040201));
    const __m256i own = _mm256_and_si256(_mm256_shuffle_epi8(word, which), bit);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_cmpeq_epi8(own, bit));
}

#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)

[[gnu::always_inline]] inline std::uint32_t bits_at_least(const std::uint8_t* from, std::uint8_t level) {
    const mve_pred16_t low = vcmpcsq_n_u8(vldrbq_u8(from), level);
    const mve_pred16_t high = vcmpcsq_n_u8(vldrbq_u8(from + 16), level);
    return std::uint32_t{low} | std::uint32_t{high} << 16;
}
[[gnu::always_inline]] inline void spread_bits(std::uint32_t bits, std::uint8_t* to) {
    const uint8x16_t white = vdupq_n_u8(255);
    const uint8x16_t black = vdupq_n_u8(0);
    vstrbq_u8(to, vpselq_u8(white, black, static_cast<mve_pred16_t>(bits & 0xffff)));
    vstrbq_u8(to + 16, vpselq_u8(white, black, static_cast<mve_pred16_t>(bits >> 16)));
}

#else

/// Bit i of 8 or 4 is bit 0 of byte i, which is 0 or 1. The products are such that no two bits meet.
[[gnu::always_inline]] inline std::uint32_t bits_of_eight(std::uint64_t bytes) {
    constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    constexpr std::uint64_t gather = big_endian ? 0x8040201008040201u : 0x0102040810204080u;
    return static_cast<std::uint32_t>(bytes * gather >> 56);
}
[[gnu::always_inline]] inline std::uint32_t bits_of_four(std::uint32_t bytes) {
    constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    constexpr std::uint32_t gather = big_endian ? 0x08040201u : 0x01020408u;
    return bytes * gather >> 24 & 15;
}

[[gnu::always_inline]] inline std::uint32_t bits_at_least(const std::uint8_t* from, std::uint8_t level) {
    std::uint32_t bits = 0;
#if FOVEA_BYTES >= 16 && defined(__SSE2__)
    const __m128i limit = _mm_set1_epi8(static_cast<char>(level));
    for (int i = 0; i < 32; i += 16) {
        const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from + i));
        const int mask = _mm_movemask_epi8(_mm_cmpeq_epi8(_mm_max_epu8(bytes, limit), bytes));
        bits |= static_cast<std::uint32_t>(mask) << i;
    }
#elif FOVEA_BYTES == 4 && defined(__ARM_FEATURE_SIMD32) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    // Each byte gives a bit of its own, and one instruction adds four bytes.
    const RawBytes limit = all_bytes(level);
    unroll<4>([&](auto i) {
        const RawBytes low = choose(load_raw<RawBytes>(from + 8 * i), limit, 0x08040201u, 0);
        const RawBytes high = choose(load_raw<RawBytes>(from + 8 * i + 4), limit, 0x80402010u, 0);
        std::uint32_t eight;
        asm("usad8 %0, %1, %2" : "=r"(eight) : "r"(low | high), "r"(0));
        bits |= eight << (8 * i);
    });
#elif FOVEA_BYTES == 4
    for (int i = 0; i < 32; i += 4) {
        const Bytes mask = at_least(Bytes::load(from + i), Bytes::all(level));
        bits |= bits_of_four(mask.raw & 0x01010101u) << i;
    }
#else
    const Bytes limit = Bytes::all(level);
    std::uint8_t masks[lanes < 32 ? 32 : lanes];
    for (int i = 0; i < 32; i += lanes)
        (at_least(lanes <= 32 ? Bytes::load(from + i) : Bytes::load(from, 32), limit) & Bytes::all(1))
            .store(masks + i);
    for (int i = 0; i < 32; i += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, masks + i, sizeof eight);
        bits |= bits_of_eight(eight) << i;
    }
#endif
    return bits;
}

[[gnu::always_inline]] inline void spread_bits(std::uint32_t bits, std::uint8_t* to) {
    constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    constexpr std::uint64_t own = big_endian ? 0x0102040810204080u : 0x8040201008040201u;
    for (int i = 0; i < 32; i += 8) {
        // One bit in every byte, at its own place: with 127 added it reaches the top.
        const std::uint64_t spread = (bits >> i & 255) * 0x0101010101010101u & own;
        const std::uint64_t tops = (spread + 0x7f7f7f7f7f7f7f7fu) >> 7 & 0x0101010101010101u;
        const std::uint64_t bytes = tops * 255;
        std::memcpy(to + i, &bytes, sizeof bytes);
    }
}

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
