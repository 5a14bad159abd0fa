// SPDX-License-Identifier: MIT
//
// Rows of half the width and height, as resizing by area and between pixels both make them.
#pragma once

#include <fovea/image/pixel.hpp>
#include <fovea/simd/backend.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace kernels {

/// Half of width pixels, each the mean of two by two.
inline void halve_row(const Gray8* upper, const Gray8* lower, int width, Gray8* dst) {
    using simd::plus;
    const auto quarter = [&](int x) {
        const simd::Words a(simd::Bytes::load(upper + 2 * x));
        const simd::Words b(simd::Bytes::load(lower + 2 * x));
        const simd::RawWords sum = plus(plus(a.even, a.odd), plus(b.even, b.odd));
        return simd::shift_right(plus(sum, simd::all_words(2)), 2);
    };
    int x = 0;
    if constexpr (simd::loads_anywhere)
        for (; x + simd::lanes <= width; x += simd::lanes)
            simd::narrowed(quarter(x), quarter(x + simd::half_lanes)).store(dst + x);
    for (; x < width; ++x)
        dst[x] =
            static_cast<Gray8>((upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1] + 2) >> 2);
}

}  // namespace kernels
}  // namespace FOVEA_ISA
}  // namespace fovea
