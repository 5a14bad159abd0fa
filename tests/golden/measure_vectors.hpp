// SPDX-License-Identifier: MIT
//
// Golden vectors of segment/ and measure/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include <fovea/measure/consensus.hpp>
#include <fovea/measure/edge_probe.hpp>
#include <fovea/measure/edge_straightness.hpp>
#include <fovea/measure/fit_circle.hpp>
#include <fovea/measure/fit_line.hpp>
#include <fovea/measure/half_turn.hpp>
#include <fovea/measure/run_gauge.hpp>
#include <fovea/number/trigonometry.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/fine_moments.hpp>
#include <fovea/segment/level_contour.hpp>
#include <fovea/segment/runs.hpp>
#include <golden/digest.hpp>
#include <golden/image_vectors.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const Region& r) {
    digest.add(r.moments, r.box, r.first, r.at_border, r.holes, r.hole_area, r.number);
}
inline void put(Digest& digest, const Hole& h) { digest.add(h.moments, h.box, h.first, h.region); }
inline void put(Digest& digest, const Edge& e) { digest.add(e.place, e.share, e.strength, e.blur); }
inline void put(Digest& digest, const Line& line) { digest.add(line.point, line.direction); }
inline void put(Digest& digest, const LineFit& fit) { digest.add(fit.line, fit.rms, fit.used); }
inline void put(Digest& digest, const Circle& circle) { digest.add(circle.centre, circle.radius); }
inline void put(Digest& digest, const CircleFit& fit) { digest.add(fit.circle, fit.rms, fit.used); }
inline void put(Digest& digest, const Asymmetry& a) { digest.add(a.sss, a.sst, a.stt, a.ttt); }
inline void put(Digest& digest, const HalfTurn& turn) { digest.add(turn.turned, turn.margin); }
inline void put(Digest& digest, const RunWidths& widths) {
    digest.add(widths.rows, widths.first_row, widths.last_row, widths.narrowest, widths.widest, widths.mean);
}
template <class Model>
void put(Digest& digest, const Consensus<Model>& consensus) {
    digest.add(consensus.model, consensus.limit);
}

// ---- segment ------------------------------------------------------------------------------

inline void segment_runs(Workspace& work, Digest& digest) {
    Arena arena(work.scratch_span());
    RunRow row(arena.take_unset<Run>(212));
    RunRow narrow(arena.take<Run>(10));
    const auto add_runs = [&](RunRow& runs, const Gray8* pixels, int width) {
        digest.add(runs.split(pixels, width));
        digest.add(runs.count(), runs.first_of(true), runs.first_of(false));
        for (int i = 0; i < runs.count(); ++i) {
            runs[i].label = static_cast<RunLabel>(i % 3 == 0 ? no_label : i);
            digest.add(runs[i].first, runs[i].label, runs.end(i), runs.is_region(i));
        }
    };
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8> dst) {
        static_cast<void>(threshold(src, 200, dst));
        for (int y = 0; y < dst.height(); ++y) {
            add_runs(row, dst.row(y), dst.width());
            digest.add(narrow.split(dst.row(y), dst.width()));
        }
    });
}

/// Both lists after a run of connected_components().
inline void add_components(Workspace& work, ImageView<const Gray8> binary, const ComponentOptions& options,
                           int labels, Digest& digest) {
    const auto bytes = connected_components_scratch(binary.width(), labels);
    digest.add(connected_components(binary, options, work.scratch_span().first(static_cast<int>(bytes)),
                                    work.regions, work.holes));
    digest.add(work.regions.view(), work.holes.view());
}

inline void segment_connected_components(Workspace& work, Digest& digest) {
    Random random(16);
    for (const Size size : {Size{1, 1}, Size{9, 1}, Size{1, 9}, Size{23, 17}, Size{70, 40}, Size{125, 20}}) {
        const ImageView<Gray8> binary = work.view<Gray8>(0, size);
        for (int i = 0; i < 4; ++i) {
            fill_clumps(binary, random);
            ComponentOptions options;
            options.connectivity = i % 2 == 0 ? Connectivity::eight : Connectivity::four;
            options.at_border = i == 1 ? BorderRegions::drop : BorderRegions::keep;
            options.area_min = i == 2 ? 5 : 1;
            options.hole_area_min = i == 3 ? 3 : 1;
            add_components(work, binary, options, 2 * size.width + 2, digest);
        }
        add_components(work, binary, {}, 2, digest);
    }
    for_each_picture(work, [&](ImageView<const Gray8> src, ImageView<Gray8> dst) {
        static_cast<void>(threshold_inverse(src, 128, dst));
        add_components(work, dst, {}, src.width() + 2, digest);
    });
    ComponentOptions crossed;
    crossed.area_max = -1;
    add_components(work, part_picture(work, 0), crossed, 4, digest);

    // Row by row, as a camera delivers them.
    ConnectedComponents components(112, {}, work.scratch_span(), work.regions, work.holes);
    const ImageView<Gray8> part = part_picture(work, 0);
    static_cast<void>(threshold(part, 128, part));
    for (int y = 0; y < part.height(); ++y) digest.add(components.add_row(part.row(y)));
    digest.add(components.finish(), work.regions.view(), work.holes.view());
}

/// The regions of the picture of the part, and the set that made them.
inline LevelSet find_plate(Workspace& work, ImageView<const Gray8> part) {
    const ImageView<Gray8> binary = work.view<Gray8>(1, part.size());
    const LevelSet set{125, true};
    static_cast<void>(threshold_inverse(part, set.level, binary));
    ComponentOptions options;
    options.area_min = 20;
    options.hole_area_min = 20;
    static_cast<void>(connected_components(binary, options, work.scratch_span(), work.regions, work.holes));
    return set;
}

inline void segment_level_contour(Workspace& work, Digest& digest) {
    const auto add_point = [&](FinePoint point) { digest.add(point); };
    const ImageView<const Gray8> part = part_picture(work, 0);
    const LevelSet set = find_plate(work, part);
    for (const Connectivity connectivity : {Connectivity::four, Connectivity::eight}) {
        for (const Region& region : work.regions)
            digest.add(trace_level_contour(part, set, connectivity, region.first, add_point));
        for (const Hole& hole : work.holes)
            digest.add(trace_level_contour(part, set.complement(), connectivity, hole.first, add_point));
        for (const Point start : {Point{-1, 0}, Point{0, 0}, Point{56, 38}})
            digest.add(trace_level_contour(part, set, connectivity, start, add_point));
    }
    Random random(17);
    const ImageView<Gray8> noise = work.view<Gray8>(0, {33, 21});
    for (int i = 0; i < 3; ++i) {
        fill(noise, Filling::random, random);
        const LevelSet bright{static_cast<Gray8>(90 + 40 * i), false};
        for (int y = 1; y < 21; y += 2)
            for (int x = 0; x < 33; x += 3)
                digest.add(bright.contains(noise(x, y)),
                           trace_level_contour(noise, bright, Connectivity::eight, {x, y}, add_point));
    }
}

inline void segment_fine_moments(Workspace& work, Digest& digest) {
    const ImageView<const Gray8> part = part_picture(work, 0);
    const LevelSet set = find_plate(work, part);
    for (const Region& region : work.regions) {
        const Result<CentralMoments> moments = fine_moments(part, set, region, work.holes.span());
        digest.add(moments, fine_moments(part, set, region, {}));
        if (moments) digest.add(orientation(*moments));
        for (int order = min_symmetry_order; moments && order <= max_symmetry_order; ++order)
            digest.add(fine_symmetry(part, set, region, work.holes.span(), moments->centroid, order,
                                     PixelAspect::from_ratio(order, 6)));
        Region wrong = region;
        wrong.first = {-1, 3};
        digest.add(fine_moments(part, set, wrong, {}));
    }
    for (const Hole& hole : work.holes) digest.add(fine_moments(part, set, hole));
}

// ---- measure ------------------------------------------------------------------------------

inline void measure_edge_probe(Workspace& work, Digest& digest) {
    Arena arena(work.scratch_span());
    const Span<std::uint16_t> profile =
        arena.take<std::uint16_t>(edge_probe_scratch(Workspace::picture_size));
    List<Edge, 12> edges;
    const auto probe = [&](ImageView<const Gray8> image, const EdgeProbe& line, GrayLevel least) {
        digest.add(edge_probe(image, line, least, profile, edges), edges.view());
    };
    const auto place = [](Random& random, Size size) {
        return FinePoint{FinePixel::from_raw(random.between(0, (size.width - 1) * 65536)),
                         FinePixel::from_raw(random.between(0, (size.height - 1) * 65536))};
    };
    const ImageView<Gray8> part = part_picture(work, 0);
    Random random(18);
    for (int i = 0; i < 60; ++i) {
        EdgeProbe line{place(random, part.size()), place(random, part.size()), {}, 1};
        if (i % 3 == 0) line.lines = random.between(2, 9);
        line.smoothing = i % 5 == 4 ? 3 : 1;
        line.across = {FinePixel::from_raw(random.between(-65536, 65536)),
                       FinePixel::from_raw(random.between(-65536, 65536))};
        probe(part, line, GrayLevel::from_int(i % 2 == 0 ? 30 : 3));
    }
    for_each_picture(work, [&](ImageView<const Gray8> image, ImageView<Gray8>) {
        probe(image, {place(random, image.size()), place(random, image.size()), {}, 1},
              GrayLevel::from_int(5));
    });
    const FinePoint here = FinePoint{FinePixel::from_int(3), FinePixel::from_int(3)};
    const FinePoint there = FinePoint{FinePixel::from_int(60), FinePixel::from_int(40)};
    probe(part, {here, here, {}, 1}, GrayLevel::from_int(5));
    probe(part, {here, there, {}, 0}, GrayLevel::from_int(5));
    probe(part, {here, there, {}, 1}, GrayLevel());
    digest.add(edge_probe_scratch({640, 480}));
}

inline void measure_edge_straightness(Workspace& work, Digest& digest) {
    Arena arena(work.scratch_span());
    const Span<std::uint16_t> profile =
        arena.take<std::uint16_t>(edge_probe_scratch(Workspace::picture_size));
    List<Edge, 12> edges;
    const ImageView<Gray8> part = part_picture(work, 0);
    Random random(19);
    const auto place = [&] {
        return FinePoint{FinePixel::from_raw(random.between(0, (part.width() - 1) * 65536)),
                         FinePixel::from_raw(random.between(0, (part.height() - 1) * 65536))};
    };
    for (int i = 0; i < 60; ++i) {
        EdgeProbe line{place(), place(), {}, random.between(1, 24)};
        line.smoothing = i % 5 == 4 ? 3 : 1;
        line.across = {FinePixel::from_raw(random.between(-20000, 20000)),
                       FinePixel::from_raw(random.between(-20000, 20000))};
        if (edge_probe(part, line, GrayLevel::from_int(10), profile, edges) != Status::ok) continue;
        const List<Edge, 12> found = edges;
        for (const Edge& edge : found) digest.add(edge_straightness(part, line, edge, profile, edges));
    }
    digest.add(edge_straightness(part, {place(), place(), {}, 0}, Edge(), profile, edges));
    digest.add(straightness_reach(2));
}

/// Points near a line or a circle, some of them far off.
template <class Place>
Span<const FinePoint> scattered_points(Random& random, Span<FinePoint> points, int outliers, Place place) {
    for (FinePoint& point : points) {
        point = place();
        const int off = static_cast<int>(random.below(100)) < outliers ? 2000000 : 20000;
        point.x += FinePixel::from_raw(random.between(-off, off));
        point.y += FinePixel::from_raw(random.between(-off, off));
    }
    return {points.data(), points.size()};
}

inline void measure_fit_line(Workspace& work, Digest& digest) {
    Arena arena(work.scratch_span());
    const Span<FinePoint> room = arena.take<FinePoint>(120);
    const Span<FinePixel> distances = arena.take<FinePixel>(120);
    Random random(19);
    for (int i = 0; i < 40; ++i) {
        const UnitVector way = unit_vector(FineAngle::from_raw(random.next()));
        const Span<const FinePoint> points =
            scattered_points(random, room.first(random.between(1, 120)), i % 4 * 15, [&] {
                const std::int64_t along = random.between(-300, 300) * 65536;
                return FinePoint{FinePixel::from_raw(static_cast<std::int32_t>(along * way.x.raw() >> 30)),
                                 FinePixel::from_raw(static_cast<std::int32_t>(along * way.y.raw() >> 30))};
            });
        const Result<LineFit> fit = fit_line(points);
        digest.add(fit, fit_line_robust(points, distances), fit_line_robust(points, distances.first(20)));
        if (fit) digest.add(distance_from(fit->line, points[0]));
    }
    for (FinePoint& point : room) point = {FinePixel::from_int(5), FinePixel::from_int(-3)};
    digest.add(fit_line(room), fit_line_robust(room, distances), fit_line({}));
}

inline void measure_fit_circle(Workspace& work, Digest& digest) {
    Arena arena(work.scratch_span());
    const Span<FinePoint> room = arena.take<FinePoint>(120);
    const Span<FinePixel> distances = arena.take<FinePixel>(120);
    Random random(20);
    for (int i = 0; i < 40; ++i) {
        const std::int64_t radius = std::int64_t{65536} * random.between(3, 400);
        const std::uint32_t arc = random.next() >> i % 5;
        const Span<const FinePoint> points =
            scattered_points(random, room.first(random.between(2, 120)), i % 4 * 12, [&] {
                const UnitVector way = unit_vector(FineAngle::from_raw(arc / 1000 * random.below(1000)));
                return FinePoint{FinePixel::from_raw(static_cast<std::int32_t>(radius * way.x.raw() >> 30)),
                                 FinePixel::from_raw(static_cast<std::int32_t>(radius * way.y.raw() >> 30))};
            });
        const Result<CircleFit> fit = fit_circle(points);
        digest.add(fit, fit_circle_robust(points, distances));
        if (fit) digest.add(distance_from(fit->circle, points[0]));
        if (points.size() >= 3) digest.add(circle_through(points[0], points[1], points[2]));
    }
    for (int i = 0; i < 120; ++i) room[i] = {FinePixel::from_int(2 * i), FinePixel::from_int(3 * i)};
    digest.add(fit_circle(room), fit_circle_robust(room, distances),
               circle_through(room[0], room[1], room[2]));
}

/// The mean of two numbers as a model, to see least_median() alone.
inline void measure_least_median(Workspace& work, Digest& digest) {
    Arena arena(work.scratch_span());
    const Span<FinePoint> room = arena.take<FinePoint>(60);
    const Span<FinePixel> distances = arena.take<FinePixel>(60);
    Random random(21);
    const auto middle = [](Span<const FinePoint> two) -> Result<FinePixel> {
        if (two[0] == two[1]) return Status::degenerate;
        return FinePixel::from_raw((two[0].x.raw() + two[1].x.raw()) / 2);
    };
    const auto distance = [](FinePixel model, FinePoint point) {
        return FinePixel::from_raw(static_cast<std::int32_t>(magnitude((point.x - model).raw())));
    };
    for (int i = 0; i < 20; ++i) {
        const Span<const FinePoint> points =
            scattered_points(random, room.first(random.between(2, 60)), 30, [&] {
                return FinePoint{FinePixel::from_int(i), {}};
            });
        digest.add(least_median<2, FinePixel>(points, middle, distance, distances));
    }
    digest.add(least_median<2, FinePixel>(room, middle, distance, {}),
               least_median<2, FinePixel>({}, middle, distance, distances));
}

inline void measure_half_turn(Workspace&, Digest& digest) {
    Random random(22);
    Asymmetry before;
    for (int i = 0; i < 60; ++i) {
        Moments moments;
        const int rows = random.between(1, 200);
        for (int y = 0; y < rows; ++y) {
            const int first = random.between(0, 100 + i % 7 * y);
            moments.add_run(first, first + random.between(0, 60 + i), y);
        }
        const Result<CentralMoments> central = central_moments(moments);
        if (!central) continue;
        const Result<Orientation> axis = orientation(*central);
        const Result<Asymmetry> ends = asymmetry(*central, axis ? axis->axis : FineAngle());
        digest.add(ends, asymmetry(*central, FineAngle::from_raw(random.next())));
        if (!ends) continue;
        digest.add(half_turn(*ends), half_turn(*ends, before), half_turn(*ends, *ends), *ends == before);
        before = *ends;
    }
    Moments pixel;
    pixel.add_run(4, 5, 4);
    digest.add(asymmetry(*central_moments(pixel), FineAngle()), half_turn(Asymmetry()));
}

inline void measure_run_widths(Workspace& work, Digest& digest) {
    Random random(23);
    for (const Size size : {Size{1, 1}, Size{3, 70}, Size{97, 40}, Size{1600, 5}}) {
        const ImageView<Gray8> src = work.view<Gray8>(0, size);
        for (int width_min = 0; width_min < 9; ++width_min) {
            fill_clumps(src, random);
            digest.add(run_widths(src, width_min), longest_run(src.row(0), size.width));
            RunWidthAccumulator lower(width_min + 1);
            RunWidthAccumulator upper(width_min + 1);
            digest.add(lower.begin(size), upper.begin(size));
            for (int y = 0; y < size.height; ++y)
                (y < size.height / 2 ? upper : lower).add_row(src.row(y), size.width, y);
            lower.merge(upper);
            digest.add(upper.result(), lower.result());
        }
    }
    digest.add(run_widths({}, 1));
}

}  // namespace fovea::golden
