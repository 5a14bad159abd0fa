// SPDX-License-Identifier: MIT
//
// Point operators as stages of a stream.
#pragma once

#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/pixelwise/to_gray.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/triples.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace stages {

/// threshold(), threshold_inverse() at a level.
struct threshold {
    using Input = Gray8;
    using Output = Gray8;
    Gray8 level;
    void row(const Gray8* src, int width, Gray8* dst) const {
        kernels::threshold_row(src, width, level, dst);
    }
};
struct threshold_inverse {
    using Input = Gray8;
    using Output = Gray8;
    Gray8 level;
    void row(const Gray8* src, int width, Gray8* dst) const {
        kernels::threshold_inverse_row(src, width, level, dst);
    }
};

/// to_gray() of colour and of YUYV.
struct GrayFromRgb {
    using Input = Rgb888;
    using Output = Gray8;
    static void row(const Rgb888* src, int width, Gray8* dst) {
        simd::weigh_triples(&src->red, width, fovea::detail::gray_weights, dst);
    }
};
struct GrayFromYuyv {
    using Input = Yuyv;
    using Output = Gray8;
    static void row(const Yuyv* src, int width, Gray8* dst) {
        for (int x = 0; x < width; ++x) dst[x] = src[x].luma;
    }
};
inline constexpr GrayFromRgb gray_from_rgb;
inline constexpr GrayFromYuyv gray_from_yuyv;

}  // namespace stages
}  // namespace FOVEA_ISA
}  // namespace fovea
