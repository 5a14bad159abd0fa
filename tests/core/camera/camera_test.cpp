// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/camera/camera.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/camera/pose.hpp>
#include <support/random_matrix.hpp>

namespace fovea::test {
namespace {

double plain(Real number) { return static_cast<double>(value_of(number)); }
Vector<2> pixel(double u, double v) { return Vector<2>(real_of(u), real_of(v)); }

/// The left camera with a lens of 4 mm of the toolkit's file for its distorted pictures.
Camera<> toolkit_camera() {
    return {real_of(532.4691162109),
            real_of(530.2947998047),
            real_of(338.1228942871),
            real_of(238.8942871094),
            real_of(-0.4175221026),
            real_of(0.1891709864),
            Real(),
            real_of(0.0003914383),
            real_of(-0.0011864222)};
}

TEST(Pose, GoesThereAndBack) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const Pose<> a{rotation_about(random_matrix<3, 1>(random)), random_matrix<3, 1>(random)};
        const Pose<> b{rotation_about(random_matrix<3, 1>(random)), random_matrix<3, 1>(random)};
        const auto x = random_matrix<3, 1>(random);
        ASSERT_LE(
            (exponent_of_difference<3, 3>(a.rotation * a.rotation.transposed(), Matrix<3, 3>::identity())),
            -60);
        ASSERT_LE((determinant(a.rotation) - Real::one()).absolute(), Real::from_int(1, -60));
        ASSERT_LE((exponent_of_difference<3, 1>(compose(a, b)(x), a(b(x)))), -59);
        ASSERT_LE((exponent_of_difference<3, 1>(inverse(a)(a(x)), x)), -59);
    }
    EXPECT_EQ((Pose<>()(Vector<3>(Real::one(), Real(), Real()))), (Vector<3>(Real::one(), Real(), Real())));
}

TEST(RotationAbout, TurnsByTheAngleOfItsTangent) {
    // The tangent of half of 90 degrees is 1: x goes to y about z.
    const Real one = Real::one();
    const Matrix<3, 3> quarter = rotation_about(Vector<3>(Real(), Real(), Real::from_int(2)));
    EXPECT_EQ(quarter, (Matrix<3, 3>(Real(), -one, Real(), one, Real(), Real(), Real(), Real(), one)));
    EXPECT_EQ(rotation_about(Vector<3>()), (Matrix<3, 3>::identity()));
    // The axis stays where it is.
    const Vector<3> axis(one, Real::from_int(-3), Real::from_ratio(1, 7));
    EXPECT_LE((exponent_of_difference<3, 1>(rotation_about(axis) * axis, axis)), -59);
}

TEST(Project, ByHand) {
    Camera<> camera;
    camera.fx = Real::from_int(500);
    camera.fy = Real::from_int(400);
    camera.cx = Real::from_int(320);
    camera.cy = Real::from_int(240);
    const auto whole = [](int x, int y, int z) {
        return Vector<3>(Real::from_int(x), Real::from_int(y), Real::from_int(z));
    };
    EXPECT_EQ(*project(camera, whole(1, -1, 4)), (Vector<2>(Real::from_int(445), Real::from_int(140))));
    // x = 1/2, y = 0: r^2 = 1/4, radial 1 + 1/4 + 1/8 + 1/64, tangential p1 0 and p2 (1/4 + 1/2).
    camera.k1 = Real::one();
    camera.k2 = Real::from_int(2);
    camera.k3 = Real::one();
    camera.p1 = Real::from_ratio(1, 4);
    camera.p2 = Real::from_ratio(1, 2);
    const Vector<2> place =
        *project(camera, Pose<>{Matrix<3, 3>::identity(), whole(0, 0, 2)}, whole(1, 0, 0));
    EXPECT_EQ(place[0], Real::from_int(320) + Real::from_int(500) * Real::from_ratio(89 + 48, 128));
    EXPECT_EQ(place[1], Real::from_int(240) + Real::from_int(400) * Real::from_ratio(1, 16));
    EXPECT_EQ(project(camera, whole(1, 1, 0)).status(), Status::out_of_range);
    EXPECT_EQ(project(camera, whole(0, 0, -1)).status(), Status::out_of_range);
}

TEST(LensInverse, OfTheToolkitsCamera) {
    const Camera<> camera = toolkit_camera();
    const LensInverse<> lens(camera);
    const Vector<2> ideal = pixel_of(camera, *lens.undistort(point_of(camera, pixel(0, 0))));
    EXPECT_NEAR(plain(ideal[0]), -98.67, 0.01);
    EXPECT_NEAR(plain(ideal[1]), -70.57, 0.01);
    const Vector<2> seen = pixel_of(camera, distort(camera, point_of(camera, pixel(0, 0))));
    EXPECT_NEAR(plain(seen[0]), 61.30, 0.01);
    EXPECT_NEAR(plain(seen[1]), 43.71, 0.01);
    EXPECT_EQ(plain(lens.radius()), 8.0);
    const Vector<3> ray = *lens.ray(pixel(0, 0));
    EXPECT_EQ(ray[2], Real::one());
    EXPECT_LE((*project(camera, ray))[0].absolute(), Real::from_int(1, -44));
}

TEST(LensInverse, FindsEveryPlaceOfItsField) {
    Random random(3);
    const auto some = [&](int most) { return Real::from_int(random.between(-most, most), -16); };
    for (int i = 0; i < 60; ++i) {
        Camera<> camera;
        camera.k1 = some(30000);
        camera.k2 = some(20000);
        camera.k3 = some(10000);
        camera.p1 = some(300);
        camera.p2 = some(300);
        const LensInverse<> lens(camera);
        ASSERT_GT(plain(lens.radius()), 0.3);
        for (int k = 0; k < 40; ++k) {
            // Up to the very edge.
            const auto way = random_matrix<2, 1>(random);
            const Real length = length_of(way);
            if (length.zero()) continue;
            const Real share = lens.radius() * (k < 4 ? Real::one() : random_part(random)) / length;
            const Vector<2> place(way[0] * share, way[1] * share);
            const Vector<2> point = distort(camera, place);
            const Result<Vector<2>> found = lens.undistort(point);
            ASSERT_TRUE(found) << i << " " << k;
            ASSERT_LE(length_of(distort(camera, *found) - point),
                      (Real::one() + length_of(point)).scaled(-55));
            // At the edge the slope is 0, and the place as uncertain as the root of what is left.
            ASSERT_LE(length_of(*found - place), Real::from_int(1, -24));
        }
    }
}

/// Lenses that fold back and straighten again, which is seen only by looking closely.
Camera<> folding(double k1, double k2, double k3) {
    Camera<> camera;
    camera.k1 = real_of(k1);
    camera.k2 = real_of(k2);
    camera.k3 = real_of(k3);
    return camera;
}

TEST(LensInverse, ItsFieldEndsBeforeTheFirstFold) {
    const double between = 1 + 1.0 / 128;
    const double square = between * between;
    const double grazing = 1 - 1.2e-4;
    for (const Camera<>& camera :
         {folding(-8889, 2.667e7, 0), folding(-0.495674, -0.446919, 0.47458), folding(-8.76, -748.5, 18483),
          folding(-2 / (3 * square * grazing), 1 / (5 * square * square * grazing), 0)}) {
        const LensInverse<> lens(camera);
        // The slope as it is sampled densely.
        const double k1 = plain(camera.k1);
        const double k2 = plain(camera.k2);
        const double k3 = plain(camera.k3);
        double fold = 0;
        for (; fold < 8; fold += 1e-5) {
            const double s = fold * fold;
            if (1 + s * (3 * k1 + s * (5 * k2 + s * 7 * k3)) <= 0) break;
        }
        ASSERT_LT(fold, 8);
        EXPECT_LE(plain(lens.radius()), fold);
        EXPECT_GE(plain(lens.radius()), fold - 2e-5);
        for (int i = 0; i < 400; ++i) {
            const Real r = lens.radius() * Real::from_ratio(i, 400);
            const Result<Vector<2>> found = lens.undistort(distort(camera, Vector<2>(r, Real())));
            ASSERT_TRUE(found);
            ASSERT_NEAR(plain((*found)[0]), plain(r), 1e-9);
        }
    }
}

TEST(LensInverse, RefusesWhatNoPlaceIsSeenAt) {
    Camera<> camera;
    camera.k1 = Real::from_ratio(-1, 3);
    const LensInverse<> lens(camera);
    // The slope 1 - r^2 ends at radius 1, which is seen at 2/3.
    EXPECT_NEAR(plain(lens.radius()), 1, 1e-8);
    EXPECT_TRUE(lens.undistort(pixel(0.6666, 0)));
    for (const double x : {0.6668, 0.7, 1.0, 5.0, 1e6})
        EXPECT_EQ(lens.undistort(pixel(x, 0)).status(), Status::out_of_range) << x;
    EXPECT_EQ(lens.ray(pixel(-3, 4)).status(), Status::out_of_range);
    camera.fx = Real();
    EXPECT_EQ(LensInverse<>(camera).ray(pixel(0, 0)).status(), Status::bad_argument);
    camera.k1 = Real::from_int(-1000000);
    EXPECT_EQ(LensInverse<>(camera).undistort(pixel(0.5, 0)).status(), Status::out_of_range);
    EXPECT_EQ(*LensInverse<>(Camera<>()).undistort(pixel(0.5, 0.25)), pixel(0.5, 0.25));
}

TEST(Distort, IsTheSameInDouble) {
    Camera<double> camera{532.4, 530.2, 338.1, 238.8, -0.4175, 0.1891, 0.01, 0.0004, -0.0012};
    Camera<> same{real_of(532.4),  real_of(530.2), real_of(338.1),  real_of(238.8),  real_of(-0.4175),
                  real_of(0.1891), real_of(0.01),  real_of(0.0004), real_of(-0.0012)};
    for (double u = 0; u <= 640; u += 40)
        for (double v = 0; v <= 480; v += 40) {
            const Vector<2, double> place(u, v);
            const Vector<2, double> seen = pixel_of(camera, distort(camera, point_of(camera, place)));
            const Vector<2> exact = pixel_of(same, distort(same, point_of(same, pixel(u, v))));
            ASSERT_NEAR(seen[0], plain(exact[0]), 1e-11);
            ASSERT_NEAR(seen[1], plain(exact[1]), 1e-11);
        }
}

}  // namespace
}  // namespace fovea::test
