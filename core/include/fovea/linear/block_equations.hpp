// SPDX-License-Identifier: MIT
//
// Normal equations of many views: unknowns that all of them share, and some that each has for itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linear/cholesky.hpp>
#include <fovea/linear/levenberg_marquardt.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/real.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

namespace detail {
inline constexpr int residuals_together = 16;
}  // namespace detail

// ---- Interface --------------------------------------------------------------------

/// Sums over residuals r with derivatives J, as NormalEquations has them, where a residual belongs to a view
/// and depends on Own unknowns of that view and on those that all views share. The views are removed from the
/// equations one by one, so that memory and time grow with the number of views, and not with its square or
/// cube.
///
/// Scratch   block_equations_scratch<Own>(shared, views) scalars, block_equations_words<Own>(shared) words
/// Rounding  sums in the order in which residuals are added. Of Real, the sums over 16 residuals of a view
///           are exact, of derivatives that are rounded to 2^-61 of the largest by the same unknown there
/// Source    Schur complement; Triggs et al., "Bundle Adjustment - A Modern Synthesis", 1999, section 6.1
template <int Own, class Scalar = Real>
class BlockEquations {
public:
    /// shared 0 or more, views 1 or more; the scratch is large enough.
    constexpr BlockEquations(int shared, int views, Span<Scalar> scratch, Span<std::int64_t> words);

    constexpr int shared() const { return shared_; }
    constexpr int views() const { return views_; }
    constexpr Scalar cost() const { return cost_; }

    /// Back to no residuals.
    constexpr void clear();
    /// One residual of a view, with its derivatives by the shared unknowns and by the view's own. Those that
    /// are 0 take no time.
    constexpr void add(int view, Span<const Scalar> by_shared, const Vector<Own, Scalar>& by_own,
                       Scalar residual);
    /// After the last residual, before anything is asked.
    constexpr void finish();

    /// The step of Gauss and Newton, with the diagonal raised by 2^damping of itself, or detail::undamped;
    /// gain is by how much it would lower the cost of a linear problem.
    ///
    /// Errors  degenerate where the residuals leave an unknown open
    constexpr Status solve(int damping, Scalar& gain);
    constexpr Span<const Scalar> shared_step() const { return shared_step_; }
    constexpr Vector<Own, Scalar> own_step(int view) const;

    /// After solve() without damping: the diagonal of the inverse of J^T J. What is given to add() before is
    /// used up.
    constexpr void invert();
    constexpr Scalar shared_variance(int index) const { return matrix(index, index); }
    constexpr Vector<Own, Scalar> own_variances(int view);

private:
    static constexpr int triangle = Own * (Own + 1) / 2;
    /// Sums of products of whole numbers below 2^61 over so many residuals stay below 2^127.
    static constexpr int together = detail::residuals_together;
    static constexpr bool exact = std::is_same_v<Scalar, Real>;

    /// Where the sum of products of two columns of a residual stands; columns are the shared unknowns, the
    /// view's own, and the residual itself.
    constexpr Scalar& sum_of(int view, int column, int other);
    constexpr void add_products(int view, Span<const Scalar> by_shared, const Vector<Own, Scalar>& by_own,
                                Scalar residual);

    /// Elements of a view: the upper triangle of its matrix, the products with what is shared, gradient,
    /// step.
    constexpr Span<Scalar> part(int view, int from, int count) const {
        const int size = triangle + Own * (shared_ + 2);
        return parts_.from(std::int64_t{size} * view + from).first(count);
    }
    constexpr Span<Scalar> own_matrix(int view) const { return part(view, 0, triangle); }
    constexpr Span<Scalar> products(int view, int index) const {
        return part(view, triangle + Own * index, Own);
    }
    constexpr Span<Scalar> own_gradient(int view) const { return products(view, shared_); }
    constexpr Span<Scalar> step_of(int view) const { return products(view, shared_ + 1); }
    constexpr Scalar& matrix(int row, int column) const { return matrix_[row * shared_ + column]; }
    constexpr MatrixView<Scalar> rest() const { return {rest_.data(), shared_, shared_}; }
    constexpr Span<Scalar> solution(int index) const {
        return solutions_.from(std::int64_t{Own} * index).first(Own);
    }
    /// The view's own matrix, ready for solve_with_ldlt().
    constexpr Status factor(int view, int damping, Matrix<Own, Own, Scalar>& a) const;
    static constexpr Scalar product(Span<const Scalar> a, Span<const Scalar> b);

    int shared_;
    int views_;
    Scalar cost_ = scalar_of<Scalar>(0);
    Span<Scalar> matrix_;
    Span<Scalar> gradient_;
    Span<Scalar> shared_step_;
    Span<Scalar> rest_;
    Span<Scalar> solutions_;
    Span<Scalar> parts_;
    /// Residuals that wait for their sums, and what of them is not 0, as whole numbers.
    Span<Scalar> rows_;
    Span<std::int64_t> words_;
    int waiting_ = 0;
    int waiting_view_ = 0;
};

/// Scalars that a BlockEquations needs.
template <int Own>
constexpr std::int64_t block_equations_scratch(int shared, int views) {
    const std::int64_t of_a_view = Own * (Own + 1) / 2 + Own * (shared + 2);
    return std::int64_t{2} * shared * (shared + 1) + Own * (shared + 1) +
           detail::residuals_together * (shared + Own + 1) + of_a_view * views;
}
template <int Own>
constexpr std::int64_t block_equations_words(int shared) {
    return std::int64_t{detail::residuals_together + 2} * (shared + Own + 1);
}

// ---- Implementation ---------------------------------------------------------------

template <int Own, class Scalar>
constexpr BlockEquations<Own, Scalar>::BlockEquations(int shared, int views, Span<Scalar> scratch,
                                                      Span<std::int64_t> words)
    : shared_(shared), views_(views), words_(words) {
    FOVEA_ASSERT(scratch.size() >= block_equations_scratch<Own>(shared, views));
    FOVEA_ASSERT(words.size() >= block_equations_words<Own>(shared));
    const auto take = [&](int count) {
        const Span<Scalar> taken = scratch.first(count);
        scratch = scratch.from(count);
        return taken;
    };
    matrix_ = take(shared * shared);
    rest_ = take(shared * shared);
    gradient_ = take(shared);
    shared_step_ = take(shared);
    solutions_ = take(Own * (shared + 1));
    rows_ = take(together * (shared + Own + 1));
    parts_ = scratch;
}

template <int Own, class Scalar>
constexpr void BlockEquations<Own, Scalar>::clear() {
    const Scalar zero = scalar_of<Scalar>(0);
    cost_ = zero;
    waiting_ = 0;
    for (Scalar& value : matrix_) value = zero;
    for (Scalar& value : gradient_) value = zero;
    for (int view = 0; view < views_; ++view)
        for (Scalar& value : part(view, 0, triangle + Own * (shared_ + 2))) value = zero;
}

template <int Own, class Scalar>
constexpr void BlockEquations<Own, Scalar>::add(int view, Span<const Scalar> by_shared,
                                                const Vector<Own, Scalar>& by_own, Scalar residual) {
    if constexpr (!exact) {
        add_products(view, by_shared, by_own, residual);
    } else {
        if (waiting_ == together || view != waiting_view_) finish();
        waiting_view_ = view;
        Scalar* row = rows_.data() + (shared_ + Own + 1) * waiting_++;
        for (int i = 0; i < shared_; ++i) *row++ = by_shared[i];
        for (int i = 0; i < Own; ++i) *row++ = by_own[i];
        *row = residual;
    }
}

template <int Own, class Scalar>
constexpr void BlockEquations<Own, Scalar>::add_products(int view, Span<const Scalar> by_shared,
                                                         const Vector<Own, Scalar>& by_own, Scalar residual) {
    const Scalar zero = scalar_of<Scalar>(0);
    cost_ = cost_ + residual * residual;
    for (int i = 0; i < shared_; ++i) {
        const Scalar a = by_shared[i];
        if (a == zero) continue;
        for (int k = i; k < shared_; ++k) matrix(i, k) = matrix(i, k) + a * by_shared[k];
        gradient_[i] = gradient_[i] + a * residual;
        for (int k = 0; k < Own; ++k) products(view, i)[k] = products(view, i)[k] + a * by_own[k];
    }
    Scalar* sums = own_matrix(view).data();
    for (int i = 0; i < Own; ++i) {
        for (int k = i; k < Own; ++k, ++sums) *sums = *sums + by_own[i] * by_own[k];
        own_gradient(view)[i] = own_gradient(view)[i] + by_own[i] * residual;
    }
}

template <int Own, class Scalar>
constexpr Scalar& BlockEquations<Own, Scalar>::sum_of(int view, int column, int other) {
    const int last = shared_ + Own;
    if (column == last) return cost_;
    if (column < shared_) {
        if (other < shared_) return matrix(column, other);
        return other == last ? gradient_[column] : products(view, column)[other - shared_];
    }
    const int i = column - shared_;
    if (other == last) return own_gradient(view)[i];
    return own_matrix(view)[i * Own - i * (i + 1) / 2 + other - shared_];
}

template <int Own, class Scalar>
constexpr void BlockEquations<Own, Scalar>::finish() {
    if constexpr (exact) {
        const int columns = shared_ + Own + 1;
        // Per column: its numbers, which of them are not 0, and the exponent of their unit.
        const auto numbers = [&](int c) { return words_.data() + (together + 2) * c; };
        for (int c = 0; c < columns; ++c) {
            std::int64_t* const number = numbers(c);
            std::int64_t used = 0;
            int most = 0;
            for (int r = 0; r < waiting_; ++r) {
                const Real& value = rows_[r * columns + c];
                if (value.zero()) continue;
                if (used == 0 || value.exponent() > most) most = value.exponent();
                used |= std::int64_t{1} << r;
            }
            for (int r = 0; r < waiting_; ++r) number[r] = rows_[r * columns + c].rounded(60 - most);
            number[together] = used;
            number[together + 1] = most - 60;
        }
        for (int c = 0; c < columns; ++c)
            for (int d = c; d < columns; ++d) {
                const std::int64_t* const first = numbers(c);
                const std::int64_t* const second = numbers(d);
                auto used = static_cast<std::uint32_t>(first[together] & second[together]);
                if (used == 0) continue;
                Int128 sum;
                for (int r = 0; used != 0; ++r, used >>= 1)
                    if ((used & 1) != 0) sum += Int128::product(first[r], second[r]);
                const auto exponent = static_cast<int>(first[together + 1] + second[together + 1]);
                Scalar& total = sum_of(waiting_view_, c, d);
                total = total + Real::from_int(sum, exponent);
            }
        waiting_ = 0;
    }
}

template <int Own, class Scalar>
constexpr Vector<Own, Scalar> BlockEquations<Own, Scalar>::own_step(int view) const {
    Vector<Own, Scalar> step;
    for (int i = 0; i < Own; ++i) step[i] = step_of(view)[i];
    return step;
}

template <int Own, class Scalar>
constexpr Status BlockEquations<Own, Scalar>::factor(int view, int damping,
                                                     Matrix<Own, Own, Scalar>& a) const {
    const Scalar* value = own_matrix(view).data();
    for (int i = 0; i < Own; ++i)
        for (int k = i; k < Own; ++k) a(i, k) = *value++;
    for (int i = 0; i < Own; ++i) a(i, i) = detail::damped(a(i, i), damping);
    return factor_ldlt(a.view());
}

template <int Own, class Scalar>
constexpr Scalar BlockEquations<Own, Scalar>::product(Span<const Scalar> a, Span<const Scalar> b) {
    Scalar sum = a[0] * b[0];
    for (std::ptrdiff_t i = 1; i < a.size(); ++i) sum = sum + a[i] * b[i];
    return sum;
}

template <int Own, class Scalar>
constexpr Status BlockEquations<Own, Scalar>::solve(int damping, Scalar& gain) {
    const MatrixView<Scalar> s = rest();
    for (int i = 0; i < shared_; ++i) {
        for (int k = i; k < shared_; ++k) s(i, k) = matrix(i, k);
        s(i, i) = detail::damped(s(i, i), damping);
        shared_step_[i] = -gradient_[i];
    }
    Matrix<Own, Own, Scalar> a;
    for (int view = 0; view < views_; ++view) {
        Status status = factor(view, damping, a);
        if (status != Status::ok) return status;
        // The view's inverse times its products and its gradient.
        for (int i = 0; i <= shared_; ++i) {
            for (int k = 0; k < Own; ++k) solution(i)[k] = products(view, i)[k];
            status = solve_with_ldlt(a.view(), solution(i));
            if (status != Status::ok) return status;
        }
        for (int i = 0; i < shared_; ++i) {
            for (int k = i; k < shared_; ++k) s(i, k) = s(i, k) - product(products(view, i), solution(k));
            shared_step_[i] = shared_step_[i] + product(products(view, i), solution(shared_));
        }
    }
    if (shared_ > 0) {
        const Status status = solve_ldlt(s, shared_step_);
        if (status != Status::ok) return status;
    }
    gain = scalar_of<Scalar>(0);
    for (int i = 0; i < shared_; ++i) gain = gain - gradient_[i] * shared_step_[i];
    for (int view = 0; view < views_; ++view) {
        Status status = factor(view, damping, a);
        if (status != Status::ok) return status;
        const Span<Scalar> step = step_of(view);
        for (int k = 0; k < Own; ++k) {
            step[k] = -own_gradient(view)[k];
            for (int i = 0; i < shared_; ++i) step[k] = step[k] - products(view, i)[k] * shared_step_[i];
        }
        status = solve_with_ldlt(a.view(), step);
        if (status != Status::ok) return status;
        gain = gain - product(own_gradient(view), step);
    }
    return Status::ok;
}

template <int Own, class Scalar>
constexpr void BlockEquations<Own, Scalar>::invert() {
    for (int c = 0; c < shared_; ++c) {
        for (int i = 0; i < shared_; ++i) shared_step_[i] = scalar_of<Scalar>(i == c ? 1 : 0);
        const Status status = solve_with_ldlt(rest(), shared_step_);
        FOVEA_ASSERT(status == Status::ok);
        static_cast<void>(status);
        for (int r = 0; r < shared_; ++r) matrix(r, c) = shared_step_[r];
    }
}

template <int Own, class Scalar>
constexpr Vector<Own, Scalar> BlockEquations<Own, Scalar>::own_variances(int view) {
    Matrix<Own, Own, Scalar> a;
    Status status = factor(view, detail::undamped, a);
    for (int i = 0; i < shared_ && status == Status::ok; ++i) {
        for (int k = 0; k < Own; ++k) solution(i)[k] = products(view, i)[k];
        status = solve_with_ldlt(a.view(), solution(i));
    }
    Vector<Own, Scalar> variances;
    for (int k = 0; k < Own && status == Status::ok; ++k) {
        Vector<Own, Scalar> unit;
        unit[k] = scalar_of<Scalar>(1);
        status = solve_with_ldlt(a.view(), Span<Scalar>(&unit[0], Own));
        Scalar sum = unit[k];
        for (int i = 0; i < shared_; ++i) {
            Scalar row = scalar_of<Scalar>(0);
            for (int j = 0; j < shared_; ++j) row = row + matrix(i, j) * solution(j)[k];
            sum = sum + solution(i)[k] * row;
        }
        variances[k] = sum;
    }
    FOVEA_ASSERT(status == Status::ok);
    return variances;
}

}  // namespace fovea
