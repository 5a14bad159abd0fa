// SPDX-License-Identifier: MIT
//
// The slow obvious warp: a place in double, one pixel at a time.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <fovea/image/image_view.hpp>
#include <fovea/warp/affine.hpp>
#include <fovea/warp/homography.hpp>
#include <fovea/warp/sampling.hpp>

namespace fovea::test {

struct Place {
    double x;
    double y;
};

inline double real(WarpCoefficient k) { return std::ldexp(static_cast<double>(k.raw()), -40); }

inline Place place_of(const AffineTransform& t, double x, double y) {
    return {real(t.xx) * x + real(t.xy) * y + real(t.x0), real(t.yx) * x + real(t.yy) * y + real(t.y0)};
}
/// Above 0 in front of the horizon.
inline double divisor_of(const Homography& h, double x, double y) {
    return static_cast<double>(h.wx) * x + static_cast<double>(h.wy) * y + static_cast<double>(h.w0);
}
inline Place place_of(const Homography& h, double x, double y) {
    const double w = divisor_of(h, x, y);
    return {(static_cast<double>(h.xx) * x + static_cast<double>(h.xy) * y + static_cast<double>(h.x0)) / w,
            (static_cast<double>(h.yx) * x + static_cast<double>(h.yy) * y + static_cast<double>(h.y0)) / w};
}

/// Whether a place belongs to the image: its nearest pixel is one.
inline bool belongs(Size size, Place p) {
    return p.x >= -0.5 && p.x < size.width - 0.5 && p.y >= -0.5 && p.y < size.height - 0.5;
}

/// The mean of four pixels at a place, the outermost repeated.
inline double real_bilinear(ImageView<const Gray8> src, Place p) {
    const double x = std::clamp(p.x, 0.0, src.width() - 1.0);
    const double y = std::clamp(p.y, 0.0, src.height() - 1.0);
    const int left = std::min(static_cast<int>(x), std::max(src.width() - 2, 0));
    const int top = std::min(static_cast<int>(y), std::max(src.height() - 2, 0));
    const int right = std::min(left + 1, src.width() - 1);
    const int below = std::min(top + 1, src.height() - 1);
    const double upper = src(left, top) + (x - left) * (src(right, top) - src(left, top));
    const double lower = src(left, below) + (x - left) * (src(right, below) - src(left, below));
    return upper + (y - top) * (lower - upper);
}

/// The place to 1/256 px, as the warps round it.
inline Place rounded(Place p) {
    return {std::floor(p.x * 256 + 0.5) / 256, std::floor(p.y * 256 + 0.5) / 256};
}

inline Gray8 naive_sample(ImageView<const Gray8> src, Place at, const Sampling<Gray8>& sampling) {
    const Place p = rounded(at);
    if (sampling.outside == Outside::constant && !belongs(src.size(), p)) return sampling.level;
    if (sampling.interpolation == Interpolation::bilinear)
        return static_cast<Gray8>(std::floor(real_bilinear(src, p) + 0.5));
    return src(std::clamp(static_cast<int>(std::floor(p.x + 0.5)), 0, src.width() - 1),
               std::clamp(static_cast<int>(std::floor(p.y + 0.5)), 0, src.height() - 1));
}

/// All four ways to sample.
inline std::vector<Sampling<Gray8>> samplings() {
    std::vector<Sampling<Gray8>> all;
    for (const Interpolation interpolation : {Interpolation::nearest, Interpolation::bilinear})
        for (const Outside outside : {Outside::replicate, Outside::constant})
            all.push_back({interpolation, outside, 77});
    return all;
}

}  // namespace fovea::test
