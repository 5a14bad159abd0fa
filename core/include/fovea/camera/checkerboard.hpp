// SPDX-License-Identifier: MIT
//
// Checkerboards: the corners of the board that a camera is calibrated with. Book sec. 2.10.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/board_check.hpp>
#include <fovea/camera/board_lattice.hpp>
#include <fovea/camera/board_window.hpp>
#include <fovea/camera/saddle_field.hpp>
#include <fovea/camera/saddle_point.hpp>
#include <fovea/filter/gaussian.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/warp/halve_row.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct CheckerboardOptions {
    /// Between a dark and a bright square, where it is least; 4..255 grey levels. Lower finds boards in
    /// worse light, and takes longer over what is none.
    int least_contrast = 16;
    /// How many corners of the image, the strongest, are looked at; 64..8192. More find a board in front of
    /// a restless ground, at 16 bytes each.
    int candidates = 1000;
};

inline namespace FOVEA_ISA {

/// Scratch bytes that find_checkerboard() needs, about 4/3 of the pixels; 0 if it refuses board or options.
constexpr std::int64_t find_checkerboard_scratch(Size size, Size board, const CheckerboardOptions& options);

/// The inner corners of a checkerboard: all of them, or none.
///
/// Shapes    board: columns and rows of inner corners, 3 to 64 each. A square is to have 6 px or more where
///           it is smallest, across it too when it is seen askew
/// Units     1/256 px
/// Order     row by row, `columns` in a row, and rows to the right hand of the way along a row, as x and y
///           are. First comes the corner whose outermost square is dark: with one side odd and the other
///           even there is one such corner, which stays the first however the board turns. Where several are
///           alike (both sides odd or both even), the one whose row runs most to the right; of two such,
///           down
/// Scratch   find_checkerboard_scratch(src.size(), board, options) bytes, undefined afterwards
/// Time      the pixels, about 35 instructions each, for every halving that is looked at, from the smallest
///           up to the first in which the board is found. Then work ends: places that are looked at for
///           corners are 8 times the pixels at most
/// Errors    empty_image; image_too_large; bad_argument; scratch_too_small; buffer_too_small for fewer
///           places than the board has; not_found: also for a board of which a corner is hidden or outside,
///           and for a larger board
/// Source    the saddle by second derivatives: Chen and Zhang, "A new sub-pixel detector for x-corners in
///           camera calibration targets", WSCG 2005; a lattice that grows: Geiger et al., "Automatic camera
///           and range sensor calibration using a single shot", ICRA 2012, here from edge to edge and with
///           what lies between them looked at. Places by refine_saddle_point() on the image itself, in a
///           window of 0.45 squares
inline Status find_checkerboard(ImageView<const Gray8> src, Size board, const CheckerboardOptions& options,
                                Span<std::uint8_t> scratch, Span<SubPixelPoint> corners);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr bool is_valid_board(Size board) {
    return board.width >= min_board_side && board.height >= min_board_side && board.width <= max_board_side &&
           board.height <= max_board_side;
}
constexpr bool is_valid(const CheckerboardOptions& options) {
    return options.least_contrast >= 4 && options.least_contrast <= 255 && options.candidates >= 64 &&
           options.candidates <= 8192;
}

}  // namespace detail

inline namespace FOVEA_ISA {
namespace kernels {

using detail::BoardFrame;
using detail::BoardLattice;
using detail::BoardPlaces;
using detail::BoardVector;
using detail::LatticePlace;
using detail::LatticeWindow;
using detail::SaddleCandidate;
using detail::SaddleField;
using detail::SaddleWay;

/// Halves of an image, and halves of those.
inline constexpr int max_board_levels = 11;
constexpr int board_levels(Size size, Size board) {
    int levels = 1;
    const int side = 4 * maximum(board.width, board.height);
    Size half{size.width / 2, size.height / 2};
    while (levels < max_board_levels && maximum(half.width, half.height) >= side &&
           minimum(half.width, half.height) >= 24) {
        half = {half.width / 2, half.height / 2};
        ++levels;
    }
    return levels;
}

class CheckerboardFinder {
public:
    static constexpr std::int64_t scratch(Size size, Size board, const CheckerboardOptions& options) {
        std::int64_t halves = 0;
        Size half = size;
        for (int k = 1; k < board_levels(size, board); ++k) {
            half = {half.width / 2, half.height / 2};
            halves += half.area();
        }
        return halves + size.area() + arena_bytes<SaddleCandidate>(options.candidates) +
               arena_bytes<std::int32_t>(3 * std::int64_t{size.width}) + BoardLattice::scratch(reach(board)) +
               arena_bytes<SubPixelPoint>(board.area()) + gaussian_5x5_scratch(size);
    }
    CheckerboardFinder(ImageView<const Gray8> src, Size board, const CheckerboardOptions& options,
                       Span<std::uint8_t> bytes)
        : src_(src),
          board_(board),
          options_(options),
          arena_(bytes),
          candidates_(arena_.take<SaddleCandidate>(options.candidates)),
          rows_(arena_.take<std::int32_t>(3 * std::int64_t{src.width()})),
          lattice_(reach(board), arena_),
          refined_(arena_.take<SubPixelPoint>(board.area())),
          smooth_(arena_.take_unset<std::uint8_t>(src.size().area())) {
        levels_[0] = src;
        count_ = board_levels(src.size(), board);
        for (int k = 1; k < count_; ++k) levels_[k] = halved(levels_[k - 1]);
    }

    Status find(Span<SubPixelPoint> corners) {
        for (int k = count_ - 1; k >= 0; --k)
            if (find_at(k)) {
                const Status status = finish(k, corners);
                if (status == Status::ok) return status;
            }
        return Status::not_found;
    }

private:
    static constexpr int reach(Size board) { return maximum(board.width, board.height) + 1; }

    ImageView<const Gray8> halved(ImageView<const Gray8> src) {
        const Size size{src.width() / 2, src.height() / 2};
        const ImageView<Gray8> half(arena_.take_unset<Gray8>(size.area()).data(), size, size.width);
        for (int y = 0; y < size.height; ++y)
            kernels::halve_row(src.row(2 * y), src.row(2 * y + 1), size.width, half.row(y));
        return half;
    }

    bool find_at(int k) {
        const ImageView<Gray8> smooth(smooth_.data(), levels_[k].size(), levels_[k].width());
        if (gaussian_5x5(levels_[k], Border::replicate, arena_.rest(), smooth) != Status::ok) return false;
        field_ = SaddleField(smooth, options_.least_contrast);
        int found = 0;
        const ListView<SaddleCandidate> list(candidates_.data(), static_cast<int>(candidates_.size()),
                                             &found);
        field_.gather(rows_, list);
        all_ = list.span();
        if (found < board_.area() / 4) return false;
        budget_ = 8 * levels_[k].size().area() + 65536;
        for (SaddleCandidate& seed : all_) {
            if (budget_ <= 0) return false;
            if (seed.used) continue;
            seed.used = true;
            budget_ -= found;
            BoardVector u;
            BoardVector v;
            if (!step_from(seed, seed.a, seed.b, u) || !step_from(seed, seed.b, seed.a, v)) continue;
            grow(seed, u, v);
            if (find_window()) return true;
        }
        return false;
    }

    /// The way along an edge of a seed to the next corner; of both directions the nearer.
    bool step_from(const SaddleCandidate& seed, SaddleWay way, SaddleWay side, BoardVector& step) const {
        const BoardVector along{way.x, way.y};
        const BoardVector beside{side.x, side.y};
        std::int64_t nearest = std::int64_t{1} << 62;
        bool found = false;
        for (const SaddleCandidate& other : all_) {
            const BoardVector to = other.place() - seed.place();
            const std::int64_t square = inner_product(to, to);
            if (square >= nearest || square < 3 * 3 * 65536) continue;
            const std::int64_t forth = inner_product(to, along);
            const std::int64_t off = cross_product(to, along);
            const std::int64_t far = forth < 0 ? -forth : forth;
            if ((off < 0 ? -off : off) * 3 > far) continue;
            if (field_.along({other.x, other.y}, seed.a, seed.b) >= 0) continue;
            const int width = clamp(to.length() / 8, 320, 2048);
            const int sign = forth < 0 ? -1 : 1;
            const BoardVector across{sign * beside.x * width / 64, sign * beside.y * width / 64};
            if (field_.edge(seed.place(), other.place(), across) < field_.least_step()) continue;
            nearest = square;
            step = forth < 0 ? -to : to;
            found = true;
        }
        return found;
    }

    void grow(const SaddleCandidate& seed, BoardVector u, BoardVector v) {
        const SaddleWay way_u = saddle_way(u);
        const SaddleWay way_v = saddle_way(v);
        const Result<BoardVector> first = field_.saddle_near(seed.place(), 1, way_u, way_v, 1);
        lattice_.start(first ? *first : seed.place(), u, v, -1);
        lattice_.grow([&](LatticePlace at, LatticePlace from, BoardVector expected) {
            const BoardVector u_here = lattice_.step(from, 0);
            const BoardVector v_here = lattice_.step(from, 1);
            const int height = minimum(u_here.length(), v_here.length());
            const int radius = clamp(height * 3 / 10 / 256, 1, 64);
            budget_ -= (2 * radius + 1) * (2 * radius + 1);
            if (budget_ <= 0) return false;
            const Result<BoardVector> place =
                field_.saddle_near(expected, radius, saddle_way(u_here), saddle_way(v_here), sign_of(at));
            if (!place || !field_.crosses(*place, u_here, v_here, sign_of(at)) || !joins(at, *place))
                return false;
            lattice_.add(at, *place, -1);
            return true;
        });
        for (SaddleCandidate& other : all_) {
            if (other.used) continue;
            for (int m = 0; m < lattice_.size() && !other.used; ++m) {
                const BoardVector off = other.place() - lattice_.place(lattice_.member(m));
                other.used = inner_product(off, off) < 3 * 3 * 65536;
            }
        }
    }
    /// 1 where it is bright between the ways along i and j, -1 where it is dark.
    static int sign_of(LatticePlace at) { return ((at.i + at.j) & 1) == 0 ? 1 : -1; }

    /// Whether edges of the right colours lead from a new place to all known neighbours.
    bool joins(LatticePlace at, BoardVector place) const {
        constexpr LatticePlace ways[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
        for (const LatticePlace way : ways) {
            const LatticePlace to = at + way;
            if (!lattice_.known(to)) continue;
            if (edge_between(field_, to, lattice_.place(to), -way, place) < field_.least_step()) return false;
        }
        return true;
    }
    /// The step of brightness across the edge that leads from a member in a way to a place, above 0 if the
    /// right side is bright.
    int edge_between(const SaddleField& field, LatticePlace member, BoardVector from, LatticePlace way,
                     BoardVector to) const {
        const int axis = way.i != 0 ? 0 : 1;
        const BoardVector side = SaddleField::side_of(lattice_.step(member, 1 - axis));
        const int sign = sign_of(member) * (way.i + way.j);
        return field.edge(from, to, sign < 0 ? -side : side);
    }

    bool find_window() {
        const Size sizes[2] = {board_, {board_.height, board_.width}};
        for (const Size size : sizes) {
            const Result<LatticeWindow> window = whole_window(lattice_, size);
            if (!window) continue;
            window_ = *window;
            return true;
        }
        return false;
    }

    /// Which corner comes first: see find_checkerboard().
    BoardFrame order() const {
        BoardFrame best;
        bool best_dark = false;
        BoardVector best_row;
        bool any = false;
        for (int quarters = 0; quarters < 4; ++quarters) {
            const Size size =
                quarters % 2 == 0 ? window_.size : Size{window_.size.height, window_.size.width};
            if (size != board_) continue;
            const BoardFrame frame = frame_of(window_, quarters);
            const BoardVector row = first_row(lattice_, frame, board_.width);
            const bool dark = !is_bright(frame);
            const bool better = !any || (best_dark != dark ? dark : runs_right_of(row, best_row));
            if (!better) continue;
            any = true;
            best = frame;
            best_dark = dark;
            best_row = row;
        }
        return best;
    }

    /// Whether the square between the first corner, its row and its column is; and so is the one outside.
    static bool is_bright(const BoardFrame& frame) {
        return sign_of(frame.start) * (frame.along.i + frame.along.j) * (frame.down.i + frame.down.j) == 1;
    }

    Status finish(int k, Span<SubPixelPoint> corners) {
        // From pixels of the level to those of the picture.
        const int shift = ((1 << k) - 1) * 128;
        for (int m = 0; m < lattice_.size(); ++m) {
            const LatticePlace at = lattice_.member(m);
            const BoardVector p = lattice_.place(at);
            lattice_.move(at, {(p.x << k) + shift, (p.y << k) + shift});
        }
        const BoardFrame frame = order();
        BoardPlaces places(refined_, board_);
        for (int row = 0; row < board_.height; ++row)
            for (int column = 0; column < board_.width; ++column) {
                const LatticePlace at = frame.at(column, row);
                const Result<SubPixelPoint> point =
                    refine_saddle_point(src_, clamped(lattice_.place(at)), window_at(at));
                if (!point) return point.status();
                places.set(column, row, *point);
            }
        const bool bright = is_bright(frame);
        if (!is_even(places) || !is_checkered(src_, places, bright) || is_part(src_, places, bright))
            return Status::not_found;
        for (std::ptrdiff_t n = 0; n < refined_.size(); ++n) corners[n] = refined_[n];
        return Status::ok;
    }
    SubPixelPoint clamped(BoardVector p) const {
        return BoardVector{clamp<std::int32_t>(p.x, 0, (src_.width() - 1) * 256),
                           clamp<std::int32_t>(p.y, 0, (src_.height() - 1) * 256)}
            .point();
    }
    /// Almost half of the squares around a corner: outer ones may be cut off there. More of small ones, and
    /// no more than 32 px of large ones.
    SaddleWindow window_at(LatticePlace at) const {
        const BoardVector u = lattice_.step(at, 0);
        const BoardVector v = lattice_.step(at, 1);
        const std::int64_t area = cross_product(u, v);
        const int longer = maximum(maximum(u.length(), v.length()), 1);
        const std::int64_t height = maximum<std::int64_t>((area < 0 ? -area : area) / longer, 1);
        // In 1/256 of the ways.
        const std::int64_t most = minimum<std::int64_t>(200, 32 * 65536 / longer);
        const std::int64_t part = minimum(maximum<std::int64_t>(115, 640 * 256 / height), most);
        const auto share = [&](BoardVector way) {
            return BoardVector{static_cast<std::int32_t>(way.x * part / 256),
                               static_cast<std::int32_t>(way.y * part / 256)}
                .point();
        };
        return {share(u), share(v)};
    }
    ImageView<const Gray8> src_;
    Size board_;
    CheckerboardOptions options_;
    Arena arena_;
    Span<SaddleCandidate> candidates_;
    Span<std::int32_t> rows_;
    BoardLattice lattice_;
    Span<SubPixelPoint> refined_;
    Span<std::uint8_t> smooth_;
    ImageView<const Gray8> levels_[max_board_levels];
    int count_ = 1;
    SaddleField field_;
    std::int64_t budget_ = 0;  ///< pixels and candidates that may be looked at yet
    Span<SaddleCandidate> all_;
    LatticeWindow window_;
};

}  // namespace kernels

constexpr std::int64_t find_checkerboard_scratch(Size size, Size board, const CheckerboardOptions& options) {
    if (!detail::is_valid_board(board) || !detail::is_valid(options)) return 0;
    return kernels::CheckerboardFinder::scratch(size, board, options);
}

inline Status find_checkerboard(ImageView<const Gray8> src, Size board, const CheckerboardOptions& options,
                                Span<std::uint8_t> scratch, Span<SubPixelPoint> corners) {
    if (src.empty()) return Status::empty_image;
    if (src.width() > max_image_side || src.height() > max_image_side) return Status::image_too_large;
    if (!detail::is_valid_board(board) || !detail::is_valid(options)) return Status::bad_argument;
    if (scratch.size() < find_checkerboard_scratch(src.size(), board, options))
        return Status::scratch_too_small;
    if (corners.size() < board.area()) return Status::buffer_too_small;
    return kernels::CheckerboardFinder(src, board, options, scratch).find(corners);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
