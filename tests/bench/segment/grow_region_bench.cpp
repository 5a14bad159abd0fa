// SPDX-License-Identifier: MIT
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/segment/grow_region.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

const bool grow_added =
    add(1840, "grow_region, the ground around a part", Sizes::vga_and_full_hd, [](Row& row) {
        auto& src = row.keep(part(row.size()));
        consume(threshold(src.view(), 128, src.view()));
        auto& mask = row.keep(Picture<Gray8>(row.size()));
        auto& scratch = row.keep(bytes(grow_region_scratch()));
        row.ours([&] {
            consume(
                grow_region(src.view(), {0, 0}, 255, 255, Connectivity::four, span_of(scratch), mask.view()));
        });
#if defined(FOVEA_HAVE_OPENCV)
        row.peer("OpenCV", [a = mat(src), m = cv::Mat()]() mutable {
            m = cv::Mat::zeros(a.rows + 2, a.cols + 2, CV_8UC1);
            consume(cv::floodFill(a, m, cv::Point(0, 0), cv::Scalar(0), nullptr, cv::Scalar(0), cv::Scalar(0),
                                  4 | cv::FLOODFILL_MASK_ONLY | 255 << 8));
        });
#endif
    });

const bool flood_added = add(1841, "flood_fill, the ground around a part", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    consume(threshold(src.view(), 128, src.view()));
    auto& level = row.keep(Gray8{254});
    auto& scratch = row.keep(bytes(flood_fill_scratch(row.size())));
    row.ours([&] {
        consume(flood_fill(src.view(), {0, 0}, level, Connectivity::four, span_of(scratch)));
        level = level == 254 ? 255 : 254;
    });
#if defined(FOVEA_HAVE_OPENCV)
    auto& copy = row.keep(mat(src).clone());
    row.peer("OpenCV", [&copy, other = 254]() mutable {
        consume(cv::floodFill(copy, cv::Point(0, 0), cv::Scalar(other), nullptr, cv::Scalar(0), cv::Scalar(0),
                              4));
        other = other == 254 ? 255 : 254;
    });
#endif
});

}  // namespace
}  // namespace fovea::bench
