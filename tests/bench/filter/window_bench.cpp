// SPDX-License-Identifier: MIT
//
// What a larger window costs.
#include <string>

#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

bool add_box(int side) {
    return add_operator(
        9000 + side, "box", Sizes::windows, {side, side},
        FOVEA_OPENCV_KEEPING(side, cv::blur(in[0], out, {side, side}, {-1, -1}, cv::BORDER_REPLICATE)),
        "box " + std::to_string(side));
}
/// A window of three sigma to either side, of a sigma that the operator takes.
bool add_gaussian(int side) {
    const double sigma = side / 6.0;
    return add_operator(9100 + side, "gaussian", Sizes::windows, {static_cast<int>(sigma * 100)},
                        FOVEA_OPENCV_KEEPING(=, cv::GaussianBlur(in[0], out, {side, side}, sigma, sigma,
                                                                 cv::BORDER_REPLICATE)),
                        "gaussian " + std::to_string(side));
}
bool add_median(int side) {
    return add_operator(9150 + side, "median", Sizes::windows, {side, side},
                        FOVEA_OPENCV_KEEPING(side, cv::medianBlur(in[0], out, side)),
                        "median " + std::to_string(side));
}
bool add_erode(int side) {
    return add_operator(9200 + side, "erode", Sizes::windows, {side, side},
                        FOVEA_OPENCV_KEEPING(side, cv::erode(in[0], out, cv::Mat::ones(side, side, CV_8U))),
                        "erode " + std::to_string(side));
}

const bool lines[] = {
    add_box(3),      add_box(7),      add_box(15),      add_box(31),      add_box(63),
    add_gaussian(5), add_gaussian(7), add_gaussian(15), add_gaussian(31), add_gaussian(59),
    add_median(3),   add_median(7),   add_median(15),   add_median(31),   add_median(63),
    add_erode(3),    add_erode(7),    add_erode(15),    add_erode(31),    add_erode(63),
};

}  // namespace
}  // namespace fovea::bench
