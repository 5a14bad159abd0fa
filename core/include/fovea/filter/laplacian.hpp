// SPDX-License-Identifier: MIT
//
// The Laplacian of a picture, with four and with eight neighbours. Book sec. 2.6.3.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/filter_row.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/stream/stage.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Scratch bytes that laplacian_4() and laplacian_8() need.
constexpr std::int64_t laplacian_4_scratch(Size size);
constexpr std::int64_t laplacian_8_scratch(Size size);

/// The sum of the four neighbours less four times the pixel.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     -1020..1020 for grey levels 0..255
/// Rounding  none
/// Border    as border says
/// Overlap   none
/// Scratch   laplacian_4_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, scratch_too_small
/// Source    book sec. 2.6.3; the toolkit's Laplace1
inline Status laplacian_4(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                          ImageView<Gradient16> dst);

/// The sum of the eight neighbours less eight times the pixel: -2040..2040. All else as laplacian_4().
///
/// Source  the toolkit's Laplace2
inline Status laplacian_8(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                          ImageView<Gradient16> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

struct Laplacian4 {
    static constexpr int rows = 3, reach = 1, byte_lines = 0, word_lines = 2;
    using Output = Gradient16;
    using Lines = FilterLines<Laplacian4>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c) const {
        const simd::Words here(b);
        lines.words<0>().put(x, here);
        // 1020 keeps it above zero.
        lines.words<1>().put(x, simd::Words(a) + simd::Words(c) + simd::Words::all(1020) - (here << 2));
    }
    [[gnu::always_inline]] simd::Words across(const Lines& lines, int x) const {
        return lines.words<0>().at<-1>(x) + lines.words<0>().at<1>(x) + lines.words<1>().at<0>(x) -
               simd::Words::all(1020);
    }
};

struct Laplacian8 {
    static constexpr int rows = 3, reach = 1, byte_lines = 0, word_lines = 2;
    using Output = Gradient16;
    using Lines = FilterLines<Laplacian8>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c) const {
        const simd::Words here(b);
        lines.words<0>().put(x, here * 9);
        lines.words<1>().put(x, simd::Words(a) + here + simd::Words(c));
    }
    [[gnu::always_inline]] simd::Words across(const Lines& lines, int x) const {
        const simd::WordLine& sums = lines.words<1>();
        return sums.at<-1>(x) + sums.at<0>(x) + sums.at<1>(x) - lines.words<0>().at<0>(x);
    }
};

}  // namespace kernels

constexpr std::int64_t laplacian_4_scratch(Size size) { return filter_scratch<kernels::Laplacian4>(size); }
constexpr std::int64_t laplacian_8_scratch(Size size) { return filter_scratch<kernels::Laplacian8>(size); }

inline Status laplacian_4(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                          ImageView<Gradient16> dst) {
    return filter_frame(kernels::Laplacian4(), src, border, scratch, dst);
}
inline Status laplacian_8(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                          ImageView<Gradient16> dst) {
    return filter_frame(kernels::Laplacian8(), src, border, scratch, dst);
}

namespace stages {
inline constexpr FilterStage<kernels::Laplacian4> laplacian_4;
inline constexpr FilterStage<kernels::Laplacian8> laplacian_8;
}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
