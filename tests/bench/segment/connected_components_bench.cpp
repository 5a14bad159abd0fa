// SPDX-License-Identifier: MIT
#include <fovea/segment/connected_components.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// Room for the regions and holes of every picture here.
struct Lists {
    std::vector<Region> regions = std::vector<Region>(100000);
    std::vector<Hole> holes = std::vector<Hole>(100000);
    int region_count = 0;
    int hole_count = 0;
};

void time_components(Row& row, Picture<Gray8> picture) {
    auto& src = row.keep(std::move(picture));
    auto& lists = row.keep(Lists());
    auto& scratch = row.keep(bytes(connected_components_scratch(row.size().width)));
    row.ours([&] {
        consume(connected_components(
            src.view(), {}, span_of(scratch),
            ListView<Region>(lists.regions.data(), static_cast<int>(lists.regions.size()),
                             &lists.region_count),
            ListView<Hole>(lists.holes.data(), static_cast<int>(lists.holes.size()), &lists.hole_count)));
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV, with labels",
             [a = mat(src), labels = cv::Mat(), stats = cv::Mat(), centres = cv::Mat()]() mutable {
                 consume(cv::connectedComponentsWithStats(a, labels, stats, centres, 8, CV_32S));
             });
#endif
}

const bool blobs_added = add(40, "connected components, 400 discs", Sizes::vga_and_full_hd,
                             [](Row& row) { time_components(row, blobs(row.size())); });

const bool plate_added = add(41, "connected components, one part", Sizes::vga, [](Row& row) {
    Picture<Gray8> picture = part(row.size());
    for (int y = 0; y < row.size().height; ++y)
        for (int x = 0; x < row.size().width; ++x) {
            Gray8& pixel = picture.view()(x, y);
            pixel = pixel < 128 ? 255 : 0;
        }
    time_components(row, std::move(picture));
});

}  // namespace
}  // namespace fovea::bench
