// SPDX-License-Identifier: MIT
//
// The pieces of straight lines that are there in an edge image. Book sec. 2.8.4.
#pragma once

#include <cstdint>
#include <initializer_list>

#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/feature/hough_lines.hpp>
#include <fovea/feature/strongest.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A straight edge with its ends.
struct LineSegment {
    Point from;
    Point to;
    int pixels = 0;  ///< edge pixels between them, the ends among them
    int line = 0;    ///< which of the lines it is a piece of
};

struct LineSegmentOptions {
    int min_length = 20;  ///< of the longer side of a segment's box, in pixels, 1 or more
    int max_gap = 2;      ///< pixels without an edge that do not end a segment, 0 or more
    int tolerance = 1;    ///< how far beside the line an edge may be, along a row or a column, 0..8
};

/// Walks along every line through the image, pixel by pixel along the side that it is nearer to, and notes
/// where edges begin and end. The ends are edge pixels, the nearest to the line within the tolerance; of two
/// as near the one above or to the left.
///
/// Shapes  1x1 or larger
/// Order   by lines, as they are given; within one by the row, then the column of from
/// Cost    width or height times 2 tolerance + 1 looks into the image for a line
/// Errors  empty_image; bad_argument; capacity_exceeded: segments holds those with most pixels, of equal ones
///         the first
/// Source  book sec. 2.8.4; the toolkit had lines without ends
inline Status line_segments(ImageView<const Gray8> edges, Span<const PolarLine> lines,
                            const LineSegmentOptions& options, ListView<LineSegment> segments);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// y or x of a line for the other one, in 2^-30 px.
struct LinePath {
    bool steep = false;  ///< a step is a row
    std::int64_t start = 0;
    std::int64_t slope = 0;

    explicit LinePath(const PolarLine& line) {
        const UnitVector normal = unit_vector(line.theta);
        const std::int64_t x = normal.x.raw();
        const std::int64_t y = normal.y.raw();
        steep = maximum(x, -x) > maximum(y, -y);
        // The larger component is above 0.7: the start stays below 2^47, |slope| below 2^30 + 2.
        std::int64_t over = steep ? x : y;
        const std::int64_t sign = over < 0 ? -1 : 1;
        over *= sign;
        const std::int64_t distance = sign * line.distance.raw();
        start = round_divide(distance * Unit::one, over) * (std::int64_t{1} << 22);
        slope = round_divide(-sign * (steep ? y : x) * Unit::one, over);
    }
    int at(int step) const { return static_cast<int>(round_shift(start + slope * step, 30)); }
};

class SegmentWalk {
public:
    SegmentWalk(ImageView<const Gray8> edges, const LineSegmentOptions& options)
        : edges_(edges), options_(options) {}

    /// found(segment) for every one of a line.
    template <class Found>
    void walk(const PolarLine& line, int number, Found found) {
        const LinePath path(line);
        const int steps = path.steep ? edges_.height() : edges_.width();
        LineSegment segment;
        int gap = 0;
        const auto end = [&] {
            const int length =
                1 + (path.steep ? segment.to.y - segment.from.y : segment.to.x - segment.from.x);
            if (segment.pixels > 0 && length >= options_.min_length) found(segment);
            segment.pixels = 0;
        };
        for (int step = 0; step < steps; ++step) {
            Point pixel;
            if (!look(path, step, pixel)) {
                if (++gap > options_.max_gap && segment.pixels > 0) end();
                continue;
            }
            if (segment.pixels == 0) segment = {pixel, pixel, 0, number};
            segment.to = pixel;
            ++segment.pixels;
            gap = 0;
        }
        end();
    }

private:
    bool look(const LinePath& path, int step, Point& pixel) const {
        const int middle = path.at(step);
        for (int distance = 0; distance <= options_.tolerance; ++distance)
            for (const int place : {middle - distance, middle + distance}) {
                pixel = path.steep ? Point{place, step} : Point{step, place};
                if (edges_.contains(pixel) && edges_.row(pixel.y)[pixel.x] != 0) return true;
            }
        return false;
    }

    ImageView<const Gray8> edges_;
    const LineSegmentOptions& options_;
};

}  // namespace detail

inline Status line_segments(ImageView<const Gray8> edges, Span<const PolarLine> lines,
                            const LineSegmentOptions& options, ListView<LineSegment> segments) {
    if (edges.empty()) return Status::empty_image;
    if (options.min_length < 1 || options.max_gap < 0 || options.tolerance < 0 || options.tolerance > 8)
        return Status::bad_argument;

    const auto comes_later = [](const LineSegment& a, const LineSegment& b) {
        if (a.line != b.line) return a.line > b.line;
        return a.from.y != b.from.y ? a.from.y > b.from.y : a.from.x > b.from.x;
    };
    detail::Strongest strongest(segments, [&](const LineSegment& a, const LineSegment& b) {
        return a.pixels != b.pixels ? a.pixels < b.pixels : comes_later(a, b);
    });
    detail::SegmentWalk walk(edges, options);
    for (int i = 0; i < lines.size(); ++i)
        walk.walk(lines[i], i, [&](const LineSegment& segment) { strongest.add(segment); });
    sort(segments.span(), [&](const LineSegment& a, const LineSegment& b) { return comes_later(b, a); });
    return strongest.status();
}

}  // namespace fovea
