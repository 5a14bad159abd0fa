// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/decision/tolerance.hpp>

namespace fovea::test {
namespace {

constexpr Verdict every_verdict[] = {Verdict::ok, Verdict::low, Verdict::high, Verdict::not_ok,
                                     Verdict::unmeasured};

TEST(Tolerance, IncludesBothEnds) {
    constexpr Tolerance tolerance{Decimal{12500000}, Decimal{300000}, Decimal{100000}};
    static_assert(judge(Decimal{12500000}, tolerance) == Verdict::ok);
    EXPECT_EQ(judge(Decimal{12200000}, tolerance), Verdict::ok);
    EXPECT_EQ(judge(Decimal{12199999}, tolerance), Verdict::low);
    EXPECT_EQ(judge(Decimal{12600000}, tolerance), Verdict::ok);
    EXPECT_EQ(judge(Decimal{12600001}, tolerance), Verdict::high);
}

TEST(Tolerance, OfNothingTakesTheNominalAlone) {
    constexpr Tolerance exact{Decimal::from_int(2), Decimal(), Decimal()};
    EXPECT_EQ(judge(Decimal::from_int(2), exact), Verdict::ok);
    EXPECT_EQ(judge(Decimal{1999999}, exact), Verdict::low);
    EXPECT_EQ(judge(Decimal{2000001}, exact), Verdict::high);
}

TEST(Tolerance, JudgesTheSameWhenValueAndNominalMoveTogether) {
    Random random(601);
    const auto any = [&random](int most) { return Decimal{random.between(-most, most)}; };
    for (int i = 0; i < 1000; ++i) {
        const Decimal value = any(1000);
        const Decimal shift = any(1000000000);
        const Tolerance here{any(1000), Decimal{random.between(0, 500)}, Decimal{random.between(0, 500)}};
        const Tolerance there{here.nominal + shift, here.minus, here.plus};
        EXPECT_EQ(judge(value, here), judge(value + shift, there));
    }
}

TEST(Verdict, OfAPartIsNotOkBeforeUnmeasuredBeforeOk) {
    for (const Verdict value : every_verdict) {
        const Verdict expected = value == Verdict::ok           ? Verdict::ok
                                 : value == Verdict::unmeasured ? Verdict::unmeasured
                                                                : Verdict::not_ok;
        EXPECT_EQ(combine(Verdict::ok, value), expected);
        EXPECT_EQ(combine(Verdict::unmeasured, value),
                  expected == Verdict::not_ok ? Verdict::not_ok : Verdict::unmeasured);
        EXPECT_EQ(combine(Verdict::not_ok, value), Verdict::not_ok);
    }
}

TEST(Verdict, OfAPartDoesNotDependOnTheOrderOfItsValues) {
    for (const Verdict a : every_verdict)
        for (const Verdict b : every_verdict)
            EXPECT_EQ(combine(combine(Verdict::ok, a), b), combine(combine(Verdict::ok, b), a));
}

}  // namespace
}  // namespace fovea::test
