// SPDX-License-Identifier: MIT
//
// Moments of what a closed line encloses, from its corners alone. Book sec. 6.2.1 names this shortcut.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The farthest a corner may be from the origin of PolygonMoments, in pixels; bounds its sums.
inline constexpr int max_polygon_reach = 4095;

/// Adds up the moments inside closed polygons from their edges: positive for one that runs clockwise on
/// screen, negative for the other way, so that holes subtract themselves.
///
/// Units     pixels; the polygon may be given with 1/65536 px and counts with 1/256
/// Rounding  sums are exact for corners in 1/256 px
/// Source    Green's theorem; Steger, "On the Calculation of Arbitrary Moments of Polygons", 1996
class PolygonMoments {
public:
    /// Every corner must be within max_polygon_reach of the origin, and stays so by the caller's care; near
    /// the centroid is best.
    explicit constexpr PolygonMoments(Point origin) : origin_(origin) {}

    /// An edge of a polygon, in order; the polygon must come back to where it began.
    constexpr void add_edge(FinePoint from, FinePoint to, int sign = 1);

    /// The moments about the centroid. Their area is rounded to whole pixels.
    ///
    /// Errors  empty_image if less than half a pixel is enclosed
    constexpr Result<CentralMoments> central() const;

private:
    Point origin_;
    // Sums of cross products times powers: 2, 6, 12, 24, 20 and 60 times the moments, coordinates in 1/256
    // px.
    Int128 s00_, s10_, s01_, s20_, s11_, s02_, s30_, s21_, s12_, s03_;
};

// ---- Implementation ---------------------------------------------------------------

constexpr void PolygonMoments::add_edge(FinePoint from, FinePoint to, int sign) {
    const auto relative = [](FinePixel value, int origin) {
        return std::int64_t{round_shift(value.raw(), 8)} - std::int64_t{origin} * 256;
    };
    // Sides of 21 bits with sign; cubes of the sums stay below 2^63.
    const std::int64_t x0 = relative(from.x, origin_.x);
    const std::int64_t y0 = relative(from.y, origin_.y);
    const std::int64_t x1 = relative(to.x, origin_.x);
    const std::int64_t y1 = relative(to.y, origin_.y);
    const std::int64_t a = (x0 * y1 - x1 * y0) * sign;
    s00_ += Int128(a);
    s10_ += Int128::product(a, x0 + x1);
    s01_ += Int128::product(a, y0 + y1);
    s20_ += Int128::product(a, x0 * x0 + x0 * x1 + x1 * x1);
    s11_ += Int128::product(a, 2 * x0 * y0 + x0 * y1 + x1 * y0 + 2 * x1 * y1);
    s02_ += Int128::product(a, y0 * y0 + y0 * y1 + y1 * y1);
    s30_ += Int128::product(a, (x0 + x1) * (x0 * x0 + x1 * x1));
    s21_ += Int128::product(a, x0 * x0 * (3 * y0 + y1) + 2 * x0 * x1 * (y0 + y1) + x1 * x1 * (y0 + 3 * y1));
    s12_ += Int128::product(a, y0 * y0 * (3 * x0 + x1) + 2 * y0 * y1 * (x0 + x1) + y1 * y1 * (x0 + 3 * x1));
    s03_ += Int128::product(a, (y0 + y1) * (y0 * y0 + y1 * y1));
}

constexpr Result<CentralMoments> PolygonMoments::central() const {
    // Moments with 8 fraction bits of pixels: a sum of order n has 8 (n + 2) of them.
    const auto moment = [](Int128 sum, std::int64_t factor, int order) {
        return round_divide(sum, Int128(factor) << (8 * order + 8));
    };
    const std::int64_t m00 = moment(s00_, 2, 0);
    if (m00 < 128) return Status::empty_image;
    const std::int64_t m10 = moment(s10_, 6, 1);
    const std::int64_t m01 = moment(s01_, 6, 1);
    const std::int64_t m20 = moment(s20_, 12, 2);
    const std::int64_t m11 = moment(s11_, 24, 2);
    const std::int64_t m02 = moment(s02_, 12, 2);
    CentralMoments c;
    c.area = round_shift(m00, 8);
    c.centroid.x = FinePixel::from_int(origin_.x) + FinePixel::from_ratio(m10, m00);
    c.centroid.y = FinePixel::from_int(origin_.y) + FinePixel::from_ratio(m01, m00);
    const std::int64_t xx = multiply_divide(m10, m10, m00);
    const std::int64_t xy = multiply_divide(m10, m01, m00);
    const std::int64_t yy = multiply_divide(m01, m01, m00);
    c.mu20 = SecondMoment::from_raw(m20 - xx);
    c.mu11 = SecondMoment::from_raw(m11 - xy);
    c.mu02 = SecondMoment::from_raw(m02 - yy);
    // mu30 = m30 - 3 x m20 + 2 x^2 m10 with x = m10 / m00, and so on.
    const std::int64_t mu30 =
        moment(s30_, 20, 3) - multiply_divide(3 * m10, m20, m00) + multiply_divide(2 * m10, xx, m00);
    const std::int64_t mu21 = moment(s21_, 60, 3) - multiply_divide(2 * m10, m11, m00) -
                              multiply_divide(m01, m20, m00) + multiply_divide(2 * m01, xx, m00);
    const std::int64_t mu12 = moment(s12_, 60, 3) - multiply_divide(2 * m01, m11, m00) -
                              multiply_divide(m10, m02, m00) + multiply_divide(2 * m10, yy, m00);
    const std::int64_t mu03 =
        moment(s03_, 20, 3) - multiply_divide(3 * m01, m02, m00) + multiply_divide(2 * m01, yy, m00);
    c.mu30 = round_shift(mu30, 8);
    c.mu21 = round_shift(mu21, 8);
    c.mu12 = round_shift(mu12, 8);
    c.mu03 = round_shift(mu03, 8);
    return c;
}

}  // namespace fovea
