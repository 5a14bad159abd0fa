// SPDX-License-Identifier: MIT
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/pixelwise/to_gray.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

const bool threshold_added = add(10, "threshold", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    row.ours([&] { consume(threshold(src.view(), 128, dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV",
             [a = mat(src), b = mat(dst)]() mutable { cv::threshold(a, b, 127, 255, cv::THRESH_BINARY); });
#endif
});

const bool range_added = add(11, "threshold_range", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    row.ours([&] { consume(threshold_range(src.view(), 40, 200, dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), b = mat(dst)]() mutable { cv::inRange(a, 40, 200, b); });
#endif
});

const bool to_gray_added = add(12, "to_gray of RGB", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(coloured_part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    row.ours([&] { consume(to_gray(src.view(), dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), b = mat(dst)]() mutable { cv::cvtColor(a, b, cv::COLOR_RGB2GRAY); });
#endif
});

const bool luma_added = add(13, "to_gray of YUYV", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(Picture<Yuyv>(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    row.ours([&] { consume(to_gray(src.view(), dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    const cv::Mat pairs(row.size().height, row.size().width, CV_8UC2, src.data());
    row.peer("OpenCV", [pairs, b = mat(dst)]() mutable { cv::cvtColor(pairs, b, cv::COLOR_YUV2GRAY_YUY2); });
#endif
});

}  // namespace
}  // namespace fovea::bench
