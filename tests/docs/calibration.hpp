// SPDX-License-Identifier: MIT
//
// The picture of docs/calibrate.md: what `fovea calibrate --coverage` draws, of corners that a known camera
// sees.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/camera/camera.hpp>

#include <calibrate/calibration_pictures.hpp>
#include <calibrate/camera_estimate.hpp>

#include "paper.hpp"

namespace fovea::test {

/// Where a board is: its middle in mm, and twice the tangents of half its turns in hundredths; and how far
/// off its corners are seen, at most, in 1/256 px.
struct BoardStand {
    int x, y, z;
    int turn_x, turn_y, turn_z;
    int noise;
};

/// What the camera sees of the board.
inline apps::SeenBoard seen_from(const Camera<>& camera, const apps::Board& board, const BoardStand& stand,
                                 Random& random) {
    Pose<> pose;
    pose.rotation =
        rotation_about(Vector<3>(Real::from_ratio(stand.turn_x, 100), Real::from_ratio(stand.turn_y, 100),
                                 Real::from_ratio(stand.turn_z, 100)));
    const Vector<3> middle(Real::from_int((board.size.width - 1) * board.square_um, -1),
                           Real::from_int((board.size.height - 1) * board.square_um, -1), Real());
    const Vector<3> place(Real::from_int(stand.x * 1000), Real::from_int(stand.y * 1000),
                          Real::from_int(stand.z * 1000));
    pose.translation = place - pose.rotation * middle;
    apps::SeenBoard seen;
    seen.picture = {640, 480};
    seen.found = seen.used = true;
    for (const PlanePoint point : board.points()) {
        const Vector<2> pixel =
            must(project(camera, pose, Vector<3>(Real::from_int(point.x), Real::from_int(point.y), Real())));
        const int off_x = random.between(-stand.noise, stand.noise);
        const int off_y = random.between(-stand.noise, stand.noise);
        seen.corners.push_back({SubPixel::from_raw(static_cast<std::int32_t>(pixel[0].rounded(8)) + off_x),
                                SubPixel::from_raw(static_cast<std::int32_t>(pixel[1].rounded(8)) + off_y)});
    }
    return seen;
}

inline void coverage(const std::string& name) {
    Camera<> camera;
    camera.fx = camera.fy = Real::from_int(560);
    camera.cx = Real::from_int(322);
    camera.cy = Real::from_int(238);
    camera.k1 = Real::from_ratio(-20, 100);
    camera.k2 = Real::from_ratio(5, 100);
    apps::Board board;
    board.size = {9, 6};
    board.square_um = 25000;
    // The lower right corner is left out, and the last view is blurred.
    const BoardStand stands[] = {{0, 0, 320, 0, 40, 0, 64},         {-112, -85, 430, 45, 10, 3, 64},
                                 {112, -85, 430, -40, -30, -5, 64}, {-112, 85, 430, -20, 50, -4, 64},
                                 {10, 20, 380, 50, -20, 20, 64},    {60, 20, 520, 10, -55, 3, 64},
                                 {-20, -10, 340, -30, 0, -10, 64},  {-50, 40, 560, -55, 25, -40, 220}};
    std::vector<apps::SeenBoard> boards;
    Random random(7);
    for (const BoardStand& stand : stands) boards.push_back(seen_from(camera, board, stand, random));
    const apps::CameraEstimate estimate = apps::estimate_camera(boards, board, IntrinsicsOptions());
    must(status_of(estimate.verdict.problem));
    Picture<Rgb888> picture = apps::coverage_picture({{"where the corners were", &boards, &estimate}});
    Canvas canvas(picture.size);
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) canvas.view()(x, y) = picture.view()(x, y);
    canvas.save(name);
}

}  // namespace fovea::test
