// SPDX-License-Identifier: MIT
//
// Eigenvalues, singular values and the nearest rotation.
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include <fovea/linear/eigen.hpp>
#include <fovea/linear/svd.hpp>
#include <support/random_matrix.hpp>

namespace fovea::test {
namespace {

template <int Count>
void expect_orthogonal(const Matrix<Count, Count>& a) {
    ASSERT_LE((exponent_of_difference<Count, Count>(a.transposed() * a, Matrix<Count, Count>::identity())),
              -56);
}

template <int Count>
void eigen_random(Random& random, int ranks) {
    for (int i = 0; i < 40; ++i) {
        auto part = random_matrix<Count, Count>(random);
        for (int r = 0; r < Count; ++r)
            for (int c = ranks; c < Count; ++c) part(r, c) = Real();
        const Matrix<Count, Count> a =
            part * part.transposed() - part(0, 0) * Matrix<Count, Count>::identity();
        Matrix<Count, Count> used = a;
        Matrix<Count, Count> vectors;
        ASSERT_EQ(symmetric_eigen(used.view(), vectors.view()), Status::ok);
        Real values[std::size_t{Count}];
        for (int k = 0; k < Count; ++k) values[k] = used(k, k);
        for (int k = 1; k < Count; ++k) ASSERT_GE(values[k - 1], values[k]);
        expect_orthogonal<Count>(vectors);
        // Elements are below 9: the limit of 1e-16 for them is 2^-53.
        ASSERT_LE((exponent_of_difference<Count, Count>(
                      vectors * diagonal<Count>(Span<const Real>(values)) * vectors.transposed(), a)),
                  -53);
        const std::vector<double> reference = eigen_eigenvalues(plain(a));
        for (std::size_t k = 0; k < Count; ++k)
            ASSERT_NEAR(static_cast<double>(value_of(values[k])), reference[k], 1e-13);
    }
}

TEST(SymmetricEigen, TakesApartWhatPutsTogether) {
    Random random(1);
    eigen_random<1>(random, 1);
    eigen_random<2>(random, 2);
    eigen_random<3>(random, 3);
    eigen_random<6>(random, 6);
    eigen_random<9>(random, 9);
}

TEST(SymmetricEigen, OfManyEqualValues) {
    Random random(2);
    eigen_random<6>(random, 2);
    eigen_random<9>(random, 1);
    Matrix<4, 4> nothing;
    Matrix<4, 4> vectors;
    EXPECT_EQ(symmetric_eigen(nothing.view(), vectors.view()), Status::ok);
    EXPECT_EQ(vectors, (Matrix<4, 4>::identity()));
}

TEST(SymmetricEigen, ByHandAndItsErrors) {
    const auto whole = [](int value) { return Real::from_int(value); };
    Matrix<2, 2> a(whole(2), whole(1), whole(1), whole(2));
    Matrix<2, 2> vectors;
    ASSERT_EQ(symmetric_eigen(a.view(), vectors.view()), Status::ok);
    EXPECT_EQ(a(0, 0), whole(3));
    EXPECT_EQ(a(1, 1), whole(1));
    EXPECT_LE((vectors(0, 0).absolute() - vectors(1, 0).absolute()).absolute(), Real::from_int(1, -62));
    Matrix<2, 3> wrong;
    EXPECT_EQ(symmetric_eigen(wrong.view(), vectors.view()), Status::size_mismatch);
    EXPECT_EQ(symmetric_eigen(a.view(), wrong.view()), Status::size_mismatch);
}

template <int Rows, int Columns>
void svd_random(Random& random, int ranks) {
    for (int i = 0; i < 40; ++i) {
        auto a = random_matrix<Rows, Columns>(random);
        for (int r = 0; r < Rows; ++r)
            for (int c = ranks; c < Columns; ++c) a(r, c) = a(r, 0) + a(r, c - 1);
        Matrix<Rows, Columns> u = a;
        Matrix<Columns, Columns> v;
        Real values[std::size_t{Columns}];
        ASSERT_EQ(svd(u.view(), v.view(), Span<Real>(values)), Status::ok);
        expect_orthogonal<Columns>(v);
        for (int k = 1; k < Columns; ++k) ASSERT_GE(values[k - 1], values[k]);
        ASSERT_LE((exponent_of_difference<Rows, Columns>(
                      u * diagonal<Columns>(Span<const Real>(values)) * v.transposed(), a)),
                  -53);
        // Where a value is nothing but rounding, so is its column.
        const int square = exponent_of_difference<Columns, Columns>(u.transposed() * u,
                                                                    Matrix<Columns, Columns>::identity());
        ASSERT_LE(square, ranks == Columns ? -53 : 1);
        const std::vector<double> reference = eigen_singular_values(plain(a));
        for (std::size_t k = 0; k < Columns; ++k)
            ASSERT_NEAR(static_cast<double>(value_of(values[k])), reference[k], 1e-13);
    }
}

TEST(Svd, TakesApartWhatPutsTogether) {
    Random random(3);
    svd_random<1, 1>(random, 1);
    svd_random<3, 3>(random, 3);
    svd_random<9, 9>(random, 9);
    svd_random<20, 4>(random, 4);
    svd_random<300, 3>(random, 3);
}

TEST(Svd, OfColumnsThatDependOnOthers) {
    Random random(4);
    svd_random<5, 3>(random, 1);
    svd_random<9, 9>(random, 5);
}

TEST(Svd, OfAllSmallWholeMatrices) {
    // 3^9 of them: with every rank, and with columns that are alike to the last digit.
    for (int number = 0; number < 19683; ++number) {
        Matrix<3, 3> a;
        for (int i = 0, rest = number; i < 9; ++i, rest /= 3) a(i / 3, i % 3) = Real::from_int(rest % 3 - 1);
        Matrix<3, 3> u = a;
        Matrix<3, 3> v;
        Real values[3];
        ASSERT_EQ(svd(u.view(), v.view(), Span<Real>(values)), Status::ok) << number;
        expect_orthogonal<3>(v);
        ASSERT_LE(
            (exponent_of_difference<3, 3>(u * diagonal<3>(Span<const Real>(values)) * v.transposed(), a)),
            -55)
            << number;
    }
}

TEST(Svd, ItsErrors) {
    Matrix<2, 3> wide;
    Matrix<3, 3> v;
    Real values[3];
    EXPECT_EQ(svd(wide.view(), v.view(), Span<Real>(values)), Status::size_mismatch);
    Matrix<3, 2> tall;
    EXPECT_EQ(svd(tall.view(), v.view(), Span<Real>(values, 2)), Status::size_mismatch);
    Matrix<2, 2> v2;
    EXPECT_EQ(svd(tall.view(), v2.view(), Span<Real>(values)), Status::size_mismatch);
    EXPECT_EQ(svd(tall.view(), v2.view(), Span<Real>(values, 2)), Status::ok);
    EXPECT_EQ(values[0], Real());
}

TEST(NearestRotation, IsARotationAndNoOtherIsNearer) {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        const auto a = random_matrix<3, 3>(random);
        const Result<Matrix<3, 3>> rotation = nearest_rotation(a);
        ASSERT_TRUE(rotation);
        expect_orthogonal<3>(*rotation);
        ASSERT_LE((determinant(*rotation) - Real::one()).absolute(), Real::from_int(1, -58));
        // trace(R^T a) is largest for the nearest one: also among its neighbours.
        const auto likeness = [&](const Matrix<3, 3>& r) {
            const Matrix<3, 3> product = r.transposed() * a;
            return product(0, 0) + product(1, 1) + product(2, 2);
        };
        for (int k = 0; k < 3; ++k) {
            Vector<3> axis;
            axis[k] = Real::from_ratio(1, 50);
            const Matrix<3, 3> turn = *nearest_rotation(Matrix<3, 3>::identity() + cross_matrix(axis));
            ASSERT_GT(likeness(*rotation), likeness(turn * *rotation));
            ASSERT_GT(likeness(*rotation), likeness(turn.transposed() * *rotation));
        }
    }
    EXPECT_EQ(nearest_rotation(Matrix<3, 3>()).status(), Status::degenerate);
    const Real one = Real::one();
    EXPECT_EQ(nearest_rotation(Matrix<3, 3>(one, one, one, one, one, one, one, one, one)).status(),
              Status::degenerate);
    EXPECT_EQ(*nearest_rotation(Matrix<3, 3>::identity() * Real::from_int(5)), (Matrix<3, 3>::identity()));
    // A mirror has many rotations that are as near; one that is less a mirror in one direction has one.
    const auto diagonal_of = [](int x, int y, int z) {
        Matrix<3, 3> a;
        a(0, 0) = Real::from_int(x);
        a(1, 1) = Real::from_int(y);
        a(2, 2) = Real::from_int(z);
        return a;
    };
    EXPECT_EQ(nearest_rotation(diagonal_of(1, 1, -1)).status(), Status::degenerate);
    EXPECT_EQ(nearest_rotation(-Matrix<3, 3>::identity()).status(), Status::degenerate);
    EXPECT_EQ(*nearest_rotation(diagonal_of(3, 2, -1)), (Matrix<3, 3>::identity()));
    EXPECT_EQ(*nearest_rotation(diagonal_of(3, 2, 0)), (Matrix<3, 3>::identity()));
}

}  // namespace
}  // namespace fovea::test
