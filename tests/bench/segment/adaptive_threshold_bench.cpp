// SPDX-License-Identifier: MIT
#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

#if defined(FOVEA_HAVE_OPENCV)
[[maybe_unused]] void mean_threshold(const cv::Mat& from, int side, cv::Mat& to) {
    cv::adaptiveThreshold(from, to, 255, cv::ADAPTIVE_THRESH_MEAN_C, cv::THRESH_BINARY, side, 5);
}
#endif

const bool added = [] {
    add_operator(1400, "adaptive_threshold", Sizes::vga_and_full_hd, {15, 5},
                 FOVEA_OPENCV(mean_threshold(in[0], 15, out)), "adaptive_threshold 15x15");
    add_operator(1401, "adaptive_threshold", Sizes::vga, {51, 5},
                 FOVEA_OPENCV(mean_threshold(in[0], 51, out)), "adaptive_threshold 51x51");
    add_operator(1402, "adaptive_threshold_inverse", Sizes::vga, {15, 5}, Peer());
    add_operator(1403, "sauvola_threshold", Sizes::vga, {15, 51}, Peer());
    return true;
}();

}  // namespace
}  // namespace fovea::bench
