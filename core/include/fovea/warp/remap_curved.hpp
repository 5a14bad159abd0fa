// SPDX-License-Identifier: MIT
//
// Remap by a grid that is interpolated along parabolas: for maps that bend, such as those of lenses. Book
// sec. 2.9.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/places.hpp>
#include <fovea/warp/remap.hpp>
#include <fovea/warp/sampling.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// remap_grid() with parabolas in place of straight lines between the points: a grid of the same size meets a
/// lens's map ten to forty times better.
///
/// Shapes    grid map_grid_size(dst.size())
/// Rounding  down a column to 2^-13 px, along a row to 1/256 px, ties up. Where third differences over 16 px
///           are e, the map is met to e / 60 each way, and to 1/200 px for the formats' roundings
/// Border    as sampling says; its level where one of the four points around is no_map_point. Further points
///           that are no_map_point or not in the grid bend nothing: the bend of the other side stands for
///           both
/// Others    as remap()
/// Errors    empty_image, size_mismatch, image_too_large
/// Source    at the share t of the way from a to b: a + (b - a) t - t (1 - t) (f - a - b + g) / 4, f before a
///           and g behind b; the mean of both ends' second differences
template <class Pixel>
Status remap_curved_grid(NonDeduced<ImageView<const Pixel>> src, ImageView<const MapPoint> grid,
                         const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst);

/// One row of the dense map that such a grid stands for.
///
/// Shapes  grid map_grid_size() of an output that is as wide as row and has row y
/// Errors  empty_image; size_mismatch; out_of_range for a y beyond the grid
inline Status expand_curved_map_grid(ImageView<const MapPoint> grid, int y, Span<MapPoint> row);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

inline namespace FOVEA_ISA {
namespace kernels {

struct CurvedGridPlaces {
    static constexpr simd::PlaceOrder order = simd::PlaceOrder::anywhere;
    static constexpr int strip = warp_strip;
    ImageView<const MapPoint> grid;

    void operator()(int x, int y, int count, simd::PlaceRun& run) const {
        const int above = minimum(y / map_grid_step, grid.height() - 2);
        const int down = y - above * map_grid_step;
        Column before{}, left{}, right{}, behind{};
        int known = -2;
        for (int i = 0; i < count; i += map_grid_step) {
            const int at = minimum((x + i) / map_grid_step, grid.width() - 2);
            if (at == known + 1) {
                before = left;
                left = right;
                right = behind;
            } else {
                before = column(at - 1, above, down);
                left = column(at, above, down);
                right = column(at + 1, above, down);
            }
            behind = column(at + 2, above, down);
            known = at;
            if (!left.there || !right.there) {
                const int end = minimum(count, i + map_grid_step);
                for (int k = i; k < end; ++k) run.x[k] = run.y[k] = simd::no_place;
                continue;
            }
            const int start = x + i - at * map_grid_step;
            along(left.x, right.x, bend(before, left, right, behind, &Column::x), start, run.x + i);
            along(left.y, right.y, bend(before, left, right, behind, &Column::y), start, run.y + i);
        }
    }

private:
    /// Where a column of the grid is at the output's row, in 1/4096 px.
    struct Column {
        std::int64_t x = 0;
        std::int64_t y = 0;
        bool there = false;
    };

    const MapPoint* point(int column, int row) const {
        if (column < 0 || column >= grid.width() || row < 0 || row >= grid.height()) return nullptr;
        const MapPoint* found = grid.row(row) + column;
        return found->x == no_map_point.x ? nullptr : found;
    }
    /// The sum of the second differences at a and at b; of f and g what is not there is null.
    static std::int64_t bend(const std::int64_t* f, std::int64_t a, std::int64_t b, const std::int64_t* g) {
        if (f != nullptr && g != nullptr) return *f - a - b + *g;
        if (f != nullptr) return 2 * (*f - 2 * a + b);
        if (g != nullptr) return 2 * (a - 2 * b + *g);
        return 0;
    }
    static std::int64_t bend(const Column& f, const Column& a, const Column& b, const Column& g,
                             std::int64_t Column::*side) {
        return bend(f.there ? &(f.*side) : nullptr, a.*side, b.*side, g.there ? &(g.*side) : nullptr);
    }
    Column column(int at, int above, int down) const {
        const MapPoint* a = point(at, above);
        const MapPoint* b = point(at, above + 1);
        if (a == nullptr || b == nullptr) return {};
        const MapPoint* f = point(at, above - 1);
        const MapPoint* g = point(at, above + 2);
        const auto between = [&](SubPixel MapPoint::*side) {
            const auto raw = [side](const MapPoint* p) { return p != nullptr ? (p->*side).raw() : 0; };
            const std::int64_t from = raw(a), to = raw(b), first = raw(f), last = raw(g);
            const std::int64_t bent =
                bend(f != nullptr ? &first : nullptr, from, to, g != nullptr ? &last : nullptr);
            // Times 1024, of which 16 stay.
            return round_shift(
                64 * (from * (map_grid_step - down) + to * down) - down * (map_grid_step - down) * bent, 6);
        };
        return {between(&MapPoint::x), between(&MapPoint::y), true};
    }
    /// Sixteen places, all in 1/4096 px, of them to 1/256.
    static void along(std::int64_t from, std::int64_t to, std::int64_t bent, int start,
                      std::int32_t* places) {
        const std::int64_t way = to - from;
        // With these bounds a sum has 31 bits, and so has a place.
        constexpr std::int64_t longest = 1 << 19;
        constexpr std::int64_t most_bent = 1 << 22;
        const auto within = [](std::int64_t value, std::int64_t most) {
            return value < most && value > -most;
        };
        if (start == 0 && within(way, longest) && within(bent, most_bent) &&
            within(from, std::int64_t{1} << 34)) {
            simd::curve_places(static_cast<std::int32_t>(from >> 4),
                               static_cast<std::int32_t>((from & 15) << 10) + (1 << 13),
                               static_cast<std::int32_t>(way * 64), static_cast<std::int32_t>(-bent), 14,
                               places);
            return;
        }
        for (int i = 0; i < map_grid_step; ++i) {
            const std::int64_t k = start + i;
            const std::int64_t place =
                round_shift(1024 * from + 64 * way * k - k * (map_grid_step - k) * bent, 14);
            // Never by chance the mark of no place.
            places[i] = saturate_cast<std::int32_t>(maximum<std::int64_t>(place, simd::no_place + 1));
        }
    }
};

}  // namespace kernels

template <class Pixel>
Status remap_curved_grid(NonDeduced<ImageView<const Pixel>> src, ImageView<const MapPoint> grid,
                         const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst) {
    return kernels::remap_frame<Pixel, kernels::CurvedGridPlaces>(src, grid, map_grid_size(dst.size()),
                                                                  sampling, dst);
}

inline Status expand_curved_map_grid(ImageView<const MapPoint> grid, int y, Span<MapPoint> row) {
    return kernels::expand_grid<kernels::CurvedGridPlaces>(grid, y, row);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
