// SPDX-License-Identifier: MIT
//
// Point operators of gray pixels as stages of a stream, and colour to gray. Other colours are in
// pixelwise/colour_stages.hpp.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/arithmetic.hpp>
#include <fovea/pixelwise/depth.hpp>
#include <fovea/pixelwise/lookup_table.hpp>
#include <fovea/pixelwise/point_rows.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/pixelwise/to_gray.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lookup.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace stages {

// ---- Thresholds -------------------------------------------------------------------

/// A threshold with a level.
template <class Operation>
struct LevelStage {
    using Input = Gray8;
    using Output = Gray8;
    Gray8 level;
    void row(const Gray8* src, int width, Gray8* dst) const {
        kernels::point_row(src, width, Operation(level), dst);
    }
};
using threshold = LevelStage<kernels::Threshold>;
using threshold_inverse = LevelStage<kernels::ThresholdInverse>;
using threshold_filter = LevelStage<kernels::ThresholdFilter>;
using threshold_filter_inverse = LevelStage<kernels::ThresholdFilterInverse>;

struct threshold_range {
    using Input = Gray8;
    using Output = Gray8;
    Gray8 low;
    Gray8 high;
    constexpr bool valid() const { return low <= high; }
    void row(const Gray8* src, int width, Gray8* dst) const {
        kernels::point_row(src, width, kernels::ThresholdRange(low, high), dst);
    }
};

// ---- Levels -----------------------------------------------------------------------

struct Invert {
    using Input = Gray8;
    using Output = Gray8;
    static void row(const Gray8* src, int width, Gray8* dst) {
        kernels::point_row(src, width, kernels::Invert(), dst);
    }
};
inline constexpr Invert invert;

/// Any function of a level. The table outlives the stream; affine(), gamma() and logarithm() are
/// affine_table(), gamma_table() and logarithm_table() applied.
class apply_lut {
public:
    using Input = Gray8;
    using Output = Gray8;
    explicit apply_lut(const LookupTable& table) : lookup_(table.levels) {}
    explicit apply_lut(const LookupTable&&) = delete;

    void row(const Gray8* src, int width, Gray8* dst) const { lookup_.row(src, width, dst); }

private:
    simd::Lookup lookup_;
};

/// widen(), narrow() and narrow_about_128(): from gray to Gray16, Gradient16 or Sum32 and back.
template <class Wide>
struct widen {
    using Input = Gray8;
    using Output = Wide;
    static void row(const Gray8* src, int width, Wide* dst) { kernels::widen_row(src, width, dst); }
};
template <class Wide>
struct narrow {
    using Input = Wide;
    using Output = Gray8;
    int shift;
    constexpr bool valid() const { return kernels::is_narrowing(shift, sizeof(Wide)); }
    void row(const Wide* src, int width, Gray8* dst) const { kernels::narrow_row(src, width, shift, 0, dst); }
};
struct narrow_about_128 {
    using Input = Gradient16;
    using Output = Gray8;
    int shift;
    constexpr bool valid() const { return kernels::is_narrowing(shift, sizeof(Gradient16)); }
    void row(const Gradient16* src, int width, Gray8* dst) const {
        kernels::narrow_row(src, width, shift, 128, dst);
    }
};

// ---- With a second image ----------------------------------------------------------

/// The operators of pixelwise/arithmetic.hpp, with what passes as the first image and one at hand as the
/// second, such as a background: of the size of the stream's, or size_mismatch is the answer.
template <class Operation>
struct PairStage {
    using Input = Gray8;
    using Output = Gray8;
    ImageView<const Gray8> other;
    Status begin(Size size) const { return other.size() == size ? Status::ok : Status::size_mismatch; }
    void row(const Gray8* src, int width, int y, Gray8* dst) const {
        kernels::point_row(src, other.row(y), width, Operation(), dst);
    }
};
using add = PairStage<kernels::Add>;
using add_saturated = PairStage<kernels::AddSaturated>;
using subtract = PairStage<kernels::Subtract>;
using subtract_saturated = PairStage<kernels::SubtractSaturated>;
using absolute_difference = PairStage<kernels::AbsoluteDifference>;
using average = PairStage<kernels::Average>;
using pixel_minimum = PairStage<kernels::PixelMinimum>;
using pixel_maximum = PairStage<kernels::PixelMaximum>;
using bitwise_and = PairStage<kernels::BitwiseAnd>;
using bitwise_or = PairStage<kernels::BitwiseOr>;
using bitwise_xor = PairStage<kernels::BitwiseXor>;

/// blend() with the weight of the image at hand, 0 to whole_weight.
struct blend {
    using Input = Gray8;
    using Output = Gray8;
    ImageView<const Gray8> other;
    int weight;
    constexpr bool valid() const { return weight >= 0 && weight <= whole_weight; }
    Status begin(Size size) const { return other.size() == size ? Status::ok : Status::size_mismatch; }
    void row(const Gray8* src, int width, int y, Gray8* dst) const {
        kernels::point_row(src, other.row(y), width, kernels::Blend{weight}, dst);
    }
};

// ---- Colour to gray ---------------------------------------------------------------

/// to_gray() of colour, and of what cameras send.
struct GrayFromRgb {
    using Input = Rgb888;
    using Output = Gray8;
    static void row(const Rgb888* src, int width, Gray8* dst) { kernels::gray_row(src, width, dst); }
};
/// to_gray_fast().
struct FastGrayFromRgb {
    using Input = Rgb888;
    using Output = Gray8;
    static void row(const Rgb888* src, int width, Gray8* dst) { kernels::fast_gray_row(src, width, dst); }
};
struct GrayFromYuyv {
    using Input = Yuyv;
    using Output = Gray8;
    static void row(const Yuyv* src, int width, Gray8* dst) {
        kernels::first_of_pairs_row(&src->luma, width, dst);
    }
};
struct GrayFromUyvy {
    using Input = Uyvy;
    using Output = Gray8;
    static void row(const Uyvy* src, int width, Gray8* dst) {
        kernels::second_of_pairs_row(&src->chroma, width, dst);
    }
};
inline constexpr GrayFromRgb gray_from_rgb;
inline constexpr FastGrayFromRgb fast_gray_from_rgb;
inline constexpr GrayFromYuyv gray_from_yuyv;
inline constexpr GrayFromUyvy gray_from_uyvy;

}  // namespace stages
}  // namespace FOVEA_ISA
}  // namespace fovea
