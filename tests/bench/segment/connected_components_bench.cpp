// SPDX-License-Identifier: MIT
#include <fovea/segment/connected_components.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// Room for the regions and holes of every picture here.
template <class Accumulated>
struct Lists {
    std::vector<RegionOf<Accumulated>> regions = std::vector<RegionOf<Accumulated>>(100000);
    std::vector<HoleOf<Accumulated>> holes = std::vector<HoleOf<Accumulated>>(100000);
    int region_count = 0;
    int hole_count = 0;
};

template <class Accumulated = Moments>
void time_components(Row& row, Picture<Gray8> picture, bool find_holes = true) {
    auto& src = row.keep(std::move(picture));
    auto& lists = row.keep(Lists<Accumulated>());
    auto& scratch = row.keep(bytes(connected_components_scratch<Accumulated>(row.size().width)));
    ComponentOptions options;
    options.find_holes = find_holes;
    row.ours([&, options] {
        consume(connected_components<Accumulated>(
            src.view(), options, span_of(scratch),
            {lists.regions.data(), static_cast<int>(lists.regions.size()), &lists.region_count},
            {lists.holes.data(), static_cast<int>(lists.holes.size()), &lists.hole_count}));
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

const bool light_added =
    add(1830, "connected components, 400 discs, area and centroid", Sizes::vga_and_full_hd,
        [](Row& row) { time_components<FirstMoments>(row, blobs(row.size()), false); });

Picture<Gray8> noise(Size size) {
    Picture<Gray8> picture(size);
    Random random(7);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) picture.view()(x, y) = random.below(2) == 0 ? 0 : 255;
    return picture;
}

const bool noise_added = add(1831, "connected components, noise, area and centroid", Sizes::vga,
                             [](Row& row) { time_components<FirstMoments>(row, noise(row.size()), false); });
const bool noisy_holes_added = add(1832, "connected components, noise, with holes", Sizes::vga,
                                   [](Row& row) { time_components(row, noise(row.size())); });

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
