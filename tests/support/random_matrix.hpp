// SPDX-License-Identifier: MIT
//
// Random matrices of Real, and the same in double.
#pragma once

#include <cstddef>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/linear/matrix.hpp>
#include <support/eigen_oracle.hpp>
#include <support/scalars.hpp>

namespace fovea::test {

/// -1 to 1 in 2^-30: exact in both.
inline Real random_part(Random& random) { return Real::from_int(random.between(-(1 << 30), 1 << 30), -30); }

template <int Rows, int Columns>
Matrix<Rows, Columns> random_matrix(Random& random) {
    Matrix<Rows, Columns> result;
    for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c) result(r, c) = random_part(random);
    return result;
}

template <int Rows, int Columns>
PlainMatrix plain(const Matrix<Rows, Columns>& a) {
    PlainMatrix result{Rows, Columns, {}};
    for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c) result.values.push_back(static_cast<double>(value_of(a(r, c))));
    return result;
}

/// The largest difference of two elements, as a power of two: below 2^(what is answered).
template <int Rows, int Columns>
int exponent_of_difference(const Matrix<Rows, Columns>& a, const Matrix<Rows, Columns>& b) {
    int most = -200;
    for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c) {
            const Real difference = a(r, c) - b(r, c);
            if (!difference.zero() && difference.exponent() + 1 > most) most = difference.exponent() + 1;
        }
    return most;
}

template <int Count>
Matrix<Count, Count> diagonal(Span<const Real> values) {
    Matrix<Count, Count> result;
    for (int i = 0; i < Count; ++i) result(i, i) = values[i];
    return result;
}

}  // namespace fovea::test
