// SPDX-License-Identifier: MIT
//
// Epipolar lines, and places from two rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <fovea/stereo/epipolar.hpp>
#include <fovea/stereo/stereo_camera.hpp>
#include <fovea/stereo/triangulate.hpp>
#include <support/stereo_rigs.hpp>

namespace fovea::test {
namespace {

Vector<2> pixel(double u, double v) { return place_of<Real>(u, v); }
Vector<3> place(double x, double y, double z) { return place_of<Real>(x, y, z); }
double plain(const Real& value) { return plain_number(value); }

/// Two pinholes with a focal length of 500 px, the right one 100 mm to the right.
StereoCamera<> plain_pair() {
    StereoCamera<> pair;
    for (Camera<>* camera : {&pair.left, &pair.right}) {
        camera->fx = camera->fy = Real::from_int(500);
        camera->cx = Real::from_int(320);
        camera->cy = Real::from_int(240);
    }
    pair.right_from_left.translation = place(-100, 0, 0);
    return pair;
}
StereoCamera<> without_lens(StereoCamera<> pair) {
    for (Camera<>* camera : {&pair.left, &pair.right}) {
        camera->k1 = camera->k2 = camera->k3 = Real();
        camera->p1 = camera->p2 = Real();
    }
    return pair;
}

TEST(StereoCamera, PoseOfTheToolkitsFile) {
    const StereoCamera<> pair = scene_rig.cameras<Real>();
    // The inventory's baseline, and what double makes of the same file.
    EXPECT_NEAR(plain(pair.right_from_left.translation[0]), -111.48340689614194, 1e-11);
    EXPECT_NEAR(plain(pair.right_from_left.translation[1]), -0.9385274964931511, 1e-11);
    EXPECT_NEAR(plain(pair.right_from_left.translation[2]), 0.5759288328047205, 1e-11);
    EXPECT_NEAR(plain(pair.right_from_left.rotation(0, 1)), 0.01842092622871652, 1e-14);
    const StereoCamera<> back = swapped(swapped(pair));
    EXPECT_LE(largest_difference(back.right_from_left.translation, pair.right_from_left.translation), 1e-15);
    EXPECT_EQ(swapped(pair).left.fx, pair.right.fx);
    // The same place by the world's coordinates and by those of the left camera.
    const Pose<> left = pose_of<Real>(scene_rig.left);
    const Pose<> right = pose_of<Real>(scene_rig.right);
    const Vector<3> world = place(30, -40, 50);
    EXPECT_LE(largest_difference(pair.right_from_left(left(world)), right(world)), 1e-4);
    Pose<> flat = left;
    flat.rotation = Matrix<3, 3>();
    EXPECT_EQ(right_from_left(flat, right).status(), Status::degenerate);
}

TEST(ProjectionMatrix, ProjectsLikeTheCamera) {
    const StereoCamera<> pair = without_lens(scene_rig.cameras<Real>());
    const Vector<3> seen = place(-67.7, 85.6, 717.6);
    const Vector<4> whole(seen[0], seen[1], seen[2], Real::one());
    const Vector<3> image = projection_matrix(pair.right, pair.right_from_left) * whole;
    const Vector<2> expected = *project(pair.right, pair.right_from_left, seen);
    EXPECT_NEAR(plain(image[0] / image[2] - expected[0]), 0, 1e-15);
    EXPECT_NEAR(plain(image[1] / image[2] - expected[1]), 0, 1e-15);
    // I19 of the inventory: that of the rectified pair has no rotation left, see rectify_test.cpp.
    EXPECT_EQ(projection_matrix(plain_pair().left, Pose<>())(0, 3), Real());
}

TEST(FundamentalMatrix, OfTwoCamerasSideBySideByHand) {
    const StereoCamera<> pair = plain_pair();
    // [t]x R, and K alike on both sides: all that is left says that rows agree.
    const Matrix<3, 3> essential = essential_matrix(pair.right_from_left);
    EXPECT_EQ(essential(1, 2), Real::from_int(100));
    EXPECT_EQ(essential(2, 1), Real::from_int(-100));
    const Matrix<3, 3> f = *fundamental_matrix(pair);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(plain(f(r, c)), r + c == 3 ? (r == 1 ? 1 : -1) * std::sqrt(0.5) : 0, 1e-18);
    const Vector<3> line = *epipolar_line(f, pixel(100, 50));
    EXPECT_NEAR(plain(distance_from_line(line, pixel(1, 53.5))), 3.5, 1e-15);
    EXPECT_NEAR(plain(distance_from_line(line, pixel(600, 49))), -1, 1e-15);
    // Both would move by half of 3, which is 3 / root of 2 in all.
    EXPECT_NEAR(plain(*sampson_distance(f, pixel(100, 50), pixel(80, 53))), 3 / std::sqrt(2.0), 1e-15);
}

TEST(FundamentalMatrix, FitsWhatBothCamerasSee) {
    Random random(1);
    for (int i = 0; i < 30; ++i) {
        const RandomRig rig(random, i % 2 == 0 ? RandomRig::Kind::side_by_side : RandomRig::Kind::one_above,
                            false);
        const StereoCamera<> pair = rig.cameras<Real>();
        const Matrix<3, 3> f = *fundamental_matrix(pair);
        const Matrix<3, 3, double> same = *fundamental_matrix(rig.cameras<double>());
        EXPECT_LE(largest_difference(f, same), 1e-14);
        // Of swapped cameras it is the transpose; its sign is the same, too.
        const Matrix<3, 3> back = *fundamental_matrix(swapped(pair));
        EXPECT_LE(
            std::min(largest_difference(back, f.transposed()), largest_difference(-back, f.transposed())),
            1e-17);
        for (int k = 0; k < 10; ++k) {
            const Vector<3> seen =
                place(random.between(-300, 300), random.between(-300, 300), random.between(700, 2000));
            const Vector<2> left = *project(pair.left, seen);
            const Vector<2> right = *project(pair.right, pair.right_from_left, seen);
            EXPECT_LE(std::abs(plain(distance_from_line(*epipolar_line(f, left), right))), 1e-14);
            EXPECT_LE(std::abs(plain(distance_from_line(*epipolar_line(f.transposed(), right), left))),
                      1e-14);
            EXPECT_LE(plain(*sampson_distance(f, left, right)), 1e-14);
        }
        const Epipoles<> ends = *epipoles(f);
        EXPECT_LE(plain(length_of(f * ends.left)), 1e-16);
        EXPECT_LE(plain(length_of(f.transposed() * ends.right)), 1e-16);
        // The left camera's centre, as the right one would see it.
        const Vector<3> centre = projection_matrix(pair.right, pair.right_from_left).column(3);
        EXPECT_LE(plain(length_of(cross(*normalized(centre), ends.right))), 1e-13);
    }
}

TEST(FundamentalMatrix, RefusesWhatHasNone) {
    StereoCamera<> pair = plain_pair();
    pair.right_from_left.translation = Vector<3>();
    EXPECT_EQ(fundamental_matrix(pair).status(), Status::degenerate);
    for (int i = 0; i < 4; ++i) {
        pair = plain_pair();
        Camera<>& camera = i < 2 ? pair.left : pair.right;
        (i % 2 == 0 ? camera.fx : camera.fy) = Real();
        EXPECT_EQ(fundamental_matrix(pair).status(), Status::bad_argument);
    }
    EXPECT_EQ(epipoles(Matrix<3, 3>()).status(), Status::degenerate);
    Matrix<3, 3> one;
    one(1, 2) = Real::one();
    EXPECT_EQ(epipoles(one).status(), Status::degenerate);
    one(0, 0) = Real::from_int(1, -42);
    EXPECT_EQ(epipoles(one).status(), Status::degenerate);
    one(0, 0) = Real::from_int(1, -38);
    EXPECT_TRUE(epipoles(one));
    EXPECT_EQ(sampson_distance(Matrix<3, 3>(), pixel(1, 2), pixel(3, 4)).status(), Status::degenerate);
}

TEST(EpipolarLine, VerticalOnesAreLikeOthers) {
    // One camera above the other: every line is a column, which the toolkit's v = m u + c cannot tell.
    StereoCamera<> pair = plain_pair();
    pair.right_from_left.translation = place(0, -100, 0);
    const Matrix<3, 3> f = *fundamental_matrix(pair);
    const Vector<3> line = *epipolar_line(f, pixel(123.5, 77));
    EXPECT_EQ(line[1], Real());
    EXPECT_NEAR(plain(distance_from_line(line, pixel(120, 400))), 3.5, 1e-15);
    const LineEnds ends = *clip_line(line, Rectangle{0, 0, 640, 480});
    EXPECT_EQ(ends.from.x.raw(), 123 * 256 + 128);
    EXPECT_EQ(ends.to.x, ends.from.x);
    EXPECT_EQ(ends.to.y.raw() + ends.from.y.raw(), 479 * 256);
    // And those of a camera in front, which meet in the epipole: every direction.
    pair.right_from_left.translation = place(0, 0, -100);
    const Matrix<3, 3> forward = *fundamental_matrix(pair);
    for (int i = 0; i < 32; ++i) {
        const double angle = i * 3.14159265358979 / 16;
        const Vector<2> at = pixel(320 + 100 * std::cos(angle), 240 + 100 * std::sin(angle));
        const Vector<3> through = *epipolar_line(forward, at);
        EXPECT_LE(std::abs(plain(distance_from_line(through, pixel(320, 240)))), 1e-14);
        EXPECT_LE(std::abs(plain(distance_from_line(through, at))), 1e-14);
    }
    EXPECT_EQ(epipolar_line(forward, pixel(320, 240)).status(), Status::degenerate);
}

TEST(ClipLine, AgreesWithLookingAtEverySide) {
    Random random(2);
    int crossing = 0;
    for (int i = 0; i < 2000; ++i) {
        const Rectangle area{random.between(-50, 50), random.between(-50, 50), random.between(1, 200),
                             random.between(1, 200)};
        const int a = random.between(-8, 8);
        const int b = random.between(-8, 8);
        const int c = random.between(-1500, 1500);
        const Vector<3> line(Real::from_int(a), Real::from_int(b), Real::from_int(c));
        const Result<LineEnds> ends = clip_line(line, area);
        if (a == 0 && b == 0) {
            ASSERT_EQ(ends.status(), Status::degenerate);
            continue;
        }
        // The line crosses if corners are on both of its sides.
        int above = 0;
        int below = 0;
        for (const int x : {area.x, area.right()})
            for (const int y : {area.y, area.bottom()}) {
                above += a * x + b * y + c >= 0 ? 1 : 0;
                below += a * x + b * y + c <= 0 ? 1 : 0;
            }
        ASSERT_EQ(ends.ok(), above > 0 && below > 0) << i;
        if (!ends) {
            ASSERT_EQ(ends.status(), Status::not_found);
            continue;
        }
        ++crossing;
        for (const SubPixelPoint& end : {ends->from, ends->to}) {
            const double x = end.x.raw() / 256.0;
            const double y = end.y.raw() / 256.0;
            ASSERT_LE(std::abs(a * x + b * y + c), (std::abs(a) + std::abs(b)) / 512.0 + 1e-9);
            ASSERT_GE(x, area.x);
            ASSERT_LE(x, area.right());
            ASSERT_GE(y, area.y);
            ASSERT_LE(y, area.bottom());
            // On a side of the rectangle.
            ASSERT_TRUE(x == area.x || x == area.right() || y == area.y || y == area.bottom());
        }
    }
    EXPECT_GT(crossing, 300);
}

TEST(ClipLine, RefusesWhatIsNoRectangle) {
    const Vector<3> line(Real::one(), Real(), Real());
    EXPECT_EQ(clip_line(line, Rectangle{0, 0, 0, 5}).status(), Status::empty_image);
    EXPECT_EQ(clip_line(line, Rectangle{0, 0, 2147483647, 5}).status(), Status::out_of_range);
    EXPECT_EQ(clip_line(line, Rectangle{-2147483647, 0, 5, 5}).status(), Status::out_of_range);
    EXPECT_EQ(clip_line(line, Rectangle{1, 0, 5, 5}).status(), Status::not_found);
    EXPECT_EQ(clip_line(line, Rectangle{0, 0, 1, 1})->to, (SubPixelPoint{}));
}

// ---- Places --------------------------------------------------------------------------------

TEST(TriangulateRays, ByHand) {
    // The right camera stands at (100, 8, 0): the rays pass each other at (50, 0, 100) and (50, 8, 100).
    const Pose<> pose{Matrix<3, 3>::identity(), place(-100, -8, 0)};
    const RayMeeting<> straight = *triangulate_rays(pose, place(0.5, 0, 1), place(-0.25, 0, 0.5));
    EXPECT_EQ(straight.on_left, place(50, 0, 100));
    EXPECT_EQ(straight.on_right, place(50, 8, 100));
    EXPECT_EQ(straight.place, place(50, 4, 100));
    EXPECT_EQ(straight.gap, Real::from_int(8));
    const RayMeeting<> meeting = *triangulate_rays(pose, place(0.5, 0.03, 1), place(-0.5, -0.05, 1));
    // What connects them is square to both rays.
    const Vector<3> between = meeting.on_right - meeting.on_left;
    EXPECT_NEAR(plain(length_of(between)), plain(meeting.gap), 1e-15);
    EXPECT_LE(std::abs(plain(dot(between, place(0.5, 0.03, 1)))), 1e-15);
    EXPECT_LE(std::abs(plain(dot(between, place(-0.5, -0.05, 1)))), 1e-15);
}

TEST(TriangulateRays, RefusesRaysThatDoNotMeet) {
    const Pose<> pose{Matrix<3, 3>::identity(), place(-100, 0, 0)};
    EXPECT_EQ(triangulate_rays(pose, place(0.1, 0.2, 1), place(0.1, 0.2, 1)).status(), Status::degenerate);
    EXPECT_EQ(triangulate_rays(pose, place(0.1, 0.2, 1), place(0.2, 0.4, 2)).status(), Status::degenerate);
    EXPECT_EQ(triangulate_rays(pose, Vector<3>(), place(0.1, 0.2, 1)).status(), Status::degenerate);
    EXPECT_EQ(triangulate_rays(Pose<>(), place(0.1, 0.2, 1), place(0.2, 0.2, 1)).status(),
              Status::degenerate);
    // They part in front and meet behind.
    EXPECT_EQ(triangulate_rays(pose, place(-0.5, 0, 1), place(0.5, 0, 1)).status(), Status::out_of_range);
}

TEST(Triangulator, CupsOfTheToolkitsScene) {
    // The inventory's golden values, whose pixels have one digit: a tenth of a pixel is 0.5 mm of depth.
    const Triangulator<> eyes(scene_rig.cameras<Real>());
    const struct {
        double left[2], right[2], place[3];
    } cups[] = {{{276.6, 355.7}, {104.0, 364.8}, {-67.7, 85.6, 717.6}},
                {{486.4, 359.7}, {320.5, 365.3}, {111.0, 91.5, 740.8}}};
    for (const auto& cup : cups) {
        const RayMeeting<> meeting =
            *eyes.midpoint(pixel(cup.left[0], cup.left[1]), pixel(cup.right[0], cup.right[1]));
        const RayMeeting<> optimal =
            *eyes.optimal(pixel(cup.left[0], cup.left[1]), pixel(cup.right[0], cup.right[1]));
        const double tolerance[3] = {0.1, 0.1, 0.5};
        // The toolkit's is the middle of the rays; theirs pass each other by 1 mm.
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(plain(meeting.place[i]), cup.place[i], tolerance[i]);
            EXPECT_NEAR(plain(optimal.place[i]), cup.place[i], 2 * tolerance[i]);
        }
    }
}

TEST(Triangulator, FindsWhatWasProjected) {
    Random random(3);
    for (int i = 0; i < 10; ++i) {
        const RandomRig rig(random, i % 3 == 0 ? RandomRig::Kind::one_above : RandomRig::Kind::side_by_side);
        const StereoCamera<> pair = rig.cameras<Real>();
        const Triangulator<> eyes(pair);
        const SeenPlaces seen = look_at(rig.cameras<double>(), random, 6);
        ASSERT_EQ(seen.places.size(), 6u);
        for (const Vector<3, double>& one : seen.places) {
            const Vector<3> true_place = place(one[0], one[1], one[2]);
            const Vector<2> left = *project(pair.left, true_place);
            const Vector<2> right = *project(pair.right, pair.right_from_left, true_place);
            const RayMeeting<> meeting = *eyes.midpoint(left, right);
            const RayMeeting<> optimal = *eyes.optimal(left, right);
            ASSERT_LE(plain(length_of(meeting.place - true_place)), 1e-13 * one[2]);
            ASSERT_LE(plain(length_of(optimal.place - true_place)), 1e-13 * one[2]);
            ASSERT_LE(plain(meeting.gap), 1e-12);
            ASSERT_LE(plain(optimal.gap), 1e-12);
        }
    }
}

/// Sum of the squares of both distances in pixels that a place makes, without lens.
double squares(const StereoCamera<double>& pair, const Vector<3, double>& at, const Vector<2, double>& left,
               const Vector<2, double>& right) {
    const Vector<2, double> a = *project(pair.left, at) - left;
    const Vector<2, double> b = *project(pair.right, pair.right_from_left, at) - right;
    return dot(a, a) + dot(b, b);
}

TEST(Triangulator, NoPlaceNearbyIsBetterThanTheOptimalOne) {
    Random random(4);
    for (int i = 0; i < 20; ++i) {
        const RandomRig rig(random, RandomRig::Kind::side_by_side, false);
        const StereoCamera<double> pair = rig.cameras<double>();
        const Triangulator<> eyes(rig.cameras<Real>());
        const SeenPlaces seen = look_at(pair, random, 1, i < 10 ? 0.5 : 8);
        ASSERT_EQ(seen.places.size(), 1u);
        const Result<RayMeeting<>> found =
            eyes.optimal(vector_of<Real>(seen.left[0]), vector_of<Real>(seen.right[0]));
        ASSERT_TRUE(found) << i;
        const Vector<2, double> left = vector_of<double>(seen.left[0]);
        const Vector<2, double> right = vector_of<double>(seen.right[0]);
        const Vector<3, double> best(plain(found->place[0]), plain(found->place[1]), plain(found->place[2]));
        const double least = squares(pair, best, left, right);
        EXPECT_NEAR(std::sqrt(least), plain(found->gap), 1e-9);
        // A step in any direction is worse: 0.01 px, and ten times as much along the depth.
        for (int k = 0; k < 60; ++k) {
            const double step = best[2] * (k % 2 == 0 ? 1e-5 : 1e-3);
            Vector<3, double> other = best;
            for (int side = 0; side < 3; ++side) other[side] += step * random.between(-1000, 1000) / 1000.0;
            ASSERT_GT(squares(pair, other, left, right), least) << i << " " << k;
        }
        // The middle is near, but not better.
        const Result<RayMeeting<>> middle =
            eyes.midpoint(vector_of<Real>(seen.left[0]), vector_of<Real>(seen.right[0]));
        ASSERT_TRUE(middle);
        const Vector<3, double> half(plain(middle->place[0]), plain(middle->place[1]),
                                     plain(middle->place[2]));
        EXPECT_GE(squares(pair, half, left, right), least * (1 - 1e-9));
    }
}

TEST(NearestMatching, MovesNoMoreThanItMust) {
    // Side by side: both move to the mean row.
    const Matrix<3, 3> f = *fundamental_matrix(plain_pair());
    const PixelPair<> pair = *nearest_matching(f, pixel(100, 50), pixel(80, 53));
    EXPECT_LE(largest_difference(pair.left, pixel(100, 51.5)), 1e-14);
    EXPECT_LE(largest_difference(pair.right, pixel(80, 51.5)), 1e-14);
    const PixelPair<> same = *nearest_matching(f, pixel(100, 50), pixel(80, 50));
    EXPECT_LE(largest_difference(same.left, pixel(100, 50)), 1e-17);
    EXPECT_EQ(nearest_matching(Matrix<3, 3>(), pixel(100, 50), pixel(80, 50)).status(), Status::degenerate);
}

TEST(Triangulator, RefusesWhatItCannotSee) {
    StereoCamera<> pair = plain_pair();
    EXPECT_EQ(Triangulator<>(pair).midpoint(pixel(300, 240), pixel(300, 240)).status(), Status::degenerate);
    EXPECT_EQ(Triangulator<>(pair).optimal(pixel(300, 240), pixel(300, 240)).status(), Status::degenerate);
    EXPECT_EQ(Triangulator<>(pair).midpoint(pixel(300, 240), pixel(310, 240)).status(), Status::out_of_range);
    EXPECT_EQ(Triangulator<>(pair).optimal(pixel(300, 240), pixel(310, 240)).status(), Status::out_of_range);
    pair.left.k1 = Real::from_int(-3);
    EXPECT_EQ(Triangulator<>(pair).midpoint(pixel(0, 0), pixel(300, 240)).status(), Status::out_of_range);
    EXPECT_EQ(Triangulator<>(pair).optimal(pixel(0, 0), pixel(300, 240)).status(), Status::out_of_range);
    pair.right.fx = Real();
    EXPECT_EQ(Triangulator<>(pair).midpoint(pixel(320, 240), pixel(300, 240)).status(), Status::bad_argument);
    EXPECT_EQ(Triangulator<>(pair).optimal(pixel(320, 240), pixel(300, 240)).status(), Status::bad_argument);
}

TEST(DepthOfDisparity, ByHand) {
    const auto whole = [](int value) { return Real::from_int(value); };
    EXPECT_EQ(*depth_of_disparity(whole(500), whole(100), whole(25)), whole(2000));
    // 2000^2 / 50000 = 80 mm a pixel.
    EXPECT_EQ(*depth_deviation(whole(500), whole(100), whole(25), whole(1).scaled(-2)), whole(20));
    EXPECT_EQ(depth_of_disparity(whole(500), whole(100), whole(0)).status(), Status::out_of_range);
    EXPECT_EQ(depth_of_disparity(whole(500), whole(100), whole(-1)).status(), Status::out_of_range);
    EXPECT_EQ(depth_of_disparity(whole(500), whole(0), whole(1)).status(), Status::out_of_range);
    EXPECT_EQ(depth_deviation(whole(500), whole(100), whole(0), whole(1)).status(), Status::out_of_range);
}

}  // namespace
}  // namespace fovea::test
