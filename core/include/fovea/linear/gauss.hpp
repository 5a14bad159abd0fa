// SPDX-License-Identifier: MIT
//
// Linear equations by elimination. Book appendix B, "Gauss".
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Solves a x = b for every column of b; x takes the place of b, and a is used up.
///
/// Shapes  a square, b with as many rows
/// Overlap none
/// Errors  size_mismatch; degenerate where a pivot, the largest that is left in its column, is 0: then a and
///         b are as far as the elimination came. A matrix without an inverse whose pivots are rounded, and so
///         only nearly 0, is not noticed: solve_least_squares() notices it
/// Source  Gauss with pivots by rows; the inverse is the solution for the identity
template <class Scalar>
constexpr Status solve_gauss(MatrixView<Scalar> a, MatrixView<Scalar> b);

/// The solution of a x = b.
///
/// Errors  degenerate where a has no inverse
template <int Count, class Scalar>
constexpr Result<Vector<Count, Scalar>> solve_gauss(Matrix<Count, Count, Scalar> a, Vector<Count, Scalar> b);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

template <class Scalar>
constexpr void swap_rows(MatrixView<Scalar> a, int first, int second) {
    for (int c = 0; c < a.columns(); ++c) {
        const Scalar kept = a(first, c);
        a(first, c) = a(second, c);
        a(second, c) = kept;
    }
}

}  // namespace detail

template <class Scalar>
constexpr Status solve_gauss(MatrixView<Scalar> a, MatrixView<Scalar> b) {
    const int n = a.rows();
    if (a.columns() != n || b.rows() != n) return Status::size_mismatch;
    const Scalar zero = scalar_of<Scalar>(0);
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int r = k + 1; r < n; ++r)
            if (absolute(a(pivot, k)) < absolute(a(r, k))) pivot = r;
        if (a(pivot, k) == zero) return Status::degenerate;
        if (pivot != k) {
            detail::swap_rows(a, k, pivot);
            detail::swap_rows(b, k, pivot);
        }
        for (int r = k + 1; r < n; ++r) {
            if (a(r, k) == zero) continue;
            const Scalar factor = a(r, k) / a(k, k);
            for (int c = k + 1; c < n; ++c) a(r, c) = a(r, c) - factor * a(k, c);
            for (int c = 0; c < b.columns(); ++c) b(r, c) = b(r, c) - factor * b(k, c);
        }
    }
    for (int c = 0; c < b.columns(); ++c)
        for (int r = n - 1; r >= 0; --r) {
            Scalar sum = b(r, c);
            for (int k = r + 1; k < n; ++k) sum = sum - a(r, k) * b(k, c);
            b(r, c) = sum / a(r, r);
        }
    return Status::ok;
}

template <int Count, class Scalar>
constexpr Result<Vector<Count, Scalar>> solve_gauss(Matrix<Count, Count, Scalar> a, Vector<Count, Scalar> b) {
    const Status status = solve_gauss(a.view(), b.view());
    if (status != Status::ok) return status;
    return b;
}

}  // namespace fovea
