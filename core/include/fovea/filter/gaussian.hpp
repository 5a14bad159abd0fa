// SPDX-License-Identifier: MIT
//
// Gaussian filters of fixed size, by the binomial coefficients. Book sec. 2.6.2.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/filter_row.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/simd/binomials.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/stream/stage.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Scratch bytes that gaussian_3x3() and gaussian_5x5() need: a line, and a row of zeros.
constexpr std::int64_t gaussian_3x3_scratch(Size size);
constexpr std::int64_t gaussian_5x5_scratch(Size size);

/// Every pixel as the mean of its 3x3 neighbourhood with the weights 1 2 1 in both directions. As a Gaussian
/// its sigma is 0.71 px.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     grey levels in and out
/// Rounding  nearest, ties up, once; the largest sum is 16 * 255
/// Border    as border says
/// Overlap   none: dst must not share pixels with src
/// Scratch   gaussian_3x3_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, scratch_too_small
/// Source    book sec. 2.6.2; the toolkit's GaussianSmooth3x3, which copied the outermost pixels
inline Status gaussian_3x3(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                           ImageView<Gray8> dst);

/// The same with the weights 1 4 6 4 1 of a 5x5 neighbourhood; sigma 1 px.
///
/// Rounding  nearest, ties up, once; the largest sum is 256 * 255
/// Scratch   gaussian_5x5_scratch(src.size()) bytes, undefined afterwards
/// Source    book sec. 2.6.2; the toolkit's GaussianSmooth5x5 rounded twice
/// Others    as gaussian_3x3()
inline Status gaussian_5x5(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                           ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

struct Gaussian3x3 {
    static constexpr int rows = 3, reach = 1, byte_lines = 0, word_lines = 1;
    using Output = Gray8;
    using Lines = FilterLines<Gaussian3x3>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c) const {
        lines.words().put(x, simd::binomial(a, b, c));
    }
    [[gnu::always_inline]] simd::Bytes across(const Lines& lines, int x) const {
        return (simd::binomial_3(lines.words(), x, 8) >> 4).narrow();
    }
};

struct Gaussian5x5 {
    static constexpr int rows = 5, reach = 2, byte_lines = 0, word_lines = 1;
    using Output = Gray8;
    using Lines = FilterLines<Gaussian5x5>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c,
                                     simd::Bytes d, simd::Bytes e) const {
        lines.words().put(x, simd::binomial(a, b, c, d, e));
    }
    [[gnu::always_inline]] simd::Bytes across(const Lines& lines, int x) const {
        return (simd::binomial_5(lines.words(), x, 128) >> 8).narrow();
    }
};

}  // namespace kernels

constexpr std::int64_t gaussian_3x3_scratch(Size size) { return filter_scratch<kernels::Gaussian3x3>(size); }
constexpr std::int64_t gaussian_5x5_scratch(Size size) { return filter_scratch<kernels::Gaussian5x5>(size); }

inline Status gaussian_3x3(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                           ImageView<Gray8> dst) {
    return filter_frame(kernels::Gaussian3x3(), src, border, scratch, dst);
}
inline Status gaussian_5x5(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                           ImageView<Gray8> dst) {
    return filter_frame(kernels::Gaussian5x5(), src, border, scratch, dst);
}

namespace stages {
inline constexpr FilterStage<kernels::Gaussian3x3> gaussian_3x3;
inline constexpr FilterStage<kernels::Gaussian5x5> gaussian_5x5;
}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
