// SPDX-License-Identifier: MIT
//
// Lookup: a table of 256 bytes applied to many pixels at once, where the processor can look up 16 or 64
// entries in a register.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/simd/isa.hpp>
#include <fovea/simd/unroll.hpp>

#if FOVEA_BYTES >= 16 && defined(__SSSE3__)
#include <immintrin.h>
#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON) && defined(__aarch64__)
#include <arm_neon.h>
#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)
#include <arm_mve.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// A table made ready for rows. The bytes of the table must outlive it.
class Lookup {
public:
    explicit Lookup(const std::uint8_t* table);

    /// dst[i] = table[src[i]] for count pixels; dst may be src.
    void row(const std::uint8_t* src, int count, std::uint8_t* dst) const;

private:
    /// One by one. Eight pixels share a load and a store where registers have 64 bits.
    void rest(const std::uint8_t* src, int count, std::uint8_t* dst) const {
        int i = 0;
        if constexpr (sizeof(void*) >= 8)
            for (; i + 8 <= count; i += 8) {
                std::uint64_t pixels;
                std::uint64_t found = 0;
                std::memcpy(&pixels, src + i, 8);
                for (int at = 0; at < 64; at += 8) found |= std::uint64_t{table_[pixels >> at & 255]} << at;
                std::memcpy(dst + i, &found, 8);
            }
        for (; i < count; ++i) dst[i] = table_[src[i]];
    }

    const std::uint8_t* table_;
#if FOVEA_BYTES >= 16 && defined(__SSSE3__)
    alignas(16) std::uint8_t steps_[16][16];
#endif
};

#if FOVEA_BYTES >= 16 && defined(__SSSE3__)

#if FOVEA_BYTES >= 32 && defined(__AVX2__)
struct LookupVector {
    static constexpr int size = 32;
    __m256i raw;
    [[gnu::always_inline]] static LookupVector load(const std::uint8_t* from) {
        return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from))};
    }
    [[gnu::always_inline]] static LookupVector table(const std::uint8_t* from) {
        return {_mm256_broadcastsi128_si256(_mm_load_si128(reinterpret_cast<const __m128i*>(from)))};
    }
    [[gnu::always_inline]] static LookupVector all(char k) { return {_mm256_set1_epi8(k)}; }
    [[gnu::always_inline]] void store(std::uint8_t* to) const {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), raw);
    }
    [[gnu::always_inline]] LookupVector in(LookupVector table) const {
        return {_mm256_shuffle_epi8(table.raw, raw)};
    }
    [[gnu::always_inline]] LookupVector less(LookupVector k) const { return {_mm256_subs_epi8(raw, k.raw)}; }
    [[gnu::always_inline]] LookupVector operator^(LookupVector other) const {
        return {_mm256_xor_si256(raw, other.raw)};
    }
};
#else
struct LookupVector {
    static constexpr int size = 16;
    __m128i raw;
    [[gnu::always_inline]] static LookupVector load(const std::uint8_t* from) {
        return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))};
    }
    [[gnu::always_inline]] static LookupVector table(const std::uint8_t* from) {
        return {_mm_load_si128(reinterpret_cast<const __m128i*>(from))};
    }
    [[gnu::always_inline]] static LookupVector all(char k) { return {_mm_set1_epi8(k)}; }
    [[gnu::always_inline]] void store(std::uint8_t* to) const {
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to), raw);
    }
    [[gnu::always_inline]] LookupVector in(LookupVector table) const {
        return {_mm_shuffle_epi8(table.raw, raw)};
    }
    [[gnu::always_inline]] LookupVector less(LookupVector k) const { return {_mm_subs_epi8(raw, k.raw)}; }
    [[gnu::always_inline]] LookupVector operator^(LookupVector other) const {
        return {_mm_xor_si128(raw, other.raw)};
    }
};
#endif

/// The shuffle answers 0 where bit 7 of the index is set and looks at its lowest 4 bits elsewhere. Of the 128
/// entries of a half, the 16 of every step are kept as the difference (exclusive or) to those before: an
/// index x less 16 k, held at -128, is not negative for the steps up to its own, and their differences add up
/// to the entry.
inline Lookup::Lookup(const std::uint8_t* table) : table_(table) {
    for (int i = 0; i < 256; ++i)
        steps_[i / 16][i % 16] = static_cast<std::uint8_t>(table[i] ^ (i / 16 % 8 == 0 ? 0 : table[i - 16]));
}

inline void Lookup::row(const std::uint8_t* src, int count, std::uint8_t* dst) const {
    using Vector = LookupVector;
    // Four vectors abreast: each of the 16 steps is loaded once for all of them.
    constexpr int step = 4 * Vector::size;
    const Vector sixteen = Vector::all(16);
    const Vector flip = Vector::all(-128);
    int i = 0;
    for (; i + step <= count; i += step) {
        Vector x[4];
        Vector found[4];
        unroll<4>([&](auto k) { found[k] = Vector::all(0); });
        for (int half = 0; half < 16; half += 8) {
            const Vector first = Vector::table(steps_[half]);
            unroll<4>([&](auto k) {
                x[k] = Vector::load(src + i + k * Vector::size);
                if (half > 0) x[k] = x[k] ^ flip;
                found[k] = found[k] ^ x[k].in(first);
            });
            // Written out, GCC would put off the exclusive ors until no register is left.
#pragma GCC unroll 1
            for (int s = half + 1; s < half + 8; ++s) {
                const Vector table = Vector::table(steps_[s]);
                unroll<4>([&](auto k) {
                    x[k] = x[k].less(sixteen);
                    found[k] = found[k] ^ x[k].in(table);
                });
            }
        }
        unroll<4>([&](auto k) { found[k].store(dst + i + k * Vector::size); });
    }
    rest(src + i, count - i, dst + i);
}

#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON) && defined(__aarch64__)

inline Lookup::Lookup(const std::uint8_t* table) : table_(table) {}

inline void Lookup::row(const std::uint8_t* src, int count, std::uint8_t* dst) const {
    // An index outside the 64 entries of a quarter leaves what was found before.
    const uint8x16x4_t quarters[4] = {vld1q_u8_x4(table_), vld1q_u8_x4(table_ + 64),
                                      vld1q_u8_x4(table_ + 128), vld1q_u8_x4(table_ + 192)};
    int i = 0;
    for (; i + 16 <= count; i += 16) {
        const uint8x16_t x = vld1q_u8(src + i);
        uint8x16_t found = vqtbl4q_u8(quarters[0], x);
        found = vqtbx4q_u8(found, quarters[1], vsubq_u8(x, vdupq_n_u8(64)));
        found = vqtbx4q_u8(found, quarters[2], vsubq_u8(x, vdupq_n_u8(128)));
        found = vqtbx4q_u8(found, quarters[3], vsubq_u8(x, vdupq_n_u8(192)));
        vst1q_u8(dst + i, found);
    }
    rest(src + i, count - i, dst + i);
}

#elif FOVEA_BYTES >= 16 && defined(__ARM_FEATURE_MVE)

inline Lookup::Lookup(const std::uint8_t* table) : table_(table) {}

inline void Lookup::row(const std::uint8_t* src, int count, std::uint8_t* dst) const {
    int i = 0;
    for (; i + 16 <= count; i += 16) vstrbq_u8(dst + i, vldrbq_gather_offset_u8(table_, vldrbq_u8(src + i)));
    rest(src + i, count - i, dst + i);
}

#else

inline Lookup::Lookup(const std::uint8_t* table) : table_(table) {}

inline void Lookup::row(const std::uint8_t* src, int count, std::uint8_t* dst) const {
    rest(src, count, dst);
}

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
