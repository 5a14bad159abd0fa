// SPDX-License-Identifier: MIT
//
// Arithmetic and logic of two images, pixel by pixel. Book sec. 2.4.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/pixelwise/point_rows.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The weight of blend() that stands for one.
inline constexpr int whole_weight = 256;

inline namespace FOVEA_ISA {

/// a + b modulo 256: a sum above 255 begins again at 0.
///
/// Shapes   a, b and dst equal, 1x1 or larger
/// Units    grey levels 0..255, or the bits of a byte
/// Overlap  dst may be a or b
/// Errors   empty_image, size_mismatch
/// Source   book sec. 2.4; the toolkit's Add, and so on for the functions below
inline Status add(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// a + b, at most 255. All else as add().
inline Status add_saturated(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// a - b modulo 256. All else as add().
inline Status subtract(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// a - b, at least 0. All else as add().
inline Status subtract_saturated(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// |a - b|. All else as add().
inline Status absolute_difference(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// (a + b) / 2 to the nearest, ties up. All else as add().
inline Status average(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// The smaller of both pixels. All else as add().
inline Status pixel_minimum(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// The larger of both pixels. All else as add().
inline Status pixel_maximum(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// a and b mixed: (a (256 - weight) + b weight) / 256. All else as add().
///
/// Units     weight of b in 1/256, 0 to whole_weight
/// Rounding  nearest, ties up; the largest sum is 255 * 256 + 128 and fits 16 bits
/// Errors    also bad_argument for a weight out of range
inline Status blend(ImageView<const Gray8> a, ImageView<const Gray8> b, int weight, ImageView<Gray8> dst);

/// The bits that both pixels have. With a mask of 0 and 255: the pixels of a where the mask is set. All else
/// as add().
inline Status bitwise_and(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// The bits that one of both pixels has. All else as add().
inline Status bitwise_or(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// The bits in which both pixels differ. All else as add().
inline Status bitwise_xor(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst);

/// 255 - pixel, which is the same as the complement of its bits.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  dst may be src
/// Errors   empty_image, size_mismatch
/// Source   book sec. 2.4; the toolkit's Invert
inline Status invert(ImageView<const Gray8> src, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// The operations, of vectors of pixels.
struct Add {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const { return x + y; }
};
struct AddSaturated {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const {
        return add_saturated(x, y);
    }
};
struct Subtract {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const { return x - y; }
};
struct SubtractSaturated {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const {
        return subtract_saturated(x, y);
    }
};
struct AbsoluteDifference {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const {
        // One of the two is 0.
        return subtract_saturated(x, y) | subtract_saturated(y, x);
    }
};
struct Average {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const {
        return average(x, y);
    }
};
struct PixelMinimum {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const { return lower(x, y); }
};
struct PixelMaximum {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const { return higher(x, y); }
};
struct BitwiseAnd {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const { return x & y; }
};
struct BitwiseOr {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const { return x | y; }
};
struct BitwiseXor {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const { return x ^ y; }
};
struct Blend {
    int weight;  ///< of y

    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x, simd::Bytes y) const {
        const auto of_x = static_cast<std::uint16_t>(whole_weight - weight);
        const auto of_y = static_cast<std::uint16_t>(weight);
        const simd::Words half = simd::Words::all(whole_weight / 2);
        return ((simd::Words(x) * of_x + simd::Words(y) * of_y + half) >> 8).narrow();
    }
};
struct Invert {
    [[gnu::always_inline]] simd::Bytes operator()(simd::Bytes x) const { return ~x; }
};

}  // namespace kernels

inline Status add(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::Add(), dst);
}

inline Status add_saturated(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::AddSaturated(), dst);
}

inline Status subtract(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::Subtract(), dst);
}

inline Status subtract_saturated(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::SubtractSaturated(), dst);
}

inline Status absolute_difference(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::AbsoluteDifference(), dst);
}

inline Status average(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::Average(), dst);
}

inline Status pixel_minimum(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::PixelMinimum(), dst);
}

inline Status pixel_maximum(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::PixelMaximum(), dst);
}

inline Status blend(ImageView<const Gray8> a, ImageView<const Gray8> b, int weight, ImageView<Gray8> dst) {
    if (a.empty() || b.empty()) return Status::empty_image;
    if (b.size() != a.size() || dst.size() != a.size()) return Status::size_mismatch;
    if (weight < 0 || weight > whole_weight) return Status::bad_argument;
    return kernels::point_frame(a, b, kernels::Blend{weight}, dst);
}

inline Status bitwise_and(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::BitwiseAnd(), dst);
}

inline Status bitwise_or(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::BitwiseOr(), dst);
}

inline Status bitwise_xor(ImageView<const Gray8> a, ImageView<const Gray8> b, ImageView<Gray8> dst) {
    return kernels::point_frame(a, b, kernels::BitwiseXor(), dst);
}

inline Status invert(ImageView<const Gray8> src, ImageView<Gray8> dst) {
    return kernels::point_frame(src, kernels::Invert(), dst);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
