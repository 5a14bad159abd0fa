// SPDX-License-Identifier: MIT
//
// Least squares of residuals that are not linear: steps of Gauss and Newton, damped while they lead too far.
#pragma once

#include <limits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linear/cholesky.hpp>
#include <fovea/linear/matrix.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct LevenbergMarquardtOptions {
    /// Equations are set up so often at most, 1 or more. Problems that are well posed need 5 to 15; where
    /// unknowns are nearly open, some ten more.
    int most_linearisations = 200;
};

/// What a refinement came to.
template <class Scalar = Real>
struct Refinement {
    /// The sum of the squares of all residuals at the answer.
    Scalar cost = scalar_of<Scalar>(0);
    /// Equations that were set up, and costs that were asked for.
    int linearisations = 0;
    int costs = 0;
    /// Whether the answer is the bottom as far as digits tell: the last step would have lowered the cost by
    /// less than 2^-68 of it, or no step lowered it at all. If not, most_linearisations were too few.
    bool converged = false;
};

/// Sums over residuals r with derivatives J by the unknowns: J^T J, its upper triangle, J^T r and r^T r.
template <int Count, class Scalar = Real>
struct NormalEquations {
    Matrix<Count, Count, Scalar> matrix;
    Vector<Count, Scalar> gradient;
    Scalar cost = scalar_of<Scalar>(0);

    /// One residual. Derivatives that are 0 take no time.
    constexpr void add(const Vector<Count, Scalar>& derivatives, Scalar residual);

    /// The inverse of J^T J: with the variance of a residual, the covariances of the unknowns.
    ///
    /// Errors  degenerate where the residuals leave an unknown open
    constexpr Result<Matrix<Count, Count, Scalar>> inverse() const;
};

/// Looks for the state whose residuals have the smallest sum of squares, from a state near it. For a few
/// unknowns; calibration has a form of its own.
///
/// A Problem is any type with these three, where a State is any type that can be copied:
///   Status linearise(const State& state, NormalEquations<Count, Scalar>& equations) const
///       adds every residual to the equations, which are empty before
///   Result<Scalar> cost(const State& state) const
///       the sum of squares alone; an error where the state makes no sense: then a shorter step is tried
///   State moved(const State& state, const Vector<Count, Scalar>& step) const
///       the state a step further; the derivatives are those by this step at 0
///
/// Rounding  that of Scalar: once a step is not seen in the cost any more, undamped steps follow until the
///           last would lower it by less than 2^-68
/// Time      bounded: each step that is accepted divides the damping by 8, each that is not multiplies it by
///           8, and it may only rise from 2^-10 to 2^32. So with n linearisations at most 2 n + 16 costs
/// Errors    bad_argument for most_linearisations below 1; what linearise() answers; degenerate where the
///           residuals leave an unknown open. Then state is untouched. An end that is not converged is no
///           error: the answer says so
/// Source    Levenberg 1944, Marquardt 1963: the diagonal of J^T J is raised by a share of itself, here a
///           power of two, which rounds nothing and does not depend on the units of the unknowns
template <int Count, class Scalar, class State, class Problem>
constexpr Result<Refinement<Scalar>> levenberg_marquardt(const Problem& problem, State& state,
                                                         const LevenbergMarquardtOptions& options = {});

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The damping is 2 to the power of this; or there is none.
inline constexpr int undamped = std::numeric_limits<int>::min();
inline constexpr int first_damping = -10;
inline constexpr int least_damping = -40;
inline constexpr int most_damping = 32;
inline constexpr int damping_step = 3;

/// An element of the diagonal.
template <class Scalar>
constexpr Scalar damped(Scalar value, int damping) {
    return damping == undamped ? value : value + scale(value, damping);
}

/// The way down, for any form of the equations. A System has a state, and
///   Status linearise()                          sets up the equations there
///   Scalar cost() const                         as the equations have it
///   Status solve(int damping, Scalar& gain)     a step; gain tells by how much it would lower the cost
///   Result<Scalar> cost_ahead()                 the cost behind that step
///   void accept()                               makes that step
///   Result<Scalar> cost_here()                  the cost of the state
template <class Scalar, class System>
constexpr Status descend(System& system, const LevenbergMarquardtOptions& options,
                         Refinement<Scalar>& refinement) {
    // Gains below 2^-40 of the cost are not looked for in costs; below 2^-20, undamped steps are safe.
    constexpr int seen_bits = 40;
    constexpr int near_bits = 20;
    constexpr int end_bits = 68;
    if (options.most_linearisations < 1) return Status::bad_argument;
    Refinement<Scalar> done;
    int damping = first_damping;
    Scalar last_gain = scalar_of<Scalar>(0);
    bool polishing = false;
    while (!done.converged && done.linearisations < options.most_linearisations) {
        const Status status = system.linearise();
        if (status != Status::ok) return status;
        ++done.linearisations;
        const Scalar cost = system.cost();
        for (bool stepped = false; !stepped;) {
            Scalar gain = scalar_of<Scalar>(0);
            Status solved = system.solve(polishing ? undamped : damping, gain);
            if (solved == Status::ok && !polishing && scale(cost, -seen_bits) < gain) {
                ++done.costs;
                const Result<Scalar> ahead = system.cost_ahead();
                if (ahead && *ahead < cost) {
                    system.accept();
                    damping = maximum(damping - damping_step, least_damping);
                    stepped = true;
                    continue;
                }
            } else if (solved == Status::ok) {
                if (!polishing) {
                    solved = system.solve(undamped, gain);
                    if (solved != Status::ok) return solved;
                    last_gain = scale(cost, -near_bits);
                    polishing = !(last_gain < gain);
                }
                stepped = true;
                if (!polishing) {
                    // Held back by the damping alone.
                    solved = system.solve(damping, gain);
                    if (solved != Status::ok) return solved;
                    system.accept();
                    damping = maximum(damping - damping_step, least_damping);
                    continue;
                }
                // Steps that do not become shorter are rounding.
                const bool shorter = gain < last_gain;
                if (shorter) system.accept();
                last_gain = gain;
                done.converged = !shorter || !(scale(cost, -end_bits) < gain);
                continue;
            } else if (polishing) {
                return solved;
            }
            damping += damping_step;
            if (damping <= most_damping) continue;
            if (solved != Status::ok) return solved;
            // No step lowers the cost.
            done.converged = true;
            stepped = true;
        }
    }
    ++done.costs;
    const Result<Scalar> cost = system.cost_here();
    if (!cost) return cost.status();
    done.cost = *cost;
    refinement = done;
    return Status::ok;
}

/// Levenberg-Marquardt's equations in one block.
template <int Count, class Scalar, class State, class Problem>
class DenseSystem {
public:
    constexpr DenseSystem(const Problem& problem, const State& state)
        : problem_(problem), state_(state), ahead_(state) {}

    constexpr const State& state() const { return state_; }
    constexpr Status linearise() {
        equations_ = {};
        return problem_.linearise(state_, equations_);
    }
    constexpr Scalar cost() const { return equations_.cost; }
    constexpr Status solve(int damping, Scalar& gain) {
        Matrix<Count, Count, Scalar> a = equations_.matrix;
        Vector<Count, Scalar> step = -equations_.gradient;
        for (int i = 0; i < Count; ++i) a(i, i) = damped(a(i, i), damping);
        const Status status = solve_ldlt(a.view(), Span<Scalar>(&step[0], Count));
        if (status != Status::ok) return status;
        gain = -dot(step, equations_.gradient);
        ahead_ = problem_.moved(state_, step);
        return Status::ok;
    }
    constexpr Result<Scalar> cost_ahead() const { return problem_.cost(ahead_); }
    constexpr Result<Scalar> cost_here() const { return problem_.cost(state_); }
    constexpr void accept() { state_ = ahead_; }

private:
    const Problem& problem_;
    State state_;
    State ahead_;
    NormalEquations<Count, Scalar> equations_;
};

}  // namespace detail

template <int Count, class Scalar>
constexpr void NormalEquations<Count, Scalar>::add(const Vector<Count, Scalar>& derivatives,
                                                   Scalar residual) {
    const Scalar zero = scalar_of<Scalar>(0);
    for (int i = 0; i < Count; ++i) {
        const Scalar a = derivatives[i];
        if (a == zero) continue;
        for (int k = i; k < Count; ++k)
            if (derivatives[k] != zero) matrix(i, k) = matrix(i, k) + a * derivatives[k];
        gradient[i] = gradient[i] + a * residual;
    }
    cost = cost + residual * residual;
}

template <int Count, class Scalar>
constexpr Result<Matrix<Count, Count, Scalar>> NormalEquations<Count, Scalar>::inverse() const {
    Matrix<Count, Count, Scalar> a = matrix;
    const Status status = factor_ldlt(a.view());
    if (status != Status::ok) return status;
    Matrix<Count, Count, Scalar> result;
    for (int c = 0; c < Count; ++c) {
        Vector<Count, Scalar> x;
        x[c] = scalar_of<Scalar>(1);
        const Status solved = solve_with_ldlt(a.view(), Span<Scalar>(&x[0], Count));
        if (solved != Status::ok) return solved;
        for (int r = 0; r < Count; ++r) result(r, c) = x[r];
    }
    return result;
}

template <int Count, class Scalar, class State, class Problem>
constexpr Result<Refinement<Scalar>> levenberg_marquardt(const Problem& problem, State& state,
                                                         const LevenbergMarquardtOptions& options) {
    detail::DenseSystem<Count, Scalar, State, Problem> system(problem, state);
    Refinement<Scalar> refinement;
    const Status status = detail::descend(system, options, refinement);
    if (status != Status::ok) return status;
    state = system.state();
    return refinement;
}

}  // namespace fovea
