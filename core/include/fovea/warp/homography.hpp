// SPDX-License-Identifier: MIT
//
// Homography warps: a plane as another camera would see it. Book sec. 2.9.
#pragma once

#include <cstdint>
#include <limits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/places.hpp>
#include <fovea/warp/affine.hpp>
#include <fovea/warp/sampling.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Where the output pixel (x, y) comes from: (xx x + xy y + x0, yx x + yy y + y0) / (wx x + wy y + w0), where
/// the divisor is above 0. Where it is not, the pixel shows what lies beyond the horizon: nothing.
///
/// Units  all nine have the same factor, which cancels. More bits are better: over all pixels of the output
///        none of the three sums may reach 2^62, and the divisor should need 32 bits or more
struct Homography {
    std::int64_t xx = WarpCoefficient::one;
    std::int64_t xy = 0;
    std::int64_t x0 = 0;
    std::int64_t yx = 0;
    std::int64_t yy = WarpCoefficient::one;
    std::int64_t y0 = 0;
    std::int64_t wx = 0;
    std::int64_t wy = 0;
    std::int64_t w0 = WarpCoefficient::one;
};

/// An affine transform as a homography.
constexpr Homography homography_of(const AffineTransform& transform);

/// Where a place goes, to the nearest 1/65536 px, ties up.
///
/// Errors  not_found at and beyond the horizon; out_of_range beyond 32767 px
constexpr Result<FinePoint> map_point(const Homography& homography, FinePoint place);

inline namespace FOVEA_ISA {

/// Every pixel of dst is what src shows at the place that the homography gives.
///
/// Shapes    any sizes, 1x1 to 32767x32767; Gray8 or Rgb888
/// Units     any 8-bit values
/// Rounding  at every 16th column the quotients are right to 2^-30 of themselves and 2^-16 px. Between these
///           columns they follow a parabola where the divisor changes by less than a sixteenth: it leaves the
///           true curve by less than 1/5000 of the way over the 16 columns, 1/300 px at true size. Elsewhere
///           every pixel is divided. Places then to 1/256 px, pixels as warp_affine()
/// Border    as sampling says; beyond the horizon its level
/// Overlap   none
/// Errors    empty_image; image_too_large; bad_argument for coefficients whose sums could reach 2^62
/// Source    book sec. 2.9.1, 2.9.2. All nine coefficients count, for nearest pixels too
template <class Pixel>
Status warp_homography(NonDeduced<ImageView<const Pixel>> src, const Homography& homography,
                       const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst);

}  // namespace FOVEA_ISA

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Whether |a x + b y + c| stays below 2^62 for the pixels of an image, and for as many columns as a curve
/// has.
constexpr bool stays_below(std::int64_t a, std::int64_t b, std::int64_t c, Size size) {
    const auto wide = [](std::int64_t k) { return k < 0 ? -Int128(k) : Int128(k); };
    return wide(a) * maximum(size.width - 1, 16) + wide(b) * (size.height - 1) + wide(c) <
           Int128(std::int64_t{1} << 62);
}

/// One over a positive number: mantissa / 2^63 * 2^(zeros - 32), the mantissa 2^31..2^32.
struct Reciprocal {
    std::uint64_t mantissa;
    int zeros;
};

/// Right to 2^-30 of itself.
constexpr Reciprocal reciprocal_of(std::int64_t divisor) {
    const int zeros = leading_zeros(static_cast<std::uint64_t>(divisor));
    const std::uint64_t top = static_cast<std::uint64_t>(divisor) << zeros >> 32;
    return {(std::uint64_t{1} << 63) / top, zeros};
}

/// The largest magnitude of quotient(): 2^21 at 16 fraction bits.
inline constexpr std::int64_t largest_quotient = std::int64_t{1} << 37;

/// value * 2^bits times a reciprocal, toward zero, right to 2^-30 of itself; held at largest_quotient.
constexpr std::int64_t quotient(std::int64_t value, Reciprocal by, int bits) {
    if (value == 0) return 0;
    const std::uint64_t size = magnitude(value);
    const int zeros = leading_zeros(size);
    const std::uint64_t product = (size << zeros >> 32) * by.mantissa;  // at most (2^32 - 1) * 2^32
    const int drop = 63 + zeros - by.zeros - bits;
    if (drop >= 64) return 0;
    const bool held = drop < 1 || product >> drop >= static_cast<std::uint64_t>(largest_quotient);
    const std::int64_t result = held ? largest_quotient : static_cast<std::int64_t>(product >> drop);
    return value < 0 ? -result : result;
}

}  // namespace detail

constexpr Homography homography_of(const AffineTransform& t) {
    return {t.xx.raw(), t.xy.raw(), t.x0.raw(), t.yx.raw(),          t.yy.raw(),
            t.y0.raw(), 0,          0,          WarpCoefficient::one};
}

constexpr Result<FinePoint> map_point(const Homography& h, FinePoint place) {
    const auto sum = [&](std::int64_t x, std::int64_t y, std::int64_t zero) {
        return Int128::product(x, place.x.raw()) + Int128::product(y, place.y.raw()) + (Int128(zero) << 16);
    };
    // At most 63 + 31 bits, 16 more below; round_divide() takes 126.
    const Int128 divisor = sum(h.wx, h.wy, h.w0);
    if (!(Int128(0) < divisor)) return Status::not_found;
    const std::int64_t x = round_divide(sum(h.xx, h.xy, h.x0) << 16, divisor);
    const std::int64_t y = round_divide(sum(h.yx, h.yy, h.y0) << 16, divisor);
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    if (x > most || x < -most || y > most || y < -most) return Status::out_of_range;
    return FinePoint{FinePixel::from_raw(static_cast<std::int32_t>(x)),
                     FinePixel::from_raw(static_cast<std::int32_t>(y))};
}

inline namespace FOVEA_ISA {
namespace kernels {

class HomographyPlaces {
public:
    static constexpr simd::PlaceOrder order = simd::PlaceOrder::along_a_line;
    static constexpr int strip = warp_strip;

    explicit HomographyPlaces(const Homography& homography)
        : h_(homography), slope_(homography.wx * simd::curve_length) {}

    void operator()(int x, int y, int count, simd::PlaceRun& run) const {
        // Below 2^62, as was checked; at the end of the last curve, a column beyond the image, below 2^63.
        Sums sums{h_.xx * x + h_.xy * y + h_.x0, h_.yx * x + h_.yy * y + h_.y0,
                  h_.wx * x + h_.wy * y + h_.w0};
        Knot from = knot_at(sums);
        for (int i = 0; i < count; i += simd::curve_length) {
            const bool last = i + simd::curve_length > count;
            Sums next = sums;
            Knot to;
            if (!last) {
                next = {sums.x + h_.xx * simd::curve_length, sums.y + h_.yx * simd::curve_length,
                        sums.w + slope_};
                to = knot_at(next);
            }
            const bool curved = from.there && to.there && curve(from, to, i, run);
            if (!curved) exact(sums, minimum(count - i, simd::curve_length), i, run);
            sums = next;
            from = to;
        }
    }

private:
    struct Sums {
        std::int64_t x, y, w;
    };
    /// A place whose quotients are known, in 1/65536 px.
    struct Knot {
        std::int64_t x = 0;
        std::int64_t y = 0;
        detail::Reciprocal inverse{};
        bool there = false;
    };

    static Knot knot_at(const Sums& sums) {
        if (sums.w <= 0) return {};
        const detail::Reciprocal inverse = detail::reciprocal_of(sums.w);
        return {detail::quotient(sums.x, inverse, 16), detail::quotient(sums.y, inverse, 16), inverse, true};
    }

    /// The places between two knots; false where a parabola is not good enough.
    ///
    /// With t from 0 to 1 and the divisor growing as 1 + r t the place is p + d t (1 + r) / (1 + r t), which
    /// is p + d t + d s t (1 - t) for s = r / (1 + r / 2) but for less than d r^2 / 20.
    bool curve(const Knot& from, const Knot& to, int i, simd::PlaceRun& run) const {
        const std::int64_t way_x = to.x - from.x;
        const std::int64_t way_y = to.y - from.y;
        constexpr std::int64_t longest = std::int64_t{1} << 26;
        if (way_x >= longest || way_x <= -longest || way_y >= longest || way_y <= -longest) return false;
        const std::int64_t growth = detail::quotient(slope_, from.inverse, 28);
        constexpr std::int64_t most = std::int64_t{1} << 24;  // 1/16
        if (growth > most || growth < -most) return false;
        // r - r^2 / 2 + r^3 / 4, the rest below 2^-19.
        const std::int64_t square = growth * growth >> 28;
        const std::int64_t bend = growth - (square >> 1) + ((square * growth >> 28) >> 2);
        curve_along(from.x, way_x, bend, run.x + i);
        curve_along(from.y, way_y, bend, run.y + i);
        return true;
    }
    /// In 2^-20 px: 16 p + d i + (d s / 16) i (16 - i), rounded to 2^-8. The three stay below 2^31.
    static void curve_along(std::int64_t from, std::int64_t way, std::int64_t bend, std::int32_t* to) {
        const auto bow = static_cast<std::int32_t>(way * bend >> 32);
        simd::curve_places(static_cast<std::int32_t>(from >> 8),
                           static_cast<std::int32_t>((from & 255) << 4) + (1 << 11),
                           static_cast<std::int32_t>(way), bow, 12, to);
    }
    /// A division for every place.
    void exact(Sums sums, int count, int i, simd::PlaceRun& run) const {
        for (const int end = i + count; i < end; ++i) {
            const Knot knot = knot_at(sums);
            run.x[i] = knot.there ? static_cast<std::int32_t>((knot.x + 128) >> 8) : simd::no_place;
            run.y[i] = static_cast<std::int32_t>((knot.y + 128) >> 8);
            sums = {sums.x + h_.xx, sums.y + h_.yx, sums.w + h_.wx};
        }
    }

    Homography h_;
    std::int64_t slope_;
};

}  // namespace kernels

template <class Pixel>
Status warp_homography(NonDeduced<ImageView<const Pixel>> src, const Homography& h,
                       const NonDeduced<Sampling<Pixel>>& sampling, ImageView<Pixel> dst) {
    if (Status s = kernels::check_warp<Pixel>(src, dst); s != Status::ok) return s;
    if (!detail::stays_below(h.xx, h.xy, h.x0, dst.size()) ||
        !detail::stays_below(h.yx, h.yy, h.y0, dst.size()) ||
        !detail::stays_below(h.wx, h.wy, h.w0, dst.size()))
        return Status::bad_argument;
    kernels::warp_frame<Pixel>(src, kernels::HomographyPlaces(h), sampling, dst);
    return Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
