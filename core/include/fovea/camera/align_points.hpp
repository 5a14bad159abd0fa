// SPDX-License-Identifier: MIT
//
// The motion between two sets of points in space: a scan and a drawing, two cameras' coordinates.
#pragma once

#include <cstddef>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/camera/pose.hpp>
#include <fovea/linear/eigen.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/linear/svd.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// x -> size * rotation * x + translation, and how well points meet.
template <class Scalar = Real>
struct Alignment {
    Pose<Scalar> pose;
    Scalar size = scalar_of<Scalar>(1);
    /// The root of the mean squared distance of points that should meet.
    Scalar rms = scalar_of<Scalar>(0);

    constexpr Vector<3, Scalar> operator()(const Vector<3, Scalar>& point) const {
        return size * (pose.rotation * point) + pose.translation;
    }
};

/// The rotation and translation that bring points nearest to others: the sum of squared distances is
/// smallest. It never mirrors.
///
/// Shapes    as many from as to: 3 to 2^20
/// Rounding  that of Scalar, from the means of the points
/// Errors    size_mismatch; bad_argument for fewer than 3 or more than 2^20; degenerate where either lie on a
///           line, thinner than 2^-16 of its length, or where several rotations are equally near
/// Source    nearest_rotation() of the sum of products; Kabsch 1976; Umeyama, "Least-Squares Estimation of
///           Transformation Parameters Between Two Point Patterns", PAMI 13(4), 1991
template <class Scalar = Real>
constexpr Result<Alignment<Scalar>> align_points(NonDeduced<Span<const Vector<3, Scalar>>> from,
                                                 NonDeduced<Span<const Vector<3, Scalar>>> to);

/// The same with a common size, for points whose unit is not known.
///
/// Errors  as above; degenerate also where the size would not be above 0
/// Source  Umeyama, eq. 42
template <class Scalar = Real>
constexpr Result<Alignment<Scalar>> align_points_with_size(NonDeduced<Span<const Vector<3, Scalar>>> from,
                                                           NonDeduced<Span<const Vector<3, Scalar>>> to);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Points about their mean.
template <class Scalar>
struct PointCloud {
    Span<const Vector<3, Scalar>> points;
    Vector<3, Scalar> mean;
    Scalar square = scalar_of<Scalar>(0);  ///< the sum of squared distances from the mean

    constexpr explicit PointCloud(Span<const Vector<3, Scalar>> all) : points(all) {
        // From the first point, so that a cloud far away keeps its digits.
        Vector<3, Scalar> sum;
        for (const Vector<3, Scalar>& point : points) sum += point - points[0];
        mean = points[0] + sum * (scalar_of<Scalar>(1) / scalar_of<Scalar>(points.size()));
        for (std::ptrdiff_t i = 0; i < points.size(); ++i) square = square + dot((*this)[i], (*this)[i]);
    }
    constexpr Vector<3, Scalar> operator[](std::ptrdiff_t index) const { return points[index] - mean; }
    /// Whether points span more than a line.
    constexpr bool flat_at_least() const {
        Matrix<3, 3, Scalar> products;
        Matrix<3, 3, Scalar> vectors;
        for (std::ptrdiff_t i = 0; i < points.size(); ++i) {
            const Vector<3, Scalar> arm = (*this)[i];
            products += arm * arm.transposed();
        }
        if (symmetric_eigen(products.view(), vectors.view()) != Status::ok) return false;
        return scale(products(0, 0), -32) < products(1, 1);
    }
};

template <class Scalar>
constexpr Result<Alignment<Scalar>> align(Span<const Vector<3, Scalar>> from,
                                          Span<const Vector<3, Scalar>> to, bool with_size) {
    if (from.size() != to.size()) return Status::size_mismatch;
    if (from.size() < 3 || from.size() > std::ptrdiff_t{1} << 20) return Status::bad_argument;
    const PointCloud<Scalar> start(from);
    const PointCloud<Scalar> end(to);
    if (!start.flat_at_least() || !end.flat_at_least()) return Status::degenerate;
    Matrix<3, 3, Scalar> products;
    for (std::ptrdiff_t i = 0; i < from.size(); ++i) products += end[i] * start[i].transposed();
    const auto rotation = nearest_rotation(products);
    if (!rotation) return rotation.status();

    Alignment<Scalar> alignment;
    alignment.pose.rotation = *rotation;
    if (with_size) {
        Scalar along = scalar_of<Scalar>(0);
        for (int r = 0; r < 3; ++r) along = along + dot(rotation->row(r), products.row(r));
        alignment.size = along / start.square;
        if (!(scalar_of<Scalar>(0) < alignment.size)) return Status::degenerate;
    }
    alignment.pose.translation = end.mean - alignment.size * (*rotation * start.mean);
    Scalar square = scalar_of<Scalar>(0);
    for (std::ptrdiff_t i = 0; i < from.size(); ++i) {
        const Vector<3, Scalar> off = alignment.size * (*rotation * start[i]) - end[i];
        square = square + dot(off, off);
    }
    alignment.rms = square_root(square / scalar_of<Scalar>(from.size()));
    return alignment;
}

}  // namespace detail

template <class Scalar>
constexpr Result<Alignment<Scalar>> align_points(NonDeduced<Span<const Vector<3, Scalar>>> from,
                                                 NonDeduced<Span<const Vector<3, Scalar>>> to) {
    return detail::align<Scalar>(from, to, false);
}
template <class Scalar>
constexpr Result<Alignment<Scalar>> align_points_with_size(NonDeduced<Span<const Vector<3, Scalar>>> from,
                                                           NonDeduced<Span<const Vector<3, Scalar>>> to) {
    return detail::align<Scalar>(from, to, true);
}

}  // namespace fovea
