// SPDX-License-Identifier: MIT
//
// Pictures of a checkerboard as a pinhole of known place sees it, rendered quickly: for what is said of them
// by `fovea calibrate`. Host tests only.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <common/picture_file.hpp>
#include <support/test_io.hpp>

namespace fovea::test {

/// A camera without distortion.
struct Pinhole {
    Size picture{320, 240};
    double fx = 320, fy = 320, cx = 160.25, cy = 119.25;
};

/// Where the middle of the board is, in mm before the camera, and how it is turned, in degrees.
struct BoardPlace {
    double x = 0, y = 0, z = 300;
    double about_x = 0, about_y = 0, about_z = 0;
};

/// Columns and rows of inner corners, and the side of a square in mm.
struct RenderedBoard {
    int columns = 7, rows = 6;
    double square = 12;
    /// Squares, or dark circles of a third of a square in place of the corners.
    enum class Pattern { squares, circles, asymmetric } pattern = Pattern::squares;
};

using Axes = std::array<std::array<double, 3>, 3>;

/// The rotation of a place: about z, then y, then x.
inline Axes rotation_of(const BoardPlace& place) {
    const double to = 3.14159265358979323846 / 180;
    const double a = std::cos(place.about_x * to), b = std::sin(place.about_x * to);
    const double c = std::cos(place.about_y * to), d = std::sin(place.about_y * to);
    const double e = std::cos(place.about_z * to), f = std::sin(place.about_z * to);
    return {{{c * e, -c * f, d},
             {a * f + b * d * e, a * e - b * d * f, -b * c},
             {b * f - a * d * e, b * e + a * d * f, a * c}}};
}

/// The picture: dark squares on a bright board with a rim of one square, before a gray wall. A pixel is the
/// mean of 5 x 5 places of its square and a little beyond, as a lens blurs.
inline apps::Picture<Gray8> render_board(const Pinhole& camera, const BoardPlace& place,
                                         const RenderedBoard& board = {}) {
    const Axes r = rotation_of(place);
    const std::array<double, 3> middle{place.x, place.y, place.z};
    const auto level = [&](double px, double py) {
        // The ray (u, v, 1) s meets the board's plane, whose normal is the third column.
        const std::array<double, 3> ray{(px - camera.cx) / camera.fx, (py - camera.cy) / camera.fy, 1};
        const double along = r[0][2] * ray[0] + r[1][2] * ray[1] + r[2][2];
        const double s = (r[0][2] * middle[0] + r[1][2] * middle[1] + r[2][2] * middle[2]) / along;
        double at[2];
        for (std::size_t axis = 0; axis < 2; ++axis) {
            at[axis] = 0;
            for (std::size_t i = 0; i < 3; ++i) at[axis] += r[i][axis] * (ray[i] * s - middle[i]);
        }
        // In squares, from the first inner corner.
        const bool shifted = board.pattern == RenderedBoard::Pattern::asymmetric;
        const double last = shifted ? 2 * (board.columns - 1) + 1 : board.columns - 1;
        const double x = at[0] / board.square + last / 2;
        const double y = at[1] / board.square + (board.rows - 1) / 2.0;
        if (s <= 0 || x < -2 || y < -2 || x > last + 2 || y > board.rows + 1) return 120.0;
        if (x < -1 || y < -1 || x >= last + 1 || y >= board.rows) return 215.0;
        const int column = static_cast<int>(std::floor(x));
        const int row = static_cast<int>(std::floor(y));
        if (board.pattern == RenderedBoard::Pattern::squares) return (column + row) % 2 == 0 ? 35.0 : 215.0;
        const double near_x = std::round(x);
        const double near_y = std::round(y);
        const bool there = near_x >= 0 && near_y >= 0 && near_x <= last && near_y <= board.rows - 1 &&
                           (!shifted || static_cast<int>(near_x + near_y) % 2 == 0);
        const double square = (x - near_x) * (x - near_x) + (y - near_y) * (y - near_y);
        return there && square < 1.0 / 9 ? 35.0 : 215.0;
    };
    apps::Picture<Gray8> picture(camera.picture);
    for (int y = 0; y < camera.picture.height; ++y)
        for (int x = 0; x < camera.picture.width; ++x) {
            double sum = 0;
            for (int i = 0; i < 25; ++i) sum += level(x + (i % 5 - 2) * 0.3, y + (i / 5 - 2) * 0.3);
            picture.view()(x, y) = static_cast<Gray8>(std::lround(sum / 25));
        }
    return picture;
}

/// Ten views as the docs ask for them: in all parts of the picture, tilted to all sides.
inline std::vector<BoardPlace> good_places() {
    return {{0, 0, 190, 0, 0, 0},       {-85, -55, 300, 25, 0, 4},  {85, -55, 300, 0, 28, -5},
            {-85, 55, 300, 0, -30, 10}, {85, 55, 300, -28, 0, 0},   {5, -4, 210, 30, 20, 15},
            {-6, 3, 220, -25, 25, -20}, {10, 8, 230, -30, -20, 45}, {-90, 5, 310, 10, 35, 0},
            {88, -3, 310, -10, -35, 8}};
}

/// Writes a picture as a file of a test.
inline void put_picture(TestIo& io, const std::string& name, const apps::Picture<Gray8>& picture) {
    std::string problem;
    apps::save_picture(io.storage(), name, picture, problem);
}

}  // namespace fovea::test
