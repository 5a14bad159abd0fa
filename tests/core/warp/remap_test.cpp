// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/warp/remap.hpp>
#include <support/guarded_image.hpp>

#include "warp_reference.hpp"

namespace fovea::test {
namespace {

MapPoint point(double x, double y) {
    return {SubPixel::from_raw(static_cast<std::int32_t>(std::lround(x * 256))),
            SubPixel::from_raw(static_cast<std::int32_t>(std::lround(y * 256)))};
}
Place real(MapPoint p) { return {p.x.raw() / 256.0, p.y.raw() / 256.0}; }

/// Barrel distortion about the middle of an image.
Place distorted(Size size, double x, double y) {
    const double cx = (size.width - 1) / 2.0;
    const double cy = (size.height - 1) / 2.0;
    const double radius = (x - cx) * (x - cx) / (cx * cx) + (y - cy) * (y - cy) / (cx * cx);
    const double scale = 1 - 0.2 * radius + 0.05 * radius * radius;
    return {cx + (x - cx) * scale, cy + (y - cy) * scale};
}

TEST(Remap, TakesEveryPixelFromItsPlace) {
    Random random(61);
    for (const Size size : test_sizes())
        for (const Size out : {Size{1, 1}, Size{67, 5}, Size{200, 3}})
            for (const Sampling<Gray8>& sampling : samplings()) {
                GuardedImage<Gray8> src(size), dst(out);
                src.fill(random);
                GuardedImage<MapPoint> map(out);
                for (int y = 0; y < out.height; ++y)
                    for (int x = 0; x < out.width; ++x) {
                        const auto place = [&](int side) {
                            return SubPixel::from_raw(random.between(-600, 256 * side + 600));
                        };
                        map(x, y) = {place(size.width), place(size.height)};
                    }
                map(out.width / 2, 0) = no_map_point;
                ASSERT_EQ(remap<Gray8>(src.view(), map.view(), sampling, dst.view()), Status::ok);
                for (int y = 0; y < out.height; ++y)
                    for (int x = 0; x < out.width; ++x)
                        ASSERT_EQ(dst(x, y), map(x, y) == no_map_point
                                                 ? sampling.level
                                                 : naive_sample(src.view(), real(map(x, y)), sampling))
                            << size.width << "x" << size.height << " at " << x << "," << y;
            }
}

TEST(Remap, TakesPlacesAtTheEndsOfTheirRange) {
    GuardedImage<Gray8> src({40, 30}), dst({64, 1});
    src.fill(Gray8{200});
    GuardedImage<MapPoint> map({64, 1});
    constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    const std::int32_t ends[] = {least + 1, -129, -128, 256 * 40 - 129, 256 * 40 - 128, most};
    for (const Sampling<Gray8>& sampling : samplings())
        for (const std::int32_t end : ends) {
            for (int x = 0; x < 64; ++x) map(x, 0) = {SubPixel::from_raw(end), SubPixel::from_raw(256)};
            ASSERT_EQ(remap<Gray8>(src.view(), map.view(), sampling, dst.view()), Status::ok);
            const bool inside = end >= -128 && end < 256 * 40 - 128;
            for (int x = 0; x < 64; ++x)
                ASSERT_EQ(dst(x, 0), inside || sampling.outside == Outside::replicate ? 200 : 77) << end;
        }
}

// Defect 18 of the IVT: an identity map blackened the last row, the last column and pixel (0, 0).
TEST(Remap, KeepsEveryPixelUnderAnIdentityMap) {
    Random random(62);
    const Size size{32, 32};
    GuardedImage<Gray8> src(size), dst(size);
    src.fill(random);
    GuardedImage<MapPoint> map(size), grid(map_grid_size(size));
    GuardedImage<MapOffset> offsets(size);
    offsets.fill(MapOffset{});
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) map(x, y) = point(x, y);
    for (int y = 0; y < grid.view().height(); ++y)
        for (int x = 0; x < grid.view().width(); ++x) grid(x, y) = point(16 * x, 16 * y);
    for (const Sampling<Gray8>& sampling : samplings()) {
        ASSERT_EQ(remap<Gray8>(src.view(), map.view(), sampling, dst.view()), Status::ok);
        EXPECT_TRUE(equal(src.view(), dst.view()));
        ASSERT_EQ(remap_offsets<Gray8>(src.view(), offsets.view(), sampling, dst.view()), Status::ok);
        EXPECT_TRUE(equal(src.view(), dst.view()));
        ASSERT_EQ(remap_grid<Gray8>(src.view(), grid.view(), sampling, dst.view()), Status::ok);
        EXPECT_TRUE(equal(src.view(), dst.view()));
    }
}

// Defect 18: it wrote to its input.
TEST(Remap, LeavesItsSourceAndItsMapAlone) {
    Random random(63);
    GuardedImage<Gray8> src({50, 40}), dst({50, 40});
    src.fill(random);
    GuardedImage<MapPoint> map({50, 40});
    map.fill(point(-1, -1));
    const GuardedImage<Gray8> before = src;
    const GuardedImage<MapPoint> map_before = map;
    ASSERT_EQ(remap<Gray8>(src.view(), map.view(), {}, dst.view()), Status::ok);
    EXPECT_TRUE(equal(before.view(), src.view()));
    EXPECT_TRUE(equal(map_before.view(), map.view()));
}

TEST(RemapOffsets, EqualsTheDenseMapOfTheSamePlaces) {
    Random random(64);
    for (const Size size : test_sizes()) {
        GuardedImage<Gray8> src(size), dense(size), compact(size);
        src.fill(random);
        GuardedImage<MapPoint> map(size);
        GuardedImage<MapOffset> offsets(size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const int most = random.below(8) == 0 ? 32767 : 100;
                offsets(x, y) = {static_cast<std::int16_t>(random.between(-most - 1, most)),
                                 static_cast<std::int16_t>(random.between(-most - 1, most))};
                map(x, y) = {SubPixel::from_raw(256 * x + 8 * offsets(x, y).x),
                             SubPixel::from_raw(256 * y + 8 * offsets(x, y).y)};
            }
        for (const Sampling<Gray8>& sampling : samplings()) {
            ASSERT_EQ(remap<Gray8>(src.view(), map.view(), sampling, dense.view()), Status::ok);
            ASSERT_EQ(remap_offsets<Gray8>(src.view(), offsets.view(), sampling, compact.view()), Status::ok);
            ASSERT_TRUE(equal(dense.view(), compact.view())) << size.width << "x" << size.height;
        }
    }
}

TEST(RemapGrid, EqualsTheMapThatItStandsFor) {
    Random random(65);
    for (const Size size : {Size{1, 1}, Size{2, 17}, Size{16, 16}, Size{17, 33}, Size{18, 3}, Size{150, 40}})
        for (const int reach : {300, 200000, 0x3fffffff}) {
            GuardedImage<Gray8> src({60, 50}), by_grid(size), by_map(size);
            src.fill(random);
            GuardedImage<MapPoint> grid(map_grid_size(size)), map(size);
            for (int y = 0; y < grid.view().height(); ++y)
                for (int x = 0; x < grid.view().width(); ++x)
                    grid(x, y) = {SubPixel::from_raw(4096 + random.between(-reach, reach)),
                                  SubPixel::from_raw(4096 + random.between(-reach, reach))};
            if (size.width > 100) grid(3, 1) = no_map_point;
            for (int y = 0; y < size.height; ++y) {
                ASSERT_EQ(expand_map_grid(grid.view(), y, {map.view().row(y), size.width}), Status::ok);
                for (int x = 0; x < size.width; ++x) {
                    const int left = std::min(x / 16, grid.view().width() - 2);
                    const int top = std::min(y / 16, grid.view().height() - 2);
                    bool gone = false;
                    double sum_x = 0;
                    double sum_y = 0;
                    for (int i = 0; i < 4; ++i) {
                        const MapPoint p = grid(left + i % 2, top + i / 2);
                        gone = gone || p == no_map_point;
                        const int u = x - 16 * left;
                        const int v = y - 16 * top;
                        const double weight = (i % 2 == 0 ? 16 - u : u) * (i / 2 == 0 ? 16 - v : v);
                        sum_x += weight * p.x.raw();
                        sum_y += weight * p.y.raw();
                    }
                    if (gone) {
                        ASSERT_EQ(map(x, y).x.raw(), no_map_point.x.raw());
                        continue;
                    }
                    ASSERT_EQ(map(x, y).x.raw(), std::floor(sum_x / 256 + 0.5)) << x << "," << y;
                    ASSERT_EQ(map(x, y).y.raw(), std::floor(sum_y / 256 + 0.5));
                }
            }
            for (const Sampling<Gray8>& sampling : samplings()) {
                ASSERT_EQ(remap_grid<Gray8>(src.view(), grid.view(), sampling, by_grid.view()), Status::ok);
                ASSERT_EQ(remap<Gray8>(src.view(), map.view(), sampling, by_map.view()), Status::ok);
                ASSERT_TRUE(equal(by_grid.view(), by_map.view()));
            }
        }
}

TEST(RemapGrid, FollowsALensToASmallPartOfAPixel) {
    // The lens bends a place by less than 0.004 px over 16 px, so that a quarter of that and the rounding of
    // the points and of the place remain.
    const Size size{640, 480};
    GuardedImage<MapPoint> grid(map_grid_size(size));
    for (int y = 0; y < grid.view().height(); ++y)
        for (int x = 0; x < grid.view().width(); ++x) {
            const Place p = distorted(size, 16 * x, 16 * y);
            grid(x, y) = point(p.x, p.y);
        }
    std::vector<MapPoint> row(640);
    double bend = 0;
    double worst = 0;
    for (int y = 0; y < 480; ++y) {
        ASSERT_EQ(expand_map_grid(grid.view(), y, {row.data(), 640}), Status::ok);
        for (int x = 0; x < 640; ++x) {
            const Place p = distorted(size, x, y);
            const Place a = distorted(size, x - 8, y);
            const Place b = distorted(size, x + 8, y);
            bend = std::max(bend, std::abs(a.x - 2 * p.x + b.x) / 2);
            worst = std::max({worst, std::abs(row[static_cast<std::size_t>(x)].x.raw() / 256.0 - p.x),
                              std::abs(row[static_cast<std::size_t>(x)].y.raw() / 256.0 - p.y)});
        }
    }
    EXPECT_LE(worst, 2 * bend + 1.0 / 256);
    EXPECT_LT(worst, 0.1);
}

TEST(Remap, SaysWhichMapDoesNotFit) {
    GuardedImage<Gray8> src({20, 20}), dst({33, 17});
    dst.fill(Gray8{9});
    GuardedImage<MapPoint> map({33, 16}), grid({3, 2}), wrong({4, 3});
    GuardedImage<MapOffset> offsets({32, 17});
    EXPECT_EQ(map_grid_size({33, 17}), (Size{3, 2}));
    EXPECT_EQ(map_grid_size({34, 18}), (Size{4, 3}));
    EXPECT_EQ(map_grid_size({640, 480}), (Size{41, 31}));
    EXPECT_EQ(remap<Gray8>(src.view(), map.view(), {}, dst.view()), Status::size_mismatch);
    EXPECT_EQ(remap_offsets<Gray8>(src.view(), offsets.view(), {}, dst.view()), Status::size_mismatch);
    EXPECT_EQ(remap_grid<Gray8>(src.view(), wrong.view(), {}, dst.view()), Status::size_mismatch);
    EXPECT_EQ(remap<Gray8>(src.view(), ImageView<const MapPoint>(), {}, dst.view()), Status::empty_image);
    EXPECT_EQ(remap<Gray8>(ImageView<const Gray8>(), map.view(), {}, dst.view()), Status::empty_image);
    EXPECT_EQ(dst(0, 0), 9);
    std::vector<MapPoint> row(33);
    EXPECT_EQ(expand_map_grid(grid.view(), 17, {row.data(), 33}), Status::out_of_range);
    EXPECT_EQ(expand_map_grid(grid.view(), -1, {row.data(), 33}), Status::out_of_range);
    EXPECT_EQ(expand_map_grid(grid.view(), 0, {row.data(), 16}), Status::size_mismatch);
    EXPECT_EQ(expand_map_grid(grid.view(), 0, {row.data(), 0}), Status::empty_image);
}

}  // namespace
}  // namespace fovea::test
