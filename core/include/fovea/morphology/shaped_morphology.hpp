// SPDX-License-Identifier: MIT
//
// Erosion, dilation, opening and closing with an element of any shape. Book sec. 2.7.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/morphology/rectangle_kernels.hpp>
#include <fovea/morphology/structuring_element.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {
inline namespace FOVEA_ISA {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that erode() and dilate() with an element need: for each of its rows a line, and for runs of
/// 4 places or more one for each doubling of the columns.
constexpr std::int64_t erode_scratch(Size size, const StructuringElement& element);
constexpr std::int64_t dilate_scratch(Size size, const StructuringElement& element) {
    return erode_scratch(size, element);
}
/// Scratch bytes that opening() and closing() with an element need: a frame besides.
constexpr std::int64_t opening_scratch(Size size, const StructuringElement& element) {
    return size.area() + erode_scratch(size, element);
}
constexpr std::int64_t closing_scratch(Size size, const StructuringElement& element) {
    return opening_scratch(size, element);
}

/// The smallest value in the places of an element around every pixel.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Units    any 8-bit values; a binary image stays binary
/// Border   only pixels of the image count; where the element holds none of them, 255
/// Overlap  none: dst must not share pixels with src
/// Scratch  erode_scratch(src.size(), element) bytes, undefined afterwards
/// Errors   empty_image, size_mismatch, bad_argument for an element without places, scratch_too_small
/// Source   book sec. 2.7.1
inline Status erode(ImageView<const Gray8> src, const StructuringElement& element, Span<std::uint8_t> scratch,
                    ImageView<Gray8> dst);

/// The largest value in the places of the reflected element, so that an opening is nowhere above its source
/// whatever the shape. 0 where there is none of them in the image; all else as erode().
inline Status dilate(ImageView<const Gray8> src, const StructuringElement& element,
                     Span<std::uint8_t> scratch, ImageView<Gray8> dst);

/// Erosion, then dilation.
///
/// Overlap  dst may be src
/// Scratch  opening_scratch(src.size(), element) bytes, undefined afterwards
/// Others   as erode()
/// Source   book sec. 2.7.3
inline Status opening(ImageView<const Gray8> src, const StructuringElement& element,
                      Span<std::uint8_t> scratch, ImageView<Gray8> dst);

/// Dilation, then erosion. All else as opening().
inline Status closing(ImageView<const Gray8> src, const StructuringElement& element,
                      Span<std::uint8_t> scratch, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// visit(x, length) for every run of places in a row of an element.
template <class Visit>
constexpr void for_each_run(std::uint32_t row, Visit visit) {
    for (int x = 0; x < max_shape_side;) {
        int length = 0;
        while (x + length < max_shape_side && (row >> (x + length) & 1) != 0) ++length;
        if (length > 0) visit(x, length);
        x += length + 1;
    }
}

/// Runs up to this length are looked at place by place, longer ones as two windows of a power of two.
inline constexpr int longest_single_run = 3;

constexpr int doublings_of(int length) {
    int doublings = 0;
    while (2 << doublings <= length) ++doublings;
    return length > longest_single_run ? doublings : 0;
}

/// Windows that are compared for one pixel.
constexpr int windows_of(const StructuringElement& element) {
    int windows = 0;
    for (int y = 0; y < element.size().height; ++y)
        for_each_run(element.row(y),
                     [&](int, int length) { windows += length <= longest_single_run ? length : 2; });
    return windows;
}

/// The most often that columns are doubled.
constexpr int most_doublings(const StructuringElement& element) {
    int most = 0;
    for (int y = 0; y < element.size().height; ++y)
        for_each_run(element.row(y), [&](int, int length) { most = maximum(most, doublings_of(length)); });
    return most;
}

/// A window: where it begins, counted from the pixel in the middle, and how often its columns are doubled.
struct ShapeWindow {
    std::int8_t x = 0;
    std::uint8_t row = 0;  ///< of the element
    std::uint8_t doublings = 0;
};

/// As many rows as an element is high, each with the extremes of 1, 2, 4 ... columns from each column on.
template <class Extreme>
class ShapedLines {
public:
    ShapedLines() = default;
    ShapedLines(int width, const StructuringElement& element, Span<std::uint8_t> scratch)
        : width_(width),
          height_(element.size().height),
          levels_(most_doublings(element) + 1),
          scratch_(scratch) {
        const std::ptrdiff_t lines = height_ * levels_ + 1;
        Arena arena(scratch_.from(lines * line_bytes()));
        pointers_ = arena.take<const std::uint8_t*>(windows_of(element));
        windows_ = arena.take<ShapeWindow>(pointers_.size());
        int count = 0;
        for (int i = 0; i < height_; ++i)
            for_each_run(element.row(i), [&](int x, int length) {
                const int first = x - element.size().width / 2;
                const int doublings = doublings_of(length);
                const auto add = [&](int begin) {
                    windows_[count++] = {static_cast<std::int8_t>(begin), static_cast<std::uint8_t>(i),
                                         static_cast<std::uint8_t>(doublings)};
                };
                if (length <= longest_single_run) {
                    for (int k = 0; k < length; ++k) add(first + k);
                } else {
                    add(first);
                    add(first + length - (1 << doublings));
                }
            });
        std::memset(nothing(), Extreme::neutral, static_cast<std::size_t>(line_bytes()));
    }
    int height() const { return height_; }

    void load(const Gray8* row, int place) {
        std::uint8_t* pixels = line_of(place, 0) + max_reach;
        std::memset(pixels - max_reach, Extreme::neutral, static_cast<std::size_t>(max_reach));
        std::memcpy(pixels, row, static_cast<std::size_t>(width_));
        std::memset(pixels + width_, Extreme::neutral, static_cast<std::size_t>(max_reach));
        for (int level = 1; level < levels_; ++level) {
            const std::uint8_t* from = line_of(place, level - 1) + max_reach;
            std::uint8_t* to = line_of(place, level) + max_reach;
            const int step = 1 << (level - 1);
            // Windows begin at most half an element before the row, and end behind it.
            for (int x = -max_shape_side / 2; x < width_ + max_shape_side / 2; x += simd::lanes)
                Extreme::of(simd::Bytes::load(from + x), simd::Bytes::load(from + x + step)).store(to + x);
        }
    }
    /// A row of the result; place_of(i) says where row i of the element was loaded to, no_index for a row
    /// beyond the image.
    template <class PlaceOf>
    void make_row(PlaceOf place_of, Gray8* dst) {
        const std::ptrdiff_t bytes = line_bytes();
        for (std::ptrdiff_t i = 0; i < windows_.size(); ++i) {
            const ShapeWindow window = windows_[i];
            const int place = place_of(window.row);
            const std::uint8_t* line =
                place == no_index ? nothing() : line_of(place, 0) + window.doublings * bytes;
            pointers_[i] = line + max_reach + window.x;
        }
        join(pointers_.data(), static_cast<int>(pointers_.size()), dst);
    }

private:
    std::ptrdiff_t line_bytes() const { return static_cast<std::ptrdiff_t>(byte_line_scratch(width_)); }
    std::uint8_t* nothing() const { return scratch_.data(); }
    std::uint8_t* line_of(int place, int level) const {
        return scratch_.data() + (1 + place * levels_ + level) * line_bytes();
    }
    /// Four vectors abreast, so that a window's address is fetched once for all of them.
    void join(const std::uint8_t* const* windows, int count, Gray8* dst) const {
        constexpr int lanes = simd::lanes;
        const int width = width_;
        int x = 0;
        for (; x + 4 * lanes <= width; x += 4 * lanes) {
            simd::Bytes a = simd::Bytes::load(windows[0] + x);
            simd::Bytes b = simd::Bytes::load(windows[0] + x + lanes);
            simd::Bytes c = simd::Bytes::load(windows[0] + x + 2 * lanes);
            simd::Bytes d = simd::Bytes::load(windows[0] + x + 3 * lanes);
            for (int i = 1; i < count; ++i) {
                const std::uint8_t* window = windows[i] + x;
                a = Extreme::of(a, simd::Bytes::load(window));
                b = Extreme::of(b, simd::Bytes::load(window + lanes));
                c = Extreme::of(c, simd::Bytes::load(window + 2 * lanes));
                d = Extreme::of(d, simd::Bytes::load(window + 3 * lanes));
            }
            a.store(dst + x);
            b.store(dst + x + lanes);
            c.store(dst + x + 2 * lanes);
            d.store(dst + x + 3 * lanes);
        }
        for (; x < width; x += lanes) {
            simd::Bytes extreme = simd::Bytes::load(windows[0] + x);
            for (int i = 1; i < count; ++i) extreme = Extreme::of(extreme, simd::Bytes::load(windows[i] + x));
            extreme.store(dst + x, minimum(lanes, width - x));
        }
    }

    int width_ = 0;
    int height_ = 1;
    int levels_ = 1;
    Span<std::uint8_t> scratch_;
    Span<const std::uint8_t*> pointers_;
    Span<ShapeWindow> windows_;
};

/// A place below 2 * count in a ring of count places. Divisions for all rows of a window took a fifth of the
/// time of a small one.
constexpr int wrapped(int place, int count) { return place < count ? place : place - count; }

/// The row kernel of erosion and dilation with an element, for rows that come one at a time. Rows beyond the
/// image hold Extreme::neutral. follows says that the window is one row below that of the call before: then
/// its lowest row alone is new.
template <class Extreme>
class ShapedRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    ShapedRow() = default;
    ShapedRow(const StructuringElement& element, Span<std::uint8_t> scratch, int width)
        : lines_(width, element, scratch) {}

    int rows() const { return lines_.height(); }

    void operator()(const RowWindow<Gray8>& window, bool follows, Gray8* dst) {
        const int height = window.count();
        first_ = follows ? wrapped(first_ + 1, height) : 0;
        const auto place_of = [&](int i) { return wrapped(first_ + i, height); };
        for (int i = follows ? height - 1 : 0; i < height; ++i) lines_.load(window[i], place_of(i));
        lines_.make_row(place_of, dst);
    }

private:
    ShapedLines<Extreme> lines_;
    int first_ = 0;  ///< where the highest row of the window is
};

inline Status check_shape(ImageView<const Gray8> src, const StructuringElement& element, std::int64_t needed,
                          Span<std::uint8_t> scratch, ImageView<const Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (element.empty()) return Status::bad_argument;
    return scratch.size() < needed ? Status::scratch_too_small : Status::ok;
}

template <class Extreme>
void shaped_frame(ImageView<const Gray8> src, const StructuringElement& element, Span<std::uint8_t> scratch,
                  ImageView<Gray8> dst) {
    ShapedLines<Extreme> lines(src.width(), element, scratch);
    const int height = element.size().height;
    const int reach = height / 2;
    int first = wrapped(height - reach, height);  // Where the highest row of the window is, or would be.
    int loaded = 0;
    int place = 0;  // Of the next row that is loaded.
    for (int y = 0; y < src.height(); ++y) {
        for (; loaded < src.height() && loaded <= y + reach; ++loaded) {
            lines.load(src.row(loaded), place);
            place = wrapped(place + 1, height);
        }
        const auto place_of = [&](int i) {
            const int row = y + i - reach;
            return row >= 0 && row < src.height() ? wrapped(first + i, height) : no_index;
        };
        lines.make_row(place_of, dst.row(y));
        first = wrapped(first + 1, height);
    }
}

}  // namespace kernels

constexpr std::int64_t erode_scratch(Size size, const StructuringElement& element) {
    const std::int64_t lines =
        std::int64_t{element.size().height} * (kernels::most_doublings(element) + 1) + 1;
    const int windows = kernels::windows_of(element);
    return lines * byte_line_scratch(size.width) + arena_bytes<const std::uint8_t*>(windows) +
           arena_bytes<kernels::ShapeWindow>(windows);
}

inline Status erode(ImageView<const Gray8> src, const StructuringElement& element, Span<std::uint8_t> scratch,
                    ImageView<Gray8> dst) {
    if (Status s = kernels::check_shape(src, element, erode_scratch(src.size(), element), scratch, dst);
        s != Status::ok)
        return s;
    kernels::shaped_frame<kernels::Lowest>(src, element, scratch, dst);
    return Status::ok;
}

inline Status dilate(ImageView<const Gray8> src, const StructuringElement& element,
                     Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    if (Status s = kernels::check_shape(src, element, dilate_scratch(src.size(), element), scratch, dst);
        s != Status::ok)
        return s;
    kernels::shaped_frame<kernels::Highest>(src, element.reflected(), scratch, dst);
    return Status::ok;
}

inline Status opening(ImageView<const Gray8> src, const StructuringElement& element,
                      Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    if (Status s = kernels::check_shape(src, element, opening_scratch(src.size(), element), scratch, dst);
        s != Status::ok)
        return s;
    const ImageView<Gray8> between(scratch.data(), src.size(), src.width());
    const Span<std::uint8_t> rest = scratch.from(static_cast<std::ptrdiff_t>(src.size().area()));
    kernels::shaped_frame<kernels::Lowest>(src, element, rest, between);
    kernels::shaped_frame<kernels::Highest>(between, element.reflected(), rest, dst);
    return Status::ok;
}

inline Status closing(ImageView<const Gray8> src, const StructuringElement& element,
                      Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    if (Status s = kernels::check_shape(src, element, closing_scratch(src.size(), element), scratch, dst);
        s != Status::ok)
        return s;
    const ImageView<Gray8> between(scratch.data(), src.size(), src.width());
    const Span<std::uint8_t> rest = scratch.from(static_cast<std::ptrdiff_t>(src.size().area()));
    kernels::shaped_frame<kernels::Highest>(src, element.reflected(), rest, between);
    kernels::shaped_frame<kernels::Lowest>(between, element, rest, dst);
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
