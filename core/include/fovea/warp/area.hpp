// SPDX-License-Identifier: MIT
//
// Resize by area: every output pixel is the mean over the part of the source that it covers.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/warp/halve_row.hpp>
#include <fovea/warp/resize.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes that resize_area() needs: a sum for every source column.
constexpr std::int64_t resize_area_scratch(Size src, Size dst);

inline namespace FOVEA_ISA {

/// Each pixel of dst is the mean brightness of src over the area that it covers, pixels on its edge counted
/// by the part that lies inside.
///
/// Shapes    any sizes, 1x1 to 32767x32767; meant for making images smaller
/// Units     any 8-bit values
/// Rounding  the exact mean to the nearest, ties up. The largest sum is 255 * 32767^2, below 2^38
/// Border    none is needed
/// Overlap   none
/// Scratch   resize_area_scratch(src.size(), dst.size()) bytes, undefined afterwards
/// Errors    empty_image, image_too_large, scratch_too_small
/// Source    the definition. An output row needs the source rows that it covers, src.height() / dst.height()
///           and 2 at most
inline Status resize_area(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

constexpr std::int64_t resize_area_scratch(Size src, Size /*dst*/) {
    return arena_bytes<std::uint32_t>(src.width);
}

inline namespace FOVEA_ISA {
namespace kernels {

/// Means over whole pixels, columns by rows each.
inline void average_row(const std::uint32_t* sums, int columns, int rows, int width, Gray8* dst) {
    const auto count = static_cast<std::uint32_t>(columns) * static_cast<std::uint32_t>(rows);
    if (static_cast<std::uint64_t>(count) * 255 + count / 2 <= 0xffffffffu) {
        for (int x = 0; x < width; ++x, sums += columns) {
            std::uint32_t sum = count / 2;
            for (int i = 0; i < columns; ++i) sum += sums[i];
            dst[x] = static_cast<Gray8>(sum / count);
        }
        return;
    }
    for (int x = 0; x < width; ++x, sums += columns) {
        std::uint64_t sum = count / 2;
        for (int i = 0; i < columns; ++i) sum += sums[i];
        dst[x] = static_cast<Gray8>(sum / count);
    }
}

/// Means where pixels are cut: column i counts by the part of (i, i + 1) * to within (x, x + 1) * from.
inline void average_cut_row(const std::uint32_t* sums, int from, int to, std::uint64_t count, Gray8* dst) {
    std::int64_t begin = 0;
    int i = 0;
    for (int x = 0; x < to; ++x) {
        const std::int64_t end = begin + from;
        std::uint64_t sum = count / 2;
        std::int64_t at = begin;
        while (at < end) {
            const std::int64_t next = minimum((i + std::int64_t{1}) * to, end);
            sum += sums[i] * static_cast<std::uint64_t>(next - at);
            at = next;
            if (at == (i + std::int64_t{1}) * to) ++i;
        }
        dst[x] = static_cast<Gray8>(sum / count);
        begin = end;
    }
}

inline void add_row(const Gray8* row, std::uint32_t weight, int width, std::uint32_t* sums) {
    for (int x = 0; x < width; ++x) sums[x] += row[x] * weight;
}

}  // namespace kernels

inline Status resize_area(ImageView<const Gray8> src, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    const std::int64_t needed = resize_area_scratch(src.size(), dst.size());
    if (Status s = detail::check_resize<Gray8>(src, needed, scratch, dst); s != Status::ok) return s;
    const int columns = src.width() / dst.width();
    const int rows = src.height() / dst.height();
    const bool whole = src.width() % dst.width() == 0 && src.height() % dst.height() == 0;
    if (whole && columns == 2 && rows == 2) {
        for (int y = 0; y < dst.height(); ++y)
            kernels::halve_row(src.row(2 * y), src.row(2 * y + 1), dst.width(), dst.row(y));
        return Status::ok;
    }
    const Span<std::uint32_t> sums = Arena(scratch).take<std::uint32_t>(src.width());
    const auto from = std::int64_t{src.height()};
    const auto to = std::int64_t{dst.height()};
    const auto count = static_cast<std::uint64_t>(src.size().area());
    for (int y = 0; y < dst.height(); ++y) {
        for (std::uint32_t& sum : sums) sum = 0;
        // Rows y * from / to up to (y + 1) * from / to, each by the part inside, in 1 / to; in all at most
        // 255 * 32767 a column.
        for (std::int64_t at = y * from; at < (y + 1) * from;) {
            const std::int64_t row = at / to;
            const std::int64_t next = minimum((row + 1) * to, (y + 1) * from);
            const std::int64_t part = whole ? 1 : next - at;
            kernels::add_row(src.row(static_cast<int>(row)), static_cast<std::uint32_t>(part), src.width(),
                             sums.data());
            at = next;
        }
        if (whole)
            kernels::average_row(sums.data(), columns, rows, dst.width(), dst.row(y));
        else
            kernels::average_cut_row(sums.data(), src.width(), dst.width(), count, dst.row(y));
    }
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
