// SPDX-License-Identifier: MIT
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/segment/runs.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/statistics/moments.hpp>

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
    auto& runs = row.keep(std::vector<Run>(static_cast<std::size_t>(row.size().width) + 1));
    row.ours([&] {
        RunRow cut({runs.data(), static_cast<std::ptrdiff_t>(runs.size())});
        Moments moments;
        for (int y = 0; y < src.view().height(); ++y) {
            consume(cut.split(src.view().row(y), src.view().width()));
            for (int i = 0; i < cut.count(); ++i)
                if (cut.is_region(i)) moments.add_run(cut[i].first, cut.end(i), y);
        }
        consume(moments);
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src)] { consume(cv::moments(a, true)); });
#endif
});

}  // namespace
}  // namespace fovea::bench
