// SPDX-License-Identifier: MIT
//
// Copying and filling, of whole images and of the frame along their border. A part of an image is a crop of
// its view.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/pixelwise/point_rows.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The pixels of src.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none, but dst may be src
/// Errors   empty_image, size_mismatch
/// Source   the toolkit's CopyImage; its two modes are crops of src or dst
template <class Pixel>
Status copy(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst);

/// One value in every pixel.
///
/// Shapes   dst 1x1 or larger
/// Errors   empty_image
/// Source   the toolkit's Zero; a region is a crop of dst
template <class Pixel>
Status fill(NonDeduced<Pixel> value, ImageView<Pixel> dst);

/// One value in the frame: all pixels less than thickness away from the border. The others stay.
///
/// Shapes   dst 1x1 or larger
/// Errors   empty_image, bad_argument for a thickness below 1
/// Source   the toolkit's ZeroFrame
template <class Pixel>
Status fill_frame(NonDeduced<Pixel> value, int thickness, ImageView<Pixel> dst);

/// The frame of src into the frame of dst. The others stay.
///
/// Shapes   src and dst equal, 1x1 or larger
/// Overlap  none, but dst may be src
/// Errors   empty_image, size_mismatch, bad_argument for a thickness below 1
/// Source   the toolkit's CopyFrame
template <class Pixel>
Status copy_frame(NonDeduced<ImageView<const Pixel>> src, int thickness, ImageView<Pixel> dst);

/// The pixels of src, but in the frame the nearest pixel inside of it.
///
/// Shapes   src and dst equal, larger than the frame on both sides
/// Overlap  none, but dst may be src
/// Errors   empty_image, size_mismatch, bad_argument for a thickness below 1, or where nothing is inside
/// Source   the toolkit's AdaptFrame
template <class Pixel>
Status replicate_frame(NonDeduced<ImageView<const Pixel>> src, int thickness, ImageView<Pixel> dst);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

template <class Pixel>
void copy_run(const Pixel* src, int count, Pixel* dst) {
    static_assert(std::is_trivially_copyable_v<Pixel>, "pixels are copied as bytes");
    if (src != dst) std::memcpy(dst, src, sizeof(Pixel) * static_cast<std::size_t>(count));
}

template <class Pixel>
void fill_pixels(Pixel value, int count, Pixel* dst) {
    if constexpr (sizeof(Pixel) == 1)
        std::memset(dst, static_cast<int>(value), static_cast<std::size_t>(count));
    else
        for (int i = 0; i < count; ++i) dst[i] = value;
}

/// visit(y, first, count) for the runs of the frame, top to bottom.
template <class Visit>
void for_each_frame_run(Size size, int thickness, Visit visit) {
    for (int y = 0; y < size.height; ++y) {
        const bool across =
            y < thickness || y >= size.height - thickness || thickness >= size.width - thickness;
        visit(y, 0, across ? size.width : thickness);
        if (!across) visit(y, size.width - thickness, thickness);
    }
}

}  // namespace detail

template <class Pixel>
Status copy(NonDeduced<ImageView<const Pixel>> src, ImageView<Pixel> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    const Size rows = detail::rows_of(src.size(), src, dst);
    for (int y = 0; y < rows.height; ++y) detail::copy_run(src.row(y), rows.width, dst.row(y));
    return Status::ok;
}

template <class Pixel>
Status fill(NonDeduced<Pixel> value, ImageView<Pixel> dst) {
    if (dst.empty()) return Status::empty_image;
    const Size rows = detail::rows_of(dst.size(), dst);
    for (int y = 0; y < rows.height; ++y) detail::fill_pixels(value, rows.width, dst.row(y));
    return Status::ok;
}

template <class Pixel>
Status fill_frame(NonDeduced<Pixel> value, int thickness, ImageView<Pixel> dst) {
    if (dst.empty()) return Status::empty_image;
    if (thickness < 1) return Status::bad_argument;
    detail::for_each_frame_run(dst.size(), thickness, [&](int y, int first, int count) {
        detail::fill_pixels(value, count, dst.row(y) + first);
    });
    return Status::ok;
}

template <class Pixel>
Status copy_frame(NonDeduced<ImageView<const Pixel>> src, int thickness, ImageView<Pixel> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (thickness < 1) return Status::bad_argument;
    detail::for_each_frame_run(dst.size(), thickness, [&](int y, int first, int count) {
        detail::copy_run(src.row(y) + first, count, dst.row(y) + first);
    });
    return Status::ok;
}

template <class Pixel>
Status replicate_frame(NonDeduced<ImageView<const Pixel>> src, int thickness, ImageView<Pixel> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    // Compared without doubling a thickness of any size.
    const int inside = minimum(src.width(), src.height()) - 1;
    if (thickness < 1 || thickness > inside / 2) return Status::bad_argument;
    const int last = src.height() - thickness - 1;
    for (int y = thickness; y <= last; ++y) {
        Pixel* row = dst.row(y);
        detail::copy_run(src.row(y), src.width(), row);
        detail::fill_pixels(row[thickness], thickness, row);
        detail::fill_pixels(row[src.width() - thickness - 1], thickness, row + src.width() - thickness);
    }
    for (int i = 0; i < thickness; ++i) {
        detail::copy_run(dst.row(thickness), src.width(), dst.row(i));
        detail::copy_run(dst.row(last), src.width(), dst.row(last + 1 + i));
    }
    return Status::ok;
}

}  // namespace fovea
