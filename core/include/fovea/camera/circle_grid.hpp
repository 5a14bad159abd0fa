// SPDX-License-Identifier: MIT
//
// Grids of circles: the other board that a camera is calibrated with. Book sec. 2.10.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/board_lattice.hpp>
#include <fovea/camera/board_window.hpp>
#include <fovea/camera/circle_spot.hpp>
#include <fovea/feature/circle_centres.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/segment/adaptive_threshold.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/warp/halve_row.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How the circles of a grid stand.
enum class CircleGridPattern : std::uint8_t {
    symmetric,   ///< in columns and rows
    asymmetric,  ///< every second row half a step to the right; a step along a row is two from row to row
};

struct CircleGridOptions {
    CircleGridPattern pattern = CircleGridPattern::symmetric;
    CircleTone tone = CircleTone::dark;  ///< of the circles; any looks twice
    int least_contrast = 16;             ///< between a circle and its ground, 4..255 grey levels
    int candidates = 500;                ///< regions of the image, the largest, that are looked at; 16..8192
};

inline namespace FOVEA_ISA {

/// Scratch bytes that find_circle_grid() needs; 0 if it refuses board or options.
constexpr std::int64_t find_circle_grid_scratch(Size size, Size board, const CircleGridOptions& options);

/// The centres of a grid of circles: all of them, or none.
///
/// Shapes    board: circles in a row, and rows; 3 to 64 each. Circles are to have 12 pixels or more
/// Units     1/256 px
/// Order     row by row, rows to the right hand of the way along a row, as x and y are; an asymmetric grid
///           begins with a row that is not shifted. Where several orders are alike (turned by half, and by
///           quarters if there are as many columns as rows; an asymmetric grid with an odd number of rows
///           has one), the one whose row runs most to the right; of two such, down
/// Rounding  centres by brightness, see Source. A circle seen askew has its centre not quite in the middle
///           of its ellipse; that is of the lens and not corrected
/// Scratch   find_circle_grid_scratch(src.size(), board, options) bytes, undefined afterwards
/// Time      two thresholds of the pixels and their components for each tone and halving, from at most 1024
///           px on up to the first in which the grid is found
/// Errors    empty_image; image_too_large above max_moment_side; bad_argument; scratch_too_small;
///           buffer_too_small for fewer places than the grid has; not_found: also where a circle is hidden,
///           or one more stands on the lattice
/// Source    adaptive_threshold(), connected_components(), regions with the area of the ellipse that has
///           their moments; a lattice grown from two neighbours, then read along any of its axes
inline Status find_circle_grid(ImageView<const Gray8> src, Size board, const CircleGridOptions& options,
                               Span<std::uint8_t> scratch, Span<SubPixelPoint> centres);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr bool is_valid(Size board, const CircleGridOptions& o) {
    return board.width >= min_board_side && board.height >= min_board_side && board.width <= max_board_side &&
           board.height <= max_board_side && o.least_contrast >= 4 && o.least_contrast <= 255 &&
           o.candidates >= 16 && o.candidates <= 8192 &&
           (o.pattern == CircleGridPattern::symmetric || o.pattern == CircleGridPattern::asymmetric) &&
           (o.tone == CircleTone::any || o.tone == CircleTone::bright || o.tone == CircleTone::dark);
}

/// Columns and rows of a grid from the steps of a lattice.
struct GridAxes {
    int column_i = 1, column_j = 0;
    int row_i = 0, row_j = 1;

    constexpr int column(LatticePlace at) const { return column_i * at.i + column_j * at.j; }
    constexpr int row(LatticePlace at) const { return row_i * at.i + row_j * at.j; }
};

}  // namespace detail

inline namespace FOVEA_ISA {
namespace kernels {

using detail::BoardLattice;
using detail::BoardVector;
using detail::CircleSpot;
using detail::GridAxes;
using detail::LatticePlace;

class CircleGridFinder {
public:
    static constexpr int max_levels = 6;
    static constexpr int coarse_side = 1024;

    static constexpr std::int64_t scratch(Size size, Size board, const CircleGridOptions& options) {
        std::int64_t halves = 0;
        Size half = size;
        while (maximum(half.width, half.height) > coarse_side) {
            half = {half.width / 2, half.height / 2};
            halves += half.area();
        }
        return halves + size.area() + arena_bytes<Region>(options.candidates) +
               arena_bytes<CircleSpot>(options.candidates) + BoardLattice::scratch(reach(board)) +
               arena_bytes<SubPixelPoint>(board.area()) + arena_bytes<std::uint8_t>(options.candidates) +
               maximum(adaptive_threshold_scratch(size, max_adaptive_side),
                       connected_components_scratch(size.width));
    }
    CircleGridFinder(ImageView<const Gray8> src, Size board, const CircleGridOptions& options,
                     Span<std::uint8_t> bytes)
        : src_(src),
          board_(board),
          options_(options),
          arena_(bytes),
          regions_(arena_.take<Region>(options.candidates)),
          spots_(arena_.take<CircleSpot>(options.candidates)),
          lattice_(reach(board), arena_),
          centres_(arena_.take<SubPixelPoint>(board.area())),
          used_(arena_.take<std::uint8_t>(options.candidates)),
          binary_(arena_.take_unset<std::uint8_t>(src.size().area())) {
        levels_[0] = src;
        while (maximum(levels_[count_ - 1].width(), levels_[count_ - 1].height()) > coarse_side) {
            levels_[count_] = halved(levels_[count_ - 1]);
            ++count_;
        }
    }

    Status find(Span<SubPixelPoint> centres) {
        for (int k = count_ - 1; k >= 0; --k)
            for (const int parts : {4, 12})
                for (int tone = 0; tone < 2; ++tone) {
                    const bool bright = tone == 1;
                    if (options_.tone == (bright ? CircleTone::dark : CircleTone::bright)) continue;
                    if (!find_spots(k, parts, bright) || !find_grid(k, bright)) continue;
                    for (std::ptrdiff_t n = 0; n < centres_.size(); ++n) centres[n] = centres_[n];
                    return Status::ok;
                }
        return Status::not_found;
    }

private:
    static constexpr int reach(Size board) { return board.width + board.height + 1; }

    ImageView<const Gray8> halved(ImageView<const Gray8> src) {
        const Size size{src.width() / 2, src.height() / 2};
        const ImageView<Gray8> half(arena_.take_unset<Gray8>(size.area()).data(), size, size.width);
        for (int y = 0; y < size.height; ++y)
            halve_row(src.row(2 * y), src.row(2 * y + 1), size.width, half.row(y));
        return half;
    }

    bool find_spots(int k, int parts, bool bright) {
        const ImageView<const Gray8> level = levels_[k];
        const Size size = level.size();
        const ImageView<Gray8> binary(binary_.data(), size, size.width);
        const int side = clamp(minimum(size.width, size.height) / parts, 5, max_adaptive_side) | 1;
        const int offset = maximum(options_.least_contrast / 4, 2);
        const Status status = bright ? adaptive_threshold(level, side, -offset, arena_.rest(), binary)
                                     : adaptive_threshold_inverse(level, side, offset, arena_.rest(), binary);
        if (status != Status::ok) return false;
        int found = 0;
        int holes = 0;
        ComponentOptions components;
        components.area_min = 12;
        components.at_border = BorderRegions::drop;
        components.find_holes = false;
        const ListView<Region> list(regions_.data(), static_cast<int>(regions_.size()), &found);
        const Status labelled =
            connected_components(binary, components, arena_.rest(), list, ListView<Hole>(nullptr, 0, &holes));
        if (labelled != Status::ok && labelled != Status::capacity_exceeded) return false;
        spot_count_ = 0;
        for (const Region& region : list) {
            const Result<CircleSpot> spot = detail::circle_spot(region);
            if (spot) spots_[spot_count_++] = *spot;
        }
        return spot_count_ >= board_.area();
    }

    bool find_grid(int k, bool bright) {
        // Every spot that has not been in a lattice may be the seed of one.
        for (int s = 0; s < spot_count_; ++s) used_[s] = 0;
        for (int s = 0; s < spot_count_; ++s) {
            if (used_[s] != 0) continue;
            used_[s] = 1;
            int a = -1;
            int b = -1;
            if (!neighbours(s, a, b)) continue;
            grow(s, a, b);
            if (lattice_.size() == board_.area() && read_axes() && refine(k, bright)) return true;
        }
        return false;
    }

    BoardVector centre(int spot) const { return spots_[spot].centre; }
    /// Of about the same size, which perspective changes by little from one to the next.
    bool alike(int a, int b) const {
        return 5 * spots_[a].area <= 12 * spots_[b].area + 50 &&
               5 * spots_[b].area <= 12 * spots_[a].area + 50;
    }
    /// The nearest spot, and the nearest that is not on a line with it.
    bool neighbours(int seed, int& a, int& b) const {
        const auto nearest = [&](auto allowed) {
            int best = -1;
            std::int64_t least = std::int64_t{1} << 62;
            for (int s = 0; s < spot_count_; ++s) {
                if (s == seed || !alike(seed, s)) continue;
                const BoardVector to = centre(s) - centre(seed);
                const std::int64_t square = inner_product(to, to);
                if (square >= least || square == 0 || !allowed(to)) continue;
                best = s;
                least = square;
            }
            return best;
        };
        a = nearest([](BoardVector) { return true; });
        if (a < 0) return false;
        const BoardVector u = centre(a) - centre(seed);
        b = nearest([&](BoardVector v) {
            const std::int64_t area = cross_product(u, v);
            return 3 * (area < 0 ? -area : area) >= std::int64_t{u.length()} * v.length();
        });
        return b >= 0;
    }
    void grow(int seed, int a, int b) {
        BoardVector u = centre(a) - centre(seed);
        BoardVector v = centre(b) - centre(seed);
        if (cross_product(u, v) < 0) v = -v;
        lattice_.start(centre(seed), u, v, seed);
        lattice_.grow([&](LatticePlace at, LatticePlace from, BoardVector expected) {
            const int near = minimum(lattice_.step(from, 0).length(), lattice_.step(from, 1).length());
            std::int64_t least = std::int64_t{near} * near / 10;
            int best = -1;
            for (int s = 0; s < spot_count_; ++s) {
                const BoardVector off = centre(s) - expected;
                const std::int64_t square = inner_product(off, off);
                if (square >= least || !alike(s, lattice_.item(from))) continue;
                best = s;
                least = square;
            }
            if (best < 0) return false;
            used_[best] = 1;
            for (int m = 0; m < lattice_.size(); ++m)
                if (lattice_.item(lattice_.member(m)) == best) return false;
            lattice_.add(at, centre(best), best);
            return true;
        });
    }

    /// Looks for columns and rows along which the lattice is the grid, whole; of several, as
    /// find_circle_grid() says.
    bool read_axes() {
        bool found = false;
        BoardVector best;
        for (int n = 0; n < 81; ++n) {
            const int a = n % 3 - 1, b = n / 3 % 3 - 1, c = n / 9 % 3 - 1, d = n / 27 - 1;
            GridAxes axes{a, b, c, d};
            // Of an asymmetric grid, neighbours are one column and one row away.
            if (options_.pattern == CircleGridPattern::asymmetric) axes = {a + c, b + d, a - c, b - d};
            const int size = axes.column_i * axes.row_j - axes.column_j * axes.row_i;
            if (size != (options_.pattern == CircleGridPattern::asymmetric ? 2 : 1)) continue;
            BoardVector row;
            if (!fits(axes, row)) continue;
            if (found && !detail::runs_right_of(row, best)) continue;
            found = true;
            best = row;
            axes_ = axes;
        }
        return found;
    }
    bool fits(const GridAxes& axes, BoardVector& first_row) const {
        int left = axes.column(lattice_.member(0));
        int right = left;
        int top = axes.row(lattice_.member(0));
        int bottom = top;
        for (int m = 1; m < lattice_.size(); ++m) {
            const LatticePlace at = lattice_.member(m);
            left = minimum(left, axes.column(at));
            right = maximum(right, axes.column(at));
            top = minimum(top, axes.row(at));
            bottom = maximum(bottom, axes.row(at));
        }
        const bool asymmetric = options_.pattern == CircleGridPattern::asymmetric;
        const int columns = asymmetric ? 2 * board_.width : board_.width;
        if (right - left + 1 != columns || bottom - top + 1 != board_.height) return false;
        // All places are taken, since there are as many members, if each stands on one.
        BoardVector first;
        BoardVector last;
        for (int m = 0; m < lattice_.size(); ++m) {
            const LatticePlace at = lattice_.member(m);
            const int column = axes.column(at) - left;
            const int row = axes.row(at) - top;
            if (asymmetric && (column + row) % 2 != 0) return false;
            if (row != 0) continue;
            if (column == 0) first = lattice_.place(at);
            if (column == (asymmetric ? columns - 2 : columns - 1)) last = lattice_.place(at);
        }
        first_row = last - first;
        return true;
    }

    bool refine(int k, bool bright) {
        int left = axes_.column(lattice_.member(0));
        int top = axes_.row(lattice_.member(0));
        for (int m = 1; m < lattice_.size(); ++m) {
            left = minimum(left, axes_.column(lattice_.member(m)));
            top = minimum(top, axes_.row(lattice_.member(m)));
        }
        for (int m = 0; m < lattice_.size(); ++m) {
            const LatticePlace at = lattice_.member(m);
            CircleSpot spot = spots_[lattice_.item(at)];
            // From pixels of the level to those of the picture.
            const int shift = ((1 << k) - 1) * 128;
            spot.centre = {(spot.centre.x << k) + shift, (spot.centre.y << k) + shift};
            spot.xx <<= 2 * k;
            spot.xy *= std::int64_t{1} << 2 * k;
            spot.yy <<= 2 * k;
            for (int i = 0; i < 3; ++i) {
                const Result<BoardVector> place =
                    detail::spot_centre(src_, spot, bright, options_.least_contrast);
                if (!place) return false;
                spot.centre = *place;
            }
            const int row = axes_.row(at) - top;
            int column = axes_.column(at) - left;
            if (options_.pattern == CircleGridPattern::asymmetric) column /= 2;
            centres_[static_cast<std::ptrdiff_t>(row) * board_.width + column] = spot.centre.point();
        }
        return true;
    }

    ImageView<const Gray8> src_;
    Size board_;
    CircleGridOptions options_;
    Arena arena_;
    Span<Region> regions_;
    Span<CircleSpot> spots_;
    BoardLattice lattice_;
    Span<SubPixelPoint> centres_;
    Span<std::uint8_t> used_;
    Span<std::uint8_t> binary_;
    ImageView<const Gray8> levels_[max_levels];
    int count_ = 1;
    int spot_count_ = 0;
    GridAxes axes_;
};

}  // namespace kernels

constexpr std::int64_t find_circle_grid_scratch(Size size, Size board, const CircleGridOptions& options) {
    if (!detail::is_valid(board, options)) return 0;
    return kernels::CircleGridFinder::scratch(size, board, options);
}

inline Status find_circle_grid(ImageView<const Gray8> src, Size board, const CircleGridOptions& options,
                               Span<std::uint8_t> scratch, Span<SubPixelPoint> centres) {
    if (src.empty()) return Status::empty_image;
    if (src.width() > max_moment_side || src.height() > max_moment_side) return Status::image_too_large;
    if (!detail::is_valid(board, options)) return Status::bad_argument;
    if (scratch.size() < find_circle_grid_scratch(src.size(), board, options))
        return Status::scratch_too_small;
    if (centres.size() < board.area()) return Status::buffer_too_small;
    return kernels::CircleGridFinder(src, board, options, scratch).find(centres);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
