// SPDX-License-Identifier: MIT
//
// The part of a lattice that is a whole board.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/camera/board_lattice.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Places first, first + (1, 0), ... of a lattice, so many in i and j.
struct LatticeWindow {
    LatticePlace first;
    Size size;
};

/// The rectangle of places around all members.
inline LatticeWindow bounds_of(const BoardLattice& lattice) {
    LatticePlace low;
    LatticePlace high;
    for (int m = 0; m < lattice.size(); ++m) {
        const LatticePlace at = lattice.member(m);
        low = {minimum(low.i, at.i), minimum(low.j, at.j)};
        high = {maximum(high.i, at.i), maximum(high.j, at.j)};
    }
    return {low, {high.i - low.i + 1, high.j - low.j + 1}};
}

/// How many of count places on a line of the lattice are known.
inline int known_on(const BoardLattice& lattice, LatticePlace from, LatticePlace way, int count) {
    int known = 0;
    LatticePlace at = from;
    for (int k = 0; k < count; ++k) {
        known += lattice.known(at) ? 1 : 0;
        at = at + way;
    }
    return known;
}

/// True if all places of a window are known, and on no line beside it are half as many: those would be of a
/// larger board, and fewer are things that look like a corner.
inline bool is_whole(const BoardLattice& lattice, LatticeWindow window) {
    constexpr LatticePlace right{1, 0};
    constexpr LatticePlace down{0, 1};
    const int width = window.size.width;
    const int height = window.size.height;
    LatticePlace row = window.first;
    for (int j = 0; j < height; ++j) {
        if (known_on(lattice, row, right, width) < width) return false;
        row = row + down;
    }
    const auto at = [&](int i, int j) {
        return window.first + LatticePlace{static_cast<std::int16_t>(i), static_cast<std::int16_t>(j)};
    };
    return 2 * known_on(lattice, at(0, -1), right, width) < width &&
           2 * known_on(lattice, at(0, height), right, width) < width &&
           2 * known_on(lattice, at(-1, 0), down, height) < height &&
           2 * known_on(lattice, at(width, 0), down, height) < height;
}

/// The window of a size that is a whole board.
///
/// Errors  not_found if there is none
inline Result<LatticeWindow> whole_window(const BoardLattice& lattice, Size size) {
    const LatticeWindow all = bounds_of(lattice);
    if (lattice.size() < size.area()) return Status::not_found;
    for (int j = 0; j + size.height <= all.size.height; ++j)
        for (int i = 0; i + size.width <= all.size.width; ++i) {
            const LatticeWindow window{
                all.first + LatticePlace{static_cast<std::int16_t>(i), static_cast<std::int16_t>(j)}, size};
            if (is_whole(lattice, window)) return window;
        }
    return Status::not_found;
}

/// A window read from one of its corners, turned by quarters: 0 begins at its first place and runs along i.
inline BoardFrame frame_of(LatticeWindow window, int quarters) {
    constexpr LatticePlace ways[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const int right = quarters == 1 || quarters == 2 ? window.size.width - 1 : 0;
    const int bottom = quarters == 2 || quarters == 3 ? window.size.height - 1 : 0;
    return {window.first + LatticePlace{static_cast<std::int16_t>(right), static_cast<std::int16_t>(bottom)},
            ways[quarters], ways[(quarters + 1) % 4]};
}

/// The way of the first row of a board in the image.
inline BoardVector first_row(const BoardLattice& lattice, const BoardFrame& frame, int columns) {
    return lattice.place(frame.at(columns - 1, 0)) - lattice.place(frame.start);
}
/// Of two ways the one that runs more to the right; of two that run equally, down.
constexpr bool runs_right_of(BoardVector a, BoardVector b) { return a.x != b.x ? a.x > b.x : a.y > b.y; }

}  // namespace detail

}  // namespace fovea
