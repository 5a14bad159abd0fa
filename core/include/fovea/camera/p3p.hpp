// SPDX-License-Identifier: MIT
//
// The poses in which a camera sees three known points as it does.
#pragma once

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/linear/cubic.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/match/point_pair.hpp>
#include <fovea/match/point_spread.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Up to four poses.
template <class Scalar = Real>
struct PoseCandidates {
    Pose<Scalar> poses[4];
    int count = 0;
};

/// All poses in which three points lie on their rays, in front of the camera.
///
/// Shapes    three points, three rays
/// Units     rays are directions in camera coordinates, of any length, as LensInverse::ray() gives them
/// Rounding  points are on their rays to the last digits where solutions lie apart. Two that meet, which they
///           do where the camera is on the cylinder through the points that stands on their plane, are known
///           to half of the digits; where rounded rays make them miss each other by less than 2^-20, the one
///           place between them is told, which is off its rays by about as much
/// Errors    bad_argument for other than three, or a ray of length 0; degenerate for points on a line or two
///           rays in one direction; not_found if no pose is
/// Source    two cones in the three distances, whose pencil has a pair of planes; as in Persson and Nordberg,
///           "Lambda Twist: An Accurate Fast Robust Perspective Three Point (P3P) Solver", ECCV 2018. Here
///           the unknowns are one distance and the differences to it, so that long focal lengths lose no
///           digits; the pair is taken apart by its adjugate in place of eigenvectors
template <class Scalar = Real>
constexpr Result<PoseCandidates<Scalar>> p3p(Span<const SpacePoint> points,
                                             NonDeduced<Span<const Vector<3, Scalar>>> rays);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

template <class Scalar>
using Conic = Matrix<3, 3, Scalar>;

template <class Scalar>
constexpr Scalar trace_of_product(const Conic<Scalar>& a, const Conic<Scalar>& b) {
    Scalar sum = scalar_of<Scalar>(0);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) sum = sum + a(r, c) * b(c, r);
    return sum;
}

/// Of a symmetric matrix.
template <class Scalar>
constexpr Conic<Scalar> adjugate(const Conic<Scalar>& a) {
    Conic<Scalar> result;
    for (int r = 0; r < 3; ++r) {
        const Vector<3, Scalar> cofactors = cross(a.row((r + 1) % 3), a.row((r + 2) % 3));
        for (int c = 0; c < 3; ++c) result(r, c) = cofactors[c];
    }
    return result;
}

/// What two conics have in common.
template <class Scalar>
class ConicMeeting {
public:
    constexpr ConicMeeting(const Conic<Scalar>& first, const Conic<Scalar>& second) {
        // det(first + x second), or the other way round where that has the larger leading coefficient.
        const Conic<Scalar> of_first = adjugate(first);
        const Conic<Scalar> of_second = adjugate(second);
        Scalar c[4] = {dot(first.row(0), of_first.row(0)), trace_of_product(of_first, second),
                       trace_of_product(first, of_second), dot(second.row(0), of_second.row(0))};
        const bool swap = absolute(c[3]) < absolute(c[0]);
        const Conic<Scalar>& a = swap ? second : first;
        const Conic<Scalar>& b = swap ? first : second;
        const Scalar zero = scalar_of<Scalar>(0);
        const Scalar one = scalar_of<Scalar>(1);
        const Scalar lead = c[swap ? 0 : 3];
        // With both ends 0, the first is a pair of lines already.
        const Scalar x = lead == zero ? zero
                                      : cubic_root_alone(c[swap ? 1 : 2] / lead, c[swap ? 2 : 1] / lead,
                                                         c[swap ? 3 : 0] / lead);
        const bool large = one < absolute(x);
        conic_ = large ? a : b;
        pair_ = large ? a * (one / x) + b : a + x * b;
    }

    /// Calls visit with each common point, as three homogeneous coordinates.
    template <class Visit>
    constexpr void each(Visit visit) const {
        const Scalar zero = scalar_of<Scalar>(0);
        // The pair is l m^T + m l^T, its adjugate -(l x m)(l x m)^T.
        const Conic<Scalar> back = adjugate(pair_);
        int pivot = 0;
        Scalar size = zero;
        for (int i = 0; i < 3; ++i) {
            if (absolute(back(pivot, pivot)) < absolute(back(i, i))) pivot = i;
            for (int k = 0; k < 3; ++k) size = size + pair_(i, k) * pair_(i, k);
        }
        Vector<3, Scalar> between;
        if (back(pivot, pivot) < zero) {
            const Scalar root = square_root(back(pivot, pivot));
            for (int i = 0; i < 3; ++i) between[i] = back(i, pivot) / root;
        } else if (scale(size, -24) < back(pivot, pivot)) {
            return;
        }
        // 2 l m^T: any of its rows and columns will do, the largest do best.
        const Conic<Scalar> product = pair_ + cross_matrix(between);
        int row = 0;
        int column = 0;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                if (absolute(product(row, column)) < absolute(product(r, c))) {
                    row = r;
                    column = c;
                }
        if (product(row, column) == zero) return;
        along(product.row(row), visit);
        along(product.column(column), visit);
    }

private:
    template <class Visit>
    constexpr void along(const Vector<3, Scalar>& line, Visit visit) const {
        const Scalar zero = scalar_of<Scalar>(0);
        int pivot = 0;
        for (int i = 1; i < 3; ++i)
            if (absolute(line[pivot]) < absolute(line[i])) pivot = i;
        const int i = (pivot + 1) % 3;
        const int k = (pivot + 2) % 3;
        Vector<3, Scalar> u;
        Vector<3, Scalar> v;
        u[i] = v[k] = scalar_of<Scalar>(1);
        u[pivot] = -(line[i] / line[pivot]);
        v[pivot] = -(line[k] / line[pivot]);
        // a x^2 + 2 b x y + c y^2 = 0 for x u + y v.
        const Scalar a = dot(u, conic_ * u);
        const Scalar b = dot(u, conic_ * v);
        const Scalar c = dot(v, conic_ * v);
        const Scalar square = b * b;
        const Scalar product = a * c;
        const Scalar discriminant = square - product;
        const bool touches = discriminant < scale(square + absolute(product), -56);
        if (touches && discriminant < -scale(square + absolute(product), -20)) return;
        const Scalar root = touches ? zero : square_root(discriminant);
        const Scalar sum = b < zero ? root - b : -(root + b);
        if (a == zero && sum == zero && c == zero) return;
        if (touches && absolute(a) < absolute(c)) {
            visit(c * u + sum * v);
            return;
        }
        visit(sum * u + a * v);
        if (!touches) visit(c * u + sum * v);
    }

    Conic<Scalar> conic_;
    Conic<Scalar> pair_;
};

/// The three equations of P3P in one distance, that to the first point, and the differences of the others to
/// it. Distances are in the unit of spread, so that all of the matrices are about 1.
template <class Scalar>
class P3pEquations {
public:
    /// Directions have length 1.
    constexpr P3pEquations(const Vector<3, Scalar> (&points)[3], const Vector<3, Scalar> (&directions)[3]) {
        const Scalar zero = scalar_of<Scalar>(0);
        const Scalar one = scalar_of<Scalar>(1);
        // Of the pairs 1 2, 1 3, 2 3: squares of the sides, and 2 - 2 cos of the angles.
        constexpr int ends[3][2] = {{0, 1}, {0, 2}, {1, 2}};
        Scalar bends[3] = {};
        Scalar most = zero;
        for (int i = 0; i < 3; ++i) {
            const Vector<3, Scalar> side = points[ends[i][1]] - points[ends[i][0]];
            const Vector<3, Scalar> turn = directions[ends[i][1]] - directions[ends[i][0]];
            squares_[i] = dot(side, side);
            bends[i] = dot(turn, turn);
            if (most < bends[i]) most = bends[i];
        }
        unit_ = square_root(most);
        for (int i = 0; i < 3; ++i) {
            const Scalar bend = bends[i] / most;
            const Scalar mixed = scale(unit_ * bend, -1);
            Conic<Scalar>& form = forms_[i];
            form(0, 0) = bend;
            for (int k = 1; k < 3; ++k)
                if (i == 2 || i == k - 1) {
                    form(k, k) = one;
                    form(0, k) = form(k, 0) = mixed;
                }
            if (i == 2) form(1, 2) = form(2, 1) = scale(bends[i], -1) - one;
        }
    }

    /// Calls visit with the distances of a solution: that to the first, and the differences.
    template <class Visit>
    constexpr void each(Visit visit) const {
        const Scalar zero = scalar_of<Scalar>(0);
        const ConicMeeting<Scalar> meeting(forms_[0] - forms_[2] * (squares_[0] / squares_[2]),
                                           forms_[1] - forms_[2] * (squares_[1] / squares_[2]));
        meeting.each([&](Vector<3, Scalar> place) {
            const Scalar square = dot(place, forms_[2] * place);
            if (!(zero < square)) return;
            const Scalar length = square_root(squares_[2] / square);
            place = place * (place[0] < zero ? -length : length);
            // A pair of planes that is only nearly real leads to places that are none.
            if (scale(squares_[2], -16) < error_of(place)) return;
            place[0] = place[0] / unit_;
            if (zero < place[0] && zero < place[0] + place[1] && zero < place[0] + place[2]) visit(place);
        });
    }

private:
    constexpr Scalar error_of(const Vector<3, Scalar>& place) const {
        Scalar sum = scalar_of<Scalar>(0);
        for (int i = 0; i < 3; ++i) sum = sum + absolute(dot(place, forms_[i] * place) - squares_[i]);
        return sum;
    }

    Conic<Scalar> forms_[3];
    Scalar squares_[3] = {};
    Scalar unit_ = scalar_of<Scalar>(0);
};

/// Axes along the first side of a triangle, in its plane, and square to it.
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> axes_of(const Vector<3, Scalar>& side,
                                               const Vector<3, Scalar>& other) {
    const auto x = normalized(side);
    const auto z = normalized(cross(side, other));
    if (!x || !z) return Status::degenerate;
    const Vector<3, Scalar> y = cross(*z, *x);
    return Matrix<3, 3, Scalar>((*x)[0], y[0], (*z)[0], (*x)[1], y[1], (*z)[1], (*x)[2], y[2], (*z)[2]);
}

}  // namespace detail

template <class Scalar>
constexpr Result<PoseCandidates<Scalar>> p3p(Span<const SpacePoint> points,
                                             NonDeduced<Span<const Vector<3, Scalar>>> rays) {
    const Scalar zero = scalar_of<Scalar>(0);
    if (points.size() != 3 || rays.size() != 3) return Status::bad_argument;
    const Result<PointSpread> spread = spread_of<Scalar>(points);
    if (!spread) return spread.status();
    if (*spread != PointSpread::plane) return Status::degenerate;
    // The longest side is that between the second and the third.
    int first = 0;
    Scalar longest = zero;
    for (int i = 0; i < 3; ++i) {
        const Scalar length =
            length_of(vector_of<Scalar>(points[(i + 1) % 3]) - vector_of<Scalar>(points[(i + 2) % 3]));
        if (!(longest < length)) continue;
        longest = length;
        first = i;
    }
    Vector<3, Scalar> corners[3];
    Vector<3, Scalar> directions[3];
    for (int i = 0; i < 3; ++i) {
        const auto direction = normalized(rays[(first + i) % 3]);
        if (!direction) return Status::bad_argument;
        directions[i] = *direction;
        corners[i] = vector_of<Scalar>(points[(first + i) % 3]);
    }
    for (int i = 0; i < 3; ++i)
        if (!(scalar_of<Scalar>(1, -40) < length_of(directions[i] - directions[(i + 1) % 3])))
            return Status::degenerate;
    const auto axes = detail::axes_of(corners[1] - corners[0], corners[2] - corners[0]);
    if (!axes) return axes.status();

    PoseCandidates<Scalar> found;
    const detail::P3pEquations<Scalar> equations(corners, directions);
    equations.each([&](const Vector<3, Scalar>& distances) {
        const auto side = [&](int i) {
            return distances[0] * (directions[i] - directions[0]) + distances[i] * directions[i];
        };
        const auto seen = detail::axes_of(side(1), side(2));
        if (!seen || found.count == 4) return;
        Pose<Scalar>& pose = found.poses[found.count];
        pose.rotation = *seen * axes->transposed();
        pose.translation = distances[0] * directions[0] - pose.rotation * corners[0];
        ++found.count;
    });
    if (found.count == 0) return Status::not_found;
    return found;
}

}  // namespace fovea
