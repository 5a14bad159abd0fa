// SPDX-License-Identifier: MIT
//
// Thresholds: from grey to binary, 255 where a pixel belongs and 0 elsewhere. Book sec. 2.4, 2.8.1.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/point_rows.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// 255 where a pixel is at least level, else 0.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  dst may be src
/// Errors   empty_image, size_mismatch
/// Source   book sec. 2.4; the toolkit's ThresholdBinarize(level)
inline Status threshold(ImageView<const Gray8> src, Gray8 level, ImageView<Gray8> dst);

/// 255 where a pixel is below level, else 0: the exact complement of threshold(). All else as there.
///
/// Source  as above; the toolkit's inverse also took pixels at level itself, so that both forms claimed them
inline Status threshold_inverse(ImageView<const Gray8> src, Gray8 level, ImageView<Gray8> dst);

/// 255 where low <= pixel <= high, else 0. All else as threshold().
///
/// Errors  also bad_argument if low is above high
inline Status threshold_range(ImageView<const Gray8> src, Gray8 low, Gray8 high, ImageView<Gray8> dst);

/// Keeps a pixel that is at least level; the others become 0. All else as threshold().
///
/// Source  book sec. 2.4; the toolkit's ThresholdFilter(level)
inline Status threshold_filter(ImageView<const Gray8> src, Gray8 level, ImageView<Gray8> dst);

/// Keeps a pixel that is below level; the others become 0, so that both filters add up to the source. All
/// else as threshold().
///
/// Source  as above; the toolkit's inverse also kept pixels at level itself
inline Status threshold_filter_inverse(ImageView<const Gray8> src, Gray8 level, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// The thresholds, of vectors of pixels.
struct Threshold {
    simd::Bytes level;
    explicit Threshold(Gray8 of) : level(simd::Bytes::all(of)) {}
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes pixels) const {
        return at_least(pixels, level);
    }
};
struct ThresholdInverse {
    simd::Bytes level;
    explicit ThresholdInverse(Gray8 of) : level(simd::Bytes::all(of)) {}
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes pixels) const {
        return ~at_least(pixels, level);
    }
};
struct ThresholdRange {
    simd::Bytes low;
    simd::Bytes high;
    ThresholdRange(Gray8 from, Gray8 to) : low(simd::Bytes::all(from)), high(simd::Bytes::all(to)) {}
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes pixels) const {
        return at_least(pixels, low) & at_least(high, pixels);
    }
};
struct ThresholdFilter {
    simd::Bytes level;
    explicit ThresholdFilter(Gray8 of) : level(simd::Bytes::all(of)) {}
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes pixels) const {
        return pixels & at_least(pixels, level);
    }
};
struct ThresholdFilterInverse {
    simd::Bytes level;
    explicit ThresholdFilterInverse(Gray8 of) : level(simd::Bytes::all(of)) {}
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes pixels) const {
        return pixels & ~at_least(pixels, level);
    }
};

/// threshold() of one row, for rows that come one at a time.
inline void threshold_row(const Gray8* src, int width, Gray8 level, Gray8* dst) {
    point_row(src, width, Threshold(level), dst);
}

/// threshold_inverse() of one row.
inline void threshold_inverse_row(const Gray8* src, int width, Gray8 level, Gray8* dst) {
    point_row(src, width, ThresholdInverse(level), dst);
}

}  // namespace kernels

inline Status threshold(ImageView<const Gray8> src, Gray8 level, ImageView<Gray8> dst) {
    return kernels::point_frame(src, kernels::Threshold(level), dst);
}

inline Status threshold_inverse(ImageView<const Gray8> src, Gray8 level, ImageView<Gray8> dst) {
    return kernels::point_frame(src, kernels::ThresholdInverse(level), dst);
}

inline Status threshold_range(ImageView<const Gray8> src, Gray8 low, Gray8 high, ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (low > high) return Status::bad_argument;
    return kernels::point_frame(src, kernels::ThresholdRange(low, high), dst);
}

inline Status threshold_filter(ImageView<const Gray8> src, Gray8 level, ImageView<Gray8> dst) {
    return kernels::point_frame(src, kernels::ThresholdFilter(level), dst);
}

inline Status threshold_filter_inverse(ImageView<const Gray8> src, Gray8 level, ImageView<Gray8> dst) {
    return kernels::point_frame(src, kernels::ThresholdFilterInverse(level), dst);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
