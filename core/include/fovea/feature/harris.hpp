// SPDX-License-Identifier: MIT
//
// Harris' response: how much a place of the picture is a corner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lines.hpp>
#include <fovea/simd/structure_sums.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Scratch bytes that harris_response() needs: some rows.
constexpr std::int64_t harris_scratch(Size size);

/// The response of every pixel: above zero at corners and spots, below it on edges, near zero where there is
/// nothing. With p and q the differences of the neighbours across and down, and A, B, C the sums of p * p,
/// q * q and p * q over 3x3 pixels by 16, it is A * B - C * C - ((A + B) / 4)^2.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     magnitudes below 1.7e9; 256 times as much for a contrast that is 4 times as high
/// Rounding  the divisions by 16 and by 4 go down, the rest is exact
/// Border    of the picture as border says, for differences and sums
/// Overlap   none
/// Scratch   harris_scratch(src.size()) bytes, undefined afterwards
/// Errors    empty_image, size_mismatch, scratch_too_small
/// Source    Harris and Stephens, "A combined corner and edge detector", AVC 1988, with kappa 1/16; the
///           numbers of the toolkit's CalculateHarrisMap, which left a frame of two pixels of zeros and said
///           0.04
inline Status harris_response(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                              ImageView<Response32> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// The row kernel of harris_response().
class HarrisRow {
public:
    using Input = Gray8;
    using Output = Response32;

    static constexpr int window = 5;
    static constexpr std::int64_t scratch(int width) {
        return window * std::int64_t{byte_line_scratch(width)} +
               arena_bytes<std::int32_t>(simd::StructureSums::room(width));
    }

    HarrisRow() = default;
    HarrisRow(Border border, Span<std::uint8_t> scratch, int width) : border_(border) {
        const int bytes = byte_line_scratch(width);
        for (int i = 0; i < window; ++i)
            lines_[i] = simd::ByteLine(scratch.from(i * std::ptrdiff_t{bytes}).first(bytes), width).pixels();
        std::memset(scratch.data(), 0, static_cast<std::size_t>(window) * static_cast<std::size_t>(bytes));
        Arena arena(scratch.from(window * std::ptrdiff_t{bytes}));
        const auto room = static_cast<std::ptrdiff_t>(simd::StructureSums::room(width));
        sums_ = simd::StructureSums(arena.take<std::int32_t>(room), width);
    }

    static constexpr int rows() { return window; }

    void operator()(const RowWindow<Gray8>& rows, Response32* dst) {
        const int width = rows.width();
        for (int i = 0; i < window; ++i) {
            std::memcpy(lines_[i], rows[i], static_cast<std::size_t>(width));
            for (const int x : {-2, -1, width, width + 1}) {
                const int column = border_index(border_, x, width);
                lines_[i][x] = column == no_index ? Gray8{0} : rows[i][column];
            }
        }
        sums_.down({lines_[0], lines_[1], lines_[2], lines_[3], lines_[4]});
        // By 16 the sums are at most 36576: the products stay below 1.34e9, the square of the trace by 4
        // below 3.4e8.
        sums_.across(
            [](auto across, auto down, auto both) {
                across >>= 4;
                down >>= 4;
                both >>= 4;
                const auto trace = (across + down) >> 2;
                return across * down - both * both - trace * trace;
            },
            dst);
    }

private:
    Border border_ = Border::replicate;
    std::uint8_t* lines_[window] = {};
    simd::StructureSums sums_;
};

}  // namespace kernels

constexpr std::int64_t harris_scratch(Size size) {
    return size.width + kernels::HarrisRow::scratch(size.width);
}

inline Status harris_response(ImageView<const Gray8> src, Border border, Span<std::uint8_t> scratch,
                              ImageView<Response32> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (scratch.size() < harris_scratch(src.size())) return Status::scratch_too_small;
    std::memset(scratch.data(), 0, static_cast<std::size_t>(src.width()));
    kernels::HarrisRow kernel(border, scratch.from(src.width()), src.width());
    for_each_row(src, border, kernel, dst, scratch.data());
    return Status::ok;
}

namespace stages {

struct HarrisStage {
    using Kernel = kernels::HarrisRow;
    using Input = Gray8;
    using Output = Response32;

    static constexpr int rows() { return Kernel::rows(); }
    static constexpr std::int64_t scratch(int width) { return Kernel::scratch(width); }
    static Kernel kernel(Border border, Span<std::uint8_t> bytes, int width) {
        return Kernel(border, bytes, width);
    }
};
inline constexpr HarrisStage harris_response;

}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
