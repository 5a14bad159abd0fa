// SPDX-License-Identifier: MIT
//
// The lattice that a board's corners or circles stand on, grown from one of them to its neighbours.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The most columns or rows of a board, and the fewest.
inline constexpr int max_board_side = 64;
inline constexpr int min_board_side = 3;

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A place or a way in an image, in 1/256 px.
struct BoardVector {
    std::int32_t x = 0;
    std::int32_t y = 0;

    friend constexpr BoardVector operator+(BoardVector a, BoardVector b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr BoardVector operator-(BoardVector a, BoardVector b) { return {a.x - b.x, a.y - b.y}; }
    friend constexpr BoardVector operator-(BoardVector a) { return {-a.x, -a.y}; }
    friend constexpr BoardVector operator*(int a, BoardVector b) { return {a * b.x, a * b.y}; }
    constexpr SubPixelPoint point() const { return {SubPixel::from_raw(x), SubPixel::from_raw(y)}; }
    constexpr int length() const { return static_cast<int>(hypotenuse(x, y)); }
};
constexpr BoardVector board_vector(SubPixelPoint p) { return {p.x.raw(), p.y.raw()}; }
constexpr std::int64_t inner_product(BoardVector a, BoardVector b) {
    return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y;
}
/// Positive where b is turned from a as y is from x.
constexpr std::int64_t cross_product(BoardVector a, BoardVector b) {
    return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
}

/// A place of the lattice, counted from the seed.
struct LatticePlace {
    std::int16_t i = 0;
    std::int16_t j = 0;

    friend constexpr LatticePlace operator+(LatticePlace a, LatticePlace b) {
        return {static_cast<std::int16_t>(a.i + b.i), static_cast<std::int16_t>(a.j + b.j)};
    }
    friend constexpr LatticePlace operator-(LatticePlace a) {
        return {static_cast<std::int16_t>(-a.i), static_cast<std::int16_t>(-a.j)};
    }
};

/// Places that are known, around the seed at (0, 0) and not farther than reach from it.
class BoardLattice {
public:
    static constexpr std::int64_t scratch(int reach) {
        return arena_bytes<Node>(cells(reach)) + arena_bytes<LatticePlace>(cells(reach));
    }
    BoardLattice(int reach, Arena& arena)
        : reach_(reach),
          nodes_(arena.take<Node>(cells(reach))),
          members_(arena.take<LatticePlace>(cells(reach))) {}

    /// A lattice of one, whose neighbours are expected u and v away.
    void start(BoardVector seed, BoardVector u, BoardVector v, int item) {
        for (int m = 0; m < count_; ++m) node(members_[m]).known = false;
        count_ = 0;
        steps_[0] = u;
        steps_[1] = v;
        add({}, seed, item);
    }
    void add(LatticePlace at, BoardVector place, int item) {
        FOVEA_ASSERT(inside(at) && !known(at));
        node(at) = {place, item, true};
        members_[count_++] = at;
    }
    /// Asks `find(at, from, expected)` for the neighbours of all that is known until none is found: it adds
    /// the place `at`, next to the member `from`, and answers true, or false. At most four asks a place.
    template <class Find>
    void grow(Find find) {
        constexpr LatticePlace ways[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
        for (int m = 0; m < count_; ++m)
            for (const LatticePlace way : ways) {
                const LatticePlace from = members_[m];
                const LatticePlace at = from + way;
                if (!inside(at) || known(at)) continue;
                if (!find(at, from, expected(from, way))) continue;
            }
    }

    int size() const { return count_; }
    LatticePlace member(int m) const { return members_[m]; }
    bool known(LatticePlace at) const { return inside(at) && node(at).known; }
    BoardVector place(LatticePlace at) const { return node(at).place; }
    void move(LatticePlace at, BoardVector place) { node(at).place = place; }
    int item(LatticePlace at) const { return node(at).item; }

    /// The way from a member to its next in i or, for axis 1, in j; from what is known nearest.
    BoardVector step(LatticePlace at, int axis) const {
        const LatticePlace way = axis == 0 ? LatticePlace{1, 0} : LatticePlace{0, 1};
        const bool next = known(at + way);
        const bool back = known(at + -way);
        if (next && back) {
            const BoardVector both = place(at + way) - place(at + -way);
            return {both.x / 2, both.y / 2};
        }
        if (next) return place(at + way) - place(at);
        if (back) return place(at) - place(at + -way);
        return steps_[axis];
    }

private:
    struct Node {
        BoardVector place;
        std::int32_t item = -1;
        bool known = false;
    };
    static constexpr std::int64_t cells(int reach) {
        return (2 * std::int64_t{reach} + 1) * (2 * std::int64_t{reach} + 1);
    }
    bool inside(LatticePlace at) const {
        return at.i >= -reach_ && at.i <= reach_ && at.j >= -reach_ && at.j <= reach_;
    }
    Node& node(LatticePlace at) const {
        return nodes_[(at.j + reach_) * (2 * std::ptrdiff_t{reach_} + 1) + at.i + reach_];
    }
    /// Straight on, and beside the neighbours that are known: the mean of what they say.
    BoardVector expected(LatticePlace from, LatticePlace way) const {
        BoardVector sum;
        int votes = 0;
        const BoardVector here = place(from);
        if (known(from + -way)) {
            sum = sum + (here - place(from + -way));
            ++votes;
        }
        const LatticePlace side{way.j, way.i};
        const LatticePlace both[2] = {from + side, from + -side};
        for (const LatticePlace beside : both)
            if (known(beside) && known(beside + way)) {
                sum = sum + (place(beside + way) - place(beside));
                ++votes;
            }
        if (votes == 0) {
            const BoardVector first = steps_[way.i != 0 ? 0 : 1];
            return way.i + way.j > 0 ? here + first : here - first;
        }
        return here + BoardVector{sum.x / votes, sum.y / votes};
    }

    int reach_;
    Span<Node> nodes_;
    Span<LatticePlace> members_;
    int count_ = 0;
    BoardVector steps_[2];
};

/// A way to number a part of a lattice: row by row from start.
struct BoardFrame {
    LatticePlace start;
    LatticePlace along;  ///< from one of a row to the next
    LatticePlace down;   ///< from one row to the next

    constexpr LatticePlace at(int column, int row) const {
        return {static_cast<std::int16_t>(start.i + column * along.i + row * down.i),
                static_cast<std::int16_t>(start.j + column * along.j + row * down.j)};
    }
};

}  // namespace detail

}  // namespace fovea
