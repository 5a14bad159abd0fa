// SPDX-License-Identifier: MIT
//
// Means of neighbours weighed by how far they are and by how much they differ: the arithmetic of bilateral().
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/number/integer.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/cells.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

#if FOVEA_BYTES == 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

// ---- Interface --------------------------------------------------------------------

/// Weights 2^-e with e = difference^2 * scale + distance, as shares of 32767. Exponents have 11 bits behind
/// the point; of 15 and more nothing is left of a weight.
struct BilateralScale {
    std::uint32_t factor = 0;  ///< of squares that were raised, by 2^16; in both halves
    std::uint16_t most = 0;    ///< squares above this are taken for it
    std::uint16_t raise = 1;   ///< a power of two

    /// Of an exponent of scale / 2^27 for a difference of 1.
    static constexpr BilateralScale of(std::uint32_t scale);
};

/// Sums for half_lanes columns.
class BilateralSums;

// ---- Implementation ---------------------------------------------------------------

constexpr BilateralScale BilateralScale::of(std::uint32_t scale) {
    // The factor of a raised square is above 2^15 where one is raised: its largest exponent is past the end.
    BilateralScale result;
    int bits = 0;
    while (scale >> bits > 65535) ++bits;
    result.factor = (scale >> bits) * 0x10001u;
    result.most = static_cast<std::uint16_t>(65535 >> bits);
    result.raise = static_cast<std::uint16_t>(1 << bits);
    return result;
}

/// The largest exponent.
inline constexpr std::uint16_t last_exponent = 65535;
/// 2^-f * 32767 is 32767 less f times (a less f times b) for f from 0 to 1, to 0.2 %; exact at both ends.
inline constexpr std::uint16_t power_a = 21950;
inline constexpr std::uint16_t power_b = 5566;
/// The weight of the pixel itself.
inline constexpr std::int32_t own_weight = 32767;
/// Bytes of a pixel in the lines, which are of 16 bits.
inline constexpr int bilateral_bytes = 2;

#if FOVEA_BYTES >= 16

[[gnu::always_inline]] inline RawWords words_at(const std::uint8_t* from) { return load_raw<RawWords>(from); }
/// The sum, at most 65535.
[[gnu::always_inline]] inline RawWords held_sum(RawWords a, RawWords b) {
#if FOVEA_BYTES == 32 && defined(__AVX2__)
    return bits_as<RawWords>(_mm256_adds_epu16(bits_as<__m256i>(a), bits_as<__m256i>(b)));
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
    return bits_as<RawWords>(_mm_adds_epu16(bits_as<__m128i>(a), bits_as<__m128i>(b)));
#else
    return lower_words(a, ~b) + b;
#endif
}

class BilateralSums {
public:
    [[gnu::always_inline]] explicit BilateralSums(const std::uint8_t* centre)
        : centre_(words_at(centre)),
          weights_{Unsigned{} + own_weight, Unsigned{} + own_weight},
          moments_{all_ints(0), all_ints(0)} {}

    /// The pixels from from on. The exponent of their distance stands in both halves of distance: such a
    /// number is spread over a vector by its load.
    [[gnu::always_inline]] void add(const std::uint8_t* from, const BilateralScale& scale,
                                    std::uint32_t distance) {
        const RawWords from_space = bits_as<RawWords>(Unsigned{} + distance);
        const RawWords step = words_at(from) - centre_;
        // By a product, because a shift by a number that is no constant takes two steps.
        const RawWords square = lower_words(step * step, all_words(scale.most)) * all_words(scale.raise);
        const RawWords factor = bits_as<RawWords>(Unsigned{} + scale.factor);
        const RawWords exponent = held_sum(both_times_high(square, factor), from_space);
        const RawWords part = exponent << 5;
        RawWords power = all_words(power_a) - times_high(part, power_b);
        power = all_words(own_weight) - both_times_high(part, power);
        const auto powers = bits_as<Unsigned>(power);
        const auto exponents = bits_as<Unsigned>(exponent);
        const auto steps = bits_as<Unsigned>(step);
        const Unsigned low = (powers & 0xffff) >> ((exponents & 0xffff) >> 11);
        const Unsigned high = (powers >> 16) >> (exponents >> 27);
        weights_[0] += low;
        weights_[1] += high;
        moments_[0] += pair_sums(bits_as<Ints>(low), bits_as<Ints>(steps));
        moments_[1] += pair_sums(bits_as<Ints>(high), bits_as<Ints>(steps >> 16));
    }
    /// The mean of every column.
    [[gnu::always_inline]] RawWords means() const {
        const Unsigned low = quotient(moments_[0], weights_[0]);
        const Unsigned high = quotient(moments_[1], weights_[1]);
        return centre_ + bits_as<RawWords>((low & 0xffff) | (high << 16));
    }

private:
    /// To the nearest, bit by bit; its magnitude is at most 255.
    [[gnu::always_inline]] static Unsigned quotient(Ints moment, Unsigned weight) {
        const Ints sign = moment >> 31;
        // Long division: the quotient comes in below the rest, which stays below 2^31. Where the difference
        // is negative it has wrapped, so that the lower one is right.
        Unsigned rest = bits_as<Unsigned>((moment ^ sign) - sign) + (weight >> 1);
        const Unsigned divisor = (weight << 8) - 1;
        for (int bit = 0; bit < 8; ++bit) {
            rest += rest;
            const Unsigned less = rest - divisor;
            rest = less < rest ? less : rest;
        }
        const Unsigned found = rest & 255;
        return (found ^ bits_as<Unsigned>(sign)) - bits_as<Unsigned>(sign);
    }

    RawWords centre_;
    Unsigned weights_[2];
    Ints moments_[2];
};

#else

class BilateralSums {
public:
    explicit BilateralSums(const std::uint8_t* centre) : centre_(centre) {
        for (std::uint32_t& weight : weights_) weight = own_weight;
    }
    void add(const std::uint8_t* from, const BilateralScale& scale, std::uint32_t distance) {
        for (int i = 0; i < half_lanes; ++i) {
            const std::int32_t step = pixel(from, i) - pixel(centre_, i);
            const auto weight = weight_of(static_cast<std::uint32_t>(step * step), scale, distance & 0xffffu);
            weights_[i] += weight;
            moments_[i] += step * static_cast<std::int32_t>(weight);
        }
    }
    RawWords means() const {
        std::uint16_t means[half_lanes];
        for (int i = 0; i < half_lanes; ++i) {
            const std::uint32_t found = (magnitude(moments_[i]) + weights_[i] / 2) / weights_[i];
            const auto by = static_cast<int>(found);
            const int centre = pixel(centre_, i);
            means[i] = static_cast<std::uint16_t>(moments_[i] < 0 ? centre - by : centre + by);
        }
        return load_raw<RawWords>(means);
    }

private:
    static int pixel(const std::uint8_t* from, int number) {
        std::uint16_t value;
        std::memcpy(&value, from + bilateral_bytes * number, sizeof value);
        return value;
    }
    static std::uint32_t weight_of(std::uint32_t square, const BilateralScale& scale,
                                   std::uint32_t distance) {
        square = minimum<std::uint32_t>(square, scale.most) * scale.raise;
        const std::uint32_t exponent =
            minimum<std::uint32_t>((square * (scale.factor & 0xffffu) >> 16) + distance, last_exponent);
        const std::uint32_t part = exponent << 5 & 0xffffu;
        std::uint32_t power = power_a - (part * power_b >> 16);
        power = own_weight - (part * power >> 16);
        return power >> (exponent >> 11);
    }

    const std::uint8_t* centre_;
    std::uint32_t weights_[half_lanes];
    std::int32_t moments_[half_lanes] = {};
};

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
