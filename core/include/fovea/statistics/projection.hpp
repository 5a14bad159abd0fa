// SPDX-License-Identifier: MIT
//
// Projections: the sum of every column, the sum of every row. Where a bright or dark stripe lies, how a part
// is spaced.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/sums.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The sum of each column, from left to right. For a rectangle take the crop of the view.
///
/// Shapes  src 1x1 or larger; one sum for each column
/// Units   sums of grey levels; of up to 16.8 million rows they fit 32 bits
/// Errors  empty_image, size_mismatch for another count of sums
inline Status project_columns(ImageView<const Gray8> src, Span<std::uint32_t> sums);

inline namespace FOVEA_ISA {

/// The sum of each row, from top to bottom.
///
/// Shapes  src 1x1 or larger; one sum for each row
/// Others  as project_columns()
inline Status project_rows(ImageView<const Gray8> src, Span<std::uint32_t> sums);

/// project_columns() of rows that come one at a time: an accumulator for streams. A strip of a frame gives
/// the sums of its rows, and those of all strips are added up by merge().
///
/// Errors  of begin(): size_mismatch for another count of sums than columns
class ColumnProjection {
public:
    using Input = Gray8;
    explicit constexpr ColumnProjection(Span<std::uint32_t> sums) : sums_(sums) {}

    Status begin(Size size) {
        if (sums_.size() != size.width) return Status::size_mismatch;
        for (std::uint32_t& sum : sums_) sum = 0;
        return Status::ok;
    }
    void add_row(const Gray8* row, int width, int) {
        std::uint32_t* to = sums_.data();
        for (int x = 0; x < width; ++x) to[x] += row[x];
    }
    /// Adds the sums of other rows of the same image.
    ///
    /// Errors  size_mismatch, with the sums as they were
    Status merge(const ColumnProjection& other) {
        if (other.sums_.size() != sums_.size()) return Status::size_mismatch;
        for (std::ptrdiff_t x = 0; x < sums_.size(); ++x) sums_[x] += other.sums_[x];
        return Status::ok;
    }

private:
    Span<std::uint32_t> sums_;
};

/// project_rows() of rows that come one at a time. Strips of a frame write the sums of their own rows, and
/// may share one span.
///
/// Errors  of begin(): size_mismatch for another count of sums than rows
class RowProjection {
public:
    using Input = Gray8;
    explicit constexpr RowProjection(Span<std::uint32_t> sums) : sums_(sums) {}

    Status begin(Size size) const { return sums_.size() == size.height ? Status::ok : Status::size_mismatch; }
    void add_row(const Gray8* row, int width, int y) const {
        sums_[y] = static_cast<std::uint32_t>(simd::sum_of_bytes(row, width));
    }

private:
    Span<std::uint32_t> sums_;
};

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

inline Status project_columns(ImageView<const Gray8> src, Span<std::uint32_t> sums) {
    if (src.empty()) return Status::empty_image;
    if (sums.size() != src.width()) return Status::size_mismatch;
    std::uint32_t* to = sums.data();
    for (int x = 0; x < src.width(); ++x) to[x] = 0;
    // Four rows at a time, so that a sum is read and written once for all of them.
    int y = 0;
    for (; y + 4 <= src.height(); y += 4) {
        const Gray8* a = src.row(y);
        const Gray8* b = src.row(y + 1);
        const Gray8* c = src.row(y + 2);
        const Gray8* d = src.row(y + 3);
        for (int x = 0; x < src.width(); ++x)
            to[x] += static_cast<std::uint16_t>(static_cast<std::uint16_t>(a[x] + b[x]) +
                                                static_cast<std::uint16_t>(c[x] + d[x]));
    }
    for (; y < src.height(); ++y) {
        const Gray8* row = src.row(y);
        for (int x = 0; x < src.width(); ++x) to[x] += row[x];
    }
    return Status::ok;
}

inline namespace FOVEA_ISA {

inline Status project_rows(ImageView<const Gray8> src, Span<std::uint32_t> sums) {
    if (src.empty()) return Status::empty_image;
    if (sums.size() != src.height()) return Status::size_mismatch;
    for (int y = 0; y < src.height(); ++y)
        sums[y] = static_cast<std::uint32_t>(simd::sum_of_bytes(src.row(y), src.width()));
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
