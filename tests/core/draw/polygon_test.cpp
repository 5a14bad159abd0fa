// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <core/draw/draw_reference.hpp>
#include <fovea/base/random.hpp>
#include <fovea/draw/polygon.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

constexpr int far = max_draw_coordinate;

Span<const Point> span_of(const std::vector<Point>& points) {
    return {points.data(), static_cast<std::ptrdiff_t>(points.size())};
}

/// Fills with exactly the scratch that is asked for.
GuardedImage<Gray8> filled(Size size, const std::vector<Point>& vertices) {
    GuardedImage<Gray8> image = black(size);
    const std::ptrdiff_t edges = fill_polygon_scratch(span_of(vertices).size());
    std::vector<PolygonEdge> scratch(static_cast<std::size_t>(edges));
    EXPECT_EQ(fill_polygon(image.view(), span_of(vertices), 255, {scratch.data(), edges}), Status::ok);
    return image;
}
GuardedImage<Gray8> naive_filled(Size size, const std::vector<Point>& vertices) {
    return naive_shape(size, [&](int x, int y) { return in_polygon(span_of(vertices), {x, y}); });
}
std::vector<Point> random_polygon(Random& random, Size size, int reach, int count) {
    std::vector<Point> vertices;
    for (int i = 0; i < count; ++i) vertices.push_back(random_point(random, size, reach));
    return vertices;
}
int count_of(GuardedImage<Gray8>& image) {
    int count = 0;
    for (int y = 0; y < image.view().height(); ++y)
        for (int x = 0; x < image.view().width(); ++x) count += image(x, y) == 255 ? 1 : 0;
    return count;
}

TEST(DrawPolygon, ReturnsToItsFirstVertex) {
    GuardedImage<Gray8> image = black({5, 4});
    const Point vertices[] = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
    ASSERT_EQ(draw_polygon<Gray8>(image.view(), vertices, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"#####", "#...#", "#...#", "#####"}));
}

TEST(DrawPolygon, OfTwoVerticesIsALineOfOneAPointOfNoneNothing) {
    GuardedImage<Gray8> image = black({3, 2});
    const Point vertices[] = {{0, 0}, {1, 0}};
    ASSERT_EQ(draw_polygon<Gray8>(image.view(), {}, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"...", "..."}));
    ASSERT_EQ(draw_polygon<Gray8>(image.view(), {vertices, 1}, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"#..", "..."}));
    ASSERT_EQ(draw_polygon<Gray8>(image.view(), vertices, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"##.", "..."}));
}

TEST(FillPolygon, HoldsItsLeftAndUpperRimAndNotItsRightAndLower) {
    GuardedImage<Gray8> square = filled({6, 5}, {{1, 1}, {4, 1}, {4, 4}, {1, 4}});
    EXPECT_EQ(picture(square), (Picture{"......", ".###..", ".###..", ".###..", "......"}));
    // Left edge x = y / 2: 0, 0.5, 1, 1.5; right edge x = 4.
    GuardedImage<Gray8> wedge = filled({6, 5}, {{0, 0}, {4, 0}, {4, 4}, {2, 4}});
    EXPECT_EQ(picture(wedge), (Picture{"####..", ".###..", ".###..", "..##..", "......"}));
}

TEST(FillPolygon, LeavesWhatIsCrossedTwice) {
    // Two squares in one polygon, the inner one the other way round, joined by an edge there and back.
    GuardedImage<Gray8> ring =
        filled({7, 7}, {{0, 0}, {7, 0}, {7, 7}, {0, 7}, {0, 0}, {2, 2}, {2, 5}, {5, 5}, {5, 2}, {2, 2}});
    EXPECT_EQ(picture(ring),
              (Picture{"#######", "#######", "##...##", "##...##", "##...##", "#######", "#######"}));
    // A bow tie.
    GuardedImage<Gray8> tie = filled({8, 8}, {{0, 0}, {8, 8}, {8, 0}, {0, 8}});
    EXPECT_EQ(picture(tie), picture(naive_filled({8, 8}, {{0, 0}, {8, 8}, {8, 0}, {0, 8}})));
    EXPECT_EQ(picture(tie)[2], "##....##");
}

// The original drew nothing at all when a vertex lay above the first row.
TEST(FillPolygon, PartlyAboveTheImageIsStillDrawn) {
    // A square of 21 x 21 with 4 rows above: 17 rows of 21 are left.
    GuardedImage<Gray8> square = filled({40, 40}, {{5, -4}, {26, -4}, {26, 17}, {5, 17}});
    EXPECT_EQ(count_of(square), 21 * 17);
    // Left edge 4 - (y + 4) / 2: 2, 1.5, 1, 0.5; right edge 4 + (y + 4) / 2: 6, 6.5, 7, 7.5.
    GuardedImage<Gray8> triangle = filled({9, 5}, {{4, -4}, {8, 4}, {0, 4}});
    EXPECT_EQ(picture(triangle), (Picture{"..####...", "..#####..", ".######..", ".#######.", "........."}));
    GuardedImage<Gray8> outline = black({9, 5});
    const Point vertices[] = {{4, -4}, {8, 4}, {0, 4}};
    ASSERT_EQ(draw_polygon<Gray8>(outline.view(), vertices, 255), Status::ok);
    EXPECT_GT(count_of(outline), 9);
}

TEST(FillPolygon, EqualsTheReferenceNearAndFar) {
    Random random(161);
    for (const Size size : drawing_sizes())
        for (const int reach : distances())
            for (int round = 0; round < 200; ++round) {
                const std::vector<Point> vertices = random_polygon(random, size, reach, random.between(0, 9));
                GuardedImage<Gray8> image = filled(size, vertices);
                ASSERT_EQ(picture(image), picture(naive_filled(size, vertices)))
                    << "round " << round << " reach " << reach << " of " << vertices.size() << " vertices";
            }
}

TEST(FillPolygon, EqualsTheReferenceForThousandsOfVertices) {
    Random random(162);
    const Size size{50, 40};
    const std::vector<Point> star = random_polygon(random, size, 30, 3000);
    GuardedImage<Gray8> image = filled(size, star);
    EXPECT_EQ(picture(image), picture(naive_filled(size, star)));

    // A comb of 1000 teeth, most of them outside.
    std::vector<Point> comb = {{-500, 45}};
    for (int i = 0; i < 1000; ++i) comb.insert(comb.end(), {{-500 + i, i % 7}, {-500 + i, 30 + i % 5}});
    GuardedImage<Gray8> teeth = filled(size, comb);
    EXPECT_EQ(picture(teeth), picture(naive_filled(size, comb)));
}

TEST(FillPolygon, HoldsAtTheEndsOfTheRange) {
    Random random(163);
    const std::vector<int> places = {-far, -far + 1, -1, 0, 3, 7, far - 1, far};
    for (int round = 0; round < 3000; ++round) {
        std::vector<Point> vertices;
        for (int i = 0; i < 5; ++i) {
            const int x = places[random.below(8)];
            const int y = places[random.below(8)];
            vertices.push_back({x, y});
        }
        GuardedImage<Gray8> image = filled({9, 7}, vertices);
        ASSERT_EQ(picture(image), picture(naive_filled({9, 7}, vertices))) << round;
    }
    GuardedImage<Gray8> all = filled({9, 7}, {{-far, -far}, {far, -far}, {far, far}, {-far, far}});
    EXPECT_EQ(picture(all), Picture(7, "#########"));
}

TEST(FillPolygon, NeighboursNeitherOverlapNorLeaveAGap) {
    Random random(164);
    const Size size{40, 30};
    for (int round = 0; round < 500; ++round) {
        // The image cut into triangles around a point: every pixel is in exactly one of them.
        const Point centre = random_point(random, size, 0);
        const Point corners[] = {{-50, -50}, {90, -50}, {90, 80}, {-50, 80}};
        std::vector<int> times(40 * 30, 0);
        for (int i = 0; i < 4; ++i) {
            GuardedImage<Gray8> image = filled(size, {centre, corners[i], corners[(i + 1) % 4]});
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    times[static_cast<std::size_t>(y * 40 + x)] += image(x, y) == 255 ? 1 : 0;
        }
        ASSERT_EQ(std::count(times.begin(), times.end(), 1), 40 * 30);
    }
}

TEST(FillPolygon, IsTheSameFromAnyVertexAndBackwards) {
    Random random(165);
    for (int round = 0; round < 300; ++round) {
        std::vector<Point> vertices = random_polygon(random, {30, 30}, 20, 7);
        const Picture first = picture(filled({30, 30}, vertices));
        std::rotate(vertices.begin(), vertices.begin() + 3, vertices.end());
        ASSERT_EQ(picture(filled({30, 30}, vertices)), first);
        std::reverse(vertices.begin(), vertices.end());
        ASSERT_EQ(picture(filled({30, 30}, vertices)), first);
    }
}

TEST(FillPolygon, WithTheOutlineCoversItsWholeRim) {
    GuardedImage<Gray8> image = filled({6, 5}, {{1, 1}, {4, 1}, {4, 3}, {1, 3}});
    const Point vertices[] = {{1, 1}, {4, 1}, {4, 3}, {1, 3}};
    ASSERT_EQ(draw_polygon<Gray8>(image.view(), vertices, 255), Status::ok);
    EXPECT_EQ(picture(image), (Picture{"......", ".####.", ".####.", ".####.", "......"}));
}

TEST(FillPolygon, DrawsInColour) {
    GuardedImage<Rgb888> image({3, 1});
    image.fill(Rgb888{0, 0, 0});
    const Point vertices[] = {{1, 0}, {2, 0}, {2, 1}, {1, 1}};
    PolygonEdge scratch[4];
    ASSERT_EQ(fill_polygon<Rgb888>(image.view(), vertices, Rgb888{1, 2, 3}, scratch), Status::ok);
    EXPECT_EQ(image(0, 0), (Rgb888{0, 0, 0}));
    EXPECT_EQ(image(1, 0), (Rgb888{1, 2, 3}));
    EXPECT_EQ(image(2, 0), (Rgb888{0, 0, 0}));
}

TEST(Polygons, SayWhatIsWrongAndLeaveTheImage) {
    const Point vertices[] = {{0, 0}, {4, 0}, {4, 4}};
    const Point beyond[] = {{0, 0}, {4, 0}, {4, far + 1}};
    PolygonEdge scratch[3];
    EXPECT_EQ(draw_polygon<Gray8>(ImageView<Gray8>(), beyond, 255), Status::empty_image);
    EXPECT_EQ(fill_polygon<Gray8>(ImageView<Gray8>(), beyond, 255, scratch), Status::empty_image);
    GuardedImage<Gray8> image = black({5, 5});
    EXPECT_EQ(draw_polygon<Gray8>(image.view(), beyond, 255), Status::bad_argument);
    EXPECT_EQ(draw_polygon<Gray8>(image.view(), vertices, 255, 0), Status::bad_argument);
    EXPECT_EQ(fill_polygon<Gray8>(image.view(), beyond, 255, {scratch, 0}), Status::bad_argument);
    EXPECT_EQ(fill_polygon<Gray8>(image.view(), vertices, 255, {scratch, 2}), Status::scratch_too_small);
    EXPECT_EQ(picture(image), Picture(5, "....."));
}

}  // namespace
}  // namespace fovea::test
