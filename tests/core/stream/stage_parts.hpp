// SPDX-License-Identifier: MIT
//
// Every stage beside the function that does the same with a frame, for pipelines drawn by lot. Host tests
// only.
#pragma once

#include <cstdint>
#include <tuple>

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/filter/box.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/filter/gaussian_sigma.hpp>
#include <fovea/filter/laplacian.hpp>
#include <fovea/filter/median.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/morphology/morphology_stages.hpp>
#include <fovea/morphology/shaped_morphology.hpp>
#include <fovea/morphology/structuring_element.hpp>
#include <fovea/morphology/top_hat.hpp>
#include <fovea/pixelwise/colour_stages.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/segment/adaptive_threshold.hpp>

namespace fovea::test {

using View = ImageView<const Gray8>;
using Scratch = Span<std::uint8_t>;

/// What parameters are drawn from; the same for a stage and for its function.
struct Drawn {
    View other;
    LookupTable table;
    Gray8 low = 0;
    Gray8 high = 0;
    int weight = 0;
    int shift = 0;
    int side = 1;
    Size element;
    StructuringElement shape;
    HsvRange range;

    Drawn(Random& random, View second)
        : other(second),
          table(gamma_table(random.between(min_gamma, 300))),
          low(static_cast<Gray8>(random.between(0, 255))),
          high(static_cast<Gray8>(random.between(low, 255))),
          weight(random.between(0, whole_weight)),
          shift(random.between(0, 15)),
          side(odd(random, 9)),
          element{odd(random, 11), odd(random, 9)} {
        const Point end{random.between(-3, 3), random.between(-4, 4)};
        shape = random.between(0, 1) == 0 ? StructuringElement::line(end)
                                          : StructuringElement::disc(odd(random, 13));
        range.hue_first = static_cast<std::uint8_t>(random.between(0, 179));
        range.hue_last = static_cast<std::uint8_t>(random.between(0, 179));
        range.saturation_low = low;
        range.value_high = high;
    }
    YuvRange yuv() const { return low % 2 == 0 ? YuvRange::full : YuvRange::narrow; }
    ColourChannel channel() const { return static_cast<ColourChannel>(low % 3); }

private:
    static int odd(Random& random, int most) { return random.between(0, most / 2) * 2 + 1; }
};

// ---- Forms of functions -------------------------------------------------------------------

template <auto& Stage, class Out, Status (*Function)(View, Border, Scratch, ImageView<Out>)>
struct FilterPart {
    static auto stage(const Drawn&) { return Stage; }
    static Status frame(const Drawn&, View src, Border border, Scratch scratch, ImageView<Out> dst) {
        return Function(src, border, scratch, dst);
    }
};
template <class Stage, Status (*Function)(View, Gray8, ImageView<Gray8>)>
struct LevelPart {
    static Stage stage(const Drawn& d) { return {d.high}; }
    static Status frame(const Drawn& d, View src, Border, Scratch, ImageView<Gray8> dst) {
        return Function(src, d.high, dst);
    }
};
template <class Stage, Status (*Function)(View, View, ImageView<Gray8>)>
struct PairPart {
    static Stage stage(const Drawn& d) { return {d.other}; }
    static Status frame(const Drawn& d, View src, Border, Scratch, ImageView<Gray8> dst) {
        return Function(src, d.other, dst);
    }
};
template <class Stage, Status (*Function)(View, Size, Scratch, ImageView<Gray8>)>
struct ElementPart {
    static Stage stage(const Drawn& d) { return {d.element}; }
    static Status frame(const Drawn& d, View src, Border, Scratch scratch, ImageView<Gray8> dst) {
        return Function(src, d.element, scratch, dst);
    }
};
template <class Stage, Status (*Function)(View, const StructuringElement&, Scratch, ImageView<Gray8>)>
struct ShapePart {
    static Stage stage(const Drawn& d) { return Stage{d.shape}; }
    static Status frame(const Drawn& d, View src, Border, Scratch scratch, ImageView<Gray8> dst) {
        return Function(src, d.shape, scratch, dst);
    }
};
template <class Stage, Status (*Function)(View, int, int, Scratch, ImageView<Gray8>)>
struct AdaptivePart {
    static Stage stage(const Drawn& d) { return {d.side, d.low - 128}; }
    static Status frame(const Drawn& d, View src, Border, Scratch scratch, ImageView<Gray8> dst) {
        return Function(src, d.side, d.low - 128, scratch, dst);
    }
};
template <auto& Stage, class In, class Out, Status (*Function)(ImageView<const In>, ImageView<Out>)>
struct ConversionPart {
    static auto stage(const Drawn&) { return Stage; }
    static Status frame(const Drawn&, ImageView<const In> src, Border, Scratch, ImageView<Out> dst) {
        return Function(src, dst);
    }
};

// ---- Forms of their own -------------------------------------------------------------------

struct BoxPart {
    static auto stage(const Drawn& d) { return stages::box{d.element}; }
    static Status frame(const Drawn& d, View src, Border border, Scratch scratch, ImageView<Gray8> dst) {
        return box(src, d.element, border, scratch, dst);
    }
};
struct GaussianPart {
    static SubPixel sigma(const Drawn& d) { return SubPixel::from_ratio(d.side + 1, 2); }
    static auto stage(const Drawn& d) { return stages::gaussian{*gaussian_taps(sigma(d))}; }
    static Status frame(const Drawn& d, View src, Border border, Scratch scratch, ImageView<Gray8> dst) {
        return gaussian(src, sigma(d), border, scratch, dst);
    }
};
struct RangePart {
    static auto stage(const Drawn& d) { return stages::threshold_range{d.low, d.high}; }
    static Status frame(const Drawn& d, View src, Border, Scratch, ImageView<Gray8> dst) {
        return threshold_range(src, d.low, d.high, dst);
    }
};
struct LookupPart {
    static auto stage(const Drawn& d) { return stages::apply_lut{d.table}; }
    static Status frame(const Drawn& d, View src, Border, Scratch, ImageView<Gray8> dst) {
        return apply_lut(src, d.table, dst);
    }
};
struct BlendPart {
    static auto stage(const Drawn& d) { return stages::blend{d.other, d.weight}; }
    static Status frame(const Drawn& d, View src, Border, Scratch, ImageView<Gray8> dst) {
        return blend(src, d.other, d.weight, dst);
    }
};
template <class Wide>
struct WidenPart {
    static auto stage(const Drawn&) { return stages::widen<Wide>{}; }
    static Status frame(const Drawn&, View src, Border, Scratch, ImageView<Wide> dst) {
        return widen(src, dst);
    }
};
template <class Wide>
struct NarrowPart {
    static auto stage(const Drawn& d) { return stages::narrow<Wide>{d.shift}; }
    static Status frame(const Drawn& d, ImageView<const Wide> src, Border, Scratch, ImageView<Gray8> dst) {
        return narrow(src, d.shift, dst);
    }
};
struct NarrowAboutPart {
    static auto stage(const Drawn& d) { return stages::narrow_about_128{d.shift}; }
    static Status frame(const Drawn& d, ImageView<const Gradient16> src, Border, Scratch,
                        ImageView<Gray8> dst) {
        return narrow_about_128(src, d.shift, dst);
    }
};
struct PlanePart {
    static auto stage(const Drawn& d) { return stages::extract_plane{d.channel()}; }
    static Status frame(const Drawn& d, ImageView<const Rgb888> src, Border, Scratch, ImageView<Gray8> dst) {
        return extract_plane(src, d.channel(), dst);
    }
};
template <class Pixel>
struct HuesPart {
    static auto stage(const Drawn& d) { return stages::hsv_range<Pixel>{d.range}; }
    static Status frame(const Drawn& d, ImageView<const Pixel> src, Border, Scratch, ImageView<Gray8> dst) {
        return hsv_range(src, d.range, dst);
    }
};
template <class Stage, class In, class Out, Status (*Function)(ImageView<const In>, YuvRange, ImageView<Out>)>
struct YuvPart {
    static Stage stage(const Drawn& d) { return {d.yuv()}; }
    static Status frame(const Drawn& d, ImageView<const In> src, Border, Scratch, ImageView<Out> dst) {
        return Function(src, d.yuv(), dst);
    }
};

// ---- All of them --------------------------------------------------------------------------

/// From gray to gray.
using GrayParts = std::tuple<
    FilterPart<stages::gaussian_3x3, Gray8, gaussian_3x3>, ElementPart<stages::erode, erode>,
    PairPart<stages::add, add>, FilterPart<stages::sobel_magnitude, Gray8, sobel_magnitude>,
    LevelPart<stages::threshold, threshold>, ElementPart<stages::opening, opening>,
    PairPart<stages::absolute_difference, absolute_difference>, BoxPart,
    ElementPart<stages::top_hat, top_hat>, PairPart<stages::subtract, subtract>,
    FilterPart<stages::gaussian_5x5, Gray8, gaussian_5x5>, ShapePart<stages::opening_shaped, opening>,
    RangePart, ElementPart<stages::morphological_gradient, morphological_gradient>,
    PairPart<stages::add_saturated, add_saturated>, FilterPart<stages::median_3x3, Gray8, median_3x3>,
    ElementPart<stages::dilate, dilate>, ConversionPart<stages::invert, Gray8, Gray8, invert>, GaussianPart,
    ShapePart<stages::erode_shaped, erode>, PairPart<stages::subtract_saturated, subtract_saturated>,
    FilterPart<stages::box_3x3, Gray8, box_3x3>, LookupPart, ElementPart<stages::black_hat, black_hat>,
    FilterPart<stages::sobel_maximum, Gray8, sobel_maximum>,
    LevelPart<stages::threshold_inverse, threshold_inverse>,
    AdaptivePart<stages::adaptive_threshold, adaptive_threshold>, PairPart<stages::average, average>,
    ShapePart<stages::dilate_shaped, dilate>, PairPart<stages::pixel_minimum, pixel_minimum>,
    ElementPart<stages::closing, closing>, FilterPart<stages::box_5x5, Gray8, box_5x5>, BlendPart,
    AdaptivePart<stages::adaptive_threshold_inverse, adaptive_threshold_inverse>,
    FilterPart<stages::prewitt_maximum, Gray8, prewitt_maximum>,
    PairPart<stages::pixel_maximum, pixel_maximum>, LevelPart<stages::threshold_filter, threshold_filter>,
    ShapePart<stages::closing_shaped, closing>, PairPart<stages::bitwise_and, bitwise_and>,
    FilterPart<stages::median_5x5, Gray8, median_5x5>, PairPart<stages::bitwise_or, bitwise_or>,
    YuvPart<stages::gray_from_luma, Gray8, Gray8, to_gray>,
    LevelPart<stages::threshold_filter_inverse, threshold_filter_inverse>,
    FilterPart<stages::difference_maximum, Gray8, difference_maximum>,
    PairPart<stages::bitwise_xor, bitwise_xor>>;

/// From other pixels to gray.
using HeadParts =
    std::tuple<ConversionPart<stages::gray_from_rgb, Rgb888, Gray8, to_gray>,
               ConversionPart<stages::gray_from_yuyv, Yuyv, Gray8, to_gray>, NarrowPart<Gray16>,
               ConversionPart<stages::fast_gray_from_rgb, Rgb888, Gray8, to_gray_fast>, HuesPart<Rgb888>,
               ConversionPart<stages::gray_from_uyvy, Uyvy, Gray8, to_gray>, PlanePart,
               ConversionPart<stages::gray_from_rgb565, Rgb565, Gray8, rgb565_to_gray>,
               ConversionPart<stages::saturation_from_rgb, Rgb888, Gray8, to_saturation>, HuesPart<Hsv888>>;

/// From gray to other pixels.
using TailParts = std::tuple<
    FilterPart<stages::sobel_x, Gradient16, sobel_x>, FilterPart<stages::sobel_y, Gradient16, sobel_y>,
    ConversionPart<stages::rgb_from_gray, Gray8, Rgb888, to_rgb>, WidenPart<Sum32>,
    FilterPart<stages::prewitt_x, Gradient16, prewitt_x>,
    FilterPart<stages::prewitt_y, Gradient16, prewitt_y>, FilterPart<stages::scharr_x, Gradient16, scharr_x>,
    FilterPart<stages::scharr_y, Gradient16, scharr_y>,
    FilterPart<stages::difference_x, Gradient16, difference_x>,
    FilterPart<stages::difference_y, Gradient16, difference_y>>;

/// Others, in an order in which they fit together.
using Rgb565ToHues = std::tuple<ConversionPart<stages::rgb_from_rgb565, Rgb565, Rgb888, rgb565_to_rgb>,
                                ConversionPart<stages::hsv_from_rgb, Rgb888, Hsv888, to_hsv>,
                                ConversionPart<stages::rgb_from_hsv, Hsv888, Rgb888, to_rgb>>;
using YuyvToGray = std::tuple<YuvPart<stages::rgb_from_yuyv, Yuyv, Rgb888, to_rgb>,
                              ConversionPart<stages::saturation_from_rgb, Rgb888, Gray8, to_saturation>,
                              FilterPart<stages::laplacian_4, Gradient16, laplacian_4>>;
using UyvyToGray = std::tuple<YuvPart<stages::rgb_from_uyvy, Uyvy, Rgb888, to_rgb>, HuesPart<Rgb888>,
                              FilterPart<stages::laplacian_8, Gradient16, laplacian_8>>;
using EdgesToGray = std::tuple<FilterPart<stages::sobel_x, Gradient16, sobel_x>, NarrowAboutPart,
                               ElementPart<stages::closing, closing>>;
using WidthAndBack = std::tuple<WidenPart<Sum32>, NarrowPart<Sum32>, WidenPart<Gray16>>;

}  // namespace fovea::test
