// SPDX-License-Identifier: MIT
//
// Video pixels to colour: YUYV, UYVY and NV12, by ITU-R BT.601.
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

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Which numbers a camera sends for black and white.
enum class YuvRange : std::uint8_t {
    full,    ///< luma 0..255, colour differences +-127: webcams, JPEG
    narrow,  ///< luma 16..235, colour differences +-112: television, most video
};

/// The colour of one video pixel. With u and v less 128, and for the narrow range luma less 16:
///     full    red = luma + 1.402 v    green = luma - 0.344 u - 0.714 v    blue = luma + 1.772 u
///     narrow  red = 1.164 luma + 1.596 v    green = 1.164 luma - 0.392 u - 0.813 v
///             blue = 1.164 luma + 2.017 u
/// held at 0..255.
///
/// Rounding  nearest, ties up; the factors are rounded to 1/256, which moves a result by less than a half
/// Source    ITU-R BT.601-7 sec. 2.5. The toolkit's factors 1.371, 0.698, 0.338, 1.732 are those of neither
///           range
constexpr Rgb888 rgb_of(std::uint8_t luma, std::uint8_t u, std::uint8_t v, YuvRange range);

/// Pairs of pixels that share colour differences, so the size of the differences of an NV12 image.
constexpr Size chroma_size(Size size) { return {(size.width + 1) / 2, (size.height + 1) / 2}; }

inline namespace FOVEA_ISA {

/// Colour of a YUYV (YUY2) or UYVY image.
///
/// Shapes   src and dst equal, 1x1 or larger. The last column of an odd width has no v of its own and takes
///          that of the pair before, or 128 where there is none
/// Units    0..255, rounded as rgb_of()
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch
/// Source   ITU-R BT.601-7 sec. 2.5
inline Status to_rgb(ImageView<const Yuyv> src, YuvRange range, ImageView<Rgb888> dst);
inline Status to_rgb(ImageView<const Uyvy> src, YuvRange range, ImageView<Rgb888> dst);

/// Colour of an NV12 image: a plane of luma, and one of the differences that four pixels share.
///
/// Shapes  luma and dst equal, 1x1 or larger, chroma of chroma_size(luma.size())
/// Others  as above
inline Status to_rgb(ImageView<const Gray8> luma, ImageView<const ChromaPair> chroma, YuvRange range,
                     ImageView<Rgb888> dst);

/// Brightness of a video image with black 0 and white 255: the luma, of the narrow range stretched as
/// rgb_of() does. The luma plane of NV12 comes as Gray8.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none: dst must not share pixels with src; but it may be luma
/// Errors   empty_image, size_mismatch
/// Source   ITU-R BT.601-7 sec. 2.5
inline Status to_gray(ImageView<const Yuyv> src, YuvRange range, ImageView<Gray8> dst);
inline Status to_gray(ImageView<const Uyvy> src, YuvRange range, ImageView<Gray8> dst);
inline Status to_gray(ImageView<const Gray8> luma, YuvRange range, ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Factors in 1/256. Luma is multiplied by 256 + luma, so that white is 255 in either range.
struct YuvFactors {
    int black;
    int luma;
    int red_v;
    int green_u;
    int green_v;
    int blue_u;
};
inline constexpr YuvFactors full_factors{0, 0, 359, 88, 183, 454};
inline constexpr YuvFactors narrow_factors{16, 42, 409, 100, 208, 516};

}  // namespace detail

constexpr Rgb888 rgb_of(std::uint8_t luma, std::uint8_t u, std::uint8_t v, YuvRange range) {
    const detail::YuvFactors k = range == YuvRange::full ? detail::full_factors : detail::narrow_factors;
    // At most 298 * 239 + 516 * 127 + 128 = 136882 in magnitude.
    const int level = (256 + k.luma) * (luma - k.black);
    const int du = u - 128;
    const int dv = v - 128;
    const auto held = [](int sum) { return saturate_cast<std::uint8_t>(round_shift(sum, 8)); };
    return {held(level + k.red_v * dv), held(level - k.green_u * du - k.green_v * dv),
            held(level + k.blue_u * du)};
}

inline namespace FOVEA_ISA {

namespace kernels {

/// The sums of rgb_of() in 16 bits without a sign. Whole multiples of 256 are taken out of the factors and
/// added after the shift. What remains is made positive by using 255 - u for -u, and by adding a multiple of
/// 256, which comes off after the shift as well.
template <YuvRange Range>
struct YuvLanes {
    static constexpr YuvRange range = Range;
    static constexpr detail::YuvFactors k =
        Range == YuvRange::full ? detail::full_factors : detail::narrow_factors;
    static constexpr int red_v = k.red_v - 256;
    static constexpr int green_v = 256 - k.green_v;
    static constexpr int blue_whole = k.blue_u / 256;
    static constexpr int blue_u = k.blue_u % 256;
    // The constant part of each sum, and how many 256 make it positive.
    static constexpr int red_constant = 128 - k.luma * k.black - 128 * red_v;
    static constexpr int green_constant = 128 - k.luma * k.black - 127 * k.green_u - 128 * green_v;
    static constexpr int blue_constant = 128 - k.luma * k.black - 128 * blue_u;
    static constexpr int red_lift = (255 - red_constant) / 256;
    static constexpr int green_lift = (255 - green_constant) / 256;
    static constexpr int blue_lift = (255 - blue_constant) / 256;
    static_assert(255 * (k.luma + k.green_u + green_v) + 255 < 65536 &&
                      255 * (k.luma + red_v) + 255 < 65536 && 255 * (k.luma + blue_u) + 255 < 65536,
                  "the sums have 16 bits");

    static constexpr std::uint16_t word(int value) { return static_cast<std::uint16_t>(value); }

    /// The colours of pixels whose colour differences are given for each of them.
    [[gnu::always_inline]] static simd::ByteTriples rgb(simd::Words luma, simd::Words u, simd::Words v) {
        using simd::Words;
        const Words level = luma * word(k.luma);
        const Words not_u = Words::all(255) - u;
        const Words not_v = Words::all(255) - v;
        const Words red = level + v * word(red_v) + Words::all(word(red_constant + 256 * red_lift));
        const Words green = level + not_u * word(k.green_u) + v * word(green_v) +
                            Words::all(word(green_constant + 256 * green_lift));
        const Words blue = level + u * word(blue_u) + Words::all(word(blue_constant + 256 * blue_lift));
        const auto held = [&](Words part, Words whole, int less) {
            return ((part >> 8) + whole + luma - Words::all(word(less + k.black))).held();
        };
        return {held(red, v, 128 + red_lift), held(green, not_v, 127 + green_lift),
                held(blue, u * word(blue_whole), 128 * blue_whole + blue_lift)};
    }

    /// lanes pixels: their luma, and the colour differences of each two of them as u, v.
    [[gnu::always_inline]] static void step(simd::Bytes luma, simd::Bytes chroma, std::uint8_t* to) {
        const simd::Words differences(chroma);
        simd::store_triples(
            rgb(simd::Words(luma), {differences.even, differences.even}, {differences.odd, differences.odd}),
            to);
    }

    [[gnu::always_inline]] static simd::Bytes gray(simd::Bytes luma) {
        if constexpr (Range == YuvRange::full) return luma;
        using simd::Words;
        constexpr int constant = 128 - k.luma * k.black;
        constexpr int lift = (255 - constant) / 256;
        const Words level(luma);
        const Words part = (level * word(k.luma) + Words::all(word(constant + 256 * lift))) >> 8;
        return (part + level - Words::all(word(k.black + lift))).held();
    }
};

constexpr bool is_range(YuvRange range) { return range == YuvRange::full || range == YuvRange::narrow; }

/// act(lanes of the range).
template <class Act>
Status with_range(YuvRange range, Act act) {
    switch (range) {
        case YuvRange::full: return act(YuvLanes<YuvRange::full>());
        case YuvRange::narrow: return act(YuvLanes<YuvRange::narrow>());
    }
    return Status::bad_argument;
}

/// The last pixel of an odd row has a u alone.
template <class Pixel>
void last_of_odd_row(const Pixel* src, int width, YuvRange range, Rgb888* dst) {
    const Pixel last = src[width - 1];
    const std::uint8_t v = width > 1 ? src[width - 2].chroma : std::uint8_t{128};
    dst[width - 1] = rgb_of(last.luma, last.chroma, v, range);
}

/// to_rgb() of one row.
template <YuvRange Range>
void rgb_from_yuyv_row(const Yuyv* src, int width, Rgb888* dst) {
    simd::for_each_step<2, 3>(&src->luma, width & ~1, &dst->red,
                              [](const std::uint8_t* from, std::uint8_t* to) {
                                  const simd::BytePairs pairs = simd::load_pairs(from);
                                  YuvLanes<Range>::step(pairs.first, pairs.second, to);
                              });
    if (width % 2 != 0) last_of_odd_row(src, width, Range, dst);
}
template <YuvRange Range>
void rgb_from_uyvy_row(const Uyvy* src, int width, Rgb888* dst) {
    simd::for_each_step<2, 3>(&src->chroma, width & ~1, &dst->red,
                              [](const std::uint8_t* from, std::uint8_t* to) {
                                  const simd::BytePairs pairs = simd::load_pairs(from);
                                  YuvLanes<Range>::step(pairs.second, pairs.first, to);
                              });
    if (width % 2 != 0) last_of_odd_row(src, width, Range, dst);
}

/// to_gray() of one row of luma.
template <class Lanes>
void gray_from_luma_row(const Gray8* luma, int width, Lanes lanes, Gray8* dst) {
    simd::for_each_step<1, 1>(luma, width, dst, [=](const std::uint8_t* from, std::uint8_t* to) {
        lanes.gray(simd::Bytes::load(from)).store(to);
    });
}

/// to_rgb() of one row of NV12 and the row of differences that belongs to it.
template <YuvRange Range>
void rgb_from_nv12_row(const Gray8* luma, const ChromaPair* chroma, int width, Rgb888* dst) {
    constexpr int lanes = simd::lanes;
    static_assert(lanes % 2 == 0, "a step begins with a pair");
    int x = 0;
    for (; x + lanes <= width; x += lanes)
        YuvLanes<Range>::step(simd::Bytes::load(luma + x), simd::Bytes::load(&chroma[x / 2].u), &dst[x].red);
    for (; x < width; ++x) dst[x] = rgb_of(luma[x], chroma[x / 2].u, chroma[x / 2].v, Range);
}

}  // namespace kernels

inline Status to_rgb(ImageView<const Yuyv> src, YuvRange range, ImageView<Rgb888> dst) {
    return kernels::with_range(range, [&](auto lanes) {
        return detail::convert_frame(src, dst, 2, kernels::rgb_from_yuyv_row<lanes.range>);
    });
}

inline Status to_rgb(ImageView<const Uyvy> src, YuvRange range, ImageView<Rgb888> dst) {
    return kernels::with_range(range, [&](auto lanes) {
        return detail::convert_frame(src, dst, 2, kernels::rgb_from_uyvy_row<lanes.range>);
    });
}

inline Status to_rgb(ImageView<const Gray8> luma, ImageView<const ChromaPair> chroma, YuvRange range,
                     ImageView<Rgb888> dst) {
    if (luma.empty()) return Status::empty_image;
    if (dst.size() != luma.size() || chroma.size() != chroma_size(luma.size())) return Status::size_mismatch;
    return kernels::with_range(range, [&](auto lanes) {
        for (int y = 0; y < luma.height(); ++y)
            kernels::rgb_from_nv12_row<lanes.range>(luma.row(y), chroma.row(y / 2), luma.width(), dst.row(y));
        return Status::ok;
    });
}

inline Status to_gray(ImageView<const Yuyv> src, YuvRange range, ImageView<Gray8> dst) {
    return kernels::with_range(range, [&](auto lanes) {
        return detail::convert_frame(src, dst, [=](const Yuyv* from, int width, Gray8* to) {
            simd::for_each_step<2, 1>(&from->luma, width, to, [=](const std::uint8_t* in, std::uint8_t* out) {
                lanes.gray(simd::load_pairs(in).first).store(out);
            });
        });
    });
}

inline Status to_gray(ImageView<const Uyvy> src, YuvRange range, ImageView<Gray8> dst) {
    return kernels::with_range(range, [&](auto lanes) {
        return detail::convert_frame(src, dst, [=](const Uyvy* from, int width, Gray8* to) {
            simd::for_each_step<2, 1>(&from->chroma, width, to,
                                      [=](const std::uint8_t* in, std::uint8_t* out) {
                                          lanes.gray(simd::load_pairs(in).second).store(out);
                                      });
        });
    });
}

inline Status to_gray(ImageView<const Gray8> luma, YuvRange range, ImageView<Gray8> dst) {
    return kernels::with_range(range, [&](auto lanes) {
        return detail::convert_frame(luma, dst, [=](const Gray8* from, int width, Gray8* to) {
            kernels::gray_from_luma_row(from, width, lanes, to);
        });
    });
}

}  // namespace FOVEA_ISA
}  // namespace fovea
