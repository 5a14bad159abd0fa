// SPDX-License-Identifier: MIT
//
// Median filters of fixed size. Book sec. 2.6.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/filter_row.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>
#include <fovea/simd/unroll.hpp>
#include <fovea/stream/stage.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Scratch bytes that median_3x3() and median_5x5() need.
constexpr std::int64_t median_3x3_scratch(Size size);
constexpr std::int64_t median_5x5_scratch(Size size);

/// The fifth of the nine pixels of a 3x3 neighbourhood in the order of their brightness: takes out single
/// bright and dark pixels, and leaves straight edges where they are.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Units    any 8-bit values
/// Border   as border says
/// Overlap  none
/// Scratch  median_3x3_scratch(src.size()) bytes, undefined afterwards
/// Errors   empty_image, size_mismatch, scratch_too_small
/// Source   Smith, "Implementing median filters in XC4000E FPGAs", Xcell 23, 1996: columns are sorted once,
///          and three extremes of sorted columns hold the median
inline Status median_3x3(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                         ImageView<Gray8> dst);

/// The thirteenth of the 25 pixels of a 5x5 neighbourhood. All else as median_3x3().
///
/// Scratch  median_5x5_scratch(src.size()) bytes, undefined afterwards
/// Source   columns and then rows are sorted; pixel (i, j) of the sorted square has (i + 1)(j + 1) - 1 pixels
///          below it and (5 - i)(5 - j) - 1 above, which leaves 13 that may be the median
inline Status median_5x5(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                         ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// Puts two vectors in order, lane by lane.
[[gnu::always_inline]] inline void sort(simd::Bytes& a, simd::Bytes& b) {
    const simd::Bytes low = lower(a, b);
    b = higher(a, b);
    a = low;
}
[[gnu::always_inline]] inline void sort(simd::Bytes& a, simd::Bytes& b, simd::Bytes& c) {
    sort(a, b);
    sort(b, c);
    sort(a, b);
}
/// Nine comparisons, the fewest that sort five.
[[gnu::always_inline]] inline void sort(simd::Bytes& a, simd::Bytes& b, simd::Bytes& c, simd::Bytes& d,
                                        simd::Bytes& e) {
    sort(a, b);
    sort(d, e);
    sort(c, e);
    sort(c, d);
    sort(a, d);
    sort(a, c);
    sort(b, e);
    sort(b, d);
    sort(b, c);
}
[[gnu::always_inline]] inline simd::Bytes middle(simd::Bytes a, simd::Bytes b, simd::Bytes c) {
    return higher(lower(a, b), lower(higher(a, b), c));
}

struct Median3x3 {
    static constexpr int rows = 3, reach = 1, byte_lines = 3, word_lines = 0;
    using Output = Gray8;
    using Lines = FilterLines<Median3x3>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c) const {
        sort(a, b, c);
        lines.bytes<0>().put(x, a);
        lines.bytes<1>().put(x, b);
        lines.bytes<2>().put(x, c);
    }
    [[gnu::always_inline]] simd::Bytes across(const Lines& lines, int x) const {
        const simd::ByteLine& low = lines.bytes<0>();
        const simd::ByteLine& mid = lines.bytes<1>();
        const simd::ByteLine& high = lines.bytes<2>();
        return middle(higher(higher(low.at(x - 1), low.at(x)), low.at(x + 1)),
                      middle(mid.at(x - 1), mid.at(x), mid.at(x + 1)),
                      lower(lower(high.at(x - 1), high.at(x)), high.at(x + 1)));
    }
};

struct Median5x5 {
    static constexpr int rows = 5, reach = 2, byte_lines = 5, word_lines = 0;
    using Output = Gray8;
    using Lines = FilterLines<Median5x5>;

    [[gnu::always_inline]] void down(Lines& lines, int x, simd::Bytes a, simd::Bytes b, simd::Bytes c,
                                     simd::Bytes d, simd::Bytes e) const {
        sort(a, b, c, d, e);
        lines.bytes<0>().put(x, a);
        lines.bytes<1>().put(x, b);
        lines.bytes<2>().put(x, c);
        lines.bytes<3>().put(x, d);
        lines.bytes<4>().put(x, e);
    }
    [[gnu::always_inline]] simd::Bytes across(const Lines& lines, int x) const {
        // What is left of each sorted row: the two highest of the lowest row, three highest, three in the
        // middle, three lowest, the two lowest of the highest row.
        simd::Bytes p[13];
        highest_two(lines.bytes<0>(), x, p[0], p[1]);
        sorted_row(lines.bytes<1>(), x, [&](const simd::Bytes(&r)[5]) { keep(r[2], r[3], r[4], p + 2); });
        sorted_row(lines.bytes<2>(), x, [&](const simd::Bytes(&r)[5]) { keep(r[1], r[2], r[3], p + 5); });
        sorted_row(lines.bytes<3>(), x, [&](const simd::Bytes(&r)[5]) { keep(r[0], r[1], r[2], p + 8); });
        lowest_two(lines.bytes<4>(), x, p[11], p[12]);
        return median_of_13(p);
    }

private:
    [[gnu::always_inline]] static void keep(simd::Bytes a, simd::Bytes b, simd::Bytes c, simd::Bytes* to) {
        to[0] = a;
        to[1] = b;
        to[2] = c;
    }
    template <class Use>
    [[gnu::always_inline]] static void sorted_row(const simd::ByteLine& line, int x, Use use) {
        simd::Bytes r[5] = {line.at(x - 2), line.at(x - 1), line.at(x), line.at(x + 1), line.at(x + 2)};
        sort(r[0], r[1], r[2], r[3], r[4]);
        use(r);
    }
    /// The second highest and the highest of five.
    [[gnu::always_inline]] static void highest_two(const simd::ByteLine& line, int x, simd::Bytes& second,
                                                   simd::Bytes& first) {
        simd::Bytes a = line.at(x - 2), b = line.at(x - 1), c = line.at(x), d = line.at(x + 1),
                    e = line.at(x + 2);
        sort(a, b);
        sort(c, d);
        first = higher(b, d);
        // Behind the highest comes the other winner, or who lost to the highest itself.
        second = higher(lower(b, d), higher(a, c));
        second = higher(second, lower(first, e));
        first = higher(first, e);
    }
    [[gnu::always_inline]] static void lowest_two(const simd::ByteLine& line, int x, simd::Bytes& first,
                                                  simd::Bytes& second) {
        simd::Bytes a = line.at(x - 2), b = line.at(x - 1), c = line.at(x), d = line.at(x + 1),
                    e = line.at(x + 2);
        sort(a, b);
        sort(c, d);
        first = lower(a, c);
        second = lower(higher(a, c), lower(b, d));
        second = lower(second, higher(first, e));
        first = lower(first, e);
    }
    /// The seventh of 13: the lowest and the highest of eight go, one more comes, and so on, until one is
    /// left.
    [[gnu::always_inline]] static simd::Bytes median_of_13(simd::Bytes (&p)[13]) {
        drop_ends<8>(p);
        p[0] = p[8];
        drop_ends<7>(p);
        p[0] = p[9];
        drop_ends<6>(p);
        p[0] = p[10];
        drop_ends<5>(p);
        p[0] = p[11];
        drop_ends<4>(p);
        return middle(p[1], p[2], p[12]);
    }
    /// Of the first Count the lowest comes to place 0 and the highest to the last place, which then moves on:
    /// the others are at places 1 to Count - 2.
    template <int Count>
    [[gnu::always_inline]] static void drop_ends(simd::Bytes (&p)[13]) {
        simd::unroll<Count / 2>([&](auto i) { sort(p[i], p[Count - 1 - i]); });
        simd::unroll<(Count + 1) / 2 - 1>([&](auto i) { sort(p[0], p[i + 1]); });
        simd::unroll<Count - 1 - Count / 2>([&](auto i) { sort(p[i + Count / 2], p[Count - 1]); });
    }
};

}  // namespace kernels

constexpr std::int64_t median_3x3_scratch(Size size) { return filter_scratch<kernels::Median3x3>(size); }
constexpr std::int64_t median_5x5_scratch(Size size) { return filter_scratch<kernels::Median5x5>(size); }

inline Status median_3x3(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                         ImageView<Gray8> dst) {
    return filter_frame(kernels::Median3x3(), src, border, scratch, dst);
}
inline Status median_5x5(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                         ImageView<Gray8> dst) {
    return filter_frame(kernels::Median5x5(), src, border, scratch, dst);
}

namespace stages {
inline constexpr FilterStage<kernels::Median3x3> median_3x3;
inline constexpr FilterStage<kernels::Median5x5> median_5x5;
}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
