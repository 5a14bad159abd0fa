// SPDX-License-Identifier: MIT
//
// Point rows: an operation on one or two rows of pixels at once, for whole frames and for rows that come one
// at a time.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {
namespace detail {

/// The most pixels that are walked as one row.
inline constexpr std::int64_t max_joined_row = 1 << 30;

/// The size to walk images by: one long row where the rows of all of them follow each other without gaps.
template <class... Pixels>
constexpr Size rows_of(Size size, ImageView<Pixels>... images) {
    const bool joined =
        ((images.stride_bytes() == images.width() * static_cast<std::ptrdiff_t>(sizeof(Pixels))) && ...);
    return joined && size.area() <= max_joined_row ? Size{size.width * size.height, 1} : size;
}

}  // namespace detail

inline namespace FOVEA_ISA {
namespace kernels {

/// dst[x] = op(src[x]) for one row; dst may be src.
template <class Operation>
void point_row(const Gray8* src, int width, Operation op, Gray8* dst) {
    simd::for_each_vector(
        width,
        [&](int x, int count) {
            if (count == simd::lanes)
                op(simd::Bytes::load(src + x)).store(dst + x);
            else
                op(simd::Bytes::load(src + x, count)).store(dst + x, count);
        },
        simd::make_pairs(src, width, op, dst));
}

/// dst[x] = op(a[x], b[x]) for one row; dst may be a or b.
template <class Operation>
void point_row(const Gray8* a, const Gray8* b, int width, Operation op, Gray8* dst) {
    simd::for_each_vector(width, [&](int x, int count) {
        if (count == simd::lanes)
            op(simd::Bytes::load(a + x), simd::Bytes::load(b + x)).store(dst + x);
        else
            op(simd::Bytes::load(a + x, count), simd::Bytes::load(b + x, count)).store(dst + x, count);
    });
}

template <class Operation>
Status point_frame(ImageView<const Gray8> src, Operation op, ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    const Size rows = detail::rows_of(src.size(), src, dst);
    for (int y = 0; y < rows.height; ++y) point_row(src.row(y), rows.width, op, dst.row(y));
    return Status::ok;
}

template <class Operation>
Status point_frame(ImageView<const Gray8> a, ImageView<const Gray8> b, Operation op, ImageView<Gray8> dst) {
    if (a.empty() || b.empty()) return Status::empty_image;
    if (b.size() != a.size() || dst.size() != a.size()) return Status::size_mismatch;
    const Size rows = detail::rows_of(a.size(), a, b, dst);
    for (int y = 0; y < rows.height; ++y) point_row(a.row(y), b.row(y), rows.width, op, dst.row(y));
    return Status::ok;
}

}  // namespace kernels
}  // namespace FOVEA_ISA
}  // namespace fovea
