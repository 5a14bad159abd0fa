// SPDX-License-Identifier: MIT
//
// A whole image as one number: smallest and largest pixel, sum, mean and variance.
#pragma once

#include <cstdint>
#include <type_traits>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/point_rows.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/sums.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The smallest and the largest pixel.
template <class Pixel>
struct Extremes {
    Pixel lowest{};
    Pixel highest{};
};

/// A squared difference of brightness: 1/65536 of a squared grey level.
using GrayVariance = Fixed<std::int32_t, 16>;

struct MeanAndVariance {
    GrayLevel mean;
    GrayVariance variance;
};

inline namespace FOVEA_ISA {

/// The smallest and the largest pixel. For Gray8, Gray16, Gradient16 and Sum32.
///
/// Shapes  src 1x1 or larger
/// Errors  empty_image
/// Source  the toolkit's MinMaxValue
template <class Pixel>
Result<Extremes<std::remove_const_t<Pixel>>> extremes_of(ImageView<Pixel> src);

/// The sum of all pixels. For Gray8, Gray16, Gradient16 and Sum32.
///
/// Shapes  src 1x1 or larger, sides up to max_image_side: 2^30 pixels of 32 bits fit
/// Errors  empty_image, image_too_large
/// Source  the toolkit's PixelSum, which held 32 bits: 16.8 million white pixels
template <class Pixel>
Result<std::int64_t> sum_of(ImageView<Pixel> src);

/// The mean and the mean squared difference from it.
///
/// Shapes    src 1x1 or larger, sides up to max_image_side
/// Units     grey levels; the variance is divided by the count of pixels
/// Rounding  nearest, ties up; the variance is computed to 2^-31 before that
/// Errors    empty_image, image_too_large
inline Result<MeanAndVariance> mean_and_variance(ImageView<const Gray8> src);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// sum <= 255 count and squares <= 65025 count, count up to 2^30.
constexpr MeanAndVariance mean_and_variance_of(std::int64_t count, std::int64_t sum, std::int64_t squares) {
    const GrayLevel mean = GrayLevel::from_raw(static_cast<std::int32_t>(round_divide(sum << 16, count)));
    // About the nearest whole level: (T - D^2 / count) / count with T below 2^46 and |D| <= count / 2. Both
    // parts in 2^-32; the division is done in two steps, so that no shift overflows.
    const std::int64_t level = round_divide(sum, count);
    const std::int64_t d = sum - level * count;
    const std::int64_t t = squares - 2 * level * sum + level * level * count;
    const std::int64_t first = (t / count << 32) + (t % count << 32) / count;
    const std::int64_t offset = d * (std::int64_t{1} << 31) / count;
    const std::int64_t variance = maximum<std::int64_t>(first - (offset * offset >> 30), 0);
    return {mean, GrayVariance::from_raw(static_cast<std::int32_t>(round_shift(variance, 16)))};
}

template <class Pixel>
constexpr bool has_a_large_side(ImageView<Pixel> image) {
    return image.width() > max_image_side || image.height() > max_image_side;
}

}  // namespace detail

inline namespace FOVEA_ISA {
namespace kernels {

/// Lowers and raises extremes to those of a row.
template <class Pixel>
void add_extremes(const Pixel* row, int width, Extremes<Pixel>& extremes) {
    Pixel lowest = extremes.lowest;
    Pixel highest = extremes.highest;
    for (int x = 0; x < width; ++x) {
        lowest = minimum(lowest, row[x]);
        highest = maximum(highest, row[x]);
    }
    extremes = {lowest, highest};
}

inline void add_extremes(const Gray8* row, int width, Extremes<Gray8>& extremes) {
    using simd::Bytes;
    constexpr int lanes = simd::lanes;
    Bytes low[2] = {Bytes::all(extremes.lowest), Bytes::all(extremes.lowest)};
    Bytes high[2] = {Bytes::all(extremes.highest), Bytes::all(extremes.highest)};
    int x = 0;
    for (; x + 2 * lanes <= width; x += 2 * lanes)
        for (int i = 0; i < 2; ++i) {
            const Bytes pixels = Bytes::load(row + x + i * lanes);
            low[i] = lower(low[i], pixels);
            high[i] = higher(high[i], pixels);
        }
    std::uint8_t ends[2][lanes];
    lower(low[0], low[1]).store(ends[0]);
    higher(high[0], high[1]).store(ends[1]);
    for (int i = 0; i < lanes; ++i) {
        extremes.lowest = minimum(extremes.lowest, ends[0][i]);
        extremes.highest = maximum(extremes.highest, ends[1][i]);
    }
    for (; x < width; ++x) {
        extremes.lowest = minimum(extremes.lowest, row[x]);
        extremes.highest = maximum(extremes.highest, row[x]);
    }
}

template <class Pixel>
std::int64_t row_sum(const Pixel* row, int width) {
    std::int64_t sum = 0;
    for (int x = 0; x < width; ++x) sum += row[x];
    return sum;
}
inline std::int64_t row_sum(const Gray8* row, int width) {
    return static_cast<std::int64_t>(simd::sum_of_bytes(row, width));
}

}  // namespace kernels

template <class Pixel>
Result<Extremes<std::remove_const_t<Pixel>>> extremes_of(ImageView<Pixel> src) {
    using Value = std::remove_const_t<Pixel>;
    static_assert(std::is_integral_v<Value>, "extremes_of() takes pixels that are numbers");
    if (src.empty()) return Status::empty_image;
    const Value* first = src.first();
    Extremes<Value> extremes{*first, *first};
    const Size rows = detail::rows_of(src.size(), src);
    for (int y = 0; y < rows.height; ++y) {
        const Value* row = src.row(y);
        kernels::add_extremes(row, rows.width, extremes);
    }
    return extremes;
}

template <class Pixel>
Result<std::int64_t> sum_of(ImageView<Pixel> src) {
    using Value = std::remove_const_t<Pixel>;
    static_assert(std::is_integral_v<Value> && sizeof(Value) <= 4,
                  "sum_of() takes pixels that are numbers of up to 32 bits");
    if (src.empty()) return Status::empty_image;
    if (detail::has_a_large_side(src)) return Status::image_too_large;
    std::int64_t sum = 0;
    const Size rows = detail::rows_of(src.size(), src);
    for (int y = 0; y < rows.height; ++y) {
        const Value* row = src.row(y);
        sum += kernels::row_sum(row, rows.width);
    }
    return sum;
}

inline Result<MeanAndVariance> mean_and_variance(ImageView<const Gray8> src) {
    if (src.empty()) return Status::empty_image;
    if (detail::has_a_large_side(src)) return Status::image_too_large;
    std::int64_t sum = 0;
    std::int64_t squares = 0;
    const Size rows = detail::rows_of(src.size(), src);
    for (int y = 0; y < rows.height; ++y) {
        const simd::ByteSums part = simd::square_sums_of_bytes(src.row(y), rows.width);
        sum += static_cast<std::int64_t>(part.sum);
        squares += static_cast<std::int64_t>(part.squares);
    }
    return detail::mean_and_variance_of(src.size().area(), sum, squares);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
