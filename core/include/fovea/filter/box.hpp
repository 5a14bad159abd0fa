// SPDX-License-Identifier: MIT
//
// Box filters: the mean over a rectangle. Book sec. 2.6.2.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/filter_row.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>
#include <fovea/stream/stage.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Scratch bytes that box_3x3(), box_5x5() and box() need.
constexpr std::int64_t box_3x3_scratch(Size size);
constexpr std::int64_t box_5x5_scratch(Size size);
constexpr std::int64_t box_scratch(Size size);

/// Mean of every pixel's 3x3 neighbourhood.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     grey levels in and out
/// Rounding  nearest (9 is odd, so no ties); the largest sum is 9 * 255
/// Border    as border says
/// Overlap   none: dst must not share pixels with src
/// Scratch   box_3x3_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, scratch_too_small
/// Source    book sec. 2.6.2, mean filter; the toolkit's AverageFilter rounded down
inline Status box_3x3(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst);

/// Mean of every pixel's 5x5 neighbourhood; the largest sum is 25 * 255. All else as box_3x3().
inline Status box_5x5(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst);

/// Mean over a rectangle that is centred on every pixel.
///
/// Shapes   element odd by odd, 1x1 to 63x63
/// Rounding nearest; the largest sum is 63 * 63 * 255
/// Scratch  box_scratch(src.size()) bytes, undefined afterwards
/// Errors   also bad_argument for an even, too small or too large element
/// Time     grows with the height of the element and the logarithm of its width up to 255 pixels in it;
/// above,
///          with the height alone
/// Others   as box_3x3()
inline Status box(ImageView<const Gray8> src, Size element, Border border, Span<std::uint8_t> scratch,
                  ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

struct Box3x3 {
    static constexpr int rows = 3, reach = 1, byte_lines = 0, word_lines = 1;
    using Output = Gray8;
    using Lines = FilterLines<Box3x3>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c) const {
        lines.words().put(x, simd::Words(a) + simd::Words(b) + simd::Words(c));
    }
    [[gnu::always_inline]] simd::Bytes across(const Lines& lines, int x) const {
        const simd::WordLine& line = lines.words();
        // 7282 = ceil(2^16 / 9) is 2 too much for 9 of them: exact below 2^16 / 2.
        return times_high(line.at<-1>(x) + line.at<0>(x) + line.at<1>(x) + simd::Words::all(4), 7282)
            .narrow();
    }
};

struct Box5x5 {
    static constexpr int rows = 5, reach = 2, byte_lines = 0, word_lines = 1;
    using Output = Gray8;
    using Lines = FilterLines<Box5x5>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c,
                                     simd::Bytes d, simd::Bytes e) const {
        lines.words().put(x,
                          simd::Words(a) + simd::Words(b) + simd::Words(c) + simd::Words(d) + simd::Words(e));
    }
    [[gnu::always_inline]] simd::Bytes across(const Lines& lines, int x) const {
        const simd::WordLine& line = lines.words();
        const simd::Words sum =
            line.at<-2>(x) + line.at<-1>(x) + line.at<0>(x) + line.at<1>(x) + line.at<2>(x);
        // 10486 = ceil(2^18 / 25) is 6 too much for 25 of them: exact below 2^18 / 6.
        return (times_high(sum + simd::Words::all(12), 10486) >> 2).narrow();
    }
};

constexpr bool is_box_element(Size element) {
    return element.width % 2 == 1 && element.height % 2 == 1 && !element.empty() &&
           element.width <= max_window_rows && element.height <= max_window_rows;
}

/// The row kernel of box(): columns are summed down the window, then neighbours across.
class BoxRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    /// Sums of 1, 2, 4 ... columns; an element of at most most_vector_area pixels is at most this wide.
    static constexpr int levels = 6;
    /// Up to this many pixels a sum and half of them fit 16 bits.
    static constexpr int most_vector_area = 255;
    static constexpr std::int64_t scratch(int width) {
        return levels * std::int64_t{word_line_scratch(width)};
    }

    BoxRow() = default;
    BoxRow(Size element, Border border, Span<std::uint8_t> scratch, int width)
        : element_(element), border_(border), lines_{line(scratch, width, 0), line(scratch, width, 1),
                                                     line(scratch, width, 2), line(scratch, width, 3),
                                                     line(scratch, width, 4), line(scratch, width, 5)} {
        // As in FilterRow: no column beyond the end may carry into one that counts.
        std::memset(scratch.data(), 0, static_cast<std::size_t>(BoxRow::scratch(width)));
    }

    int rows() const { return element_.height; }

    void operator()(const RowWindow<Gray8>& window, Gray8* dst) {
        const int width = window.width();
        down(window, width);
        continue_ends(width);
        if (element_.width * element_.height <= most_vector_area)
            across_in_vectors(width, dst);
        else
            across_one_by_one(width, dst);
    }

private:
    static simd::WordLine line(Span<std::uint8_t> scratch, int width, int number) {
        const int bytes = word_line_scratch(width);
        return simd::WordLine(scratch.from(number * std::ptrdiff_t{bytes}).first(bytes), width);
    }
    void down(const RowWindow<Gray8>& window, int width) {
        simd::for_each_vector(width, [&](int x, int count) {
            simd::Words sum = simd::Words::all(0);
            if (count == simd::lanes)
                for (int i = 0; i < window.count(); ++i)
                    sum = sum + simd::Words(simd::Bytes::load(window[i] + x));
            else
                for (int i = 0; i < window.count(); ++i)
                    sum = sum + simd::Words(simd::Bytes::load(window[i] + x, count));
            lines_[0].put(x, sum);
        });
    }
    void continue_ends(int width) {
        for (int i = 1; i <= element_.width / 2; ++i) {
            const int left = border_index(border_, -i, width);
            const int right = border_index(border_, width - 1 + i, width);
            lines_[0].set(-i, left == no_index ? std::uint16_t{0} : lines_[0].value(left));
            lines_[0].set(width - 1 + i, right == no_index ? std::uint16_t{0} : lines_[0].value(right));
        }
    }
    /// The sums of 2, 4, 8 ... columns from each column on; an element's width is a sum of powers of two.
    void across_in_vectors(int width, Gray8* dst) {
        const int reach = element_.width / 2;
        const int first = -(reach + reach % 2);
        for (int level = 1; 1 << level <= element_.width; ++level) {
            const int half = 1 << (level - 1);
            for (int x = first; x <= width + reach - (1 << level); x += simd::lanes)
                lines_[level].put(x, lines_[level - 1].at(x, 0) + lines_[level - 1].at(x, half));
        }
        const int area = element_.width * element_.height;
        const auto half = static_cast<std::uint16_t>(area / 2);
        // The reciprocal rounded down gives a quotient that is right or one too small.
        const auto reciprocal = static_cast<std::uint16_t>(area == 1 ? 65535 : 65536 / area);
        const simd::Words one = simd::Words::all(1);
        const simd::Words divisor = simd::Words::all(static_cast<std::uint16_t>(area));
        simd::for_each_vector(width, [&](int x, int count) {
            simd::Words sum = simd::Words::all(half);
            int offset = -reach;
            for (int level = 0; 1 << level <= element_.width; ++level)
                if ((element_.width >> level & 1) != 0) {
                    sum = sum + lines_[level].at(x, offset);
                    offset += 1 << level;
                }
            const simd::Words quotient = times_high(sum, reciprocal);
            const simd::Words rest = sum - quotient * static_cast<std::uint16_t>(area);
            (quotient + (at_least(rest, divisor) & one)).narrow().store(dst + x, count);
        });
    }
    /// A running sum of 32 bits.
    void across_one_by_one(int width, Gray8* dst) {
        const int reach = element_.width / 2;
        const auto area = static_cast<std::uint32_t>(element_.width * element_.height);
        // Less than area too much for 2^32 of them, and sums are below 2^20: exact.
        const std::uint32_t reciprocal = 0xffffffffu / area + 1;
        std::uint32_t sum = area / 2;
        for (int x = -reach; x < reach; ++x) sum += lines_[0].value(x);
        for (int x = 0; x < width; ++x) {
            sum += lines_[0].value(x + reach);
            dst[x] = static_cast<Gray8>(std::uint64_t{sum} * reciprocal >> 32);
            sum -= lines_[0].value(x - reach);
        }
    }

    Size element_{1, 1};
    Border border_ = Border::replicate;
    simd::WordLine lines_[levels];
};

}  // namespace kernels

constexpr std::int64_t box_3x3_scratch(Size size) { return filter_scratch<kernels::Box3x3>(size); }
constexpr std::int64_t box_5x5_scratch(Size size) { return filter_scratch<kernels::Box5x5>(size); }
constexpr std::int64_t box_scratch(Size size) { return size.width + kernels::BoxRow::scratch(size.width); }

inline Status box_3x3(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst) {
    return filter_frame(kernels::Box3x3(), src, border, scratch, dst);
}
inline Status box_5x5(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                      ImageView<Gray8> dst) {
    return filter_frame(kernels::Box5x5(), src, border, scratch, dst);
}

inline Status box(ImageView<const Gray8> src, Size element, Border border, Span<std::uint8_t> scratch,
                  ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (!kernels::is_box_element(element)) return Status::bad_argument;
    if (scratch.size() < box_scratch(src.size())) return Status::scratch_too_small;
    std::memset(scratch.data(), 0, static_cast<std::size_t>(src.width()));
    kernels::BoxRow kernel(element, border, scratch.from(src.width()), src.width());
    for_each_row(src, border, kernel, dst, scratch.data());
    return Status::ok;
}

namespace stages {

inline constexpr FilterStage<kernels::Box3x3> box_3x3;
inline constexpr FilterStage<kernels::Box5x5> box_5x5;

/// box() of an element, odd by odd, 1x1 to 63x63.
struct box {
    using Kernel = kernels::BoxRow;
    using Input = Gray8;
    using Output = Gray8;
    Size element;

    constexpr bool valid() const { return kernels::is_box_element(element); }
    constexpr int rows() const { return element.height; }
    static constexpr std::int64_t scratch(int width) { return Kernel::scratch(width); }
    Kernel kernel(Border border, Span<std::uint8_t> bytes, int width) const {
        return Kernel(element, border, bytes, width);
    }
};

}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
