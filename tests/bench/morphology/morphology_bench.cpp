// SPDX-License-Identifier: MIT
#include <fovea/morphology/morphology.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

void time_erosion(Row& row, int side) {
    auto& src = row.keep(part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    auto& scratch = row.keep(bytes(erode_scratch(row.size())));
    row.ours([&, side] { consume(erode(src.view(), {side, side}, span_of(scratch), dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    const cv::Mat element = cv::getStructuringElement(cv::MORPH_RECT, {side, side});
    row.peer("OpenCV", [a = mat(src), b = mat(dst), element]() mutable { cv::erode(a, b, element); });
#endif
}

const bool erode_3_added =
    add(30, "erode 3x3", Sizes::vga_and_full_hd, [](Row& row) { time_erosion(row, 3); });
const bool erode_15_added =
    add(31, "erode 15x15", Sizes::vga_and_full_hd, [](Row& row) { time_erosion(row, 15); });

const bool opening_added = add(32, "opening 3x3", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    auto& scratch = row.keep(bytes(opening_scratch(row.size())));
    row.ours([&] { consume(opening(src.view(), {3, 3}, span_of(scratch), dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    const cv::Mat element = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
    row.peer("OpenCV", [a = mat(src), b = mat(dst), element]() mutable {
        cv::morphologyEx(a, b, cv::MORPH_OPEN, element);
    });
#endif
});

}  // namespace
}  // namespace fovea::bench
