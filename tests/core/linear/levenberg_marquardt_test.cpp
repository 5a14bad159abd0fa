// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/linear/levenberg_marquardt.hpp>
#include <support/random_matrix.hpp>

namespace fovea::test {
namespace {

/// Samples of the curve a / (1 + b x), x = 0, 1, ...: two unknowns.
template <class Scalar>
struct Hyperbola {
    using State = Vector<2, Scalar>;

    Span<const Scalar> samples;

    Status linearise(const State& state, NormalEquations<2, Scalar>& equations) const {
        for (int i = 0; i < samples.size(); ++i) {
            const Scalar x = scalar_of<Scalar>(i);
            const Scalar below = scalar_of<Scalar>(1) + state[1] * x;
            if (!(scalar_of<Scalar>(0) < below)) return Status::out_of_range;
            const Scalar share = scalar_of<Scalar>(1) / below;
            equations.add(Vector<2, Scalar>(share, -(state[0] * x * share * share)),
                          state[0] * share - samples[i]);
        }
        return Status::ok;
    }
    Result<Scalar> cost(const State& state) const {
        NormalEquations<2, Scalar> equations;
        const Status status = linearise(state, equations);
        if (status != Status::ok) return status;
        return equations.cost;
    }
    State moved(const State& state, const Vector<2, Scalar>& step) const { return state + step; }
};

/// Rosenbrock's valley: residuals 1 - x and 10 (y - x^2).
struct Valley {
    using State = Vector<2>;

    Status linearise(const State& at, NormalEquations<2>& equations) const {
        const Real ten = Real::from_int(10);
        equations.add(Vector<2>(-Real::one(), Real()), Real::one() - at[0]);
        equations.add(Vector<2>(-Real::from_int(20) * at[0], ten), ten * (at[1] - at[0] * at[0]));
        return Status::ok;
    }
    Result<Real> cost(const State& at) const {
        NormalEquations<2> equations;
        EXPECT_EQ(linearise(at, equations), Status::ok);
        return equations.cost;
    }
    State moved(const State& at, const Vector<2>& step) const { return at + step; }
};

TEST(NormalEquations, ByHand) {
    NormalEquations<2> equations;
    const auto whole = [](int value) { return Real::from_int(value); };
    equations.add(Vector<2>(whole(1), whole(2)), whole(3));
    equations.add(Vector<2>(whole(0), whole(2)), whole(-1));
    EXPECT_EQ(equations.matrix(0, 0), whole(1));
    EXPECT_EQ(equations.matrix(0, 1), whole(2));
    EXPECT_EQ(equations.matrix(1, 1), whole(8));
    EXPECT_EQ(equations.gradient, (Vector<2>(whole(3), whole(4))));
    EXPECT_EQ(equations.cost, whole(10));
    // The inverse of 1 2, 2 8.
    EXPECT_EQ(*equations.inverse(), (Matrix<2, 2>(whole(2), -Real::from_int(1, -1), -Real::from_int(1, -1),
                                                  Real::from_int(1, -2))));
    NormalEquations<2> open;
    open.add(Vector<2>(whole(1), whole(2)), whole(3));
    EXPECT_EQ(open.inverse().status(), Status::degenerate);
}

TEST(LevenbergMarquardt, FindsTheCurveThatSamplesWereTakenOf) {
    Random random(11);
    for (int i = 0; i < 100; ++i) {
        const Real a = Real::from_int(random.between(1000, 9000), -10);
        const Real b = Real::from_int(random.between(100, 4000), -10);
        Real samples[9];
        for (int k = 0; k < 9; ++k) samples[k] = a / (Real::one() + b * Real::from_int(k));
        Vector<2> state(Real::from_int(random.between(1, 12)), Real::from_int(random.between(1, 40), -3));
        const Hyperbola<Real> problem{samples};
        const auto done = levenberg_marquardt<2, Real>(problem, state);
        ASSERT_TRUE(done) << i;
        EXPECT_TRUE(done->converged);
        EXPECT_LE((state[0] - a).absolute(), Real::from_int(1, -56)) << i;
        EXPECT_LE((state[1] - b).absolute(), Real::from_int(1, -56)) << i;
        EXPECT_LE(done->linearisations, 25);
    }
}

TEST(LevenbergMarquardt, ItsAnswerIsTheBottomAndTheSameInLongDouble) {
    Random random(12);
    for (int i = 0; i < 100; ++i) {
        Real samples[12];
        long double same[12];
        for (int k = 0; k < 12; ++k) {
            const Real noise = Real::from_int(random.between(-40, 40), -10);
            samples[k] = Real::from_int(4) / (Real::one() + Real::from_int(k, -1)) + noise;
            same[k] = value_of(samples[k]);
        }
        Vector<2> state(Real::from_int(2), Real::from_int(2));
        Vector<2, long double> other(2.0L, 2.0L);
        const Hyperbola<Real> problem{samples};
        const auto done = levenberg_marquardt<2, Real>(problem, state);
        const auto reference = levenberg_marquardt<2, long double>(Hyperbola<long double>{same}, other);
        ASSERT_TRUE(done && reference);
        ASSERT_TRUE(done->converged && reference->converged);
        // Both stop where a step would lower the cost by less than 2^-68: within 2^-33 standard deviations.
        EXPECT_NEAR(static_cast<double>(value_of(state[0])), static_cast<double>(other[0]), 1e-10);
        EXPECT_NEAR(static_cast<double>(value_of(state[1])), static_cast<double>(other[1]), 1e-10);
        // Another step would gain no more than the last.
        NormalEquations<2> equations;
        ASSERT_EQ(problem.linearise(state, equations), Status::ok);
        const Real gain = dot(equations.gradient, *equations.inverse() * equations.gradient);
        EXPECT_LE(gain, done->cost.scaled(-68));
        // No neighbour is lower.
        for (const int bits : {-12, -20, -24})
            for (int way = 0; way < 4; ++way) {
                Vector<2> beside = state;
                const Real step = Real::from_int(way < 2 ? 1 : -1, bits);
                beside[way % 2] += step;
                EXPECT_LT(done->cost, *problem.cost(beside));
            }
    }
}

TEST(LevenbergMarquardt, FollowsAValleyWithinItsBound) {
    for (int most = 1; most <= 40; ++most) {
        Vector<2> state(Real::from_ratio(-6, 5), Real::one());
        LevenbergMarquardtOptions options;
        options.most_linearisations = most;
        const auto done = levenberg_marquardt<2, Real>(Valley{}, state, options);
        ASSERT_TRUE(done);
        EXPECT_LE(done->linearisations, most);
        EXPECT_LE(done->costs, 2 * most + 16);
        EXPECT_EQ(done->cost, *Valley{}.cost(state));
        if (most < 40) continue;
        EXPECT_TRUE(done->converged);
        EXPECT_LE((state[0] - Real::one()).absolute(), Real::from_int(1, -50));
    }
}

TEST(LevenbergMarquardt, RefusesWhatLeavesAnUnknownOpen) {
    struct Line {
        Status linearise(const Vector<2>& at, NormalEquations<2>& equations) const {
            for (int i = 0; i < 5; ++i)
                equations.add(Vector<2>(Real::one(), Real::one()), at[0] + at[1] - Real::from_int(i));
            return Status::ok;
        }
        Result<Real> cost(const Vector<2>& at) const {
            NormalEquations<2> equations;
            EXPECT_EQ(linearise(at, equations), Status::ok);
            return equations.cost;
        }
        Vector<2> moved(const Vector<2>& at, const Vector<2>& step) const { return at + step; }
    };
    const Vector<2> start(Real::from_int(7), Real::from_int(1));
    Vector<2> state = start;
    EXPECT_EQ((levenberg_marquardt<2, Real>(Line{}, state).status()), Status::degenerate);
    EXPECT_EQ(state, start);

    // A start without sense, and no equations allowed.
    const Real samples[] = {Real::one(), Real::one()};
    Vector<2> behind(Real::one(), -Real::from_int(2));
    EXPECT_EQ((levenberg_marquardt<2, Real>(Hyperbola<Real>{samples}, behind).status()),
              Status::out_of_range);
    EXPECT_EQ(behind, (Vector<2>(Real::one(), -Real::from_int(2))));
    LevenbergMarquardtOptions none;
    none.most_linearisations = 0;
    EXPECT_EQ((levenberg_marquardt<2, Real>(Valley{}, state, none).status()), Status::bad_argument);
    EXPECT_EQ(state, start);
}

}  // namespace
}  // namespace fovea::test
