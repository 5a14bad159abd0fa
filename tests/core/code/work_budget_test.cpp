// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/work_budget.hpp>

namespace fovea::test {
namespace {

using detail::WorkBudget;

TEST(WorkBudget, GrowsWithThePixelsAndIsNeverBelowTheLeast) {
    EXPECT_EQ(WorkBudget(Size{100, 50}, 4, 1000).left(), 20000);
    EXPECT_EQ(WorkBudget(Size{10, 5}, 4, 1000).left(), 1000);
    // The largest image does not overflow it.
    EXPECT_EQ(WorkBudget(Size{max_image_side, max_image_side}, 16, 0).left(),
              std::int64_t{16} * max_image_side * max_image_side);
}

TEST(WorkBudget, IsSpentWithItsLastUnit) {
    WorkBudget budget(10);
    EXPECT_FALSE(budget.spent());
    budget.spend(9);
    EXPECT_FALSE(budget.spent());
    budget.spend(1);
    EXPECT_TRUE(budget.spent());
    budget.spend(5);
    EXPECT_EQ(budget.left(), -5);
    EXPECT_TRUE(WorkBudget().spent());
}

}  // namespace
}  // namespace fovea::test
