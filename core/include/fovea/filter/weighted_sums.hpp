// SPDX-License-Identifier: MIT
//
// Sums of neighbours with weights of either sign, divided and rounded: the arithmetic of convolve().
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>
#include <fovea/simd/taps.hpp>
#include <fovea/simd/unroll.hpp>
#include <fovea/simd/wide_sums.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace kernels {

/// Weighted sums of 8-bit pixels, divided by 1..65535, to the nearest, ties up; an offset of -255..255 added,
/// and held at the ends of Pixel, Gray8 or Gradient16. Up to 225 weights, which outlive this.
template <class Pixel>
class WeightedSums {
    static_assert(std::is_same_v<Pixel, Gray8> || std::is_same_v<Pixel, Gradient16>,
                  "weighted sums are made as Gray8 or Gradient16");

public:
    WeightedSums() = default;
    WeightedSums(Span<const std::int16_t> weights, int divisor, int offset)
        : weights_(weights), divisor_(divisor), offset_(offset) {
        FOVEA_ASSERT(weights.size() <= most_weights);
        std::int64_t most = 0;
        std::int64_t least = 0;
        for (const std::int16_t weight : weights) (weight > 0 ? most : least) += 255 * weight;
        most_sum_ = static_cast<std::uint32_t>(maximum(most, -least));
        // A multiple of the divisor that lifts every sum above zero, and half of the divisor for rounding.
        const std::int64_t lift = (-least + divisor - 1) / divisor * divisor;
        const std::int64_t half = divisor / 2;
        const bool fits_pixel = std::is_same_v<Pixel, Gray8> || ((most + half) / divisor + offset <= 32767 &&
                                                                 -lift / divisor + offset >= -32768);
        narrow_ = lift + half + most <= 65535 && fits_pixel;
        if (narrow_) {
            start_ = static_cast<std::uint16_t>(lift + half);
            // No quotient is above 65535.
            lifted_ = minimum(static_cast<int>(lift / divisor) - offset, 65535);
        }
        while (1 << (shift_ + 1) <= divisor) ++shift_;
        if (1 << shift_ != divisor) shift_ = no_shift;
    }

    /// True where 16 bits hold every sum: narrow_row() does for these weights, wide_row() else.
    bool narrow() const { return narrow_; }

    /// A row of width pixels from as many lines as the size has rows: line(i) is one of them.
    template <class Line>
    void narrow_row(Line line, Size size, int width, Pixel* dst) const {
        // Copies, so that no store makes the compiler load them again.
        std::int16_t weights[most_weights];
        copy_weights(weights);
        const WeightedSums sums = *this;
        if (size == Size{3, 3})
            sums.divide_row(width, dst, [&](int x) { return sums.sum_of<3, 3>(line, weights, 3, x); });
        else if (size.width == 3)
            sums.divide_row(width, dst, [&](int x) { return sums.sum_of<3>(line, weights, size.height, x); });
        else if (size.width == 5)
            sums.divide_row(width, dst, [&](int x) { return sums.sum_of<5>(line, weights, size.height, x); });
        else if (size.width == 7)
            sums.divide_row(width, dst, [&](int x) { return sums.sum_of<7>(line, weights, size.height, x); });
        else
            sums.divide_row(width, dst, [&](int x) { return sums.sum_of(line, weights, size, x); });
    }
    /// The same from lines of 16-bit numbers in order: line(i) is the first column of one of them.
    template <class Line>
    void wide_row(Line line, Size size, int width, Pixel* dst) const {
        // The last weight of a row has a partner of zero.
        simd::Pair pairs[(max_side + 1) / 2 * max_side];
        const int in_a_row = (size.width + 1) / 2;
        for (int i = 0; i < size.height; ++i)
            for (int k = 0; k < size.width; k += 2) {
                const std::int16_t* weight = weights_.data() + i * size.width + k;
                pairs[i * in_a_row + k / 2] = {weight[0], k + 1 < size.width ? weight[1] : std::int16_t{0}};
            }
        const simd::WideDivision division(most_sum_, static_cast<std::uint32_t>(divisor_), offset_);
        if (size == Size{3, 3})
            wide_columns<2>(line, pairs, 3, size, division, width, dst);
        else
            wide_columns<0>(line, pairs, in_a_row, size, division, width, dst);
    }

private:
    static constexpr int max_side = 15;
    static constexpr int most_weights = max_side * max_side;
    static constexpr int no_shift = -1;

    void copy_weights(std::int16_t* to) const {
        std::memcpy(to, weights_.data(), sizeof(std::int16_t) * static_cast<std::size_t>(weights_.size()));
    }
    /// InARow pairs of weights a row of three rows, or any number.
    template <int InARow, class Line>
    static void wide_columns(Line line, const simd::Pair* pairs, int in_a_row, Size size,
                             const simd::WideDivision& division, int width, Pixel* dst) {
        constexpr bool gray = std::is_same_v<Pixel, Gray8>;
        constexpr int low = gray ? 0 : -32768;
        constexpr int high = gray ? 255 : 32767;
        const int reach = size.width / 2;
        simd::for_each_vector(width, [&](int x, int count) {
            simd::WideSums first;
            simd::WideSums second;
            const auto add = [&](const std::uint8_t* from, int k, simd::Pair pair) {
                first.add(from + 2 * simd::column_bytes * k, pair);
                second.add(from + simd::column_bytes * (2 * k + simd::half_lanes), pair);
            };
            if constexpr (InARow > 0) {
                simd::unroll<3>([&](int i) {
                    const std::uint8_t* from = line(i) + simd::column_bytes * (x - reach);
                    simd::unroll<InARow>([&](int k) { add(from, k, pairs[i * InARow + k]); });
                });
            } else {
                const simd::Pair* pair = pairs;
                for (int i = 0; i < size.height; ++i) {
                    const std::uint8_t* from = line(i) + simd::column_bytes * (x - reach);
                    for (int k = 0; k < in_a_row; ++k) add(from, k, *pair++);
                }
            }
            const simd::RawWords a = division.of(first, low, high);
            const simd::RawWords b = division.of(second, low, high);
            if constexpr (gray) {
                const simd::Bytes pixels = simd::narrowed(a, b);
                if (count == simd::lanes)
                    pixels.store(dst + x);
                else
                    pixels.store(dst + x, count);
            } else {
                Pixel pixels[simd::lanes];
                std::memcpy(pixels, &a, sizeof a);
                std::memcpy(pixels + simd::half_lanes, &b, sizeof b);
                std::memcpy(dst + x, pixels, sizeof(Pixel) * static_cast<std::size_t>(count));
            }
        });
    }
    template <int Width, int Height = 0, class Line>
    [[gnu::always_inline]] simd::Words sum_of(Line line, const std::int16_t* weights, int rows, int x) const {
        simd::Words sum = simd::Words::all(start_);
        const auto add_row = [&](int i) {
            const simd::WordLine from = line(i);
            simd::unroll<Width>([&](auto column) {
                constexpr int shift = decltype(column)::value - Width / 2;
                sum = sum + times_signed(from.template at<shift>(x), weights[i * Width + column]);
            });
        };
        if constexpr (Height > 0)
            simd::unroll<Height>(add_row);
        else
            for (int i = 0; i < rows; ++i) add_row(i);
        return sum;
    }
    template <class Line>
    [[gnu::always_inline]] simd::Words sum_of(Line line, const std::int16_t* weight, Size size, int x) const {
        simd::Words sum = simd::Words::all(start_);
        for (int i = 0; i < size.height; ++i) {
            const simd::WordLine from = line(i);
            for (int shift = -(size.width / 2); shift <= size.width / 2; ++shift, ++weight)
                sum = sum + times_signed(from.at(x, shift), *weight);
        }
        return sum;
    }
    template <class Sum>
    void divide_row(int width, Pixel* dst, Sum sum) const {
        const auto divisor = static_cast<std::uint16_t>(divisor_);
        // Rounded down, it gives a quotient that is right or one too small.
        const auto reciprocal = static_cast<std::uint16_t>(divisor_ == 1 ? 65535 : 65536 / divisor_);
        const int shift = shift_;
        const simd::Words one = simd::Words::all(1);
        simd::for_each_vector(width, [&](int x, int count) {
            simd::Words quotient = sum(x);
            if (shift != no_shift) {
                quotient = quotient >> shift;
            } else {
                const simd::Words rounded_down = times_high(quotient, reciprocal);
                const simd::Words rest = quotient - rounded_down * divisor;
                quotient = rounded_down + (at_least(rest, simd::Words::all(divisor)) & one);
            }
            if (count == simd::lanes)
                lowered(quotient).store(dst + x);
            else
                lowered(quotient).store(dst + x, count);
        });
    }
    /// Less what the sum was lifted by.
    [[gnu::always_inline]] auto lowered(simd::Words quotient) const {
        const simd::Words by = simd::Words::all(static_cast<std::uint16_t>(lifted_ < 0 ? -lifted_ : lifted_));
        if constexpr (std::is_same_v<Pixel, Gray8>) {
            if (lifted_ >= 0) return (higher(quotient, by) - by).saturate();
            return (lower(quotient, simd::Words::all(255)) + by).saturate();
        } else {
            return lifted_ >= 0 ? quotient - by : quotient + by;
        }
    }
    Span<const std::int16_t> weights_;
    /// The largest magnitude of a sum, at most 225 * 32768 * 255.
    std::uint32_t most_sum_ = 0;
    int divisor_ = 1;
    int offset_ = 0;
    int shift_ = 0;
    int lifted_ = 0;
    std::uint16_t start_ = 0;
    bool narrow_ = false;
};

}  // namespace kernels
}  // namespace FOVEA_ISA
}  // namespace fovea
