// SPDX-License-Identifier: MIT
//
// Remap: warps by a map of places, dense, compact, or as a grid that is interpolated on the way. Book sec.
// 2.9.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/places.hpp>
#include <fovea/warp/sampling.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Where an output pixel comes from: in 1/256 px, 8 bytes a pixel.
using MapPoint = SubPixelPoint;

/// The same as a way from the output pixel's own place: in 1/32 px, up to 1023 px, 4 bytes a pixel.
struct MapOffset {
    std::int16_t x = 0;
    std::int16_t y = 0;

    static constexpr int fraction_bits = 5;
};

/// In a map: there is no such place, the pixel becomes the sampling's level.
inline constexpr MapPoint no_map_point{SubPixel::from_raw(simd::no_place), SubPixel()};

/// Columns and rows between two points of a grid.
inline constexpr int map_grid_step = 16;

/// The size of the grid for an output: points at columns 0, 16, 32, ... up to the first one at or beyond the
/// last pixel, and at least two; rows alike.
constexpr Size map_grid_size(Size output);

inline namespace FOVEA_ISA {

/// Every pixel of dst is what src shows at the place that the map gives for it.
///
/// Shapes    map and dst equal; src any size; all 1x1 to 32767x32767; Gray8 or Rgb888
/// Units     any 8-bit values
/// Rounding  pixels as warp_affine(); the map's places are taken as they are
/// Border    as sampling says; its level for no_map_point
/// Overlap   none
/// Errors    empty_image, size_mismatch, image_too_large
/// Source    book sec. 2.9.2. Pixels of the last row and column are pixels like others, and src is read only
template <class Pixel>
Status remap(NonDeduced<ImageView<const Pixel>> src, ImageView<const MapPoint> map,
             const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst);

/// The same with a compact map, half as large, which suits maps that move pixels a little: a lens
/// undistorted.
///
/// Rounding  places are multiples of 1/32 px: within 1/64 px, or 4 levels on a step from black to white
/// Others    as remap()
template <class Pixel>
Status remap_offsets(NonDeduced<ImageView<const Pixel>> src, ImageView<const MapOffset> map,
                     const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst);

/// The same with a grid, 1/256 as large, between whose points the places are interpolated bilinearly.
///
/// Shapes    grid map_grid_size(dst.size())
/// Rounding  each place once, to 1/256 px, ties up, from an exact mean of four points. A map whose second
///           differences over 16 px are e is met to e / 4
/// Border    as sampling says; where one of the four points is no_map_point, its level
/// Errors    empty_image, size_mismatch, image_too_large
/// Others    as remap()
template <class Pixel>
Status remap_grid(NonDeduced<ImageView<const Pixel>> src, ImageView<const MapPoint> grid,
                  const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst);

/// One row of the dense map that a grid stands for, for programs that keep a map of their own.
///
/// Shapes  grid map_grid_size() of an output that is as wide as row and has row y
/// Errors  empty_image; size_mismatch; out_of_range for a y beyond the grid
inline Status expand_map_grid(ImageView<const MapPoint> grid, int y, Span<MapPoint> row);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

constexpr Size map_grid_size(Size output) {
    const auto points = [](int side) { return side <= 1 ? 2 : (side - 2) / map_grid_step + 2; };
    return {points(output.width), points(output.height)};
}

inline namespace FOVEA_ISA {
namespace kernels {

struct MapPlaces {
    static constexpr simd::PlaceOrder order = simd::PlaceOrder::anywhere;
    static constexpr int strip = map_strip;
    ImageView<const MapPoint> map;

    void operator()(int x, int y, int count, simd::PlaceRun& run) const {
        static_assert(sizeof(MapPoint) == 2 * sizeof(std::int32_t), "a pair of places");
        simd::split_places(reinterpret_cast<const std::int32_t*>(map.row(y) + x), count, run);
    }
};

struct OffsetPlaces {
    static constexpr simd::PlaceOrder order = simd::PlaceOrder::anywhere;
    static constexpr int strip = map_strip;
    ImageView<const MapOffset> map;

    void operator()(int x, int y, int count, simd::PlaceRun& run) const {
        static_assert(sizeof(MapOffset) == 2 * sizeof(std::int16_t), "a pair of offsets");
        simd::offset_places(256 * x, 256 * y, reinterpret_cast<const std::int16_t*>(map.row(y) + x),
                            SubPixel::fraction_bits - MapOffset::fraction_bits, count, run);
    }
};

struct GridPlaces {
    static constexpr simd::PlaceOrder order = simd::PlaceOrder::anywhere;
    static constexpr int strip = warp_strip;
    ImageView<const MapPoint> grid;

    void operator()(int x, int y, int count, simd::PlaceRun& run) const {
        // The last row of an output may lie on the last row of the grid.
        const int above = minimum(y / map_grid_step, grid.height() - 2);
        const int down = y - above * map_grid_step;
        const MapPoint* upper = grid.row(above);
        const MapPoint* lower = grid.row(above + 1);
        for (int i = 0; i < count; i += map_grid_step) {
            const int left = minimum((x + i) / map_grid_step, grid.width() - 2);
            const int start = x + i - left * map_grid_step;
            if (gone(upper[left]) || gone(upper[left + 1]) || gone(lower[left]) || gone(lower[left + 1])) {
                const int end = minimum(count, i + map_grid_step);
                for (int k = i; k < end; ++k) run.x[k] = run.y[k] = simd::no_place;
                continue;
            }
            const auto between = [down](SubPixel a, SubPixel b) {
                return std::int64_t{a.raw()} * (map_grid_step - down) + std::int64_t{b.raw()} * down;
            };
            along(between(upper[left].x, lower[left].x), between(upper[left + 1].x, lower[left + 1].x), start,
                  run.x + i);
            along(between(upper[left].y, lower[left].y), between(upper[left + 1].y, lower[left + 1].y), start,
                  run.y + i);
        }
    }

private:
    static bool gone(const MapPoint& point) { return point.x.raw() == simd::no_place; }
    /// Sixteen places from one to the next, both times 16.
    static void along(std::int64_t from, std::int64_t to, int start, std::int32_t* places) {
        const std::int64_t way = to - from;
        constexpr std::int64_t longest = std::int64_t{1} << 26;
        if (start == 0 && way < longest && way > -longest) {
            simd::curve_places(static_cast<std::int32_t>(from >> 4),
                               static_cast<std::int32_t>((from & 15) << 4) + 128,
                               static_cast<std::int32_t>(way), 0, 8, places);
            return;
        }
        for (int i = 0; i < map_grid_step; ++i)
            places[i] = static_cast<std::int32_t>((from * map_grid_step + way * (start + i) + 128) >> 8);
    }
};

template <class Pixel, class Places, class Map>
Status remap_frame(ImageView<const Pixel> src, ImageView<const Map> map, Size needed,
                   const Sampling<Pixel>& sampling, ImageView<Pixel> dst) {
    if (src.empty() || map.empty() || dst.empty()) return Status::empty_image;
    if (map.size() != needed) return Status::size_mismatch;
    if (Status s = check_warp<Pixel>(src, dst); s != Status::ok) return s;
    warp_frame<Pixel>(src, Places{map}, sampling, dst);
    return Status::ok;
}

/// A row of the map that a grid stands for, by how its places are calculated.
template <class Places>
Status expand_grid(ImageView<const MapPoint> grid, int y, Span<MapPoint> row) {
    if (grid.empty() || row.empty()) return Status::empty_image;
    const auto width = static_cast<int>(minimum<std::ptrdiff_t>(row.size(), max_image_side + 1));
    if (grid.width() != map_grid_size({width, 1}).width || grid.height() < 2) return Status::size_mismatch;
    if (y < 0 || y > (grid.height() - 1) * map_grid_step) return Status::out_of_range;
    const Places places{grid};
    for (int x = 0; x < width; x += simd::run_length) {
        simd::PlaceRun run;
        const int count = minimum(width - x, simd::run_length);
        places(x, y, count, run);
        for (int i = 0; i < count; ++i)
            row[x + i] = {SubPixel::from_raw(run.x[i]), SubPixel::from_raw(run.y[i])};
    }
    return Status::ok;
}

}  // namespace kernels

template <class Pixel>
Status remap(NonDeduced<ImageView<const Pixel>> src, ImageView<const MapPoint> map,
             const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst) {
    return kernels::remap_frame<Pixel, kernels::MapPlaces>(src, map, dst.size(), sampling, dst);
}

template <class Pixel>
Status remap_offsets(NonDeduced<ImageView<const Pixel>> src, ImageView<const MapOffset> map,
                     const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst) {
    return kernels::remap_frame<Pixel, kernels::OffsetPlaces>(src, map, dst.size(), sampling, dst);
}

template <class Pixel>
Status remap_grid(NonDeduced<ImageView<const Pixel>> src, ImageView<const MapPoint> grid,
                  const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst) {
    return kernels::remap_frame<Pixel, kernels::GridPlaces>(src, grid, map_grid_size(dst.size()), sampling,
                                                            dst);
}

inline Status expand_map_grid(ImageView<const MapPoint> grid, int y, Span<MapPoint> row) {
    return kernels::expand_grid<kernels::GridPlaces>(grid, y, row);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
