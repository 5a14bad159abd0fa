// SPDX-License-Identifier: MIT
//
// FilterRow: the row kernel of a filter that is given as two expressions. down() combines the pixels of the
// rows at one column into scratch lines; the lines are continued beyond both ends as the border says;
// across() combines neighbours within the lines. No pixel is ever asked whether it lies at the border.
//
// A filter is an object with
//     static constexpr int rows;                   height of its window, odd
//     static constexpr int reach;                  how far across() looks to either side
//     static constexpr int byte_lines, word_lines; the lines it wants
//     using Output = ...;                          Gray8 or Gradient16
//     void down(FilterLines<Filter>& lines, int x, Bytes...) const;       a pixel vector of every row
//     Bytes or Words across(const FilterLines<Filter>& lines, int x) const;
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {
inline namespace FOVEA_ISA {

/// Lines begin where a vector is quickest loaded and stored.
inline constexpr int line_alignment = 64;

/// The scratch lines of a filter, by number.
template <class Filter>
class FilterLines {
public:
    static constexpr std::int64_t scratch(int width) {
        return Filter::byte_lines * aligned(byte_line_scratch(width)) +
               Filter::word_lines * aligned(word_line_scratch(width)) + line_alignment - 1;
    }
    FilterLines() = default;
    FilterLines(Span<std::uint8_t> bytes, int width)
        : FilterLines(from_aligned(bytes), width, std::make_integer_sequence<int, Filter::byte_lines>(),
                      std::make_integer_sequence<int, Filter::word_lines>()) {}

    template <int Number = 0>
    [[gnu::always_inline]] simd::ByteLine& bytes() {
        return bytes_[Number];
    }
    template <int Number = 0>
    [[gnu::always_inline]] const simd::ByteLine& bytes() const {
        return bytes_[Number];
    }
    template <int Number = 0>
    [[gnu::always_inline]] simd::WordLine& words() {
        return words_[Number];
    }
    template <int Number = 0>
    [[gnu::always_inline]] const simd::WordLine& words() const {
        return words_[Number];
    }

    /// Column from stands for column to in every line.
    void repeat(int from, int to) {
        if constexpr (Filter::byte_lines > 0)
            for (simd::ByteLine& line : bytes_) line.set(to, line.value(from));
        if constexpr (Filter::word_lines > 0)
            for (simd::WordLine& line : words_) line.set(to, line.value(from));
    }

private:
    static constexpr int aligned(int bytes) {
        return (bytes + line_alignment - 1) / line_alignment * line_alignment;
    }
    static std::uint8_t* from_aligned(Span<std::uint8_t> bytes) {
        const auto over = reinterpret_cast<std::uintptr_t>(bytes.data() + max_reach) % line_alignment;
        return bytes.data() + (line_alignment - static_cast<int>(over)) % line_alignment;
    }
    template <int... B, int... W>
    FilterLines(std::uint8_t* first, int width, std::integer_sequence<int, B...>,
                std::integer_sequence<int, W...>)
        : bytes_{simd::ByteLine(
              span_at(first, B * aligned(byte_line_scratch(width)), byte_line_scratch(width)), width)...},
          words_{simd::WordLine(span_at(first + Filter::byte_lines * aligned(byte_line_scratch(width)),
                                        W * aligned(word_line_scratch(width)), word_line_scratch(width)),
                                width)...} {}
    static Span<std::uint8_t> span_at(std::uint8_t* first, int offset, int bytes) {
        return {first + offset, bytes};
    }

    // An array of length 0 is not allowed; what a filter does not want is an empty object.
    struct None {};
    template <class Line, int Count>
    using Lines =
        std::conditional_t<Count == 0, None, Line[static_cast<std::size_t>(Count == 0 ? 1 : Count)]>;
    Lines<simd::ByteLine, Filter::byte_lines> bytes_{};
    Lines<simd::WordLine, Filter::word_lines> words_{};
};

/// The row kernel of Filter.
template <class Filter>
class FilterRow {
public:
    using Input = Gray8;
    using Output = typename Filter::Output;

    /// Bytes of scratch: the lines.
    static constexpr std::int64_t scratch(int width) { return FilterLines<Filter>::scratch(width); }

    FilterRow() = default;
    FilterRow(const Filter& filter, Border border, Span<std::uint8_t> scratch, int width)
        : filter_(filter), border_(border), lines_(scratch, width) {
        // across() also computes columns beyond the end, which nobody stores. What stands there must be
        // numbers that down() could have made: with two numbers in a word, others would carry into their
        // neighbour.
        std::memset(scratch.data(), 0, static_cast<std::size_t>(FilterRow::scratch(width)));
    }

    static constexpr int rows() { return Filter::rows; }

    void operator()(const RowWindow<Gray8>& window, Output* dst) {
        run(window, dst, std::make_integer_sequence<int, Filter::rows>());
    }

private:
    template <int... I>
    [[gnu::always_inline]] void run(const RowWindow<Gray8>& window, Output* dst,
                                    std::integer_sequence<int, I...>) {
        // Copies, so that no store makes the compiler load them again.
        const Gray8* const rows[] = {window[I]...};
        const int width = window.width();
        FilterLines<Filter> lines = lines_;
        const Filter filter = filter_;
        int x = 0;
        for (; x + simd::lanes <= width; x += simd::lanes)
            filter.down(lines, x, simd::Bytes::load(rows[I] + x)...);
        if (x < width) filter.down(lines, x, simd::Bytes::load(rows[I] + x, width - x)...);
        continue_ends(lines, width);
        for (x = 0; x + simd::lanes <= width; x += simd::lanes) filter.across(lines, x).store(dst + x);
        if (x < width) filter.across(lines, x).store(dst + x, width - x);
    }
    /// Beyond a zero border down() would have seen nothing but zeros.
    void continue_ends(FilterLines<Filter>& lines, int width) {
        for (int i = 1; i <= Filter::reach; ++i) {
            const int left = border_index(border_, -i, width);
            const int right = border_index(border_, width - 1 + i, width);
            if (left == no_index) continue;
            lines.repeat(left, -i);
            lines.repeat(right, width - 1 + i);
        }
        if (border_ == Border::zero) zero_ends(lines, width);
    }
    void zero_ends(FilterLines<Filter>& lines, int width) {
        // Columns that across() does not read serve to hold what down() makes of zeros.
        constexpr int aside = -max_reach;
        static_assert(Filter::reach + 2 <= max_reach, "the first columns of a line are free");
        const int last = width + Filter::reach;
        zeros_down(lines, last + last % 2, std::make_integer_sequence<int, Filter::rows>());
        lines.repeat(last + last % 2, aside);
        for (int i = 1; i <= Filter::reach; ++i) {
            lines.repeat(aside, -i);
            lines.repeat(aside, width - 1 + i);
        }
    }
    template <int... I>
    void zeros_down(FilterLines<Filter>& lines, int x, std::integer_sequence<int, I...>) {
        filter_.down(lines, x, ((void)I, simd::Bytes::all(0))...);
    }

    Filter filter_{};
    Border border_ = Border::replicate;
    FilterLines<Filter> lines_{};
};

/// Bytes of scratch that filter_frame() needs: the lines, and a row of zeros.
template <class Filter>
constexpr std::int64_t filter_scratch(Size size) {
    return size.width + FilterRow<Filter>::scratch(size.width);
}

/// Runs a filter over a whole frame, after the checks of every filter.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none
/// Scratch  filter_scratch<Filter>(src.size())
/// Errors   empty_image, size_mismatch, scratch_too_small
template <class Filter>
Status filter_frame(const Filter& filter, ImageView<const Gray8> src, Border border,
                    Span<std::uint8_t> scratch, ImageView<typename Filter::Output> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (scratch.size() < filter_scratch<Filter>(src.size())) return Status::scratch_too_small;
    std::memset(scratch.data(), 0, static_cast<std::size_t>(src.width()));
    FilterRow<Filter> kernel(filter, border, scratch.from(src.width()), src.width());
    for_each_row(src, border, kernel, dst, scratch.data());
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
