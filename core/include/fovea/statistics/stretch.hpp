// SPDX-License-Identifier: MIT
//
// Contrast by the picture's own range: its extremes or its quantiles become 0 and 255. Book sec. 2.4, 2.5.3.
#pragma once

#include <cstdint>
#include <type_traits>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/lookup_table.hpp>
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
    for (int y = 0; y < src.height(); ++y) {
        const Wide* from = src.row(y);
        Gray8* to = dst.row(y);
        if constexpr (sizeof(Wide) == 2) {
            // In 32 bits, so that many pixels are done at once. The range is raised to 16 bits; the
            // reciprocal is too small by less than 1 in 2^-23, which 16 bits of value make less than 2^-7:
            // the quotient is right or one too small, and the remainder tells. 255 * 2^23 + 2^22 fits 32
            // bits.
            const auto width = static_cast<std::uint32_t>(range);
            const int raise = leading_zeros(width) - 16;
            const std::uint32_t reciprocal = (255u << 23) / (width << raise);
            for (int x = 0; x < src.width(); ++x) {
                const auto above = static_cast<std::uint32_t>(from[x] - static_cast<std::int32_t>(lowest));
                const std::uint32_t guess = ((above << raise) * reciprocal + (1u << 22)) >> 23;
                const std::uint32_t left = above * 510u + width - guess * (2 * width);
                to[x] = static_cast<Gray8>(guess + (left >= 2 * width ? 1 : 0));
            }
        } else {
            for (int x = 0; x < src.width(); ++x) {
                const auto above = static_cast<std::uint64_t>(from[x] - lowest);
                to[x] = static_cast<Gray8>((above * 510 + range) / (2 * range));
            }
        }
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
