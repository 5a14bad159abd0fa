// SPDX-License-Identifier: MIT
#include <fovea/measure/run_gauge.hpp>
#include <fovea/pixelwise/threshold.hpp>

#include <bench/harness.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

const bool added = add(51, "run_widths, one part", Sizes::vga_and_full_hd, [](Row& row) {
    auto& gray = row.keep(part(row.size()));
    auto& src = row.keep(Picture<Gray8>(row.size()));
    consume(threshold_inverse(gray.view(), 128, src.view()));
    row.moves(row.size().area());
    row.ours([&] { consume(run_widths(src.view(), 2)); });
});

}  // namespace
}  // namespace fovea::bench
