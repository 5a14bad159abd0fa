// SPDX-License-Identifier: MIT
//
// Golden vectors of number/ beyond the integers, and of linear/.
#pragma once

#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/linear/cholesky.hpp>
#include <fovea/linear/eigen.hpp>
#include <fovea/linear/gauss.hpp>
#include <fovea/linear/least_squares.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/linear/qr.hpp>
#include <fovea/linear/svd.hpp>
#include <fovea/number/logarithm.hpp>
#include <fovea/number/real.hpp>
#include <fovea/number/real_text.hpp>
#include <fovea/number/scalar.hpp>
#include <fovea/number/wide.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, Wide number) { digest.add(number.high, number.low); }
template <int Rows, int Columns>
void put(Digest& digest, const Matrix<Rows, Columns>& a) {
    for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c) digest.add(a(r, c));
}

/// 64 bits of which every second time half are alike.
inline std::uint64_t random_digits(Random& random) {
    const std::uint64_t high = random.next();
    const std::uint64_t bits = high << 32 | random.next();
    const int shift = random.between(0, 63);
    return random.below(2) == 0 ? bits : ~(bits >> shift);
}
inline Real random_real(Random& random, int spread) {
    const auto digits = static_cast<std::int64_t>(random_digits(random));
    return Real::from_int(digits, random.between(-spread, spread) - 63);
}
template <int Rows, int Columns>
Matrix<Rows, Columns> random_matrix(Random& random) {
    Matrix<Rows, Columns> result;
    for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c) result(r, c) = random_real(random, 1);
    return result;
}

inline void number_wide(Workspace&, Digest& digest) {
    constexpr std::uint64_t top = std::uint64_t{1} << 63;
    Random random(61);
    for (int i = 0; i < 300; ++i) {
        const std::uint64_t a = random_digits(random);
        const std::uint64_t b = random_digits(random);
        digest.add(multiply_words(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)));
        digest.add(multiply_wide(a, b), divide_wide(a | top, b | top), isqrt_wide((a | top) >> (i & 1)));
    }
}

inline void number_real(Workspace&, Digest& digest) {
    Random random(62);
    for (int i = 0; i < 400; ++i) {
        const int spread = i % 2 == 0 ? 1 : 70;
        const Real a = random_real(random, spread);
        const Real b = random_real(random, spread);
        digest.add(a + b, a - b, a * b, a / b, -a, square_root(a), absolute(a), scale(a, -7));
        digest.add(a == b, a != b, a<b, a> b, a <= b, a >= b, a.rounded(40), log2_of(a));
        digest.add(a.to_fixed<SubPixel>(), Real::from_fixed(a.to_fixed<SubPixel>()));
        const Int128 wide = Int128::product(a.rounded(60), b.rounded(60));
        digest.add(Real::from_int(wide, -120), Real::from_ratio(a.rounded(20), b.rounded(20)));
        digest.add(Real::sum_with_branches(a, b), Real::sum_without_branches(b, a));
        digest.add(scalar_of<Real>(a.rounded(12), -12), a.scaled(9), a.positive(), a.zero());
    }
    digest.add(Real(), Real::one(), log2_of(Real()));
}

inline void number_real_text(Workspace&, Digest& digest) {
    Random random(66);
    char text[8 + whole_real_digits] = {};
    for (int i = 0; i < 40; ++i) {
        const Real number = random_real(random, i < 20 ? 1 : 190);
        const int digits = random.between(1, whole_real_digits);
        const Result<int> length = print_real(number, digits, Span<char>(text));
        digest.add(length);
        if (!length) continue;
        for (int k = 0; k < *length; ++k) digest.add(text[k]);
        digest.add(parse_real(Span<const char>(text, *length)));
    }
    digest.add(print_real(Real(), 0, Span<char>(text)), parse_real(Span<const char>(text, 0)));
}

inline void linear_matrices(Workspace&, Digest& digest) {
    Random random(63);
    for (int i = 0; i < 10; ++i) {
        const auto a = random_matrix<3, 3>(random);
        const auto x = random_matrix<3, 1>(random);
        const auto y = random_matrix<3, 1>(random);
        digest.add(a * x, a + a, a - a.transposed(), -a, dot(x, y), cross(x, y), cross_matrix(x));
        Matrix<3, 3> own = a;
        const MatrixView<Real> view(&own(0, 1), 3, 2, 3);
        digest.add(view.rows(), view.columns(), view(2, 1));
        digest.add(determinant(a), inverse(a), normalized(x), length_of(y), a.row(1), a.column(2));
    }
}

inline void linear_solvers(Workspace&, Digest& digest) {
    Random random(64);
    for (int i = 0; i < 4; ++i) {
        const auto a = random_matrix<5, 5>(random);
        const auto b = random_matrix<5, 1>(random);
        digest.add(solve_gauss(a, b));
        const Matrix<5, 5> square = a * a.transposed();
        Matrix<5, 5> used = square;
        digest.add(cholesky(used.view()), used);
        used = square;
        Vector<5> x = b;
        digest.add(solve_ldlt(used.view(), Span<Real>(&x[0], 5)), used, x);
        used = square + Matrix<5, 5>::identity();
        digest.add(factor_ldlt(used.view()));
        digest.add(solve_with_ldlt(used.view(), Span<Real>(&x[0], 5)), x);
        auto tall = random_matrix<9, 4>(random);
        auto right = random_matrix<9, 1>(random);
        digest.add(solve_least_squares(tall.view(), Span<Real>(&right[0], 9)), tall, right);
        ExactLeastSquares<3> sums;
        for (int k = 0; k < 9; ++k) {
            const std::int64_t row[3] = {tall(k, 0).rounded(20), tall(k, 1).rounded(40),
                                         tall(k, 2).rounded(30)};
            sums.add(row, right[k].rounded(20));
        }
        digest.add(sums.solve(Span<Real>(&x[0], 3)), x);
    }
}

inline void linear_eigen(Workspace&, Digest& digest) {
    Random random(65);
    const auto part = random_matrix<6, 6>(random);
    Matrix<6, 6> a = part + part.transposed();
    Matrix<6, 6> vectors;
    digest.add(symmetric_eigen(a.view(), vectors.view()), a, vectors);
    auto tall = random_matrix<7, 3>(random);
    Matrix<3, 3> v;
    Real values[3];
    digest.add(svd(tall.view(), v.view(), Span<Real>(values)), tall, v, Span<const Real>(values));
    digest.add(nearest_rotation(random_matrix<3, 3>(random)));
}

}  // namespace fovea::golden
