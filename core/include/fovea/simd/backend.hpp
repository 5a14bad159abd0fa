// SPDX-License-Identifier: MIT
//
// The two raw vectors behind Bytes and Words, and the few operations that differ by back end: compiler
// vectors of 8 to 64 bytes, or 32-bit words with the DSP instructions of Cortex-M where they exist. Nothing
// else may know them.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/simd/isa.hpp>

#if FOVEA_BYTES == 4 && defined(__ARM_FEATURE_SIMD32)
#include <arm_acle.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// Pixels in one vector.
inline constexpr int lanes = FOVEA_BYTES;

/// The same bits as another type of the same size.
template <class To, class From>
[[gnu::always_inline]] inline To bits_as(From from) {
    static_assert(sizeof(To) == sizeof(From), "bits_as keeps the size");
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

#if FOVEA_BYTES >= 8

using RawBytes [[gnu::vector_size(FOVEA_BYTES)]] = std::uint8_t;
using RawWords [[gnu::vector_size(FOVEA_BYTES)]] = std::uint16_t;
using RawSigned [[gnu::vector_size(FOVEA_BYTES)]] = std::int16_t;

[[gnu::always_inline]] inline RawBytes all_bytes(std::uint8_t k) { return RawBytes{} + k; }
[[gnu::always_inline]] inline RawWords all_words(std::uint16_t k) { return RawWords{} + k; }
[[gnu::always_inline]] inline RawBytes lower(RawBytes a, RawBytes b) { return a < b ? a : b; }
[[gnu::always_inline]] inline RawBytes higher(RawBytes a, RawBytes b) { return a > b ? a : b; }
[[gnu::always_inline]] inline RawBytes at_least(RawBytes a, RawBytes b) { return bits_as<RawBytes>(a >= b); }
[[gnu::always_inline]] inline RawWords plus(RawWords a, RawWords b) { return a + b; }
[[gnu::always_inline]] inline RawWords minus(RawWords a, RawWords b) { return a - b; }
[[gnu::always_inline]] inline RawWords times(RawWords a, std::uint16_t k) { return a * all_words(k); }
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
[[gnu::always_inline]] inline RawBytes plus_bytes(RawBytes a, RawBytes b) { return a + b; }
[[gnu::always_inline]] inline RawBytes minus_bytes(RawBytes a, RawBytes b) { return a - b; }

#else

using RawBytes = std::uint32_t;
using RawWords = std::uint32_t;

[[gnu::always_inline]] inline RawBytes all_bytes(std::uint8_t k) { return k * 0x01010101u; }
[[gnu::always_inline]] inline RawWords all_words(std::uint16_t k) { return k * 0x00010001u; }
// Sums, products and left shifts of the two halves must stay below 2^16: words says so in its contract.
[[gnu::always_inline]] inline RawWords plus(RawWords a, RawWords b) { return a + b; }
[[gnu::always_inline]] inline RawWords times(RawWords a, std::uint16_t k) { return a * k; }
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
[[gnu::always_inline]] inline RawBytes plus_bytes(RawBytes a, RawBytes b) { return __uadd8(a, b); }
[[gnu::always_inline]] inline RawBytes minus_bytes(RawBytes a, RawBytes b) { return __usub8(a, b); }

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

#endif
#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
