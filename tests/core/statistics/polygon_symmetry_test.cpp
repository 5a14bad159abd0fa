// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/statistics/polygon_symmetry.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

using Place = std::complex<double>;

Result<RotationalAxis> axis_of(const std::vector<FinePoint>& corners, int order, FinePoint origin = {},
                               PixelAspect aspect = PixelAspect::from_int(1)) {
    PolygonSymmetry symmetry(origin, order, aspect);
    for (std::size_t i = 0; i < corners.size(); ++i)
        symmetry.add_edge(corners[i], corners[(i + 1) % corners.size()]);
    return symmetry.axis();
}
double degrees(FineAngle angle) { return angle.microdegrees() * 1e-6; }
/// How far an angle is from zero, or from the nearest multiple of a part of a turn.
double off(double angle, int order) { return std::abs(std::remainder(angle, 360.0 / order)); }

/// The outline r(angle) about a middle, in many short edges, turned.
template <class Radius>
std::vector<FinePoint> outline(Radius radius, double turn, double x = 0, double y = 0) {
    constexpr int count = 3600;
    std::vector<FinePoint> corners;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * pi * i / count;
        corners.push_back(
            fine(x + radius(angle) * std::cos(angle + turn), y + radius(angle) * std::sin(angle + turn)));
    }
    return corners;
}
/// A regular polygon with the middle of a side at angle 0.
auto regular(int sides, double apothem) {
    return [=](double angle) { return apothem / std::cos(std::remainder(angle, 2 * pi / sides)); };
}

TEST(PolygonSymmetry, OfFourEdgesByHand) {
    // Each edge of a square weighs a quarter of the area in the direction of its middle: 0, 90, 180 and 270
    // degrees, which four times are 0. All of the area points that way, and the least is half of a period
    // off.
    const std::vector<FinePoint> square = {fine(-5, -5), fine(5, -5), fine(5, 5), fine(-5, 5)};
    const Result<RotationalAxis> axis = axis_of(square, 4);
    ASSERT_TRUE(axis.ok());
    EXPECT_EQ(axis->strength, Ratio::from_int(1));
    EXPECT_NEAR(std::abs(degrees(axis->axis)), 45, 1e-6);
    // Three times they are 0, 270, 180 and 90 degrees, whose sum is nothing.
    EXPECT_EQ(axis_of(square, 3).status(), Status::degenerate);
    // Six times 0, 180, 0 and 180.
    EXPECT_EQ(axis_of(square, 6).status(), Status::degenerate);
}

TEST(PolygonSymmetry, OfRegularPolygonsIsTheIntegral) {
    // The integral of cos(4 x) / cos(x)^2 over that of 1 / cos(x)^2, from -45 to 45 degrees, is 3 - pi.
    const Result<RotationalAxis> square = axis_of(outline(regular(4, 50), 0.3), 4);
    ASSERT_TRUE(square.ok());
    EXPECT_NEAR(square->strength.raw() / 65536.0, pi - 3, 1e-4);
    EXPECT_LT(off(degrees(square->axis) - 0.3 * 180 / pi, 4), 1e-3);
    for (int sides = min_symmetry_order; sides <= max_symmetry_order; ++sides)
        for (int order = min_symmetry_order; order <= max_symmetry_order; ++order) {
            const Result<RotationalAxis> axis = axis_of(outline(regular(sides, 50), 0.3), order);
            const double strength = axis ? axis->strength.raw() / 65536.0 : 0;
            if (order == sides) {
                EXPECT_GT(strength, 0.012) << sides;
                EXPECT_LT(off(degrees(axis->axis) - 0.3 * 180 / pi, order), 1e-3) << sides;
            } else if (order % sides != 0) {
                EXPECT_LT(strength, 1e-4) << sides << " sides, order " << order;
            }
        }
    for (int order = min_symmetry_order; order <= max_symmetry_order; ++order)
        EXPECT_EQ(axis_of(outline([](double) { return 50.0; }, 0), order).status(), Status::degenerate);
}

TEST(PolygonSymmetry, EqualsTheReference) {
    Random random(131);
    for (int round = 0; round < 200; ++round) {
        const int order = random.between(min_symmetry_order, max_symmetry_order);
        const int count = random.between(3, 60);
        const double size = uniform(random, 20, 3000);
        const PixelAspect aspect = PixelAspect::from_ratio(random.between(1, 16), 4);
        const double height = aspect.raw() / static_cast<double>(PixelAspect::one);
        const FinePoint middle = fine(uniform(random, 0, 4000), uniform(random, 0, 4000));
        std::vector<FinePoint> corners;
        for (int i = 0; i < count; ++i) {
            const double radius = size * uniform(random, 0.3, 1);
            const double angle = 2 * pi * i / count;
            corners.push_back(
                fine(real(middle.x) + radius * std::cos(angle), real(middle.y) + radius * std::sin(angle)));
        }
        Place sum = 0;
        double area = 0;
        for (int i = 0; i < count; ++i) {
            const auto place = [&](FinePoint p) {
                // To 1/65536 px in the stretched picture, then to 1/256.
                const auto grid = [](double value, double parts) {
                    return std::floor(value * parts + 0.5) / parts;
                };
                const double y = grid((real(p.y) - real(middle.y)) * height, 65536);
                return Place(grid(real(p.x) - real(middle.x), 256), grid(y, 256));
            };
            const Place a = place(corners[static_cast<std::size_t>(i)]);
            const Place b = place(corners[static_cast<std::size_t>((i + 1) % count)]);
            const double twice = a.real() * b.imag() - b.real() * a.imag();
            sum += twice * std::polar(1.0, order * std::arg(a + b));
            area += twice;
        }
        const Result<RotationalAxis> axis = axis_of(corners, order, middle, aspect);
        ASSERT_TRUE(axis.ok()) << round;
        EXPECT_NEAR(axis->strength.raw() / 65536.0, std::abs(sum) / area, 2e-5) << round;
        if (std::abs(sum) / area < 1e-3) continue;
        EXPECT_LT(off(degrees(axis->axis) - (std::arg(sum) * 180 / pi + 180) / order, order), 1e-4) << round;
        // The first direction, not any of the others.
        EXPECT_LE(std::abs(degrees(axis->axis)), 180.0 / order + 1e-6);
    }
}

TEST(PolygonSymmetry, TurnsWithThePolygonAndNotWithItsPlaceOrSize) {
    Random random(132);
    const auto nut = regular(6, 1);
    for (int i = 0; i < 50; ++i) {
        const double turn = uniform(random, -pi, pi);
        const double size = uniform(random, 20, 900);
        const double x = uniform(random, 1000, 6000);
        const double y = uniform(random, 1000, 6000);
        const Result<RotationalAxis> axis =
            axis_of(outline([&](double angle) { return size * nut(angle); }, turn, x, y), 6, fine(x, y));
        ASSERT_TRUE(axis.ok());
        EXPECT_LT(off(degrees(axis->axis) - turn * 180 / pi, 6), 0.01);
        EXPECT_NEAR(axis->strength.raw() / 65536.0, 0.0587, 2e-4);
    }
}

TEST(PolygonSymmetry, HolesSubtract) {
    // A disc with four holes around its middle: the least lies at a hole.
    PolygonSymmetry symmetry(FinePoint(), 4);
    const auto add = [&](const std::vector<FinePoint>& corners, int sign) {
        for (std::size_t i = 0; i < corners.size(); ++i)
            symmetry.add_edge(corners[i], corners[(i + 1) % corners.size()], sign);
    };
    add(outline([](double) { return 100.0; }, 0), 1);
    const double turn = 20 * pi / 180;
    for (int i = 0; i < 4; ++i)
        add(outline([](double) { return 10.0; }, 0, 60 * std::cos(turn + i * pi / 2),
                    60 * std::sin(turn + i * pi / 2)),
            -1);
    const Result<RotationalAxis> axis = symmetry.axis();
    ASSERT_TRUE(axis.ok());
    EXPECT_LT(off(degrees(axis->axis) - 20, 4), 0.01);
    // Every hole has a hundredth of the disc, all in one direction, but for its breadth of up to 10 degrees.
    EXPECT_NEAR(axis->strength.raw() / 65536.0, 0.04 / 0.96, 0.004);
}

TEST(PolygonSymmetry, HasNoneWhereNothingIsEnclosed) {
    EXPECT_EQ(PolygonSymmetry(FinePoint(), 4).axis().status(), Status::empty_image);
    std::vector<FinePoint> backward = outline(regular(4, 50), 0);
    std::reverse(backward.begin(), backward.end());
    EXPECT_EQ(axis_of(backward, 4).status(), Status::empty_image);
}

TEST(PolygonSymmetry, HoldsTheOrderToItsRange) {
    const std::vector<FinePoint> square = outline(regular(4, 50), 0.3);
    const std::vector<FinePoint> triangle = outline(regular(3, 50), 0.3);
    EXPECT_EQ(axis_of(triangle, -7)->axis, axis_of(triangle, min_symmetry_order)->axis);
    EXPECT_EQ(axis_of(square, 1000)->axis, axis_of(square, max_symmetry_order)->axis);
}

TEST(PolygonSymmetry, TakesTheFarthestCorners) {
    const FinePixel most = FinePixel::from_raw(2147483647);
    const FinePixel least = FinePixel::from_raw(-2147483647 - 1);
    const std::vector<FinePoint> corners = {{least, least}, {most, least}, {most, most}, {least, most}};
    const Result<RotationalAxis> axis = axis_of(corners, 4, {most, most}, PixelAspect::from_int(4));
    EXPECT_TRUE(axis.ok());
}

}  // namespace
}  // namespace fovea::test
