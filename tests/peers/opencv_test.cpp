// SPDX-License-Identifier: MIT
//
// What OpenCV makes of the same image: equal to the last bit, or within the difference that both ways of
// rounding allow. Built where OpenCV is installed.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <op/all_operators.hpp>
#include <support/guarded_image.hpp>
#include <support/operator_run.hpp>

namespace fovea::test {
namespace {

/// An operator of the catalogue, its parameters as far as they are not presets, and the same by OpenCV.
struct Peer {
    const char* name;
    std::vector<int> values;
    int difference;  ///< the largest of a channel of a pixel
    std::function<void(const std::vector<cv::Mat>& in, cv::Mat& out)> theirs;
};
void PrintTo(const Peer& peer, std::ostream* out) { *out << peer.name; }

using In = const std::vector<cv::Mat>&;
using Out = cv::Mat&;
constexpr auto outermost = cv::BORDER_REPLICATE;
const cv::Point centre(-1, -1);

cv::Mat square(int side) { return cv::Mat::ones(side, side, CV_8U); }
cv::Mat cross(int side) { return cv::getStructuringElement(cv::MORPH_CROSS, {side, side}); }

const Peer peers[] = {
    // Point by point.
    {"threshold", {99}, 0, [](In in, Out out) { cv::threshold(in[0], out, 98, 255, cv::THRESH_BINARY); }},
    {"add_saturated", {}, 0, [](In in, Out out) { cv::add(in[0], in[1], out); }},
    {"subtract_saturated", {}, 0, [](In in, Out out) { cv::subtract(in[0], in[1], out); }},
    {"absolute_difference", {}, 0, [](In in, Out out) { cv::absdiff(in[0], in[1], out); }},
    {"pixel_minimum", {}, 0, [](In in, Out out) { cv::min(in[0], in[1], out); }},
    {"pixel_maximum", {}, 0, [](In in, Out out) { cv::max(in[0], in[1], out); }},
    {"bitwise_and", {}, 0, [](In in, Out out) { cv::bitwise_and(in[0], in[1], out); }},
    {"bitwise_or", {}, 0, [](In in, Out out) { cv::bitwise_or(in[0], in[1], out); }},
    {"bitwise_xor", {}, 0, [](In in, Out out) { cv::bitwise_xor(in[0], in[1], out); }},
    {"invert", {}, 0, [](In in, Out out) { cv::bitwise_not(in[0], out); }},
    {"otsu_threshold", {}, 0, [](In in, Out out) { cv::threshold(in[0], out, 0, 255, cv::THRESH_OTSU); }},
    {"equalize", {}, 1, [](In in, Out out) { cv::equalizeHist(in[0], out); }},
    // Colour.
    {"to_gray", {}, 1, [](In in, Out out) { cv::cvtColor(in[0], out, cv::COLOR_RGB2GRAY); }},
    {"to_hsv", {}, 1, [](In in, Out out) { cv::cvtColor(in[0], out, cv::COLOR_RGB2HSV); }},
    // Windows.
    {"gaussian_3x3",
     {},
     0,
     [](In in, Out out) {
         cv::GaussianBlur(in[0], out, {3, 3}, 0, 0, outermost);
     }},
    {"gaussian_5x5",
     {},
     0,
     [](In in, Out out) {
         cv::GaussianBlur(in[0], out, {5, 5}, 0, 0, outermost);
     }},
    {"box_3x3",
     {},
     0,
     [](In in, Out out) {
         cv::blur(in[0], out, {3, 3}, centre, outermost);
     }},
    {"box_5x5",
     {},
     0,
     [](In in, Out out) {
         cv::blur(in[0], out, {5, 5}, centre, outermost);
     }},
    {"box",
     {15, 9},
     0,
     [](In in, Out out) {
         cv::blur(in[0], out, {15, 9}, centre, outermost);
     }},
    {"median_3x3", {}, 0, [](In in, Out out) { cv::medianBlur(in[0], out, 3); }},
    {"median_5x5", {}, 0, [](In in, Out out) { cv::medianBlur(in[0], out, 5); }},
    {"median", {13, 13}, 0, [](In in, Out out) { cv::medianBlur(in[0], out, 13); }},
    {"sobel_x", {}, 0, [](In in, Out out) { cv::Sobel(in[0], out, CV_16S, 1, 0, 3, 1, 0, outermost); }},
    {"sobel_y", {}, 0, [](In in, Out out) { cv::Sobel(in[0], out, CV_16S, 0, 1, 3, 1, 0, outermost); }},
    {"scharr_x", {}, 0, [](In in, Out out) { cv::Scharr(in[0], out, CV_16S, 1, 0, 1, 0, outermost); }},
    {"scharr_y", {}, 0, [](In in, Out out) { cv::Scharr(in[0], out, CV_16S, 0, 1, 1, 0, outermost); }},
    {"laplacian_4", {}, 0, [](In in, Out out) { cv::Laplacian(in[0], out, CV_16S, 1, 1, 0, outermost); }},
    {"canny", {60, 150}, 0, [](In in, Out out) { cv::Canny(in[0], out, 60, 150); }},
    {"erode", {7, 7}, 0, [](In in, Out out) { cv::erode(in[0], out, square(7)); }},
    {"dilate", {3, 3}, 0, [](In in, Out out) { cv::dilate(in[0], out, square(3)); }},
    {"opening", {5, 5}, 0, [](In in, Out out) { cv::morphologyEx(in[0], out, cv::MORPH_OPEN, square(5)); }},
    {"closing", {5, 5}, 0, [](In in, Out out) { cv::morphologyEx(in[0], out, cv::MORPH_CLOSE, square(5)); }},
    {"erode_shape", {0, 5}, 0, [](In in, Out out) { cv::erode(in[0], out, cross(5)); }},
    {"dilate_shape", {0, 5}, 0, [](In in, Out out) { cv::dilate(in[0], out, cross(5)); }},
    // Geometry and sums.
    {"flip_x", {}, 0, [](In in, Out out) { cv::flip(in[0], out, 1); }},
    {"flip_y", {}, 0, [](In in, Out out) { cv::flip(in[0], out, 0); }},
    {"rotate_180", {}, 0, [](In in, Out out) { cv::flip(in[0], out, -1); }},
    {"transpose", {}, 0, [](In in, Out out) { cv::transpose(in[0], out); }},
    {"rotate_90_clockwise", {}, 0, [](In in, Out out) { cv::rotate(in[0], out, cv::ROTATE_90_CLOCKWISE); }},
    {"pyramid_down", {}, 0, [](In in, Out out) { cv::pyrDown(in[0], out, {}, outermost); }},
    {"integral_image", {}, 0, [](In in, Out out) { cv::integral(in[0], out, CV_32S); }},
};

int type_of(PixelKind kind) {
    switch (kind) {
        case PixelKind::gradient16: return CV_16SC1;
        case PixelKind::rgb888:
        case PixelKind::hsv888:
        case PixelKind::lab888: return CV_8UC3;
        case PixelKind::sum32: return CV_32SC1;
        default: return CV_8UC1;
    }
}
cv::Mat over(const AnyImage& image, PixelKind kind) {
    return {image.size.height, image.size.width, type_of(kind), image.first,
            static_cast<std::size_t>(image.stride_bytes)};
}

class OpenCV : public testing::TestWithParam<Peer> {};

TEST_P(OpenCV, MakesTheSameOfIt) {
    const Peer& peer = GetParam();
    const Operator* op = find_operator(apps::all_operators(), peer.name);
    ASSERT_NE(op, nullptr);
    std::vector<int> values = peer.values;
    for (int i = static_cast<int>(values.size()); i < op->parameter_count(); ++i)
        values.push_back(op->parameters[i].preset);
    cv::setNumThreads(1);
    for (const Size size : test_sizes()) {
        for (const int block : {1, 4}) {
            OperatorRun run(*op, size, values);
            run.fill(661, block);
            const Status status = run.run();
            if (status != Status::ok && status == op->refuses) continue;
            ASSERT_EQ(status, Status::ok);
            std::vector<cv::Mat> in;
            for (int i = 0; i < op->input_count(); ++i) in.push_back(over(run.call.inputs[i], op->inputs[i]));
            cv::Mat theirs;
            peer.theirs(in, theirs);
            const cv::Mat ours = over(run.call.output, op->output);
            ASSERT_EQ(theirs.type(), ours.type());
            ASSERT_EQ(theirs.size(), ours.size());
            EXPECT_LE(cv::norm(ours, theirs, cv::NORM_INF), peer.difference)
                << size.width << "x" << size.height << ", blocks of " << block;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, OpenCV, testing::ValuesIn(peers),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace fovea::test
