// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/polygon_moments.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

PolygonMoments of(const std::vector<FinePoint>& corners, Point origin = {0, 0}) {
    PolygonMoments moments(origin);
    for (std::size_t i = 0; i < corners.size(); ++i)
        moments.add_edge(corners[i], corners[(i + 1) % corners.size()]);
    return moments;
}

TEST(PolygonMoments, OfARectangleByHand) {
    // Clockwise on screen: right, down, left, up. 12 x 6 about (16, 13).
    const std::vector<FinePoint> corners = {fine(10, 10), fine(22, 10), fine(22, 16), fine(10, 16)};
    const CentralMoments c = *of(corners).central();
    EXPECT_EQ(c.area, 72);
    EXPECT_EQ(c.centroid, fine(16, 13));
    EXPECT_EQ(c.mu20.raw(), 72 * 12 * 12 / 12 * 256);
    EXPECT_EQ(c.mu02.raw(), 72 * 6 * 6 / 12 * 256);
    EXPECT_EQ(c.mu11.raw(), 0);
    EXPECT_EQ(c.mu30, 0);
}

TEST(PolygonMoments, OfARightTriangleByHand) {
    // Legs 30 and 60: mu20 = b^2 A / 18, mu02 = h^2 A / 18, mu11 = -b h A / 36, mu30 = b^3 A / 135.
    const std::vector<FinePoint> corners = {fine(0, 0), fine(30, 0), fine(0, 60)};
    const CentralMoments c = *of(corners, {10, 20}).central();
    EXPECT_EQ(c.area, 900);
    EXPECT_EQ(c.centroid, fine(10, 20));
    EXPECT_EQ(c.mu20.raw(), 900 * 900 / 18 * 256);
    EXPECT_EQ(c.mu02.raw(), 3600 * 900 / 18 * 256);
    EXPECT_EQ(c.mu11.raw(), -1800 * 900 / 36 * 256);
    EXPECT_EQ(c.mu30, 27000 * 900 / 135);
    EXPECT_EQ(c.mu03, 216000 * 900 / 135);
}

TEST(PolygonMoments, HolesSubtract) {
    PolygonMoments moments = of({fine(0, 0), fine(30, 0), fine(30, 30), fine(0, 30)}, {10, 10});
    const std::vector<FinePoint> hole = {fine(5, 5), fine(10, 5), fine(10, 10), fine(5, 10)};
    for (std::size_t i = 0; i < 4; ++i) moments.add_edge(hole[i], hole[(i + 1) % 4], -1);
    const CentralMoments c = *moments.central();
    EXPECT_EQ(c.area, 875);
    EXPECT_NEAR(real(c.centroid.x), (900 * 15 - 25 * 7.5) / 875, 1e-5);
}

TEST(PolygonMoments, EqualsTheReferenceAndDoesNotDependOnTheOrigin) {
    Random random(121);
    for (int round = 0; round < 50; ++round) {
        // A star-shaped polygon; the reference splits it into triangles about its middle.
        const int count = random.between(3, 60);
        const double size = uniform(random, 20, 3000);
        std::vector<FinePoint> corners;
        for (int i = 0; i < count; ++i) {
            const double r = uniform(random, 0.4, 1) * size;
            corners.push_back(fine(3500 + std::floor(r * std::cos(2 * pi * i / count) * 256) / 256,
                                   3500 + std::floor(r * std::sin(2 * pi * i / count) * 256) / 256));
        }
        const CentralMoments c = *of(corners, {3500, 3500}).central();
        // 7-point rule of degree 5 in every triangle, exact for third moments.
        const auto integral = [&](auto f) {
            double sum = 0;
            for (int i = 0; i < count; ++i) {
                const FinePoint p = corners[static_cast<std::size_t>(i)];
                const FinePoint q = corners[static_cast<std::size_t>((i + 1) % count)];
                const double ax = real(p.x) - 3500, ay = real(p.y) - 3500;
                const double bx = real(q.x) - 3500, by = real(q.y) - 3500;
                const double area = (ax * by - bx * ay) / 2;
                const double r = std::sqrt(15.0);
                const double u[7] = {1 / 3.0,      (6 - r) / 21,     (9 + 2 * r) / 21, (6 - r) / 21,
                                     (6 + r) / 21, (9 - 2 * r) / 21, (6 + r) / 21};
                const double v[7] = {1 / 3.0,      (6 - r) / 21, (6 - r) / 21,    (9 + 2 * r) / 21,
                                     (6 + r) / 21, (6 + r) / 21, (9 - 2 * r) / 21};
                const double w[7] = {9 / 40.0,         (155 - r) / 1200, (155 - r) / 1200, (155 - r) / 1200,
                                     (155 + r) / 1200, (155 + r) / 1200, (155 + r) / 1200};
                for (int k = 0; k < 7; ++k)
                    sum += area * w[k] * f(u[k] * ax + v[k] * bx, u[k] * ay + v[k] * by);
            }
            return sum;
        };
        const double area = integral([](double, double) { return 1; });
        const double cx = integral([](double x, double) { return x; }) / area;
        const double cy = integral([](double, double y) { return y; }) / area;
        EXPECT_NEAR(real(c.centroid.x), 3500 + cx, 1e-4);
        EXPECT_NEAR(real(c.centroid.y), 3500 + cy, 1e-4);
        const double scale2 = area * size * size;
        const double scale3 = scale2 * size;
        const auto second = [&](SecondMoment m) { return static_cast<double>(m.raw()) / 256; };
        EXPECT_NEAR(second(c.mu20), integral([&](double x, double) { return (x - cx) * (x - cx); }),
                    1e-7 * scale2);
        EXPECT_NEAR(second(c.mu11), integral([&](double x, double y) { return (x - cx) * (y - cy); }),
                    1e-7 * scale2);
        EXPECT_NEAR(static_cast<double>(c.mu30),
                    integral([&](double x, double) { return std::pow(x - cx, 3); }), 1e-6 * scale3);
        EXPECT_NEAR(static_cast<double>(c.mu21),
                    integral([&](double x, double y) { return (x - cx) * (x - cx) * (y - cy); }),
                    1e-6 * scale3);
        EXPECT_NEAR(static_cast<double>(c.mu12),
                    integral([&](double x, double y) { return (x - cx) * (y - cy) * (y - cy); }),
                    1e-6 * scale3);
        EXPECT_NEAR(static_cast<double>(c.mu03),
                    integral([&](double, double y) { return std::pow(y - cy, 3); }), 1e-6 * scale3);
    }
}

TEST(PolygonMoments, NeedAnArea) {
    EXPECT_EQ(PolygonMoments({0, 0}).central().status(), Status::empty_image);
    EXPECT_EQ(of({fine(0, 0), fine(0, 30), fine(30, 0)}).central().status(), Status::empty_image)
        << "the other way round";
}

}  // namespace
}  // namespace fovea::test
