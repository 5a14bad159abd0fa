// SPDX-License-Identifier: MIT
//
// Affine warps: turn, scale, shear and shift an image. Book sec. 2.9.3.
#pragma once

#include <cstdint>
#include <limits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/places.hpp>
#include <fovea/warp/sampling.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A coefficient of a warp, or a place in px that a warp goes through: 2^-40.
using WarpCoefficient = Fixed<std::int64_t, 40>;

/// Where the output pixel (x, y) comes from: (xx x + xy y + x0, yx x + yy y + y0).
///
/// Units  px; a coefficient is right to 2^-41, a place of the largest image to 2^-25 px
struct AffineTransform {
    WarpCoefficient xx = WarpCoefficient::from_int(1);
    WarpCoefficient xy;
    WarpCoefficient x0;
    WarpCoefficient yx;
    WarpCoefficient yy = WarpCoefficient::from_int(1);
    WarpCoefficient y0;
};

/// Turns places by angle about centre: +x towards +y for a positive angle. As the map of a warp it reads the
/// source at the turned places, so the content of the image turns the other way: what lies along angle in the
/// source lies along +x afterwards.
constexpr AffineTransform rotation_about(FinePoint centre, FineAngle angle);

/// First inner, then outer: the place outer(inner(p)).
///
/// Errors  out_of_range for a coefficient that does not fit
constexpr Result<AffineTransform> chained(const AffineTransform& outer, const AffineTransform& inner);

/// The way back.
///
/// Errors  degenerate where the transform keeps no area (a determinant below 2^-40); out_of_range for a
///         coefficient that does not fit
constexpr Result<AffineTransform> inverse_of(const AffineTransform& transform);

/// Where a place goes, to the nearest 1/65536 px, ties up.
///
/// Errors  out_of_range beyond 32767 px
constexpr Result<FinePoint> map_point(const AffineTransform& transform, FinePoint place);

/// Source rows that one output row of that width reads, the one below the last place included. A stream that
/// keeps as many, and knows the rows' shift from one output row to the next (yy), can warp on the way.
constexpr int source_rows_of(const AffineTransform& transform, int width);

inline namespace FOVEA_ISA {

/// Every pixel of dst is what src shows at the place that the transform gives.
///
/// Shapes    any sizes, 1x1 to 32767x32767; Gray8 or Rgb888
/// Units     any 8-bit values
/// Rounding  places to 1/256 px, from an exact start in every row; pixels to the nearest, ties up, of the
///           exact mean of four with 8-bit weights: within 0.5 + (|gx| + |gy|) / 512 of the value between
///           pixels that differ by gx and gy. The largest sum is 255 * 2^16 + 2^15
/// Border    as sampling says
/// Overlap   none
/// Errors    empty_image; image_too_large; bad_argument if a place is 2^22 px or farther from pixel (0, 0)
/// Source    book sec. 2.9.2, 2.9.3. The centre of a pixel is its whole coordinate
template <class Pixel>
Status warp_affine(NonDeduced<ImageView<const Pixel>> src, const AffineTransform& transform,
                   const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst);

/// Turns the content of an image by -angle about centre: what lies along angle comes to lie along +x. All
/// else as warp_affine() with rotation_about().
template <class Pixel>
Status rotate(NonDeduced<ImageView<const Pixel>> src, FinePoint centre, FineAngle angle,
              const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A sum of products of coefficients, rounded back to one; not ok where it does not fit.
constexpr bool coefficient_of(Int128 sum, WarpCoefficient& to) {
    const Int128 rounded =
        (sum + (Int128(1) << (WarpCoefficient::fraction_bits - 1))) >> WarpCoefficient::fraction_bits;
    to = WarpCoefficient::from_raw(rounded.low_word());
    return rounded.fits_int64();
}

constexpr Int128 times(WarpCoefficient a, WarpCoefficient b) { return Int128::product(a.raw(), b.raw()); }

constexpr Int128 widened(WarpCoefficient a) { return Int128(a.raw()) << WarpCoefficient::fraction_bits; }

/// Whether |a x + b y + c| stays below 2^22 for the pixels of an image. Products have at most 78 bits.
constexpr bool stays_near(WarpCoefficient a, WarpCoefficient b, WarpCoefficient c, Size size) {
    const auto size_of = [](WarpCoefficient k) { return k.raw() < 0 ? -Int128(k.raw()) : Int128(k.raw()); };
    const Int128 most = size_of(a) * (size.width - 1) + size_of(b) * (size.height - 1) + size_of(c);
    return most < Int128(std::int64_t{1} << 62);
}

constexpr bool stays_near(const AffineTransform& t, Size size) {
    return stays_near(t.xx, t.xy, t.x0, size) && stays_near(t.yx, t.yy, t.y0, size);
}

}  // namespace detail

constexpr AffineTransform rotation_about(FinePoint centre, FineAngle angle) {
    const UnitVector direction = unit_vector(angle);
    const auto cosine = direction.x.convert<WarpCoefficient>();
    const auto sine = direction.y.convert<WarpCoefficient>();
    const std::int64_t one = WarpCoefficient::one;
    // c - R c, with products of at most 41 + 31 bits.
    const auto offset = [&](FinePixel c, Int128 turned) {
        const Int128 sum = Int128::product(c.raw(), one) - turned;
        return WarpCoefficient::from_raw(((sum + (Int128(1) << 15)) >> 16).low_word());
    };
    const auto by = [](WarpCoefficient k, FinePixel c) { return Int128::product(k.raw(), c.raw()); };
    AffineTransform turn;
    turn.xx = cosine;
    turn.xy = -sine;
    turn.x0 = offset(centre.x, by(cosine, centre.x) - by(sine, centre.y));
    turn.yx = sine;
    turn.yy = cosine;
    turn.y0 = offset(centre.y, by(sine, centre.x) + by(cosine, centre.y));
    return turn;
}

constexpr Result<AffineTransform> chained(const AffineTransform& outer, const AffineTransform& inner) {
    using detail::times;
    AffineTransform both;
    const auto row = [&inner](WarpCoefficient x, WarpCoefficient y, WarpCoefficient zero,
                              WarpCoefficient& to_x, WarpCoefficient& to_y, WarpCoefficient& to_zero) {
        return detail::coefficient_of(times(x, inner.xx) + times(y, inner.yx), to_x) &&
               detail::coefficient_of(times(x, inner.xy) + times(y, inner.yy), to_y) &&
               detail::coefficient_of(times(x, inner.x0) + times(y, inner.y0) + detail::widened(zero),
                                      to_zero);
    };
    if (!row(outer.xx, outer.xy, outer.x0, both.xx, both.xy, both.x0) ||
        !row(outer.yx, outer.yy, outer.y0, both.yx, both.yy, both.y0))
        return Status::out_of_range;
    return both;
}

constexpr Result<AffineTransform> inverse_of(const AffineTransform& t) {
    using detail::times;
    WarpCoefficient determinant;
    if (!detail::coefficient_of(times(t.xx, t.yy) - times(t.xy, t.yx), determinant))
        return Status::out_of_range;
    if (determinant.raw() == 0) return Status::degenerate;
    // Below 2^63 times 2^40 over the determinant; held ends say that it does not fit.
    bool fits = true;
    const auto over = [&](WarpCoefficient k) {
        const std::int64_t raw = multiply_divide(k.raw(), WarpCoefficient::one, determinant.raw());
        fits = fits && raw != std::numeric_limits<std::int64_t>::max() &&
               raw != std::numeric_limits<std::int64_t>::min();
        return WarpCoefficient::from_raw(raw);
    };
    AffineTransform back;
    back.xx = over(t.yy);
    back.xy = over(-t.xy);
    back.yx = over(-t.yx);
    back.yy = over(t.xx);
    if (!fits || !detail::coefficient_of(-(times(back.xx, t.x0) + times(back.xy, t.y0)), back.x0) ||
        !detail::coefficient_of(-(times(back.yx, t.x0) + times(back.yy, t.y0)), back.y0))
        return Status::out_of_range;
    return back;
}

constexpr Result<FinePoint> map_point(const AffineTransform& t, FinePoint place) {
    const auto mapped = [&](WarpCoefficient x, WarpCoefficient y, WarpCoefficient zero) {
        const Int128 sum = Int128::product(x.raw(), place.x.raw()) + Int128::product(y.raw(), place.y.raw()) +
                           (Int128(zero.raw()) << 16);
        return (sum + (Int128(1) << 39)) >> 40;
    };
    const Int128 x = mapped(t.xx, t.xy, t.x0);
    const Int128 y = mapped(t.yx, t.yy, t.y0);
    const Int128 most(std::numeric_limits<std::int32_t>::max());
    if (most < x || x < -most || most < y || y < -most) return Status::out_of_range;
    return FinePoint{FinePixel::from_raw(static_cast<std::int32_t>(x.low_word())),
                     FinePixel::from_raw(static_cast<std::int32_t>(y.low_word()))};
}

constexpr int source_rows_of(const AffineTransform& transform, int width) {
    const Int128 rise = Int128::product(transform.yx.raw(), width - 1);
    const Int128 height = (rise.negative() ? -rise : rise) >> WarpCoefficient::fraction_bits;
    // One for the part of a row at either end, one for the row below.
    return height < Int128(max_image_side) ? static_cast<int>(height.low_word()) + 3 : max_image_side;
}

inline namespace FOVEA_ISA {
namespace kernels {

struct AffinePlaces {
    static constexpr simd::PlaceOrder order = simd::PlaceOrder::along_a_line;
    static constexpr int strip = warp_strip;
    AffineTransform transform;

    void operator()(int x, int y, int count, simd::PlaceRun& run) const {
        const AffineTransform& t = transform;
        // Below 2^62, as was checked. Places of 40 bits less 32 are 1/256 px.
        simd::straight_places(t.xx.raw() * x + t.xy.raw() * y + t.x0.raw(), t.xx.raw(), count, run.x);
        simd::straight_places(t.yx.raw() * x + t.yy.raw() * y + t.y0.raw(), t.yx.raw(), count, run.y);
    }
};

}  // namespace kernels

template <class Pixel>
Status warp_affine(NonDeduced<ImageView<const Pixel>> src, const AffineTransform& transform,
                   const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst) {
    if (Status s = kernels::check_warp<Pixel>(src, dst); s != Status::ok) return s;
    if (!detail::stays_near(transform, dst.size())) return Status::bad_argument;
    kernels::warp_frame<Pixel>(src, kernels::AffinePlaces{transform}, sampling, dst);
    return Status::ok;
}

template <class Pixel>
Status rotate(NonDeduced<ImageView<const Pixel>> src, FinePoint centre, FineAngle angle,
              const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst) {
    return warp_affine<Pixel>(src, rotation_about(centre, angle), sampling, dst);
}

}  // namespace FOVEA_ISA
}  // namespace fovea
