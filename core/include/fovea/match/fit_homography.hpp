// SPDX-License-Identifier: MIT
//
// The homography and the affine transform that fit pairs of places best. Book sec. 2.9.4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linear/least_squares.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The homography that takes places of a plane to pixels: (h00 x + h01 y + h02, h10 x + h11 y + h12) / (h20 x
/// + h21 y + h22), where the divisor is above 0 at all of the places and 1 at their mean.
///
/// Shapes    as many from as to: 4 to 2^20
/// Range     no place is further than 2^26 of its units, 1/256 px for pixels, from the mean of all
/// Rounding  sums are exact; then that of Scalar
/// Errors    size_mismatch; bad_argument for fewer than 4 pairs or more than 2^20; out_of_range beyond the
///           range; degenerate where all but one place or pixel lie on a line, or where the horizon would
///           pass between the places
/// Source    book sec. 2.9.4; least squares of the pixels times the divisor, with the origins shifted to
///           the means: by whole numbers, which rounds nothing
template <class Scalar = Real>
constexpr Result<Matrix<3, 3, Scalar>> fit_homography(Span<const PlanePoint> from,
                                                      Span<const SubPixelPoint> to);
/// The same from pixels to pixels.
template <class Scalar = Real>
constexpr Result<Matrix<3, 3, Scalar>> fit_homography(Span<const SubPixelPoint> from,
                                                      Span<const SubPixelPoint> to);

/// The affine transform that takes places of a plane to pixels: (a00 x + a01 y + a02, a10 x + a11 y + a12).
///
/// Shapes    as many from as to: 3 to 2^20
/// Range     as above
/// Rounding  as above
/// Errors    as above, with 3 in place of 4; degenerate where all places lie on a line
/// Source    book sec. 2.9.4; least squares of the distances in pixels
template <class Scalar = Real>
constexpr Result<Matrix<2, 3, Scalar>> fit_affine(Span<const PlanePoint> from, Span<const SubPixelPoint> to);
/// The same from pixels to pixels.
template <class Scalar = Real>
constexpr Result<Matrix<2, 3, Scalar>> fit_affine(Span<const SubPixelPoint> from,
                                                  Span<const SubPixelPoint> to);

/// Where a homography takes a place of a plane, or a pixel.
///
/// Errors  out_of_range at the horizon and beyond it
template <class Scalar>
constexpr Result<Vector<2, Scalar>> map_point(const Matrix<3, 3, Scalar>& homography,
                                              const Vector<2, Scalar>& place);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr std::int64_t most_from_mean = std::int64_t{1} << 26;

/// A place in its own units, of which there are 2^bits in what the caller counts in.
struct WholePlace {
    std::int64_t x = 0;
    std::int64_t y = 0;
};
constexpr WholePlace whole_place(PlanePoint point) { return {point.x, point.y}; }
constexpr WholePlace whole_place(SubPixelPoint point) { return {point.x.raw(), point.y.raw()}; }
constexpr int fraction_bits_of(PlanePoint) { return 0; }
constexpr int fraction_bits_of(SubPixelPoint) { return SubPixel::fraction_bits; }

/// The pairs that are used, and their means.
template <class From, class Use>
class CentredPairs {
public:
    constexpr CentredPairs(Span<const From> from, Span<const SubPixelPoint> to, Use use)
        : from_(from), to_(to), use_(use) {}

    /// Checks and finds the means.
    constexpr Status prepare(std::ptrdiff_t least) {
        if (from_.size() != to_.size()) return Status::size_mismatch;
        if (from_.size() > most_pairs) return Status::bad_argument;
        std::int64_t count = 0;
        WholePlace sum;
        WholePlace seen;
        for (std::ptrdiff_t i = 0; i < from_.size(); ++i) {
            if (!use_(i)) continue;
            ++count;
            sum.x += whole_place(from_[i]).x;
            sum.y += whole_place(from_[i]).y;
            seen.x += whole_place(to_[i]).x;
            seen.y += whole_place(to_[i]).y;
        }
        if (count < least) return Status::bad_argument;
        origin_ = {floor_divide(sum.x, count), floor_divide(sum.y, count)};
        centre_ = {floor_divide(seen.x, count), floor_divide(seen.y, count)};
        bool far = false;
        each([&](WholePlace a, WholePlace b) {
            for (const std::int64_t side : {a.x, a.y, b.x, b.y})
                if (side > most_from_mean || side < -most_from_mean) far = true;
            widest_ = {maximum(widest_.x, a.x < 0 ? -a.x : a.x), maximum(widest_.y, a.y < 0 ? -a.y : a.y)};
        });
        return far ? Status::out_of_range : Status::ok;
    }
    /// How far places are from their mean, along each axis.
    constexpr WholePlace widest() const { return widest_; }
    /// Calls visit with both places of each pair, from the means.
    template <class Visit>
    constexpr void each(Visit visit) const {
        for (std::ptrdiff_t i = 0; i < from_.size(); ++i) {
            if (!use_(i)) continue;
            const WholePlace a = whole_place(from_[i]);
            const WholePlace b = whole_place(to_[i]);
            visit(WholePlace{a.x - origin_.x, a.y - origin_.y}, WholePlace{b.x - centre_.x, b.y - centre_.y});
        }
    }
    /// A transform between places from the means, as one between places as they are.
    template <class Scalar, int Rows>
    constexpr Matrix<Rows, 3, Scalar> uncentred(Matrix<Rows, 3, Scalar> map) const {
        const int in = fraction_bits_of(From{});
        constexpr int out = SubPixel::fraction_bits;
        for (int r = 0; r < Rows; ++r)
            map(r, 2) = map(r, 2) - map(r, 0) * scalar_of<Scalar>(origin_.x) -
                        map(r, 1) * scalar_of<Scalar>(origin_.y);
        for (int c = 0; c < 3; ++c) {
            const Scalar weight = Rows == 3 ? map(Rows - 1, c) : scalar_of<Scalar>(c == 2 ? 1 : 0);
            const int bits = c == 2 ? 0 : in;
            map(0, c) = scale(map(0, c) + weight * scalar_of<Scalar>(centre_.x), bits - out);
            map(1, c) = scale(map(1, c) + weight * scalar_of<Scalar>(centre_.y), bits - out);
            if constexpr (Rows == 3) map(2, c) = scale(weight, bits);
        }
        return map;
    }

private:
    Span<const From> from_;
    Span<const SubPixelPoint> to_;
    Use use_;
    WholePlace origin_;
    WholePlace centre_;
    WholePlace widest_;
};

/// fit_homography() of the pairs for which use(index) holds.
template <class Scalar, class From, class Use>
constexpr Result<Matrix<3, 3, Scalar>> fit_homography_to(Span<const From> from, Span<const SubPixelPoint> to,
                                                         Use use) {
    CentredPairs<From, Use> pairs(from, to, use);
    Status status = pairs.prepare(4);
    if (status != Status::ok) return status;
    // Coefficients reach 2^52, so that 2^20 squares reach 2^125.
    ExactLeastSquares<8> equations;
    pairs.each([&](WholePlace a, WholePlace b) {
        equations.add({a.x, a.y, 1, 0, 0, 0, -b.x * a.x, -b.x * a.y}, b.x);
        equations.add({0, 0, 0, a.x, a.y, 1, -b.y * a.x, -b.y * a.y}, b.y);
    });
    Vector<8, Scalar> h;
    status = equations.solve(Span<Scalar>(&h[0], 8));
    if (status != Status::ok) return status;
    const Scalar zero = scalar_of<Scalar>(0);
    const Scalar one = scalar_of<Scalar>(1);
    // In front of the horizon for certain, or looked at one by one.
    const WholePlace widest = pairs.widest();
    bool in_front =
        absolute(h[6]) * scalar_of<Scalar>(widest.x) + absolute(h[7]) * scalar_of<Scalar>(widest.y) < one;
    if (!in_front) {
        in_front = true;
        pairs.each([&](WholePlace a, WholePlace) {
            const Scalar weight = one + h[6] * scalar_of<Scalar>(a.x) + h[7] * scalar_of<Scalar>(a.y);
            if (!(zero < weight)) in_front = false;
        });
    }
    if (!in_front) return Status::degenerate;
    const Matrix<3, 3, Scalar> map(h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], one);
    return pairs.uncentred(map);
}

template <class Scalar, class From, class Use>
constexpr Result<Matrix<2, 3, Scalar>> fit_affine_to(Span<const From> from, Span<const SubPixelPoint> to,
                                                     Use use) {
    CentredPairs<From, Use> pairs(from, to, use);
    Status status = pairs.prepare(3);
    if (status != Status::ok) return status;
    ExactLeastSquares<3> across;
    ExactLeastSquares<3> down;
    pairs.each([&](WholePlace a, WholePlace b) {
        across.add({a.x, a.y, 1}, b.x);
        down.add({a.x, a.y, 1}, b.y);
    });
    Vector<3, Scalar> x;
    Vector<3, Scalar> y;
    status = across.solve(Span<Scalar>(&x[0], 3));
    if (status == Status::ok) status = down.solve(Span<Scalar>(&y[0], 3));
    if (status != Status::ok) return status;
    return pairs.uncentred(Matrix<2, 3, Scalar>(x[0], x[1], x[2], y[0], y[1], y[2]));
}

/// Uses all pairs.
struct EachPair {
    constexpr bool operator()(std::ptrdiff_t) const { return true; }
};

}  // namespace detail

template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> fit_homography(Span<const PlanePoint> from,
                                                      Span<const SubPixelPoint> to) {
    return detail::fit_homography_to<Scalar>(from, to, detail::EachPair());
}
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> fit_homography(Span<const SubPixelPoint> from,
                                                      Span<const SubPixelPoint> to) {
    return detail::fit_homography_to<Scalar>(from, to, detail::EachPair());
}
template <class Scalar>
constexpr Result<Matrix<2, 3, Scalar>> fit_affine(Span<const PlanePoint> from, Span<const SubPixelPoint> to) {
    return detail::fit_affine_to<Scalar>(from, to, detail::EachPair());
}
template <class Scalar>
constexpr Result<Matrix<2, 3, Scalar>> fit_affine(Span<const SubPixelPoint> from,
                                                  Span<const SubPixelPoint> to) {
    return detail::fit_affine_to<Scalar>(from, to, detail::EachPair());
}

template <class Scalar>
constexpr Result<Vector<2, Scalar>> map_point(const Matrix<3, 3, Scalar>& homography,
                                              const Vector<2, Scalar>& place) {
    const Vector<3, Scalar> image = homography * Vector<3, Scalar>(place[0], place[1], scalar_of<Scalar>(1));
    if (!(scalar_of<Scalar>(0) < image[2])) return Status::out_of_range;
    return Vector<2, Scalar>(image[0] / image[2], image[1] / image[2]);
}

}  // namespace fovea
