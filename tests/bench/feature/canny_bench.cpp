// SPDX-License-Identifier: MIT
#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

const bool lines[] = {
    add_operator(2000, "canny", Sizes::vga_and_full_hd, {60, 150},
                 FOVEA_OPENCV(cv::Canny(in[0], out, 60, 150))),
};

}  // namespace
}  // namespace fovea::bench
