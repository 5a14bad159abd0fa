// SPDX-License-Identifier: MIT
//
// Poses of a known object: refined, of a plane with its two tilts, and among doubtful pairs.
#include <fovea/camera/refine_pose.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/camera/find_pose.hpp>
#include <fovea/camera/planar_pose.hpp>
#include <fovea/camera/posit.hpp>
#include <support/board_corners.hpp>
#include <support/object_scene.hpp>

namespace fovea::test {
namespace {

/// A lens whose field ends at radius 1.1.
Camera<> folding() {
    Camera<> camera = usual_camera(true);
    camera.k2 = Real();
    return camera;
}

/// A pose a few degrees and percents off.
Pose<> beside(const Pose<>& pose, Random& random) {
    return {rotation_about(random_matrix<3, 1>(random) * real_of(0.1)) * pose.rotation,
            pose.translation * real_of(1.05)};
}

TEST(RefinePose, LeadsToTheSameLeastFromEverywhere) {
    Random random(81);
    const Camera<> camera = usual_camera(true);
    for (int i = 0; i < 15; ++i) {
        const auto points = random_object(random, 4 + 2 * i, 1000);
        const Pose<> pose = random_pose(random, 6000);
        const auto pixels = seen_by(camera, pose, points, 0.3, random);
        const auto first = refine_pose(span_of(points), span_of(pixels), camera, pose);
        const auto second = refine_pose(span_of(points), span_of(pixels), camera, beside(pose, random));
        const auto wide = refine_pose<long double>(
            span_of(points), span_of(pixels), camera_in<long double>(camera), pose_in<long double>(pose));
        ASSERT_TRUE(first && second && wide) << i;
        // Far below a standard deviation, which is some 1e-4.
        ASSERT_LE(difference(first->pose, second->pose), 1e-13) << i;
        for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(plain(first->pose.translation[k]), static_cast<double>(wide->pose.translation[k]),
                        1e-9);
        ASSERT_LE(difference(first->pose, pose), 2e-2) << i;
    }
}

TEST(RefinePose, KnowsHowWellItKnows) {
    // Over many draws of noise, errors divided by their deviations have the mean square 1.
    Random random(82);
    const Camera<> camera = usual_camera(true);
    const auto points = random_object(random, 20, 1000);
    const Pose<> pose = random_pose(random, 6000);
    const Vector<3> mean = vector_of(SpacePoint{0, 0, 0});
    double turns = 0;
    double places = 0;
    double residuals = 0;
    constexpr int draws = 60;
    for (int i = 0; i < draws; ++i) {
        const auto pixels = seen_by(camera, pose, points, 0.25, random);
        const auto fit = refine_pose(span_of(points), span_of(pixels), camera, pose);
        ASSERT_TRUE(fit);
        EXPECT_EQ(fit->used, 20);
        residuals += plain(fit->rms * fit->rms);
        // The turn between both, as an axis.
        const Matrix<3, 3> turn = fit->pose.rotation * pose.rotation.transposed();
        const double axis[3] = {plain(turn(2, 1) - turn(1, 2)) / 2, plain(turn(0, 2) - turn(2, 0)) / 2,
                                plain(turn(1, 0) - turn(0, 1)) / 2};
        for (int k = 0; k < 3; ++k) {
            turns += std::pow(axis[k] / plain(fit->turn_deviation[k]), 2) / 3;
            places +=
                std::pow(plain(fit->pose(mean)[k] - pose(mean)[k]) / plain(fit->place_deviation[k]), 2) / 3;
        }
    }
    // 0.25 px an axis, less the six unknowns: 2 * 0.25^2 * 34 / 40. Mean squares of 180 numbers, which are
    // normal, have deviations of sqrt(2 / 180) = 0.11 if independent.
    EXPECT_NEAR(residuals / draws, 0.106, 0.012);
    EXPECT_NEAR(turns / draws, 1, 0.4);
    EXPECT_NEAR(places / draws, 1, 0.4);
}

TEST(RefinePose, OfThreePointsHasNothingLeftOver) {
    Random random(83);
    const Camera<> camera = usual_camera(false);
    const std::vector<SpacePoint> points = {{-500, 0, 100}, {700, 100, 0}, {0, 800, -200}};
    const Pose<> pose = random_pose(random, 5000);
    const auto pixels = seen_by(camera, pose, points, 0, random);
    const auto fit = refine_pose(span_of(points), span_of(pixels), camera, pose);
    ASSERT_TRUE(fit);
    EXPECT_LE(plain(fit->rms), 1e-12);
    EXPECT_EQ(fit->turn_deviation, Vector<3>());
}

TEST(RefinePose, RefusesByName) {
    Random random(84);
    const Camera<> camera = usual_camera(true);
    auto points = random_object(random, 6, 1000);
    const Pose<> pose{Matrix<3, 3>::identity(), vector_of({0, 0, 6000})};
    const auto pixels = seen_by(camera, pose, points, 0.1, random);
    const auto status = [&](const Pose<>& start) {
        return refine_pose(span_of(points), span_of(pixels), camera, start).status();
    };
    EXPECT_EQ(status(pose), Status::ok);
    EXPECT_EQ(status({pose.rotation, -pose.translation}), Status::out_of_range);
    EXPECT_EQ(refine_pose(span_of(points).first(2), span_of(pixels).first(2), camera, pose).status(),
              Status::bad_argument);
    EXPECT_EQ(refine_pose(span_of(points), span_of(pixels).first(5), camera, pose).status(),
              Status::size_mismatch);
    for (SpacePoint& point : points) point = {point.x, -point.x, 2 * point.x};
    EXPECT_EQ(status(pose), Status::degenerate);
}

std::vector<PlanePoint> board(int columns, int rows, int step) {
    std::vector<PlanePoint> points;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) points.push_back({x * step, y * step});
    return points;
}

TEST(PlanarPose, ANearPlaneHasOneTiltAndADistantOneTwo) {
    Random random(85);
    const Camera<> camera = usual_camera(true);
    std::vector<SubPixelPoint> scratch(54);
    const Span<SubPixelPoint> room(scratch.data(), 54);
    const auto points = board(9, 6, 25);
    int swapped = 0;
    double twin = 0;
    for (int i = 0; i < 20; ++i) {
        // Near, and tilted by 30 degrees or more: the better fit is the pose, and the other clearly worse.
        const Vector<3> tilt(real_of(0.5 + 0.02 * i), real_of(i % 2 == 0 ? 0.3 : -0.4), real_of(0.1));
        Pose<> pose{rotation_about(tilt), vector_of({-90, -70, 480})};
        auto pixels = seen_by(camera, pose, points, 0.1, random);
        auto found = planar_pose(span_of(points), span_of(pixels), camera, room);
        ASSERT_TRUE(found) << i;
        ASSERT_LE(difference(found->fits[0].pose, pose), 3e-3) << i;
        // Four deviations of the root of a mean over 102 numbers that are free.
        ASSERT_NEAR(plain(found->fits[0].rms), 0.1414, 0.04);
        if (found->count == 2) {
            ASSERT_GT(plain(found->fits[1].rms), 5 * plain(found->fits[0].rms));
        }

        // A hundred times as far, 4 px high: both fit alike, and one of them is the pose.
        pose.translation = vector_of({-90, -70, 30000});
        pixels = seen_by(camera, pose, points, 0.02, random);
        found = planar_pose(span_of(points), span_of(pixels), camera, room);
        ASSERT_TRUE(found) << i;
        ASSERT_EQ(found->count, 2) << i;
        ASSERT_LE(plain(found->fits[0].rms), plain(found->fits[1].rms));
        ASSERT_LE(plain(found->fits[1].rms), 1.3 * plain(found->fits[0].rms)) << i;
        const double first = difference(found->fits[0].pose, pose);
        const double second = difference(found->fits[1].pose, pose);
        ASSERT_LE(std::fmin(first, second), 0.15) << i;
        twin = std::fmax(twin, std::fmax(first, second));
        if (second < first) ++swapped;
    }
    EXPECT_GT(twin, 0.3);
    // Now and then the wrong one fits better: that is why both are told.
    EXPECT_GT(swapped, 0);
}

TEST(PlanarPose, FromTheFrontThereIsOne) {
    Random random(80);
    std::vector<SubPixelPoint> scratch(54);
    const auto points = board(9, 6, 25);
    const Pose<> pose{Matrix<3, 3>::identity(), vector_of({-100, -62, 400})};
    const auto pixels = seen_by(usual_camera(true), pose, points, 0, random);
    const auto found = planar_pose(span_of(points), span_of(pixels), usual_camera(true),
                                   Span<SubPixelPoint>(scratch.data(), 54));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->count, 1);
    EXPECT_LE(difference(found->fits[0].pose, pose), 1e-4);
}

TEST(PlanarPose, OfAPhotographedBoardIsThatOfItsCalibration) {
    // The camera of calibrate_planar_test.cpp: with it fixed, the best pose of each view is the one that the
    // calibration has, and so are the squares.
    Camera<> camera;
    camera.fx = real_of(536.454766207);
    camera.fy = real_of(536.406519322);
    camera.cx = real_of(342.367759491);
    camera.cy = real_of(235.542658456);
    camera.k1 = real_of(-0.2786528930);
    camera.k2 = real_of(0.0672480489);
    camera.p1 = real_of(0.00182148412);
    camera.p2 = real_of(-0.00034478546);
    constexpr BoardCorners corners = board_corners();
    std::vector<SubPixelPoint> scratch(board_points);
    double squares = 0;
    for (const auto& seen : corners.left) {
        const auto found = planar_pose(Span<const PlanePoint>(corners.board), Span<const SubPixelPoint>(seen),
                                       camera, Span<SubPixelPoint>(scratch.data(), board_points));
        ASSERT_TRUE(found);
        squares += plain(found->fits[0].rms) * plain(found->fits[0].rms) / board_views;
        if (found->count == 2) {
            EXPECT_GT(plain(found->fits[1].rms), 2 * plain(found->fits[0].rms));
        }
    }
    EXPECT_NEAR(std::sqrt(squares), 0.408256475887, 1e-11);
}

TEST(PosesOfPlane, AgreeInTheSlopesAtTheirPlace) {
    Random random(86);
    for (int i = 0; i < 50; ++i) {
        const Pose<> pose{rotation_about(random_matrix<3, 1>(random) * Real::from_int(2)),
                          vector_of({random.between(-300, 300), random.between(-300, 300), 1000})};
        Matrix<3, 3> homography;
        for (int r = 0; r < 3; ++r) {
            homography(r, 0) = pose.rotation(r, 0);
            homography(r, 1) = pose.rotation(r, 1);
            homography(r, 2) = pose.translation[r];
        }
        const Vector<2> place(Real::from_int(random.between(-50, 50)),
                              Real::from_int(random.between(-50, 50)));
        const auto tilts = poses_of_plane(homography, place);
        ASSERT_TRUE(tilts);
        const double first = difference(tilts->poses[0], pose);
        const double second = difference(tilts->poses[1], pose);
        ASSERT_LE(std::fmin(first, second), 1e-12) << i;
        // Near the place, both lie on the rays of the plane to the square of the distance.
        for (const Pose<>& tilt : tilts->poses) {
            const Vector<3> point(place[0] + Real::from_int(1, -20), place[1] - Real::from_int(1, -20),
                                  Real());
            const Vector<3> a = tilt(point);
            const Vector<3> b = pose(point);
            ASSERT_LE(plain(length_of(cross(a, b))) / plain(length_of(a) * length_of(b)), 1e-17);
            ASSERT_TRUE(tilt(point)[2].positive());
        }
    }
    // Seen from the front, there is one.
    Matrix<3, 3> front = Matrix<3, 3>::identity();
    front(2, 2) = Real::from_int(10);
    const auto tilts = poses_of_plane(front, Vector<2>());
    ASSERT_TRUE(tilts);
    EXPECT_EQ(tilts->poses[0].rotation, (Matrix<3, 3>::identity()));
    EXPECT_EQ(tilts->poses[1].rotation, (Matrix<3, 3>::identity()));
    EXPECT_EQ(poses_of_plane(-front, Vector<2>()).status(), Status::degenerate);
    front(1, 1) = Real();
    EXPECT_EQ(poses_of_plane(front, Vector<2>()).status(), Status::degenerate);
}

TEST(PlanarPose, RefusesByName) {
    Random random(87);
    const Camera<> camera = usual_camera(true);
    std::vector<SubPixelPoint> scratch(54);
    const Span<SubPixelPoint> room(scratch.data(), 54);
    auto points = board(9, 6, 25);
    const Pose<> pose{rotation_about(Vector<3>(real_of(0.5), Real(), Real())), vector_of({-90, -70, 480})};
    auto pixels = seen_by(camera, pose, points, 0.1, random);
    EXPECT_EQ(planar_pose(span_of(points), span_of(pixels), camera, room.first(53)).status(),
              Status::scratch_too_small);
    EXPECT_EQ(planar_pose(span_of(points), span_of(pixels).first(9), camera, room).status(),
              Status::size_mismatch);
    EXPECT_EQ(planar_pose(span_of(points).first(3), span_of(pixels).first(3), camera, room).status(),
              Status::bad_argument);
    EXPECT_EQ(planar_pose(span_of(points).first(9), span_of(pixels).first(9), camera, room).status(),
              Status::degenerate);
    Camera<> blind = camera;
    blind.fx = Real();
    EXPECT_EQ(planar_pose(span_of(points), span_of(pixels), blind, room).status(), Status::bad_argument);
    EXPECT_EQ(planar_pose(span_of(points), span_of(pixels), folding(), room).status(), Status::ok);
    pixels[5].x = SubPixel::from_int(-9000);
    EXPECT_EQ(planar_pose(span_of(points), span_of(pixels), folding(), room).status(), Status::out_of_range);
}

TEST(FindPose, AmongPairsOfWhichHalfAreWrong) {
    Random random(88);
    const Camera<> camera = folding();
    for (int i = 0; i < 6; ++i) {
        auto points = random_object(random, 60, 1000);
        if (i % 2 == 1)
            for (SpacePoint& point : points) point.z = 0;
        const Pose<> pose{rotation_about(random_matrix<3, 1>(random)), vector_of({100, -200, 5000})};
        auto pixels = seen_by(camera, pose, points, i < 2 ? 0 : 0.2, random);
        // Half of the pairs are wrong, one of them beyond the field of the lens.
        for (std::size_t k = 0; k < 30; ++k)
            pixels[2 * k] = {SubPixel::from_int(random.between(0, 639)),
                             SubPixel::from_int(random.between(0, 479))};
        pixels[4].x = SubPixel::from_int(-9000);
        // A pair that is off by a little more than the tolerance, and one by less.
        pixels[7].x += SubPixel::from_int(4);
        pixels[9].y += SubPixel::from_int(1);
        // The model of the lens sees a place far outside of its field in a pixel that no ray leads from.
        const Vector<3> place = inverse(pose)(vector_of({11000, 0, 5000}));
        points[11] = {static_cast<std::int32_t>(place[0].rounded(0)),
                      static_cast<std::int32_t>(place[1].rounded(0)),
                      static_cast<std::int32_t>(place[2].rounded(0))};
        pixels[11] = noisy(project(camera, pose, vector_of(points[11])).value(), 0, random);
        std::vector<Vector<3>> scratch(60);
        std::vector<std::uint8_t> agrees(60, 7);
        const auto found =
            find_pose(span_of(points), span_of(pixels), camera, SubPixel::from_int(2), RansacOptions(),
                      Span<Vector<3>>(scratch.data(), 60), Span<std::uint8_t>(agrees.data(), 60));
        ASSERT_TRUE(found) << i;
        EXPECT_LE(difference(found->fit.pose, pose), 5e-3) << i;
        EXPECT_TRUE(found->certain);
        EXPECT_GE(found->fit.used, 28);
        EXPECT_LE(found->fit.used, 32);
        EXPECT_EQ(agrees[7], 0);
        EXPECT_EQ(agrees[11], 0);
        int agreeing = 0;
        for (std::size_t k = 0; k < 60; ++k) {
            agreeing += agrees[k];
            EXPECT_LE(agrees[k], 1);
            if (k % 2 == 1 && k != 7 && k != 11) {
                EXPECT_EQ(agrees[k], 1) << i << " " << k;
            }
        }
        EXPECT_EQ(agreeing, found->fit.used);
    }
}

TEST(FindPose, OneSampleIsEnoughWhereAllAgree) {
    Random random(79);
    const Camera<> camera = usual_camera(false);
    for (int i = 0; i < 20; ++i) {
        const auto points = random_object(random, 30, 1000);
        const Pose<> pose{rotation_about(random_matrix<3, 1>(random)), vector_of({100, -200, 5000})};
        const auto pixels = seen_by(camera, pose, points, 0, random);
        std::vector<Vector<3>> scratch(30);
        std::vector<std::uint8_t> agrees(30);
        const auto found =
            find_pose(span_of(points), span_of(pixels), camera, SubPixel::from_int(8), RansacOptions(),
                      Span<Vector<3>>(scratch.data(), 30), Span<std::uint8_t>(agrees.data(), 30));
        ASSERT_TRUE(found);
        ASSERT_EQ(found->samples, 1) << i;
        ASSERT_EQ(found->fit.used, 30);
    }
}

TEST(FindPose, RefusesByName) {
    Random random(89);
    const Camera<> camera = usual_camera(false);
    auto points = random_object(random, 12, 1000);
    const Pose<> pose{Matrix<3, 3>::identity(), vector_of({0, 0, 5000})};
    auto pixels = seen_by(camera, pose, points, 0.2, random);
    std::vector<Vector<3>> scratch(12);
    std::vector<std::uint8_t> agrees(12, 7);
    SubPixel tolerance = SubPixel::from_int(2);
    RansacOptions options;
    options.enough = 10;
    options.most_samples = 200;
    std::ptrdiff_t count = 12;
    std::ptrdiff_t room = 12;
    const auto status = [&] {
        return find_pose(span_of(points).first(count), span_of(pixels).first(count), camera, tolerance,
                         options, Span<Vector<3>>(scratch.data(), room),
                         Span<std::uint8_t>(agrees.data(), count))
            .status();
    };
    EXPECT_EQ(status(), Status::ok);
    agrees.assign(12, 7);
    room = 11;
    EXPECT_EQ(status(), Status::scratch_too_small);
    room = 12;
    count = 3;
    EXPECT_EQ(status(), Status::bad_argument);
    count = 12;
    tolerance = SubPixel();
    EXPECT_EQ(status(), Status::bad_argument);
    tolerance = SubPixel::from_int(2);
    for (SubPixelPoint& pixel : pixels)
        pixel = {SubPixel::from_int(random.between(0, 639)), SubPixel::from_int(random.between(0, 479))};
    EXPECT_EQ(status(), Status::not_found);
    for (SpacePoint& point : points) point = {point.x, 0, 0};
    EXPECT_EQ(status(), Status::degenerate);
    EXPECT_EQ(agrees, std::vector<std::uint8_t>(12, 7));
}

}  // namespace
}  // namespace fovea::test
