// SPDX-License-Identifier: MIT
//
// Singular values: how a matrix stretches, and the rotation that is nearest to it.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linear/eigen.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// a = U diag(values) V^T: U takes the place of a, with columns of length 1, square to each other, and 0
/// where the value is 0; the largest value comes first. Values below 2^-58 of the length of all elements are
/// 0.
///
/// Shapes  a has at least as many rows as columns; v is square, with as many columns; values has as many
///         elements
/// Time    at most 16 sweeps over all pairs
/// Overlap none
/// Errors  size_mismatch; degenerate if 16 sweeps were too few; no matrix of the tests needs more than 8
/// Source  one-sided Jacobi rotations; Golub and Van Loan, "Matrix Computations", section 8.6.3
template <class Scalar>
constexpr Status svd(MatrixView<Scalar> a, MatrixView<Scalar> v, Span<Scalar> values);

/// The rotation that is nearest to a matrix: the sum of squares of the differences is smallest.
///
/// Errors  degenerate where no rotation is nearest: two singular values are less than 2^-56 of the first, or
///         the matrix mirrors and its last two values are as near to each other
/// Source  U V^T, with the last column of U turned where its determinant is -1; Kabsch, "A solution for the
///         best rotation to relate two sets of vectors", Acta Cryst. A32, 1976
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> nearest_rotation(Matrix<3, 3, Scalar> a);

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr Status svd(MatrixView<Scalar> a, MatrixView<Scalar> v, Span<Scalar> values) {
    const int n = a.columns();
    if (a.rows() < n || v.rows() != n || v.columns() != n || values.size() != n) return Status::size_mismatch;
    const Scalar zero = scalar_of<Scalar>(0);
    detail::set_identity(v);
    // Columns shorter than 2^-58 of all of them are what was rounded: noise has no direction that holds
    // still.
    Scalar whole = zero;
    for (int r = 0; r < a.rows(); ++r)
        for (int c = 0; c < n; ++c) whole = whole + a(r, c) * a(r, c);
    const Scalar least = scale(whole, -116);
    // What the sums over the rows may have lost.
    const int lost_bits = 34 - leading_zeros(static_cast<std::uint32_t>(a.rows()));
    bool turned = true;
    for (int sweep = 0; turned; ++sweep) {
        if (sweep == detail::most_sweeps) return Status::degenerate;
        turned = false;
        for (int p = 0; p < n; ++p)
            for (int q = p + 1; q < n; ++q) {
                Scalar pp = zero;
                Scalar qq = zero;
                Scalar pq = zero;
                for (int r = 0; r < a.rows(); ++r) {
                    pp = pp + a(r, p) * a(r, p);
                    qq = qq + a(r, q) * a(r, q);
                    pq = pq + a(r, p) * a(r, q);
                }
                if (!(least < pp) || !(least < qq)) continue;
                const Scalar size = square_root(pp) * square_root(qq);
                // Square to each other but for the last digits of the sums.
                if (!(size < size + scale(absolute(pq), -lost_bits))) continue;
                turned = true;
                const detail::JacobiRotation<Scalar> rotation(pp, qq, scale(pq, 1));
                rotation.turn(a, p, q);
                rotation.turn(v, p, q);
            }
    }
    for (int c = 0; c < n; ++c) {
        Scalar square = zero;
        for (int r = 0; r < a.rows(); ++r) square = square + a(r, c) * a(r, c);
        values[c] = least < square ? square_root(square) : zero;
        for (int r = 0; r < a.rows(); ++r) a(r, c) = values[c] == zero ? zero : a(r, c) / values[c];
    }
    detail::sort_largest_first(
        n, [&](int i) -> const Scalar& { return values[i]; },
        [&](int i, int k) {
            const Scalar kept = values[i];
            values[i] = values[k];
            values[k] = kept;
            detail::swap_columns(a, i, k);
            detail::swap_columns(v, i, k);
        });
    return Status::ok;
}

template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> nearest_rotation(Matrix<3, 3, Scalar> a) {
    const Scalar zero = scalar_of<Scalar>(0);
    Matrix<3, 3, Scalar> v;
    Scalar values[3] = {};
    const Status status = svd(a.view(), v.view(), Span<Scalar>(values));
    if (status != Status::ok) return status;
    if (!(scale(values[0], -56) < values[1])) return Status::degenerate;
    // The third of U is fixed by the first two, and with it the handedness.
    const Vector<3, Scalar> third = cross(a.column(0), a.column(1));
    const bool mirrored = determinant(v) < zero;
    const Vector<3, Scalar> wanted = mirrored ? -third : third;
    if (dot(a.column(2), wanted) < zero && !(scale(values[0], -56) < values[1] - values[2]))
        return Status::degenerate;
    for (int r = 0; r < 3; ++r) a(r, 2) = wanted[r];
    return a * v.transposed();
}

}  // namespace fovea
