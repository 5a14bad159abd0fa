// SPDX-License-Identifier: MIT
#include <cstdlib>

#include <fovea/measure/half_turn.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/segment/fine_moments.hpp>
#include <fovea/segment/level_contour.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

constexpr LevelSet dark{128, true};

/// The plate, found.
struct Found {
    explicit Found(Size size) : picture(part(size)) {
        Picture<Gray8> binary(size);
        Bytes scratch = bytes(connected_components_scratch(size.width));
        ComponentOptions options;
        options.area_min = 1000;
        options.hole_area_min = 100;
        List<Region, 4> regions;
        if (threshold_inverse(picture.view(), dark.level, binary.view()) != Status::ok ||
            connected_components(binary.view(), options, span_of(scratch), regions, holes) != Status::ok ||
            regions.size() != 1)
            std::abort();
        region = regions[0];
    }

    Picture<Gray8> picture;
    Region region;
    List<Hole, 8> holes;
};

const bool contour_added = add(42, "level contour of a part", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& found = row.keep(Found(row.size()));
    row.ours([&] {
        FinePoint last;
        consume(trace_level_contour(found.picture.view(), dark, Connectivity::eight, found.region.first,
                                    [&](FinePoint point) { last = point; }));
        consume(last);
    });
#if defined(FOVEA_HAVE_OPENCV)
    auto& binary = row.keep(Picture<Gray8>(row.size()));
    consume(threshold_inverse(found.picture.view(), dark.level, binary.view()));
    row.peer("OpenCV, of whole pixels",
             [a = mat(binary), contours = std::vector<std::vector<cv::Point>>()]() mutable {
                 cv::findContours(a, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
             });
#endif
});

const bool moments_added = add(43, "fine moments of a part with two holes", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& found = row.keep(Found(row.size()));
    row.ours([&] { consume(fine_moments(found.picture.view(), dark, found.region, found.holes.span())); });
});

const bool symmetry_added = add(43, "symmetry of a part with two holes, one order", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& found = row.keep(Found(row.size()));
    const FinePoint middle =
        fine_moments(found.picture.view(), dark, found.region, found.holes.span())->centroid;
    row.ours([&, middle] {
        consume(fine_symmetry(found.picture.view(), dark, found.region, found.holes.span(), middle, 4,
                              PixelAspect::from_int(1)));
    });
});

const bool ends_added = add(44, "orientation and which end", Sizes::vga, [](Row& row) {
    row.not_per_pixel();
    auto& found = row.keep(Found(row.size()));
    auto& moments = row.keep(*fine_moments(found.picture.view(), dark, found.region, found.holes.span()));
    row.ours([&] {
        const Result<Asymmetry> ends = asymmetry(moments, orientation(moments)->axis);
        consume(half_turn(*ends, *ends));
    });
});

}  // namespace
}  // namespace fovea::bench
