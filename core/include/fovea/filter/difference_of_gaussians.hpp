// SPDX-License-Identifier: MIT
//
// Difference of Gaussians: what of a picture is finer than one sigma and coarser than another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/filter/gaussian_sigma.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// Scratch bytes that difference_of_gaussians() needs.
constexpr std::int64_t difference_of_gaussians_scratch(Size size);

/// The magnitude of the difference between two gaussian() filters of a picture, or, with a sigma of 0 for the
/// fine one, between the picture and its gaussian(): texture without the level of the ground.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     grey levels in and out; sigmas in pixels
/// Rounding  of each Gaussian as gaussian(); the difference is exact
/// Border    as border says
/// Overlap   none: dst must not share pixels with src
/// Scratch   difference_of_gaussians_scratch(src.size()) bytes, undefined afterwards: some rows, never a
///           frame
/// Errors    empty_image, size_mismatch; bad_argument for a sigma that gaussian() refuses, but for a fine one
///           of 0, and unless fine < coarse; scratch_too_small
/// Source    the toolkit's demo of stereo took the picture less its Gaussian of sigma 2.1
inline Status difference_of_gaussians(ImageView<const Gray8> src, SubPixel fine, SubPixel coarse,
                                      Border border, Span<std::uint8_t> scratch, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

/// The row kernel of difference_of_gaussians(): two of gaussian() in one window.
class DifferenceOfGaussiansRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    static constexpr std::int64_t scratch(int width) { return width + 2 * GaussianRow::scratch(width); }

    DifferenceOfGaussiansRow() = default;
    /// A reach of 0 for the picture itself in place of the fine one.
    DifferenceOfGaussiansRow(const GaussianTaps& fine, const GaussianTaps& coarse, Border border,
                             Span<std::uint8_t> scratch, int width)
        : reach_(fine.reach),
          line_(scratch.data()),
          fine_(fine, border, scratch.from(width), width),
          coarse_(coarse, border,
                  scratch.from(width + static_cast<std::ptrdiff_t>(GaussianRow::scratch(width))), width) {}

    int rows() const { return coarse_.rows(); }

    void operator()(const RowWindow<Gray8>& window, Gray8* dst) {
        const int width = window.width();
        const int middle = window.count() / 2;
        coarse_(window, dst);
        const Gray8* fine = window[middle];
        if (reach_ > 0) {
            const Gray8* rows[2 * max_reach + 1];
            for (int i = -reach_; i <= reach_; ++i) rows[reach_ + i] = window[middle + i];
            fine_(RowWindow<Gray8>(rows, 2 * reach_ + 1, width), line_);
            fine = line_;
        }
        simd::for_each_vector(width, [&](int x, int count) {
            if (count == simd::lanes)
                apart(simd::Bytes::load(fine + x), simd::Bytes::load(dst + x)).store(dst + x);
            else
                apart(simd::Bytes::load(fine + x, count), simd::Bytes::load(dst + x, count))
                    .store(dst + x, count);
        });
    }

private:
    [[gnu::always_inline]] static simd::Bytes apart(simd::Bytes a, simd::Bytes b) {
        return higher(a, b) - lower(a, b);
    }

    int reach_ = 0;
    Gray8* line_ = nullptr;
    GaussianRow fine_;
    GaussianRow coarse_;
};

}  // namespace kernels

constexpr std::int64_t difference_of_gaussians_scratch(Size size) {
    return size.width + kernels::DifferenceOfGaussiansRow::scratch(size.width);
}

inline Status difference_of_gaussians(ImageView<const Gray8> src, SubPixel fine, SubPixel coarse,
                                      Border border, Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    const Result<GaussianTaps> coarse_taps = gaussian_taps(coarse);
    if (!coarse_taps) return coarse_taps.status();
    if (fine >= coarse) return Status::bad_argument;
    GaussianTaps fine_taps;
    if (fine != SubPixel()) {
        const Result<GaussianTaps> taps = gaussian_taps(fine);
        if (!taps) return taps.status();
        fine_taps = *taps;
    }
    if (scratch.size() < difference_of_gaussians_scratch(src.size())) return Status::scratch_too_small;
    std::memset(scratch.data(), 0, static_cast<std::size_t>(src.width()));
    kernels::DifferenceOfGaussiansRow kernel(fine_taps, *coarse_taps, border, scratch.from(src.width()),
                                             src.width());
    for_each_row(src, border, kernel, dst, scratch.data());
    return Status::ok;
}

namespace stages {

/// difference_of_gaussians() of the taps of two sigmas; GaussianTaps{} as the fine ones leaves the picture.
struct difference_of_gaussians {
    using Kernel = kernels::DifferenceOfGaussiansRow;
    using Input = Gray8;
    using Output = Gray8;
    GaussianTaps fine;
    GaussianTaps coarse;

    constexpr bool valid() const {
        return fine.reach >= 0 && fine.reach <= coarse.reach && coarse.reach > 0 && coarse.reach < max_reach;
    }
    constexpr int rows() const { return 2 * coarse.reach + 1; }
    static constexpr std::int64_t scratch(int width) { return Kernel::scratch(width); }
    Kernel kernel(Border border, Span<std::uint8_t> bytes, int width) const {
        return Kernel(fine, coarse, border, bytes, width);
    }
};

}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
