// SPDX-License-Identifier: MIT
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/light_section/line_peak.hpp>

#include <bench/harness.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

/// A line of five pixels with a step in the middle, on noise.
Picture<Gray8> laser_line(Size size) {
    Picture<Gray8> picture(size);
    Random random(5);
    for (int y = 0; y < size.height; ++y) {
        const int centre = size.width / 3 + y / 4 + (y > size.height / 2 ? 20 : 0);
        for (int x = 0; x < size.width; ++x) {
            const int distance = x < centre ? centre - x : x - centre;
            const int light = distance < 3 ? 200 - 50 * distance : 15;
            picture.view()(x, y) = static_cast<Gray8>(light + static_cast<int>(random.below(16)));
        }
    }
    return picture;
}

const bool added = add(52, "line_peaks, a laser line", Sizes::vga_and_full_hd, [](Row& row) {
    auto& src = row.keep(laser_line(row.size()));
    auto& peaks = row.keep(std::vector<LinePeak>(static_cast<std::size_t>(row.size().height)));
    row.moves(row.size().area());
    row.ours([&] {
        consume(line_peaks(src.view(), {}, {peaks.data(), static_cast<std::ptrdiff_t>(peaks.size())}));
    });
});

}  // namespace
}  // namespace fovea::bench
