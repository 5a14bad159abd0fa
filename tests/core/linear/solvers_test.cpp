// SPDX-License-Identifier: MIT
//
// Equations: by elimination, by L D L^T, by reflections, and from exact sums.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/linear/cholesky.hpp>
#include <fovea/linear/gauss.hpp>
#include <fovea/linear/least_squares.hpp>
#include <fovea/linear/qr.hpp>
#include <support/random_matrix.hpp>

namespace fovea::test {
namespace {

template <int Count>
void solve_random(Random& random) {
    for (int i = 0; i < 50; ++i) {
        const auto a = random_matrix<Count, Count>(random);
        const auto x = random_matrix<Count, 1>(random);
        const std::vector<double> stretches = eigen_singular_values(plain(a));
        const double condition = stretches.front() / stretches.back();
        if (condition > 1e6) continue;
        const Vector<Count> b = a * x;
        const Result<Vector<Count>> found = solve_gauss(a, b);
        ASSERT_TRUE(found);
        // 2^20 of condition and 2^6 for elimination leave 2^-37 of 2^-63.
        ASSERT_LE((exponent_of_difference<Count, 1>(*found, x)), -36);

        Matrix<Count, Count> square = a.transposed() * a;
        Vector<Count> right = a.transposed() * b;
        if (condition > 1e4) continue;
        ASSERT_EQ(solve_ldlt(square.view(), Span<Real>(&right[0], Count)), Status::ok);
        ASSERT_LE((exponent_of_difference<Count, 1>(right, x)), -63 + 27 + 6);
    }
}

TEST(SolveGauss, FindsWhatEquationsWereMadeOf) {
    Random random(1);
    solve_random<1>(random);
    solve_random<2>(random);
    solve_random<5>(random);
    solve_random<8>(random);
}

TEST(SolveGauss, ByHandWithAPivotThatIs0) {
    const auto whole = [](int value) { return Real::from_int(value); };
    const Matrix<3, 3> a(whole(0), whole(2), whole(1), whole(1), whole(1), whole(1), whole(2), whole(0),
                         whole(3));
    const Result<Vector<3>> x = solve_gauss(a, Vector<3>(whole(7), whole(6), whole(11)));
    ASSERT_TRUE(x);
    EXPECT_EQ(*x, (Vector<3>(whole(1), whole(2), whole(3))));
    EXPECT_EQ(solve_gauss(Matrix<2, 2>(whole(1), whole(2), whole(2), whole(4)), Vector<2>()).status(),
              Status::degenerate);
    Matrix<2, 3> wrong;
    EXPECT_EQ(solve_gauss(wrong.view(), wrong.view()), Status::size_mismatch);
}

TEST(SolveGauss, OfTheIdentityIsTheInverse) {
    Random random(2);
    for (int i = 0; i < 50; ++i) {
        const auto a = random_matrix<3, 3>(random);
        Matrix<3, 3> used = a;
        Matrix<3, 3> back = Matrix<3, 3>::identity();
        if (determinant(a).absolute() < Real::from_ratio(1, 100)) continue;
        ASSERT_EQ(solve_gauss(used.view(), back.view()), Status::ok);
        ASSERT_LE((exponent_of_difference<3, 3>(back, *inverse(a))), -45);
    }
}

TEST(Cholesky, ItsSquareIsTheMatrix) {
    Random random(3);
    for (int i = 0; i < 50; ++i) {
        const auto part = random_matrix<7, 7>(random);
        const Matrix<7, 7> a = part * part.transposed();
        Matrix<7, 7> lower = a;
        ASSERT_EQ(cholesky(lower.view()), Status::ok);
        for (int r = 0; r < 7; ++r)
            for (int c = r + 1; c < 7; ++c) lower(r, c) = Real();
        // Elements of a are below 8 and lose at most 8 digits of 2^-63 of it.
        ASSERT_LE((exponent_of_difference<7, 7>(lower * lower.transposed(), a)), -57);
    }
}

TEST(Cholesky, LeavesWhatIsAboveTheDiagonal) {
    const auto whole = [](int value) { return Real::from_int(value); };
    // cholesky() reads the lower triangle alone.
    Matrix<2, 2> lower(whole(4), whole(77), whole(2), whole(10));
    ASSERT_EQ(cholesky(lower.view()), Status::ok);
    EXPECT_EQ(lower(0, 0), whole(2));
    EXPECT_EQ(lower(1, 0), whole(1));
    EXPECT_EQ(lower(1, 1), whole(3));
    EXPECT_EQ(lower(0, 1), whole(77));
    // L D L^T reads the upper triangle and leaves it: 4, 2, 10 = [1 0; 1/2 1] [4 0; 0 9] [1 1/2; 0 1].
    Matrix<2, 2> factors(whole(4), whole(2), whole(77), whole(10));
    ASSERT_EQ(factor_ldlt(factors.view()), Status::ok);
    EXPECT_EQ(factors(0, 1), whole(2));
    EXPECT_EQ(factors(1, 0), Real::from_ratio(1, 2));
    EXPECT_EQ(factors(1, 1), whole(9));
    // Factors that nobody may write solve too: 4 x + 2 y = 10, 2 x + 10 y = 14 at x = 2, y = 1.
    const Matrix<2, 2> kept = factors;
    Real b[2] = {whole(10), whole(14)};
    ASSERT_EQ(solve_with_ldlt(kept.view(), Span<Real>(b)), Status::ok);
    EXPECT_EQ(b[0], whole(2));
    EXPECT_EQ(b[1], whole(1));
}

TEST(Cholesky, RefusesWhatIsNotPositiveDefinite) {
    const auto whole = [](int value) { return Real::from_int(value); };
    for (const Matrix<2, 2>& a : {Matrix<2, 2>(), Matrix<2, 2>(whole(1), whole(2), whole(2), whole(3)),
                                  Matrix<2, 2>(whole(-1), whole(0), whole(0), whole(1)),
                                  Matrix<2, 2>(Real::from_ratio(1, 3), whole(1), whole(1), whole(3))}) {
        Matrix<2, 2> used = a;
        EXPECT_EQ(cholesky(used.view()), Status::degenerate);
        used = a;
        EXPECT_EQ(factor_ldlt(used.view()), Status::degenerate);
    }
    Matrix<2, 3> wrong;
    Real b[3];
    EXPECT_EQ(cholesky(wrong.view()), Status::size_mismatch);
    EXPECT_EQ(factor_ldlt(wrong.view()), Status::size_mismatch);
    EXPECT_EQ(solve_with_ldlt(wrong.view(), Span<Real>(b)), Status::size_mismatch);
    Matrix<2, 2> two = Matrix<2, 2>::identity();
    EXPECT_EQ(solve_ldlt(two.view(), Span<Real>(b)), Status::size_mismatch);
}

/// 40 equations whose right sides do not fit, so that something is left.
struct Overdetermined {
    Matrix<40, 5> a;
    Vector<40> b;
    std::int64_t whole[40][5] = {};
    std::int64_t right[40] = {};

    explicit Overdetermined(Random& random) {
        for (int r = 0; r < 40; ++r)
            for (int c = 0; c < 6; ++c) {
                std::int64_t& number = c < 5 ? whole[r][c] : right[r];
                number = random.between(-5000, 5000) * (c == 1 ? std::int64_t{1} << 20 : 1);
                (c < 5 ? a(r, c) : b[r]) = Real::from_int(number);
            }
    }
};

TEST(SolveLeastSquares, IsThatOfEigenAndOfExactSums) {
    Random random(4);
    for (int i = 0; i < 50; ++i) {
        const Overdetermined system(random);
        Matrix<40, 5> a = system.a;
        Vector<40> b = system.b;
        ASSERT_EQ(solve_least_squares(a.view(), Span<Real>(&b[0], 40)), Status::ok);
        const std::vector<double> reference = eigen_least_squares(plain(system.a), plain(system.b).values);
        Vector<5> x;
        Real square;
        for (int k = 0; k < 40; ++k) (k < 5 ? x[k] : square) += k < 5 ? b[k] : b[k] * b[k];
        for (std::size_t k = 0; k < 5; ++k)
            ASSERT_NEAR(static_cast<double>(value_of(x[static_cast<int>(k)])), reference[k],
                        1e-12 * (k == 1 ? 1e-6 : 1));
        // What is left, and that it stands on all columns.
        const Vector<40> left = system.b - system.a * x;
        ASSERT_LE((length_of(left) - square.square_root()).absolute(), Real::from_int(1, -40));
        const Vector<5> along = system.a.transposed() * left;
        for (int k = 0; k < 5; ++k) ASSERT_LE(along[k].absolute(), Real::from_int(1, k == 1 ? 0 : -20));

        ExactLeastSquares<5> sums;
        for (int r = 0; r < 40; ++r) sums.add(system.whole[r], system.right[r]);
        Real y[5];
        ASSERT_EQ(sums.solve(Span<Real>(y)), Status::ok);
        for (int k = 0; k < 5; ++k)
            ASSERT_LE((y[k] - b[k]).absolute(), Real::from_int(1, k == 1 ? -75 : -55)) << k;
    }
}

TEST(SolveLeastSquares, RefusesColumnsThatDependOnOthers) {
    Random random(5);
    Overdetermined system(random);
    for (int r = 0; r < 40; ++r) {
        system.a(r, 4) = system.a(r, 0) * Real::from_ratio(1, 3) + system.a(r, 1) * Real::from_ratio(-2, 7);
        system.whole[r][4] = 3 * system.whole[r][0] - system.whole[r][2];
    }
    EXPECT_EQ(solve_least_squares(system.a.view(), Span<Real>(&system.b[0], 40)), Status::degenerate);
    Matrix<3, 2> nothing;
    Vector<3> b;
    EXPECT_EQ(solve_least_squares(nothing.view(), Span<Real>(&b[0], 3)), Status::degenerate);
    EXPECT_EQ(solve_least_squares(nothing.view(), Span<Real>(&b[0], 2)), Status::size_mismatch);
    Matrix<2, 3> wide;
    EXPECT_EQ(solve_least_squares(wide.view(), Span<Real>(&b[0], 2)), Status::size_mismatch);

    ExactLeastSquares<5> sums;
    for (int r = 0; r < 40; ++r) sums.add(system.whole[r], system.right[r]);
    Real x[5] = {Real::one()};
    EXPECT_EQ(sums.solve(Span<Real>(x)), Status::degenerate);
    EXPECT_EQ(x[0], Real::one());
    EXPECT_EQ(sums.solve(Span<Real>(x, 4)), Status::size_mismatch);
}

TEST(ExactLeastSquares, DoesNotDependOnTheOrder) {
    Random random(6);
    const Overdetermined system(random);
    ExactLeastSquares<5> forward;
    ExactLeastSquares<5> backward;
    for (int r = 0; r < 40; ++r) {
        forward.add(system.whole[r], system.right[r]);
        backward.add(system.whole[39 - r], system.right[39 - r]);
    }
    Real x[5];
    Real y[5];
    ASSERT_EQ(forward.solve(Span<Real>(x)), Status::ok);
    ASSERT_EQ(backward.solve(Span<Real>(y)), Status::ok);
    for (int k = 0; k < 5; ++k) EXPECT_EQ(x[k], y[k]);
    forward.clear();
    EXPECT_EQ(forward.solve(Span<Real>(x)), Status::degenerate);
}

TEST(ExactLeastSquares, GivesNoLineWhoseDigitsAreLost) {
    // y = 2 m + 1 far from the origin: what sets the columns apart is less and less.
    for (int far = 0; far < 40; ++far) {
        ExactLeastSquares<2> line;
        for (int i = 0; i < 4; ++i) line.add({(std::int64_t{1} << far) + i, 1}, 2 * i + 1);
        Real x[2];
        const Status status = line.solve(Span<Real>(x));
        EXPECT_TRUE(far >= 14 || status == Status::ok) << far;
        EXPECT_TRUE(far <= 18 || status == Status::degenerate) << far;
        if (status != Status::ok) continue;
        // 2^-32 in squares leaves 2^-31 of 2^-63, and 2^-28 after its four operations.
        ASSERT_LE((x[0] - Real::from_int(2)).absolute(), Real::from_int(1, -27)) << far;
    }
}

TEST(SolveLeastSquares, OfVeryManyRowsToo) {
    constexpr int rows = 400000;
    std::vector<Real> a(2 * rows);
    std::vector<Real> b(rows, Real::one());
    const Real part = Real::from_ratio(1000003, 3000001);
    for (std::size_t r = 0; r < rows; ++r) {
        a[2 * r] = r == 0 ? part * Real::from_int(3) : part;
        a[2 * r + 1] = a[2 * r] * Real::from_ratio(1, 3);
    }
    EXPECT_EQ(solve_least_squares(MatrixView<Real>(a.data(), rows, 2), Span<Real>(b.data(), rows)),
              Status::degenerate);
}

}  // namespace
}  // namespace fovea::test
