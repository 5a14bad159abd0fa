// SPDX-License-Identifier: MIT
//
// The bilateral filter: a Gaussian that stops at edges.
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
#include <fovea/number/integer.hpp>
#include <fovea/simd/bilateral_sums.hpp>
#include <fovea/simd/bilateral_tables.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How far bilateral() looks.
struct BilateralOptions {
    int radius = 2;                                ///< 1..7 px; of the disc of neighbours
    SubPixel sigma_space = SubPixel::from_int(2);  ///< 0.3..10 px; a larger one smooths more
    int sigma_range = 25;  ///< 1..255 grey levels; steps of three times as much stay what they are
};

inline namespace FOVEA_ISA {

/// Scratch bytes that bilateral() needs; 0 if it refuses the options.
constexpr std::int64_t bilateral_scratch(Size size, const BilateralOptions& options);

/// Every pixel as the mean of a disc around it, in which a neighbour counts less the farther it is, by a
/// Gaussian of sigma_space, and the more its level differs, by a Gaussian of sigma_range. Smooths noise and
/// keeps edges.
///
/// Shapes    src and dst equal, 1x1 or larger
/// Units     grey levels in and out
/// Rounding  to the nearest, ties away from the pixel, of a mean that is within 0.2 of the real one, and
///           within 0.6 where a pixel differs from all of its neighbours alike: weights are right to 0.3 % of
///           themselves and 1/32767 of the pixel's own, and are summed exactly. A flat image stays what it
///           is, and an inverted one gives the inverted means
/// Border    as border says
/// Overlap   none: dst must not share pixels with src
/// Scratch   bilateral_scratch(src.size(), options) bytes, undefined afterwards: 2 radius + 1 rows of
///           16 bits. Without vectors and with Helium rows of 8 bits, and for each distance on the disc, of
///           which radius 1 has 1, 2 has 3 and 7 has 23, a table of 1022 bytes, with Helium of 512
/// Cost      grows with the pixels of the disc: 4, 12, 28, 48 ... 148 weights a pixel
/// Errors    empty_image, size_mismatch, bad_argument for options out of their range, scratch_too_small
/// Source    Tomasi and Manduchi, "Bilateral filtering for gray and color images", ICCV 1998
inline Status bilateral(ImageView<const Gray8> src, const BilateralOptions& options, Border border,
                        Span<std::uint8_t> scratch, ImageView<Gray8> dst);

// ---- Implementation ---------------------------------------------------------------

namespace kernels {

constexpr bool is_bilateral(const BilateralOptions& options) {
    return options.radius >= 1 && options.radius <= max_bilateral_radius &&
           options.sigma_space >= min_gaussian_sigma && options.sigma_space <= max_gaussian_sigma &&
           options.sigma_range >= 1 && options.sigma_range <= 255;
}

/// The row kernel of bilateral().
class BilateralRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    static constexpr std::int64_t scratch(int width, int radius) {
        return line_bytes(width, radius) + Disc::scratch(radius);
    }

    BilateralRow() = default;
    BilateralRow(const BilateralOptions& options, Border border, Span<std::uint8_t> scratch, int width)
        : radius_(options.radius),
          border_(border),
          lines_{scratch.data() + Disc::first_bytes, Disc::line_scratch(width), 2 * options.radius + 1, 0} {
        const std::int64_t bytes = line_bytes(width, radius_);
        std::memset(scratch.data(), 0, static_cast<std::size_t>(bytes));
        // log2(e) / 2 in 2^-27, which are 2^-11 for sigma in 1/256 px.
        constexpr std::uint32_t half_log2_e = 96817625;
        const auto range = static_cast<std::uint32_t>(options.sigma_range * options.sigma_range);
        const auto space = static_cast<std::uint64_t>(options.sigma_space.raw());
        const auto exponent_of = [space](int square) {
            const std::uint64_t exponent =
                (static_cast<std::uint64_t>(square) * half_log2_e + space * space / 2) / (space * space);
            return static_cast<std::uint32_t>(minimum<std::uint64_t>(exponent, simd::last_exponent));
        };
        disc_ = Disc(radius_, simd::BilateralScale::of((half_log2_e + range / 2) / range), exponent_of,
                     scratch.from(static_cast<std::ptrdiff_t>(bytes)));
    }

    int rows() const { return 2 * radius_ + 1; }

    /// All rows of a window that follows stand in lines but the last one, which takes that of the row above
    /// the window.
    void operator()(const RowWindow<Gray8>& window, bool follows, Gray8* dst) {
        const int width = window.width();
        lines_.top = follows && lines_.top + 1 < rows() ? lines_.top + 1 : 0;
        for (int i = follows ? rows() - 1 : 0; i < rows(); ++i) {
            std::uint8_t* line = lines_.at(i);
            Disc::put(window[i], width, line);
            for (int reach = 1; reach <= radius_; ++reach)
                for (const int x : {-reach, width - 1 + reach}) {
                    const int column = border_index(border_, x, width);
                    const Disc::Pixel pixel = column == no_index ? Disc::Pixel{0} : window[i][column];
                    std::memcpy(line + int{sizeof pixel} * x, &pixel, sizeof pixel);
                }
        }
        disc_.means(lines_, width, dst);
    }

private:
    using Disc = simd::BilateralDisc;
    static constexpr std::int64_t line_bytes(int width, int radius) {
        return (2 * radius + 1) * std::int64_t{Disc::line_scratch(width)};
    }

    int radius_ = 1;
    Border border_ = Border::replicate;
    simd::BilateralLines lines_;
    Disc disc_;
};

}  // namespace kernels

constexpr std::int64_t bilateral_scratch(Size size, const BilateralOptions& options) {
    if (!kernels::is_bilateral(options)) return 0;
    return size.width + kernels::BilateralRow::scratch(size.width, options.radius);
}

inline Status bilateral(ImageView<const Gray8> src, const BilateralOptions& options, Border border,
                        Span<std::uint8_t> scratch, ImageView<Gray8> dst) {
    if (src.empty()) return Status::empty_image;
    if (dst.size() != src.size()) return Status::size_mismatch;
    if (!kernels::is_bilateral(options)) return Status::bad_argument;
    if (scratch.size() < bilateral_scratch(src.size(), options)) return Status::scratch_too_small;
    std::memset(scratch.data(), 0, static_cast<std::size_t>(src.width()));
    kernels::BilateralRow kernel(options, border, scratch.from(src.width()), src.width());
    for_each_row(src, border, kernel, dst, scratch.data());
    return Status::ok;
}

namespace stages {

/// bilateral() of options.
struct bilateral {
    using Kernel = kernels::BilateralRow;
    using Input = Gray8;
    using Output = Gray8;
    BilateralOptions options;

    constexpr bool valid() const { return kernels::is_bilateral(options); }
    constexpr int rows() const { return 2 * options.radius + 1; }
    constexpr std::int64_t scratch(int width) const { return Kernel::scratch(width, options.radius); }
    Kernel kernel(Border border, Span<std::uint8_t> bytes, int width) const {
        return Kernel(options, border, bytes, width);
    }
};

}  // namespace stages

}  // namespace FOVEA_ISA
}  // namespace fovea
