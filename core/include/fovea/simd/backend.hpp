// SPDX-License-Identifier: MIT
//
// The two raw vectors behind Bytes and Words, and the few operations that differ by back end: compiler
// vectors of 8 to 64 bytes, or 32-bit words with the DSP instructions of Cortex-M where they exist. Nothing
// else may know them.
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>

#include <fovea/simd/isa.hpp>

#if FOVEA_BYTES == 4 && defined(__ARM_FEATURE_SIMD32)
#include <arm_acle.h>
#elif FOVEA_BYTES == 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
#include <emmintrin.h>
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// Pixels in one vector.
inline constexpr int lanes = FOVEA_BYTES;

/// Whether one instruction loads a vector from any address; elsewhere a word is put together of its bytes.
#if FOVEA_BYTES == 4 && (defined(__riscv) || (defined(__arm__) && !defined(__ARM_FEATURE_UNALIGNED)))
inline constexpr bool loads_anywhere = false;
#else
inline constexpr bool loads_anywhere = true;
#endif

/// The same bits as another type of the same size.
template <class To, class From>
[[gnu::always_inline]] inline To bits_as(From from) {
    static_assert(sizeof(To) == sizeof(From), "bits_as keeps the size");
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

/// The vector that lies at an address, of any alignment.
template <class Raw>
[[gnu::always_inline]] inline Raw load_raw(const void* from) {
#if defined(__clang__) && defined(__ARM_FEATURE_MVE)
    // Clang 14 loads the halves of a memcpy() and puts them together lane by lane.
    struct [[gnu::packed, gnu::may_alias]] Loose {
        Raw raw;
    };
    return static_cast<const Loose*>(from)->raw;
#else
    Raw raw;
    std::memcpy(&raw, from, sizeof raw);
    return raw;
#endif
}

#if FOVEA_BYTES >= 8

using RawBytes [[gnu::vector_size(FOVEA_BYTES)]] = std::uint8_t;
using RawWords [[gnu::vector_size(FOVEA_BYTES)]] = std::uint16_t;
using RawSigned [[gnu::vector_size(FOVEA_BYTES)]] = std::int16_t;
using RawQuads [[gnu::vector_size(FOVEA_BYTES)]] = std::uint32_t;

[[gnu::always_inline]] inline RawBytes all_bytes(std::uint8_t k) { return RawBytes{} + k; }
[[gnu::always_inline]] inline RawWords all_words(std::uint16_t k) { return RawWords{} + k; }
[[gnu::always_inline]] inline RawBytes lower(RawBytes a, RawBytes b) { return a < b ? a : b; }
[[gnu::always_inline]] inline RawBytes higher(RawBytes a, RawBytes b) { return a > b ? a : b; }
[[gnu::always_inline]] inline RawBytes at_least(RawBytes a, RawBytes b) { return bits_as<RawBytes>(a >= b); }
[[gnu::always_inline]] inline RawWords plus(RawWords a, RawWords b) { return a + b; }
[[gnu::always_inline]] inline RawWords minus(RawWords a, RawWords b) { return a - b; }
[[gnu::always_inline]] inline RawWords times(RawWords a, std::uint16_t k) { return a * all_words(k); }
[[gnu::always_inline]] inline RawWords times_signed(RawWords a, std::int16_t k) {
    return a * all_words(static_cast<std::uint16_t>(k));
}
[[gnu::always_inline]] inline RawWords shift_left(RawWords a, int n) { return a << n; }
[[gnu::always_inline]] inline RawWords shift_right(RawWords a, int n) { return a >> n; }
[[gnu::always_inline]] inline RawWords absolute(RawWords a) {
    // Negated as unsigned: -32768 stays what it is.
    const RawSigned value = bits_as<RawSigned>(a);
    const RawSigned negated = bits_as<RawSigned>(RawWords{} - a);
    return bits_as<RawWords>(value > negated ? value : negated);
}
[[gnu::always_inline]] inline RawWords at_most_255(RawWords a) {
    const RawWords limit = all_words(255);
    return a < limit ? a : limit;
}
[[gnu::always_inline]] inline RawWords lower_words(RawWords a, RawWords b) { return a < b ? a : b; }
[[gnu::always_inline]] inline RawWords higher_words(RawWords a, RawWords b) { return a > b ? a : b; }
/// 65535 where a >= b, else 0.
[[gnu::always_inline]] inline RawWords at_least_words(RawWords a, RawWords b) {
    return bits_as<RawWords>(a >= b);
}
/// The high 16 bits of each product.
[[gnu::always_inline]] inline RawWords times_high(RawWords a, std::uint16_t k) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    return bits_as<RawWords>(_mm256_mulhi_epu16(bits_as<__m256i>(a), bits_as<__m256i>(all_words(k))));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    return bits_as<RawWords>(_mm_mulhi_epu16(bits_as<__m128i>(a), bits_as<__m128i>(all_words(k))));
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
    return bits_as<RawWords>(vmulhq_u16(bits_as<uint16x8_t>(a), vdupq_n_u16(k)));
#else
    const RawQuads pairs = bits_as<RawQuads>(a);
    return bits_as<RawWords>((pairs & 0xffffu) * k >> 16 | ((pairs >> 16) * k & 0xffff0000u));
#endif
}

[[gnu::always_inline]] inline RawWords both_times_high(RawWords a, RawWords b) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    return bits_as<RawWords>(_mm256_mulhi_epu16(bits_as<__m256i>(a), bits_as<__m256i>(b)));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    return bits_as<RawWords>(_mm_mulhi_epu16(bits_as<__m128i>(a), bits_as<__m128i>(b)));
#elif FOVEA_BYTES == 16 && defined(__ARM_FEATURE_MVE)
    return bits_as<RawWords>(vmulhq_u16(bits_as<uint16x8_t>(a), bits_as<uint16x8_t>(b)));
#else
    const RawQuads x = bits_as<RawQuads>(a);
    const RawQuads y = bits_as<RawQuads>(b);
    return bits_as<RawWords>((x & 0xffffu) * (y & 0xffffu) >> 16 | ((x >> 16) * (y >> 16) & 0xffff0000u));
#endif
}

/// The numbers Count of a vector as a pack, for shuffles.
template <class Numbers>
struct Shuffle;
template <int... I>
struct Shuffle<std::integer_sequence<int, I...>> {
    static constexpr int count = static_cast<int>(sizeof...(I));
    /// a0 b0 a1 b1 ..., the first half of it, and the second.
    [[gnu::always_inline]] static RawWords interleave_first(RawWords a, RawWords b) {
        return __builtin_shufflevector(a, b, (I / 2 + I % 2 * count)...);
    }
    [[gnu::always_inline]] static RawWords interleave_second(RawWords a, RawWords b) {
        return __builtin_shufflevector(a, b, (count / 2 + I / 2 + I % 2 * count)...);
    }
    /// Every second of a and then of b, from the first on, and from the second.
    [[gnu::always_inline]] static RawWords even_of(RawWords a, RawWords b) {
        return __builtin_shufflevector(a, b, (2 * I)...);
    }
    [[gnu::always_inline]] static RawWords odd_of(RawWords a, RawWords b) {
        return __builtin_shufflevector(a, b, (2 * I + 1)...);
    }
};
using ShuffleWords = Shuffle<std::make_integer_sequence<int, FOVEA_BYTES / 2>>;
[[gnu::always_inline]] inline RawWords interleave_first(RawWords a, RawWords b) {
    return ShuffleWords::interleave_first(a, b);
}
[[gnu::always_inline]] inline RawWords interleave_second(RawWords a, RawWords b) {
    return ShuffleWords::interleave_second(a, b);
}
[[gnu::always_inline]] inline RawWords even_words(RawWords a, RawWords b) {
    return ShuffleWords::even_of(a, b);
}
[[gnu::always_inline]] inline RawWords odd_words(RawWords a, RawWords b) {
    return ShuffleWords::odd_of(a, b);
}
[[gnu::always_inline]] inline RawWords product(RawWords a, RawWords b) { return a * b; }
[[gnu::always_inline]] inline RawBytes plus_bytes(RawBytes a, RawBytes b) { return a + b; }
[[gnu::always_inline]] inline RawBytes minus_bytes(RawBytes a, RawBytes b) { return a - b; }
[[gnu::always_inline]] inline RawWords hold_to_byte(RawWords a) {
    const RawSigned value = bits_as<RawSigned>(a);
    const RawSigned low = RawSigned{};
    const RawSigned high = bits_as<RawSigned>(all_words(255));
    const RawSigned raised = value > low ? value : low;
    return bits_as<RawWords>(raised < high ? raised : high);
}

#else

using RawBytes = std::uint32_t;
using RawWords = std::uint32_t;

[[gnu::always_inline]] inline RawBytes all_bytes(std::uint8_t k) { return k * 0x01010101u; }
[[gnu::always_inline]] inline RawWords all_words(std::uint16_t k) { return k * 0x00010001u; }
// Sums, products and left shifts of the two halves must stay below 2^16: words says so in its contract.
[[gnu::always_inline]] inline RawWords plus(RawWords a, RawWords b) { return a + b; }
[[gnu::always_inline]] inline RawWords times(RawWords a, std::uint16_t k) { return a * k; }
// The whole word times k: what a half borrows from its neighbour comes back when the sums are positive again.
[[gnu::always_inline]] inline RawWords times_signed(RawWords a, std::int16_t k) {
    return a * static_cast<std::uint32_t>(std::int32_t{k});
}
[[gnu::always_inline]] inline RawWords product(RawWords a, RawWords b) {
    return (a & 0xffffu) * (b & 0xffffu) | ((a >> 16) * (b >> 16)) << 16;
}
[[gnu::always_inline]] inline RawWords shift_left(RawWords a, int n) { return a << n; }
[[gnu::always_inline]] inline RawWords shift_right(RawWords a, int n) {
    return a >> n & (0xffffu >> n) * 0x00010001u;
}

#if defined(__ARM_FEATURE_SIMD32)

// Byte by byte: a >= b ? x : y. USUB8 leaves its comparison in the GE flags, SEL reads them.
[[gnu::always_inline]] inline RawBytes choose(RawBytes a, RawBytes b, RawBytes x, RawBytes y) {
    RawBytes result;
    asm("usub8 %0, %1, %2\n\tsel %0, %3, %4" : "=&r"(result) : "r"(a), "r"(b), "r"(x), "r"(y) : "cc");
    return result;
}
[[gnu::always_inline]] inline RawBytes lower(RawBytes a, RawBytes b) { return choose(a, b, b, a); }
[[gnu::always_inline]] inline RawBytes higher(RawBytes a, RawBytes b) { return choose(a, b, a, b); }
[[gnu::always_inline]] inline RawBytes at_least(RawBytes a, RawBytes b) { return choose(a, b, ~0u, 0u); }
[[gnu::always_inline]] inline RawWords minus(RawWords a, RawWords b) {
    return static_cast<RawWords>(__ssub16(static_cast<int16x2_t>(a), static_cast<int16x2_t>(b)));
}
[[gnu::always_inline]] inline RawWords absolute(RawWords a) {
    const RawWords negated = minus(0, a);
    RawWords result;
    asm("ssub16 %0, %1, %2\n\tsel %0, %1, %2" : "=&r"(result) : "r"(a), "r"(negated) : "cc");
    return result;
}
[[gnu::always_inline]] inline RawWords at_most_255(RawWords a) {
    // a less what it exceeds 255 by. USAT16 would take a half above 32767 for a negative one.
    RawWords excess;
    asm("uqsub16 %0, %1, %2" : "=r"(excess) : "r"(a), "r"(all_words(255)));
    return a - excess;
}
[[gnu::always_inline]] inline RawBytes plus_bytes(RawBytes a, RawBytes b) {
    RawBytes sum;
    asm("uadd8 %0, %1, %2" : "=r"(sum) : "r"(a), "r"(b) : "cc");
    return sum;
}
[[gnu::always_inline]] inline RawBytes minus_bytes(RawBytes a, RawBytes b) {
    RawBytes difference;
    asm("usub8 %0, %1, %2" : "=r"(difference) : "r"(a), "r"(b) : "cc");
    return difference;
}
[[gnu::always_inline]] inline RawWords hold_to_byte(RawWords a) {
    RawWords held;
    asm("usat16 %0, #8, %1" : "=r"(held) : "r"(a) : "cc");
    return held;
}

#else

// 0xff in every byte where a >= b: the borrow of each byte's difference, kept from its neighbours by the top
// bits.
[[gnu::always_inline]] inline RawBytes at_least(RawBytes a, RawBytes b) {
    constexpr RawBytes top = 0x80808080u;
    const RawBytes difference = (a | top) - (b & ~top);
    const RawBytes flags = ((a & ~b) | (~(a ^ b) & difference)) & top;
    return (flags << 1) - (flags >> 7);
}
[[gnu::always_inline]] inline RawBytes lower(RawBytes a, RawBytes b) {
    const RawBytes mask = at_least(a, b);
    return (b & mask) | (a & ~mask);
}
[[gnu::always_inline]] inline RawBytes higher(RawBytes a, RawBytes b) {
    const RawBytes mask = at_least(a, b);
    return (a & mask) | (b & ~mask);
}
[[gnu::always_inline]] inline RawWords minus(RawWords a, RawWords b) {
    constexpr RawWords top = 0x80008000u;
    return ((a | top) - (b & ~top)) ^ ((a ^ ~b) & top);
}
[[gnu::always_inline]] inline RawWords absolute(RawWords a) {
    const RawWords negative = a >> 15 & 0x00010001u;
    const RawWords mask = (negative << 16) - negative;
    return (a ^ mask) + negative;
}
[[gnu::always_inline]] inline RawWords at_most_255(RawWords a) {
    RawWords over = a >> 8 & 0x00ff00ffu;
    over |= over >> 4;
    over |= over >> 2;
    over |= over >> 1;
    over &= 0x00010001u;
    return (a & 0x00ff00ffu) | ((over << 8) - over);
}
[[gnu::always_inline]] inline RawBytes plus_bytes(RawBytes a, RawBytes b) {
    constexpr RawBytes top = 0x80808080u;
    return ((a & ~top) + (b & ~top)) ^ ((a ^ b) & top);
}
[[gnu::always_inline]] inline RawBytes minus_bytes(RawBytes a, RawBytes b) {
    constexpr RawBytes top = 0x80808080u;
    return ((a | top) - (b & ~top)) ^ ((a ^ ~b) & top);
}
[[gnu::always_inline]] inline RawWords hold_to_byte(RawWords a) {
    const RawWords negative = a >> 15 & 0x00010001u;
    return at_most_255(a & ~((negative << 16) - negative));
}

#endif

/// 65535 in each half where a >= b, else 0: as at_least(), with halves.
[[gnu::always_inline]] inline RawWords at_least_words(RawWords a, RawWords b) {
    constexpr RawWords top = 0x80008000u;
    const RawWords difference = (a | top) - (b & ~top);
    const RawWords flags = ((a & ~b) | (~(a ^ b) & difference)) & top;
    return (flags << 1) - (flags >> 15);
}
[[gnu::always_inline]] inline RawWords lower_words(RawWords a, RawWords b) {
    const RawWords mask = at_least_words(a, b);
    return (b & mask) | (a & ~mask);
}
[[gnu::always_inline]] inline RawWords higher_words(RawWords a, RawWords b) {
    const RawWords mask = at_least_words(a, b);
    return (a & mask) | (b & ~mask);
}
[[gnu::always_inline]] inline RawWords times_high(RawWords a, std::uint16_t k) {
    return (a & 0xffffu) * k >> 16 | ((a >> 16) * k & 0xffff0000u);
}
[[gnu::always_inline]] inline RawWords both_times_high(RawWords a, RawWords b) {
    return (a & 0xffffu) * (b & 0xffffu) >> 16 | ((a >> 16) * (b >> 16) & 0xffff0000u);
}
// The half of the lower column lies where memory has it first.
inline constexpr bool big_endian_words = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
#if defined(__ARM_FEATURE_SIMD32) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
[[gnu::always_inline]] inline RawWords interleave_first(RawWords a, RawWords b) {
    RawWords first;
    asm("pkhbt %0, %1, %2, lsl #16" : "=r"(first) : "r"(a), "r"(b));
    return first;
}
[[gnu::always_inline]] inline RawWords interleave_second(RawWords a, RawWords b) {
    RawWords second;
    asm("pkhtb %0, %1, %2, asr #16" : "=r"(second) : "r"(b), "r"(a));
    return second;
}
#else
[[gnu::always_inline]] inline RawWords interleave_first(RawWords a, RawWords b) {
    return big_endian_words ? (a & 0xffff0000u) | b >> 16 : (a & 0xffffu) | b << 16;
}
[[gnu::always_inline]] inline RawWords interleave_second(RawWords a, RawWords b) {
    return big_endian_words ? a << 16 | (b & 0xffffu) : a >> 16 | (b & 0xffff0000u);
}
#endif
[[gnu::always_inline]] inline RawWords even_words(RawWords a, RawWords b) { return interleave_first(a, b); }
[[gnu::always_inline]] inline RawWords odd_words(RawWords a, RawWords b) { return interleave_second(a, b); }

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
