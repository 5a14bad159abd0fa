// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/warp/remap_curved.hpp>
#include <support/guarded_image.hpp>

#include "warp_reference.hpp"

namespace fovea::test {
namespace {

MapPoint raw_point(int x, int y) { return {SubPixel::from_raw(x), SubPixel::from_raw(y)}; }

/// Between a and b along a parabola; f and g count if they are there.
long double curve(const long double (&at)[4], const bool (&there)[4], long double t) {
    const long double before = at[0] - 2 * at[1] + at[2];
    const long double behind = at[1] - 2 * at[2] + at[3];
    const long double bend = there[0] && there[3] ? before + behind
                             : there[0]           ? 2 * before
                             : there[3]           ? 2 * behind
                                                  : 0;
    return at[1] + (at[2] - at[1]) * t - t * (1 - t) * bend / 4;
}

/// What stands in the comment of remap_curved_grid(), with floats: the place before it is rounded, in 1/256
///      px.
bool place_of(ImageView<const MapPoint> grid, int x, int y, bool of_x, long double& place) {
    const int left = std::min(x / 16, grid.width() - 2);
    const int top = std::min(y / 16, grid.height() - 2);
    long double columns[4] = {};
    bool columns_there[4] = {};
    for (int i = 0; i < 4; ++i) {
        long double at[4] = {};
        bool there[4] = {};
        for (int k = 0; k < 4; ++k) {
            const Point p{left - 1 + i, top - 1 + k};
            if (p.x < 0 || p.y < 0 || p.x >= grid.width() || p.y >= grid.height()) continue;
            there[k] = grid(p.x, p.y).x != no_map_point.x;
            at[k] = of_x ? grid(p.x, p.y).x.raw() : grid(p.x, p.y).y.raw();
        }
        columns_there[i] = there[1] && there[2];
        if (columns_there[i])
            columns[i] = std::floor(16 * curve(at, there, (y - 16 * top) / 16.0L) + 0.5L) / 16;
    }
    place = curve(columns, columns_there, (x - 16 * left) / 16.0L);
    return columns_there[1] && columns_there[2];
}

TEST(RemapCurvedGrid, TakesAParabolaAsItIs) {
    // x^2 / 64 in pixels at every 16th column: 0, 4, 16, 36, 64. Between them the parabola, not the chord.
    GuardedImage<MapPoint> grid({5, 2});
    for (int x = 0; x < 5; ++x) {
        grid(x, 0) = raw_point(256 * 4 * x * x, 0);
        grid(x, 1) = raw_point(256 * 4 * x * x, 256 * 16);
    }
    MapPoint row[65];
    ASSERT_EQ(expand_curved_map_grid(grid.view(), 4, {row, 65}), Status::ok);
    for (int x = 0; x <= 64; ++x) {
        EXPECT_EQ(row[x].x.raw(), 4 * x * x);
        EXPECT_EQ(row[x].y.raw(), 256 * 4);
    }
}

TEST(RemapCurvedGrid, EqualsTheMapThatItStandsFor) {
    Random random(67);
    for (const Size size : {Size{1, 1}, Size{2, 17}, Size{16, 16}, Size{17, 33}, Size{18, 3}, Size{150, 70}})
        for (const int reach : {300, 20000, 200000, 0x3fffffff})
            for (const std::uint32_t gone : {0u, 6u}) {
                GuardedImage<Gray8> src({60, 50}), by_grid(size), by_map(size);
                src.fill(random);
                GuardedImage<MapPoint> grid(map_grid_size(size)), map(size);
                for (int y = 0; y < grid.view().height(); ++y)
                    for (int x = 0; x < grid.view().width(); ++x) {
                        const int to_x = 4096 + random.between(-reach, reach);
                        const int to_y = 4096 + random.between(-reach, reach);
                        grid(x, y) =
                            gone > 0 && random.below(gone) == 0 ? no_map_point : raw_point(to_x, to_y);
                    }
                for (int y = 0; y < size.height; ++y) {
                    ASSERT_EQ(expand_curved_map_grid(grid.view(), y, {map.view().row(y), size.width}),
                              Status::ok);
                    for (int x = 0; x < size.width; ++x) {
                        long double to_x = 0, to_y = 0;
                        if (!place_of(grid.view(), x, y, true, to_x)) {
                            ASSERT_EQ(map(x, y).x.raw(), no_map_point.x.raw());
                            continue;
                        }
                        ASSERT_TRUE(place_of(grid.view(), x, y, false, to_y));
                        ASSERT_EQ(map(x, y).x.raw(), std::floor(to_x + 0.5L)) << x << "," << y;
                        ASSERT_EQ(map(x, y).y.raw(), std::floor(to_y + 0.5L)) << x << "," << y;
                    }
                }
                for (const Sampling<Gray8>& sampling : samplings()) {
                    ASSERT_EQ(remap_curved_grid<Gray8>(src.view(), grid.view(), sampling, by_grid.view()),
                              Status::ok);
                    ASSERT_EQ(remap<Gray8>(src.view(), map.view(), sampling, by_map.view()), Status::ok);
                    ASSERT_TRUE(equal(by_grid.view(), by_map.view()));
                }
            }
}

TEST(RemapCurvedGrid, HoldsPlacesAtTheEndsOfTheirRange) {
    // Points that swing from one end to the other: parabolas leave the format, which holds them.
    GuardedImage<MapPoint> grid({6, 4});
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x)
            grid(x, y) =
                raw_point((x + y) % 2 == 0 ? 0x7fffffff : -0x7fffffff, x == 2 ? 0x7fffffff : 0x7ffffff0);
    GuardedImage<Gray8> src({9, 9}), dst({81, 49});
    src.fill(7);
    ASSERT_EQ(remap_curved_grid<Gray8>(src.view(), grid.view(), {}, dst.view()), Status::ok);
    MapPoint row[81];
    for (int y = 0; y < 49; ++y) {
        ASSERT_EQ(expand_curved_map_grid(grid.view(), y, {row, 81}), Status::ok);
        for (const MapPoint& p : row) ASSERT_NE(p.x.raw(), no_map_point.x.raw());
    }
}

TEST(RemapCurvedGrid, SaysWhichGridDoesNotFit) {
    GuardedImage<Gray8> src({20, 20}), dst({33, 17});
    dst.fill(99);
    const GuardedImage<Gray8> before = dst;
    GuardedImage<MapPoint> grid({3, 2}), wrong({4, 3});
    EXPECT_EQ(remap_curved_grid<Gray8>(src.view(), {}, {}, dst.view()), Status::empty_image);
    EXPECT_EQ(remap_curved_grid<Gray8>({}, grid.view(), {}, dst.view()), Status::empty_image);
    EXPECT_EQ(remap_curved_grid<Gray8>(src.view(), wrong.view(), {}, dst.view()), Status::size_mismatch);
    EXPECT_TRUE(equal(before.view(), dst.view()));
    MapPoint row[33];
    EXPECT_EQ(expand_curved_map_grid(grid.view(), 17, {row, 33}), Status::out_of_range);
    EXPECT_EQ(expand_curved_map_grid(grid.view(), -1, {row, 33}), Status::out_of_range);
    EXPECT_EQ(expand_curved_map_grid(grid.view(), 0, {row, 16}), Status::size_mismatch);
    EXPECT_EQ(expand_curved_map_grid(grid.view(), 0, {row, 0}), Status::empty_image);
}

}  // namespace
}  // namespace fovea::test
