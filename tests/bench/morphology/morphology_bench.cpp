// SPDX-License-Identifier: MIT
#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

/// OpenCV's operations by number, with a rectangle.
[[maybe_unused]] constexpr int erosion = 0, dilation = 1, opened = 2, closed = 3, rim = 4, top = 5, black = 6;

Peer rectangle([[maybe_unused]] int operation, [[maybe_unused]] int side) {
    return FOVEA_OPENCV(
        cv::morphologyEx(in[0], out, operation, cv::getStructuringElement(cv::MORPH_RECT, {side, side})));
}

const bool lines[] = {
    add_operator(30, "erode", Sizes::vga_and_full_hd, {3, 3}, rectangle(erosion, 3), "erode 3x3"),
    add_operator(31, "erode", Sizes::vga_and_full_hd, {15, 15}, rectangle(erosion, 15), "erode 15x15"),
    add_operator(32, "dilate", Sizes::vga, {3, 3}, rectangle(dilation, 3), "dilate 3x3"),
    add_operator(33, "opening", Sizes::vga_and_full_hd, {3, 3}, rectangle(opened, 3), "opening 3x3"),
    add_operator(1800, "top_hat", Sizes::vga_and_full_hd, {15, 15}, rectangle(top, 15), "top_hat 15x15"),
    add_operator(1801, "black_hat", Sizes::vga, {3, 3}, rectangle(black, 3), "black_hat 3x3"),
    add_operator(1802, "morphological_gradient", Sizes::vga_and_full_hd, {3, 3}, rectangle(rim, 3),
                 "morphological_gradient 3x3"),
    add_operator(34, "closing", Sizes::vga, {3, 3}, rectangle(closed, 3), "closing 3x3"),
};

}  // namespace
}  // namespace fovea::bench
