// SPDX-License-Identifier: MIT
//
// Box filters: the mean over a rectangle. Book sec. 2.6.2.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/filter/box_running.hpp>
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
/// Time     grows with the logarithm of the element's width, without vectors not at all; its height costs
///          nothing
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

/// The row kernel of box() in vectors: columns are summed down the window as BoxRunningRow does it, then
/// neighbours across.
class BoxVectorRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    /// Up to this many pixels a sum and half of them fit 16 bits.
    static constexpr int most_narrow_area = 255;
    static constexpr int lines = 5;
    static constexpr std::int64_t scratch(int width) {
        return lines * std::int64_t{word_line_scratch(width)};
    }

    BoxVectorRow() = default;
    BoxVectorRow(Size element, Border border, Span<std::uint8_t> scratch, int width)
        : element_(element),
          border_(border),
          columns_(line(scratch, width, 0)),
          remaining_(line(scratch, width, 1)),
          fours_(line(scratch, width, 2)),
          sixteens_(line(scratch, width, 3)),
          coarse_sixteens_(line(scratch, width, 4)) {
        // As in FilterRow: no column beyond the end may carry into one that counts.
        std::memset(scratch.data(), 0, static_cast<std::size_t>(BoxVectorRow::scratch(width)));
    }

    int rows() const { return element_.height; }

    void operator()(const RowWindow<Gray8>& window, bool follows, Gray8* dst) {
        const int width = window.width();
        if (follows)
            down_one(window, width);
        else
            down(window, width);
        continue_ends(width);
        add_fours(width);
        if (narrow())
            divide_narrow(width, dst);
        else
            divide_wide(width, dst);
    }

private:
    bool narrow() const { return element_.width * element_.height <= most_narrow_area; }
    static simd::WordLine line(Span<std::uint8_t> scratch, int width, int number) {
        const int bytes = word_line_scratch(width);
        return simd::WordLine(scratch.from(number * std::ptrdiff_t{bytes}).first(bytes), width);
    }
    static simd::Words load(const Gray8* row, int x, int count) {
        return simd::Words(count == simd::lanes ? simd::Bytes::load(row + x)
                                                : simd::Bytes::load(row + x, count));
    }

    // ---- Down ----

    void down(const RowWindow<Gray8>& window, int width) {
        simd::for_each_vector(width, [&](int x, int count) {
            simd::Words sum = simd::Words::all(0);
            for (int i = 1; i < window.count(); ++i) sum = sum + load(window[i], x, count);
            remaining_.put(x, sum);
            columns_.put(x, sum + load(window[0], x, count));
        });
    }
    void down_one(const RowWindow<Gray8>& window, int width) {
        const Gray8* first = window[0];
        const Gray8* last = window[window.count() - 1];
        simd::WordLine columns = columns_;
        simd::WordLine remaining = remaining_;
        simd::for_each_vector(
            width, [&](int x, int count) __attribute__((always_inline)) {
                const simd::Words sum = remaining.at<0>(x) + load(last, x, count);
                columns.put(x, sum);
                remaining.put(x, sum - load(first, x, count));
            });
    }
    void continue_ends(int width) {
        for (int i = 1; i <= element_.width / 2; ++i) {
            const int left = border_index(border_, -i, width);
            const int right = border_index(border_, width - 1 + i, width);
            columns_.set(-i, left == no_index ? std::uint16_t{0} : columns_.value(left));
            columns_.set(width - 1 + i, right == no_index ? std::uint16_t{0} : columns_.value(right));
        }
    }

    // ---- Across ----

    /// Sums of 4 and of 16 columns from each column on: a width is so many of them and so many columns.
    void add_fours(int width) {
        const simd::WordLine columns = columns_;
        simd::WordLine fours = fours_;
        simd::WordLine sixteens = sixteens_;
        simd::WordLine coarse_sixteens = coarse_sixteens_;
        const int reach = element_.width / 2;
        const int begin = -(reach + reach % 2);
        if (element_.width < 3) return;
        // Up to five columns beyond the window are added and subtracted again.
        for (int x = begin; x <= width + reach + 2; x += simd::lanes)
            fours.put(x, (columns.at<0>(x) + columns.at<1>(x)) + (columns.at<2>(x) + columns.at<3>(x)));
        if (element_.width < (narrow() ? 16 : 15)) return;
        for (int x = begin; x <= width + reach - 10; x += simd::lanes) {
            const simd::Words a = fours.at<0>(x);
            const simd::Words b = fours.at<4>(x);
            const simd::Words c = fours.at<8>(x);
            const simd::Words d = fours.at<12>(x);
            sixteens.put(x, (a + b) + (c + d));
            coarse_sixteens.put(x, ((a >> coarse) + (b >> coarse)) + ((c >> coarse) + (d >> coarse)));
        }
    }
    simd::Words across_narrow(int x) const {
        int offset = -(element_.width / 2);
        simd::Words sum = columns_.at(x, offset++);
        for (int i = element_.width % 4; i > 1; --i) sum = sum + columns_.at(x, offset++);
        for (int i = element_.width / 4 % 4; i > 0; --i, offset += 4) sum = sum + fours_.at(x, offset);
        for (int i = element_.width / 16; i > 0; --i, offset += 16) sum = sum + sixteens_.at(x, offset);
        return sum;
    }
    void divide_narrow(int width, Gray8* dst) const {
        const int area = element_.width * element_.height;
        const simd::Words half = simd::Words::all(static_cast<std::uint16_t>(area / 2));
        // The reciprocal rounded down gives a quotient that is right or one too small.
        const auto reciprocal = static_cast<std::uint16_t>(area == 1 ? 65535 : 65536 / area);
        const simd::Words one = simd::Words::all(1);
        const simd::Words divisor = simd::Words::all(static_cast<std::uint16_t>(area));
        simd::for_each_vector(width, [&](int x, int count) {
            const simd::Words sum = across_narrow(x) + half;
            const simd::Words quotient = times_high(sum, reciprocal);
            const simd::Words rest = sum - quotient * static_cast<std::uint16_t>(area);
            (quotient + (at_least(rest, divisor) & one)).narrow().store(dst + x, count);
        });
    }

    /// Sums of more than 16 bits: their low 16 bits, and in 64ths, rounded down in every sum of 1 to 4
    /// columns.
    struct WideSum {
        simd::Words low;
        simd::Words coarse;
    };
    static constexpr int coarse = 6;

    /// A width as few sums: 31 is two sixteens less one. Fours may be -1 too.
    struct Parts {
        explicit Parts(int width)
            : reach(width / 2),
              sixteens((width + 1) / 4 / 4),
              fours((width + 1) / 4 % 4),
              one_more(width % 4 == 1) {
            if (sixteens == 0 || fours < 3) return;
            ++sixteens;
            fours = -1;
        }
        int reach, sixteens, fours;
        bool one_more;
    };

    /// Copies of lines, so that no pixel written can change them.
    struct Lines {
        simd::WordLine columns, fours, sixteens, coarse_sixteens;
        Parts parts;
    };

    [[gnu::always_inline]] static WideSum across_wide(const Lines& from, int x) {
        const Parts parts = from.parts;
        int offset = -parts.reach;
        simd::Words low = simd::Words::all(0);
        simd::Words high = low;
        for (int i = parts.sixteens; i > 0; --i, offset += 16) {
            low = low + from.sixteens.at(x, offset);
            high = high + from.coarse_sixteens.at(x, offset);
        }
        for (int i = parts.fours; i > 0; --i, offset += 4) {
            const simd::Words four = from.fours.at(x, offset);
            low = low + four;
            high = high + (four >> coarse);
        }
        if (parts.fours < 0) {
            offset -= 4;
            const simd::Words four = from.fours.at(x, offset);
            low = low - four;
            high = high - (four >> coarse);
        }
        if (parts.one_more) {
            const simd::Words one = from.columns.at(x, offset);
            return {low + one, high + (one >> coarse)};
        }
        const simd::Words one = from.columns.at(x, offset - 1);
        return {low - one, high - (one >> coarse)};
    }
    void divide_wide(int width, Gray8* dst) const {
        const Lines from{columns_, fours_, sixteens_, coarse_sixteens_, Parts(element_.width)};
        const int area = element_.width * element_.height;
        const auto divisor = static_cast<std::uint16_t>(area);
        const simd::Words half = simd::Words::all(static_cast<std::uint16_t>(area / 2));
        const simd::Words one = simd::Words::all(1);
        // 16 / area in 2^-16, rounded down.
        const auto reciprocal = static_cast<std::uint16_t>((1 << 20) / area);
        simd::for_each_vector(
            width, [&](int x, int count) __attribute__((always_inline)) {
                const WideSum sum = across_wide(from, x);
                const simd::Words low = sum.low + half;
                // At most 18 sums were rounded, 2 of them subtracted: what 64 coarse is too little is below
                // 64 * 17 + area / 2 and above area / 2 - 128, which is not below 0 for areas above 255. So
                // its low 16 bits tell it, and with it the sum in 16ths. The quotient of these is right or
                // one too small: sum < 256 area, so it lacks less than 255.5 area / 2^20 + 15 / area < 1.
                const simd::Words lacking = low - (sum.coarse << coarse);
                const simd::Words quotient =
                    times_high((sum.coarse << (coarse - 4)) + (lacking >> 4), reciprocal);
                const simd::Words rest = low - quotient * divisor;
                (quotient + (at_least(rest, simd::Words::all(divisor)) & one)).narrow().store(dst + x, count);
            });
    }

    Size element_{1, 1};
    Border border_ = Border::replicate;
    /// Sums of the columns, and those without the first row of the window.
    simd::WordLine columns_, remaining_;
    simd::WordLine fours_, sixteens_, coarse_sixteens_;
};

/// The row kernel of box(). Words, whose numbers share a register, cannot let sums grow beyond 16 bits.
using BoxRow = std::conditional_t<(simd::lanes > 4), BoxVectorRow, BoxRunningRow>;

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
