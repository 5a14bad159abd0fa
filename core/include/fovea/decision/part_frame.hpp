// SPDX-License-Identifier: MIT
//
// PartFrame: from the coordinates of a part to those of the image and back. The probes are carried into the
// image; the image is never turned. Book sec. 6.2.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

constexpr PartPoint operator+(PartPoint a, PartPoint b) { return {a.x + b.x, a.y + b.y}; }
constexpr PartPoint operator-(PartPoint a, PartPoint b) { return {a.x - b.x, a.y - b.y}; }

/// The length of a vector in the frame of a part; as hypotenuse().
constexpr std::int64_t length_of(PartPoint vector) { return hypotenuse(vector.x, vector.y); }

/// The vector of that length a quarter turn clockwise from another; zero if the other is.
constexpr PartPoint square_to(PartPoint vector, std::int64_t length) {
    const std::int64_t whole = maximum<std::int64_t>(length_of(vector), 1);
    return {multiply_divide(-vector.y, length, whole), multiply_divide(vector.x, length, whole)};
}

/// The point `part` of `whole` steps on the way from a to b.
constexpr PartPoint point_between(PartPoint a, PartPoint b, std::int64_t part, std::int64_t whole) {
    const PartPoint way = b - a;
    return a + PartPoint{multiply_divide(way.x, part, whole), multiply_divide(way.y, part, whole)};
}

/// Where a part lies: its centroid in the image, and the direction of its axis where rows and columns are
/// equally far apart.
class PartFrame {
public:
    constexpr PartFrame() = default;
    constexpr PartFrame(FinePoint origin, FineAngle angle, const Scale& scale)
        : origin_(origin), angle_(angle), axis_(unit_vector(angle)), scale_(scale) {}

    constexpr FinePoint origin() const { return origin_; }
    constexpr FineAngle angle() const { return angle_; }

    /// A place of the part, in the image.
    ///
    /// Rounding  to the nearest 1/65536 px
    /// Errors    out_of_range beyond +-32767 px
    constexpr Result<FinePoint> to_image(PartPoint place) const;

    /// A place of the image, in the part.
    ///
    /// Rounding  to the nearest millionth of the unit
    constexpr PartPoint to_part(FinePoint place) const;

private:
    FinePoint origin_;
    FineAngle angle_;
    UnitVector axis_{Unit::from_raw(Unit::one), Unit()};
    Scale scale_;
};

// ---- Implementation ---------------------------------------------------------------

constexpr Result<FinePoint> PartFrame::to_image(PartPoint place) const {
    // Coordinates of 38 bits times a unit vector of 31; the divisor leaves 16 fraction bits.
    const Int128 x = Int128::product(place.x, axis_.x.raw()) - Int128::product(place.y, axis_.y.raw());
    const Int128 y = Int128::product(place.x, axis_.y.raw()) + Int128::product(place.y, axis_.x.raw());
    constexpr std::int64_t divisor = std::int64_t{1} << (Unit::fraction_bits - FinePixel::fraction_bits);
    const std::int64_t u = round_divide(x, Int128::product(scale_.x_per_pixel, divisor));
    const std::int64_t v = round_divide(y, Int128::product(scale_.y_per_pixel, divisor));
    constexpr std::int64_t most = FinePixel::from_int(max_image_side).raw();
    if (magnitude(u) > static_cast<std::uint64_t>(2 * most) ||
        magnitude(v) > static_cast<std::uint64_t>(2 * most))
        return Status::out_of_range;
    const std::int64_t image_x = origin_.x.raw() + u;
    const std::int64_t image_y = origin_.y.raw() + v;
    if (magnitude(image_x) > static_cast<std::uint64_t>(most) ||
        magnitude(image_y) > static_cast<std::uint64_t>(most))
        return Status::out_of_range;
    return FinePoint{FinePixel::from_raw(static_cast<std::int32_t>(image_x)),
                     FinePixel::from_raw(static_cast<std::int32_t>(image_y))};
}

constexpr PartPoint PartFrame::to_part(FinePoint place) const {
    // Offsets of 33 bits times a scale of 27 fit.
    const std::int64_t u = (std::int64_t{place.x.raw()} - origin_.x.raw()) * scale_.x_per_pixel;
    const std::int64_t v = (std::int64_t{place.y.raw()} - origin_.y.raw()) * scale_.y_per_pixel;
    const Int128 one(std::int64_t{1} << (Unit::fraction_bits + FinePixel::fraction_bits));
    return {round_divide(Int128::product(u, axis_.x.raw()) + Int128::product(v, axis_.y.raw()), one),
            round_divide(Int128::product(v, axis_.x.raw()) - Int128::product(u, axis_.y.raw()), one)};
}

}  // namespace fovea
