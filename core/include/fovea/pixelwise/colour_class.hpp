// SPDX-License-Identifier: MIT
//
// Colour segmentation: the pixels whose hue, saturation and value lie within bounds. Book sec. 2.8.2.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/convert_frame.hpp>
#include <fovea/pixelwise/hsv.hpp>
#include <fovea/simd/interleave.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Bounds of a colour, all of them inclusive.
struct HsvRange {
    std::uint8_t hue_first = 0;   ///< 0..179; where it is above hue_last, the range goes round through red
    std::uint8_t hue_last = 179;  ///< 0..179
    std::uint8_t saturation_low = 0;  ///< a higher one leaves out what is nearly gray, whose hue is noise
    std::uint8_t saturation_high = 255;
    std::uint8_t value_low = 0;  ///< a higher one leaves out what is nearly black, whose saturation is noise
    std::uint8_t value_high = 255;

    constexpr bool valid() const {
        return hue_first < hue_turn && hue_last < hue_turn && saturation_low <= saturation_high &&
               value_low <= value_high;
    }
    /// Whether a colour belongs. A hue of 180 and more belongs nowhere.
    constexpr bool contains(Hsv888 colour) const {
        const bool after = colour.hue >= hue_first;
        const bool before = colour.hue <= hue_last;
        return (hue_first <= hue_last ? after && before : after || before) && colour.hue < hue_turn &&
               colour.saturation >= saturation_low && colour.saturation <= saturation_high &&
               colour.value >= value_low && colour.value <= value_high;
    }
};

/// A colour by the middle of its hues: its name in a configuration, and bounds as people state them.
struct ColourClass {
    const char* name;
    int hue;            ///< 0..179
    int hue_tolerance;  ///< to either side; 90 and more allow every hue
    int saturation_low;
    int saturation_high;
    int value_low;
    int value_high;

    /// The bounds. Numbers outside a byte are held at its ends.
    constexpr HsvRange range() const;
};

/// Colours of common things under white light, to begin with. Everything else is a matter of the lamp and the
/// camera.
///
/// Source  the toolkit's built-in parameters
inline constexpr ColourClass colour_classes[] = {
    {"skin", 1, 16, 20, 128, 25, 255},     {"yellow", 40, 26, 36, 255, 25, 255},
    {"orange", 21, 15, 128, 255, 25, 255}, {"red", 0, 10, 140, 255, 25, 255},
    {"blue", 113, 13, 149, 255, 25, 255},  {"green", 65, 20, 100, 255, 25, 255},
    {"white", 90, 90, 0, 120, 200, 255},
};

inline namespace FOVEA_ISA {

/// 255 where a pixel's hue, saturation and value lie within the range, else 0.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch, bad_argument for a hue above 179 or a low bound above its high one
/// Source   book sec. 2.8.2; the toolkit's FilterHSV2(), and with ColourClass::range() its FilterHSV()
inline Status hsv_range(ImageView<const Hsv888> src, const HsvRange& range, ImageView<Gray8> dst);

/// The same straight from a colour image, without an image of hues between. All else as above.
///
/// Source  the toolkit's FilterColor(), which makes a frame of hues for every call
inline Status hsv_range(ImageView<const Rgb888> src, const HsvRange& range, ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

constexpr HsvRange ColourClass::range() const {
    HsvRange range;
    if (hue_tolerance < hue_turn / 2) {
        range.hue_first = static_cast<std::uint8_t>(floor_modulo(hue - hue_tolerance, hue_turn));
        range.hue_last = static_cast<std::uint8_t>(floor_modulo(hue + hue_tolerance, hue_turn));
    }
    range.saturation_low = saturate_cast<std::uint8_t>(saturation_low);
    range.saturation_high = saturate_cast<std::uint8_t>(saturation_high);
    range.value_low = saturate_cast<std::uint8_t>(value_low);
    range.value_high = saturate_cast<std::uint8_t>(value_high);
    return range;
}

inline namespace FOVEA_ISA {

namespace kernels {

/// HsvRange::contains() of every lane: 255 or 0.
class HsvRangeLanes {
public:
    explicit HsvRangeLanes(const HsvRange& range)
        : hue_first_(simd::Bytes::all(range.hue_first)),
          hue_last_(simd::Bytes::all(range.hue_last)),
          either_(simd::Bytes::all(range.hue_first > range.hue_last ? 255 : 0)),
          saturation_low_(simd::Bytes::all(range.saturation_low)),
          saturation_high_(simd::Bytes::all(range.saturation_high)),
          value_low_(simd::Bytes::all(range.value_low)),
          value_high_(simd::Bytes::all(range.value_high)) {}

    [[gnu::always_inline]] simd::Bytes contains(const simd::ByteTriples& colour) const {
        const simd::Bytes after = at_least(colour.first, hue_first_);
        const simd::Bytes before = at_least(hue_last_, colour.first);
        const simd::Bytes hue = (after & before) | ((after | before) & either_);
        return hue & at_least(simd::Bytes::all(hue_turn - 1), colour.first) &
               at_least(colour.second, saturation_low_) & at_least(saturation_high_, colour.second) &
               at_least(colour.third, value_low_) & at_least(value_high_, colour.third);
    }

private:
    simd::Bytes hue_first_;
    simd::Bytes hue_last_;
    simd::Bytes either_;
    simd::Bytes saturation_low_;
    simd::Bytes saturation_high_;
    simd::Bytes value_low_;
    simd::Bytes value_high_;
};

/// hsv_range() of one row of hues.
inline void hsv_range_row(const Hsv888* src, int width, const HsvRange& range, Gray8* dst) {
    const HsvRangeLanes lanes(range);
    simd::for_each_step<3, 1>(&src->hue, width, dst, [&](const std::uint8_t* from, std::uint8_t* to) {
        lanes.contains(simd::load_triples(from)).store(to);
    });
}

/// hsv_range() of one row of colours.
inline void hsv_range_row(const Rgb888* src, int width, const HsvRange& range, Gray8* dst) {
    if constexpr (hsv_by_lanes) {
        const HsvRangeLanes lanes(range);
        simd::for_each_step<3, 1>(&src->red, width, dst, [&](const std::uint8_t* from, std::uint8_t* to) {
            lanes.contains(hsv_of_lanes(simd::load_triples(from))).store(to);
        });
    } else {
        for (int x = 0; x < width; ++x) dst[x] = range.contains(hsv_of(src[x])) ? 255 : 0;
    }
}

template <class Pixel>
Status hsv_range_frame(ImageView<const Pixel> src, const HsvRange& range, ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (!range.valid()) return Status::bad_argument;
    return detail::convert_frame(
        src, dst, [&](const Pixel* from, int width, Gray8* to) { hsv_range_row(from, width, range, to); });
}

}  // namespace kernels

inline Status hsv_range(ImageView<const Hsv888> src, const HsvRange& range, ImageView<Gray8> dst) {
    return kernels::hsv_range_frame(src, range, dst);
}

inline Status hsv_range(ImageView<const Rgb888> src, const HsvRange& range, ImageView<Gray8> dst) {
    return kernels::hsv_range_frame(src, range, dst);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
