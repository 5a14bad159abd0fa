// SPDX-License-Identifier: MIT
//
// Golden vectors of segment/ beside connected components and level contours: contours, polygons, growing,
// labels.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/segment/approximate_polygon.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/contour.hpp>
#include <fovea/segment/convex_hull.hpp>
#include <fovea/segment/find_contours.hpp>
#include <fovea/segment/grow_region.hpp>
#include <fovea/segment/label_image.hpp>
#include <fovea/segment/minimum_rectangle.hpp>
#include <fovea/segment/polygon.hpp>
#include <fovea/segment/region.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const FirstMoments& m) { digest.add(m.m00, m.m10, m.m01, m.area()); }
inline void put(Digest& digest, const RegionOf<FirstMoments>& r) {
    digest.add(r.moments, r.moments.centroid(), r.box, r.first, r.at_border, r.holes, r.hole_area, r.number);
}
inline void put(Digest& digest, const Contour& c) {
    digest.add(c.first, c.count, c.region, c.hole, c.parent);
}
inline void put(Digest& digest, const RotatedRectangle& r) {
    digest.add(r.centre, r.length, r.width, r.axis);
}

/// Elements of a list in the scratch memory.
template <class T>
struct ScratchList {
    ScratchList(Arena& arena, int capacity) : elements(arena.take<T>(capacity)) {}
    ListView<T> list() { return {elements.data(), static_cast<int>(elements.size()), &count}; }
    Span<T> elements;
    int count = 0;
};

/// Clumps of any size, and the part.
template <class Visit>
void for_each_binary(Workspace& work, Visit visit) {
    Random random(31);
    for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{5, 4}, Size{33, 21}, Size{60, 40}}) {
        const ImageView<Gray8> image = work.view<Gray8>(0, size);
        fill_clumps(image, random);
        visit(image);
    }
    const ImageView<Gray8> part = part_picture(work, 0);
    for (int y = 0; y < part.height(); ++y)
        for (int x = 0; x < part.width(); ++x) part(x, y) = part(x, y) < 128 ? 255 : 0;
    visit(part);
}

inline void segment_contours(Workspace& work, Digest& digest) {
    for (int code = 0; code < 8; ++code)
        digest.add(chain_step(static_cast<ChainCode>(code)),
                   chain_code({3, 3}, {2 + code % 3, 2 + code / 3}));
    for_each_binary(work, [&](ImageView<const Gray8> image) {
        for (const Connectivity connectivity : {Connectivity::eight, Connectivity::four})
            for (const ContourPoints wanted : {ContourPoints::all, ContourPoints::corners}) {
                Arena arena(work.scratch_span());
                ScratchList<Point> points(arena, 1200);
                ScratchList<Contour> contours(arena, 150);
                ScratchList<RegionOf<FirstMoments>> regions(arena, 60);
                ScratchList<HoleOf<FirstMoments>> holes(arena, 60);
                ComponentOptions options;
                options.connectivity = connectivity;
                digest.add(connected_components<FirstMoments>(
                    image, options,
                    arena.rest().first(connected_components_scratch<FirstMoments>(image.width())),
                    regions.list(), holes.list()));
                ConnectedComponentsOf<FirstMoments> rows(image.width(), options, arena.rest(), regions.list(),
                                                         holes.list());
                for (int y = 0; y < image.height(); ++y) digest.add(rows.add_row(image.row(y)));
                digest.add(rows.finish());
                for (const auto& region : regions.list()) digest.add(region);
                for (const auto& hole : holes.list())
                    digest.add(hole.moments, hole.box, hole.first, hole.region);
                digest.add(trace_contours<FirstMoments>(image, connectivity, wanted, regions.list().span(),
                                                        holes.list().span(), points.list(), contours.list()));
                digest.add(points.list(), contours.list());
                digest.add(find_contours(image, connectivity, wanted,
                                         arena.rest().first(find_contours_scratch(image.size())),
                                         points.list(), contours.list()));
                digest.add(points.list(), contours.list());
                const auto visit = [&](Point p) { digest.add(p); };
                for (int x = 0; x < image.width(); x += 3) {
                    digest.add(trace_region_border(image, connectivity, {x, image.height() / 2}, visit));
                    digest.add(trace_hole_border(image, connectivity, {x, image.height() / 2}, visit));
                }
            }
    });
}

inline void segment_polygons(Workspace& work, Digest& digest) {
    Random random(32);
    for (int round = 0; round < 200; ++round) {
        Arena arena(work.scratch_span());
        const int count = random.between(1, 60);
        const int reach = 1 << random.between(1, 13);
        ScratchList<Point> points(arena, count);
        ScratchList<Point> hull(arena, count);
        ScratchList<Point> corners(arena, count);
        for (int i = 0; i < count; ++i)
            static_cast<void>(
                points.list().push({random.between(-reach, reach), random.between(-reach, reach)}));
        const Span<const Point> all = points.list().span();
        digest.add(polygon_length(all, Closure::closed), polygon_length(all, Closure::open));
        digest.add(doubled_area(all), convexity(all), place_in_polygon(all, {0, 0}),
                   place_in_polygon(all, all[0]));
        digest.add(convex_hull(all, arena.rest().first(convex_hull_scratch(count)), hull.list()),
                   hull.list());
        digest.add(convexity(hull.list().span()), minimum_area_rectangle(hull.list().span()));
        for (const int tolerance : {0, 100, reach * 64})
            digest.add(
                approximate_polygon(all, round % 2 == 0 ? Closure::closed : Closure::open,
                                    SubPixel::from_raw(tolerance),
                                    arena.rest().first(approximate_polygon_scratch(count)), corners.list()),
                corners.list());
    }
}

inline void segment_growing(Workspace& work, Digest& digest) {
    for_each_binary(work, [&](ImageView<Gray8> image) {
        const ImageView<Gray8> mask = work.view<Gray8>(1, image.size());
        for (const Connectivity connectivity : {Connectivity::eight, Connectivity::four})
            for (const int runs : {1, 64})
                for (int x = 0; x < image.width(); x += 17) {
                    const Span<std::uint8_t> stack = work.scratch_span().first(grow_region_scratch(runs));
                    digest.add(grow_region(image, {x, image.height() / 2}, 1, 255, connectivity, stack, mask),
                               mask);
                }
        const Span<std::uint8_t> room = work.scratch_span().first(flood_fill_scratch(image.size(), 4));
        digest.add(flood_fill(image, {image.width() / 2, image.height() / 2}, 77, Connectivity::four, room),
                   image);
    });
    RegionFilter filter;
    for (int width = 0; width < 12; ++width)
        for (int area = 0; area < 40; area += 3) digest.add(filter_region(area, {0, 0, width, 5}, filter));
    filter.aspect_max = Ratio();
    digest.add(filter_region(9, {0, 0, 3, 3}, filter));
}

inline void segment_label_image(Workspace& work, Digest& digest) {
    for_each_binary(work, [&](ImageView<const Gray8> image) {
        if (image.size().area() * 2 > Workspace::image_bytes) return;
        const ImageView<Label16> labels = work.view<Label16>(1, image.size());
        for (const Connectivity connectivity : {Connectivity::eight, Connectivity::four})
            digest.add(label_image(image, connectivity,
                                   work.scratch_span().first(label_image_scratch(image.size())), labels),
                       labels);
    });
}

}  // namespace fovea::golden
