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

const bool to_gray_added = add(11, "to_gray of RGB", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(coloured_part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    row.ours([&] { consume(to_gray(src.view(), dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), b = mat(dst)]() mutable { cv::cvtColor(a, b, cv::COLOR_RGB2GRAY); });
#endif
});

}  // namespace
}  // namespace fovea::bench
