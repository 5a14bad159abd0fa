// SPDX-License-Identifier: MIT
//
// The direction of the gradient at every pixel. Book sec. 2.6.3.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/filter_row.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/unroll.hpp>
#include <fovea/stream/stage.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Scratch bytes that gradient_direction() needs.
constexpr std::int64_t gradient_direction_scratch(Size size);

/// The direction in which the brightness rises: the angle of (sobel_x(), sobel_y()).
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     65536 to the turn, 0 to the right, 16384 downwards; Angle::from_raw() makes an Angle of it
/// Rounding  less than 1 (0.0055 degrees) from the angle of the two derivatives (all of them were compared
///           with real ones); exact in steps of 45 degrees. Turning the image by 90 degrees turns it exactly.
///           Where both derivatives are 0 it is 0
/// Border    as border says
/// Overlap   none: dst must not share pixels with src
/// Scratch   gradient_direction_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, scratch_too_small
/// Source    book sec. 2.6.3; a minimax polynomial of the ninth degree for the arc tangent up to 45 degrees
inline Status gradient_direction(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                                 ImageView<Direction16> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// The angle of (x, y), 65536 to the turn; both are differences of at most 1023 in magnitude.
[[gnu::always_inline]] inline simd::Words direction_of(simd::Words x, simd::Words y) {
    const simd::Words negative = simd::Words::all(std::uint16_t{0x8000});
    const simd::Words wide = absolute(x);
    const simd::Words high = absolute(y);
    const simd::Words longer = higher(wide, high);
    // The shorter by the longer in 15 bits, five at a time: below the rest, in the lowest five bits, stands
    // the quotient. The least of the two differences is the right one, because the other has wrapped. 1
    // becomes 1 - 2^-15; twice 1023 * 32 still fits.
    const simd::Words divisor = (longer << 5) - simd::Words::all(1);
    simd::Words rest = lower(wide, high) << 5;
    simd::Words quotient = simd::Words::all(0);
    simd::unroll<3>([&](auto) {
        simd::unroll<5>([&](auto) {
            rest = rest << 1;
            rest = lower(rest, rest - divisor);
        });
        quotient = (quotient << 5) | (rest & simd::Words::all(31));
        rest = rest & simd::Words::all(static_cast<std::uint16_t>(~31u));
    });
    const simd::Words ratio = (quotient << 1) + simd::Words::all(1);
    // The arc tangent in 1/4 of the unit, by Horner's rule in 1/65536 of the ratio's square. The weights are
    // those of the minimax polynomial; the lowest two were moved by 2 to make the largest error least.
    const simd::Words square = times_high(ratio, ratio);
    simd::Words sum = simd::Words::all(3553) - times_high(square, 870);
    sum = simd::Words::all(7517) - times_high(square, sum);
    sum = simd::Words::all(13779) - times_high(square, sum);
    sum = simd::Words::all(41714) - times_high(square, sum);
    simd::Words angle = (times_high(ratio, sum) + simd::Words::all(2)) >> 2;
    // Mirrored about 45, 90 and 0 degrees.
    const auto pick = [](simd::Words mask, simd::Words a, simd::Words b) { return (a & mask) | (b & ~mask); };
    angle = pick(at_least(wide, high), angle, simd::Words::all(16384) - angle);
    angle = pick(at_least(x, negative), simd::Words::all(32768) - angle, angle);
    angle = pick(at_least(y, negative), simd::Words::all(0) - angle, angle);
    return angle & at_least(longer, simd::Words::all(1));
}

struct GradientDirection {
    static constexpr int rows = 3, reach = 1, byte_lines = 0, word_lines = 2;
    using Output = Direction16;
    using Lines = FilterLines<GradientDirection>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c) const {
        const simd::Words above(a), here(b), below(c);
        lines.words<0>().put(x, SobelWeights::of(above, here, below));
        lines.words<1>().put(x, below + simd::Words::all(raised) - above);
    }
    [[gnu::always_inline]] simd::Words across(const Lines& lines, int x) const {
        const simd::WordLine& smooth = lines.words<0>();
        const simd::WordLine& steps = lines.words<1>();
        return direction_of(smooth.at<1>(x) - smooth.at<-1>(x),
                            SobelWeights::of(steps.at<-1>(x), steps.at<0>(x), steps.at<1>(x)) -
                                simd::Words::all(raised * SobelWeights::weight));
    }
};

}  // namespace kernels

constexpr std::int64_t gradient_direction_scratch(Size size) {
    return filter_scratch<kernels::GradientDirection>(size);
}

inline Status gradient_direction(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                                 ImageView<Direction16> dst) {
    return filter_frame(kernels::GradientDirection(), src, border, scratch, dst);
}

namespace stages {
inline constexpr FilterStage<kernels::GradientDirection> gradient_direction;
}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
