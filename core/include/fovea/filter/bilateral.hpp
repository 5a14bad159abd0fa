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
#include <fovea/simd/halves.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lanes.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The largest radius of bilateral().
inline constexpr int max_bilateral_radius = 7;

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
///           16 bits
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
        return (2 * radius + 1) * std::int64_t{word_line_scratch(width)};
    }

    BilateralRow() = default;
    BilateralRow(const BilateralOptions& options, Border border, Span<std::uint8_t> scratch, int width)
        : radius_(options.radius),
          border_(border),
          bytes_(word_line_scratch(width)),
          first_(scratch.data() + simd::bilateral_bytes * max_reach) {
        std::memset(scratch.data(), 0, static_cast<std::size_t>(BilateralRow::scratch(width, radius_)));
        // log2(e) / 2 in 2^-27, which are 2^-11 for sigma in 1/256 px.
        constexpr std::uint32_t half_log2_e = 96817625;
        const auto range = static_cast<std::uint32_t>(options.sigma_range * options.sigma_range);
        scale_ = simd::BilateralScale::of((half_log2_e + range / 2) / range);
        const auto space = static_cast<std::uint64_t>(options.sigma_space.raw());
        for (int y = 0; y <= radius_; ++y)
            while (square_of(y) + square_of(sides_[y] + 1) <= square_of(radius_)) ++sides_[y];
        for (int square = 0; square <= square_of(radius_); ++square) {
            const std::uint64_t exponent =
                (static_cast<std::uint64_t>(square) * half_log2_e + space * space / 2) / (space * space);
            distances_[square] =
                static_cast<std::uint32_t>(minimum<std::uint64_t>(exponent, simd::last_exponent)) * 0x10001u;
        }
    }

    int rows() const { return 2 * radius_ + 1; }

    /// All rows of a window that follows stand in lines but the last one, which takes that of the row above
    /// the window.
    void operator()(const RowWindow<Gray8>& window, bool follows, Gray8* dst) {
        const int width = window.width();
        top_ = follows && top_ + 1 < rows() ? top_ + 1 : 0;
        for (int i = follows ? rows() - 1 : 0; i < rows(); ++i) {
            std::uint8_t* line = line_of(i);
            simd::for_each_vector(width, [&](int x, int count) {
                std::uint16_t pixels[simd::lanes];
                simd::Words(count == simd::lanes ? simd::Bytes::load(window[i] + x)
                                                 : simd::Bytes::load(window[i] + x, count))
                    .store(pixels);
                std::memcpy(line + simd::bilateral_bytes * x, pixels, sizeof pixels);
            });
            for (int reach = 1; reach <= radius_; ++reach)
                for (const int x : {-reach, width - 1 + reach}) {
                    const int column = border_index(border_, x, width);
                    const std::uint16_t pixel = column == no_index ? std::uint16_t{0} : window[i][column];
                    std::memcpy(line + simd::bilateral_bytes * x, &pixel, sizeof pixel);
                }
        }
        // A copy, so that no store makes the compiler load it again.
        const BilateralRow row = *this;
        simd::for_each_vector(width, [&](int x, int count) {
            const simd::Bytes means = row.means(x);
            if (count == simd::lanes)
                means.store(dst + x);
            else
                means.store(dst + x, count);
        });
    }

private:
    static constexpr int square_of(int side) { return side * side; }
    /// Of row i of the window.
    [[gnu::always_inline]] std::uint8_t* line_of(int i) const {
        return first_ + (top_ + i < rows() ? top_ + i : top_ + i - rows()) * bytes_;
    }

    [[gnu::always_inline]] simd::Bytes means(int x) const {
        const std::uint8_t* middle = line_of(radius_) + simd::bilateral_bytes * x;
        simd::BilateralSums first(middle);
        simd::BilateralSums second(middle + simd::bilateral_bytes * simd::half_lanes);
        for (int y = -radius_; y <= radius_; ++y) {
            const int side = sides_[y < 0 ? -y : y];
            const std::uint8_t* from = line_of(radius_ + y) + simd::bilateral_bytes * x;
            for (int i = -side; i <= side; ++i) {
                const int square = y * y + i * i;
                if (square == 0) continue;
                const std::uint8_t* at = from + simd::bilateral_bytes * i;
                first.add(at, scale_, distances_[square]);
                second.add(at + simd::bilateral_bytes * simd::half_lanes, scale_, distances_[square]);
            }
        }
        return simd::narrowed(first.means(), second.means());
    }

    int radius_ = 1;
    int top_ = 0;  ///< which line has the topmost row
    Border border_ = Border::replicate;
    std::ptrdiff_t bytes_ = 0;
    std::uint8_t* first_ = nullptr;
    simd::BilateralScale scale_;
    std::uint8_t sides_[max_bilateral_radius + 1] =
        {};  ///< half of the disc's width by the distance of a row
    std::uint32_t distances_[max_bilateral_radius * max_bilateral_radius + 1] = {};
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
