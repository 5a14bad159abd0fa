// SPDX-License-Identifier: MIT
//
// Otsu's threshold of an image, applied to it. Book sec. 2.4.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/statistics/histogram.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Scratch bytes that otsu_threshold() and its inverse need: one histogram.
constexpr std::int64_t otsu_threshold_scratch() { return arena_bytes<Histogram>(1); }

/// 255 where a pixel belongs to the bright class of otsu(), else 0. Where the level is wanted too, take
/// histogram_of(), otsu() and threshold().
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  dst may be src
/// Scratch  otsu_threshold_scratch() bytes, undefined afterwards
/// Errors   empty_image, size_mismatch, scratch_too_small; degenerate if all pixels have one level, which are
///          not two classes: the output is as it was
/// Source   as otsu()
inline Status otsu_threshold(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst);

/// 255 where a pixel belongs to the dark class, else 0. All else as otsu_threshold().
inline Status otsu_threshold_inverse(ImageView<const Gray8> src, Span<std::uint8_t> scratch,
                                     ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The level, once the images are known to fit.
inline Result<Gray8> otsu_level(ImageView<const Gray8> src, Span<std::uint8_t> scratch,
                                ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (scratch.size() < otsu_threshold_scratch()) return Status::scratch_too_small;
    Arena arena(scratch);
    Histogram& histogram = take_histogram(arena);
    if (const Status s = histogram_of(src, histogram); s != Status::ok) return s;
    return otsu(histogram);
}

}  // namespace detail

inline namespace FOVEA_ISA {

inline Status otsu_threshold(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    const Result<Gray8> level = detail::otsu_level(src, scratch, dst);
    return level ? threshold(src, *level, dst) : level.status();
}

inline Status otsu_threshold_inverse(ImageView<const Gray8> src, Span<std::uint8_t> scratch,
                                     ImageView<Gray8> dst) {
    const Result<Gray8> level = detail::otsu_level(src, scratch, dst);
    return level ? threshold_inverse(src, *level, dst) : level.status();
}

}  // namespace FOVEA_ISA
}  // namespace fovea
