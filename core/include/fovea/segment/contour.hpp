// SPDX-License-Identifier: MIT
//
// Contours: the pixels along the borders of regions and holes, one after the other. Book sec. 6.2.1 names
// them.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/segment/region.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Which points of a contour are listed.
enum class ContourPoints : std::uint8_t {
    all,      ///< every pixel, each a neighbour of the one before
    corners,  ///< only those where the way turns: the ends of straight stretches
};

/// A border among others in one list of points.
struct Contour {
    int first = 0;      ///< place of its first point
    int count = 0;      ///< points
    int region = 0;     ///< place of the region in its list
    bool hole = false;  ///< the border of a hole in the region, not of the region
    int parent = -1;    ///< place of the contour of the region, for a hole; none for a region
};

/// One of the eight ways to a neighbouring pixel: 0 is +x, 1 is +x +y, and so on clockwise on screen.
using ChainCode = std::uint8_t;

/// The step of a chain code.
constexpr Point chain_step(ChainCode code);

/// The chain code of the way from a point to a neighbour of it.
///
/// Errors  bad_argument if they are no neighbours
constexpr Result<ChainCode> chain_code(Point from, Point to);

/// Walks once along the outermost pixels of a region.
///
/// The walk runs over pixels of the region that have ground beside them, clockwise on screen, and comes over
/// pixels where the region is one pixel wide more than once.
///
/// Shapes   binary 1x1 or larger; zero is ground, all else belongs. start belongs, the pixels to its left and
///          above it do not: Region::first is such a pixel. At another one the border of a hole may begin,
///          which is walked then
/// Order    start is the first point; visit(Point) for each
/// Border   beyond the image is ground
/// Cost     with the length of the contour; a pixel looks at eight neighbours at most, at three on average
/// Errors   empty_image; out_of_range if start is outside the image; bad_argument if it is no start
/// Source   border following; Suzuki and Abe, "Topological Structural Analysis of Digitized Binary Images by
///          Border Following", 1985, step 3. A single pixel is one point
template <class Visit>
Status trace_region_border(ImageView<const std::uint8_t> binary, Connectivity connectivity, Point start,
                           Visit visit);

/// Walks once along the pixels of a region around one of its holes, counter-clockwise on screen.
///
/// Shapes  first is the first pixel of the hole, row by row: Hole::first
/// Order   the pixel to the left of it is the first point
/// Errors  also bad_argument if there is no region to the left of first
/// Others  as trace_region_border()
template <class Visit>
Status trace_hole_border(ImageView<const std::uint8_t> binary, Connectivity connectivity, Point first,
                         Visit visit);

/// The contours of regions and holes, as connected_components() lists them.
///
/// Shapes   regions and holes are those of binary with this connectivity
/// Order    the contours of the regions, then those of the holes, each in the order of its list
/// Errors   empty_image; out_of_range or bad_argument if lists and image do not belong together;
///          capacity_exceeded when either list is full: all contours in the list are whole
/// Source   trace_region_border(), trace_hole_border()
template <class Accumulated = Moments>
Status trace_contours(ImageView<const std::uint8_t> binary, Connectivity connectivity, ContourPoints wanted,
                      NonDeduced<Span<const RegionOf<Accumulated>>> regions,
                      NonDeduced<Span<const HoleOf<Accumulated>>> holes, ListView<Point> points,
                      ListView<Contour> contours);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr Point chain_steps[8] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                         {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

/// Follows a border from a pixel of the region: looks around clockwise, from the way it came on, for the next
/// pixel that belongs. Turn is 1 or 2: only sides, or corners too, hold together.
template <int Turn>
class BorderWalk {
public:
    BorderWalk(ImageView<const std::uint8_t> binary, Point start)
        : binary_(binary), at_(start), pixel_(&binary(start.x, start.y)) {
        for (int code = 0; code < 8; ++code)
            offsets_[code] = chain_steps[code].y * binary.stride_bytes() + chain_steps[code].x;
    }

    Point at() const { return at_; }
    /// The first way, from `from` on clockwise, that leads to a pixel of the region; -1 if there is none.
    int next_way(int from) {
        from_ = from;
        const bool inside =
            at_.x > 0 && at_.y > 0 && at_.x < binary_.width() - 1 && at_.y < binary_.height() - 1;
        for (looked_ = 0; looked_ < 8; looked_ += Turn) {
            const int code = (from + looked_) & 7;
            if (!inside && !binary_.contains({at_.x + chain_steps[code].x, at_.y + chain_steps[code].y}))
                continue;
            if (pixel_[offsets_[code]] != 0) return code;
        }
        return -1;
    }
    /// Whether the last look went over the neighbour of this code, and found ground there.
    bool passed(int code) const { return ((code - from_) & 7) < looked_; }
    void step(int code) {
        at_.x += chain_steps[code].x;
        at_.y += chain_steps[code].y;
        pixel_ += offsets_[code];
    }

private:
    ImageView<const std::uint8_t> binary_;
    Point at_;
    const std::uint8_t* pixel_;
    std::ptrdiff_t offsets_[8];
    int from_ = 0;
    int looked_ = 0;
};

/// The whole border from start, looking at first from the way of the ground beside it. After every look
/// note(walk) may ask what was passed.
template <int Turn, class Visit, class Note>
void follow_border(ImageView<const std::uint8_t> binary, Point start, int ground, Visit visit, Note note) {
    BorderWalk<Turn> walk(binary, start);
    const int first = walk.next_way(ground);
    visit(start);
    note(walk);
    if (first < 0) return;
    int way = first;
    for (;;) {
        walk.step(way);
        // Behind is the pixel it came from; what comes after it, clockwise, is looked at anew.
        way = walk.next_way((way + 4 + Turn) & 7);
        note(walk);
        if (walk.at() == start && way == first) return;
        visit(walk.at());
    }
}

template <class Visit, class Note>
void follow_border(ImageView<const std::uint8_t> binary, Connectivity connectivity, Point start, int ground,
                   Visit visit, Note note) {
    if (connectivity == Connectivity::eight)
        follow_border<1>(binary, start, ground, visit, note);
    else
        follow_border<2>(binary, start, ground, visit, note);
}
/// For walks whose looks nobody asks for.
struct NoNote {
    template <class Walk>
    void operator()(const Walk&) const {}
};

/// Takes the points of a contour as they come and lists those that are wanted.
class ContourWriter {
public:
    ContourWriter(ListView<Point> points, ContourPoints wanted) : points_(points), wanted_(wanted) {}

    int first() const { return first_; }
    bool full() const { return full_; }
    void begin() {
        first_ = points_.size();
        full_ = false;
    }
    void operator()(Point p) {
        const int count = points_.size() - first_;
        if (wanted_ == ContourPoints::corners && count >= 2 &&
            straight(points_[first_ + count - 2], points_[first_ + count - 1], p))
            points_[first_ + count - 1] = p;
        else if (points_.push(p) != Status::ok)
            full_ = true;
    }
    /// The way back to the first point may go straight on at either end.
    void end() {
        if (wanted_ == ContourPoints::all) return;
        const auto at = [&](int i) { return points_[first_ + i]; };
        int count = points_.size() - first_;
        if (count > 2 && straight(at(count - 2), at(count - 1), at(0))) points_.shrink(first_ + --count);
        if (count > 2 && straight(at(count - 1), at(0), at(1))) {
            points_[first_] = at(count - 1);
            points_.shrink(first_ + count - 1);
        }
    }
    void undo() { points_.shrink(first_); }

private:
    /// b lies on the way from a straight on to c.
    static bool straight(Point a, Point b, Point c) {
        const int ux = b.x - a.x;
        const int uy = b.y - a.y;
        const int vx = c.x - b.x;
        const int vy = c.y - b.y;
        return ux * vy == uy * vx && ux * vx + uy * vy > 0;
    }

    ListView<Point> points_;
    ContourPoints wanted_;
    int first_ = 0;
    bool full_ = false;
};

}  // namespace detail

constexpr Point chain_step(ChainCode code) { return detail::chain_steps[code & 7]; }

constexpr Result<ChainCode> chain_code(Point from, Point to) {
    for (int code = 0; code < 8; ++code) {
        const Point step = detail::chain_steps[code];
        if (std::int64_t{from.x} + step.x == to.x && std::int64_t{from.y} + step.y == to.y)
            return static_cast<ChainCode>(code);
    }
    return Status::bad_argument;
}

template <class Visit>
Status trace_region_border(ImageView<const std::uint8_t> binary, Connectivity connectivity, Point start,
                           Visit visit) {
    if (binary.empty()) return Status::empty_image;
    if (!binary.contains(start)) return Status::out_of_range;
    const auto belongs = [&](int x, int y) { return binary.contains({x, y}) && binary(x, y) != 0; };
    if (!belongs(start.x, start.y) || belongs(start.x - 1, start.y) || belongs(start.x, start.y - 1))
        return Status::bad_argument;
    detail::follow_border(binary, connectivity, start, 4, visit, detail::NoNote());
    return Status::ok;
}

template <class Visit>
Status trace_hole_border(ImageView<const std::uint8_t> binary, Connectivity connectivity, Point first,
                         Visit visit) {
    if (binary.empty()) return Status::empty_image;
    if (!binary.contains(first)) return Status::out_of_range;
    if (first.x == 0 || binary(first.x, first.y) != 0 || binary(first.x - 1, first.y) == 0)
        return Status::bad_argument;
    detail::follow_border(binary, connectivity, {first.x - 1, first.y}, 0, visit, detail::NoNote());
    return Status::ok;
}

template <class Accumulated>
Status trace_contours(ImageView<const std::uint8_t> binary, Connectivity connectivity, ContourPoints wanted,
                      NonDeduced<Span<const RegionOf<Accumulated>>> regions,
                      NonDeduced<Span<const HoleOf<Accumulated>>> holes, ListView<Point> points,
                      ListView<Contour> contours) {
    if (binary.empty()) return Status::empty_image;
    points.clear();
    contours.clear();
    detail::ContourWriter writer(points, wanted);
    const auto list = [&](Status traced, Contour contour) {
        if (traced != Status::ok) return traced;
        writer.end();
        contour.first = writer.first();
        contour.count = points.size() - writer.first();
        if (!writer.full() && contours.push(contour) == Status::ok) return Status::ok;
        writer.undo();
        return Status::capacity_exceeded;
    };
    for (std::ptrdiff_t i = 0; i < regions.size(); ++i) {
        writer.begin();
        Contour contour;
        contour.region = static_cast<int>(i);
        const Status traced =
            trace_region_border(binary, connectivity, regions[i].first, [&](Point p) { writer(p); });
        if (Status s = list(traced, contour); s != Status::ok) return s;
    }
    for (std::ptrdiff_t i = 0; i < holes.size(); ++i) {
        const HoleOf<Accumulated>& hole = holes[i];
        if (hole.region < 0 || hole.region >= regions.size()) return Status::bad_argument;
        writer.begin();
        Contour contour;
        contour.region = contour.parent = hole.region;
        contour.hole = true;
        const Status traced =
            trace_hole_border(binary, connectivity, hole.first, [&](Point p) { writer(p); });
        if (Status s = list(traced, contour); s != Status::ok) return s;
    }
    return Status::ok;
}

}  // namespace fovea
