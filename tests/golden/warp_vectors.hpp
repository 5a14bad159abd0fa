// SPDX-License-Identifier: MIT
//
// Golden vectors of warp/: what the catalogue does not run by itself. warp/bilinear is among the image
// vectors.
#pragma once

#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/warp/affine.hpp>
#include <fovea/warp/from_points.hpp>
#include <fovea/warp/homography.hpp>
#include <fovea/warp/polar.hpp>
#include <fovea/warp/remap.hpp>
#include <fovea/warp/remap_curved.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const AffineTransform& t) { digest.add(t.xx, t.xy, t.x0, t.yx, t.yy, t.y0); }
inline void put(Digest& digest, const Homography& h) {
    digest.add(h.xx, h.xy, h.x0, h.yx, h.yy, h.y0, h.wx, h.wy, h.w0);
}

/// A place in a square of that many px.
inline FinePoint warp_place(Random& random, int side) {
    return {FinePixel::from_raw(random.between(0, side * 65536)),
            FinePixel::from_raw(random.between(0, side * 65536))};
}

inline void warp_polar_places(Workspace& work, Digest& digest) {
    Random random(46);
    for (int i = 0; i < 200; ++i) {
        PolarFrame frame;
        frame.centre = warp_place(random, i % 2 == 0 ? 500 : 32000);
        frame.inner = FinePixel::from_raw(random.between(-100, 1 << (i % 30)));
        frame.outer = FinePixel::from_raw(random.between(0, 1 << 30));
        frame.scale = i % 3 == 0 ? RadiusScale::linear : RadiusScale::logarithmic;
        frame.start = FineAngle::from_raw(random.next());
        const Size size{random.between(1, 700), random.between(1, 700)};
        digest.add(
            polar_place(frame, size, {random.between(-1, size.width), random.between(0, size.height)}));
        digest.add(polar_place(frame, size, {random.between(0, size.width - 1), 0}));
    }
    const ImageView<Gray8> src = part_picture(work, 0);
    const ImageView<Rgb888> colour = work.view<Rgb888>(1, {40, 30});
    const ImageView<Rgb888> rings = work.view<Rgb888>(2, {50, 20});
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) colour(x, y) = {src(x, y), src(2 * x, y), src(x, 2 * y)};
    PolarFrame frame;
    frame.centre = {FinePixel::from_ratio(39, 2), FinePixel::from_ratio(29, 3)};
    frame.outer = FinePixel::from_int(25);
    digest.add(warp_polar<Rgb888>(colour, frame, {}, work.scratch_span(), rings), rings);
}

inline void warp_transforms(Workspace& work, Digest& digest) {
    static_cast<void>(work);
    Random random(41);
    for (int i = 0; i < 40; ++i) {
        const FinePoint centre = warp_place(random, 600);
        const AffineTransform turn = rotation_about(centre, FineAngle::from_raw(random.next()));
        FinePoint from[4];
        FinePoint to[4];
        for (int k = 0; k < 4; ++k) {
            from[k] = warp_place(random, 500);
            to[k] = warp_place(random, 30000);
        }
        const Result<AffineTransform> affine =
            affine_through({from[0], from[1], from[2]}, {to[0], to[1], to[2]});
        digest.add(turn, map_point(turn, from[0]), source_rows_of(turn, 640), affine);
        if (affine)
            digest.add(inverse_of(*affine), chained(*affine, turn), chained(turn, *affine),
                       map_point(*affine, from[3]), homography_of(*affine));
        // Corners near those of a square, so that most of them have an answer.
        for (int k = 0; k < 4; ++k) {
            const int right = k == 1 || k == 2 ? 400 : 0;
            const int down = k >= 2 ? 400 : 0;
            from[k].x += FinePixel::from_int(right);
            to[k] = {from[k].x, from[k].y + FinePixel::from_int(2 * down)};
            from[k] = {FinePixel::from_int(right), FinePixel::from_int(down)};
        }
        const Result<Homography> homography = homography_through(from, to);
        digest.add(homography);
        if (homography) digest.add(map_point(*homography, warp_place(random, 2000)));
    }
}

inline void warp_maps(Workspace& work, Digest& digest) {
    const ImageView<Gray8> src = part_picture(work, 0);
    const Size sizes_of[] = {{1, 1}, {20, 3}, {37, 11}, {70, 9}};
    Random random(42);
    for (const Size size : sizes_of) {
        const ImageView<Gray8> dst = work.view<Gray8>(1, size);
        for (const int reach : {300, 6000, 2000000}) {
            const Sampling<Gray8> sampling{
                random.below(2) == 0 ? Interpolation::nearest : Interpolation::bilinear,
                random.below(2) == 0 ? Outside::replicate : Outside::constant, 99};
            const auto point = [&](int x, int y) {
                return MapPoint{SubPixel::from_raw(256 * x + random.between(-reach, reach)),
                                SubPixel::from_raw(256 * y + random.between(-reach, reach))};
            };
            const ImageView<MapPoint> map = work.view<MapPoint>(2, size);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) map(x, y) = point(x, y);
            map(0, size.height / 2) = no_map_point;
            digest.add(remap<Gray8>(src, map, sampling, dst), dst);

            const ImageView<MapOffset> offsets = work.view<MapOffset>(2, size);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    offsets(x, y) = {static_cast<std::int16_t>(random.between(-reach, reach) / 100),
                                     static_cast<std::int16_t>(random.between(-reach, reach) / 100)};
            digest.add(remap_offsets<Gray8>(src, offsets, sampling, dst), dst);

            const Size points = map_grid_size(size);
            const ImageView<MapPoint> grid = work.view<MapPoint>(2, points);
            for (int y = 0; y < points.height; ++y)
                for (int x = 0; x < points.width; ++x)
                    grid(x, y) = point(map_grid_step * x, map_grid_step * y);
            digest.add(remap_grid<Gray8>(src, grid, sampling, dst), dst);
            MapPoint row[70];
            const Span<MapPoint> whole(row, size.width);
            digest.add(expand_map_grid(grid, size.height - 1, whole), whole);
            digest.add(remap_grid<Gray8>(src, map, sampling, dst));
        }
    }
}

inline void warp_curved_maps(Workspace& work, Digest& digest) {
    const ImageView<Gray8> src = part_picture(work, 0);
    const Size sizes_of[] = {{1, 1}, {20, 3}, {37, 11}, {70, 40}};
    Random random(44);
    for (const Size size : sizes_of) {
        const ImageView<Gray8> dst = work.view<Gray8>(1, size);
        const Size points = map_grid_size(size);
        const ImageView<MapPoint> grid = work.view<MapPoint>(2, points);
        for (const int reach : {300, 6000, 0x7fffff00}) {
            for (int y = 0; y < points.height; ++y)
                for (int x = 0; x < points.width; ++x) {
                    const int to_x = random.between(-reach, reach);
                    const int to_y = random.between(-reach, reach);
                    const int near = reach > 6000 ? 0 : 4096;
                    grid(x, y) = {SubPixel::from_raw(near * x + to_x), SubPixel::from_raw(near * y + to_y)};
                }
            if (points.width > 3) grid(points.width - 1, 0) = no_map_point;
            digest.add(remap_curved_grid<Gray8>(src, grid, {}, dst), dst);
            MapPoint row[70];
            const Span<MapPoint> whole(row, size.width);
            digest.add(expand_curved_map_grid(grid, size.height - 1, whole), whole);
        }
    }
}

inline void warp_homographies(Workspace& work, Digest& digest) {
    const ImageView<Gray8> src = part_picture(work, 0);
    const ImageView<Gray8> dst = work.view<Gray8>(1, {100, 40});
    Random random(43);
    for (int i = 0; i < 12; ++i) {
        // From hardly tilted to a horizon in the image.
        Homography h;
        const int tilt = 1 << (2 * i);
        h.wx = std::int64_t{random.between(-tilt, tilt)} * 1024;
        h.wy = std::int64_t{random.between(-tilt, tilt)} * 1024;
        h.xy = std::int64_t{random.between(-1000, 1000)} * (1 << 30);
        h.x0 = std::int64_t{random.between(-1000, 1000)} * (std::int64_t{1} << 34);
        const Sampling<Gray8> sampling{i % 2 == 0 ? Interpolation::bilinear : Interpolation::nearest,
                                       i % 3 == 0 ? Outside::replicate : Outside::constant, 99};
        digest.add(warp_homography<Gray8>(src, h, sampling, dst), dst);
    }
}

}  // namespace fovea::golden
