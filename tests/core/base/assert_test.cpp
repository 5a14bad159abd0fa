// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/base/assert.hpp>

namespace fovea::test {
namespace {

constexpr int half_of_even(int number) {
    FOVEA_ASSERT(number % 2 == 0);
    return number / 2;
}

TEST(Assert, IsSilentWhileItsConditionHoldsAndWorksInConstants) {
    static_assert(half_of_even(8) == 4);
    EXPECT_EQ(half_of_even(-6), -3);
}

#if defined(NDEBUG)
TEST(Assert, IsNotEvenEvaluatedInARelease) {
    int evaluated = 0;
    FOVEA_ASSERT(++evaluated == 7);
    EXPECT_EQ(evaluated, 0);
    EXPECT_EQ(half_of_even(7), 3);
}
#else
TEST(AssertDeathTest, StopsAtABrokenConditionWhileDebugging) { EXPECT_DEATH(half_of_even(7), ""); }

TEST(Assert, EvaluatesItsConditionOnceWhileDebugging) {
    int evaluated = 0;
    FOVEA_ASSERT(++evaluated == 1);
    EXPECT_EQ(evaluated, 1);
}
#endif

}  // namespace
}  // namespace fovea::test
