// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include <fovea/camera/fitted_view.hpp>
#include <fovea/camera/undistortion_map.hpp>
#include <support/scalars.hpp>

namespace fovea::test {
namespace {

Camera<> pinhole(double f, double cx, double cy) {
    return {real_of(f), real_of(f), real_of(cx), real_of(cy)};
}
double plain(Real number) { return static_cast<double>(value_of(number)); }

Camera<> barrel() {
    Camera<> camera = pinhole(530, 338, 239);
    camera.k1 = real_of(-0.4175);
    camera.k2 = real_of(0.1892);
    camera.p1 = real_of(0.0004);
    camera.p2 = real_of(-0.0012);
    return camera;
}
Camera<> pincushion() {
    Camera<> camera = pinhole(700, 310, 250);
    camera.k1 = real_of(0.3);
    return camera;
}
const Matrix<3, 3> straight = Matrix<3, 3>::identity();
const Matrix<3, 3> turned = rotation_about(Vector<3>(real_of(0.03), real_of(-0.05), real_of(0.02)));

TEST(VisibleBounds, AreThoseOfThePinhole) {
    const LensInverse<> lens(pinhole(100, 100, 50));
    const auto bounds = visible_bounds(lens, straight, {201, 101});
    ASSERT_TRUE(bounds.ok());
    for (const ViewBounds<>& side : {bounds->inner, bounds->outer}) {
        EXPECT_NEAR(plain(side.left), -1, 1e-15);
        EXPECT_NEAR(plain(side.right), 1, 1e-15);
        EXPECT_NEAR(plain(side.top), -0.5, 1e-15);
        EXPECT_NEAR(plain(side.bottom), 0.5, 1e-15);
    }
    // A square of it: the height decides what fills it, the width what holds all.
    const auto filled = view_that_fills(bounds->inner, lens.camera(), {101, 101});
    const auto held = view_that_holds(bounds->outer, lens.camera(), {101, 101});
    ASSERT_TRUE(filled.ok() && held.ok());
    EXPECT_NEAR(plain(filled->fx), 100, 1e-12);
    EXPECT_NEAR(plain(held->fy), 50, 1e-12);
    for (const Camera<>& view : {*filled, *held}) {
        EXPECT_NEAR(plain(view.cx), 50, 1e-12);
        EXPECT_NEAR(plain(view.cy), 50, 1e-12);
    }
}

TEST(FittedView, LeavesNoPixelEmptyOrKeepsThemAll) {
    const Size size{640, 480};
    for (const Camera<>& camera : {barrel(), pincushion()})
        for (const Matrix<3, 3>& rotation : {straight, turned}) {
            const LensInverse<> lens(camera);
            const auto bounds = visible_bounds(lens, rotation, size);
            ASSERT_TRUE(bounds.ok());
            const auto filled = view_that_fills(bounds->inner, camera, size);
            ASSERT_TRUE(filled.ok());
            const auto map = undistortion_map(lens, rotation, *filled, size);
            ASSERT_TRUE(map.ok());
            double least_x = 1e9, least_y = 1e9, most_x = -1e9, most_y = -1e9;
            for (int y = 0; y < 480; ++y)
                for (int x = 0; x < 640; ++x) {
                    const FinePoint place = map->place(x, y);
                    least_x = std::min(least_x, place.x.raw() / 65536.0);
                    least_y = std::min(least_y, place.y.raw() / 65536.0);
                    most_x = std::max(most_x, place.x.raw() / 65536.0);
                    most_y = std::max(most_y, place.y.raw() / 65536.0);
                }
            EXPECT_GT(least_x, -0.1);
            EXPECT_GT(least_y, -0.1);
            EXPECT_LT(most_x, 639.1);
            EXPECT_LT(most_y, 479.1);
            // It touches two sides; with a border that bends outwards, nearly.
            const double near = camera.k1.negative() ? 0.1 : 3;
            EXPECT_TRUE((least_x < near && most_x > 639 - near) || (least_y < near && most_y > 479 - near));

            const auto held = view_that_holds(bounds->outer, camera, size);
            ASSERT_TRUE(held.ok());
            double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
            for (int i = 0; i < 2 * (640 + 480); ++i) {
                const Vector<2> pixel =
                    i < 1280 ? Vector<2>(Real::from_int(i / 2), Real::from_int(i % 2 * 479))
                             : Vector<2>(Real::from_int(i % 2 * 639), Real::from_int((i - 1280) / 2));
                const auto ray = lens.ray(pixel);
                ASSERT_TRUE(ray.ok());
                const auto seen = project(*held, rotation * *ray);
                ASSERT_TRUE(seen.ok());
                left = std::min(left, plain((*seen)[0]));
                right = std::max(right, plain((*seen)[0]));
                top = std::min(top, plain((*seen)[1]));
                bottom = std::max(bottom, plain((*seen)[1]));
            }
            EXPECT_GT(left, -0.1);
            EXPECT_GT(top, -0.1);
            EXPECT_LT(right, 639.1);
            EXPECT_LT(bottom, 479.1);
            EXPECT_TRUE((left < 0.1 && right > 638.9) || (top < 0.1 && bottom > 478.9));
        }
}

TEST(VisibleBounds, RefusesWhatIsNotSeen) {
    const LensInverse<> lens(barrel());
    EXPECT_EQ(visible_bounds(lens, straight, {1, 480}).status(), Status::empty_image);
    EXPECT_EQ(visible_bounds(lens, straight, {640, 32768}).status(), Status::image_too_large);
    EXPECT_EQ(visible_bounds(lens, Matrix<3, 3>(), {640, 480}).status(), Status::bad_argument);
    EXPECT_EQ(visible_bounds(LensInverse<>(pinhole(0, 1, 1)), straight, {640, 480}).status(),
              Status::bad_argument);
    // The lens folds back inside of the image; the view looks to the side.
    Camera<> folding = pinhole(300, 320, 240);
    folding.k1 = real_of(-0.5);
    EXPECT_EQ(visible_bounds(LensInverse<>(folding), straight, {640, 480}).status(), Status::out_of_range);
    EXPECT_EQ(visible_bounds(lens, rotation_about(Vector<3>(Real(), Real::from_int(2), Real())), {640, 480})
                  .status(),
              Status::out_of_range);
    const ViewBounds<> bounds{-Real::one(), -Real::one(), Real::one(), Real::one()};
    EXPECT_EQ(view_that_fills(bounds, pinhole(1, 1, 1), {640, 1}).status(), Status::empty_image);
    EXPECT_EQ(view_that_fills(bounds, pinhole(1, 1, 1), {40000, 2}).status(), Status::image_too_large);
    EXPECT_EQ(view_that_holds(bounds, pinhole(0, 1, 1), {640, 480}).status(), Status::bad_argument);
    EXPECT_EQ(view_that_holds(ViewBounds<>(), pinhole(1, 1, 1), {640, 480}).status(), Status::degenerate);
}

TEST(IsRotation, TellsRotationsFromOtherMatrices) {
    EXPECT_TRUE(is_rotation(straight));
    EXPECT_TRUE(is_rotation(turned));
    EXPECT_FALSE(is_rotation(-straight));
    EXPECT_FALSE(is_rotation(turned * real_of(1.00001)));
    EXPECT_FALSE(is_rotation(Matrix<3, 3>()));
}

}  // namespace
}  // namespace fovea::test
