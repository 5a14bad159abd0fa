// SPDX-License-Identifier: MIT
//
// Polar and log-polar warps: rings become rows. What turns about the centre moves along y, and what grows
// moves along x in the log-polar image.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/places.hpp>
#include <fovea/warp/sampling.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How the radius grows with the column.
enum class RadiusScale : std::uint8_t {
    linear,       ///< by the same length with every column
    logarithmic,  ///< by the same factor with every column
};

/// Which ring of an image becomes which image.
struct PolarFrame {
    FinePoint centre;
    FinePixel inner = FinePixel::from_int(1);  ///< radius of column 0; above 0 if logarithmic
    FinePixel outer;                           ///< radius of the column behind the last one; above inner
    RadiusScale scale = RadiusScale::logarithmic;
    FineAngle start;  ///< direction of row 0; the rows make one turn, clockwise on screen
};

/// The place in the source of pixel (x, y) of a polar image of a size: centre + r (cos a, sin a), where
/// a = start + y / height of a turn, and r = inner (outer / inner)^(x / width) or
/// inner + (outer - inner) x / width.
///
/// Rounding  to within outer * 2^-25 and 1/65536 px
/// Errors    empty_image; bad_argument for radii that make no ring; out_of_range for a pixel beyond the image
///           or a place beyond 32767 px
constexpr Result<FinePoint> polar_place(const PolarFrame& frame, Size size, Point pixel);

/// Scratch bytes of warp_polar() for an output of that size.
constexpr std::int64_t warp_polar_scratch(Size output) {
    return arena_bytes<std::int32_t>(std::int64_t{output.width} + 2 * std::int64_t{output.height});
}

inline namespace FOVEA_ISA {

/// Every pixel of dst is what src shows at its polar_place().
///
/// Shapes    any sizes, 1x1 to 32767x32767; Gray8 or Rgb888
/// Units     any 8-bit values
/// Rounding  places to 1/256 px from the place as polar_place() has it; pixels as warp_affine()
/// Border    as sampling says
/// Overlap   none
/// Scratch   warp_polar_scratch(dst.size()) bytes, undefined afterwards
/// Errors    empty_image, image_too_large, bad_argument for radii that make no ring, scratch_too_small
/// Source    the radii are products of roots of outer / inner, one for every binary digit of x / width
template <class Pixel>
Status warp_polar(NonDeduced<ImageView<const Pixel>> src, const PolarFrame& frame,
                  const NonDeduced<Sampling<Pixel>>& sampling, Span<std::uint8_t> scratch,
                  ImageView<Pixel> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr bool makes_a_ring(const PolarFrame& frame) {
    const std::int32_t least = frame.scale == RadiusScale::logarithmic ? 1 : 0;
    return frame.inner.raw() >= least && frame.inner < frame.outer;
}

/// The radii of the columns, in 1/65536 px.
class PolarRadii {
public:
    /// The frame makes a ring; width 1 or larger.
    constexpr PolarRadii(const PolarFrame& frame, int width)
        : inner_(frame.inner.raw()), outer_(frame.outer.raw()), width_(width), scale_(frame.scale) {
        if (scale_ == RadiusScale::linear) return;
        // inner / outer in 2^-62, then its roots, rounded to 2^-31. What a root leaves is kept for the next
        // one: the first ones may be small.
        const auto low = static_cast<std::uint64_t>(inner_);
        const auto high = static_cast<std::uint64_t>(outer_);
        std::uint64_t square = (low << 32) / high << 30 | ((low << 32) % high << 30) / high;
        for (std::uint32_t& root : roots_) {
            const std::uint64_t whole = isqrt(square);
            square = (whole << 31) + ((square - whole * whole) << 30) / whole;
            root = static_cast<std::uint32_t>((square + (1u << 30)) >> 31);
        }
    }

    constexpr std::int32_t at(int column) const {
        if (scale_ == RadiusScale::linear)
            return inner_ + static_cast<std::int32_t>(
                                round_divide(std::int64_t{outer_ - inner_} * column, std::int64_t{width_}));
        if (column == 0) return inner_;
        // outer (inner / outer)^(1 - x / width). Every factor and every product is right to 2^-31: 2^-26 in
        // all.
        const auto share = static_cast<std::uint32_t>((static_cast<std::uint64_t>(width_ - column) << 32) /
                                                      static_cast<std::uint64_t>(width_));
        std::uint64_t product = std::uint64_t{1} << 31;
        for (int digit = 0; digit < digits; ++digit)
            if ((share >> (digits - 1 - digit) & 1) != 0)
                product = (product * roots_[digit] + (1u << 30)) >> 31;
        return static_cast<std::int32_t>((product * static_cast<std::uint64_t>(outer_) + (1u << 30)) >> 31);
    }

private:
    static constexpr int digits = 32;
    std::int32_t inner_;
    std::int32_t outer_;
    int width_;
    RadiusScale scale_;
    std::uint32_t roots_[digits]{};
};

constexpr UnitVector polar_direction(const PolarFrame& frame, int height, int row) {
    const auto turned = (static_cast<std::uint64_t>(row) << 32) / static_cast<std::uint64_t>(height);
    return unit_vector(frame.start + FineAngle::from_raw(static_cast<std::uint32_t>(turned)));
}

}  // namespace detail

constexpr Result<FinePoint> polar_place(const PolarFrame& frame, Size size, Point pixel) {
    if (size.empty()) return Status::empty_image;
    if (!detail::makes_a_ring(frame)) return Status::bad_argument;
    if (pixel.x < 0 || pixel.x >= size.width || pixel.y < 0 || pixel.y >= size.height)
        return Status::out_of_range;
    const UnitVector direction = detail::polar_direction(frame, size.height, pixel.y);
    const std::int64_t radius = detail::PolarRadii(frame, size.width).at(pixel.x);
    const std::int64_t x =
        frame.centre.x.raw() + round_shift(radius * direction.x.raw(), Unit::fraction_bits);
    const std::int64_t y =
        frame.centre.y.raw() + round_shift(radius * direction.y.raw(), Unit::fraction_bits);
    const FinePoint place{FinePixel::from_raw(saturate_cast<std::int32_t>(x)),
                          FinePixel::from_raw(saturate_cast<std::int32_t>(y))};
    if (place.x.raw() != x || place.y.raw() != y) return Status::out_of_range;
    return place;
}

inline namespace FOVEA_ISA {
namespace kernels {

struct PolarPlaces {
    static constexpr simd::PlaceOrder order = simd::PlaceOrder::along_a_line;
    static constexpr int strip = warp_strip;
    const std::int32_t* radii;
    const std::int32_t* cosines;
    const std::int32_t* sines;
    FinePoint centre;

    void operator()(int x, int y, int count, simd::PlaceRun& run) const {
        along(centre.x, cosines[y], radii + x, count, run.x);
        along(centre.y, sines[y], radii + x, count, run.y);
    }

private:
    static void along(FinePixel from, std::int32_t side, const std::int32_t* radii, int count,
                      std::int32_t* to) {
        // In 2^-46 px, below 2^61 + 2^61 + 2^37; the high words are 2^-14 px.
        constexpr int drop = FinePixel::fraction_bits + Unit::fraction_bits - SubPixel::fraction_bits;
        static_assert(drop == 38, "32 and 6");
        const std::int64_t start = from.raw() * std::int64_t{Unit::one} + (std::int64_t{1} << (drop - 1));
        for (int i = 0; i < count; ++i)
            to[i] = static_cast<std::int32_t>((start + std::int64_t{side} * radii[i]) >> 32) >> 6;
    }
};

}  // namespace kernels

template <class Pixel>
Status warp_polar(NonDeduced<ImageView<const Pixel>> src, const PolarFrame& frame,
                  const NonDeduced<Sampling<Pixel>>& sampling, Span<std::uint8_t> scratch,
                  ImageView<Pixel> dst) {
    if (Status s = kernels::check_warp<Pixel>(src, dst); s != Status::ok) return s;
    if (!detail::makes_a_ring(frame)) return Status::bad_argument;
    if (scratch.size() < warp_polar_scratch(dst.size())) return Status::scratch_too_small;
    Arena arena(scratch);
    const Span<std::int32_t> radii = arena.take<std::int32_t>(dst.width());
    const Span<std::int32_t> cosines = arena.take<std::int32_t>(dst.height());
    const Span<std::int32_t> sines = arena.take<std::int32_t>(dst.height());
    const detail::PolarRadii columns(frame, dst.width());
    for (int x = 0; x < dst.width(); ++x) radii[x] = columns.at(x);
    for (int y = 0; y < dst.height(); ++y) {
        const UnitVector direction = detail::polar_direction(frame, dst.height(), y);
        cosines[y] = direction.x.raw();
        sines[y] = direction.y.raw();
    }
    kernels::warp_frame<Pixel>(
        src, kernels::PolarPlaces{radii.data(), cosines.data(), sines.data(), frame.centre}, sampling, dst);
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
