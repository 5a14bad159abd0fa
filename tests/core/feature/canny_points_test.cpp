// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/feature/canny.hpp>
#include <fovea/feature/canny_points.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

struct Points {
    std::vector<EdgePoint> room;
    int count = 0;

    explicit Points(int capacity) : room(static_cast<std::size_t>(capacity)) {}
    ListView<EdgePoint> list() { return {room.data(), static_cast<int>(room.size()), &count}; }
};

GuardedImage<Gray8> edges_of(GuardedImage<Gray8>& src, int low, int high) {
    GuardedImage<Gray8> dst(src.view().size());
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(canny_scratch(src.view().size())));
    EXPECT_EQ(canny(src.view(), low, high, Border::replicate,
                    {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, dst.view()),
              Status::ok);
    return dst;
}

/// The mean brightness of a pixel beside a straight edge at x cos + y sin = distance, from 8x8 samples,
/// blurred by a Gaussian.
void fill_edge(GuardedImage<Gray8>& image, double degrees, double distance, double blur) {
    const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
    for (int y = 0; y < image.view().height(); ++y)
        for (int x = 0; x < image.view().width(); ++x) {
            double sum = 0;
            for (int j = 0; j < 8; ++j)
                for (int i = 0; i < 8; ++i) {
                    const double u = x + (i - 3.5) / 8, v = y + (j - 3.5) / 8;
                    sum += 40 + 80 * (1 + std::erf((u * c + v * s - distance) / blur / std::sqrt(2.0)));
                }
            image(x, y) = static_cast<Gray8>(std::lround(sum / 64));
        }
}

/// Mean distance of the points from the edge they were made of, away from the rim.
double mean_error(double degrees, double distance, double blur) {
    const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
    GuardedImage<Gray8> src({48, 48});
    fill_edge(src, degrees, distance, blur);
    GuardedImage<Gray8> edges = edges_of(src, 100, 200);
    Points points(400);
    EXPECT_EQ(canny_points(src.view(), edges.view(), Border::replicate, points.list()), Status::ok);
    double error = 0;
    int used = 0;
    for (int i = 0; i < points.count; ++i) {
        const EdgePoint& point = points.room[static_cast<std::size_t>(i)];
        if (point.pixel.x < 4 || point.pixel.y < 4 || point.pixel.x > 43 || point.pixel.y > 43) continue;
        error += std::abs(point.place.x.raw() / 256.0 * c + point.place.y.raw() / 256.0 * s - distance);
        const double turn = point.gradient.signed_raw() * 360.0 / 65536 - degrees;
        // Sobel's direction is off by 2 degrees at most on a blurred edge.
        EXPECT_LT(std::abs(std::remainder(turn, 360)), 3);
        ++used;
    }
    EXPECT_GT(used, 25);
    return error / used;
}

TEST(CannyPoints, PutsAStepBetweenItsColumns) {
    GuardedImage<Gray8> src({9, 5});
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) src(x, y) = x < 5 ? 10 : 110;
    GuardedImage<Gray8> edges = edges_of(src, 100, 300);
    Points points(10);
    ASSERT_EQ(canny_points(src.view(), edges.view(), Border::replicate, points.list()), Status::ok);
    ASSERT_EQ(points.count, 5);
    for (int y = 0; y < 5; ++y) {
        const EdgePoint& point = points.room[static_cast<std::size_t>(y)];
        // Strengths 0, 400, 400: the summit is half a pixel to the right.
        EXPECT_EQ(point.place.x.raw(), 4 * 256 + 128);
        EXPECT_EQ(point.place.y.raw(), y * 256);
        EXPECT_EQ(point.pixel, (Point{4, y}));
        EXPECT_EQ(point.gradient, Angle());
        EXPECT_EQ(point.strength, 400);
    }
}

TEST(CannyPoints, LieOnADiagonalEdgeWhichTheToolkitMissedByARootOfTwo) {
    // The toolkit's mean error in x + y was 0.17 px, and 0.04 px with the right step; across the edge that is
    // less by the root of 2.
    for (const double degrees : {45.0, -45.0, 135.0, 225.0})
        for (int tenths = 0; tenths < 10; ++tenths) {
            const double turned = degrees * M_PI / 180;
            const double distance = 24 * (std::cos(turned) + std::sin(turned)) + tenths / 10.0;
            EXPECT_LT(mean_error(degrees, distance, 0.8), 0.04 / std::sqrt(2.0)) << degrees << " " << tenths;
        }
}

TEST(CannyPoints, LieOnBlurredEdgesOfEveryDirection) {
    for (const double blur : {0.5, 1.0, 1.5})
        for (int degrees = 0; degrees < 360; degrees += 7) {
            const double turned = degrees * M_PI / 180;
            // Rounding of a grey level is 1/160 of the step; the rest is a margin of two.
            EXPECT_LT(mean_error(degrees, 24.3 * (std::cos(turned) + std::sin(turned)), blur), 0.025)
                << degrees << " " << blur;
        }
}

TEST(CannyPoints, TakeLogarithmsThatAreRightTo2ToTheMinus15) {
    // Half a unit of the table, 0.9 of the straight line, half of rounding.
    for (int strength = 1; strength <= 2047; ++strength)
        ASSERT_NEAR(detail::logarithm(strength) / 65536.0, std::log2(strength), 2.0 / 65536) << strength;
}

TEST(CannyPoints, KeepTheStrongestInOrderOfRowsWhereTheListIsFull) {
    Random random(3);
    GuardedImage<Gray8> src({64, 40});
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 64; ++x)
            src(x, y) = static_cast<Gray8>((x / 8 * 67 + y / 6 * 45) % 200 + random.between(0, 9));
    GuardedImage<Gray8> edges = edges_of(src, 40, 80);
    Points all(2000);
    ASSERT_EQ(canny_points(src.view(), edges.view(), Border::replicate, all.list()), Status::ok);
    ASSERT_GT(all.count, 200);
    std::vector<EdgePoint> ranked(all.room.begin(), all.room.begin() + all.count);
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const EdgePoint& a, const EdgePoint& b) { return a.strength > b.strength; });
    for (const int capacity : {1, 2, 3, 100, 157}) {
        std::vector<EdgePoint> expected(ranked.begin(), ranked.begin() + capacity);
        std::sort(expected.begin(), expected.end(), [](const EdgePoint& a, const EdgePoint& b) {
            return a.pixel.y != b.pixel.y ? a.pixel.y < b.pixel.y : a.pixel.x < b.pixel.x;
        });
        Points some(capacity);
        ASSERT_EQ(canny_points(src.view(), edges.view(), Border::replicate, some.list()),
                  Status::capacity_exceeded);
        ASSERT_EQ(some.count, capacity);
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(some.room[i].pixel, expected[i].pixel) << capacity << " " << i;
    }
}

TEST(CannyPoints, StayWithinHalfAPixelWhateverTheEdgesAre) {
    Random random(4);
    for (const Size size : test_sizes())
        for (const Border border : {Border::replicate, Border::reflect_101, Border::zero}) {
            GuardedImage<Gray8> src(size), edges(size);
            src.fill(random);
            edges.fill(Gray8{1});
            Points points(static_cast<int>(size.area()));
            ASSERT_EQ(canny_points(src.view(), edges.view(), border, points.list()), Status::ok);
            ASSERT_EQ(points.count, size.area());
            for (const EdgePoint& point : points.room) {
                ASSERT_LE(std::abs(point.place.x.raw() - 256 * point.pixel.x), 128);
                ASSERT_LE(std::abs(point.place.y.raw() - 256 * point.pixel.y), 128);
            }
        }
}

TEST(CannyPoints, SayWhatIsWrongAndLeaveTheList) {
    GuardedImage<Gray8> src({8, 8}), edges({8, 7});
    src.fill(Gray8{1});
    edges.fill(Gray8{1});
    Points points(3);
    points.count = 2;
    EXPECT_EQ(canny_points({}, edges.view(), Border::replicate, points.list()), Status::empty_image);
    EXPECT_EQ(canny_points(src.view(), edges.view(), Border::replicate, points.list()),
              Status::size_mismatch);
    EXPECT_EQ(points.count, 2);
    points.room.clear();
    GuardedImage<Gray8> fitting({8, 8});
    fitting.fill(Gray8{1});
    EXPECT_EQ(canny_points(src.view(), fitting.view(), Border::replicate, points.list()),
              Status::capacity_exceeded);
    EXPECT_EQ(points.count, 0);
}

}  // namespace
}  // namespace fovea::test
