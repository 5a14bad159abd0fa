// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/two_width.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

TEST(TwoWidth, TheWidestRunsAreTheWideOnes) {
    const std::vector<std::int32_t> edges = {0, 100, 300, 410, 500, 710};
    TwoWidths sorted;
    ASSERT_TRUE(sort_widths(span_of(edges), 0, 1, 5, 2, 0, 4, sorted));
    EXPECT_EQ(sorted.wide, 0b01001U);
    EXPECT_EQ(sorted.narrow, 100);
    // 0 + 5 + 10 + 10 + 5 of five runs, in 1/256 of 100.
    EXPECT_EQ(sorted.error, 30 * 256 / 500);
}

TEST(TwoWidth, GainIsTakenFromBarsAndGivenToSpaces) {
    // Runs 1 and 3 are bars that are 60 too wide: as wide as the wide space seems.
    const std::vector<std::int32_t> edges = {0, 40, 200, 340, 500, 540};
    TwoWidths sorted;
    ASSERT_TRUE(sort_widths(span_of(edges), 0, 1, 5, 1, 60, 4, sorted));
    EXPECT_EQ(sorted.wide, 0b00100U);
    EXPECT_EQ(sorted.narrow, 100);
}

TEST(TwoWidth, EveryOtherRunMayBeTaken) {
    const std::vector<std::int32_t> edges = {0, 100, 900, 1100, 1900, 2000};
    TwoWidths sorted;
    ASSERT_TRUE(sort_widths(span_of(edges), 0, 2, 3, 1, 0, 4, sorted));
    EXPECT_EQ(sorted.wide, 0b010U);
}

TEST(TwoWidth, WhatIsNotClearlyWiderIsRefused) {
    const std::vector<std::int32_t> edges = {0, 100, 220, 320, 420, 520};
    TwoWidths sorted;
    sorted.error = 77;
    EXPECT_FALSE(sort_widths(span_of(edges), 0, 1, 5, 1, 0, 4, sorted));
    const std::vector<std::int32_t> still(6, 5);
    EXPECT_FALSE(sort_widths(span_of(still), 0, 1, 5, 1, 0, 4, sorted));
    EXPECT_EQ(sorted.error, 77);
}

}  // namespace
}  // namespace fovea::test
