// SPDX-License-Identifier: MIT
//
// Means of neighbours weighed by how far they are and by how much they differ: the arithmetic of bilateral(),
// where vectors compute every weight. bilateral_tables.hpp has the means of all others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/cells.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

#if FOVEA_BYTES == 32 && defined(__AVX2__)
#include <immintrin.h>
#elif FOVEA_BYTES == 16 && defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace fovea {

/// The largest radius of bilateral().
inline constexpr int max_bilateral_radius = 7;

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

/// The rows of a window, each in a line of its own; a row keeps its line while the window goes down.
struct BilateralLines {
    std::uint8_t* first = nullptr;  ///< column 0 of the first line
    std::ptrdiff_t bytes = 0;       ///< from a line to the next
    int rows = 0;
    int top = 0;  ///< which line has the topmost row

    /// Of row i of the window.
    [[gnu::always_inline]] std::uint8_t* at(int i) const {
        return first + (top + i < rows ? top + i : top + i - rows) * bytes;
    }
};

/// The neighbours on a disc and their weights.
///   Pixel                what lines hold, radius more of them than a row has on either side
///   line_scratch(width)  bytes of a line, first_bytes of them before column 0
///   scratch(radius)      bytes besides
///   put(row, width, line)
///   means(lines, width, dst)
class BilateralDisc;

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

constexpr int square_of(int side) { return side * side; }

#if FOVEA_BYTES >= 16 && !defined(__ARM_FEATURE_MVE)

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

/// Sums for half_lanes columns.
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

class BilateralDisc {
public:
    using Pixel = std::uint16_t;
    static constexpr int first_bytes = int{sizeof(Pixel)} * max_reach;
    static constexpr int line_scratch(int width) { return word_line_scratch(width); }
    static constexpr std::int64_t scratch(int) { return 0; }

    BilateralDisc() = default;
    /// exponent_of(square of a distance), at most last_exponent.
    template <class Exponent>
    BilateralDisc(int radius, const BilateralScale& scale, Exponent exponent_of, Span<std::uint8_t>)
        : radius_(radius), scale_(scale) {
        for (int y = 0; y <= radius; ++y)
            while (square_of(y) + square_of(sides_[y] + 1) <= square_of(radius)) ++sides_[y];
        for (int square = 0; square <= square_of(radius); ++square)
            distances_[square] = exponent_of(square) * 0x10001u;
    }

    static void put(const std::uint8_t* row, int width, std::uint8_t* line) {
        for_each_vector(width, [&](int x, int count) {
            Pixel pixels[lanes];
            Words(count == lanes ? Bytes::load(row + x) : Bytes::load(row + x, count)).store(pixels);
            std::memcpy(line + pixel_bytes * x, pixels, sizeof pixels);
        });
    }
    void means(const BilateralLines& lines, int width, std::uint8_t* dst) const {
        // Copies, so that no store makes the compiler load them again.
        const BilateralDisc disc = *this;
        const BilateralLines rows = lines;
        for_each_vector(width, [&](int x, int count) {
            const Bytes means = disc.means(rows, x);
            if (count == lanes)
                means.store(dst + x);
            else
                means.store(dst + x, count);
        });
    }

private:
    static constexpr int pixel_bytes = sizeof(Pixel);

    [[gnu::always_inline]] Bytes means(const BilateralLines& lines, int x) const {
        const std::uint8_t* middle = lines.at(radius_) + pixel_bytes * x;
        BilateralSums first(middle);
        BilateralSums second(middle + pixel_bytes * half_lanes);
        for (int y = -radius_; y <= radius_; ++y) {
            const int side = sides_[y < 0 ? -y : y];
            const std::uint8_t* from = lines.at(radius_ + y) + pixel_bytes * x;
            for (int i = -side; i <= side; ++i) {
                const int square = y * y + i * i;
                if (square == 0) continue;
                const std::uint8_t* at = from + pixel_bytes * i;
                first.add(at, scale_, distances_[square]);
                second.add(at + pixel_bytes * half_lanes, scale_, distances_[square]);
            }
        }
        return narrowed(first.means(), second.means());
    }

    int radius_ = 1;
    BilateralScale scale_;
    /// Half of the disc's width by the distance of a row.
    std::uint8_t sides_[max_bilateral_radius + 1] = {};
    std::uint32_t distances_[max_bilateral_radius * max_bilateral_radius + 1] = {};
};

#endif

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea
