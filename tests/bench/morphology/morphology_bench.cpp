// SPDX-License-Identifier: MIT
#include <fovea/morphology/morphology.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// The four operators have one form of call.
template <class Operator>
void time_rectangle(Row& row, int side, std::int64_t scratch_bytes, Operator op,
                    [[maybe_unused]] int opencv_op) {
    auto& src = row.keep(part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    auto& scratch = row.keep(bytes(scratch_bytes));
    row.ours([&, side, op] { consume(op(src.view(), {side, side}, span_of(scratch), dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    const cv::Mat element = cv::getStructuringElement(cv::MORPH_RECT, {side, side});
    row.peer("OpenCV", [a = mat(src), b = mat(dst), element, opencv_op]() mutable {
        cv::morphologyEx(a, b, opencv_op, element);
    });
#endif
}

constexpr int opencv_erode = 0, opencv_dilate = 1, opencv_open = 2, opencv_close = 3;

const bool erode_3_added = add(30, "erode 3x3", Sizes::vga_and_full_hd, [](Row& row) {
    time_rectangle(row, 3, erode_scratch(row.size()), erode, opencv_erode);
});
const bool erode_15_added = add(31, "erode 15x15", Sizes::vga_and_full_hd, [](Row& row) {
    time_rectangle(row, 15, erode_scratch(row.size()), erode, opencv_erode);
});
const bool dilate_3_added = add(32, "dilate 3x3", Sizes::vga, [](Row& row) {
    time_rectangle(row, 3, dilate_scratch(row.size()), dilate, opencv_dilate);
});
const bool opening_added = add(33, "opening 3x3", Sizes::vga_and_full_hd, [](Row& row) {
    time_rectangle(row, 3, opening_scratch(row.size()), opening, opencv_open);
});
const bool closing_added = add(34, "closing 3x3", Sizes::vga, [](Row& row) {
    time_rectangle(row, 3, closing_scratch(row.size()), closing, opencv_close);
});

}  // namespace
}  // namespace fovea::bench
