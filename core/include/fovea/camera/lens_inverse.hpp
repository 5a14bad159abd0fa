// SPDX-License-Identifier: MIT
//
// Back through the lens: which way the light came that fell on a pixel. Book sec. 2.2.4.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The inverse of distort(), inside the field in which there is one.
///
/// A lens model is a polynomial, and what it says far outside of what was calibrated is nothing: from some
/// radius on it folds back, and two ways lead to the same pixel. The field is a disc in which the slope of
/// the model is above 0 in every direction; there the inverse is unique.
///
/// Range   the field reaches to radius 8 at most, which is 83 degrees off the axis. With tangential terms it
///         may end before the last place that has an inverse
/// Source  the slope is symmetric, so the model is the gradient of a potential that is convex in the field,
///         and damped Newton steps lead down to the one place. The slope is at least the radial one less 6
///         |p| r: the tangential part's is 4 p x +- 2 |p| |x|. Radial slopes are polynomials of the squared
///         radius, and between two radii above the least of their four Bernstein coefficients there
template <class Scalar = Real>
class LensInverse {
public:
    /// Looks for the field: 512 strides of the radius, more where it ends, at most 4096.
    constexpr explicit LensInverse(const Camera<Scalar>& camera);

    constexpr const Camera<Scalar>& camera() const { return camera_; }
    /// Of the field, at distance 1.
    constexpr Scalar radius() const { return radius_; }

    /// The point at distance 1 that distort() puts to where this one is.
    ///
    /// Rounding  distort() of the answer is within 2^-54 of the point, or of its length where that is above 1
    /// Time      at most 60 steps of up to 40 halvings; four or five steps inside of the picture of a usual
    ///           lens, ten to twenty times as long for a place that is not seen
    /// Errors    out_of_range if no place of the field is seen there
    constexpr Result<Vector<2, Scalar>> undistort(const Vector<2, Scalar>& point) const;

    /// The direction at z = 1 from which a pixel is seen.
    ///
    /// Errors  bad_argument for a camera without focal lengths; out_of_range as above
    constexpr Result<Vector<3, Scalar>> ray(const Vector<2, Scalar>& pixel) const;

private:
    /// Whether the slope is above 0 between two radii.
    constexpr bool sound(Scalar from, Scalar to) const;
    /// The step of Newton's from a place whose image is off by (dx, dy).
    constexpr Vector<2, Scalar> step(const Vector<2, Scalar>& place, const Vector<2, Scalar>& off) const;

    Camera<Scalar> camera_;
    Scalar radius_;
};

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr LensInverse<Scalar>::LensInverse(const Camera<Scalar>& camera)
    : camera_(camera), radius_(scalar_of<Scalar>(0)) {
    const Scalar most = scalar_of<Scalar>(8);
    int bits = 6;
    for (int i = 0; i < 4096 && bits <= 30 && radius_ < most; ++i) {
        const Scalar next = radius_ + scalar_of<Scalar>(1, -bits);
        const bool good = sound(radius_, next);
        if (good) radius_ = next;
        // Smaller strides where it is not certain, and back to the first.
        bits = good ? maximum(bits - 1, 6) : bits + 1;
    }
}

template <class Scalar>
constexpr bool LensInverse<Scalar>::sound(Scalar from, Scalar to) const {
    const Scalar one = scalar_of<Scalar>(1);
    const Scalar s = from * from;
    const Scalar t = to * to;
    const Scalar third = (t - s) / scalar_of<Scalar>(3);
    const Scalar tangential = square_root(camera_.p1 * camera_.p1 + camera_.p2 * camera_.p2);
    const Scalar least = scalar_of<Scalar>(6) * tangential * to;
    // 1 + a s + b s^2 + c s^3 from s to t.
    const auto above = [&](Scalar a, Scalar b, Scalar c) {
        const auto value = [&](Scalar x) { return one + x * (a + x * (b + x * c)); };
        const auto rise = [&](Scalar x) {
            return third * (a + x * (scale(b, 1) + x * scalar_of<Scalar>(3) * c));
        };
        const Scalar first = value(s);
        const Scalar last = value(t);
        return least < first && least < first + rise(s) && least < last - rise(t) && least < last;
    };
    // Along the radius, and across it.
    return above(scalar_of<Scalar>(3) * camera_.k1, scalar_of<Scalar>(5) * camera_.k2,
                 scalar_of<Scalar>(7) * camera_.k3) &&
           above(camera_.k1, camera_.k2, camera_.k3);
}

template <class Scalar>
constexpr Vector<2, Scalar> LensInverse<Scalar>::step(const Vector<2, Scalar>& place,
                                                      const Vector<2, Scalar>& off) const {
    const Scalar x = place[0];
    const Scalar y = place[1];
    const Scalar s = x * x + y * y;
    const Scalar radial = scalar_of<Scalar>(1) + s * (camera_.k1 + s * (camera_.k2 + s * camera_.k3));
    // Twice the derivative of the radial factor by the square of the radius.
    const Scalar bend =
        scale(camera_.k1 + s * (scale(camera_.k2, 1) + s * scalar_of<Scalar>(3) * camera_.k3), 1);
    const Scalar six = scalar_of<Scalar>(6);
    const Scalar xx = radial + bend * x * x + scale(camera_.p1 * y, 1) + six * camera_.p2 * x;
    const Scalar xy = bend * x * y + scale(camera_.p1 * x + camera_.p2 * y, 1);
    const Scalar yy = radial + bend * y * y + six * camera_.p1 * y + scale(camera_.p2 * x, 1);
    const Scalar size = xx * yy - xy * xy;
    return Vector<2, Scalar>((yy * off[0] - xy * off[1]) / size, (xx * off[1] - xy * off[0]) / size);
}

template <class Scalar>
constexpr Result<Vector<2, Scalar>> LensInverse<Scalar>::undistort(const Vector<2, Scalar>& point) const {
    const Scalar small = scale(scalar_of<Scalar>(1) + length_of(point), -55);
    // From the axis: the images of the places on the way are about the straight line to the point, which is
    // in the image of the field. The first step leads to the point itself.
    Vector<2, Scalar> place;
    Vector<2, Scalar> off = point;
    Scalar error = length_of(off);
    for (int i = 0; i < 60; ++i) {
        if (!(small < error)) return place;
        const Vector<2, Scalar> move = step(place, off);
        // A step that is too long is halved until it stays in the field and leads down.
        bool better = false;
        for (int halving = 0; halving < 40 && !better; ++halving) {
            const Vector<2, Scalar> next = place + move * scalar_of<Scalar>(1, -halving);
            if (radius_ < length_of(next)) continue;
            const Vector<2, Scalar> rest = point - distort(camera_, next);
            const Scalar length = length_of(rest);
            if (!(length < error)) continue;
            better = true;
            place = next;
            off = rest;
            error = length;
        }
        if (!better) break;
    }
    return Status::out_of_range;
}

template <class Scalar>
constexpr Result<Vector<3, Scalar>> LensInverse<Scalar>::ray(const Vector<2, Scalar>& pixel) const {
    const Scalar zero = scalar_of<Scalar>(0);
    if (camera_.fx == zero || camera_.fy == zero) return Status::bad_argument;
    const Result<Vector<2, Scalar>> place = undistort(point_of(camera_, pixel));
    if (!place) return place.status();
    return Vector<3, Scalar>((*place)[0], (*place)[1], scalar_of<Scalar>(1));
}

}  // namespace fovea
