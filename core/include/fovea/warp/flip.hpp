// SPDX-License-Identifier: MIT
//
// Flips and quarter turns: pictures of cameras that are mounted on their side or look into a mirror. No pixel
// is computed, all are moved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Left and right exchanged.
///
/// Shapes   src and dst equal, 1x1 or larger; pixels of any type
/// Overlap  none: dst must not share pixels with src
/// Errors   empty_image, size_mismatch
/// Source   the definition
template <class Pixel>
Status flip_x(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst);

/// Top and bottom exchanged. All else as flip_x().
template <class Pixel>
Status flip_y(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst);

/// Half a turn: both exchanged. All else as flip_x().
template <class Pixel>
Status rotate_180(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst);

/// Rows become columns: dst(x, y) = src(y, x).
///
/// Shapes  dst as high as src is wide, and as wide as src is high
/// Others  as flip_x()
template <class Pixel>
Status transpose(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst);

/// A quarter turn clockwise on screen: the first row becomes the last column. All else as transpose().
template <class Pixel>
Status rotate_90_clockwise(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst);

/// A quarter turn against it: the first row becomes the first column, from its end. All else as transpose().
template <class Pixel>
Status rotate_90_counterclockwise(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// flip_x() of one row.
template <class Pixel>
void flip_row(const Pixel* src, int width, Pixel* dst) {
    int x = 0;
    if constexpr (std::is_same_v<Pixel, Gray8>) {
        for (; x + simd::lanes <= width; x += simd::lanes)
            simd::reversed(simd::Bytes::load(src + width - simd::lanes - x)).store(dst + x);
    }
    for (; x < width; ++x) dst[x] = src[width - 1 - x];
}

/// The same image with its rows in reverse order.
template <class Pixel>
ImageView<Pixel> upside_down(ImageView<Pixel> image) {
    return {image.row(image.height() - 1), image.size(), -image.stride_bytes()};
}

/// to[i] is the pixel of column x in row first + i.
template <class Pixel>
void transpose_column(ImageView<const Pixel> src, int x, int first, int rows, Pixel* to) {
    int i = 0;
    if constexpr (sizeof(Pixel) == 3) {
        // Four bytes in one move, the next pixel over the last of them.
        if (x + 1 < src.width())
            for (; i + 1 < rows; ++i) std::memcpy(static_cast<void*>(to + i), src.row(first + i) + x, 4);
    }
    for (; i < rows; ++i) to[i] = src.row(first + i)[x];
}

template <class Pixel>
void transpose_frame(ImageView<const Pixel> src, ImageView<Pixel> dst) {
    constexpr int side = simd::square_side;
    for (int top = 0; top < src.height(); top += side) {
        const int rows = minimum(side, src.height() - top);
        int left = 0;
        if constexpr (std::is_same_v<Pixel, Gray8>) {
            if (rows == side)
                for (; left + side <= src.width(); left += side)
                    simd::transpose_square(src.row(top) + left, src.stride_bytes(), dst.row(left) + top,
                                           dst.stride_bytes());
        }
        // The rest, and other pixels: so few columns at a time that their rows stay in the cache.
        for (; left < src.width(); left += side) {
            const int columns = minimum(side, src.width() - left);
            for (int k = 0; k < columns; ++k)
                transpose_column(src, left + k, top, rows, dst.row(left + k) + top);
        }
    }
}

template <class Pixel>
Status check_transpose(ImageView<const Pixel> src, ImageView<Pixel> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.width() != src.height() || dst.height() != src.width()) return Status::size_mismatch;
    return Status::ok;
}

}  // namespace kernels

template <class Pixel>
Status flip_x(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    for (int y = 0; y < src.height(); ++y) kernels::flip_row(src.row(y), src.width(), dst.row(y));
    return Status::ok;
}

template <class Pixel>
Status flip_y(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    for (int y = 0; y < src.height(); ++y)
        std::memcpy(dst.row(src.height() - 1 - y), src.row(y),
                    sizeof(Pixel) * static_cast<std::size_t>(src.width()));
    return Status::ok;
}

template <class Pixel>
Status rotate_180(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    return flip_x<Pixel>(src, kernels::upside_down(dst));
}

template <class Pixel>
Status transpose(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst) {
    if (Status s = kernels::check_transpose<Pixel>(src, dst); s != Status::ok) return s;
    kernels::transpose_frame<Pixel>(src, dst);
    return Status::ok;
}

template <class Pixel>
Status rotate_90_clockwise(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst) {
    if (Status s = kernels::check_transpose<Pixel>(src, dst); s != Status::ok) return s;
    kernels::transpose_frame<Pixel>(kernels::upside_down(src), dst);
    return Status::ok;
}

template <class Pixel>
Status rotate_90_counterclockwise(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst) {
    if (Status s = kernels::check_transpose<Pixel>(src, dst); s != Status::ok) return s;
    kernels::transpose_frame<Pixel>(src, kernels::upside_down(dst));
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
