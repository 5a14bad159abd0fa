// SPDX-License-Identifier: MIT
//
// What erosion and dilation with a rectangle are made of: extremes of columns, then of the rows they gave.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>
#include <fovea/simd/unroll.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The largest side of a structuring rectangle.
inline constexpr int max_element_side = max_window_rows;

inline namespace FOVEA_ISA {
namespace kernels {

struct Lowest {
    static constexpr std::uint8_t neutral = 255;
    [[gnu::always_inline]] static simd::Bytes of(simd::Bytes a, simd::Bytes b) { return lower(a, b); }
};
struct Highest {
    static constexpr std::uint8_t neutral = 0;
    [[gnu::always_inline]] static simd::Bytes of(simd::Bytes a, simd::Bytes b) { return higher(a, b); }
};

/// The row kernel of erosion and dilation, for rows that come one at a time.
template <class Extreme>
class ExtremeRow;

/// Rows first..last of an erosion or dilation with a rectangle; dst holds those rows alone.
///
/// Border   the outermost pixels repeat
/// Scratch  two lines: 2 * byte_line_scratch(src.width())
template <class Extreme>
void extreme_rows(ImageView<const Gray8> src, Size element, int first, int last, Span<std::uint8_t> scratch,
                  ImageView<Gray8> dst);

/// Rows of a strip, which the steps of an operator pass on while they are in the cache.
inline constexpr int strip_rows = 16;

/// Rows between two steps that two_steps() keeps at a time: a strip and what its windows reach.
constexpr int between_rows(int height) { return minimum(height, max_element_side - 1 + strip_rows); }

/// A first erosion or dilation, whose rows a second step takes strip by strip, top to bottom:
/// second(between, first, last, y) for rows y.. of the frame, which are first..last of between. Beyond them
/// there are as many rows as the element reaches, or the border of the frame is the border of between.
///
/// Overlap  second may write rows y.. of src: they are not read again
/// Scratch  two lines, which second may use, and between_rows(src.height()) rows
template <class First, class Second>
void two_steps(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch, Second second);

// ---- Implementation ---------------------------------------------------------------

/// Rows that are made together: neighbours share all but one row of their windows. Small registers hold
/// fewer.
inline constexpr int most_rows_together = simd::lanes == 4 ? 4 : 8;

/// The extremes of Rows windows of height rows, each a row below the one before: put(i, extreme) for the
/// window whose uppermost row is load(i). What all windows have in common is computed once, so a row costs
/// height / Rows + 2 comparisons. Rows is at most height, which may be a constant.
template <class Extreme, int Rows, class Height, class Load, class Put>
[[gnu::always_inline]] inline void extremes_down(Height height, Load load, Put put) {
    simd::Bytes
        upper[static_cast<std::size_t>(Rows)];  // of rows i.. down to the lowest that all windows have
    simd::Bytes common = load(Rows - 1);
    for (int i = Rows; i < height; ++i) common = Extreme::of(common, load(i));
    upper[Rows - 1] = common;
    simd::unroll<Rows - 1>([&](auto n) {
        constexpr int i = Rows - 2 - n;
        upper[i] = Extreme::of(upper[i + 1], load(i));
    });
    put(0, upper[0]);
    if constexpr (Rows > 1) {
        simd::Bytes lower_part = load(height);
        put(1, Extreme::of(upper[1], lower_part));
        simd::unroll<Rows - 2>([&](auto n) {
            constexpr int i = 2 + n;
            lower_part = Extreme::of(lower_part, load(height + i - 1));
            put(i, Extreme::of(upper[i], lower_part));
        });
    }
}

/// The same for whole rows: row_at(i) is a row of the windows, out(i) where the i-th result begins. What
/// stands behind a row's end in a line may be written, in an image not.
template <class Extreme, int Rows, class Height, class RowAt, class Out>
[[gnu::always_inline]] inline void rows_down(Height height, int width, RowAt row_at, Out out) {
    int x = 0;
    for (; x + simd::lanes <= width; x += simd::lanes)
        extremes_down<Extreme, Rows>(
            height, [&](int i) { return simd::Bytes::load(row_at(i) + x); },
            [&](int i, simd::Bytes extreme) { extreme.store(out(i) + x); });
    const int rest = width - x;
    if (rest > 0)
        extremes_down<Extreme, Rows>(
            height, [&](int i) { return simd::Bytes::load(row_at(i) + x, rest); },
            [&](int i, simd::Bytes extreme) { extreme.store(out(i) + x, rest); });
}

/// The extreme of four windows of the line, each step columns right of the one before, from x on.
template <class Extreme>
[[gnu::always_inline]] inline simd::Bytes four_at(const std::uint8_t* pixels, int step) {
    return Extreme::of(
        Extreme::of(simd::Bytes::load(pixels), simd::Bytes::load(pixels + step)),
        Extreme::of(simd::Bytes::load(pixels + 2 * step), simd::Bytes::load(pixels + 3 * step)));
}

/// The extremes of four columns from each column on, for a row with its border repeated reach times.
template <class Extreme>
void quads_of_row(const Gray8* row, int width, int reach, simd::ByteLine& line) {
    constexpr int lanes = simd::lanes;
    std::uint8_t* pixels = line.pixels();
    const int inside = width - 3 >= lanes ? (width - 3) / lanes * lanes : 0;  // windows that need no border
    std::memset(pixels - reach, row[0], static_cast<std::size_t>(reach));
    std::memcpy(pixels + inside, row + inside, static_cast<std::size_t>(width - inside));
    std::memset(pixels + width, row[width - 1], static_cast<std::size_t>(reach));
    int x = -reach;
    if (inside > 0) {
        std::memcpy(pixels, row, 3);
        for (; x < 0; x += lanes) line.put(x, four_at<Extreme>(pixels + x, 1));
        for (x = 0; x < inside; x += lanes) line.put(x, four_at<Extreme>(row + x, 1));
    }
    for (; x <= width + reach - 4; x += lanes) line.put(x, four_at<Extreme>(pixels + x, 1));
}

/// dst[x] = the extreme of Windows windows of the line, step columns apart but for the last.
template <class Extreme, int Windows>
[[gnu::always_inline]] inline void join_windows(const std::uint8_t* first, int step, int last_step, int width,
                                                Gray8* dst) {
    simd::for_each_vector(width, [&](int x, int count) {
        simd::Bytes extreme =
            Extreme::of(simd::Bytes::load(first + x), simd::Bytes::load(first + x + last_step));
        if constexpr (Windows > 2) extreme = Extreme::of(extreme, simd::Bytes::load(first + x + step));
        if constexpr (Windows > 3) extreme = Extreme::of(extreme, simd::Bytes::load(first + x + 2 * step));
        if (count == simd::lanes)
            extreme.store(dst + x);
        else
            extreme.store(dst + x, count);
    });
}

/// The extremes of three columns of a line whose border is filled.
template <class Extreme>
void three_across(const simd::ByteLine& line, int width, Gray8* dst) {
    simd::for_each_vector(width, [&](int x, int count) {
        const simd::Bytes extreme = Extreme::of(Extreme::of(line.at(x - 1), line.at(x)), line.at(x + 1));
        if (count == simd::lanes)
            extreme.store(dst + x);
        else
            extreme.store(dst + x, count);
    });
}

/// The extremes of side columns of a row, 5 or more: of 4, 16 columns from each column on, in place, until at
/// most four of them cover the window. dst may be the row.
template <class Extreme>
void wide_across(const Gray8* row, int width, int side, simd::ByteLine& line, Gray8* dst) {
    const int reach = side / 2;
    quads_of_row<Extreme>(row, width, reach, line);
    int covered = 4;
    for (; 4 * covered <= side; covered *= 4)
        for (int x = -reach; x <= width + reach - 4 * covered; x += simd::lanes)
            line.put(x, four_at<Extreme>(line.pixels() + x, covered));
    const std::uint8_t* first = line.pixels() - reach;
    const int last = side - covered;
    if (side <= 2 * covered)
        join_windows<Extreme, 2>(first, covered, last, width, dst);
    else if (side <= 3 * covered)
        join_windows<Extreme, 3>(first, covered, last, width, dst);
    else
        join_windows<Extreme, 4>(first, covered, last, width, dst);
}

/// All widths of an element, for a row that stands in dst.
template <class Extreme>
void across_in_place(int width, int side, simd::ByteLine& line, Gray8* dst) {
    if (side == 1) return;
    if (side > 3) return wide_across<Extreme>(dst, width, side, line, dst);
    std::memcpy(line.pixels(), dst, static_cast<std::size_t>(width));
    line.replicate(width, 1);
    three_across<Extreme>(line, width, dst);
}

/// put(x, extreme, count) for the columns of rows first..height - 1 of a window: a few vectors abreast, so
/// that the pointer of a row is fetched once for all of them and none waits for the one before.
template <class Extreme, class Height, class Put>
[[gnu::always_inline]] inline void window_down(const RowWindow<Gray8>& window, int first, Height height,
                                               Put put) {
    using simd::Bytes;
    constexpr int lanes = simd::lanes;
    constexpr int abreast = lanes == 4 ? 2 : 4;
    const int width = window.width();
    int x = 0;
    for (; x + abreast * lanes <= width; x += abreast * lanes) {
        Bytes extreme[abreast];
        simd::unroll<abreast>([&](auto k) { extreme[k] = Bytes::load(window[first] + x + k * lanes); });
        for (int i = first + 1; i < height; ++i) {
            const Gray8* row = window[i] + x;
            simd::unroll<abreast>(
                [&](auto k) { extreme[k] = Extreme::of(extreme[k], Bytes::load(row + k * lanes)); });
        }
        simd::unroll<abreast>([&](auto k) { put(x + k * lanes, extreme[k], lanes); });
    }
    for (; x < width; x += lanes) {
        const int count = minimum(lanes, width - x);
        Bytes extreme = Bytes::load(window[first] + x, count);
        for (int i = first + 1; i < height; ++i)
            extreme = Extreme::of(extreme, Bytes::load(window[i] + x, count));
        put(x, extreme, count);
    }
}

/// Windows from this height on share all but one row with the next one.
inline constexpr int least_shared_height = 5;

/// follows says that the window is one row below that of the call before. Of tall windows every second one
/// leaves what it shares with the next.
template <class Extreme>
class ExtremeRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    /// A line, and of tall windows a row that two of them share.
    static constexpr std::int64_t scratch(Size element, int width) {
        return byte_line_scratch(width) + (element.height < least_shared_height ? 0 : std::int64_t{width});
    }

    ExtremeRow() = default;
    ExtremeRow(Size element, Span<std::uint8_t> scratch, int width)
        : element_(element), line_(scratch, width), shared_(scratch.data() + byte_line_scratch(width)) {}

    int rows() const { return element_.height; }

    void operator()(const RowWindow<Gray8>& window, Gray8* dst) { (*this)(window, false, dst); }
    void operator()(const RowWindow<Gray8>& window, bool follows, Gray8* dst) {
        const int width = window.width();
        const bool three = element_.width == 3;
        down(window, follows, three ? line_.pixels() : dst);
        if (three) {
            line_.replicate(width, 1);
            three_across<Extreme>(line_, width, dst);
        } else {
            across_in_place<Extreme>(width, element_.width, line_, dst);
        }
    }

private:
    void down(const RowWindow<Gray8>& window, bool follows, Gray8* out) {
        using simd::Bytes;
        const int height = window.count();
        const auto store = [&](int x, Bytes extreme, int count) { extreme.store(out + x, count); };
        is_shared_ = height >= least_shared_height && !(follows && is_shared_);
        if (height == 3) {
            window_down<Extreme>(window, 0, std::integral_constant<int, 3>(), store);
        } else if (height < least_shared_height) {
            window_down<Extreme>(window, 0, height, store);
        } else if (is_shared_) {
            window_down<Extreme>(window, 1, height, [&](int x, Bytes extreme, int count) {
                extreme.store(shared_ + x, count);
                store(x, Extreme::of(extreme, Bytes::load(window[0] + x, count)), count);
            });
        } else {
            const Gray8* const two[] = {shared_, window[height - 1]};
            window_down<Extreme>({two, 2, window.width()}, 0, std::integral_constant<int, 2>(), store);
        }
    }

    Size element_{1, 1};
    simd::ByteLine line_;
    Gray8* shared_ = nullptr;
    bool is_shared_ = false;  ///< whether shared_ holds what the next window needs
};

/// Rows first..last in groups of Rows, and what is left one by one; height is that of the element.
template <class Extreme, int Rows, class Height>
void extreme_rows_together(ImageView<const Gray8> src, Size element, Height height, int first, int last,
                           Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    const int width = src.width();
    const int reach = element.height / 2;
    const auto line_bytes = static_cast<std::ptrdiff_t>(byte_line_scratch(width));
    simd::ByteLine lines[2] = {{scratch, width}, {scratch.from(line_bytes), width}};
    const auto group = [&](auto rows, int y) {
        // A window of three columns is made from a line, all others where the row will stand.
        constexpr int count = decltype(rows)::value;
        const bool three = count <= 2 && element.width == 3;
        Gray8* out[static_cast<std::size_t>(count)];
        for (int i = 0; i < count; ++i) out[i] = three ? lines[i].pixels() : dst.row(y - first + i);
        const auto down = [&](auto row_at) {
            rows_down<Extreme, count>(height, width, row_at, [&](int i) { return out[i]; });
        };
        if (y >= reach && y + count - 1 + reach < src.height()) {
            const Gray8* top = src.row(y - reach);
            const std::ptrdiff_t stride = src.stride_bytes();
            down([=](int i) { return top + i * stride; });
        } else {
            const Gray8* window[max_element_side + most_rows_together];
            for (int i = 0; i < element.height + count - 1; ++i)
                window[i] = src.row(border_index(Border::replicate, y - reach + i, src.height()));
            down([&](int i) { return window[i]; });
        }
        for (int i = 0; i < count; ++i) {
            if (three) {
                lines[i].replicate(width, 1);
                three_across<Extreme>(lines[i], width, dst.row(y - first + i));
            } else {
                across_in_place<Extreme>(width, element.width, lines[0], dst.row(y - first + i));
            }
        }
    };
    int y = first;
    for (; y + Rows - 1 <= last; y += Rows) group(std::integral_constant<int, Rows>(), y);
    for (; y <= last; ++y) group(std::integral_constant<int, 1>(), y);
}

template <class Extreme>
void extreme_rows(ImageView<const Gray8> src, Size element, int first, int last, Span<std::uint8_t> scratch,
                  ImageView<Gray8> dst) {
    FOVEA_ASSERT(last - first < dst.height() && scratch.size() >= 2 * byte_line_scratch(src.width()));
    const int height = element.height;
    constexpr std::integral_constant<int, 3> three{};  // The most frequent one.
    if (height == 1)
        extreme_rows_together<Extreme, 1>(src, element, height, first, last, scratch, dst);
    else if (height == three)
        extreme_rows_together<Extreme, 2>(src, element, three, first, last, scratch, dst);
    else if (height < 5 || element.width == 3)
        extreme_rows_together<Extreme, 2>(src, element, height, first, last, scratch, dst);
    else if (height < most_rows_together)
        extreme_rows_together<Extreme, 4>(src, element, height, first, last, scratch, dst);
    else
        extreme_rows_together<Extreme, most_rows_together>(src, element, height, first, last, scratch, dst);
}

template <class First, class Second>
void two_steps(ImageView<const Gray8> src, Size element, Span<std::uint8_t> scratch, Second second) {
    const int width = src.width();
    const int height = src.height();
    const int reach = element.height / 2;
    const int room = between_rows(height);
    const std::ptrdiff_t lines_bytes = 2 * static_cast<std::ptrdiff_t>(byte_line_scratch(width));
    const ImageView<Gray8> rows(scratch.from(lines_bytes).data(), {width, room}, width);
    int top = 0;   // of the frame, where rows begins
    int made = 0;  // rows of the first step
    for (int y = 0; y < height; y += strip_rows) {
        const int last = minimum(y + strip_rows, height) - 1;
        const int wanted = minimum(last + reach + 1, height);
        if (wanted - top > room) {
            const int next_top = maximum(y - reach, 0);
            std::memmove(rows.row(0), rows.row(next_top - top),
                         static_cast<std::size_t>(width) * static_cast<std::size_t>(made - next_top));
            top = next_top;
        }
        if (wanted > made) {
            const ImageView<Gray8> fresh(rows.row(made - top), {width, wanted - made}, width);
            extreme_rows<First>(src, element, made, wanted - 1, scratch, fresh);
            made = wanted;
        }
        second(ImageView<const Gray8>(rows.row(0), {width, made - top}, width), y - top, last - top, y);
    }
}

}  // namespace kernels
}  // namespace FOVEA_ISA
}  // namespace fovea
