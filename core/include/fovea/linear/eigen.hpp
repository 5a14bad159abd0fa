// SPDX-License-Identifier: MIT
//
// Eigenvalues and eigenvectors of symmetric matrices.
#pragma once

#include <fovea/base/status.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// a = V D V^T for a symmetric a: afterwards the diagonal of a holds the eigenvalues, the largest first, and
/// the columns of vectors their eigenvectors, of length 1 and square to each other. What a column's sign is,
/// is left to the calculation, which is the same everywhere.
///
/// Shapes  both square, of one size
/// Time    at most 16 sweeps over all pairs
/// Overlap none
/// Errors  size_mismatch; degenerate if 16 sweeps were too few; no matrix of the tests needs more than 8
/// Source  cyclic Jacobi rotations; Golub and Van Loan, "Matrix Computations", section 8.5
template <class Scalar>
constexpr Status symmetric_eigen(MatrixView<Scalar> a, MatrixView<Scalar> vectors);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr int most_sweeps = 16;

/// Cosine and sine of the rotation that makes two columns square to each other, whose squares are p and q and
/// whose product is half of twice; and the tangent.
template <class Scalar>
struct JacobiRotation {
    Scalar cosine, sine, tangent;

    constexpr JacobiRotation(Scalar p, Scalar q, Scalar twice) {
        const Scalar difference = q - p;
        const Scalar length = square_root(difference * difference + twice * twice);
        const Scalar one = scalar_of<Scalar>(1);
        tangent = twice / (difference < scalar_of<Scalar>(0) ? difference - length : difference + length);
        cosine = one / square_root(one + tangent * tangent);
        sine = tangent * cosine;
    }
    /// Turns columns p and q.
    constexpr void turn(MatrixView<Scalar> a, int p, int q) const {
        for (int r = 0; r < a.rows(); ++r) {
            const Scalar x = a(r, p);
            const Scalar y = a(r, q);
            a(r, p) = cosine * x - sine * y;
            a(r, q) = sine * x + cosine * y;
        }
    }
};

template <class Scalar>
constexpr void set_identity(MatrixView<Scalar> a) {
    for (int r = 0; r < a.rows(); ++r)
        for (int c = 0; c < a.columns(); ++c) a(r, c) = scalar_of<Scalar>(r == c ? 1 : 0);
}
template <class Scalar>
constexpr void swap_columns(MatrixView<Scalar> a, int first, int second) {
    for (int r = 0; r < a.rows(); ++r) {
        const Scalar kept = a(r, first);
        a(r, first) = a(r, second);
        a(r, second) = kept;
    }
}

/// Sorts n values, the largest first: value(i) is the one at i, exchange(i, k) swaps what belongs to two.
template <class Value, class Exchange>
constexpr void sort_largest_first(int n, Value value, Exchange exchange) {
    for (int i = 0; i < n; ++i) {
        int largest = i;
        for (int k = i + 1; k < n; ++k)
            if (value(largest) < value(k)) largest = k;
        if (largest != i) exchange(i, largest);
    }
}

}  // namespace detail

template <class Scalar>
constexpr Status symmetric_eigen(MatrixView<Scalar> a, MatrixView<Scalar> vectors) {
    const int n = a.rows();
    if (a.columns() != n || vectors.rows() != n || vectors.columns() != n) return Status::size_mismatch;
    const Scalar zero = scalar_of<Scalar>(0);
    detail::set_identity(vectors);
    bool turned = true;
    for (int sweep = 0; turned; ++sweep) {
        if (sweep == detail::most_sweeps) return Status::degenerate;
        turned = false;
        for (int p = 0; p < n; ++p)
            for (int q = p + 1; q < n; ++q) {
                const Scalar size = absolute(a(p, p)) + absolute(a(q, q));
                // What changes no digit of its neighbours on the diagonal is 0.
                const bool counts = size < size + scale(absolute(a(p, q)), 2);
                if (!counts) {
                    a(p, q) = a(q, p) = zero;
                    continue;
                }
                turned = true;
                const Scalar twice = scale(a(p, q), 1);
                const detail::JacobiRotation<Scalar> rotation(a(p, p), a(q, q), twice);
                const Scalar step = rotation.tangent * a(p, q);
                a(p, p) = a(p, p) - step;
                a(q, q) = a(q, q) + step;
                a(p, q) = a(q, p) = zero;
                // (1 - cosine) / sine, so that small turns keep their digits.
                const Scalar tau = rotation.sine / (scalar_of<Scalar>(1) + rotation.cosine);
                const auto turn = [&](Scalar& x, Scalar& y) {
                    const Scalar old = x;
                    x = old - rotation.sine * (y + tau * old);
                    y = y + rotation.sine * (old - tau * y);
                };
                for (int i = 0; i < n; ++i) {
                    turn(vectors(i, p), vectors(i, q));
                    if (i == p || i == q) continue;
                    turn(a(i, p), a(i, q));
                    a(p, i) = a(i, p);
                    a(q, i) = a(i, q);
                }
            }
    }
    detail::sort_largest_first(
        n, [&](int i) -> const Scalar& { return a(i, i); },
        [&](int i, int k) {
            const Scalar kept = a(i, i);
            a(i, i) = a(k, k);
            a(k, k) = kept;
            detail::swap_columns(vectors, i, k);
        });
    return Status::ok;
}

}  // namespace fovea
