// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/code/code_area.hpp>

namespace fovea::test {
namespace {

SubPixelPoint at(int x, int y) { return {SubPixel::from_int(x), SubPixel::from_int(y)}; }

/// A square that stands on a corner: 20 px from its middle to each.
Code diamond() {
    Code code;
    code.corners[0] = at(50, 30);
    code.corners[1] = at(70, 50);
    code.corners[2] = at(50, 70);
    code.corners[3] = at(30, 50);
    return code;
}

TEST(CodeArea, TellsTheColumnsOfARow) {
    const detail::CodeColumns middle = detail::code_columns(diamond(), 50);
    EXPECT_EQ(middle.first, 29);
    EXPECT_EQ(middle.last, 72);
    const detail::CodeColumns above = detail::code_columns(diamond(), 40);
    EXPECT_EQ(above.first, 39);
    EXPECT_EQ(above.last, 62);
    const detail::CodeColumns none = detail::code_columns(diamond(), 20);
    EXPECT_LT(none.last, none.first);
}

TEST(CodeArea, CoversWhatLiesInsideAndTwoPixelsBeside) {
    EXPECT_TRUE(detail::code_covers(diamond(), {50, 50}));
    EXPECT_TRUE(detail::code_covers(diamond(), {61, 41}));
    EXPECT_FALSE(detail::code_covers(diamond(), {62, 38}));
    EXPECT_FALSE(detail::code_covers(diamond(), {10, 50}));
    // Whichever way its corners go.
    Code turned = diamond();
    turned.corners[1] = at(30, 50);
    turned.corners[3] = at(70, 50);
    EXPECT_TRUE(detail::code_covers(turned, {50, 50}));
    EXPECT_FALSE(detail::code_covers(turned, {62, 38}));
}

}  // namespace
}  // namespace fovea::test
