// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include <fovea/measure/half_turn.hpp>
#include <support/render.hpp>

namespace fovea::test {
namespace {

/// The pixels whose centre lies in a shape, turned by an angle about (300, 300).
Moments region(double angle, const std::function<bool(double, double)>& inside) {
    Moments moments;
    for (int y = 0; y < 600; ++y)
        for (int x = 0; x < 600; ++x) {
            const double u = x - 300.0;
            const double v = y - 300.0;
            if (inside(u * std::cos(angle) + v * std::sin(angle), v * std::cos(angle) - u * std::sin(angle)))
                moments.add_run(x, x + 1, y);
        }
    return moments;
}

bool wedge(double s, double t) { return s > -100 && s < 100 && std::abs(t) < 20 + 0.15 * (s + 100); }
bool triangle(double s, double t) { return s > -150 && s < 100 && std::abs(t) < 0.3 * (s + 150); }
bool plate_with_hole(double s, double t) {
    return std::abs(s) < 100 && std::abs(t) < 40 && std::hypot(s - 60, t) > 12;
}
bool brick(double s, double t) { return std::abs(s) < 100 && std::abs(t) < 30; }
/// Symmetric along s, but heavier on one side of t.
bool bracket(double s, double t) { return std::abs(s) < 100 && t > -30 && t < (std::abs(s) > 70 ? 60 : -10); }

FineAngle angle_of_radians(double angle) {
    return FineAngle::from_microdegrees(static_cast<std::int64_t>(std::llround(angle * 180e6 / pi)));
}
Asymmetry measure(const std::function<bool(double, double)>& shape, double angle) {
    return *asymmetry(*central_moments(region(angle, shape)), angle_of_radians(angle));
}

TEST(Asymmetry, IsTheThirdMomentByHand) {
    // Pixels 0, 1 and 5 of a row: centroid 2, squares 4 + 1 + 9, cubes -8 - 1 + 27.
    Moments moments;
    moments.add_run(0, 2, 0);
    moments.add_run(5, 6, 0);
    const Asymmetry result = *asymmetry(*central_moments(moments), FineAngle());
    EXPECT_NEAR(result.sss.raw() / 65536.0, 18 / (14 * std::sqrt(14 / 3.0)), 2e-5);
    EXPECT_EQ(result.stt.raw(), 0);
    const Asymmetry back = *asymmetry(*central_moments(moments), FineAngle::half_turn());
    EXPECT_EQ(back.sss.raw(), -result.sss.raw());
    const Asymmetry quarter = *asymmetry(*central_moments(moments), FineAngle::quarter_turn());
    EXPECT_NEAR(quarter.ttt.raw(), -result.sss.raw(), 2);
}

TEST(Asymmetry, EqualsTheReferenceAtAnyAngle) {
    Random random(101);
    for (int round = 0; round < 30; ++round) {
        const double turn = uniform(random, -pi, pi);
        const double angle = uniform(random, -pi, pi);
        const Moments moments = region(turn, round % 2 == 0 ? wedge : bracket);
        const double area = static_cast<double>(moments.m00);
        const double cx = static_cast<double>(moments.m10) / area;
        const double cy = static_cast<double>(moments.m01) / area;
        double sums[5] = {0, 0, 0, 0, 0};
        for (int y = 0; y < 600; ++y)
            for (int x = 0; x < 600; ++x) {
                const double u = x - 300.0;
                const double v = y - 300.0;
                const double a = u * std::cos(turn) + v * std::sin(turn);
                const double b = v * std::cos(turn) - u * std::sin(turn);
                if (!(round % 2 == 0 ? wedge(a, b) : bracket(a, b))) continue;
                const double s = (x - cx) * std::cos(angle) + (y - cy) * std::sin(angle);
                const double t = (y - cy) * std::cos(angle) - (x - cx) * std::sin(angle);
                sums[0] += s * s * s;
                sums[1] += s * s * t;
                sums[2] += s * t * t;
                sums[3] += t * t * t;
                sums[4] += s * s + t * t;
            }
        const double scale = sums[4] * std::sqrt(sums[4] / area);
        const Asymmetry found = *asymmetry(*central_moments(moments), angle_of_radians(angle));
        const Ratio parts[] = {found.sss, found.sst, found.stt, found.ttt};
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(parts[i].raw() / 65536.0, sums[i] / scale, 1e-4);
    }
}

TEST(HalfTurn, FollowsTheTaughtPartAtAnyAngle) {
    for (const auto& shape : {wedge, plate_with_hole, bracket}) {
        const Asymmetry taught = measure(shape, 0.3);
        for (int i = 0; i < 24; ++i) {
            const double angle = i * 0.27;
            const Result<HalfTurn> same = half_turn(measure(shape, angle), taught);
            ASSERT_TRUE(same.ok()) << i;
            EXPECT_FALSE(same->turned);
            EXPECT_GT(same->margin.raw(), Ratio::one * 8 / 10);
            const Asymmetry back = *asymmetry(*central_moments(region(angle, shape)),
                                              angle_of_radians(angle) + FineAngle::half_turn());
            EXPECT_TRUE(half_turn(back, taught)->turned);
        }
    }
}

TEST(HalfTurn, WithoutATaughtPartTheFarEndLeads) {
    // The tip of the triangle is at -s; the legs of the bracket point along +t.
    EXPECT_TRUE(half_turn(measure(triangle, 0.4))->turned);
    EXPECT_FALSE(half_turn(measure(bracket, 0.4))->turned);
    const Moments moments = region(0.4, triangle);
    const FineAngle back = angle_of_radians(0.4) + FineAngle::half_turn();
    EXPECT_FALSE(half_turn(*asymmetry(*central_moments(moments), back))->turned);
}

TEST(HalfTurn, NeverGuessesOnAPartThatLooksTheSame) {
    for (int i = 0; i < 24; ++i) EXPECT_EQ(half_turn(measure(brick, i * 0.27)).status(), Status::undecided);
    EXPECT_EQ(half_turn(measure(wedge, 0), measure(brick, 0)).status(), Status::undecided);
    EXPECT_EQ(half_turn(measure(brick, 0), measure(wedge, 0)).status(), Status::undecided);
}

TEST(HalfTurn, NeverGuessesOnAnotherPart) {
    EXPECT_EQ(half_turn(measure(bracket, 0), measure(wedge, 0)).status(), Status::undecided);
}

TEST(Asymmetry, NeedsMoreThanAPixel) {
    Moments moments;
    moments.add_run(3, 4, 3);
    EXPECT_EQ(asymmetry(*central_moments(moments), FineAngle()).status(), Status::degenerate);
}

}  // namespace
}  // namespace fovea::test
