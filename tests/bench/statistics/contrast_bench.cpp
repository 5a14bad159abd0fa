// SPDX-License-Identifier: MIT
#include <fovea/statistics/colour_histogram.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/statistics/integral_image.hpp>
#include <fovea/statistics/projection.hpp>
#include <fovea/statistics/reductions.hpp>

#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

#if defined(FOVEA_HAVE_OPENCV)
/// Every channel equalized on its own.
[[maybe_unused]] void equalize_channels(const cv::Mat& from, cv::Mat& to) {
    std::vector<cv::Mat> channels;
    cv::split(from, channels);
    for (cv::Mat& channel : channels) cv::equalizeHist(channel, channel);
    cv::merge(channels, to);
}
[[maybe_unused]] void stretch(const cv::Mat& from, cv::Mat& to) {
    cv::normalize(from, to, 0, 255, cv::NORM_MINMAX, CV_8U);
}
[[maybe_unused]] void clahe_of(const cv::Mat& from, cv::Mat& to) {
    cv::createCLAHE(2.0, {8, 8})->apply(from, to);
}
#endif

const bool added = [] {
    add_operator(1300, "spread", Sizes::vga, {}, FOVEA_OPENCV(stretch(in[0], out)));
    add_operator(1301, "histogram_stretching", Sizes::vga, {}, Peer());
    add_operator(1302, "equalize", Sizes::vga_and_full_hd, {}, FOVEA_OPENCV(cv::equalizeHist(in[0], out)));
    add_operator(1303, "equalize_by_share", Sizes::vga, {}, Peer());
    add_operator(1304, "normalize_colour", Sizes::vga, {}, FOVEA_OPENCV(equalize_channels(in[0], out)));
    add_operator(1305, "clahe", Sizes::vga_and_full_hd, {8, 8, 200}, FOVEA_OPENCV(clahe_of(in[0], out)));
    add_operator(1306, "auto_scale_gray16", Sizes::vga, {}, FOVEA_OPENCV(stretch(in[0], out)));
    add_operator(1307, "otsu_threshold", Sizes::vga_and_full_hd, {},
                 FOVEA_OPENCV(cv::threshold(in[0], out, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU)));
    add_operator(1308, "otsu_threshold_inverse", Sizes::vga, {},
                 FOVEA_OPENCV(cv::threshold(in[0], out, 0, 255, cv::THRESH_BINARY_INV | cv::THRESH_OTSU)));
    add_operator(1310, "integral_image", Sizes::vga_and_full_hd, {},
                 FOVEA_OPENCV(cv::integral(in[0], out, CV_32S)));
    add_operator(1311, "integral_of_binary", Sizes::vga, {}, Peer());
    add_operator(1312, "image_of_integral", Sizes::vga, {}, Peer());
    return true;
}();

const bool squares_added = add(1313, "integral_of_squares", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& dst = row.keep(Picture<Sum64>(integral_size(row.size())));
    row.ours([&] { consume(integral_of_squares(src.view(), dst.view())); });
});

const bool rectangle_added = add(1314, "rectangle_sum, 1000 rectangles", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& sums = row.keep(Picture<Sum32>(integral_size(row.size())));
    static_cast<void>(integral_image(src.view(), sums.view()));
    row.not_per_pixel();
    row.ours([&] {
        const ImageView<const Sum32> integral = sums.view();
        for (int i = 0; i < 500; ++i) {
            consume(rectangle_sum(integral, {i, i / 2, 31, 21}));
            consume(rectangle_sum_unchecked(integral, {i, i / 2, 31, 21}));
        }
    });
});

const bool extremes_added = add(1320, "extremes_of", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    row.ours([&] { consume(extremes_of(src.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src)] {
        double low = 0;
        double high = 0;
        cv::minMaxLoc(a, &low, &high);
        consume(high);
    });
#endif
});

const bool wide_extremes_added = add(1321, "extremes_of 16 bits", Sizes::vga, [](Row& row) {
    auto& src = row.keep(Picture<Gray16>(row.size()));
    row.ours([&] { consume(extremes_of(src.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = cv::Mat(row.size().height, row.size().width, CV_16UC1, src.data())] {
        double low = 0;
        double high = 0;
        cv::minMaxLoc(a, &low, &high);
        consume(high);
    });
#endif
});

const bool sum_added = add(1322, "sum_of", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    row.ours([&] { consume(sum_of(src.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src)] { consume(cv::sum(a)); });
#endif
});

const bool variance_added = add(1323, "mean_and_variance", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    row.ours([&] { consume(mean_and_variance(src.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src)] {
        cv::Scalar mean;
        cv::Scalar deviation;
        cv::meanStdDev(a, mean, deviation);
        consume(deviation);
    });
#endif
});

const bool masked_added = add(1324, "histogram with a mask", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& mask = row.keep(blobs(row.size()));
    auto& histogram = row.keep(Histogram());
    row.ours([&] { consume(histogram_of(src.view(), mask.view(), histogram)); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), m = mat(mask), counts = cv::Mat()]() mutable {
        const int channel = 0;
        const int bins = 256;
        const float range[] = {0, 256};
        const float* ranges = range;
        cv::calcHist(&a, 1, &channel, m, counts, 1, &bins, &ranges);
    });
#endif
});

const bool colours_added = add(1325, "histogram of hue and saturation", Sizes::vga, [](Row& row) {
    auto& colours = row.keep(coloured_part(row.size()));
    auto& histogram = row.keep(HueSaturationHistogram<>());
    const ImageView<const Hsv888> src(reinterpret_cast<const Hsv888*>(colours.data()), row.size(),
                                      colours.view().stride_bytes());
    row.ours([&histogram, src] { consume(histogram_of(src, histogram)); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(colours), counts = cv::Mat()]() mutable {
        const int channels[] = {0, 1};
        const int bins[] = {18, 8};
        const float hues[] = {0, 180};
        const float saturations[] = {0, 256};
        const float* ranges[] = {hues, saturations};
        cv::calcHist(&a, 1, channels, cv::Mat(), counts, 2, bins, ranges);
    });
#endif
});

/// Columns or rows of the part, with OpenCV's sums along the same side.
void time_projection(Row& row, bool columns) {
    auto& src = row.keep(part(row.size()));
    const int count = columns ? row.size().width : row.size().height;
    auto& sums = row.keep(std::vector<std::uint32_t>(static_cast<std::size_t>(count)));
    row.ours([&, count, columns] {
        const Span<std::uint32_t> span(sums.data(), count);
        consume(columns ? project_columns(src.view(), span) : project_rows(src.view(), span));
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), b = cv::Mat(), columns]() mutable {
        cv::reduce(a, b, columns ? 0 : 1, cv::REDUCE_SUM, CV_32S);
    });
#endif
}
const bool columns_added =
    add(1330, "project_columns", Sizes::vga, [](Row& row) { time_projection(row, true); });
const bool rows_added = add(1331, "project_rows", Sizes::vga, [](Row& row) { time_projection(row, false); });

}  // namespace
}  // namespace fovea::bench
