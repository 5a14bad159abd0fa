// SPDX-License-Identifier: MIT
//
// Histogram equalization: every grey level becomes the share of the pixels that are not brighter. Book
// sec. 2.5.4.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/lookup_table.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/statistics/histogram.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// 255 (c(x) - c(first)) / (N - c(first)), c(x) the count of pixels that are not brighter than x and first
/// the darkest level there is: that becomes 0, the brightest 255.
///
/// Rounding  nearest, ties up; of an image of one level, every level stays what it is
/// Errors    empty_image without a pixel
/// Source    book sec. 2.5.4, with the darkest level taken off as OpenCV does
constexpr Result<LookupTable> equalize_table(const Histogram& histogram);

/// 255 c(x) / N: the darkest level becomes its own share, not 0.
///
/// Rounding  nearest, ties up
/// Errors    empty_image without a pixel
/// Source    book sec. 2.5.4, as the toolkit's HistogramEqualization
constexpr Result<LookupTable> equalize_by_share_table(const Histogram& histogram);

inline namespace FOVEA_ISA {

/// Scratch bytes that equalize() and equalize_by_share() need: one histogram.
constexpr std::int64_t equalize_scratch() { return arena_bytes<Histogram>(1); }

/// Scratch bytes that normalize_colour() needs: the counts of three channels.
constexpr std::int64_t normalize_colour_scratch() { return arena_bytes<std::uint32_t>(3 * 256); }

/// equalize_table() of the image, applied to it.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  dst may be src
/// Scratch  equalize_scratch() bytes, undefined afterwards
/// Errors   empty_image, size_mismatch, scratch_too_small
/// Source   book sec. 2.5.4
inline Status equalize(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst);

/// equalize_by_share_table() of the image, applied to it. All else as equalize().
inline Status equalize_by_share(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst);

/// Each channel of a colour image equalized by share on its own: takes the cast of a lamp away, and makes
/// dull colours strong.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  dst may be src
/// Scratch  normalize_colour_scratch() bytes, undefined afterwards
/// Errors   empty_image, size_mismatch, scratch_too_small
/// Source   the toolkit's NormalizeColor, which mixed the channels up
inline Status normalize_colour(ImageView<const Rgb888> src, Span<std::uint8_t> scratch,
                               ImageView<Rgb888> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// 255 (sum of count(0..x) - off) / (total - off), held at 0. Counts below 2^32.
template <class Count>
constexpr LookupTable share_table(Count count, std::uint64_t total, std::uint64_t off) {
    LookupTable table;
    const std::uint64_t whole = total - off;
    std::uint64_t below = 0;
    for (int x = 0; x < 256; ++x) {
        below += count(x);
        table.levels[x] =
            below <= off ? Gray8{0} : static_cast<Gray8>((510 * (below - off) + whole) / (2 * whole));
    }
    return table;
}

}  // namespace detail

constexpr Result<LookupTable> equalize_table(const Histogram& histogram) {
    const std::uint32_t total = histogram.total();
    if (total == 0) return Status::empty_image;
    int first = 0;
    while (histogram[first] == 0) ++first;
    if (histogram[first] == total) {
        LookupTable same;
        for (int x = 0; x < 256; ++x) same.levels[x] = static_cast<Gray8>(x);
        return same;
    }
    return detail::share_table([&](int x) { return histogram[x]; }, total, histogram[first]);
}

constexpr Result<LookupTable> equalize_by_share_table(const Histogram& histogram) {
    const std::uint32_t total = histogram.total();
    if (total == 0) return Status::empty_image;
    return detail::share_table([&](int x) { return histogram[x]; }, total, 0);
}

inline namespace FOVEA_ISA {

namespace kernels {

template <class Table>
Status equalize_frame(ImageView<const Gray8> src, Table table, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (scratch.size() < equalize_scratch()) return Status::scratch_too_small;
    Arena arena(scratch);
    Histogram& histogram = detail::take_histogram(arena);
    if (Status s = histogram_of(src, histogram); s != Status::ok) return s;
    return apply_lut(src, *table(histogram), dst);
}

}  // namespace kernels

inline Status equalize(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    return kernels::equalize_frame(src, equalize_table, scratch, dst);
}

inline Status equalize_by_share(ImageView<const Gray8> src, Span<std::uint8_t> scratch,
                                ImageView<Gray8> dst) {
    return kernels::equalize_frame(src, equalize_by_share_table, scratch, dst);
}

inline Status normalize_colour(ImageView<const Rgb888> src, Span<std::uint8_t> scratch,
                               ImageView<Rgb888> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (scratch.size() < normalize_colour_scratch()) return Status::scratch_too_small;
    std::uint32_t* counts = Arena(scratch).take<std::uint32_t>(3 * 256).data();
    for (int y = 0; y < src.height(); ++y) {
        const Rgb888* row = src.row(y);
        for (int x = 0; x < src.width(); ++x) {
            ++counts[row[x].red];
            ++counts[256 + row[x].green];
            ++counts[512 + row[x].blue];
        }
    }
    const auto total = static_cast<std::uint64_t>(src.size().area());
    // The tables take the place of the counts that they are made from.
    Gray8* tables = reinterpret_cast<Gray8*>(counts);
    for (int channel = 0; channel < 3; ++channel) {
        const std::uint32_t* of_channel = counts + 256 * channel;
        const LookupTable table = detail::share_table([&](int x) { return of_channel[x]; }, total, 0);
        for (int x = 0; x < 256; ++x) tables[256 * channel + x] = table.levels[x];
    }
    for (int y = 0; y < src.height(); ++y) {
        const Rgb888* from = src.row(y);
        Rgb888* to = dst.row(y);
        for (int x = 0; x < src.width(); ++x) {
            const Rgb888 colour = from[x];
            to[x] = {tables[colour.red], tables[256 + colour.green], tables[512 + colour.blue]};
        }
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
