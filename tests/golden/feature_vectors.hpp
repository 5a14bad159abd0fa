// SPDX-License-Identifier: MIT
//
// Golden vectors of feature/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include <fovea/base/arena.hpp>
#include <fovea/feature/canny.hpp>
#include <fovea/feature/canny_points.hpp>
#include <fovea/feature/find_circles.hpp>
#include <fovea/feature/harris_points.hpp>
#include <fovea/feature/hough_circles.hpp>
#include <fovea/feature/hough_lines.hpp>
#include <fovea/feature/line_segments.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const EdgePoint& p) { digest.add(p.place, p.gradient, p.strength, p.pixel); }
inline void put(Digest& digest, const PolarLine& line) { digest.add(line.theta, line.distance, line.votes); }
inline void put(Digest& digest, const HoughCircle& c) { digest.add(c.centre, c.radius, c.votes, c.share); }
inline void put(Digest& digest, const HarrisPoint& p) { digest.add(p.place, p.response); }
inline void put(Digest& digest, const LineSegment& s) { digest.add(s.from, s.to, s.pixels, s.line); }

/// A list in the scratch of the workspace.
template <class T>
struct ArenaList {
    Span<T> room;
    int count = 0;

    ArenaList(Arena& arena, int capacity) : room(arena.take<T>(capacity)) {}
    ListView<T> view() { return {room.data(), static_cast<int>(room.size()), &count}; }
};

/// The edges of the part in image 1.
inline ImageView<Gray8> part_edges(Workspace& work, ImageView<const Gray8> src) {
    const ImageView<Gray8> edges = work.view<Gray8>(1, src.size());
    static_cast<void>(canny(src, 60, 150, Border::replicate, work.scratch_span(), edges));
    return edges;
}

inline void feature_canny_points(Workspace& work, Digest& digest) {
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8>) {
        const ImageView<Gray8> edges = part_edges(work, src);
        for (const int capacity : {20, 600}) {
            Arena arena(work.scratch_span());
            ArenaList<EdgePoint> points(arena, capacity);
            digest.add(canny_points(src, edges, Border::replicate, points.view()), points.view());
        }
    });
}

inline void feature_harris_points(Workspace& work, Digest& digest) {
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8>) {
        for (const int capacity : {5, 200})
            for (const int distance : {0, 3, 11}) {
                HarrisPointOptions options;
                options.quality = Ratio::from_raw(capacity * 40);
                options.min_distance = distance;
                options.candidates = 300;
                Arena arena(work.scratch_span());
                ArenaList<HarrisPoint> points(arena, capacity);
                digest.add(harris_points_scratch(src.size(), options) > 0);
                const Status status =
                    harris_points(src, options, Border::reflect_101, arena.rest(), points.view());
                digest.add(status, points.view());
            }
    });
}

inline void feature_hough_lines(Workspace& work, Digest& digest) {
    HoughLineOptions options;
    options.angles = 90;
    options.min_votes = 25;
    options.suppressed_angles = 4;
    const ImageView<Gray8> src = part_picture(work, 0);
    const ImageView<Gray8> edges = part_edges(work, src);
    Arena arena(work.scratch_span());
    ArenaList<PolarLine> lines(arena, 6);
    ArenaList<EdgePoint> points(arena, 600);
    ArenaList<LineSegment> segments(arena, 12);
    const std::int64_t scratch = hough_lines_scratch(src.size(), options);
    digest.add(scratch > 0, scratch <= arena.rest().size());
    digest.add(hough_lines(edges, options, arena.rest(), lines.view()), lines.view());
    digest.add(line_segments(edges, lines.view().span(), {10, 2, 1}, segments.view()), segments.view());
    digest.add(canny_points(src, edges, Border::replicate, points.view()));
    digest.add(hough_lines_directed(points.view().span(), src.size(), options, arena.rest(), lines.view()),
               lines.view());
    for (const Size size : {Size{0, 3}, Size{32767, 32767}, Size{111, 75}})
        digest.add(hough_lines_directed(points.view().span(), size, options, arena.rest(), lines.view()),
                   lines.view());
}

inline void feature_find_circles(Workspace& work, Digest& digest) {
    const ImageView<Gray8> src = part_picture(work, 0);
    List<HoughCircle, 3> circles;
    FindCirclesOptions options;
    options.circles.min_radius = 3;
    options.circles.max_radius = 30;
    options.circles.min_votes = 12;
    options.max_points = 500;
    for (const EdgeSmoothing smoothing :
         {EdgeSmoothing::none, EdgeSmoothing::gaussian_3x3, EdgeSmoothing::gaussian_5x5}) {
        options.smoothing = smoothing;
        // Its bytes differ by the width of a vector.
        const std::int64_t scratch = find_circles_scratch(src.size(), options);
        digest.add(scratch > 0, scratch <= work.scratch_span().size());
        digest.add(find_circles(src, options, work.scratch_span(), circles.view()), circles.view());
        options.max_points = 120;
    }
    options.low = 200;
    digest.add(find_circles(src, options, work.scratch_span(), circles.view()));
}

inline void feature_hough_circles(Workspace& work, Digest& digest) {
    const ImageView<Gray8> src = part_picture(work, 0);
    const ImageView<Gray8> edges = part_edges(work, src);
    Arena arena(work.scratch_span());
    ArenaList<EdgePoint> points(arena, 600);
    ArenaList<HoughCircle> circles(arena, 8);
    digest.add(canny_points(src, edges, Border::replicate, points.view()));
    HoughCircleOptions options;
    options.min_radius = 3;
    options.max_radius = 30;
    options.min_votes = 12;
    options.cell = 1;
    for (const CircleTone tone : {CircleTone::any, CircleTone::bright, CircleTone::dark}) {
        options.tone = tone;
        const std::int64_t scratch = hough_circles_scratch(src.size(), points.count, options);
        digest.add(scratch > 0, scratch <= arena.rest().size());
        digest.add(hough_circles(points.view().span(), src.size(), options, arena.rest(), circles.view()),
                   circles.view());
        options.cell = 3;
    }
}

}  // namespace fovea::golden
