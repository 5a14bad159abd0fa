// SPDX-License-Identifier: MIT
//
// Golden vectors of filter/ beside those of the catalogue.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/filter/convolve.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

/// Kernels of any size, with weights that need 16 bits and with such that need 32.
inline void filter_convolve(Workspace& work, Digest& digest) {
    Random random(11);
    const ConvolutionKernel shapes[] = {{{}, {5, 5}, 16, 0},
                                        {{}, {9, 3}, 7, 100},
                                        {{}, {1, 13}, 1, -20},
                                        {{}, {7, 7}, 999, 50},
                                        {{}, {3, 5}, 65535, 0}};
    const Size size = Workspace::picture_size;
    const ImageView<const Gray8> src = part_picture(work, 0);
    for (const ConvolutionKernel& shape : shapes)
        for (const int magnitude : {2, 1000, 32767}) {
            std::int16_t weights[49];
            for (std::int16_t& weight : weights)
                weight = static_cast<std::int16_t>(random.between(-magnitude, magnitude));
            ConvolutionKernel kernel = shape;
            kernel.weights = {weights, static_cast<std::ptrdiff_t>(shape.size.area())};
            const Span<std::uint8_t> scratch =
                work.scratch_span().first(static_cast<std::ptrdiff_t>(convolve_scratch(size, kernel.size)));
            const ImageView<Gray8> dst = work.view<Gray8>(1, size);
            const Status status = convolve(src, kernel, Border::reflect_101, scratch, dst);
            digest.add(status, dst);
            const ImageView<const Gray8> part(src.first(), {53, 39}, src.stride_bytes());
            const ImageView<Gradient16> slope = work.view<Gradient16>(2, part.size());
            const Status signed_status = convolve(part, kernel, Border::zero, scratch, slope);
            digest.add(signed_status, slope);
        }
}

}  // namespace fovea::golden
