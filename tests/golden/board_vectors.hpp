// SPDX-License-Identifier: MIT
//
// Golden vectors of camera/: the boards that a camera is calibrated with.
#pragma once

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/camera/board_lattice.hpp>
#include <fovea/camera/checkerboard.hpp>
#include <fovea/camera/circle_grid.hpp>
#include <fovea/camera/saddle_point.hpp>
#include <fovea/image/image_view.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

/// A board turned by some ten degrees, in shares of 4 samples a pixel, with a little noise. shade(u, v) says
/// what is dark, in 1/64 of a square.
template <class Shade>
void draw_board(ImageView<Gray8> to, int pitch, Shade shade) {
    Random random(77);
    // 2^-10 squares in half a pixel.
    const int along = 1009 / (2 * pitch);
    const int across = 176 / (2 * pitch);
    for (int y = 0; y < to.height(); ++y)
        for (int x = 0; x < to.width(); ++x) {
            int dark = 0;
            for (int k = 0; k < 4; ++k) {
                const int dx = 2 * x + k % 2 - to.width();
                const int dy = 2 * y + k / 2 - to.height();
                dark += shade((dx * along + dy * across) >> 4, (dy * along - dx * across) >> 4) ? 1 : 0;
            }
            to(x, y) = static_cast<Gray8>(200 - 40 * dark + random.between(-2, 2));
        }
}

inline void camera_checkerboard(Workspace& work, Digest& digest) {
    constexpr Size size{70, 56};
    const ImageView<Gray8> image = work.view<Gray8>(0, size);
    // Four by three corners about the middle.
    draw_board(image, 10, [](int u, int v) {
        const int i = (u + 160) >> 6;
        const int j = (v + 128) >> 6;
        return i >= 0 && j >= 0 && i < 5 && j < 4 && (i + j) % 2 == 0;
    });
    CheckerboardOptions options;
    options.candidates = 100;
    SubPixelPoint corners[12];
    digest.add(find_checkerboard_scratch(size, {4, 3}, options) <= work.scratch_span().size());
    digest.add(find_checkerboard(image, {4, 3}, options, work.scratch_span(), corners));
    for (const SubPixelPoint corner : corners) digest.add(corner);
    digest.add(find_checkerboard(image, {3, 3}, options, work.scratch_span(), corners));
    for (const int radius : {3, 6}) {
        const auto point = refine_saddle_point(image, corners[5], SubPixel::from_int(radius));
        digest.add(point.status(), point ? *point : SubPixelPoint());
    }
}

inline void camera_circle_grid(Workspace& work, Digest& digest) {
    constexpr Size size{68, 50};
    const ImageView<Gray8> image = work.view<Gray8>(0, size);
    SubPixelPoint centres[12];
    CircleGridOptions options;
    options.candidates = 40;
    // Four by three about the middle; then three by four with every second row moved.
    for (const bool asymmetric : {false, true}) {
        draw_board(image, asymmetric ? 8 : 11, [asymmetric](int u, int v) {
            const int j = (v + (asymmetric ? 96 : 64) + 32) >> 6;
            const int shift = asymmetric ? 160 - (j % 2 != 0 ? 64 : 0) : 96;
            const int pitch = asymmetric ? 128 : 64;
            const int i = (u + shift + pitch / 2) >> (asymmetric ? 7 : 6);
            if (i < 0 || j < 0 || i >= (asymmetric ? 3 : 4) || j >= (asymmetric ? 4 : 3)) return false;
            const int dx = u + shift - i * pitch;
            const int dy = v + (asymmetric ? 96 : 64) - j * 64;
            return dx * dx + dy * dy < 24 * 24;
        });
        const Size board = asymmetric ? Size{3, 4} : Size{4, 3};
        options.pattern = asymmetric ? CircleGridPattern::asymmetric : CircleGridPattern::symmetric;
        // Its bytes differ by the width of a vector.
        digest.add(find_circle_grid_scratch(size, board, options) <= work.scratch_span().size());
        digest.add(find_circle_grid(image, board, options, work.scratch_span(), centres));
        for (const SubPixelPoint centre : centres) digest.add(centre);
    }
}

}  // namespace fovea::golden
