// SPDX-License-Identifier: MIT
//
// First derivatives of a picture: Sobel, Prewitt, Scharr and central differences, and the strength of the
// gradient. Book sec. 2.6.3.
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

/// Scratch bytes that a derivative needs, and the strength of both.
constexpr std::int64_t derivative_scratch(Size size);
constexpr std::int64_t gradient_scratch(Size size);

/// Brightness to the right less brightness to the left, smoothed downwards by 1 2 1.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     -1020..1020 for grey levels 0..255; an edge of one grey level a pixel gives 8
/// Rounding  none
/// Border    as border says
/// Overlap   none
/// Scratch   derivative_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, scratch_too_small
/// Source    book sec. 2.6.3; the toolkit's SobelX, which left a frame of zeros
inline Status sobel_x(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                      ImageView<Gradient16> dst);

/// Brightness below less brightness above, smoothed across. All else as sobel_x().
inline Status sobel_y(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                      ImageView<Gradient16> dst);

/// Derivatives with the weights 1 1 1: -765..765, 6 for one grey level a pixel. All else as sobel_x().
inline Status prewitt_x(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                        ImageView<Gradient16> dst);
inline Status prewitt_y(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                        ImageView<Gradient16> dst);

/// Derivatives with the weights 3 10 3, whose direction is right to a smaller fraction of a degree:
/// -4080..4080, 32 for one grey level a pixel. All else as sobel_x().
///
/// Source  Scharr, "Optimal operators in digital image processing", Heidelberg 2000
inline Status scharr_x(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                       ImageView<Gradient16> dst);
inline Status scharr_y(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                       ImageView<Gradient16> dst);

/// The pixel to the right less that to the left, below less above: -255..255, 2 for one grey level a pixel.
/// All else as sobel_x().
///
/// Source  the toolkit's HighPassX3 and HighPassY3 had half of it, and never wrote the last row
inline Status difference_x(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                           ImageView<Gradient16> dst);
inline Status difference_y(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                           ImageView<Gradient16> dst);

/// The strength of the gradient as |x| + |y| of sobel_x() and sobel_y(), at most 255.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     grey levels in; 8 out for an edge of one grey level a pixel along a row or a column
/// Rounding  none; above 255 it is 255
/// Border    as border says
/// Overlap   none
/// Scratch   gradient_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, scratch_too_small
/// Source    book sec. 2.6.3
inline Status sobel_magnitude(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                              ImageView<Gray8> dst);

/// The larger of |x| and |y|, at most 255, of Sobel's, Prewitt's and the central differences. All else as
/// sobel_magnitude().
///
/// Source  the toolkit's CalculateGradientImageSobel, -Prewitt and CalculateGradientImage
inline Status sobel_maximum(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                            ImageView<Gray8> dst);
inline Status prewitt_maximum(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                              ImageView<Gray8> dst);
inline Status difference_maximum(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                                 ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// Side * a + Middle * b + Side * c. Below 16 * 510 for bytes; in differences that were raised by raise()
/// below 2 * 16 * 510.
template <int Side, int Middle>
struct Smoothing {
    static constexpr int weight = 2 * Side + Middle;
    [[gnu::always_inline]] static simd::Words of(simd::Words a, simd::Words b, simd::Words c) {
        if constexpr (Side == 0)
            return b;
        else if constexpr (Side == 1 && Middle == 1)
            return a + b + c;
        else if constexpr (Side == 1 && Middle == 2)
            return a + c + (b << 1);
        else
            return (a + c) * Side + b * Middle;
    }
};

/// Differences of bytes are kept above zero by adding this.
inline constexpr std::uint16_t raised = 256;

template <class Smooth>
struct DerivativeX {
    static constexpr int rows = 3, reach = 1, byte_lines = 0, word_lines = 1;
    using Output = Gradient16;
    using Lines = FilterLines<DerivativeX>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c) const {
        lines.words().put(x, Smooth::of(simd::Words(a), simd::Words(b), simd::Words(c)));
    }
    [[gnu::always_inline]] simd::Words across(const Lines& lines, int x) const {
        return lines.words().template at<1>(x) - lines.words().template at<-1>(x);
    }
};

template <class Smooth>
struct DerivativeY {
    static constexpr int rows = 3, reach = 1, byte_lines = 0, word_lines = 1;
    using Output = Gradient16;
    using Lines = FilterLines<DerivativeY>;

    [[gnu::always_inline]] static void down(Lines& lines, int x, simd::Bytes a, simd::Bytes, simd::Bytes c) {
        lines.words().put(x, simd::Words(c) + simd::Words::all(raised) - simd::Words(a));
    }
    [[gnu::always_inline]] static simd::Words across(const Lines& lines, int x) {
        const simd::WordLine& line = lines.words();
        return Smooth::of(line.template at<-1>(x), line.template at<0>(x), line.template at<1>(x)) -
               simd::Words::all(static_cast<std::uint16_t>(raised * Smooth::weight));
    }
};

/// |x| and |y| of both derivatives, joined by Join.
template <class Smooth, class Join>
struct GradientStrength {
    static constexpr int rows = 3, reach = 1, byte_lines = 0, word_lines = 2;
    using Output = Gray8;
    using Lines = FilterLines<GradientStrength>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c) const {
        const simd::Words above(a), here(b), below(c);
        lines.template words<0>().put(x, Smooth::of(above, here, below));
        lines.template words<1>().put(x, below + simd::Words::all(raised) - above);
    }
    [[gnu::always_inline]] simd::Bytes across(const Lines& lines, int x) const {
        const simd::WordLine& smooth = lines.template words<0>();
        const simd::WordLine& steps = lines.template words<1>();
        const simd::Words along = smooth.at<1>(x) - smooth.at<-1>(x);
        const simd::Words crossing = Smooth::of(steps.at<-1>(x), steps.at<0>(x), steps.at<1>(x)) -
                                     simd::Words::all(static_cast<std::uint16_t>(raised * Smooth::weight));
        return Join::of(absolute(along), absolute(crossing)).saturate();
    }
};
struct SumOf {
    [[gnu::always_inline]] static simd::Words of(simd::Words a, simd::Words b) { return a + b; }
};
struct HigherOf {
    [[gnu::always_inline]] static simd::Words of(simd::Words a, simd::Words b) { return higher(a, b); }
};

using SobelWeights = Smoothing<1, 2>;
using PrewittWeights = Smoothing<1, 1>;
using ScharrWeights = Smoothing<3, 10>;
using NoWeights = Smoothing<0, 1>;
using SobelMagnitude = GradientStrength<SobelWeights, SumOf>;

}  // namespace kernels

constexpr std::int64_t derivative_scratch(Size size) {
    return filter_scratch<kernels::DerivativeX<kernels::SobelWeights>>(size);
}
constexpr std::int64_t gradient_scratch(Size size) { return filter_scratch<kernels::SobelMagnitude>(size); }

inline Status sobel_x(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                      ImageView<Gradient16> dst) {
    return filter_frame(kernels::DerivativeX<kernels::SobelWeights>(), src, border, scratch, dst);
}
inline Status sobel_y(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                      ImageView<Gradient16> dst) {
    return filter_frame(kernels::DerivativeY<kernels::SobelWeights>(), src, border, scratch, dst);
}
inline Status prewitt_x(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                        ImageView<Gradient16> dst) {
    return filter_frame(kernels::DerivativeX<kernels::PrewittWeights>(), src, border, scratch, dst);
}
inline Status prewitt_y(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                        ImageView<Gradient16> dst) {
    return filter_frame(kernels::DerivativeY<kernels::PrewittWeights>(), src, border, scratch, dst);
}
inline Status scharr_x(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                       ImageView<Gradient16> dst) {
    return filter_frame(kernels::DerivativeX<kernels::ScharrWeights>(), src, border, scratch, dst);
}
inline Status scharr_y(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                       ImageView<Gradient16> dst) {
    return filter_frame(kernels::DerivativeY<kernels::ScharrWeights>(), src, border, scratch, dst);
}
inline Status difference_x(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                           ImageView<Gradient16> dst) {
    return filter_frame(kernels::DerivativeX<kernels::NoWeights>(), src, border, scratch, dst);
}
inline Status difference_y(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                           ImageView<Gradient16> dst) {
    return filter_frame(kernels::DerivativeY<kernels::NoWeights>(), src, border, scratch, dst);
}

inline Status sobel_magnitude(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                              ImageView<Gray8> dst) {
    return filter_frame(kernels::SobelMagnitude(), src, border, scratch, dst);
}
inline Status sobel_maximum(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                            ImageView<Gray8> dst) {
    return filter_frame(kernels::GradientStrength<kernels::SobelWeights, kernels::HigherOf>(), src, border,
                        scratch, dst);
}
inline Status prewitt_maximum(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                              ImageView<Gray8> dst) {
    return filter_frame(kernels::GradientStrength<kernels::PrewittWeights, kernels::HigherOf>(), src, border,
                        scratch, dst);
}
inline Status difference_maximum(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                                 ImageView<Gray8> dst) {
    return filter_frame(kernels::GradientStrength<kernels::NoWeights, kernels::HigherOf>(), src, border,
                        scratch, dst);
}

namespace stages {
inline constexpr FilterStage<kernels::DerivativeX<kernels::SobelWeights>> sobel_x;
inline constexpr FilterStage<kernels::DerivativeY<kernels::SobelWeights>> sobel_y;
inline constexpr FilterStage<kernels::DerivativeX<kernels::PrewittWeights>> prewitt_x;
inline constexpr FilterStage<kernels::DerivativeY<kernels::PrewittWeights>> prewitt_y;
inline constexpr FilterStage<kernels::DerivativeX<kernels::ScharrWeights>> scharr_x;
inline constexpr FilterStage<kernels::DerivativeY<kernels::ScharrWeights>> scharr_y;
inline constexpr FilterStage<kernels::DerivativeX<kernels::NoWeights>> difference_x;
inline constexpr FilterStage<kernels::DerivativeY<kernels::NoWeights>> difference_y;
inline constexpr FilterStage<kernels::SobelMagnitude> sobel_magnitude;
inline constexpr FilterStage<kernels::GradientStrength<kernels::SobelWeights, kernels::HigherOf>>
    sobel_maximum;
inline constexpr FilterStage<kernels::GradientStrength<kernels::PrewittWeights, kernels::HigherOf>>
    prewitt_maximum;
inline constexpr FilterStage<kernels::GradientStrength<kernels::NoWeights, kernels::HigherOf>>
    difference_maximum;
}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
