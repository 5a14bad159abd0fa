// SPDX-License-Identifier: MIT
//
// Symmetric positive definite matrices: L L^T, and L D L^T without roots.
#pragma once

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// a = L L^T. Reads the lower triangle of a and puts L there; what is above it stays.
///
/// Errors  size_mismatch if a is not square; degenerate if it is not positive definite, which is that less
///         than 2^-56 of an element of the diagonal is left: then a is used up
template <class Scalar>
constexpr Status cholesky(MatrixView<Scalar> a);

/// a = L D L^T with 1 along the diagonal of L. Reads the upper triangle and the diagonal of a, which holds D
/// afterwards, with L below it; what is above it stays.
///
/// Errors  size_mismatch if a is not square; degenerate if it is not positive definite, which is that less
///         than 2^-56 of an element of the diagonal is left: then a is used up
template <class Scalar>
constexpr Status factor_ldlt(MatrixView<Scalar> a);

/// Solves a x = b with what factor_ldlt() made of a; x takes the place of b.
///
/// Errors  size_mismatch
template <class Scalar>
constexpr Status solve_with_ldlt(NonDeduced<MatrixView<const Scalar>> factors, Span<Scalar> b);

/// Solves a x = b for a symmetric positive definite a: both of the above.
///
/// Errors  size_mismatch; degenerate as factor_ldlt() is, with a used up and b untouched
template <class Scalar>
constexpr Status solve_ldlt(MatrixView<Scalar> a, Span<Scalar> b);

// ---- Implementation ---------------------------------------------------------------

template <class Scalar>
constexpr Status cholesky(MatrixView<Scalar> a) {
    const int n = a.rows();
    if (a.columns() != n) return Status::size_mismatch;
    const Scalar zero = scalar_of<Scalar>(0);
    for (int j = 0; j < n; ++j) {
        const Scalar least = scale(a(j, j), -56);
        Scalar square = a(j, j);
        for (int k = 0; k < j; ++k) square = square - a(j, k) * a(j, k);
        if (!(zero < square && least < square)) return Status::degenerate;
        a(j, j) = square_root(square);
        for (int i = j + 1; i < n; ++i) {
            Scalar sum = a(i, j);
            for (int k = 0; k < j; ++k) sum = sum - a(i, k) * a(j, k);
            a(i, j) = sum / a(j, j);
        }
    }
    return Status::ok;
}

template <class Scalar>
constexpr Status factor_ldlt(MatrixView<Scalar> a) {
    const int n = a.rows();
    if (a.columns() != n) return Status::size_mismatch;
    const Scalar zero = scalar_of<Scalar>(0);
    for (int j = 0; j < n; ++j) {
        for (int i = j; i < n; ++i) {
            const Scalar least = scale(a(j, i), -56);
            Scalar sum = a(j, i);
            for (int k = 0; k < j; ++k) sum = sum - a(i, k) * a(j, k) * a(k, k);
            if (i == j && !(zero < sum && least < sum)) return Status::degenerate;
            a(i, j) = i == j ? sum : sum / a(j, j);
        }
    }
    return Status::ok;
}

template <class Scalar>
constexpr Status solve_with_ldlt(NonDeduced<MatrixView<const Scalar>> factors, Span<Scalar> b) {
    const int n = factors.rows();
    if (factors.columns() != n || b.size() != n) return Status::size_mismatch;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < i; ++k) b[i] = b[i] - factors(i, k) * b[k];
    for (int i = 0; i < n; ++i) b[i] = b[i] / factors(i, i);
    for (int i = n - 1; i >= 0; --i)
        for (int k = i + 1; k < n; ++k) b[i] = b[i] - factors(k, i) * b[k];
    return Status::ok;
}

template <class Scalar>
constexpr Status solve_ldlt(MatrixView<Scalar> a, Span<Scalar> b) {
    if (b.size() != a.rows()) return Status::size_mismatch;
    const Status status = factor_ldlt(a);
    return status == Status::ok ? solve_with_ldlt<Scalar>(a, b) : status;
}

}  // namespace fovea
