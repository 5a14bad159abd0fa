// SPDX-License-Identifier: MIT
#include <fovea/warp/bilinear.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// Where a pixel of an image comes from that is turned a little about its upper left corner and made smaller,
/// so that all of it is there.
FinePoint source_of(int x, int y) {
    return {FinePixel::from_raw(60000 * x + 3000 * (480 - y) / 8),
            FinePixel::from_raw(3000 * x / 8 + 60000 * y)};
}

const bool bilinear_added = add(45, "sample_bilinear, a point a pixel", Sizes::vga, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& dst = row.keep(Picture<Gray8>(row.size()));
    row.ours([&] {
        const ImageView<const Gray8> from = src.view();
        for (int y = 0; y < from.height(); ++y)
            for (int x = 0; x < from.width(); ++x) {
                const Result<GrayLevel> level = sample_bilinear(from, source_of(x, y));
                dst.view()(x, y) = level ? static_cast<Gray8>(level->round()) : Gray8{0};
            }
        consume(dst);
    });
#if defined(FOVEA_HAVE_OPENCV)
    cv::Mat map_x(row.size().height, row.size().width, CV_32F);
    cv::Mat map_y(row.size().height, row.size().width, CV_32F);
    for (int y = 0; y < row.size().height; ++y)
        for (int x = 0; x < row.size().width; ++x) {
            map_x.at<float>(y, x) = static_cast<float>(source_of(x, y).x.raw()) / 65536.0f;
            map_y.at<float>(y, x) = static_cast<float>(source_of(x, y).y.raw()) / 65536.0f;
        }
    row.peer("OpenCV, remap", [a = mat(src), b = mat(dst), map_x, map_y]() mutable {
        cv::remap(a, b, map_x, map_y, cv::INTER_LINEAR);
    });
#endif
});

}  // namespace
}  // namespace fovea::bench
