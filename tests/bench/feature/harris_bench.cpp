// SPDX-License-Identifier: MIT
#include <vector>

#include <fovea/feature/harris_points.hpp>

#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

const bool lines[] = {
    add_operator(2030, "harris_response", Sizes::vga_and_full_hd, {},
                 FOVEA_OPENCV(cv::cornerHarris(in[0], out, 3, 3, 1 / 16.0, cv::BORDER_REPLICATE))),
};

/// Up to 500 points; OpenCV's function takes the same share, distance and number.
const bool points_added = add(2031, "Harris points", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(part(row.size()));
    auto& points = row.keep(std::vector<HarrisPoint>(500));
    auto& count = row.keep(0);
    auto& scratch = row.keep(bytes(harris_points_scratch(row.size(), {})));
    row.ours([&] {
        consume(
            harris_points(src.view(), {}, Border::replicate, span_of(scratch), {points.data(), 500, &count}));
    });
#if defined(FOVEA_HAVE_OPENCV)
    row.peer("OpenCV", [a = mat(src), found = std::vector<cv::Point2f>()]() mutable {
        cv::goodFeaturesToTrack(a, found, 500, 0.01, 5, cv::noArray(), 3, true, 1 / 16.0);
    });
#endif
});

}  // namespace
}  // namespace fovea::bench
