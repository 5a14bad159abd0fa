// SPDX-License-Identifier: MIT
//
// Differences of morphological operators: what a rectangle removes, and the outline of things. Book sec. 2.7.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/morphology/rectangle_kernels.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {
inline namespace FOVEA_ISA {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that top_hat() and black_hat() need: that of opening(), and a strip of rows.
constexpr std::int64_t top_hat_scratch(Size size) {
    return opening_scratch(size) + std::int64_t{size.width} * kernels::strip_rows;
}
constexpr std::int64_t black_hat_scratch(Size size) { return top_hat_scratch(size); }

/// Scratch bytes that morphological_gradient() needs: that of erode(), and a strip of rows.
constexpr std::int64_t morphological_gradient_scratch(Size size) {
    return erode_scratch(size) + std::int64_t{size.width} * kernels::strip_rows;
}

/// The source less its opening: what is bright and smaller than the element, on any ground.
///
/// Shapes   src and dst equal, 1x1 or larger; element odd by odd, 1x1 to 63x63
/// Units    differences 0..255: the opening is nowhere above the source
/// Border   the outermost pixels repeat
/// Overlap  dst may be src
/// Scratch  top_hat_scratch(src.size()) bytes, undefined afterwards
/// Errors   empty_image, size_mismatch, bad_argument for an even, too small or too large element,
///          scratch_too_small
/// Source   Meyer, "Iterative image transformations for an automatic screening of cervical smears", 1979
inline Status top_hat(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst);

/// The closing less the source: what is dark and smaller than the element. All else as top_hat().
inline Status black_hat(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                        ImageView<Gray8> dst);

/// The dilation less the erosion: the outline, as thick as the element less one.
///
/// Overlap  none: dst must not share pixels with src
/// Scratch  morphological_gradient_scratch(src.size()) bytes, undefined afterwards
/// Others   as top_hat()
/// Source   Beucher's gradient
inline Status morphological_gradient(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                                     ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// dst[x] = higher[x] - lower[x], where no difference is negative. dst may be either of them.
inline void difference_row(const Gray8* higher, const Gray8* lower, int width, Gray8* dst) {
    simd::for_each_vector(width, [&](int x, int count) {
        if (count == simd::lanes) {
            const simd::Words a(simd::Bytes::load(higher + x));
            const simd::Words b(simd::Bytes::load(lower + x));
            (a - b).narrow().store(dst + x);
        } else {
            const simd::Words a(simd::Bytes::load(higher + x, count));
            const simd::Words b(simd::Bytes::load(lower + x, count));
            (a - b).narrow().store(dst + x, count);
        }
    });
}

/// The second step of an opening or closing into a strip, and the difference from the source out of it.
template <class First, class Second>
void hat_frame(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    const int width = src.width();
    const auto used = static_cast<std::ptrdiff_t>(opening_scratch(src.size()));
    const ImageView<Gray8> strip(scratch.from(used).data(), {width, strip_rows}, width);
    two_steps<First>(src, element, scratch, [&](ImageView<const Gray8> between, int first, int last, int y) {
        extreme_rows<Second>(between, element, first, last, scratch, strip);
        for (int i = 0; i <= last - first; ++i) {
            if constexpr (First::neutral == Lowest::neutral)
                difference_row(src.row(y + i), strip.row(i), width, dst.row(y + i));
            else
                difference_row(strip.row(i), src.row(y + i), width, dst.row(y + i));
        }
    });
}

}  // namespace kernels

inline Status top_hat(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst) {
    if (Status s = kernels::check_morphology(src, element, top_hat_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    kernels::hat_frame<kernels::Lowest, kernels::Highest>(src, element, scratch, dst);
    return Status::ok;
}

inline Status black_hat(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                        ImageView<Gray8> dst) {
    if (Status s = kernels::check_morphology(src, element, black_hat_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    kernels::hat_frame<kernels::Highest, kernels::Lowest>(src, element, scratch, dst);
    return Status::ok;
}

inline Status morphological_gradient(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch,
                                     ImageView<Gray8> dst) {
    if (Status s =
            kernels::check_morphology(src, element, morphological_gradient_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    const int width = src.width();
    const auto used = static_cast<std::ptrdiff_t>(erode_scratch(src.size()));
    const ImageView<Gray8> strip(scratch.from(used).data(), {width, kernels::strip_rows}, width);
    for (int y = 0; y < src.height(); y += kernels::strip_rows) {
        const int last = minimum(y + kernels::strip_rows, src.height()) - 1;
        const ImageView<Gray8> rows(dst.row(y), {width, last - y + 1}, dst.stride_bytes());
        kernels::extreme_rows<kernels::Lowest>(src, element, y, last, scratch, strip);
        kernels::extreme_rows<kernels::Highest>(src, element, y, last, scratch, rows);
        for (int i = 0; i <= last - y; ++i)
            kernels::difference_row(rows.row(i), strip.row(i), width, rows.row(i));
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
