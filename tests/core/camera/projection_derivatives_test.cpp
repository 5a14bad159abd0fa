// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/camera/projection_derivatives.hpp>
#include <support/camera_scene.hpp>

namespace fovea::test {
namespace {

using Place = Vector<3, long double>;
using Seen = Camera<long double>;

/// A camera with all terms, and a point in front of it.
Seen draw(Noise& random, Place& point) {
    const auto some = [&](double low, double high) {
        return static_cast<long double>(random.between(low, high));
    };
    Seen camera;
    camera.fx = some(300, 900);
    camera.fy = some(300, 900);
    camera.cx = some(200, 400);
    camera.cy = some(200, 400);
    camera.k1 = some(-0.3, 0.3);
    camera.k2 = some(-0.1, 0.1);
    camera.k3 = some(-0.1, 0.1);
    camera.p1 = some(-0.01, 0.01);
    camera.p2 = some(-0.01, 0.01);
    point[0] = some(-1, 1);
    point[1] = some(-1, 1);
    point[2] = some(1, 2);
    return camera;
}

TEST(ProjectDerivatives, AreQuotientsOfSmallDifferences) {
    Noise random(31);
    const long double step = 1e-6L;
    for (int i = 0; i < 50; ++i) {
        Place point;
        const Seen camera = draw(random, point);
        ProjectionDerivatives<long double> derivatives;
        ASSERT_EQ(project_derivatives(camera, point, derivatives), Status::ok);
        const auto pixel = *project(camera, point);
        EXPECT_EQ(derivatives.pixel, pixel);
        // Central differences are off by a sixth of the third derivative times the square of the step.
        for (int k = 0; k < camera_terms; ++k) {
            Seen more = camera;
            Seen less = camera;
            term_of(more, static_cast<CameraTerm>(k)) += step;
            term_of(less, static_cast<CameraTerm>(k)) -= step;
            const auto slope = (*project(more, point) - *project(less, point)) * (0.5L / step);
            for (int row = 0; row < 2; ++row)
                EXPECT_NEAR(static_cast<double>(slope[row]),
                            static_cast<double>(derivatives.by_camera(row, k)), 1e-7);
        }
        for (int k = 0; k < 3; ++k) {
            Place more = point;
            Place less = point;
            more[k] += step;
            less[k] -= step;
            const auto slope = (*project(camera, more) - *project(camera, less)) * (0.5L / step);
            for (int row = 0; row < 2; ++row)
                EXPECT_NEAR(static_cast<double>(slope[row]),
                            static_cast<double>(derivatives.by_point(row, k)), 1e-5);
        }
    }
}

TEST(ProjectDerivatives, ByPoseAreQuotientsToo) {
    Noise random(32);
    const long double step = 1e-6L;
    for (int i = 0; i < 50; ++i) {
        Place point;
        const Seen camera = draw(random, point);
        Pose<long double> pose;
        pose.rotation = rotation_about(Place(0.3L, -0.2L, 0.7L));
        const Place world = pose.rotation.transposed() * (point * 0.5L);
        pose.translation = point * 0.5L;
        ProjectionDerivatives<long double> derivatives;
        ASSERT_EQ(project_derivatives(camera, pose(world), derivatives), Status::ok);
        for (int k = 0; k < 6; ++k) {
            Vector<6, long double> change;
            change[k] = step;
            const auto slope = (*project(camera, moved(pose, change), world) -
                                *project(camera, moved(pose, -change), world)) *
                               (0.5L / step);
            for (int row = 0; row < 2; ++row) {
                const auto by = by_pose(derivatives.by_point.row(row), pose.rotation * world);
                EXPECT_NEAR(static_cast<double>(slope[row]), static_cast<double>(by[k]), 1e-5);
            }
        }
    }
}

TEST(ProjectDerivatives, ByHandAndBehindTheCamera) {
    Camera<> camera;
    camera.fx = Real::from_int(500);
    camera.fy = Real::from_int(400);
    const auto whole = [](int x, int y, int z) {
        return Vector<3>(Real::from_int(x), Real::from_int(y), Real::from_int(z));
    };
    // x = 1/2, y = 1/4, r^2 = 5/16.
    ProjectionDerivatives<> derivatives;
    ASSERT_EQ(project_derivatives(camera, whole(2, 1, 4), derivatives), Status::ok);
    EXPECT_EQ(derivatives.pixel, (Vector<2>(Real::from_int(250), Real::from_int(100))));
    EXPECT_EQ(derivatives.by_camera(0, 0), Real::from_int(1, -1));
    EXPECT_EQ(derivatives.by_camera(1, 0), Real());
    EXPECT_EQ(derivatives.by_camera(0, 4), Real::from_ratio(500 * 5, 32));
    EXPECT_EQ(derivatives.by_camera(1, 7), Real::from_ratio(400 * 7, 16));
    EXPECT_EQ(derivatives.by_point(0, 0), Real::from_int(125));
    EXPECT_EQ(derivatives.by_point(0, 2), Real::from_ratio(-125, 2));
    EXPECT_EQ(derivatives.by_point(1, 2), Real::from_int(-25));
    EXPECT_EQ(project_derivatives(camera, whole(2, 1, 0), derivatives), Status::out_of_range);
    EXPECT_EQ(project_derivatives(camera, whole(2, 1, -4), derivatives), Status::out_of_range);
    EXPECT_EQ(derivatives.pixel, (Vector<2>(Real::from_int(250), Real::from_int(100))));
}

}  // namespace
}  // namespace fovea::test
