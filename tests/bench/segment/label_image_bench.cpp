// SPDX-License-Identifier: MIT
#include <fovea/segment/label_image.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

const bool added = add(1835, "label_image, 400 discs", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(blobs(row.size()));
    auto& dst = row.keep(Picture<Label16>(row.size()));
    auto& scratch = row.keep(bytes(label_image_scratch(row.size())));
    row.ours([&] { consume(label_image(src.view(), Connectivity::eight, span_of(scratch), dst.view())); });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), labels = cv::Mat()]() mutable {
        consume(cv::connectedComponents(a, labels, 8, CV_16U));
    });
#endif
});

}  // namespace
}  // namespace fovea::bench
