// SPDX-License-Identifier: MIT
//
// Contrast by the picture's own range: its extremes or its quantiles become 0 and 255. Book sec. 2.4, 2.5.3.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/lookup_table.hpp>
#include <fovea/pixelwise/point_rows.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/statistics/reductions.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// The darkest level becomes 0, the brightest 255, in a straight line between them; an image of one level
/// becomes 0.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Rounding  nearest, ties up
/// Overlap   dst may be src
/// Errors    empty_image, size_mismatch
/// Source    the toolkit's Spread, which left the output of an image of one level as it was
inline Status spread(ImageView<const Gray8> src, ImageView<Gray8> dst);

/// Scratch bytes that histogram_stretching() needs: one histogram.
constexpr std::int64_t histogram_stretching_scratch() { return arena_bytes<Histogram>(1); }

/// The quantile of low becomes 0, that of high 255, in a straight line between them; what is beyond is held
/// there. A few dead or glaring pixels do not decide, as they do with spread().
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     shares of the pixels in 1/65536; 6554 and 58982 are the tenth and the nine tenths of the book
/// Rounding  nearest, ties up; where both quantiles are one level, that and below becomes 0, above it 255
/// Overlap   dst may be src
/// Scratch   histogram_stretching_scratch() bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, bad_argument for low above high or high above whole_share,
///           scratch_too_small
/// Source    book sec. 2.5.3
inline Status histogram_stretching(ImageView<const Gray8> src, std::uint32_t low, std::uint32_t high,
                                   Span<std::uint8_t> scratch, ImageView<Gray8> dst);

/// Gray16, Gradient16 or Sum32 for the eye: the smallest value becomes 0, the largest 255, in a straight line
/// between them; an image of one value becomes 0. The scale changes with every picture: where that flickers,
/// narrow().
///
/// Shapes    src and dst equal, 1x1 or larger
/// Rounding  nearest, ties up; products have 64 bits, so that every range fits
/// Overlap   none
/// Errors    empty_image, size_mismatch
/// Source    the toolkit's ConvertImage, whose products overflowed above a range of 32767
template <class Wide>
Status auto_scale(ImageView<const Wide> src, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

inline Status spread(ImageView<const Gray8> src, ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    const Extremes<Gray8> extremes = *extremes_of(src);
    return apply_lut(src, stretch_table(extremes.lowest, extremes.highest), dst);
}

inline Status histogram_stretching(ImageView<const Gray8> src, std::uint32_t low, std::uint32_t high,
                                   Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (low > high || high > whole_share) return Status::bad_argument;
    if (scratch.size() < histogram_stretching_scratch()) return Status::scratch_too_small;
    Arena arena(scratch);
    Histogram& histogram = detail::take_histogram(arena);
    if (Status s = histogram_of(src, histogram); s != Status::ok) return s;
    return apply_lut(src, stretch_table(*quantile(histogram, low), *quantile(histogram, high)), dst);
}

namespace kernels {

/// 255 (value - lowest) / range to the nearest, for 16 bits: a product with the reciprocal of the range,
/// which is raised to 16 bits. It is too large by less than 2^-22, which is less than a quotient can be under
/// a half number, 1 / (2 * 65535).
struct Stretch16 {
    std::uint32_t lowest;
    int raise;
    std::uint32_t reciprocal;  ///< 255 * 2^39 / raised range, rounded up

    Stretch16(std::int32_t least, std::uint32_t range)
        : lowest(static_cast<std::uint32_t>(least)), raise(leading_zeros(range) - 16) {
        const std::uint32_t divisor = range << raise;
        reciprocal = static_cast<std::uint32_t>(((std::uint64_t{255} << 39) + divisor - 1) / divisor);
    }

    /// The lower half of the reciprocal counts whole, and one for what its product loses.
    Gray8 operator()(std::int32_t value) const {
        const std::uint32_t above = (static_cast<std::uint32_t>(value) - lowest) << raise;
        const std::uint32_t product = above * (reciprocal >> 16) + (above * (reciprocal & 0xffffu) >> 16) + 1;
        return static_cast<Gray8>((product + (1u << 22)) >> 23);
    }
#if FOVEA_BYTES >= 16
    /// Half a vector. The sum's lower half only carries.
    [[gnu::always_inline]] simd::RawWords operator()(simd::RawWords values) const {
        const auto high = static_cast<std::uint16_t>(reciprocal >> 16);
        const auto low = static_cast<std::uint16_t>(reciprocal & 0xffffu);
        const simd::RawWords above = (values - static_cast<std::uint16_t>(lowest & 0xffffu)) << raise;
        const simd::RawWords whole = above * high;
        const simd::RawWords less = whole + simd::times_high(above, low) + 1;
        const simd::RawWords no_carry = simd::at_least_words(less, whole);
        return (simd::times_high(above, high) + no_carry + 65) >> 7;
    }
#endif
};

template <class Wide>
void stretch_row(const Wide* src, int width, const Stretch16& stretch, Gray8* dst) {
    int x = 0;
#if FOVEA_BYTES >= 16
    for (; x + simd::lanes <= width; x += simd::lanes) {
        simd::RawWords first;
        simd::RawWords second;
        std::memcpy(&first, src + x, sizeof first);
        std::memcpy(&second, src + x + simd::half_lanes, sizeof second);
        simd::narrowed(stretch(first), stretch(second)).store(dst + x);
    }
#endif
    for (; x < width; ++x) dst[x] = stretch(src[x]);
}

/// For 32 bits, whose products have 64.
template <class Wide>
void stretch_row(const Wide* src, int width, std::int64_t lowest, std::uint64_t range, Gray8* dst) {
    for (int x = 0; x < width; ++x) {
        const auto above = static_cast<std::uint64_t>(src[x] - lowest);
        dst[x] = static_cast<Gray8>((above * 510 + range) / (2 * range));
    }
}

}  // namespace kernels

template <class Wide>
Status auto_scale(ImageView<const Wide> src, ImageView<Gray8> dst) {
    static_assert(std::is_integral_v<Wide> && (sizeof(Wide) == 2 || sizeof(Wide) == 4),
                  "auto_scale() takes Gray16, Gradient16 and Sum32");
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    const Extremes<Wide> extremes = *extremes_of(src);
    const std::int64_t lowest = extremes.lowest;
    // A range of 0 makes every numerator 0.
    const auto range = static_cast<std::uint64_t>(maximum<std::int64_t>(extremes.highest - lowest, 1));
    const Size rows = detail::rows_of(src.size(), src, dst);
    if constexpr (sizeof(Wide) == 2) {
        const kernels::Stretch16 stretch(extremes.lowest, static_cast<std::uint32_t>(range));
        for (int y = 0; y < rows.height; ++y)
            kernels::stretch_row(src.row(y), rows.width, stretch, dst.row(y));
    } else {
        for (int y = 0; y < rows.height; ++y)
            kernels::stretch_row(src.row(y), rows.width, lowest, range, dst.row(y));
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
