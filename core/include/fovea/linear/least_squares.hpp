// SPDX-License-Identifier: MIT
//
// Least squares over whole numbers: sums that are exact, so that nothing is rounded before the equations are
// solved, and the order in which they were added is without effect.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linear/cholesky.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Equations r x = s of whole numbers, of which there may be more than unknowns. Columns may differ in size
/// by any powers of two: the solution has as many digits for each.
///
/// Range     products of two coefficients, summed over all equations, stay below 2^127: the user states why
/// Rounding  none but that of the solution, for which the sums are cut after 64 digits once. What normal
///           equations lose is lost there: columns that are alike to 2^-k leave 2k digits fewer, so take the
///           mean off coordinates before
/// Source    normal equations
template <int Count>
class ExactLeastSquares {
public:
    using Coefficients = std::int64_t[static_cast<std::size_t>(Count)];

    /// Adds an equation; coefficients that are 0 take no time.
    constexpr void add(const Coefficients& coefficients, std::int64_t right);
    constexpr void clear() { *this = {}; }

    /// The solution of least squares.
    ///
    /// Errors  size_mismatch; degenerate where less than 2^-32 of a column is left besides the others, in
    ///         squares: the equations leave an unknown open, or would give it with fewer than 30 digits. Then
    ///         x is untouched
    template <class Scalar>
    constexpr Status solve(Span<Scalar> x) const;

private:
    // The upper triangle, row by row.
    static constexpr int at(int row, int column) { return row * Count - row * (row - 1) / 2 + column - row; }

    Int128 products_[static_cast<std::size_t>(Count * (Count + 1) / 2)];
    Int128 right_[static_cast<std::size_t>(Count)];
};

// ---- Implementation ---------------------------------------------------------------

template <int Count>
constexpr void ExactLeastSquares<Count>::add(const Coefficients& coefficients, std::int64_t right) {
    for (int i = 0; i < Count; ++i) {
        const std::int64_t a = coefficients[i];
        if (a == 0) continue;
        for (int k = i; k < Count; ++k)
            if (coefficients[k] != 0) products_[at(i, k)] += Int128::product(a, coefficients[k]);
        right_[i] += Int128::product(a, right);
    }
}

template <int Count>
template <class Scalar>
constexpr Status ExactLeastSquares<Count>::solve(Span<Scalar> x) const {
    if (x.size() != Count) return Status::size_mismatch;
    Matrix<Count, Count, Scalar> a;
    Vector<Count, Scalar> b;
    for (int i = 0; i < Count; ++i) {
        for (int k = i; k < Count; ++k) a(i, k) = ScalarTraits<Scalar>::from_int(products_[at(i, k)], 0);
        b[i] = ScalarTraits<Scalar>::from_int(right_[i], 0);
    }
    const Matrix<Count, Count, Scalar> sums = a;
    const Status status = factor_ldlt(a.view());
    if (status != Status::ok) return status;
    for (int i = 0; i < Count; ++i)
        if (!(scale(sums(i, i), -32) < a(i, i))) return Status::degenerate;
    for (int i = 0; i < Count; ++i) x[i] = b[i];
    return solve_with_ldlt(a.view(), x);
}

}  // namespace fovea
