// SPDX-License-Identifier: MIT
//
// Several operators in one pass, beside OpenCV's calls one after the other.
#include <fovea/filter/gaussian.hpp>
#include <fovea/filter/sobel.hpp>
#include <fovea/morphology/morphology_stages.hpp>
#include <fovea/pixelwise/copy.hpp>
#include <fovea/pixelwise/point_stages.hpp>
#include <fovea/statistics/binary_moments.hpp>
#include <fovea/stream/stream.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

#if defined(FOVEA_HAVE_OPENCV)
/// Edges of a colour image, binary.
void opencv_edges(const cv::Mat& src, cv::Mat& dst) {
    static cv::Mat gray, smooth, x, y, a, b, sum;
    cv::cvtColor(src, gray, cv::COLOR_RGB2GRAY);
    cv::GaussianBlur(gray, smooth, {5, 5}, 0, 0, cv::BORDER_REPLICATE);
    cv::Sobel(smooth, x, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
    cv::Sobel(smooth, y, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
    cv::convertScaleAbs(x, a);
    cv::convertScaleAbs(y, b);
    cv::add(a, b, sum);
    cv::threshold(sum, dst, 39, 255, cv::THRESH_BINARY);
}

/// What is not in the background, without specks.
void opencv_foreground(const cv::Mat& src, const cv::Mat& background, cv::Mat& dst) {
    static cv::Mat difference, level;
    static const cv::Mat element = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
    cv::absdiff(src, background, difference);
    cv::threshold(difference, level, 39, 255, cv::THRESH_BINARY);
    cv::morphologyEx(level, dst, cv::MORPH_OPEN, element);
}
#endif

const bool edges_added =
    add(250, "gray, gaussian_5x5, sobel_magnitude, threshold", Sizes::vga_and_full_hd, [](Row& row) {
        auto& src = row.keep(coloured_part(row.size()));
        auto& dst = row.keep(Picture<Gray8>(row.size()));
        auto& program = row.keep(stream(stages::gray_from_rgb, stages::gaussian_5x5, stages::sobel_magnitude,
                                        stages::threshold{40}, into(dst.view())));
        auto& scratch = row.keep(bytes(program.scratch(row.size().width)));
        row.ours([&] { consume(program.run(src.view(), Border::replicate, span_of(scratch))); });
#if defined(FOVEA_HAVE_OPENCV)
        row.peer("OpenCV", [a = mat(src), b = mat(dst)]() mutable { opencv_edges(a, b); });
#endif
    });

const bool foreground_added =
    add(251, "absolute_difference, threshold, opening 3x3", Sizes::vga_and_full_hd, [](Row& row) {
        auto& src = row.keep(part(row.size()));
        auto& background = row.keep(Picture<Gray8>(row.size()));
        static_cast<void>(fill(Gray8{200}, background.view()));
        auto& dst = row.keep(Picture<Gray8>(row.size()));
        auto& program = row.keep(stream(stages::absolute_difference{background.view()}, stages::threshold{40},
                                        stages::opening{{3, 3}}, into(dst.view())));
        auto& scratch = row.keep(bytes(program.scratch(row.size().width)));
        row.ours([&] { consume(program.run(src.view(), Border::replicate, span_of(scratch))); });
#if defined(FOVEA_HAVE_OPENCV)
        row.peer("OpenCV",
                 [a = mat(src), b = mat(background), c = mat(dst)]() mutable { opencv_foreground(a, b, c); });
#endif
    });

/// The same to the moments of the edges: no image is written at all.
const bool measured_added =
    add(251, "gray, gaussian_5x5, sobel_magnitude, threshold, moments", Sizes::vga_and_full_hd, [](Row& row) {
        auto& src = row.keep(coloured_part(row.size()));
        auto& program = row.keep(stream(stages::gray_from_rgb, stages::gaussian_5x5, stages::sobel_magnitude,
                                        stages::threshold{40}, BinaryMoments()));
        auto& scratch = row.keep(bytes(program.scratch(row.size().width)));
        row.ours([&] {
            consume(program.run(src.view(), Border::replicate, span_of(scratch)));
            consume(program.accumulator().moments());
        });
#if defined(FOVEA_HAVE_OPENCV)
        row.peer("OpenCV", [a = mat(src), b = cv::Mat()]() mutable {
            opencv_edges(a, b);
            consume(cv::moments(b, true));
        });
#endif
    });

}  // namespace
}  // namespace fovea::bench
