// SPDX-License-Identifier: MIT
//
// The fisheye camera: a lens whose picture grows with the angle, and not with its tangent.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/arctangent.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What a fisheye camera is by itself.
///
/// Units   fx, fy, cx, cy in pixels; light that comes from the angle a off the axis, in radians, falls at the
///         radius a (1 + k1 a^2 + k2 a^4 + k3 a^6 + k4 a^8), of which fx and fy make pixels
/// Source  Kannala and Brandt, "A Generic Camera Model and Calibration Method for Conventional, Wide-Angle,
///         and Fish-Eye Lenses", PAMI 28(8), 2006, eq. 6; the terms are those of OpenCV's module fisheye
template <class Scalar = Real>
struct FisheyeCamera {
    Scalar fx = scalar_of<Scalar>(1);
    Scalar fy = scalar_of<Scalar>(1);
    Scalar cx = scalar_of<Scalar>(0);
    Scalar cy = scalar_of<Scalar>(0);
    Scalar k1 = scalar_of<Scalar>(0);
    Scalar k2 = scalar_of<Scalar>(0);
    Scalar k3 = scalar_of<Scalar>(0);
    Scalar k4 = scalar_of<Scalar>(0);

    /// The radius of an angle, and how it rises with it.
    constexpr Scalar radius(Scalar angle) const;
    constexpr Scalar slope(Scalar angle) const;
};

/// A fisheye camera and its field: the angles up to the first at which the radius might not grow any more.
/// What the polynomial says beyond is nothing, and is not answered. The field may reach behind the camera.
///
/// Source  between two angles the slope is above the least of its five Bernstein coefficients in the square
template <class Scalar = Real>
class FisheyeLens {
public:
    /// Looks for the field: 202 strides, more where it ends, at most 4096.
    constexpr explicit FisheyeLens(const FisheyeCamera<Scalar>& camera);

    constexpr const FisheyeCamera<Scalar>& camera() const { return camera_; }
    /// The angle off the axis at which the field ends, up to pi.
    constexpr Scalar field() const { return field_; }

    /// The pixel in which a point in camera coordinates is seen.
    ///
    /// Errors  out_of_range for a point outside of the field, or in the camera itself
    constexpr Result<Vector<2, Scalar>> project(const Vector<3, Scalar>& point) const;

    /// The direction from which a pixel is seen, at length 1; z is below 0 behind the camera.
    ///
    /// Rounding  the radius of its angle is within 2^-54 of the pixel's, or of its length where that is above
    ///           1
    /// Time      at most 80 steps of Newton's, halved where they leave what is known to hold the angle; 3 to
    ///           6 as a rule
    /// Errors    bad_argument for a camera without focal lengths; out_of_range for a pixel outside of the
    ///           field
    constexpr Result<Vector<3, Scalar>> ray(const Vector<2, Scalar>& pixel) const;

private:
    /// Whether the slope is above 0 between two angles.
    constexpr bool sound(Scalar from, Scalar to) const;

    FisheyeCamera<Scalar> camera_;
    Scalar field_ = scalar_of<Scalar>(0);
};

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr Scalar FisheyeCamera<Scalar>::radius(Scalar angle) const {
    const Scalar s = angle * angle;
    return angle * (scalar_of<Scalar>(1) + s * (k1 + s * (k2 + s * (k3 + s * k4))));
}

template <class Scalar>
constexpr Scalar FisheyeCamera<Scalar>::slope(Scalar angle) const {
    const Scalar s = angle * angle;
    return scalar_of<Scalar>(1) +
           s * (scalar_of<Scalar>(3) * k1 +
                s * (scalar_of<Scalar>(5) * k2 +
                     s * (scalar_of<Scalar>(7) * k3 + s * (scalar_of<Scalar>(9) * k4))));
}

template <class Scalar>
constexpr FisheyeLens<Scalar>::FisheyeLens(const FisheyeCamera<Scalar>& camera) : camera_(camera) {
    const Scalar most = pi<Scalar>();
    int bits = 6;
    for (int i = 0; i < 4096 && bits <= 30 && field_ < most; ++i) {
        Scalar next = field_ + scalar_of<Scalar>(1, -bits);
        if (most < next) next = most;
        const bool good = sound(field_, next);
        if (good) field_ = next;
        // Smaller strides where it is not certain, and back to the first.
        bits = good ? maximum(bits - 1, 6) : bits + 1;
    }
}

template <class Scalar>
constexpr bool FisheyeLens<Scalar>::sound(Scalar from, Scalar to) const {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar a = scalar_of<Scalar>(3) * camera_.k1;
    const Scalar b = scalar_of<Scalar>(5) * camera_.k2;
    const Scalar c = scalar_of<Scalar>(7) * camera_.k3;
    const Scalar d = scalar_of<Scalar>(9) * camera_.k4;
    const Scalar three = scalar_of<Scalar>(3);
    const Scalar s = from * from;
    const Scalar t = to * to;
    const Scalar quarter = scale(t - s, -2);
    // 1 + a x + b x^2 + c x^3 + d x^4 from s to t.
    const auto rise = [&](Scalar x) {
        return quarter * (a + x * (scale(b, 1) + x * (three * c + x * scale(d, 2))));
    };
    const Scalar bend = scale(b, 1) + s * (scalar_of<Scalar>(6) * c + s * (scalar_of<Scalar>(12) * d));
    const Scalar first = camera_.slope(from);
    const Scalar last = camera_.slope(to);
    const Scalar middle = first + scale(rise(s), 1) + scale(quarter * quarter, 2) / three * bend;
    return zero < first && zero < first + rise(s) && zero < middle && zero < last - rise(t) && zero < last;
}

template <class Scalar>
constexpr Result<Vector<2, Scalar>> FisheyeLens<Scalar>::project(const Vector<3, Scalar>& point) const {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar off = square_root(point[0] * point[0] + point[1] * point[1]);
    if (off == zero) {
        if (!(zero < point[2])) return Status::out_of_range;
        return Vector<2, Scalar>(camera_.cx, camera_.cy);
    }
    const Scalar angle = arctangent(off, point[2]);
    if (field_ < angle) return Status::out_of_range;
    const Scalar share = camera_.radius(angle) / off;
    return Vector<2, Scalar>(camera_.fx * (point[0] * share) + camera_.cx,
                             camera_.fy * (point[1] * share) + camera_.cy);
}

template <class Scalar>
constexpr Result<Vector<3, Scalar>> FisheyeLens<Scalar>::ray(const Vector<2, Scalar>& pixel) const {
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar one = scalar_of<Scalar>(1);
    if (camera_.fx == zero || camera_.fy == zero) return Status::bad_argument;
    const Vector<2, Scalar> place((pixel[0] - camera_.cx) / camera_.fx, (pixel[1] - camera_.cy) / camera_.fy);
    const Scalar wanted = length_of(place);
    if (wanted == zero) return Vector<3, Scalar>(zero, zero, one);
    Scalar low = zero;
    Scalar high = field_;
    if (camera_.radius(high) < wanted) return Status::out_of_range;
    const Scalar small = scale(one + wanted, -55);
    Scalar angle = wanted < high ? wanted : high;
    for (int i = 0; i < 80; ++i) {
        const Scalar error = camera_.radius(angle) - wanted;
        if (!(small < absolute(error))) {
            const CosineAndSine<Scalar> turn(angle);
            const Scalar share = turn.sine / wanted;
            return Vector<3, Scalar>(place[0] * share, place[1] * share, turn.cosine);
        }
        (zero < error ? high : low) = angle;
        const Scalar slope = camera_.slope(angle);
        const Scalar next = zero < slope ? angle - error / slope : high;
        angle = low < next && next < high ? next : scale(low + high, -1);
    }
    return Status::out_of_range;
}

}  // namespace fovea
