// SPDX-License-Identifier: MIT
//
// Whether places that were found are those of a board: evenly set, and squares of two colours between them.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/camera/board_lattice.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The places of a board, row by row.
class BoardPlaces {
public:
    BoardPlaces(Span<SubPixelPoint> places, Size board) : places_(places), board_(board) {}

    int columns() const { return board_.width; }
    int rows() const { return board_.height; }
    BoardVector operator()(int column, int row) const { return board_vector(places_[index(column, row)]); }
    void set(int column, int row, SubPixelPoint place) { places_[index(column, row)] = place; }
    /// The mean way to the neighbours along the row, or for axis 1 the column.
    BoardVector step(int column, int row, int axis) const {
        const int c = axis == 0 ? 1 : 0;
        const int r = 1 - c;
        const BoardVector next = (*this)(minimum(column + c, columns() - 1), minimum(row + r, rows() - 1));
        const BoardVector last = (*this)(maximum(column - c, 0), maximum(row - r, 0));
        const bool inner = axis == 0 ? column > 0 && column < columns() - 1 : row > 0 && row < rows() - 1;
        const BoardVector way = next - last;
        return inner ? BoardVector{way.x / 2, way.y / 2} : way;
    }

private:
    std::ptrdiff_t index(int column, int row) const {
        return static_cast<std::ptrdiff_t>(row) * board_.width + column;
    }
    Span<SubPixelPoint> places_;
    Size board_;
};

/// Whether each place is near the middle of its neighbours on both sides: off by at most a fifth of the way
/// between them, which is where one step is half as long again as the other.
inline bool is_even(const BoardPlaces& places) {
    const auto even = [](BoardVector a, BoardVector b, BoardVector c) {
        const BoardVector way = c - a;
        const BoardVector off = a + c - 2 * b;
        return 25 * inner_product(off, off) <= inner_product(way, way);
    };
    for (int r = 0; r < places.rows(); ++r)
        for (int c = 0; c < places.columns(); ++c) {
            if (c > 1 && !even(places(c - 2, r), places(c - 1, r), places(c, r))) return false;
            if (r > 1 && !even(places(c, r - 2), places(c, r - 1), places(c, r))) return false;
        }
    return true;
}

/// The sum of the pixels around a place, so many on each side; the outermost repeat.
inline int sum_around(ImageView<const Gray8> src, BoardVector place, int half) {
    const int x = round_shift(place.x, 8);
    const int y = round_shift(place.y, 8);
    int sum = 0;
    for (int dy = -half; dy <= half; ++dy) {
        const Gray8* row = src.row(clamp(y + dy, 0, src.height() - 1));
        for (int dx = -half; dx <= half; ++dx) sum += row[clamp(x + dx, 0, src.width() - 1)];
    }
    return sum;
}

/// Whether the edge between two places has one step of brightness all along, brighter towards side: at each
/// quarter of it at least a quarter of the largest. Blur leaves more; lines and circles, which look like a
/// checkerboard from afar, leave nothing.
inline bool is_edge(ImageView<const Gray8> src, BoardVector from, BoardVector to, BoardVector side) {
    const int length = side.length();
    const int width = maximum(length / 4, 320);
    const BoardVector off{static_cast<std::int32_t>(std::int64_t{side.x} * width / maximum(length, 1)),
                          static_cast<std::int32_t>(std::int64_t{side.y} * width / maximum(length, 1))};
    const int shorter = minimum(length, (to - from).length()) >> 8;
    const int half = shorter < 8 ? 0 : clamp(shorter / 16, 1, 4);
    const BoardVector way = to - from;
    int low = 0;
    int high = 0;
    for (int k = 1; k <= 3; ++k) {
        const BoardVector p = from + BoardVector{way.x * k / 4, way.y * k / 4};
        const int step = sum_around(src, p + off, half) - sum_around(src, p - off, half);
        low = k == 1 ? step : minimum(low, step);
        high = k == 1 ? step : maximum(high, step);
    }
    return low > 0 && 4 * low >= high;
}

/// Whether squares of two colours alternate between the places: of eight edges seven must be.
/// @param bright  the square between the first place, its row and its column is
inline bool is_checkered(ImageView<const Gray8> src, const BoardPlaces& places, bool bright) {
    int edges = 0;
    int wrong = 0;
    for (int r = 0; r < places.rows(); ++r)
        for (int c = 0; c < places.columns(); ++c) {
            const bool to_side = ((r + c) % 2 == 0) == bright;
            for (int axis = 0; axis < 2; ++axis) {
                const int next_c = axis == 0 ? c + 1 : c;
                const int next_r = axis == 0 ? r : r + 1;
                if (next_c == places.columns() || next_r == places.rows()) continue;
                const BoardVector side = places.step(c, r, 1 - axis);
                ++edges;
                if (!is_edge(src, places(c, r), places(next_c, next_r), to_side ? side : -side)) ++wrong;
            }
        }
    return 8 * wrong <= edges;
}

/// Whether four squares of alternating colours meet near a place, u and v away from its neighbours: between
/// the darker of the bright ones and the brighter of the dark ones there is half of the step that the two
/// have which lie back along u.
/// @param bright  it is between u and v, and opposite
inline bool is_crossing(ImageView<const Gray8> src, BoardVector place, BoardVector u, BoardVector v,
                        bool bright) {
    const int shorter = minimum(u.length(), v.length()) >> 8;
    const int half = shorter < 8 ? 0 : clamp(shorter / 16, 1, 4);
    const auto square = [&](BoardVector a, BoardVector b) {
        const BoardVector off = a + b;
        const int sum = sum_around(src, place + BoardVector{off.x / 4, off.y / 4}, half);
        return bright ? sum : -sum;
    };
    const int bright_out = square(u, v);
    const int bright_in = square(-u, -v);
    const int dark_out = square(u, -v);
    const int dark_in = square(-u, v);
    const int step = bright_in - dark_in;
    return step > 0 && 2 * (minimum(bright_out, bright_in) - maximum(dark_out, dark_in)) >= step;
}

/// Whether the pattern goes on beyond one of the four sides, in half of its places or more: then this is a
/// part of a larger board.
inline bool is_part(ImageView<const Gray8> src, const BoardPlaces& places, bool bright) {
    const int last_c = places.columns() - 1;
    const int last_r = places.rows() - 1;
    for (int side = 0; side < 4; ++side) {
        const bool upright = side < 2;
        const int count = upright ? places.rows() : places.columns();
        const int outer = side % 2 == 0 ? 0 : (upright ? last_c : last_r);
        const int inner = outer == 0 ? 1 : outer - 1;
        int crossings = 0;
        for (int k = 0; k < count; ++k) {
            const BoardVector edge = upright ? places(outer, k) : places(k, outer);
            const BoardVector before = upright ? places(inner, k) : places(k, inner);
            const BoardVector along = upright ? places.step(outer, k, 1) : places.step(k, outer, 0);
            const BoardVector out = edge - before;
            const BoardVector p = edge + out;
            if (p.x < 0 || p.y < 0 || p.x > (src.width() - 1) * 256 || p.y > (src.height() - 1) * 256)
                continue;
            // One more step than the edge place, out and along for right and down or the other way.
            const bool even = (outer + 1 + k) % 2 == 0;
            const bool turned = outer == 0;
            if (is_crossing(src, p, out, along, (even == bright) != turned)) ++crossings;
        }
        if (2 * crossings >= count) return true;
    }
    return false;
}

}  // namespace detail

}  // namespace fovea
