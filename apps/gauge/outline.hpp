// SPDX-License-Identifier: MIT
//
// Outline: the contour of a part in its own frame, its extent, and its straight stretches.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <fovea/measure/fit_circle.hpp>
#include <fovea/measure/fit_line.hpp>

#include <gauge/samples.hpp>

namespace fovea::apps {

struct Extent {
    std::int64_t left = 0, right = 0, top = 0, bottom = 0;
};

struct Outline {
    std::vector<PartPoint> points;  ///< clockwise on screen
    Extent extent;
};

/// A straight piece of an outline, in the direction of the outline.
struct Stretch {
    PartPoint from;
    PartPoint to;
    FineAngle direction() const { return angle_of(to.x - from.x, to.y - from.y); }
    std::int64_t length() const { return hypotenuse(to.x - from.x, to.y - from.y); }
};

// ---- Implementation ---------------------------------------------------------------

inline Outline outline_of(const Sample& sample, const PartFrame& frame) {
    Outline outline;
    static_cast<void>(trace_level_contour(
        sample.image->view(), sample.threshold.part, Connectivity::eight, sample.region.first,
        [&](FinePoint point) { outline.points.push_back(frame.to_part(point)); }));
    if (outline.points.empty()) return outline;
    // From a corner on: what is farthest from any point is one.
    const PartPoint any = outline.points.front();
    std::rotate(
        outline.points.begin(),
        std::max_element(outline.points.begin(), outline.points.end(),
                         [&](PartPoint a, PartPoint b) { return length_of(a - any) < length_of(b - any); }),
        outline.points.end());
    Extent& box = outline.extent;
    box = {outline.points[0].x, outline.points[0].x, outline.points[0].y, outline.points[0].y};
    for (const PartPoint& point : outline.points) {
        box.left = std::min(box.left, point.x);
        box.right = std::max(box.right, point.x);
        box.top = std::min(box.top, point.y);
        box.bottom = std::max(box.bottom, point.y);
    }
    return outline;
}

/// A length over a whole number.
inline FinePixel fine_ratio(FinePixel length, int divisor) {
    return FinePixel::from_raw(length.raw() / divisor);
}

/// From widths of a pixel to the unit of the part, and back.
inline PartPoint part_point(FinePoint place, const Scale& scale) {
    return {multiply_divide(place.x.raw(), scale.x_per_pixel, FinePixel::one),
            multiply_divide(place.y.raw(), scale.x_per_pixel, FinePixel::one)};
}

inline FinePoint in_pixels(PartPoint place, const Scale& scale) {
    return {FinePixel::from_ratio(place.x, scale.x_per_pixel),
            FinePixel::from_ratio(place.y, scale.x_per_pixel)};
}

/// The circle of an outline, in widths of a pixel about the origin of the part, and how much of the outline
/// is something else: off it by a fiftieth of the radius or two pixels.
struct RoundOutline {
    Circle circle;
    int percent_off = 0;  ///< rounded up
};

/// not_found if more than a fifth is off the circle.
inline Result<RoundOutline> circle_of(const Outline& outline, const Scale& scale) {
    std::vector<FinePoint> points;
    const std::size_t step = outline.points.size() / static_cast<std::size_t>(max_fit_points) + 1;
    for (std::size_t i = 0; i < outline.points.size(); i += step)
        points.push_back(in_pixels(outline.points[i], scale));
    std::vector<FinePixel> scratch(points.size());
    const Span<const FinePoint> all(points.data(), static_cast<std::ptrdiff_t>(points.size()));
    const Result<CircleFit> fit =
        fit_circle_robust(all, {scratch.data(), all.size()}, FinePixel::from_int(2));
    if (!fit) return fit.status();
    const FinePixel most = std::min(fine_ratio(fit->circle.radius, 50), FinePixel::from_int(2));
    const auto off = std::count_if(points.begin(), points.end(), [&](FinePoint point) {
        return magnitude(distance_from(fit->circle, point).raw()) > magnitude(most.raw());
    });
    if (off * 5 > all.size()) return Status::not_found;
    return RoundOutline{fit->circle, static_cast<int>((off * 100 + all.size() - 1) / all.size())};
}

namespace detail {

/// The length of a vector in a direction, and the vector of a length.
inline std::int64_t along(PartPoint vector, UnitVector way) {
    return multiply_divide(vector.x, way.x.raw(), Unit::one) +
           multiply_divide(vector.y, way.y.raw(), Unit::one);
}
inline PartPoint stretched_by(UnitVector way, std::int64_t length) {
    return {multiply_divide(length, way.x.raw(), Unit::one), multiply_divide(length, way.y.raw(), Unit::one)};
}

/// How far a point is from the line through two others.
inline std::int64_t distance_from_chord(PartPoint point, PartPoint from, PartPoint to) {
    const PartPoint chord{to.x - from.x, to.y - from.y};
    const std::int64_t length = hypotenuse(chord.x, chord.y);
    if (length == 0) return hypotenuse(point.x - from.x, point.y - from.y);
    const Int128 area =
        Int128::product(chord.x, point.y - from.y) - Int128::product(chord.y, point.x - from.x);
    return std::abs(round_divide(area, Int128(length)));
}

/// The corners of an outline that keep it within a tolerance. Douglas and Peucker, 1973, with a stack.
inline std::vector<std::size_t> corners_of(const std::vector<PartPoint>& points, std::int64_t tolerance) {
    const std::size_t count = points.size();
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (hypotenuse(points[i].x - points[0].x, points[i].y - points[0].y) >
            hypotenuse(points[farthest].x - points[0].x, points[farthest].y - points[0].y))
            farthest = i;
    std::vector<std::size_t> corners = {0, farthest};
    std::vector<std::pair<std::size_t, std::size_t>> open = {{0, farthest}, {farthest, count}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        std::size_t worst = first;
        std::int64_t most = tolerance;
        for (std::size_t i = first + 1; i < last; ++i) {
            const std::int64_t distance = distance_from_chord(points[i], points[first], points[last % count]);
            if (distance > most) {
                most = distance;
                worst = i;
            }
        }
        if (worst == first) continue;
        corners.push_back(worst);
        open.push_back({first, worst});
        open.push_back({worst, last});
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// Points first..last of an outline, of count; last may lie beyond its end, once around.
struct PointRange {
    std::size_t first = 0;
    std::size_t last = 0;
};

/// A line fitted to a range, cut at the feet of its ends.
struct FittedEdge {
    Stretch stretch;
    FinePixel rms;  ///< of the distances of its points
    FinePixel bow;  ///< how far its middle third is beside its ends
    /// An arc has a bow of one and a half times its rms, noise of less than half.
    bool straight() const { return bow < FinePixel::from_ratio(1, 8) || bow < rms; }
};
/// The mean distance of the middle third of points from a line, less that of the others, without its sign.
inline FinePixel bow_of(const std::vector<FinePoint>& points, const Line& line) {
    std::int64_t inner = 0;
    std::int64_t outer = 0;
    const std::size_t third = points.size() / 3;
    for (std::size_t i = 0; i < points.size(); ++i)
        (i >= third && i < points.size() - third ? inner : outer) += distance_from(line, points[i]).raw();
    const auto outer_count = static_cast<std::int64_t>(std::max<std::size_t>(2 * third, 1));
    const auto inner_count = static_cast<std::int64_t>(points.size() - 2 * third);
    return FinePixel::from_raw(
        saturate_cast<std::int32_t>(std::abs(inner / inner_count - outer / outer_count)));
}
inline std::optional<FittedEdge> fitted_edge(const Outline& outline, PointRange range, const Scale& scale) {
    const std::size_t count = outline.points.size();
    const std::size_t step = (range.last - range.first) / static_cast<std::size_t>(max_fit_points) + 1;
    std::vector<FinePoint> points;
    for (std::size_t i = range.first; i <= range.last; i += step)
        points.push_back(in_pixels(outline.points[i % count], scale));
    const Result<LineFit> fit = fit_line({points.data(), static_cast<std::ptrdiff_t>(points.size())});
    if (!fit) return {};
    const UnitVector way = unit_vector(fit->line.direction);
    const PartPoint centre = part_point(fit->line.point, scale);
    const auto foot = [&](PartPoint point) { return centre + stretched_by(way, along(point - centre, way)); };
    return FittedEdge{{foot(outline.points[range.first % count]), foot(outline.points[range.last % count])},
                      fit->rms,
                      bow_of(points, fit->line)};
}

/// The longest range around the middle of another that stays within a tolerance of a line; single points may
/// lie farther.
inline PointRange range_along(const Outline& outline, const Stretch& line, PointRange start,
                              std::int64_t tolerance) {
    const std::size_t count = outline.points.size();
    const UnitVector across = unit_vector(line.direction() + FineAngle::quarter_turn());
    const auto near = [&](std::size_t i) {
        return std::abs(along(outline.points[i % count] - line.from, across)) <= tolerance;
    };
    // Counted from one turn on, so that a range may begin before the first point.
    const std::size_t middle = count + (start.first + start.last) / 2;
    PointRange range{middle, middle};
    while (range.last - range.first + 2 < count && (near(range.first - 1) || near(range.first - 2)))
        --range.first;
    while (range.last - range.first + 2 < count && (near(range.last + 1) || near(range.last + 2)))
        ++range.last;
    const std::size_t turns = range.first / count * count;
    return {range.first - turns, range.last - turns};
}

/// True if the middle of a range is in another one, of count points around: they follow the same edge. At
/// corners, ranges of two edges may share a point.
inline bool same_edge(PointRange one, PointRange two, std::size_t count) {
    const std::size_t middle = (one.first + one.last) / 2 % count;
    return (middle >= two.first && middle <= two.last) || middle + count <= two.last;
}

}  // namespace detail

/// The straight stretches of an outline that are longer than a sixth of it is wide: lines fitted to what lies
/// within half a pixel of them, or three times the noise, without a twelfth and six pixels at both ends so
/// that corners stay out.
inline std::vector<Stretch> straight_edges(const Outline& outline, const Scale& scale) {
    std::vector<Stretch> edges;
    const std::size_t count = outline.points.size();
    if (count < 8) return edges;
    const std::int64_t pixel = std::max(scale.x_per_pixel, scale.y_per_pixel);
    const Extent& box = outline.extent;
    const std::int64_t least = std::max(std::max(box.right - box.left, box.bottom - box.top) / 6, 24 * pixel);
    const std::vector<std::size_t> corners = detail::corners_of(outline.points, pixel + pixel / 2);
    std::vector<detail::PointRange> ranges;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const detail::PointRange piece{corners[i],
                                       i + 1 < corners.size() ? corners[i + 1] : count + corners[0]};
        const std::size_t trim = (piece.last - piece.first) / 7;
        const std::optional<detail::FittedEdge> line =
            detail::fitted_edge(outline, {piece.first + trim, piece.last - trim}, scale);
        if (!line || line->stretch.length() < least / 3) continue;
        const std::int64_t tolerance =
            std::max(pixel / 2, multiply_divide(3 * line->rms.raw(), pixel, FinePixel::one));
        const detail::PointRange range = detail::range_along(outline, line->stretch, piece, tolerance);
        const Stretch whole{outline.points[range.first % count], outline.points[range.last % count]};
        const std::int64_t length = whole.length();
        if (length < least || std::any_of(ranges.begin(), ranges.end(), [&](detail::PointRange other) {
                return detail::same_edge(range, other, count);
            }))
            continue;
        // Points lie closer than a pixel, and evenly enough.
        const auto points = static_cast<std::int64_t>(range.last - range.first);
        const auto cut =
            static_cast<std::size_t>(multiply_divide(points, std::max(length / 12, 6 * pixel), length));
        const std::optional<detail::FittedEdge> edge =
            detail::fitted_edge(outline, {range.first + cut, range.last - cut}, scale);
        if (!edge || !edge->straight()) continue;
        ranges.push_back(range);
        edges.push_back(edge->stretch);
    }
    return edges;
}

/// How far an outline reaches in a direction, from its first point to its last.
inline std::int64_t breadth_of(const Outline& outline, FineAngle direction) {
    const UnitVector way = unit_vector(direction);
    std::int64_t least = 0;
    std::int64_t most = 0;
    for (const PartPoint& point : outline.points) {
        const std::int64_t at = detail::along(point, way);
        least = &point == &outline.points.front() ? at : std::min(least, at);
        most = &point == &outline.points.front() ? at : std::max(most, at);
    }
    return most - least;
}

/// A probe across two edges that face away from each other, some pixels longer than they are apart, in the
/// middle of where they face; and how long that is.
struct Facing {
    PartPoint from;
    PartPoint to;
    std::int64_t breadth = 0;
};

/// Square to the first edge. Nothing if the edges are not parallel to a degree, or hardly face.
inline std::optional<Facing> facing_edges(const Stretch& one, const Stretch& two, std::int64_t pixel) {
    const std::int32_t off = (two.direction() - one.direction() - FineAngle::half_turn()).signed_raw();
    if (magnitude(off) > 0x00b60b61u) return {};  // one degree
    const UnitVector way = unit_vector(one.direction());
    const UnitVector across = unit_vector(one.direction() + FineAngle::quarter_turn());
    const std::int64_t first = std::max<std::int64_t>(0, detail::along(two.to - one.from, way));
    const std::int64_t last =
        std::min(detail::along(one.to - one.from, way), detail::along(two.from - one.from, way));
    // The part lies to the right of its outline, clockwise on screen.
    const std::int64_t far_side = detail::along(point_between(two.from, two.to, 1, 2) - one.from, across);
    if (last - first < 12 * pixel || far_side < 4 * pixel) return {};
    const PartPoint middle = one.from + detail::stretched_by(way, (first + last) / 2);
    const std::int64_t margin = 6 * pixel;
    return Facing{middle - detail::stretched_by(across, margin),
                  middle + detail::stretched_by(across, far_side + margin), last - first};
}

/// True if moments are those of a disc, nearly: one of area A has second moments of A^2 / 2 pi together, any
/// other shape has more.
inline bool is_disc(const CentralMoments& moments) {
    const std::int64_t sum = (moments.mu20 + moments.mu02).raw() / SecondMoment::one;
    return Int128::product(sum, 710) < Int128::product(moments.area * 119 / 100, moments.area * 113);
}

}  // namespace fovea::apps
