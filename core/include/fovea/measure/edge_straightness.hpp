// SPDX-License-Identifier: MIT
//
// Straightness of an edge: whether the parallel lines of a probe all meet the same straight edge.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/measure/edge_probe.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How far an edge that edge_probe() found strays from straight over the lines of the probe.
///
/// The lines are taken in groups of neighbours: three to sixteen groups, of four or five lines where there
/// are 12 to 67, of fewer and more below and above. In each the edge is sought anew, of the same sense, near
/// its place: of those at least half as strong as the strongest the nearest one. The result is the largest
/// distance along the probe of these edges from the straight line fitted to them, which may run aslant; a
/// group without an edge counts as straightness_reach() away.
///
/// Shapes    as edge_probe(); 0 for a probe of less than three lines
/// Units     pixels, 0 or more. A step of s pixels between two groups gives 0.3 s or more; one within the
///           middle of three groups may look like an edge that runs aslant. A round edge of the radius R
///           gives lines^2 / (27 R) with three groups and towards lines^2 / (12 R) with more
/// Rounding  to 1/65536 px
/// Border    as edge_probe()
/// Scratch   as edge_probe(), and room for a few edges; both undefined afterwards
/// Errors    as edge_probe(); a full list of edges is none
/// Source    the quantity is the straightness of ISO 1101 with the least-squares line of ISO 12780-1 as its
///           reference, one side of it
inline Result<FinePixel> edge_straightness(ImageView<const Gray8> src, const EdgeProbe& probe,
                                           const Edge& edge, Span<std::uint16_t> scratch,
                                           ListView<Edge> edges);

/// How far before and behind its place an edge is sought.
constexpr FinePixel straightness_reach(int smoothing) { return FinePixel::from_int(8 + 2 * smoothing); }

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int max_line_groups = 16;

/// The number of groups that lines are taken in.
constexpr int line_groups(int lines) { return clamp(lines / 4, minimum(lines, 3), max_line_groups); }

/// Place of the edge in the group of lines first..last, along the probe from `edge`; the reach if there is
/// none.
inline Result<std::int64_t> edge_in_group(ImageView<const Gray8> src, const EdgeProbe& probe,
                                          const Edge& edge, int first, int last, Span<std::uint16_t> scratch,
                                          ListView<Edge> edges) {
    const std::int64_t reach = straightness_reach(probe.smoothing).raw();
    const std::int64_t length = hypotenuse(std::int64_t{probe.to.x.raw()} - probe.from.x.raw(),
                                           std::int64_t{probe.to.y.raw()} - probe.from.y.raw());
    // Within the probe, so that no line leaves the image.
    const std::int64_t at = multiply_divide(length, edge.share.raw(), Unit::one);
    const std::int64_t start = maximum<std::int64_t>(at - reach, 0);
    const std::int64_t end = minimum(at + reach, length);
    EdgeProbe group = probe;
    group.lines = last - first + 1;
    // The middle of the group lies so many half lines beside that of the probe. Rounded towards it like the
    // lines themselves, none lies farther out than those of the probe.
    const int halves = first + last - (probe.lines - 1);
    const auto place = [&](std::int64_t along) {
        const auto coordinate = [&](FinePixel from, FinePixel to, FinePixel across) {
            const std::int64_t way = std::int64_t{to.raw()} - from.raw();
            return FinePixel::from_raw(saturate_cast<std::int32_t>(
                from.raw() + multiply_divide(way, along, length) + std::int64_t{across.raw()} * halves / 2));
        };
        return FinePoint{coordinate(probe.from.x, probe.to.x, probe.across.x),
                         coordinate(probe.from.y, probe.to.y, probe.across.y)};
    };
    group.from = place(start);
    group.to = place(end);
    const std::int64_t least = maximum<std::int64_t>(magnitude(edge.strength.raw()) / 2, 1);
    const Status status =
        edge_probe(src, group, GrayLevel::from_raw(static_cast<std::int32_t>(least)), scratch, edges);
    if (status != Status::ok && status != Status::capacity_exceeded) return status;
    const auto same_sense = [&](const Edge& other) {
        return (other.strength.raw() < 0) == (edge.strength.raw() < 0);
    };
    std::int64_t strongest = 0;
    for (const Edge& other : edges)
        if (same_sense(other))
            strongest = maximum(strongest, static_cast<std::int64_t>(magnitude(other.strength.raw())));
    std::int64_t nearest = reach;
    for (const Edge& other : edges) {
        if (!same_sense(other) || 2 * static_cast<std::int64_t>(magnitude(other.strength.raw())) < strongest)
            continue;
        const std::int64_t off = start + multiply_divide(end - start, other.share.raw(), Unit::one) - at;
        if (magnitude(off) < magnitude(nearest)) nearest = off;
    }
    return nearest;
}

}  // namespace detail

inline Result<FinePixel> edge_straightness(ImageView<const Gray8> src, const EdgeProbe& probe,
                                           const Edge& edge, Span<std::uint16_t> scratch,
                                           ListView<Edge> edges) {
    if (Status s = detail::check_edge_probe(src, probe, GrayLevel::from_raw(1), scratch); s != Status::ok)
        return s;
    if (probe.lines < 3) return FinePixel();
    const int groups = detail::line_groups(probe.lines);
    std::int64_t beside[detail::max_line_groups] = {};  // half lines from the middle of the probe
    std::int64_t along[detail::max_line_groups] = {};   // 2^-16 px
    std::int64_t sum = 0, squares = 0, products = 0, beside_sum = 0;
    for (int i = 0; i < groups; ++i) {
        const int first = probe.lines * i / groups;
        const int last = probe.lines * (i + 1) / groups - 1;
        const Result<std::int64_t> place =
            detail::edge_in_group(src, probe, edge, first, last, scratch, edges);
        if (!place) return place.status();
        beside[i] = first + last - (probe.lines - 1);
        along[i] = *place;
        beside_sum += beside[i];
        sum += along[i];
    }
    // About the means, times the number of groups.
    for (int i = 0; i < groups; ++i) {
        const std::int64_t from_mean = groups * beside[i] - beside_sum;
        squares += from_mean * from_mean;
        products += from_mean * along[i];
    }
    std::int64_t most = 0;
    for (int i = 0; i < groups; ++i) {
        const std::int64_t line =
            round_divide(sum, groups) + multiply_divide(products, groups * beside[i] - beside_sum, squares);
        most = maximum(most, static_cast<std::int64_t>(magnitude(along[i] - line)));
    }
    return FinePixel::from_raw(saturate_cast<std::int32_t>(most));
}

}  // namespace fovea
