// SPDX-License-Identifier: MIT
//
// Image pyramids: half the size after a low-pass, and twice the size. Book sec. 2.9.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The size of the next level: every second pixel, the first one included.
constexpr Size pyramid_down_size(Size size) {
    return {size.width - size.width / 2, size.height - size.height / 2};
}

inline namespace FOVEA_ISA {

/// Scratch bytes of the two, for a source of that size: one line.
constexpr std::int64_t pyramid_down_scratch(Size size);
constexpr std::int64_t pyramid_up_scratch(Size size);

/// Every second pixel of src after a low-pass of 1 4 6 4 1 along rows and columns.
///
/// Shapes    src 1x1 or larger; dst pyramid_down_size(src.size()). Pixel (x, y) of dst lies on (2x, 2y) of
///           src
/// Units     any 8-bit values
/// Rounding  nearest, ties up, once; the largest sum is 255 * 256 and fits 16 bits
/// Border    the outermost pixels repeat
/// Overlap   none
/// Scratch   pyramid_down_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, image_too_large, scratch_too_small
/// Source    Burt and Adelson's pyramid with binomial weights. An output row needs 5 source rows
inline Status pyramid_down(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst);

/// Twice the size: pixels on those of src get weights of 1 6 1 eighths, those between 4 4.
///
/// Shapes    dst twice as wide and high as src; src up to 16383x16383. Pixel (x, y) of src lies on (2x, 2y)
/// Rounding  nearest, ties up, once; the largest sum is 255 * 64
/// Scratch   pyramid_up_scratch(src.size()) bytes, undefined afterwards
/// Source    as pyramid_down(). An output row needs 3 source rows
/// Others    as pyramid_down()
inline Status pyramid_up(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// Values before and behind those of a line: one for the neighbour, the rest of a vector.
inline constexpr int pyramid_margin = 1 + simd::lanes;

}  // namespace kernels

constexpr std::int64_t pyramid_down_scratch(Size size) {
    return 2 * arena_bytes<std::uint16_t>(pyramid_down_size(size).width +
                                          std::int64_t{2} * kernels::pyramid_margin);
}
constexpr std::int64_t pyramid_up_scratch(Size size) {
    return arena_bytes<std::uint16_t>(size.width + std::int64_t{2} * kernels::pyramid_margin);
}

namespace kernels {

[[gnu::always_inline]] inline simd::RawWords load_words(const std::uint16_t* from) {
    simd::RawWords words;
    std::memcpy(&words, from, sizeof words);
    return words;
}
[[gnu::always_inline]] inline void store_words(simd::RawWords words, std::uint16_t* to) {
    std::memcpy(to, &words, sizeof words);
}

/// a + 4 b + 6 c + 4 d + e
template <class Values>
[[gnu::always_inline]] inline Values binomial(Values a, Values b, Values c, Values d, Values e) {
    return a + e + ((b + c + d) << 2) + (c << 1);
}

/// Makes rows of pyramid_down() from five source rows each.
class PyramidDownRow {
public:
    PyramidDownRow(int width, Span<std::uint8_t> scratch) : width_(width), half_(width - width / 2) {
        Arena arena(scratch);
        even_ =
            arena.take<std::uint16_t>(half_ + 2 * kernels::pyramid_margin).data() + kernels::pyramid_margin;
        odd_ =
            arena.take<std::uint16_t>(half_ + 2 * kernels::pyramid_margin).data() + kernels::pyramid_margin;
    }

    void operator()(const Gray8* const (&rows)[5], Gray8* dst) {
        down(rows);
        even_[-1] = odd_[-1] = even_[0];
        if (width_ % 2 != 0)
            odd_[half_ - 1] = even_[half_] = even_[half_ - 1];
        else
            even_[half_] = odd_[half_ - 1];
        for (int x = 0; x < half_; x += simd::lanes) {
            const simd::Bytes pixels = simd::narrowed(across(x), across(x + simd::half_lanes));
            if (x + simd::lanes <= half_)
                pixels.store(dst + x);
            else
                pixels.store(dst + x, half_ - x);
        }
    }

private:
    /// The sums of columns, even and odd ones apart; at most 255 * 16.
    void down(const Gray8* const (&rows)[5]) {
        const Gray8* a = rows[0];
        const Gray8* b = rows[1];
        const Gray8* c = rows[2];
        const Gray8* d = rows[3];
        const Gray8* e = rows[4];
        const auto sums = [&](auto load, int x) {
            const simd::Words sum =
                binomial(simd::Words(load(a + x)), simd::Words(load(b + x)), simd::Words(load(c + x)),
                         simd::Words(load(d + x)), simd::Words(load(e + x)));
            store_words(sum.even, even_ + x / 2);
            store_words(sum.odd, odd_ + x / 2);
        };
        int x = 0;
        for (; x + simd::lanes <= width_; x += simd::lanes)
            sums([](const Gray8* from) { return simd::Bytes::load(from); }, x);
        const int rest = width_ - x;
        if (rest > 0) sums([=](const Gray8* from) { return simd::Bytes::load(from, rest); }, x);
    }
    /// Half a vector of pixels. Behind the row they are of no use but below 256: line values are below 2^12.
    [[gnu::always_inline]] simd::RawWords across(int x) const {
        using simd::plus;
        using simd::shift_left;
        const simd::RawWords middle = load_words(even_ + x);
        const simd::RawWords outer = plus(load_words(even_ + x - 1), load_words(even_ + x + 1));
        const simd::RawWords inner = plus(plus(load_words(odd_ + x - 1), load_words(odd_ + x)), middle);
        const simd::RawWords sum = plus(plus(outer, shift_left(inner, 2)), shift_left(middle, 1));
        return simd::shift_right(plus(sum, simd::all_words(128)), 8);
    }

    int width_;
    int half_;
    std::uint16_t* even_;
    std::uint16_t* odd_;
};

/// Makes pairs of rows of pyramid_up() from three source rows.
class PyramidUpRow {
public:
    PyramidUpRow(int width, Span<std::uint8_t> scratch)
        : width_(width),
          line_(Arena(scratch).take<std::uint16_t>(width + 2 * kernels::pyramid_margin).data() +
                kernels::pyramid_margin) {}

    /// The row on the source row here.
    void even(const Gray8* above, const Gray8* here, const Gray8* below, Gray8* dst) {
        using simd::plus;
        using simd::shift_left;
        using simd::widened;
        int x = 0;
        for (; x + simd::half_lanes <= width_; x += simd::half_lanes) {
            const simd::RawWords middle = widened(here + x);
            const simd::RawWords six = plus(shift_left(middle, 2), shift_left(middle, 1));
            store_words(plus(plus(widened(above + x), widened(below + x)), six), line_ + x);
        }
        for (; x < width_; ++x) line_[x] = static_cast<std::uint16_t>(above[x] + 6 * here[x] + below[x]);
        across(dst);
    }
    /// The row between here and below.
    void odd(const Gray8* here, const Gray8* below, Gray8* dst) {
        int x = 0;
        for (; x + simd::half_lanes <= width_; x += simd::half_lanes)
            store_words(simd::shift_left(simd::plus(simd::widened(here + x), simd::widened(below + x)), 2),
                        line_ + x);
        for (; x < width_; ++x) line_[x] = static_cast<std::uint16_t>(4 * (here[x] + below[x]));
        across(dst);
    }

private:
    void across(Gray8* dst) {
        using simd::plus;
        using simd::shift_left;
        line_[-1] = line_[0];
        line_[width_] = line_[width_ - 1];
        const simd::RawWords half = simd::all_words(32);
        for (int x = 0; x < width_; x += simd::half_lanes) {
            const simd::RawWords here = load_words(line_ + x);
            const simd::RawWords right = load_words(line_ + x + 1);
            const simd::RawWords six = plus(shift_left(here, 2), shift_left(here, 1));
            const simd::RawWords on = plus(plus(load_words(line_ + x - 1), six), plus(right, half));
            const simd::RawWords between = plus(shift_left(plus(here, right), 2), half);
            const simd::Bytes pixels =
                simd::Words(simd::shift_right(on, 6), simd::shift_right(between, 6)).narrow();
            if (x + simd::half_lanes <= width_)
                pixels.store(dst + 2 * x);
            else
                pixels.store(dst + 2 * x, 2 * (width_ - x));
        }
    }

    int width_;
    std::uint16_t* line_;
};

inline Status check_pyramid(ImageView<const Gray8> src, Size needed_size, std::int64_t needed,
                            Span<std::uint8_t> scratch, ImageView<const Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != needed_size) return Status::size_mismatch;
    if (maximum(src.width(), dst.width()) > max_image_side ||
        maximum(src.height(), dst.height()) > max_image_side)
        return Status::image_too_large;
    if (scratch.size() < needed) return Status::scratch_too_small;
    return Status::ok;
}

}  // namespace kernels

inline Status pyramid_down(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    if (Status s = kernels::check_pyramid(src, pyramid_down_size(src.size()),
                                          pyramid_down_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    kernels::PyramidDownRow kernel(src.width(), scratch);
    const auto row = [&](int y) -> const Gray8* { return src.row(clamp(y, 0, src.height() - 1)); };
    for (int y = 0; y < dst.height(); ++y)
        kernel({row(2 * y - 2), row(2 * y - 1), row(2 * y), row(2 * y + 1), row(2 * y + 2)}, dst.row(y));
    return Status::ok;
}

inline Status pyramid_up(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    const Size twice{2 * src.width(), 2 * src.height()};
    if (Status s = kernels::check_pyramid(src, twice, pyramid_up_scratch(src.size()), scratch, dst);
        s != Status::ok)
        return s;
    kernels::PyramidUpRow kernel(src.width(), scratch);
    for (int y = 0; y < src.height(); ++y) {
        const Gray8* above = src.row(maximum(y - 1, 0));
        const Gray8* below = src.row(minimum(y + 1, src.height() - 1));
        kernel.even(above, src.row(y), below, dst.row(2 * y));
        kernel.odd(src.row(y), below, dst.row(2 * y + 1));
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
