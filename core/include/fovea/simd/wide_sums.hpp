// SPDX-License-Identifier: MIT
//
// WideSums: weighted sums of 32 bits over neighbours in a line of 16-bit numbers, and their division.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/number/integer.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/cells.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/taps.hpp>

#if FOVEA_BYTES == 32 && defined(__AVX2__)
#include <immintrin.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// Bytes of a line of 16-bit numbers in order; before its first column and behind its last one there is room
/// for a reach.
inline constexpr int column_bytes = 2;

#if FOVEA_BYTES >= 16

using WideInts = Ints;
using WideUnsigned = Unsigned;
[[gnu::always_inline]] inline WideInts all_wide(std::int32_t k) { return all_ints(k); }
/// The high 32 bits of each product.
[[gnu::always_inline]] inline WideUnsigned wide_times_high(WideUnsigned a, std::uint32_t k) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    const __m256i by = _mm256_set1_epi32(static_cast<int>(k));
    const __m256i even = _mm256_srli_epi64(_mm256_mul_epu32(bits_as<__m256i>(a), by), 32);
    const __m256i odd = _mm256_mul_epu32(_mm256_srli_epi64(bits_as<__m256i>(a), 32), by);
    return bits_as<WideUnsigned>(_mm256_blend_epi32(even, odd, 0xaa));
#else
    using Pairs [[gnu::vector_size(FOVEA_BYTES)]] = std::uint64_t;
    const Pairs pairs = bits_as<Pairs>(a);
    const Pairs low = (pairs & 0xffffffffu) * k >> 32;
    const Pairs high = (pairs >> 32) * k & ~std::uint64_t{0xffffffffu};
    return bits_as<WideUnsigned>(low | high);
#endif
}
/// All bits where a >= b, both below 2^31.
[[gnu::always_inline]] inline WideUnsigned wide_at_least(WideUnsigned a, WideUnsigned b) {
    return bits_as<WideUnsigned>(bits_as<Ints>(a) >= bits_as<Ints>(b));
}
[[gnu::always_inline]] inline WideInts held_between(WideInts a, WideInts low, WideInts high) {
    a = a > low ? a : low;
    return a < high ? a : high;
}

/// Sums for half_lanes columns: those of even columns, then those of odd ones. None may overflow.
class WideSums {
public:
    static constexpr int count = 2;
    [[gnu::always_inline]] WideSums() : sums_{all_ints(0), all_ints(0)} {}
    /// To every column the number there times weights.first and that behind it times weights.second. from
    /// holds numbers of 16 bits, below 2^15.
    [[gnu::always_inline]] void add(const std::uint8_t* from, Pair weights) {
        const Ints by = all_ints(bits_as<std::int32_t>(weights));
        sums_[0] += pair_sums(load_raw<Ints>(from), by);
        sums_[1] += pair_sums(load_raw<Ints>(from + column_bytes), by);
    }
    WideInts operator[](int number) const { return sums_[number]; }
    /// The lower halves of both, in order.
    [[gnu::always_inline]] static RawWords joined(const WideInts (&sums)[count]) {
        const auto even = bits_as<Unsigned>(sums[0]);
        const auto odd = bits_as<Unsigned>(sums[1]);
        constexpr bool big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
        return bits_as<RawWords>(big_endian ? (even << 16 | (odd & 0xffff)) : (odd << 16 | (even & 0xffff)));
    }

private:
    Ints sums_[count];
};

#else

using WideInts = std::int32_t;
using WideUnsigned = std::uint32_t;
[[gnu::always_inline]] inline WideInts all_wide(std::int32_t k) { return k; }
[[gnu::always_inline]] inline WideUnsigned wide_times_high(WideUnsigned a, std::uint32_t k) {
    return static_cast<std::uint32_t>(std::uint64_t{a} * k >> 32);
}
[[gnu::always_inline]] inline WideUnsigned wide_at_least(WideUnsigned a, WideUnsigned b) {
    return a >= b ? ~0u : 0u;
}
[[gnu::always_inline]] inline WideInts held_between(WideInts a, WideInts low, WideInts high) {
    return clamp(a, low, high);
}

class WideSums {
public:
    static constexpr int count = half_lanes;
    void add(const std::uint8_t* from, Pair weights) {
        std::uint16_t numbers[count + 1];
        std::memcpy(numbers, from, sizeof numbers);
        for (int i = 0; i < count; ++i)
            sums_[i] += numbers[i] * weights.first + numbers[i + 1] * weights.second;
    }
    WideInts operator[](int number) const { return sums_[number]; }
    static RawWords joined(const WideInts (&sums)[count]) {
        std::uint16_t numbers[count];
        for (int i = 0; i < count; ++i) numbers[i] = static_cast<std::uint16_t>(sums[i]);
        return load_raw<RawWords>(numbers);
    }

private:
    std::int32_t sums_[count] = {};
};

#endif

/// Division of sums whose magnitude is at most most by divisor, to the nearest, ties up; offset added, and
/// held between two numbers of 16 bits.
class WideDivision {
public:
    /// 2 * (most + divisor) stays below 2^32, divisor below 2^16.
    WideDivision(std::uint32_t most, std::uint32_t divisor, int offset)
        : divisor_(divisor), reciprocal_(0xffffffffu / divisor) {
        // A multiple of the divisor makes all sums positive.
        const std::uint32_t lifts = (most + divisor - 1) / divisor;
        lift_ = lifts * divisor + divisor / 2;
        back_ = static_cast<std::uint32_t>(offset) - lifts;
        while ((1u << (shift_ + 1)) <= divisor) ++shift_;
        if (1u << shift_ == divisor) return;
        shift_ = no_shift;
        // Rounded up, the reciprocal is (2^32 + more) / divisor. It adds sum * more / (divisor * 2^32) to a
        // quotient, and lifts none to the next whole number as long as that is below 1 / divisor.
        const std::uint64_t more = std::uint64_t{reciprocal_ + 1} * divisor - (std::uint64_t{1} << 32);
        is_exact_ = (std::uint64_t{lift_} + most) * more < std::uint64_t{1} << 32;
        if (is_exact_) ++reciprocal_;
    }
    /// The quotients of the columns in order.
    [[gnu::always_inline]] RawWords of(const WideSums& sums, int low, int high) const {
        WideInts quotients[WideSums::count];
        for (int i = 0; i < WideSums::count; ++i)
            quotients[i] =
                held_between(bits_as<WideInts>(quotient(bits_as<WideUnsigned>(sums[i]) + lift_) + back_),
                             all_wide(low), all_wide(high));
        return WideSums::joined(quotients);
    }

private:
    static constexpr int no_shift = -1;

    [[gnu::always_inline]] WideUnsigned quotient(WideUnsigned lifted) const {
        if (shift_ != no_shift) return lifted >> shift_;
        if (is_exact_) return wide_times_high(lifted, reciprocal_);
        // The reciprocal rounded down gives a quotient that is right or one too small.
        const WideUnsigned rounded_down = wide_times_high(lifted, reciprocal_);
        const WideUnsigned rest = lifted - rounded_down * divisor_;
        const WideUnsigned whole = bits_as<WideUnsigned>(all_wide(static_cast<std::int32_t>(divisor_)));
        return rounded_down - wide_at_least(rest, whole);
    }

    std::uint32_t divisor_;
    std::uint32_t reciprocal_;
    std::uint32_t lift_;
    std::uint32_t back_;
    int shift_ = 0;
    bool is_exact_ = false;
};

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
