// SPDX-License-Identifier: MIT
//
// Canny's edges: lines one pixel wide where the gradient is strongest across them. Book sec. 2.8.4.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/feature/hysteresis.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/filter_row.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The strongest gradient that Sobel's derivatives give, as |x| + |y|.
inline constexpr int max_gradient_strength = 2040;

inline namespace FOVEA_ISA {

/// Scratch bytes that canny() needs: some rows.
constexpr std::int64_t canny_scratch(Size size);

/// Edges as lines one pixel wide, 255 on 0. A pixel is a candidate where |x| + |y| of sobel_x() and sobel_y()
/// is above low and not exceeded by the two neighbours that the gradient points at and away from. Candidates
/// above high are edges, and so is every candidate that one of the eight neighbours joins to an edge.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     low and high 0..2040, low <= high; an edge of one grey level a pixel along a row or a column has
///           8
/// Rounding  none. The neighbours are those of the row below 22.5 degrees, of the column above 67.5, else of
///           the diagonal, with 13573 / 32768 for the tangent of 22.5 degrees. Of equal neighbours the left
///           one and the upper one keep the edge; on a diagonal neither does
/// Border    of the picture as border says; the strength outside is 0
/// Overlap   none
/// Scratch   canny_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, bad_argument, scratch_too_small
/// Source    Canny, "A computational approach to edge detection", PAMI 8(6), 1986; book sec. 2.8.4. The
///           toolkit had sectors of 26.6 and 63.4 degrees and an empty frame of one pixel. With
///           Border::replicate the pixels are those of OpenCV's Canny with the sum as norm
inline Status canny(ImageView<const Gray8> src, int low, int high, Border border, Span<std::uint8_t> scratch,
                    ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// The lines of CannyRows: two rows of the two lines that join the rows, three rows of the strength.
struct CannyLines {
    static constexpr int byte_lines = 0, word_lines = 7;
};

/// Derivatives and thinned edges, row after row. Keeps three rows of strengths and two of what they are made
/// of.
class CannyRows {
public:
    static constexpr std::int64_t scratch(int width) { return FilterLines<CannyLines>::scratch(width); }

    CannyRows(Border border, Span<std::uint8_t> scratch, int width) : border_(border), width_(width) {
        std::memset(scratch.data(), 0, static_cast<std::size_t>(CannyRows::scratch(width)));
        const FilterLines<CannyLines> lines(scratch, width);
        slopes_[0] = {lines.words<0>(), lines.words<1>()};
        slopes_[1] = {lines.words<2>(), lines.words<3>()};
        strength_[0] = lines.words<4>();
        strength_[1] = lines.words<5>();
        strength_[2] = lines.words<6>();
    }

    /// Derivatives of row y from it and its neighbours, y = 0, 1, 2, ...
    void differentiate(int y, const Gray8* above, const Gray8* here, const Gray8* below) {
        Slopes slopes = slopes_[y % 2];
        simd::for_each_vector(width_, [&](int x, int count) {
            if (count == simd::lanes)
                slopes.down(x, simd::Bytes::load(above + x), simd::Bytes::load(here + x),
                            simd::Bytes::load(below + x));
            else
                slopes.down(x, simd::Bytes::load(above + x, count), simd::Bytes::load(here + x, count),
                            simd::Bytes::load(below + x, count));
        });
        for (const int end : {-1, width_}) {
            const int column = border_index(border_, end, width_);
            slopes.smooth.set(end, column == no_index ? std::uint16_t{0} : slopes.smooth.value(column));
            slopes.steps.set(end, column == no_index ? raised_step : slopes.steps.value(column));
        }
        simd::WordLine strength = strength_[y % 3];
        for (int x = 0; x < width_; x += simd::lanes)
            strength.put(x, absolute(slopes.along(x)) + absolute(slopes.crossing(x)));
        strength.set(-1, 0);
        strength.set(width_, 0);
    }
    /// Row y lies below the image.
    void end(int y) {
        simd::WordLine strength = strength_[y % 3];
        for (int x = 0; x < width_; x += simd::lanes) strength.put(x, simd::Words::all(0));
        strength.set(width_, 0);
    }
    /// Marks the candidates of row y, when row y + 1 has its derivatives or was ended.
    void thin(int y, int low, int high, Gray8* dst) const {
        const simd::WordLine above = strength_[(y + 2) % 3];
        const simd::WordLine here = strength_[y % 3];
        const simd::WordLine below = strength_[(y + 1) % 3];
        const Slopes slopes = slopes_[y % 2];
        const simd::Words least = simd::Words::all(static_cast<std::uint16_t>(low + 1));
        const simd::Words least_strong = simd::Words::all(static_cast<std::uint16_t>(high + 1));
        const simd::Words one = simd::Words::all(1);
        simd::for_each_vector(width_, [&](int x, int count) {
            const simd::Words strength = here.at<0>(x);
            const simd::Words enough = at_least(strength, least);
            simd::Bytes marks = simd::Bytes::all(0);
            if (any(enough)) {
                const simd::Words edge =
                    enough & ridge(above, here, below, slopes.along(x), slopes.crossing(x), x);
                const simd::Words strong = edge & at_least(strength, least_strong);
                marks = ((edge & one) + (strong & one)).narrow();
            }
            if (count == simd::lanes)
                marks.store(dst + x);
            else
                marks.store(dst + x, count);
        });
    }

private:
    // Differences of bytes are kept above zero by adding this.
    static constexpr std::uint16_t raised_step = 256;

    /// What the three rows of a derivative give, before the columns are joined.
    struct Slopes {
        simd::WordLine smooth;
        simd::WordLine steps;

        [[gnu::always_inline]] void down(int x, simd::Bytes a, simd::Bytes b, simd::Bytes c) {
            const simd::Words above(a), here(b), below(c);
            smooth.put(x, above + below + (here << 1));
            steps.put(x, below + simd::Words::all(raised_step) - above);
        }
        [[gnu::always_inline]] simd::Words along(int x) const { return smooth.at<1>(x) - smooth.at<-1>(x); }
        [[gnu::always_inline]] simd::Words crossing(int x) const {
            return steps.at<-1>(x) + steps.at<1>(x) + (steps.at<0>(x) << 1) -
                   simd::Words::all(4 * raised_step);
        }
    };
    [[gnu::always_inline]] static simd::Words pick(simd::Words mask, simd::Words a, simd::Words b) {
        return (a & mask) | (b & ~mask);
    }
    [[gnu::always_inline]] static bool any(simd::Words masks) {
        constexpr int count = simd::lanes < 8 ? 1 : simd::lanes / 8;
        using Piece = std::conditional_t<(simd::lanes < 8), std::uint32_t, std::uint64_t>;
        std::uint8_t bytes[simd::lanes];
        (masks & simd::Words::all(255)).narrow().store(bytes);
        Piece pieces[count];
        std::memcpy(pieces, bytes, sizeof pieces);
        Piece joined = 0;
        for (const Piece piece : pieces) joined |= piece;
        return joined != 0;
    }
    /// 65535 where no neighbour along the gradient is stronger. The tangent of 22.5 degrees is k = 13573 /
    /// 32768. With whole x and y, y < k x where y <= floor(k x), because k x is whole for x = 0 alone; and
    /// 1 / k = k + 2.
    [[gnu::always_inline]] static simd::Words ridge(const simd::WordLine& above, const simd::WordLine& here,
                                                    const simd::WordLine& below, simd::Words to_x,
                                                    simd::Words to_y, int x) {
        const simd::Words twice_x = absolute(to_x) << 1;
        const simd::Words y = absolute(to_y);
        const simd::Words limit = times_high(twice_x, 13573);
        const simd::Words flat = at_least(limit, y);
        const simd::Words not_steep = at_least(limit + twice_x, y);
        const simd::Words signs_differ =
            at_least((to_x | to_y) & ~(to_x & to_y), simd::Words::all(std::uint16_t{0x8000}));
        simd::Words before = pick(signs_differ, above.at<1>(x), above.at<-1>(x));
        simd::Words behind = pick(signs_differ, below.at<-1>(x), below.at<1>(x)) + simd::Words::all(1);
        before = pick(flat, here.at<-1>(x), pick(not_steep, before, above.at<0>(x)));
        behind = pick(flat, here.at<1>(x), pick(not_steep, behind, below.at<0>(x)));
        const simd::Words strength = here.at<0>(x);
        return at_least(strength, behind) & ~at_least(before, strength);
    }

    Border border_;
    int width_;
    Slopes slopes_[2];
    simd::WordLine strength_[3];
};

}  // namespace kernels

constexpr std::int64_t canny_scratch(Size size) {
    return arena_bytes<detail::PixelPlace>(detail::hysteresis_places(size)) + size.width +
           kernels::CannyRows::scratch(size.width);
}

inline Status canny(ImageView<const Gray8> src, int low, int high, Border border, Span<std::uint8_t> scratch,
                    ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (low < 0 || high > max_gradient_strength || low > high) return Status::bad_argument;
    if (scratch.size() < canny_scratch(src.size())) return Status::scratch_too_small;

    const int last = src.height() - 1;
    Arena arena(scratch);
    detail::EdgeGrowth growth(dst, arena.take<detail::PixelPlace>(detail::hysteresis_places(src.size())));
    const Gray8* zeros = arena.take<Gray8>(src.width()).data();
    const auto row = [&](int y) {
        const int index = border_index(border, y, src.height());
        return index == no_index ? zeros : src.row(index);
    };
    kernels::CannyRows rows(border, arena.rest(), src.width());
    for (int y = 0; y <= last; ++y) {
        rows.differentiate(y, row(y - 1), src.row(y), row(y + 1));
        if (y == 0) continue;
        rows.thin(y - 1, low, high, dst.row(y - 1));
        growth.take_row(y - 1);
    }
    rows.end(last + 1);
    rows.thin(last, low, high, dst.row(last));
    growth.take_row(last);
    growth.finish();
    for (int y = 0; y <= last; ++y) {
        Gray8* pixels = dst.row(y);
        simd::for_each_vector(src.width(), [&](int x, int count) {
            const simd::Bytes edges = simd::Bytes::all(detail::edge_mark);
            if (count == simd::lanes)
                at_least(simd::Bytes::load(pixels + x), edges).store(pixels + x);
            else
                at_least(simd::Bytes::load(pixels + x, count), edges).store(pixels + x, count);
        });
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
