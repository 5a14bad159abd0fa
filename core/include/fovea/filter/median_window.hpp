// SPDX-License-Identifier: MIT
//
// The median filter of any odd window. Its time does not grow with the window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/filter/median.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/counts.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Scratch bytes that median() needs; 0 if it refuses the window.
constexpr std::int64_t median_scratch(Size size, Size window);

/// The pixel in the middle of the order of the window that is centred on every pixel.
///
/// Shapes    src and dst equal, 1x1 or larger; window odd by odd, 1x1 to 63x63, larger than the image too.
///           5x1 keeps a line that runs across and clears what is shorter than three pixels, 1x5 one that
///           runs down
/// Units     any 8-bit values
/// Rounding  none: the middle of an odd number of pixels
/// Border    as border says
/// Overlap   none: dst must not share pixels with src
/// Scratch   median_scratch(src.size(), window) bytes, undefined afterwards: 272 for each of up to 64 columns
///           and of those that the window reaches beyond them
/// Cost      grows with neither side of the window, but for a start of every 64 columns that grows with its
///           height; 3x3 and 5x5 are median_3x3() and median_5x5()
/// Errors    empty_image, size_mismatch, bad_argument for a window that is even, too small or too large,
///           scratch_too_small
/// Source    Perreault and Hebert, "Median filtering in constant time", IEEE TIP 16(9), 2007. Here the
///           histograms are cumulated, so that a median is found by one comparison of sixteen counts
inline Status median(ImageView<const Gray8> src, Size window, Border border, Span<std::uint8_t> scratch,
                     ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

constexpr bool is_median_window(Size window) {
    return window.width % 2 == 1 && window.height % 2 == 1 && !window.empty() &&
           window.width <= max_window_rows && window.height <= max_window_rows;
}

/// Median of a stripe of columns, from top to bottom. Each column has a histogram of the window's height: 16
/// cumulated counts of the pixels' upper four bits, and within each of these 16 of their lower ones.
class MedianStripe {
public:
    /// The histograms of a stripe of that many columns stay in the nearest cache.
    static constexpr int columns = 64;
    static constexpr int parts = simd::count_entries;
    static constexpr int column_bytes = parts + parts * parts;

    static constexpr int most_columns(int width, Size window) {
        return (width < columns ? width : columns) + window.width - 1;
    }
    static constexpr std::int64_t scratch(int width, Size window) {
        return std::int64_t{column_bytes} * most_columns(width, window);
    }

    MedianStripe(ImageView<const Gray8> src, Size window, Border border, Span<std::uint8_t> scratch,
                 const Gray8* zeros)
        : src_(src),
          window_(window),
          border_(border),
          zeros_(zeros),
          capacity_(most_columns(src.width(), window)),
          coarse_(scratch.data()),
          fine_(scratch.data() + std::ptrdiff_t{parts} * capacity_) {}

    /// Columns first..first + count - 1 of dst.
    void run(int first, int count, ImageView<Gray8> dst) {
        first_ = first - window_.width / 2;
        count_ = count + window_.width - 1;
        std::memset(coarse_, 0, static_cast<std::size_t>(column_bytes) * static_cast<std::size_t>(capacity_));
        const int reach = window_.height / 2;
        for (int y = -reach; y < reach; ++y)
            for_each_pixel(row(y), row(y), [this](int at, int, int pixel) { take_in(at, pixel); });
        for (int y = 0; y < src_.height(); ++y) {
            const Gray8* in = row(y + reach);
            if (y == 0)
                for_each_pixel(in, in, [this](int at, int, int pixel) { take_in(at, pixel); });
            else
                for_each_pixel(row(y - 1 - reach), in, [this](int at, int old, int pixel) {
                    if (old == pixel) return;
                    leave_out(at, old);
                    take_in(at, pixel);
                });
            across(count, dst.row(y) + first);
        }
    }

private:
    const Gray8* row(int y) const {
        const int index = border_index(border_, y, src_.height());
        return index == no_index ? zeros_ : src_.row(index);
    }
    /// visit(column, pixel of a, pixel of b) for every column of the stripe, those beyond the image too.
    template <class Visit>
    [[gnu::always_inline]] void for_each_pixel(const Gray8* a, const Gray8* b, Visit visit) const {
        const int begin = first_ < 0 ? -first_ : 0;
        const int end = first_ + count_ > src_.width() ? src_.width() - first_ : count_;
        const auto outside = [&](int at) {
            const int x = border_index(border_, first_ + at, src_.width());
            visit(at, x == no_index ? 0 : a[x], x == no_index ? 0 : b[x]);
        };
        for (int at = 0; at < begin; ++at) outside(at);
        for (int at = begin; at < end; ++at) visit(at, a[first_ + at], b[first_ + at]);
        for (int at = end; at < count_; ++at) outside(at);
    }
    std::uint8_t* coarse_of(int at) const { return coarse_ + std::ptrdiff_t{parts} * at; }
    /// Neighbouring columns lie side by side.
    std::uint8_t* fine_of(int part, int at) const {
        return fine_ + std::ptrdiff_t{parts} * (std::ptrdiff_t{part} * capacity_ + at);
    }
    [[gnu::always_inline]] void take_in(int at, int pixel) const {
        simd::count_in(coarse_of(at), pixel >> 4);
        simd::count_in(fine_of(pixel >> 4, at), pixel & 15);
    }
    [[gnu::always_inline]] void leave_out(int at, int pixel) const {
        simd::count_out(coarse_of(at), pixel >> 4);
        simd::count_out(fine_of(pixel >> 4, at), pixel & 15);
    }
    /// The sums over the window's columns: the coarse one goes along, a fine one follows when it is asked
    /// for.
    void across(int count, Gray8* dst) const {
        const int wide = window_.width;
        const int half = wide * window_.height / 2;
        alignas(32) std::uint16_t sums[parts][parts];
        int valid[parts];  // the pixel that the sums of a part hold
        for (int& x : valid) x = -wide;
        simd::Counts coarse;
        for (int at = 0; at < wide - 1; ++at) coarse.add(coarse_of(at));
        alignas(32) std::uint16_t below[parts + 1];
        below[0] = 0;
        for (int x = 0; x < count; ++x) {
            coarse.add(coarse_of(x + wide - 1));
            const int part = coarse.at_most(half);
            coarse.store(below + 1);
            coarse.subtract(coarse_of(x));

            simd::Counts fine;
            const int missed = x - valid[part];
            const std::uint8_t* from = fine_of(part, 0);
            if (2 * missed < wide) {
                fine = simd::Counts::load(sums[part]);
                for (int at = valid[part]; at < x; ++at) {
                    fine.add(from + std::ptrdiff_t{parts} * (at + wide));
                    fine.subtract(from + std::ptrdiff_t{parts} * at);
                }
            } else {
                for (int at = x; at < x + wide; ++at) fine.add(from + std::ptrdiff_t{parts} * at);
            }
            fine.store(sums[part]);
            valid[part] = x;
            dst[x] = static_cast<Gray8>(16 * part + fine.at_most(half - below[part]));
        }
    }

    ImageView<const Gray8> src_;
    Size window_;
    Border border_;
    const Gray8* zeros_;
    int capacity_;
    std::uint8_t* coarse_;
    std::uint8_t* fine_;
    int first_ = 0;
    int count_ = 0;
};

}  // namespace kernels

constexpr std::int64_t median_scratch(Size size, Size window) {
    if (!kernels::is_median_window(window)) return 0;
    if (window == Size{3, 3}) return median_3x3_scratch(size);
    if (window == Size{5, 5}) return median_5x5_scratch(size);
    return size.width + kernels::MedianStripe::scratch(size.width, window);
}

inline Status median(ImageView<const Gray8> src, Size window, Border border, Span<std::uint8_t> scratch,
                     ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (!kernels::is_median_window(window)) return Status::bad_argument;
    if (scratch.size() < median_scratch(src.size(), window)) return Status::scratch_too_small;
    if (window == Size{3, 3}) return median_3x3(src, border, scratch, dst);
    if (window == Size{5, 5}) return median_5x5(src, border, scratch, dst);
    std::memset(scratch.data(), 0, static_cast<std::size_t>(src.width()));
    kernels::MedianStripe stripe(src, window, border, scratch.from(src.width()), scratch.data());
    for (int x = 0; x < src.width(); x += kernels::MedianStripe::columns)
        stripe.run(x, minimum(kernels::MedianStripe::columns, src.width() - x), dst);
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
