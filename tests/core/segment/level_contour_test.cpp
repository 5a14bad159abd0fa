// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/segment/level_contour.hpp>
#include <fovea/statistics/polygon_moments.hpp>
#include <support/guarded_image.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

std::vector<FinePoint> trace(ImageView<const Gray8> image, LevelSet set, Point start,
                             Connectivity connectivity = Connectivity::eight) {
    std::vector<FinePoint> points;
    EXPECT_EQ(trace_level_contour(image, set, connectivity, start, [&](FinePoint p) { points.push_back(p); }),
              Status::ok);
    return points;
}

TEST(TraceLevelContour, GoesClockwiseAroundAPixel) {
    GuardedImage<Gray8> image({5, 5});
    image.fill(Gray8{0});
    image(2, 2) = 200;
    const std::vector<FinePoint> points = trace(image.view(), {101, false}, {2, 2});
    // The level is 100.5: from 200 to 0 it is crossed after 99.5 / 200.
    const double way = 99.5 / 200;
    ASSERT_EQ(points.size(), 4u);
    EXPECT_EQ(points[0], fine(2, 2 - way));
    EXPECT_EQ(points[1], fine(2 + way, 2));
    EXPECT_EQ(points[2], fine(2, 2 + way));
    EXPECT_EQ(points[3], fine(2 - way, 2));
}

TEST(TraceLevelContour, CornersHoldTogetherOnlyWithEightNeighbours) {
    GuardedImage<Gray8> image({4, 4});
    image.fill(Gray8{255});
    image(1, 1) = 0;
    image(2, 2) = 0;
    EXPECT_EQ(trace(image.view(), {128, true}, {1, 1}).size(), 8u);
    EXPECT_EQ(trace(image.view(), {128, true}, {1, 1}, Connectivity::four).size(), 4u);
}

TEST(TraceLevelContour, StaysHalfAPixelOutsideAtTheBorder) {
    GuardedImage<Gray8> image({2, 1});
    image.fill(Gray8{255});
    const std::vector<FinePoint> points = trace(image.view(), {128, false}, {0, 0});
    ASSERT_EQ(points.size(), 6u);
    EXPECT_EQ(points[0], fine(0, -0.5));
    EXPECT_EQ(points[2], fine(1.5, 0));
    EXPECT_EQ(points[5], fine(-0.5, 0));
}

TEST(TraceLevelContour, ReturnsFromEveryRegionAndHoleOfRandomImages) {
    Random random(131);
    for (int round = 0; round < 100; ++round) {
        GuardedImage<Gray8> image({random.between(1, 40), random.between(1, 40)});
        image.fill(random);
        const LevelSet set{static_cast<Gray8>(random.between(1, 255)), round % 2 == 0};
        const Connectivity regions = round % 3 == 0 ? Connectivity::four : Connectivity::eight;
        const Connectivity ground = round % 3 == 0 ? Connectivity::eight : Connectivity::four;
        GuardedImage<Gray8> binary(image.view().size());
        for (int y = 0; y < binary.view().height(); ++y)
            for (int x = 0; x < binary.view().width(); ++x)
                binary(x, y) = set.contains(image(x, y)) ? 255 : 0;
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(connected_components_scratch(image.view().width())));
        List<Region, 1600> found;
        List<Hole, 1600> holes;
        ComponentOptions options;
        options.connectivity = regions;
        ASSERT_EQ(
            connected_components(binary.view(), options,
                                 {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, found, holes),
            Status::ok);
        std::size_t cracks = 0;
        for (const Region& region : found) cracks += trace(image.view(), set, region.first, regions).size();
        for (const Hole& hole : holes)
            cracks += trace(image.view(), set.complement(), hole.first, ground).size();
        // Together they pass every side between inside and outside once.
        std::size_t sides = 0;
        for (int y = 0; y < binary.view().height(); ++y)
            for (int x = 0; x < binary.view().width(); ++x)
                for (const Point q : {Point{x + 1, y}, Point{x - 1, y}, Point{x, y + 1}, Point{x, y - 1}})
                    if (binary(x, y) != 0 && (!binary.view().contains(q) || binary(q.x, q.y) == 0)) ++sides;
        ASSERT_EQ(cracks, sides) << round;
    }
}

TEST(TraceLevelContour, EnclosesABlurredDiscToAHundredthOfAPixel) {
    Random random(132);
    for (int round = 0; round < 20; ++round) {
        const double x = uniform(random, 48, 52);
        const double y = uniform(random, 48, 52);
        const double radius = uniform(random, 15, 30);
        Scene scene;
        const GuardedImage<Gray8> image = render(
            {100, 100}, scene, random, [&](double u, double v) { return std::hypot(u - x, v - y) < radius; });
        const int column = static_cast<int>(std::lround(x));
        int row = 0;
        while (image(column, row) >= 125) ++row;
        PolygonMoments moments({50, 50});
        std::vector<FinePoint> points = trace(image.view(), {125, true}, {column, row});
        for (std::size_t i = 0; i < points.size(); ++i)
            moments.add_edge(points[i], points[(i + 1) % points.size()]);
        const CentralMoments c = *moments.central();
        EXPECT_NEAR(real(c.centroid.x), x, 0.01);
        EXPECT_NEAR(real(c.centroid.y), y, 0.01);
        // The level of the middle lies where the blurred disc has half its height: s^2 / 2R inside the edge.
        EXPECT_NEAR(std::sqrt(static_cast<double>(c.area) / pi), radius - 1.08 / (2 * radius), 0.02);
    }
}

TEST(TraceLevelContour, SaysWhatIsWrong) {
    GuardedImage<Gray8> image({4, 4});
    image.fill(Gray8{255});
    image(1, 1) = 0;
    const auto nothing = [](FinePoint) {};
    const LevelSet bright{128, false};
    EXPECT_EQ(trace_level_contour(ImageView<const Gray8>(), bright, Connectivity::eight, {0, 0}, nothing),
              Status::empty_image);
    EXPECT_EQ(trace_level_contour(image.view(), bright, Connectivity::eight, {4, 0}, nothing),
              Status::out_of_range);
    EXPECT_EQ(trace_level_contour(image.view(), bright, Connectivity::eight, {1, 1}, nothing),
              Status::bad_argument);
    EXPECT_EQ(trace_level_contour(image.view(), bright, Connectivity::eight, {2, 2}, nothing),
              Status::bad_argument);
}

}  // namespace
}  // namespace fovea::test
