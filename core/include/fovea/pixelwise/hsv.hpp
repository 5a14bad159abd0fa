// SPDX-License-Identifier: MIT
//
// Colour as hue, saturation and value. Book sec. 2.3.3.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/convert_frame.hpp>
#include <fovea/simd/interleave.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/ratio.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Hues around the circle: steps of 2 degrees.
inline constexpr int hue_turn = 180;

/// A colour as hue, saturation and value. Value is the largest of red, green and blue, saturation 255 (value
/// - smallest) / value, hue 30 (green - blue) / (value - smallest) if red is the largest, 60 + 30 (blue -
/// red) / ... if green is, else 120 + 30 (red - green) / ...; of equal ones red goes before green, and green
/// before blue. Gray has hue 0, black also saturation 0.
///
/// Units     hue 0..179 in steps of 2 degrees, saturation and value 0..255
/// Rounding  nearest, ties up; hue then modulo 180
/// Source    book sec. 2.3.3. The toolkit truncates, so that saturation 255 does not occur and yellow is 29
constexpr Hsv888 hsv_of(Rgb888 colour);

/// The inverse of hsv_of(), as far as 8 bits can say: range = value saturation / 255, the smallest is value -
/// range, the middle one value less the share of the range that hue says. A hue of 180 and more counts on
/// round the circle.
///
/// Rounding  the range, and the share of it that is taken off: nearest, ties up; the largest product is 255^2
/// Accuracy  after hsv_of() each of red, green and blue comes back within 4 levels, tried for all colours;
///           value and smallest, so all pure and gray colours, come back exactly
constexpr Rgb888 rgb_of(Hsv888 colour);

inline namespace FOVEA_ISA {

/// hsv_of() of every pixel.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch
/// Source   book sec. 2.3.3
inline Status to_hsv(ImageView<const Rgb888> src, ImageView<Hsv888> dst);

/// rgb_of() of every pixel. All else as to_hsv().
inline Status to_rgb(ImageView<const Hsv888> src, ImageView<Rgb888> dst);

/// The saturation of hsv_of() alone. All else as to_hsv().
inline Status to_saturation(ImageView<const Rgb888> src, ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// 15 * 2^22 / i rounded up; 0 for 0. A product with it is too large by less than the product of the other
/// factors and 2^-22, which for those below is less than what an exact quotient can be under a whole or a
/// half number, 1/510.
struct Reciprocals {
    std::uint32_t of[256];
};
inline constexpr int reciprocal_bits = 22;
constexpr Reciprocals reciprocals() {
    Reciprocals made{};
    for (std::uint32_t i = 1; i < 256; ++i) made.of[i] = ((15u << reciprocal_bits) + i - 1) / i;
    return made;
}
inline constexpr Reciprocals fifteen_over = reciprocals();

/// 255 part / whole to the nearest, ties up; the largest product is 255 * 2^22 and a few thousand.
constexpr std::uint8_t saturation_of(std::uint32_t part, std::uint32_t whole) {
    return static_cast<std::uint8_t>((part * 17 * fifteen_over.of[whole] + (1u << (reciprocal_bits - 1))) >>
                                     reciprocal_bits);
}

/// 30 (a - b) / whole to the nearest, ties up: -30 to 30.
constexpr int sixth_of_hue(int a, int b, std::uint32_t whole) {
    // Ties of a negative quotient go toward zero: a little less than a half is added to its magnitude, more
    // than the product may be too large, and less than what may be missing to a tie.
    constexpr std::uint32_t half = 1u << (reciprocal_bits - 1);
    constexpr std::uint32_t little = 1u << (reciprocal_bits - 10);
    const std::uint32_t twice = 2 * fifteen_over.of[whole];
    return a >= b ? static_cast<int>((static_cast<std::uint32_t>(a - b) * twice + half) >> reciprocal_bits)
                  : -static_cast<int>((static_cast<std::uint32_t>(b - a) * twice + half - little) >>
                                      reciprocal_bits);
}

}  // namespace detail

constexpr Hsv888 hsv_of(Rgb888 colour) {
    const int red = colour.red;
    const int green = colour.green;
    const int blue = colour.blue;
    const int value = maximum(red, maximum(green, blue));
    const auto range = static_cast<std::uint32_t>(value - minimum(red, minimum(green, blue)));
    int hue = 0;
    if (red == value)
        hue = detail::sixth_of_hue(green, blue, range);
    else if (green == value)
        hue = hue_turn / 3 + detail::sixth_of_hue(blue, red, range);
    else
        hue = 2 * hue_turn / 3 + detail::sixth_of_hue(red, green, range);
    if (hue < 0) hue += hue_turn;
    return {static_cast<std::uint8_t>(hue), detail::saturation_of(range, static_cast<std::uint32_t>(value)),
            static_cast<std::uint8_t>(value)};
}

constexpr Rgb888 rgb_of(Hsv888 colour) {
    constexpr int sixth = hue_turn / 6;
    const int hue = colour.hue < hue_turn ? colour.hue : colour.hue - hue_turn;
    const int along = hue % sixth;
    const bool rising = hue / sixth % 2 == 0;
    const int range = (colour.value * colour.saturation + 127) / 255;
    const int off = (range * (rising ? sixth - along : along) + sixth / 2) / sixth;
    const auto low = static_cast<std::uint8_t>(colour.value - range);
    const auto middle = static_cast<std::uint8_t>(colour.value - off);
    switch (hue / sixth) {
        case 0: return {colour.value, middle, low};
        case 1: return {middle, colour.value, low};
        case 2: return {low, colour.value, middle};
        case 3: return {low, middle, colour.value};
        case 4: return {middle, low, colour.value};
        default: return {colour.value, low, middle};
    }
}

inline namespace FOVEA_ISA {

namespace kernels {

/// Vectors divide bit by bit; a processor without them looks the reciprocals up.
inline constexpr bool hsv_by_lanes = simd::lanes > 4;

[[gnu::always_inline]] inline simd::Bytes saturation_of(simd::Bytes range, simd::Bytes value) {
    const simd::Ratio ratio = simd::ratio_of<8>(range, value);
    const simd::Bytes up = at_least(ratio.rest, value - ratio.rest);
    return (ratio.quotient - up) & at_least(value, simd::Bytes::all(1));
}

[[gnu::always_inline]] inline simd::Bytes choose(simd::Bytes mask, simd::Bytes where_set,
                                                 simd::Bytes where_not) {
    return where_not ^ ((where_set ^ where_not) & mask);
}

/// hsv_of() of every lane.
[[gnu::always_inline]] inline simd::ByteTriples hsv_of_lanes(const simd::ByteTriples& colour) {
    using simd::Bytes;
    const Bytes red = colour.first;
    const Bytes green = colour.second;
    const Bytes blue = colour.third;
    const Bytes value = higher(red, higher(green, blue));
    const Bytes range = value - lower(red, lower(green, blue));
    const Bytes is_red = at_least(red, value);
    const Bytes is_green = at_least(green, value);
    const Bytes a = choose(is_red, green, choose(is_green, blue, red));
    const Bytes b = choose(is_red, blue, choose(is_green, red, green));
    const Bytes forward = at_least(a, b);
    // 30 = 2 * 15.
    const simd::Ratio ratio = twice(simd::ratio_of<4>(higher(a, b) - lower(a, b), range), range);
    const Bytes left = range - ratio.rest;
    const Bytes up = choose(forward, at_least(ratio.rest, left), ~at_least(left, ratio.rest));
    const Bytes sixth = ratio.quotient - up;
    // Backwards from red is backwards from a whole turn, but for nothing.
    const Bytes turn = Bytes::all(hue_turn);
    const Bytes start = choose(is_red, ~forward & at_least(sixth, Bytes::all(1)) & turn,
                               choose(is_green, Bytes::all(hue_turn / 3), Bytes::all(2 * hue_turn / 3)));
    const Bytes hue = start + ((sixth ^ ~forward) - ~forward);
    return {hue & at_least(range, Bytes::all(1)), saturation_of(range, value), value};
}

/// to_hsv() of one row.
inline void hsv_row(const Rgb888* src, int width, Hsv888* dst) {
    if constexpr (hsv_by_lanes) {
        simd::for_each_step<3, 3>(&src->red, width, &dst->hue,
                                  [](const std::uint8_t* from, std::uint8_t* to) {
                                      simd::store_triples(hsv_of_lanes(simd::load_triples(from)), to);
                                  });
    } else {
        for (int x = 0; x < width; ++x) dst[x] = hsv_of(src[x]);
    }
}

/// to_saturation() of one row.
inline void saturation_row(const Rgb888* src, int width, Gray8* dst) {
    if constexpr (hsv_by_lanes) {
        simd::for_each_step<3, 1>(&src->red, width, dst, [](const std::uint8_t* from, std::uint8_t* to) {
            const simd::ByteTriples c = simd::load_triples(from);
            const simd::Bytes value = higher(c.first, higher(c.second, c.third));
            const simd::Bytes range = value - lower(c.first, lower(c.second, c.third));
            saturation_of(range, value).store(to);
        });
    } else {
        for (int x = 0; x < width; ++x) dst[x] = hsv_of(src[x]).saturation;
    }
}

/// w / 255 rounded down, for w up to 65279 so that no sum overflows.
[[gnu::always_inline]] inline simd::Words over_255(simd::Words w) {
    return (w + (w >> 8) + simd::Words::all(1)) >> 8;
}

/// rgb_of() of every lane.
[[gnu::always_inline]] inline simd::ByteTriples rgb_of_lanes(const simd::ByteTriples& colour) {
    using simd::Bytes;
    using simd::Words;
    constexpr std::uint8_t sixth = hue_turn / 6;
    const Bytes step = Bytes::all(sixth);
    const Bytes value = colour.third;
    const Bytes hue = colour.first - (at_least(colour.first, Bytes::all(hue_turn)) & Bytes::all(hue_turn));
    const Bytes from1 = at_least(hue, step);
    const Bytes from2 = at_least(hue, Bytes::all(2 * sixth));
    const Bytes from3 = at_least(hue, Bytes::all(3 * sixth));
    const Bytes from4 = at_least(hue, Bytes::all(4 * sixth));
    const Bytes from5 = at_least(hue, Bytes::all(5 * sixth));
    const Bytes along =
        hue - (step & from1) - (step & from2) - (step & from3) - (step & from4) - (step & from5);
    const Bytes falling = from1 ^ from2 ^ from3 ^ from4 ^ from5;
    const Words range = over_255(Words(value) * Words(colour.second) + Words::all(127));
    // Over 30 as over 2 and 15, and over 15 as 17 over 255.
    const Words halves = (range * Words(choose(falling, along, step - along)) + Words::all(sixth / 2)) >> 1;
    const Bytes low = value - range.narrow();
    const Bytes middle = value - over_255(halves * 17).narrow();
    // In pairs of sixths each colour is in turn the largest, middle, smallest.
    const Bytes red = choose(~from1 | from5, value, choose(~from2 | from4, middle, low));
    const Bytes green = choose(from1 & ~from3, value, choose(from4, low, middle));
    const Bytes blue = choose(from3 & ~from5, value, choose(from2, middle, low));
    return {red, green, blue};
}

/// to_rgb() of one row of hues, saturations and values.
inline void rgb_from_hsv_row(const Hsv888* src, int width, Rgb888* dst) {
    if constexpr (hsv_by_lanes) {
        simd::for_each_step<3, 3>(&src->hue, width, &dst->red,
                                  [](const std::uint8_t* from, std::uint8_t* to) {
                                      simd::store_triples(rgb_of_lanes(simd::load_triples(from)), to);
                                  });
    } else {
        for (int x = 0; x < width; ++x) dst[x] = rgb_of(src[x]);
    }
}

}  // namespace kernels

inline Status to_hsv(ImageView<const Rgb888> src, ImageView<Hsv888> dst) {
    return detail::convert_frame(src, dst, kernels::hsv_row);
}

inline Status to_rgb(ImageView<const Hsv888> src, ImageView<Rgb888> dst) {
    return detail::convert_frame(src, dst, kernels::rgb_from_hsv_row);
}

inline Status to_saturation(ImageView<const Rgb888> src, ImageView<Gray8> dst) {
    return detail::convert_frame(src, dst, kernels::saturation_row);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
