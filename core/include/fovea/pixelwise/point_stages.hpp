// SPDX-License-Identifier: MIT
//
// Point operators as stages of a stream.
#pragma once

#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/threshold.hpp>
#include <fovea/pixelwise/to_gray.hpp>
#include <fovea/simd/isa.hpp>

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

/// to_gray() of colour, and of what cameras send.
struct GrayFromRgb {
    using Input = Rgb888;
    using Output = Gray8;
    static void row(const Rgb888* src, int width, Gray8* dst) { kernels::gray_row(src, width, dst); }
};
struct GrayFromYuyv {
    using Input = Yuyv;
    using Output = Gray8;
    static void row(const Yuyv* src, int width, Gray8* dst) {
        kernels::first_of_pairs_row(&src->luma, width, dst);
    }
};
struct GrayFromUyvy {
    using Input = Uyvy;
    using Output = Gray8;
    static void row(const Uyvy* src, int width, Gray8* dst) {
        kernels::second_of_pairs_row(&src->chroma, width, dst);
    }
};
inline constexpr GrayFromRgb gray_from_rgb;
inline constexpr GrayFromYuyv gray_from_yuyv;
inline constexpr GrayFromUyvy gray_from_uyvy;

}  // namespace stages
}  // namespace FOVEA_ISA
}  // namespace fovea
