// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <fovea/image/border.hpp>

namespace fovea::test {
namespace {

/// The pixels that a row "abc" seems to have from -4 to 6.
std::string seen(Border border) {
    std::string text;
    for (int x = -4; x <= 6; ++x) text += "abc"[border_index(border, x, 3)];
    return text;
}

TEST(Border, LooksAsItsPictureSays) {
    EXPECT_EQ(seen(Border::replicate), "aaaaabccccc");
    EXPECT_EQ(seen(Border::reflect_101), "abcbabcbabc");
}

TEST(Border, LeavesPixelsOfTheImageAlone) {
    for (const Border border : {Border::replicate, Border::reflect_101})
        for (int count = 1; count < 9; ++count)
            for (int x = 0; x < count; ++x) EXPECT_EQ(border_index(border, x, count), x);
}

TEST(Border, EqualsAWalkThatTurnsAtTheOutermostPixels) {
    for (int count = 1; count < 9; ++count)
        for (const int way : {1, -1}) {
            int mirrored = 0;
            int step = way;
            for (int distance = 0; distance < 40; ++distance) {
                ASSERT_EQ(border_index(Border::reflect_101, way * distance, count), mirrored)
                    << way * distance << " of " << count;
                ASSERT_EQ(border_index(Border::replicate, way * distance, count),
                          way < 0 ? 0 : (distance < count ? distance : count - 1));
                if (count == 1) continue;
                if (mirrored + step < 0 || mirrored + step >= count) step = -step;
                mirrored += step;
            }
        }
}

TEST(Border, OfASinglePixelIsThatPixel) {
    for (const Border border : {Border::replicate, Border::reflect_101})
        for (int x = -70; x <= 70; ++x) EXPECT_EQ(border_index(border, x, 1), 0);
}

TEST(Border, WorksInConstants) { static_assert(border_index(Border::reflect_101, -1, 5) == 1); }

}  // namespace
}  // namespace fovea::test
