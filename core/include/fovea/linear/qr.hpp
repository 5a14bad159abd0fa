// SPDX-License-Identifier: MIT
//
// Least squares by reflections: the way that keeps the most digits where equations are many and rounded.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The x for which |a x - b| is smallest: it takes the place of the first elements of b, and behind them are
/// what is left of b, whose length is that smallest value. a is used up: R is in its upper triangle.
///
/// Shapes  a has at least as many rows as columns, b as many elements as a has rows
/// Errors  size_mismatch; degenerate where a column is a combination of those before it: less than 2^-48 of
///         its length is left, or more by what rows beyond 32767 are. Then a and b are as far as it came
/// Source  Householder reflections; Golub and Van Loan, "Matrix Computations", section 5.3.2
template <class Scalar>
constexpr Status solve_least_squares(MatrixView<Scalar> a, Span<Scalar> b);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

template <class Scalar>
constexpr Scalar square_of_column(MatrixView<Scalar> a, int column, int from) {
    Scalar sum = scalar_of<Scalar>(0);
    for (int r = from; r < a.rows(); ++r) sum = sum + a(r, column) * a(r, column);
    return sum;
}

}  // namespace detail

template <class Scalar>
constexpr Status solve_least_squares(MatrixView<Scalar> a, Span<Scalar> b) {
    const int m = a.rows();
    const int n = a.columns();
    if (m < n || b.size() != m) return Status::size_mismatch;
    const Scalar zero = scalar_of<Scalar>(0);
    // Sums over very many rows lose more digits.
    const int lost_bits = maximum(32 - leading_zeros(static_cast<std::uint32_t>(m)) - 15, 0);
    for (int j = 0; j < n; ++j) {
        // What stands above is part of the column's length, which reflections do not change.
        const Scalar square = detail::square_of_column(a, j, j);
        Scalar whole = square;
        for (int r = 0; r < j; ++r) whole = whole + a(r, j) * a(r, j);
        if (!(scale(whole, 2 * lost_bits - 96) < square)) return Status::degenerate;

        const Scalar length = square_root(square);
        const Scalar head = a(j, j);
        const Scalar pivot = zero < head ? head + length : head - length;
        // 2 / (v v) for the reflection's v, which is the column with the pivot at its head.
        const Scalar factor = scalar_of<Scalar>(1) / (length * absolute(pivot));
        a(j, j) = pivot;
        for (int c = j + 1; c <= n; ++c) {
            const auto element = [&](int r) -> Scalar& { return c < n ? a(r, c) : b[r]; };
            Scalar sum = zero;
            for (int r = j; r < m; ++r) sum = sum + a(r, j) * element(r);
            sum = sum * factor;
            for (int r = j; r < m; ++r) element(r) = element(r) - sum * a(r, j);
        }
        a(j, j) = zero < head ? -length : length;
    }
    for (int r = n - 1; r >= 0; --r) {
        for (int k = r + 1; k < n; ++k) b[r] = b[r] - a(r, k) * b[k];
        b[r] = b[r] / a(r, r);
    }
    return Status::ok;
}

}  // namespace fovea
