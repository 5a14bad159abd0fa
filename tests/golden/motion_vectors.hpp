// SPDX-License-Identifier: MIT
//
// Golden vectors of motion/.
#pragma once

#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/motion/block_motion.hpp>
#include <fovea/stream/stream.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const BlockMotion& motion) {
    digest.add(motion.changed, motion.box, motion.light);
}

/// A dark square that wanders over noise, in light that changes.
inline void motion_blocks(Workspace& work, Digest& digest) {
    Random random(72);
    for (const Size size : {Size{1, 1}, Size{33, 7}, Size{97, 70}, Size{211, 5}})
        for (const int block : {4, 16, 128}) {
            BlockMotionOptions options;
            options.block = block;
            options.follow = random.between(0, 8);
            const Size blocks = blocks_of(size, block);
            const Span<std::uint16_t> background(reinterpret_cast<std::uint16_t*>(work.image[1]),
                                                 static_cast<std::ptrdiff_t>(blocks.area()));
            const std::int64_t bytes = block_motion_scratch(size, block);
            BlockMotionAccumulator motion(options, background, work.scratch_span().first(bytes));
            auto program = stream(into(motion));
            digest.add(blocks, motion.begin({max_image_side + 1, 1}));
            for (int frame = 0; frame < 6; ++frame) {
                const ImageView<Gray8> image = work.view<Gray8>(0, size);
                const int light = random.between(60, 200);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x) {
                        const bool thing = x / 9 == frame && y < 20;
                        image(x, y) =
                            static_cast<Gray8>((thing ? 20 : light) + static_cast<int>(random.next() >> 28));
                    }
                if (frame == 4) motion.forget();
                if (frame % 2 == 0) {
                    digest.add(block_motion(image, motion));
                } else {
                    digest.add(program.run(image, Border::zero, work.scratch_span().from(bytes)));
                    digest.add(motion.finish());
                }
                digest.add(background);
            }
            digest.add(motion.finish(), block_motion({}, motion));
        }
}

}  // namespace fovea::golden
