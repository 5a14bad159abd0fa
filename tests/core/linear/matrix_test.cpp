// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/linear/matrix.hpp>
#include <support/random_matrix.hpp>

namespace fovea::test {
namespace {

Real whole(int value) { return Real::from_int(value); }

TEST(Matrix, MultipliesAsByHand) {
    const Matrix<2, 3> a(whole(1), whole(2), whole(3), whole(4), whole(5), whole(6));
    const Vector<3> x(whole(1), whole(0), whole(-1));
    EXPECT_EQ(a * x, (Vector<2>(whole(-2), whole(-2))));
    EXPECT_EQ(a * a.transposed(), (Matrix<2, 2>(whole(14), whole(32), whole(32), whole(77))));
    EXPECT_EQ(a + a - a, a);
    EXPECT_EQ(a * whole(2), whole(2) * a);
    EXPECT_EQ((Matrix<2, 2>::identity() * a), a);
    EXPECT_EQ(a.row(1), (Vector<3>(whole(4), whole(5), whole(6))));
    EXPECT_EQ(a.column(2), (Vector<2>(whole(3), whole(6))));
    EXPECT_NE(a, -a);
    EXPECT_EQ((Matrix<2, 3>()), a - a);
}

TEST(Matrix, OfThreeHasCrossProductsAndAnInverse) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const auto a = random_matrix<3, 3>(random);
        const auto x = random_matrix<3, 1>(random);
        const auto y = random_matrix<3, 1>(random);
        ASSERT_LE((exponent_of_difference<3, 1>(cross(x, y), cross_matrix(x) * y)), -62);
        ASSERT_LE(dot(x, cross(x, y)).absolute(), Real::from_int(1, -61));
        const Result<Matrix<3, 3>> back = inverse(a);
        ASSERT_TRUE(back);
        const Real size = determinant(a);
        ASSERT_LE((determinant(a.transposed()) - size).absolute(), Real::from_int(1, -59));
        // What was rounded in the cofactors counts more where the determinant is small.
        if (size.absolute() < Real::from_ratio(1, 100)) continue;
        ASSERT_LE((exponent_of_difference<3, 3>(a * *back, Matrix<3, 3>::identity())), -52);
    }
    EXPECT_EQ(determinant(Matrix<3, 3>(whole(2), whole(0), whole(1), whole(1), whole(3), whole(2), whole(1),
                                       whole(1), whole(1))),
              whole(0));
    EXPECT_EQ(determinant(Matrix<3, 3>(whole(2), whole(0), whole(0), whole(0), whole(3), whole(2), whole(1),
                                       whole(1), whole(1))),
              whole(2));
    const Vector<3> x(whole(2), whole(-3), whole(6));
    EXPECT_EQ(length_of(x), whole(7));
    EXPECT_LE((length_of(*normalized(x)) - whole(1)).absolute(), Real::from_int(1, -61));
    EXPECT_EQ(normalized(Vector<3>()).status(), Status::degenerate);
    EXPECT_EQ(inverse(Matrix<3, 3>()).status(), Status::degenerate);
    EXPECT_EQ(inverse(cross_matrix(x)).status(), Status::degenerate);
}

}  // namespace
}  // namespace fovea::test
