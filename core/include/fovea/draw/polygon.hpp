// SPDX-License-Identifier: MIT
//
// Polygons, outlined and filled.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/draw/line.hpp>
#include <fovea/draw/run.hpp>
#include <fovea/draw/slope.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The polyline through all vertices and back to the first.
///
/// Shapes  as draw_line(); no vertices draw nothing
/// Errors  empty_image, bad_argument; every vertex is checked before the first line is drawn
/// Source  as draw_line()
template <class Pixel>
Status draw_polygon(ImageView<Pixel> image, Span<const Point> vertices, NonDeduced<Pixel> colour,
                    int thickness = 1);

/// An edge on its way down the image: scratch of fill_polygon().
struct PolygonEdge {
    Slope crossing;  ///< the first column at or right of the edge, in the current row
    int first_row;
    int last_row;
};

/// Scratch elements that fill_polygon() needs.
constexpr std::ptrdiff_t fill_polygon_scratch(std::ptrdiff_t vertices) { return vertices; }

/// All pixels whose centres are inside the closed polygon through the vertices: inside is where a ray crosses
/// the edges an odd number of times (even-odd rule), so a polygon may cross itself and have holes.
///
/// Shapes    any image; vertices within max_draw_coordinate; fewer than 3 enclose nothing
/// Rounding  exact. A centre on a left or upper edge belongs, one on a right or lower edge does not: polygons
///           that share an edge neither overlap nor leave a gap. draw_polygon() over it adds the whole rim
/// Scratch   fill_polygon_scratch(vertices.size()) elements, undefined afterwards; this bounds the vertices
/// Time      rows inside the image times vertices, and the pixels drawn; times vertices again at worst, where
///           edges cross each other without end
/// Errors    empty_image, bad_argument, scratch_too_small
/// Source    J. D. Foley et al., "Computer Graphics: Principles and Practice", 2nd ed., sec. 3.6, with exact
///           edges, each of which starts at its first row inside the image
template <class Pixel>
Status fill_polygon(ImageView<Pixel> image, Span<const Point> vertices, NonDeduced<Pixel> colour,
                    Span<PolygonEdge> scratch);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The edges of a polygon that cross rows of an image, in the caller's memory: first the live ones, from left
/// to right, which cross the current row; then those that wait for their first row.
class EdgeTable {
public:
    EdgeTable(Span<const Point> vertices, int height, Span<PolygonEdge> memory) : edges_(memory) {
        for (std::ptrdiff_t i = 0; i < vertices.size(); ++i)
            add(vertices[i], vertices[i + 1 < vertices.size() ? i + 1 : 0], height);
    }

    bool empty() const { return count_ == 0; }
    /// Of the edges not yet passed; needs one.
    int first_row() const {
        int row = edges_[0].first_row;
        for (const PolygonEdge& edge : edges_.first(count_)) row = minimum(row, edge.first_row);
        return row;
    }

    /// Goes on to the next row: every edge is asked for each row from its first to its last.
    void enter(int row) {
        std::ptrdiff_t kept = 0;
        for (std::ptrdiff_t i = 0; i < live_; ++i) {
            if (edges_[i].last_row < row) continue;
            if (kept != i) edges_[kept] = edges_[i];
            edges_[kept++].crossing.step();
        }
        // Waiting edges from the far end close the gap.
        while (live_ > kept) edges_[--live_] = edges_[--count_];
        for (std::ptrdiff_t i = live_; i < count_; ++i) {
            if (edges_[i].first_row != row) continue;
            const PolygonEdge edge = edges_[i];
            edges_[i] = edges_[live_];
            edges_[live_++] = edge;
        }
        sort();
        FOVEA_ASSERT(live_ % 2 == 0);
    }

    Span<const PolygonEdge> live() const { return {edges_.data(), live_}; }

private:
    /// An edge holds the rows from its upper end to just above its lower end: a level edge holds none, and a
    /// vertex between two edges that go on downward is counted once.
    void add(Point from, Point to, int height) {
        const Point upper = from.y < to.y ? from : to;
        const Point lower = from.y < to.y ? to : from;
        const int first = maximum(upper.y, 0);
        const int last = minimum(lower.y - 1, height - 1);
        if (first > last) return;
        const std::int64_t run = std::int64_t{lower.y} - upper.y;
        edges_[count_++] = {
            Slope(upper.x, std::int64_t{lower.x} - upper.x, run, run - 1, std::int64_t{first} - upper.y),
            first, last};
    }
    /// By insertion: from one row to the next the order hardly changes. An edge that stays is not moved, not
    /// even in place: its step has only just been stored.
    void sort() {
        for (std::ptrdiff_t i = 1; i < live_; ++i) {
            if (edges_[i - 1].crossing.value() <= edges_[i].crossing.value()) continue;
            const PolygonEdge edge = edges_[i];
            std::ptrdiff_t at = i;
            for (; at > 0 && edges_[at - 1].crossing.value() > edge.crossing.value(); --at)
                edges_[at] = edges_[at - 1];
            edges_[at] = edge;
        }
    }

    Span<PolygonEdge> edges_;
    std::ptrdiff_t count_ = 0;
    std::ptrdiff_t live_ = 0;
};

}  // namespace detail

template <class Pixel>
Status draw_polygon(ImageView<Pixel> image, Span<const Point> vertices, NonDeduced<Pixel> colour,
                    int thickness) {
    if (Status s = draw_polyline(image, vertices, colour, thickness); s != Status::ok) return s;
    if (vertices.size() < 3) return Status::ok;
    return draw_line(image, vertices[vertices.size() - 1], vertices[0], colour, thickness);
}

template <class Pixel>
Status fill_polygon(ImageView<Pixel> image, Span<const Point> vertices, NonDeduced<Pixel> colour,
                    Span<PolygonEdge> scratch) {
    if (image.empty()) return Status::empty_image;
    for (const Point p : vertices)
        if (!drawable(p)) return Status::bad_argument;
    if (scratch.size() < fill_polygon_scratch(vertices.size())) return Status::scratch_too_small;

    const detail::Paint<Pixel> paint(colour);
    detail::EdgeTable edges(vertices, image.height(), scratch);
    if (edges.empty()) return Status::ok;
    for (int y = edges.first_row(); y < image.height() && !edges.empty(); ++y) {
        edges.enter(y);
        const Span<const PolygonEdge> live = edges.live();
        for (std::ptrdiff_t i = 0; i + 1 < live.size(); i += 2)
            detail::paint_run(image, y, live[i].crossing.value(),
                              std::int64_t{live[i + 1].crossing.value()} - 1, paint);
    }
    return Status::ok;
}

}  // namespace fovea
