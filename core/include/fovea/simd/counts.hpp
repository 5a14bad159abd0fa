// SPDX-License-Identifier: MIT
//
// Sixteen counts side by side that ascend: entry i tells how many values are not above i. What histograms of
// running windows are made of: all sixteen are added, subtracted and searched at once.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/simd/backend.hpp>
#include <fovea/simd/isa.hpp>

#if FOVEA_BYTES >= 16 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES >= 16 && defined(__SSE2__)
#include <emmintrin.h>
#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON) && defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

// ---- Interface --------------------------------------------------------------------

/// Entries of a group of counts.
inline constexpr int count_entries = 16;

/// Adds one, takes one from the entries of 8 bits that are not below value, 0..15. None may leave 0..255.
inline void count_in(std::uint8_t* counts, int value);
inline void count_out(std::uint8_t* counts, int value);

/// Sixteen counts of 16 bits.
class Counts;

// ---- Implementation ---------------------------------------------------------------

/// From entry 15 - value on: ones where i >= value.
alignas(32) inline constexpr std::uint8_t count_steps[32] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1,
                                                             1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0};

#if FOVEA_BYTES >= 16

using CountBytes [[gnu::vector_size(16)]] = std::uint8_t;

[[gnu::always_inline]] inline void count_in(std::uint8_t* counts, int value) {
    auto bytes = load_raw<CountBytes>(counts);
    bytes += load_raw<CountBytes>(count_steps + 15 - value);
    std::memcpy(counts, &bytes, sizeof bytes);
}
[[gnu::always_inline]] inline void count_out(std::uint8_t* counts, int value) {
    auto bytes = load_raw<CountBytes>(counts);
    bytes -= load_raw<CountBytes>(count_steps + 15 - value);
    std::memcpy(counts, &bytes, sizeof bytes);
}

#else

// Four entries a word: no entry overflows, so none carries into its neighbour.
[[gnu::always_inline]] inline void count_in(std::uint8_t* counts, int value) {
    std::uint32_t words[4];
    std::uint32_t steps[4];
    std::memcpy(words, counts, sizeof words);
    std::memcpy(steps, count_steps + 15 - value, sizeof steps);
    for (int i = 0; i < 4; ++i) words[i] += steps[i];
    std::memcpy(counts, words, sizeof words);
}
[[gnu::always_inline]] inline void count_out(std::uint8_t* counts, int value) {
    std::uint32_t words[4];
    std::uint32_t steps[4];
    std::memcpy(words, counts, sizeof words);
    std::memcpy(steps, count_steps + 15 - value, sizeof steps);
    for (int i = 0; i < 4; ++i) words[i] -= steps[i];
    std::memcpy(counts, words, sizeof words);
}

#endif

#if FOVEA_BYTES >= 16 && defined(__AVX2__)

class Counts {
public:
    [[gnu::always_inline]] Counts() : raw_(_mm256_setzero_si256()) {}
    [[gnu::always_inline]] static Counts load(const std::uint16_t* from) {
        Counts counts;
        counts.raw_ = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
        return counts;
    }
    [[gnu::always_inline]] void store(std::uint16_t* to) const {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), raw_);
    }
    /// With sixteen counts of 8 bits, without them.
    [[gnu::always_inline]] void add(const std::uint8_t* counts) {
        raw_ = _mm256_add_epi16(raw_, wide(counts));
    }
    [[gnu::always_inline]] void subtract(const std::uint8_t* counts) {
        raw_ = _mm256_sub_epi16(raw_, wide(counts));
    }
    /// How many entries are at most limit, 0..32767; all entries are at most 32767 too.
    [[gnu::always_inline]] int at_most(int limit) const {
        const __m256i above = _mm256_cmpgt_epi16(raw_, _mm256_set1_epi16(static_cast<short>(limit)));
        const auto mask = static_cast<std::uint32_t>(_mm256_movemask_epi8(above));
        return mask == 0 ? count_entries : __builtin_ctz(mask) / 2;
    }

private:
    [[gnu::always_inline]] static __m256i wide(const std::uint8_t* counts) {
        return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(counts)));
    }
    __m256i raw_;
};

#elif FOVEA_BYTES >= 16 && defined(__SSE2__)

class Counts {
public:
    [[gnu::always_inline]] Counts() : low_(_mm_setzero_si128()), high_(_mm_setzero_si128()) {}
    [[gnu::always_inline]] static Counts load(const std::uint16_t* from) {
        Counts counts;
        counts.low_ = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
        counts.high_ = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from + 8));
        return counts;
    }
    [[gnu::always_inline]] void store(std::uint16_t* to) const {
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to), low_);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to + 8), high_);
    }
    [[gnu::always_inline]] void add(const std::uint8_t* counts) {
        const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(counts));
        low_ = _mm_add_epi16(low_, _mm_unpacklo_epi8(bytes, _mm_setzero_si128()));
        high_ = _mm_add_epi16(high_, _mm_unpackhi_epi8(bytes, _mm_setzero_si128()));
    }
    [[gnu::always_inline]] void subtract(const std::uint8_t* counts) {
        const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(counts));
        low_ = _mm_sub_epi16(low_, _mm_unpacklo_epi8(bytes, _mm_setzero_si128()));
        high_ = _mm_sub_epi16(high_, _mm_unpackhi_epi8(bytes, _mm_setzero_si128()));
    }
    [[gnu::always_inline]] int at_most(int limit) const {
        const __m128i limits = _mm_set1_epi16(static_cast<short>(limit));
        const __m128i above = _mm_packs_epi16(_mm_cmpgt_epi16(low_, limits), _mm_cmpgt_epi16(high_, limits));
        const auto mask = static_cast<std::uint32_t>(_mm_movemask_epi8(above));
        return mask == 0 ? count_entries : __builtin_ctz(mask);
    }

private:
    __m128i low_;
    __m128i high_;
};

#elif FOVEA_BYTES >= 16 && defined(__ARM_NEON) && defined(__aarch64__)

class Counts {
public:
    [[gnu::always_inline]] Counts() : low_(vdupq_n_u16(0)), high_(vdupq_n_u16(0)) {}
    [[gnu::always_inline]] static Counts load(const std::uint16_t* from) {
        Counts counts;
        counts.low_ = vld1q_u16(from);
        counts.high_ = vld1q_u16(from + 8);
        return counts;
    }
    [[gnu::always_inline]] void store(std::uint16_t* to) const {
        vst1q_u16(to, low_);
        vst1q_u16(to + 8, high_);
    }
    [[gnu::always_inline]] void add(const std::uint8_t* counts) {
        const uint8x16_t bytes = vld1q_u8(counts);
        low_ = vaddw_u8(low_, vget_low_u8(bytes));
        high_ = vaddw_high_u8(high_, bytes);
    }
    [[gnu::always_inline]] void subtract(const std::uint8_t* counts) {
        const uint8x16_t bytes = vld1q_u8(counts);
        low_ = vsubw_u8(low_, vget_low_u8(bytes));
        high_ = vsubw_high_u8(high_, bytes);
    }
    [[gnu::always_inline]] int at_most(int limit) const {
        const uint16x8_t limits = vdupq_n_u16(static_cast<std::uint16_t>(limit));
        // Each entry that is not above gives -1.
        const uint16x8_t both = vaddq_u16(vcleq_u16(low_, limits), vcleq_u16(high_, limits));
        return -static_cast<std::int16_t>(vaddvq_u16(both));
    }

private:
    uint16x8_t low_;
    uint16x8_t high_;
};

#else

class Counts {
public:
    Counts() : entries_{} {}
    static Counts load(const std::uint16_t* from) {
        Counts counts;
        std::memcpy(counts.entries_, from, sizeof counts.entries_);
        return counts;
    }
    void store(std::uint16_t* to) const { std::memcpy(to, entries_, sizeof entries_); }
    void add(const std::uint8_t* counts) {
        for (int i = 0; i < count_entries; ++i)
            entries_[i] = static_cast<std::uint16_t>(entries_[i] + counts[i]);
    }
    void subtract(const std::uint8_t* counts) {
        for (int i = 0; i < count_entries; ++i)
            entries_[i] = static_cast<std::uint16_t>(entries_[i] - counts[i]);
    }
    int at_most(int limit) const {
        // Ascending: halves are told apart by one entry.
        int place = 0;
        for (int step = count_entries / 2; step > 0; step /= 2)
            if (entries_[place + step - 1] <= limit) place += step;
        return place + (entries_[place] <= limit ? 1 : 0);
    }

private:
    std::uint16_t entries_[count_entries];
};

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
