// SPDX-License-Identifier: MIT
//
// Means of neighbours weighed by how far they are and by how much they differ, where a processor looks
// weights up faster than it computes them: without vectors, and with the gathers of Helium.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/bilateral_sums.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/unroll.hpp>

#if FOVEA_BYTES < 16 || defined(__ARM_FEATURE_MVE)

#if FOVEA_BYTES >= 16
#include <arm_mve.h>
#endif

namespace fovea {
inline namespace FOVEA_ISA {
namespace simd {

/// As BilateralSums has it.
constexpr std::uint32_t bilateral_weight(int difference, const BilateralScale& scale,
                                         std::uint32_t distance) {
    const auto square =
        minimum(static_cast<std::uint32_t>(square_of(difference)), std::uint32_t{scale.most}) * scale.raise;
    const std::uint32_t exponent =
        minimum<std::uint32_t>((square * (scale.factor & 0xffffu) >> 16) + distance, last_exponent);
    const std::uint32_t part = exponent << 5 & 0xffffu;
    std::uint32_t power = power_a - (part * power_b >> 16);
    power = own_weight - (part * power >> 16);
    return power >> (exponent >> 11);
}

#if FOVEA_BYTES >= 16

/// Sums for eight columns, even and odd ones apart.
class BilateralTableSums {
public:
    /// Two neighbours of every pixel. Their weights together fit 16 bits.
    [[gnu::always_inline]] void add(const std::uint16_t* table, uint16x8_t pixels, uint16x8_t a,
                                    uint16x8_t b) {
        const uint16x8_t both = vaddq_u16(add_moments(table, pixels, a), add_moments(table, pixels, b));
        weights_[0] = vaddq_u32(weights_[0], vmovlbq_u16(both));
        weights_[1] = vaddq_u32(weights_[1], vmovltq_u16(both));
    }
    /// From every pixel to its mean.
    [[gnu::always_inline]] uint16x8_t steps() const {
        const int32x4_t even = quotients(moments_[0], vreinterpretq_s32_u32(weights_[0]));
        const int32x4_t odd = quotients(moments_[1], vreinterpretq_s32_u32(weights_[1]));
        return vreinterpretq_u16_s16(vmovntq_s32(vreinterpretq_s16_s32(even), odd));
    }

private:
    [[gnu::always_inline]] uint16x8_t add_moments(const std::uint16_t* table, uint16x8_t pixels,
                                                  uint16x8_t others) {
        const uint16x8_t found = vldrhq_gather_shifted_offset_u16(table, vabdq_u16(others, pixels));
        const int16x8_t weights = vreinterpretq_s16_u16(found);
        const int16x8_t steps = vreinterpretq_s16_u16(vsubq_u16(others, pixels));
        moments_[0] = vaddq_s32(moments_[0], vmullbq_int_s16(weights, steps));
        moments_[1] = vaddq_s32(moments_[1], vmulltq_int_s16(weights, steps));
        return found;
    }
    /// To the nearest: half of the weight goes away from 0, as division rounds towards it.
    [[gnu::always_inline]] static int32x4_t quotients(int32x4_t moments, int32x4_t weights) {
        const int32x4_t sign = vshrq_n_s32(moments, 31);
        const int32x4_t half = vsubq_s32(veorq_s32(vshrq_n_s32(weights, 1), sign), sign);
        // One by one, as there is no such instruction for vectors.
        std::int32_t dividends[4];
        std::int32_t divisors[4];
        vst1q_s32(dividends, vaddq_s32(moments, half));
        vst1q_s32(divisors, weights);
        std::int32_t found[4];
        unroll<4>([&](auto i) { found[i] = dividends[i] / divisors[i]; });
        return vld1q_s32(found);
    }

    uint32x4_t weights_[2] = {vdupq_n_u32(own_weight), vdupq_n_u32(own_weight)};
    int32x4_t moments_[2] = {vdupq_n_s32(0), vdupq_n_s32(0)};
};

#endif

/// By tables of weights by difference, one for each distance on the disc.
class BilateralDisc {
public:
    using Pixel = std::uint8_t;
    static constexpr int first_bytes = max_bilateral_radius;
    static constexpr int line_scratch(int width) {
        return width + 2 * max_bilateral_radius + (pixels_at_once - 1);
    }
    static constexpr std::int64_t scratch(int radius) {
        int quads = 0;
        int tables = 0;
        std::uint64_t squares = 0;
        for_each_quad(radius, [&](int x, int y) {
            const std::uint64_t bit = std::uint64_t{1} << (square_of(x) + square_of(y));
            tables += (squares & bit) == 0 ? 1 : 0;
            squares |= bit;
            ++quads;
        });
        return arena_bytes<Quad>(quads) + arena_bytes<std::uint16_t>(std::int64_t{tables} * table_size);
    }

    BilateralDisc() = default;
    /// exponent_of(square of a distance), at most last_exponent.
    template <class Exponent>
    BilateralDisc(int radius, const BilateralScale& scale, Exponent exponent_of, Span<std::uint8_t> scratch)
        : radius_(radius) {
        for_each_quad(radius, [&](int, int) { ++count_; });
        Arena arena(scratch);
        quads_ = arena.take_unset<Quad>(count_).data();
        const std::uint16_t* weights[square_of(max_bilateral_radius) + 1] = {};
        Quad* quad = quads_;
        for_each_quad(radius, [&](int x, int y) {
            const int square = square_of(x) + square_of(y);
            if (weights[square] == nullptr)
                weights[square] =
                    made(scale, exponent_of(square), arena.take_unset<std::uint16_t>(table_size));
            (quad++)->weights = weights[square];
        });
    }

    static void put(const std::uint8_t* row, int width, std::uint8_t* line) {
        std::memcpy(line, row, static_cast<std::size_t>(width));
    }
    void means(const BilateralLines& lines, int width, std::uint8_t* dst) const {
        place(lines);
        if (count_ == 1)
            means_of<true>(lines, width, dst);
        else
            means_of<false>(lines, width, dst);
    }

private:
    /// Four neighbours at the same distance: one, and those that quarter turns make of it.
    struct Quad {
        const std::uint16_t* weights;  ///< of difference 0
        std::int32_t at[4];            ///< bytes from the first line
    };
    static constexpr int largest = 255;
#if FOVEA_BYTES >= 16
    /// By the magnitude of the difference.
    static constexpr int table_size = largest + 1;
    static constexpr int pixels_at_once = 8;
#else
    /// By the difference: to look one up takes no magnitude.
    static constexpr int table_size = 2 * largest + 1;
    static constexpr int pixels_at_once = 1;
#endif

    template <class Visit>
    static constexpr void for_each_quad(int radius, Visit visit) {
        for (int x = 1; x <= radius; ++x)
            for (int y = 0; square_of(x) + square_of(y) <= square_of(radius); ++y) visit(x, y);
    }
    static const std::uint16_t* made(const BilateralScale& scale, std::uint32_t distance,
                                     Span<std::uint16_t> table) {
        std::uint16_t* none = table.data() + (table_size - 1 - largest);
        for (int difference = 0; difference <= largest; ++difference) {
            const auto weight = static_cast<std::uint16_t>(bilateral_weight(difference, scale, distance));
            none[difference] = weight;
            if constexpr (table_size > largest + 1) none[-difference] = weight;
        }
        return none;
    }
    /// Finds the neighbours where the lines are in turn.
    void place(const BilateralLines& lines) const {
        Quad* quad = quads_;
        for_each_quad(radius_, [&](int x, int y) {
            const auto at = [&](int column, int row) {
                return static_cast<std::int32_t>(lines.at(radius_ + row) - lines.first + column);
            };
            quad->at[0] = at(x, y);
            quad->at[1] = at(-y, x);
            quad->at[2] = at(-x, -y);
            quad->at[3] = at(y, -x);
            ++quad;
        });
    }

#if FOVEA_BYTES >= 16
    template <bool One>
    [[gnu::noinline]] void means_of(const BilateralLines& lines, int width, std::uint8_t* dst) const {
        const std::uint8_t* const first = lines.first;
        const std::uint8_t* const centre = lines.at(radius_);
        const Quad only = *quads_;
        const Quad* const begin = One ? &only : quads_;
        const Quad* const end = begin + (One ? 1 : count_);
        for (int x = 0; x < width; x += pixels_at_once) {
            const uint16x8_t pixels = vldrbq_u16(centre + x);
            BilateralTableSums sums;
            for (const Quad* quad = begin; quad != end; ++quad) {
                const auto at = [&](int i) { return vldrbq_u16(first + x + quad->at[i]); };
                sums.add(quad->weights, pixels, at(0), at(1));
                // Not all loads first: eight registers do not hold them and the sums.
                asm volatile("" ::: "memory");
                sums.add(quad->weights, pixels, at(2), at(3));
            }
            vstrbq_p_u16(dst + x, vaddq_u16(pixels, sums.steps()),
                         vctp16q(static_cast<std::uint32_t>(width - x)));
        }
    }
#else
    template <bool One>
    [[gnu::noinline]] void means_of(const BilateralLines& lines, int width, std::uint8_t* dst) const {
        const std::uint8_t* const first = lines.first;
        const std::uint8_t* const centre = lines.at(radius_);
        // The only one in registers.
        const Quad only = *quads_;
        const Quad* const begin = One ? &only : quads_;
        const Quad* const end = begin + (One ? 1 : count_);
        for (int x = 0; x < width; ++x) {
            const int pixel = centre[x];
            std::uint32_t weight = 0;
            std::uint32_t moment = 0;  // of the pixels, at most 148 * 32767 * 255
            for (const Quad* quad = begin; quad != end; ++quad) {
                const std::uint16_t* weights = quad->weights - pixel;
                unroll<4>([&](auto i) {
                    const int other = first[x + quad->at[i]];
                    weight += weights[other];
                    moment += weights[other] * static_cast<std::uint32_t>(other);
                });
            }
            const auto steps = static_cast<std::int32_t>(moment - weight * static_cast<std::uint32_t>(pixel));
            weight += own_weight;
            // To the nearest, as division rounds towards 0.
            const auto half = static_cast<std::int32_t>(weight >> 1);
            const std::int32_t by = (steps + (steps < 0 ? -half : half)) / static_cast<std::int32_t>(weight);
            dst[x] = static_cast<std::uint8_t>(pixel + by);
        }
    }
#endif

    int radius_ = 1;
    int count_ = 0;
    Quad* quads_ = nullptr;
};

}  // namespace simd
}  // namespace FOVEA_ISA
}  // namespace fovea

#endif
