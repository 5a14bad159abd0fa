// SPDX-License-Identifier: MIT
#include <fovea/camera/fisheye.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include <support/object_scene.hpp>

namespace fovea::test {
namespace {

FisheyeCamera<> camera_of(double k1, double k2, double k3, double k4) {
    FisheyeCamera<> camera;
    camera.fx = Real::from_int(300);
    camera.fy = Real::from_int(310);
    camera.cx = Real::from_int(640);
    camera.cy = Real::from_int(480);
    camera.k1 = real_of(k1);
    camera.k2 = real_of(k2);
    camera.k3 = real_of(k3);
    camera.k4 = real_of(k4);
    return camera;
}
Vector<3> direction(double angle, double about) {
    return Vector<3>(real_of(std::sin(angle) * std::cos(about)), real_of(std::sin(angle) * std::sin(about)),
                     real_of(std::cos(angle)));
}

TEST(FisheyeLens, IsOpenCvsFormula) {
    // cv::fisheye::projectPoints: a = x / z, b = y / z, theta = atan(r), theta_d / r times a and b.
    Random random(95);
    const FisheyeCamera<> camera = camera_of(-0.0375, 0.0118, -0.0081, 0.0011);
    const FisheyeLens<> lens(camera);
    ASSERT_GT(plain(lens.field()), 1.5);
    for (int i = 0; i < 200; ++i) {
        const double x = random.between(-3000, 3000);
        const double y = random.between(-3000, 3000);
        const double z = random.between(300, 3000);
        const double r = std::sqrt(x * x + y * y) / z;
        const double t = std::atan(r);
        const double t2 = t * t;
        const double d = t * (1 + t2 * (-0.0375 + t2 * (0.0118 + t2 * (-0.0081 + t2 * 0.0011))));
        const auto pixel = lens.project(Vector<3>(real_of(x), real_of(y), real_of(z)));
        ASSERT_TRUE(pixel);
        ASSERT_NEAR(plain((*pixel)[0]), 640 + 300 * d / r * x / z, 1e-11);
        ASSERT_NEAR(plain((*pixel)[1]), 480 + 310 * d / r * y / z, 1e-11);
    }
}

TEST(FisheyeLens, ByHandAndBehindTheCamera) {
    const FisheyeLens<> lens(camera_of(0, 0, 0, 0));
    EXPECT_EQ(lens.field(), pi<Real>());
    const auto right = lens.project(vector_of({5, 0, 0}));
    ASSERT_TRUE(right);
    EXPECT_NEAR(plain((*right)[0]), 640 + 300 * std::acos(-1.0) / 2, 1e-12);
    EXPECT_EQ((*right)[1], Real::from_int(480));
    const auto behind = lens.project(vector_of({0, 1, -1}));
    ASSERT_TRUE(behind);
    EXPECT_NEAR(plain((*behind)[1]), 480 + 310 * std::acos(-1.0) * 3 / 4, 1e-12);
    EXPECT_EQ(*lens.project(vector_of({0, 0, 3})), (Vector<2>(Real::from_int(640), Real::from_int(480))));
    EXPECT_EQ(lens.project(vector_of({0, 0, -3})).status(), Status::out_of_range);
    EXPECT_EQ(lens.project(Vector<3>()).status(), Status::out_of_range);
    EXPECT_EQ(*lens.ray(Vector<2>(Real::from_int(640), Real::from_int(480))), vector_of({0, 0, 1}));
    EXPECT_EQ(lens.ray(Vector<2>(Real::from_int(640 + 950), Real::from_int(480))).status(),
              Status::out_of_range);
    FisheyeCamera<> blind = camera_of(0, 0, 0, 0);
    blind.fy = Real();
    EXPECT_EQ(FisheyeLens<>(blind).ray(Vector<2>()).status(), Status::bad_argument);
}

TEST(FisheyeLens, FindsEveryRayOfItsField) {
    Random random(96);
    for (int i = 0; i < 30; ++i) {
        const auto some = [&](double size) { return size * random.between(-1000, 1000) / 1000; };
        const double k1 = some(0.1);
        const double k2 = some(0.05);
        const double k3 = some(0.02);
        const double k4 = some(0.01);
        const FisheyeLens<> lens(camera_of(k1, k2, k3, k4));
        const double field = plain(lens.field());
        ASSERT_GT(field, 0.8) << i;
        for (int k = 0; k < 30; ++k) {
            // Up to the very edge.
            const double angle = field * (k < 3 ? 1 : random.between(0, 1000) / 1000.0);
            const Vector<3> wanted = direction(angle * (1 - 1e-12), some(3.1));
            const auto pixel = lens.project(wanted);
            ASSERT_TRUE(pixel) << i << " " << k;
            const auto ray = lens.ray(*pixel);
            ASSERT_TRUE(ray) << i << " " << k;
            ASSERT_NEAR(plain(length_of(*ray)), 1, 1e-16);
            // At the edge the slope may be 0, and the angle as uncertain as the root of what is left.
            ASSERT_LE(plain(length_of(*ray - wanted)), angle < 0.99 * field ? 1e-12 : 1e-7) << i << " " << k;
        }
    }
}

TEST(FisheyeLens, ItsFieldEndsBeforeTheFirstFold) {
    // The slope 1 - a^2 ends at 1 radian; and polynomials that fold and straighten again.
    EXPECT_NEAR(plain(FisheyeLens<>(camera_of(-1.0 / 3, 0, 0, 0)).field()), 1, 1e-8);
    // The last but grazes 0, between two of the first strides.
    const double square = (1 + 1.0 / 128) * (1 + 1.0 / 128);
    const double grazing = 1 - 1.2e-4;
    const double lenses[4][4] = {{-0.68, 0.2, 0, 0},
                                 {-0.3, 0.02, 0.004, 0.0002},
                                 {-0.35, 0.06, -0.004, 0.0001},
                                 {-2 / (3 * square * grazing), 1 / (5 * square * square * grazing), 0, 0}};
    for (const auto& k : lenses) {
        const FisheyeLens<> lens(camera_of(k[0], k[1], k[2], k[3]));
        double fold = 0;
        for (; fold < 3.2; fold += 1e-5) {
            const double s = fold * fold;
            if (1 + s * (3 * k[0] + s * (5 * k[1] + s * (7 * k[2] + s * 9 * k[3]))) <= 0) break;
        }
        ASSERT_LT(fold, 3);
        EXPECT_LE(plain(lens.field()), fold);
        EXPECT_GE(plain(lens.field()), fold - 2e-5);
        EXPECT_EQ(lens.project(direction(fold + 1e-4, 1)).status(), Status::out_of_range);
    }
    EXPECT_EQ(FisheyeLens<>(camera_of(-1e9, 0, 0, 0)).ray(Vector<2>()).status(), Status::out_of_range);
}

}  // namespace
}  // namespace fovea::test
