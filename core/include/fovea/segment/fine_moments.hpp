// SPDX-License-Identifier: MIT
//
// Moments and symmetry of regions and holes to a fraction of a pixel: from the contour on which brightness
// crosses the threshold, instead of from whole pixels.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/level_contour.hpp>
#include <fovea/statistics/moments.hpp>
#include <fovea/statistics/polygon_moments.hpp>
#include <fovea/statistics/polygon_symmetry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The moments inside the contour of a region, without its listed holes. Specks that are too small for the
/// list count as filled.
///
/// Shapes    src is the image whose threshold by `set` gave the region and the holes, with
///           Connectivity::eight
/// Rounding  as PolygonMoments; of a region with a side above max_polygon_reach, the moments of its pixels
/// Errors    empty_image if nothing is enclosed; out_of_range or bad_argument if region and image do not
///           belong together
/// Source    trace_level_contour() and PolygonMoments
inline Result<CentralMoments> fine_moments(ImageView<const Gray8> src, LevelSet set, const Region& region,
                                           Span<const Hole> holes);

/// The same of a hole.
inline Result<CentralMoments> fine_moments(ImageView<const Gray8> src, LevelSet set, const Hole& hole);

/// The rotational symmetry of what the contour of a region encloses without its listed holes; pass none for
/// that of its outline.
///
/// Shapes    as fine_moments(); origin is the centroid of that, aspect the height of a pixel in widths of one
/// Rounding  as PolygonSymmetry
/// Errors    as fine_moments(); degenerate if nothing repeats itself
/// Source    trace_level_contour() and PolygonSymmetry
inline Result<RotationalAxis> fine_symmetry(ImageView<const Gray8> src, LevelSet set, const Region& region,
                                            Span<const Hole> holes, FinePoint origin, int order,
                                            PixelAspect aspect);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Adds a contour to the sums of polygons: the points of the walk, joined.
template <class Sums>
Status add_contour(ImageView<const Gray8> src, LevelSet set, Connectivity connectivity, Point start, int sign,
                   Sums& sums) {
    FinePoint first;
    FinePoint last;
    bool any = false;
    const Status status = trace_level_contour(src, set, connectivity, start, [&](FinePoint point) {
        if (any)
            sums.add_edge(last, point, sign);
        else
            first = point;
        any = true;
        last = point;
    });
    if (any) sums.add_edge(last, first, sign);
    return status;
}

/// Adds the contour of a region and, the other way round, those of its holes.
template <class Sums>
Status add_contours(ImageView<const Gray8> src, LevelSet set, const Region& region, Span<const Hole> holes,
                    Sums& sums) {
    if (Status s = add_contour(src, set, Connectivity::eight, region.first, 1, sums); s != Status::ok)
        return s;
    for (const Hole& hole : holes) {
        if (hole.region != region.number) continue;
        if (Status s = add_contour(src, set.complement(), Connectivity::four, hole.first, -1, sums);
            s != Status::ok)
            return s;
    }
    return Status::ok;
}

constexpr Point middle_of(Rectangle box) { return {box.x + box.width / 2, box.y + box.height / 2}; }
constexpr bool within_reach(Rectangle box) {
    return box.width <= max_polygon_reach && box.height <= max_polygon_reach;
}

}  // namespace detail

inline Result<CentralMoments> fine_moments(ImageView<const Gray8> src, LevelSet set, const Region& region,
                                           Span<const Hole> holes) {
    if (!detail::within_reach(region.box)) return central_moments(region.moments);
    PolygonMoments moments(detail::middle_of(region.box));
    if (Status s = detail::add_contours(src, set, region, holes, moments); s != Status::ok) return s;
    return moments.central();
}

inline Result<CentralMoments> fine_moments(ImageView<const Gray8> src, LevelSet set, const Hole& hole) {
    if (!detail::within_reach(hole.box)) return central_moments(hole.moments);
    PolygonMoments moments(detail::middle_of(hole.box));
    if (Status s = detail::add_contour(src, set.complement(), Connectivity::four, hole.first, 1, moments);
        s != Status::ok)
        return s;
    return moments.central();
}

inline Result<RotationalAxis> fine_symmetry(ImageView<const Gray8> src, LevelSet set, const Region& region,
                                            Span<const Hole> holes, FinePoint origin, int order,
                                            PixelAspect aspect) {
    PolygonSymmetry symmetry(origin, order, aspect);
    if (Status s = detail::add_contours(src, set, region, holes, symmetry); s != Status::ok) return s;
    return symmetry.axis();
}

}  // namespace fovea
