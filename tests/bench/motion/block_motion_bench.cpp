// SPDX-License-Identifier: MIT
#include <cstdint>
#include <vector>

#include <fovea/motion/block_motion.hpp>

#include <bench/harness.hpp>
#include <bench/pictures.hpp>

namespace fovea::bench {
namespace {

const bool added = add(53, "block_motion, blocks of 16", Sizes::vga_and_full_hd, [](Row& row) {
    const BlockMotionOptions options;
    const Size size = row.size();
    auto& src = row.keep(part(size));
    auto& scratch = row.keep(bytes(block_motion_scratch(size, options.block)));
    auto& background =
        row.keep(std::vector<std::uint16_t>(static_cast<std::size_t>(blocks_of(size, options.block).area())));
    auto& motion = row.keep(BlockMotionAccumulator(
        options, {background.data(), static_cast<std::ptrdiff_t>(background.size())}, span_of(scratch)));
    row.moves(size.area());
    row.ours([&] { consume(block_motion(src.view(), motion)); });
});

}  // namespace
}  // namespace fovea::bench
