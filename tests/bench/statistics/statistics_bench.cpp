// SPDX-License-Identifier: MIT
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/statistics/binary_moments.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/statistics/hu_moments.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

#if defined(FOVEA_HAVE_OPENCV)
void opencv_histogram(const cv::Mat& image, cv::Mat& histogram) {
    const int channel = 0;
    const int bins = 256;
    const float range[] = {0, 256};
    const float* ranges = range;
    cv::calcHist(&image, 1, &channel, cv::Mat(), histogram, 1, &bins, &ranges);
}
#endif

void time_histogram(Row& row, Picture<Gray8> picture) {
    auto& src = row.keep(std::move(picture));
    auto& histogram = row.keep(Histogram());
    row.ours([&] { consume(histogram_of(src.view(), histogram)); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), counts = cv::Mat()]() mutable { opencv_histogram(a, counts); });
#endif
}

const bool histogram_added =
    add(20, "histogram", Sizes::vga_and_full_hd, [](Row& row) { time_histogram(row, part(row.size())); });

const bool flat_added = add(21, "histogram, one grey level", Sizes::vga,
                            [](Row& row) { time_histogram(row, Picture<Gray8>(row.size())); });

const bool otsu_added = add(22, "histogram, otsu, threshold", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    auto& histogram = row.keep(Histogram());
    row.ours([&] {
        consume(histogram_of(src.view(), histogram));
        consume(threshold(src.view(), *otsu(histogram), dst.view()));
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV",
             [a = mat(src), b = mat(dst)]() mutable { cv::threshold(a, b, 0, 255, cv::THRESH_OTSU); });
#endif
});

const bool moments_added = add(23, "moments of a binary image", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(blobs(row.size()));
    row.ours([&] { consume(moments_of(src.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src)] { consume(cv::moments(a, true)); });
#endif
});

const bool hu_added = add(24, "moments of a binary image, Hu's invariants", Sizes::vga, [](Row& row) {
    auto& src = row.keep(blobs(row.size()));
    row.ours([&] { consume(hu_moments(*moments_of(src.view()))); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src)] {
        double hu[7];
        cv::HuMoments(cv::moments(a, true), hu);
        consume(hu);
    });
#endif
});

}  // namespace
}  // namespace fovea::bench
