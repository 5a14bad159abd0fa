// SPDX-License-Identifier: MIT
//
// A whole image as one number: smallest and largest pixel, sum, mean and variance.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/point_rows.hpp>
#include <fovea/simd/backend.hpp>
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

/// extremes_of(), sum_of() and mean_and_variance() of rows that come one at a time: accumulators for streams.
/// What strips of a frame gave is joined by merge().
///
/// Errors  result() is empty_image before the first row; begin() of sums is image_too_large as the functions
///         are
template <class Pixel>
class ExtremesAccumulator;
template <class Pixel>
class SumAccumulator;
class MeanAndVarianceAccumulator;

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

constexpr bool has_a_large_side(Size size) {
    return size.width > max_image_side || size.height > max_image_side;
}

}  // namespace detail

inline namespace FOVEA_ISA {
namespace kernels {

#if FOVEA_BYTES >= 16
/// Lowers and raises extremes to those of whole vectors of 16 bits in a row, and answers how many pixels they
/// were. All are compared with a sign, which those without one get by a flipped highest bit.
template <class Pixel>
int add_extremes_in_vectors(const Pixel* row, int width, Extremes<Pixel>& extremes) {
    constexpr int pixels = simd::lanes / 2;
    constexpr std::uint16_t flip = std::is_signed_v<Pixel> ? 0 : 0x8000;
    const auto signed_from = [](const Pixel* from) {
        simd::RawWords words;
        std::memcpy(&words, from, sizeof words);
        return simd::bits_as<simd::RawSigned>(words ^ flip);
    };
    if (width < pixels) return 0;
    simd::RawSigned low = signed_from(row);
    simd::RawSigned high = low;
    int x = pixels;
    for (; x + pixels <= width; x += pixels) {
        const simd::RawSigned values = signed_from(row + x);
        low = values < low ? values : low;
        high = values > high ? values : high;
    }
    for (int i = 0; i < pixels; ++i) {
        extremes.lowest = minimum(extremes.lowest, static_cast<Pixel>(low[i] ^ flip));
        extremes.highest = maximum(extremes.highest, static_cast<Pixel>(high[i] ^ flip));
    }
    return x;
}
#endif

/// Lowers and raises extremes to those of a row.
template <class Pixel>
void add_extremes(const Pixel* row, int width, Extremes<Pixel>& extremes) {
    int x = 0;
#if FOVEA_BYTES >= 16
    if constexpr (sizeof(Pixel) == 2) x = add_extremes_in_vectors(row, width, extremes);
#endif
    Pixel lowest = extremes.lowest;
    Pixel highest = extremes.highest;
    for (; x < width; ++x) {
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
    if (detail::has_a_large_side(src.size())) return Status::image_too_large;
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
    if (detail::has_a_large_side(src.size())) return Status::image_too_large;
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

template <class Pixel>
class ExtremesAccumulator {
public:
    using Input = Pixel;
    static_assert(std::is_integral_v<Pixel>, "extremes are of pixels that are numbers");

    Status begin(Size) {
        empty_ = true;
        return Status::ok;
    }
    void add_row(const Pixel* row, int width, int) {
        if (empty_) extremes_ = {row[0], row[0]};
        empty_ = false;
        kernels::add_extremes(row, width, extremes_);
    }
    void merge(const ExtremesAccumulator& other) {
        if (other.empty_) return;
        if (empty_) extremes_ = other.extremes_;
        empty_ = false;
        extremes_.lowest = minimum(extremes_.lowest, other.extremes_.lowest);
        extremes_.highest = maximum(extremes_.highest, other.extremes_.highest);
    }
    Result<Extremes<Pixel>> result() const {
        if (empty_) return Status::empty_image;
        return extremes_;
    }

private:
    Extremes<Pixel> extremes_;
    bool empty_ = true;
};

template <class Pixel>
class SumAccumulator {
public:
    using Input = Pixel;
    static_assert(std::is_integral_v<Pixel> && sizeof(Pixel) <= 4,
                  "sums are of pixels that are numbers of up to 32 bits");

    Status begin(Size size) {
        if (detail::has_a_large_side(size)) return Status::image_too_large;
        *this = {};
        return Status::ok;
    }
    void add_row(const Pixel* row, int width, int) {
        sum_ += kernels::row_sum(row, width);
        empty_ = false;
    }
    void merge(const SumAccumulator& other) {
        sum_ += other.sum_;
        empty_ = empty_ && other.empty_;
    }
    Result<std::int64_t> result() const {
        if (empty_) return Status::empty_image;
        return sum_;
    }

private:
    std::int64_t sum_ = 0;
    bool empty_ = true;
};

class MeanAndVarianceAccumulator {
public:
    using Input = Gray8;

    Status begin(Size size) {
        if (detail::has_a_large_side(size)) return Status::image_too_large;
        *this = {};
        return Status::ok;
    }
    void add_row(const Gray8* row, int width, int) {
        const simd::ByteSums part = simd::square_sums_of_bytes(row, width);
        sum_ += static_cast<std::int64_t>(part.sum);
        squares_ += static_cast<std::int64_t>(part.squares);
        count_ += width;
    }
    void merge(const MeanAndVarianceAccumulator& other) {
        sum_ += other.sum_;
        squares_ += other.squares_;
        count_ += other.count_;
    }
    Result<MeanAndVariance> result() const {
        if (count_ == 0) return Status::empty_image;
        return detail::mean_and_variance_of(count_, sum_, squares_);
    }

private:
    std::int64_t sum_ = 0;
    std::int64_t squares_ = 0;
    std::int64_t count_ = 0;
};

}  // namespace FOVEA_ISA
}  // namespace fovea
