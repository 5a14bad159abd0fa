// SPDX-License-Identifier: MIT
//
// Poses from rays: of three points, and of many by POSIT; the cubic root that the first needs.
#include <fovea/camera/p3p.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <fovea/camera/posit.hpp>
#include <fovea/camera/rays.hpp>
#include <fovea/linear/cubic.hpp>
#include <support/object_scene.hpp>

namespace fovea::test {
namespace {

/// The largest sine between a ray and where a pose puts its point.
double off_rays(const Pose<>& pose, const std::vector<SpacePoint>& points,
                const std::vector<Vector<3>>& rays) {
    double most = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector<3> place = pose(vector_of(points[i]));
        const Real size = length_of(place) * length_of(rays[i]);
        most = std::fmax(most, plain(length_of(cross(place, rays[i])) / size));
        if (!dot(place, rays[i]).positive()) most = 2;
    }
    return most;
}

/// All solutions are on their rays, and one of them is the pose. Answers how far the nearest is.
double nearest_solution(const Pose<>& pose, const std::vector<SpacePoint>& points, double off = 1e-15) {
    const auto rays = rays_to(pose, points);
    const auto found = p3p(span_of(points), span_of(rays));
    EXPECT_TRUE(found);
    if (!found) return 2;
    double least = 2;
    for (int i = 0; i < found->count; ++i) {
        EXPECT_LE(off_rays(found->poses[i], points, rays), off);
        EXPECT_LE(
            (exponent_of_difference<3, 3>(found->poses[i].rotation * found->poses[i].rotation.transposed(),
                                          Matrix<3, 3>::identity())),
            -58);
        EXPECT_GT(plain(determinant(found->poses[i].rotation)), 0.5);
        least = std::fmin(least, difference(found->poses[i], pose));
    }
    return least;
}

TEST(CubicRootAlone, IsTheRootFarthestFromTheOthers) {
    const auto root = [](int a, int b, int c) {
        return plain(cubic_root_alone(Real::from_int(a), Real::from_int(b), Real::from_int(c)));
    };
    EXPECT_EQ(root(-6, 11, -6), 3);     // 1, 2, 3: the larger of two
    EXPECT_EQ(root(-13, 32, -20), 10);  // 1, 2, 10
    EXPECT_EQ(root(7, -28, 20), -10);   // 1, 2, -10
    EXPECT_EQ(root(0, 0, 0), 0);
    EXPECT_EQ(root(0, 0, -27), 3);
    EXPECT_EQ(root(0, 0, 27), -3);
    EXPECT_NEAR(root(0, 1000000, -1), 1e-6, 1e-20);  // nearly a line
    EXPECT_NEAR(root(3, 3, 1), -1, 1e-5);            // threefold
    EXPECT_NEAR(root(-1000000, 1, -1), 1e6, 1e-5);   // one far away
}

TEST(CubicRootAlone, OfRandomCubics) {
    Random random(71);
    for (int i = 0; i < 300; ++i) {
        Real c[3];
        for (Real& number : c)
            number = Real::from_int(random.between(-1000000, 1000000), -random.between(0, 40));
        const Real x = cubic_root_alone(c[0], c[1], c[2]);
        const Real sizes =
            x.absolute() * x * x + c[0].absolute() * x * x + c[1].absolute() * x.absolute() + c[2].absolute();
        const Real left = c[2] + x * (c[1] + x * (c[0] + x));
        ASSERT_LE(left.absolute(), sizes.absolute().scaled(-58)) << i;
    }
}

TEST(P3p, OfATriangleStraightAhead) {
    // An equilateral triangle is seen alike in four poses: upright, and tilted about each of its sides.
    const std::vector<SpacePoint> points = {{0, 1000, 0}, {866, -500, 0}, {-866, -500, 0}};
    const Pose<> pose{Matrix<3, 3>::identity(), Vector<3>(Real(), Real(), Real::from_int(2000))};
    EXPECT_LE(nearest_solution(pose, points), 1e-14);
    const auto rays = rays_to(pose, points);
    EXPECT_EQ(p3p(span_of(points), span_of(rays))->count, 4);
}

TEST(P3p, FindsThePoseOfEveryRandomTriangle) {
    Random random(72);
    int counts[5] = {};
    for (int i = 0; i < 300; ++i) {
        const auto points = random_object(random, 3, 1000);
        if (*spread_of(span_of(points)) != PointSpread::plane) continue;
        // Every second through a very long lens.
        const Pose<> pose = random_pose(random, i % 2 == 0 ? random.between(2500, 5000) : 40000000);
        ASSERT_LE(nearest_solution(pose, points), 1e-11) << i;
        const auto rays = rays_to(pose, points);
        ++counts[p3p(span_of(points), span_of(rays))->count];
    }
    EXPECT_GT(counts[2], 100);
    EXPECT_GT(counts[4], 3);
}

TEST(P3p, LooksThroughTrianglesFromTheirPlane) {
    // The camera in the plane of the points, and a point in front of another.
    const std::vector<SpacePoint> points = {{-300, 0, 0}, {400, 0, 200}, {50, 0, 700}};
    const Pose<> pose{Matrix<3, 3>::identity(), Vector<3>(Real::from_int(20), Real(), Real::from_int(1500))};
    EXPECT_LE(nearest_solution(pose, points, 1e-8), 1e-6);
    const Pose<> hidden{Matrix<3, 3>::identity(), Vector<3>(Real(), Real(), Real::from_int(1000))};
    const std::vector<SpacePoint> line_of_sight = {{0, 0, 0}, {0, 0, 500}, {300, 100, 0}};
    const auto rays = rays_to(hidden, line_of_sight);
    EXPECT_EQ(p3p(span_of(line_of_sight), span_of(rays)).status(), Status::degenerate);
}

TEST(P3p, OnTheDangerousCylinderKnowsHalfOfTheDigits) {
    // The circle through the points has radius 500 about the origin; the camera is straight above a place of
    // it, where two solutions meet.
    const std::vector<SpacePoint> points = {{500, 0, 0}, {-300, 400, 0}, {-300, -400, 0}};
    for (const double angle : {0.3, 1.1, 2.6, 4.0}) {
        const Vector<3> centre(real_of(500 * std::cos(angle)), real_of(500 * std::sin(angle)),
                               Real::from_int(-1300));
        const Pose<> pose{Matrix<3, 3>::identity(), -centre};
        EXPECT_LE(nearest_solution(pose, points, 1e-9), 1e-6) << angle;
    }
}

TEST(P3p, TellsNothingThatIsOffItsRays) {
    // Rays that belong to no triangle, or to one by chance.
    Random random(75);
    int counts[5] = {};
    for (int i = 0; i < 600; ++i) {
        const auto points = random_object(random, 3, 1000);
        if (*spread_of(span_of(points)) != PointSpread::plane) continue;
        std::vector<Vector<3>> rays;
        for (int k = 0; k < 3; ++k) rays.push_back(random_matrix<3, 1>(random));
        const auto found = p3p(span_of(points), span_of(rays));
        if (!found) {
            ASSERT_EQ(found.status(), Status::not_found);
            ++counts[0];
            continue;
        }
        ++counts[found->count];
        for (int k = 0; k < found->count; ++k) ASSERT_LE(off_rays(found->poses[k], points, rays), 1e-5) << i;
    }
    for (int count = 0; count < 3; ++count) EXPECT_GT(counts[count], 0) << count;
}

TEST(P3p, RefusesByName) {
    const std::vector<SpacePoint> points = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}};
    std::vector<Vector<3>> rays = rays_to({Matrix<3, 3>::identity(), vector_of({0, 0, 300})}, points);
    ASSERT_TRUE(p3p(span_of(points), span_of(rays)));
    EXPECT_EQ(p3p(span_of(points).first(2), span_of(rays)).status(), Status::bad_argument);
    EXPECT_EQ(p3p(Span<const SpacePoint>(), Span<const Vector<3>>()).status(), Status::bad_argument);
    const std::vector<SpacePoint> line = {{0, 0, 0}, {100, 0, 50}, {200, 0, 100}};
    EXPECT_EQ(p3p(span_of(line), span_of(rays)).status(), Status::degenerate);
    rays[1] = Vector<3>();
    EXPECT_EQ(p3p(span_of(points), span_of(rays)).status(), Status::bad_argument);
    rays[1] = rays[0] * Real::from_int(3);
    EXPECT_EQ(p3p(span_of(points), span_of(rays)).status(), Status::degenerate);
    // Rays to all sides: no triangle is seen so.
    rays = {vector_of({0, 0, 1}), vector_of({1, 0, -1}), vector_of({-1, 0, -1})};
    const auto nothing =
        p3p(span_of(std::vector<SpacePoint>{{0, 0, 0}, {1, 0, 0}, {1000, 900, 0}}), span_of(rays));
    EXPECT_EQ(nothing.status(), Status::not_found);
}

TEST(Posit, FindsPosesWithoutAStart) {
    Random random(73);
    for (int i = 0; i < 40; ++i) {
        const auto points = random_object(random, 5 + i % 12, 1000);
        const Pose<> pose = random_pose(random, 8000 + 500 * i);
        const auto rays = rays_to(pose, points);
        const auto found = posit(span_of(points), span_of(rays));
        ASSERT_TRUE(found) << i;
        ASSERT_LE(difference(*found, pose), 1e-13) << i;
        // The same in long double.
        std::vector<Vector<3, long double>> wide;
        for (const Vector<3>& ray : rays) {
            wide.emplace_back();
            for (int k = 0; k < 3; ++k) wide.back()[k] = value_of(ray[k]);
        }
        const auto same = posit<long double>(span_of(points), span_of(wide));
        ASSERT_TRUE(same);
        for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(plain(found->translation[k]), static_cast<double>(same->translation[k]), 1e-10);
    }
}

TEST(Posit, RefusesByName) {
    Random random(74);
    auto points = random_object(random, 8, 1000);
    const Pose<> pose = random_pose(random, 9000);
    auto rays = rays_to(pose, points);
    const auto status = [&] { return posit(span_of(points), span_of(rays)).status(); };
    EXPECT_EQ(status(), Status::ok);
    EXPECT_EQ(posit(span_of(points).first(3), span_of(rays).first(3)).status(), Status::bad_argument);
    EXPECT_EQ(posit(span_of(points).first(4), span_of(rays)).status(), Status::size_mismatch);
    rays[3][2] = Real();
    EXPECT_EQ(status(), Status::out_of_range);
    for (SpacePoint& point : points) point.z = 3 * point.x - point.y;
    rays = rays_to({Matrix<3, 3>::identity(), vector_of({0, 0, 90000})}, points);
    EXPECT_EQ(status(), Status::degenerate);
    // A sheet: its products have an inverse, but it tells nothing.
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = {random.between(-1000000, 1000000), random.between(-1000000, 1000000),
                     static_cast<std::int32_t>(i % 2)};
    rays = rays_to({Matrix<3, 3>::identity(), vector_of({0, 0, 9000000})}, points);
    EXPECT_EQ(status(), Status::degenerate);
    // Inside of the object there is no scaled projection to start from: it does not settle, or not in front.
    points = {{0, 0, 0}, {1000, 0, 100}, {0, 1000, -100}, {-1000, -900, 0}, {300, 200, 1000}};
    rays = rays_to({Matrix<3, 3>::identity(), vector_of({0, 0, 150})}, points);
    EXPECT_NE(status(), Status::ok);
}

TEST(RaysOf, AreThoseOfTheLens) {
    const Camera<> camera = usual_camera(true);
    const LensInverse<> lens(camera);
    const SubPixelPoint pixels[2] = {{SubPixel::from_int(17), SubPixel::from_int(400)},
                                     {SubPixel::from_raw(81234), SubPixel::from_raw(777)}};
    Vector<3> rays[2];
    ASSERT_EQ(rays_of(lens, Span<const SubPixelPoint>(pixels), Span<Vector<3>>(rays)), Status::ok);
    EXPECT_EQ(rays[1], *lens.ray(Vector<2>(Real::from_int(81234, -8), Real::from_int(777, -8))));
    EXPECT_EQ(rays_of(lens, Span<const SubPixelPoint>(pixels), Span<Vector<3>>(rays, 1)),
              Status::size_mismatch);
    FisheyeCamera<> round;
    round.fx = round.fy = Real::from_int(200);
    ASSERT_EQ(rays_of(FisheyeLens<>(round), Span<const SubPixelPoint>(pixels), Span<Vector<3>>(rays)),
              Status::ok);
    EXPECT_NEAR(plain(length_of(rays[0])), 1, 1e-17);
    EXPECT_EQ(
        rays_of(FisheyeLens<>(FisheyeCamera<>()), Span<const SubPixelPoint>(pixels), Span<Vector<3>>(rays)),
        Status::out_of_range);
}

}  // namespace
}  // namespace fovea::test
