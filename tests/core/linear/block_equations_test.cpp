// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include <fovea/linear/block_equations.hpp>
#include <support/random_matrix.hpp>

namespace fovea::test {
namespace {

constexpr int own = 3;
constexpr int views = 4;

/// Residuals of some views, with some derivatives that are 0; the same in one matrix.
template <int Shared>
void compare_with_dense(Random& random) {
    constexpr int all = Shared + own * views;
    std::vector<Real> scratch(static_cast<std::size_t>(block_equations_scratch<own>(Shared, views)));
    std::vector<std::int64_t> words(static_cast<std::size_t>(block_equations_words<own>(Shared)));
    BlockEquations<own> blocks(Shared, views, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                               {words.data(), static_cast<std::ptrdiff_t>(words.size())});
    NormalEquations<all> dense;
    blocks.clear();
    for (int view = 0; view < views; ++view)
        for (int i = 0; i < 20; ++i) {
            Vector<all> row;
            Real shared[std::size_t{Shared} + 1];
            for (int k = 0; k < Shared; ++k) row[k] = shared[k] = k == i % 4 ? Real() : random_part(random);
            const auto by_own = random_matrix<own, 1>(random);
            for (int k = 0; k < own; ++k) row[Shared + own * view + k] = by_own[k];
            const Real residual = random_part(random);
            blocks.add(view, Span<const Real>(shared, Shared), by_own, residual);
            dense.add(row, residual);
        }
    blocks.finish();
    EXPECT_LE((blocks.cost() - dense.cost).absolute(), dense.cost.scaled(-56));
    for (const int damping : {detail::undamped, -3, 2}) {
        Matrix<all, all> a = dense.matrix;
        Vector<all> step = -dense.gradient;
        for (int i = 0; i < all; ++i) a(i, i) = detail::damped(a(i, i), damping);
        ASSERT_EQ(solve_ldlt(a.view(), Span<Real>(&step[0], all)), Status::ok);
        Real gain;
        ASSERT_EQ(blocks.solve(damping, gain), Status::ok);
        // Conditions are below 2^14 or so.
        const Real small = Real::from_int(1, -46);
        EXPECT_LE((gain + dot(step, dense.gradient)).absolute(), small);
        for (int i = 0; i < Shared; ++i) EXPECT_LE((blocks.shared_step()[i] - step[i]).absolute(), small);
        for (int view = 0; view < views; ++view)
            for (int i = 0; i < own; ++i)
                EXPECT_LE((blocks.own_step(view)[i] - step[Shared + own * view + i]).absolute(), small);
    }
    Real gain;
    ASSERT_EQ(blocks.solve(detail::undamped, gain), Status::ok);
    blocks.invert();
    const auto inverse = *dense.inverse();
    for (int i = 0; i < Shared; ++i)
        EXPECT_LE((blocks.shared_variance(i) - inverse(i, i)).absolute(), Real::from_int(1, -40));
    for (int view = 0; view < views; ++view)
        for (int i = 0; i < own; ++i) {
            const int at = Shared + own * view + i;
            EXPECT_LE((blocks.own_variances(view)[i] - inverse(at, at)).absolute(), Real::from_int(1, -40));
        }
}

TEST(BlockEquations, AreThoseOfOneMatrix) {
    Random random(21);
    for (int i = 0; i < 4; ++i) {
        compare_with_dense<5>(random);
        compare_with_dense<1>(random);
        compare_with_dense<0>(random);
    }
}

TEST(BlockEquations, SayWhereAnUnknownIsOpen) {
    std::vector<Real> scratch(static_cast<std::size_t>(block_equations_scratch<1>(1, 2)));
    std::vector<std::int64_t> words(static_cast<std::size_t>(block_equations_words<1>(1)));
    BlockEquations<1> blocks(1, 2, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                             {words.data(), static_cast<std::ptrdiff_t>(words.size())});
    blocks.clear();
    const Real one[] = {Real::one()};
    const Real zero[] = {Real()};
    const Vector<1> unit(Real::one());
    Real gain;
    // Nothing of the second view; then nothing that tells what is shared from what is its own.
    blocks.add(0, Span<const Real>(one), unit, Real::one());
    blocks.finish();
    EXPECT_EQ(blocks.solve(detail::undamped, gain), Status::degenerate);
    blocks.add(1, Span<const Real>(one), unit, Real::one());
    blocks.finish();
    EXPECT_EQ(blocks.solve(detail::undamped, gain), Status::degenerate);
    EXPECT_EQ(blocks.solve(0, gain), Status::ok);
    blocks.add(1, Span<const Real>(zero), unit, Real::one());
    blocks.finish();
    EXPECT_EQ(blocks.solve(detail::undamped, gain), Status::ok);
}

}  // namespace
}  // namespace fovea::test
