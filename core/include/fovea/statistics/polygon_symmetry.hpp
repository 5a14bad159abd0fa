// SPDX-License-Identifier: MIT
//
// Rotational symmetry of what polygons enclose: how strongly it repeats itself a given number of times in a
// turn, and where it begins. It gives a direction to parts that have no longest axis: squares, nuts, flanges.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The orders of rotational symmetry that are told apart: 3 of a triangle, 4 of a square, 6 of a nut.
inline constexpr int min_symmetry_order = 3;
inline constexpr int max_symmetry_order = 12;

/// A direction that repeats itself every 1 / order of a turn.
///
/// axis      where the least lies, so to the middle of a flat side; -180 / order to 180 / order degrees
/// strength  of the harmonic over the area: 0.142 of a square, 0.059 of a hexagon, 0 of a disc
struct RotationalAxis {
    FineAngle axis;
    Ratio strength;
};

/// Adds up the harmonic of the angle about an origin over what closed polygons enclose, edge by edge:
/// positive for a polygon that runs clockwise on screen, negative for the other way, so that holes subtract
/// themselves.
///
/// Shapes    origin is where the moments say; near the middle of what is enclosed
/// Units     pixels; the edges may be given with 1/65536 px and count with 1/256. Rows are `aspect` times as
///           far apart as columns, 1/4 to 4
/// Rounding  an edge weighs the area of its triangle with the origin, all of it in the direction of the
///           middle of the edge: short edges, such as those of a contour, give the integral
/// Source    Fourier series of r^2 / 2 over the angle, which is the area of a sector; Zahn and Roskies,
///           "Fourier Descriptors for Plane Closed Curves", 1972, do the same with the tangent
class PolygonSymmetry {
public:
    /// order is held to min_symmetry_order..max_symmetry_order.
    constexpr PolygonSymmetry(FinePoint origin, int order, PixelAspect aspect = PixelAspect::from_int(1))
        : origin_(origin), order_(clamp(order, min_symmetry_order, max_symmetry_order)), aspect_(aspect) {}

    /// An edge of a polygon, in order; the polygon must come back to where it began.
    constexpr void add_edge(FinePoint from, FinePoint to, int sign = 1);

    /// Errors  empty_image if nothing is enclosed; degenerate if nothing repeats itself (a disc)
    constexpr Result<RotationalAxis> axis() const;

private:
    FinePoint origin_;
    int order_;
    PixelAspect aspect_;
    Int128 area_;    ///< twice, in 1/256^2 px^2
    Int128 cosine_;  ///< the same times the cosine of order * angle, with 30 fraction bits more
    Int128 sine_;
};

// ---- Implementation ---------------------------------------------------------------

constexpr void PolygonSymmetry::add_edge(FinePoint from, FinePoint to, int sign) {
    const auto along = [](FinePixel value, FinePixel origin) {
        return round_shift(std::int64_t{value.raw()} - origin.raw(), 8);
    };
    const auto across = [&](FinePixel value) {
        const std::int64_t plain = std::int64_t{value.raw()} - origin_.y.raw();
        return round_shift(multiply_divide(plain, aspect_.raw(), PixelAspect::one), 8);
    };
    // Sides of 27 bits with sign at most, so areas of 54.
    const std::int64_t x0 = along(from.x, origin_.x);
    const std::int64_t y0 = across(from.y);
    const std::int64_t x1 = along(to.x, origin_.x);
    const std::int64_t y1 = across(to.y);
    const std::int64_t area = (x0 * y1 - x1 * y0) * sign;
    const std::uint32_t angle = angle_of(x0 + x1, y0 + y1).raw();
    const UnitVector way = unit_vector(FineAngle::from_raw(angle * static_cast<std::uint32_t>(order_)));
    area_ += Int128(area);
    cosine_ += Int128::product(area, way.x.raw());
    sine_ += Int128::product(area, way.y.raw());
}

constexpr Result<RotationalAxis> PolygonSymmetry::axis() const {
    const Int128 unit = Int128(1) << Unit::fraction_bits;
    const std::int64_t area = round_divide(area_, Int128(1));
    if (area <= 0) return Status::empty_image;
    const std::int64_t cosine = round_divide(cosine_, unit);
    const std::int64_t sine = round_divide(sine_, unit);
    RotationalAxis result;
    const std::int64_t length = hypotenuse(cosine, sine);
    result.strength = Ratio::from_raw(saturate_cast<std::int32_t>(multiply_divide(length, Ratio::one, area)));
    if (result.strength.raw() == 0) return Status::degenerate;
    const FineAngle least = angle_of(cosine, sine) + FineAngle::half_turn();
    result.axis = FineAngle::from_raw(static_cast<std::uint32_t>(least.signed_raw() / order_));
    return result;
}

}  // namespace fovea
