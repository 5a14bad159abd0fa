// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <climits>
#include <cstdint>

#include <fovea/image/geometry.hpp>

namespace fovea::test {
namespace {

TEST(Size, IsEmptyWithoutPixelsAndHasAnAreaWithoutOverflow) {
    EXPECT_TRUE(Size().empty());
    EXPECT_TRUE((Size{0, 5}.empty()));
    EXPECT_TRUE((Size{5, -1}.empty()));
    EXPECT_FALSE((Size{1, 1}.empty()));
    EXPECT_EQ((Size{3, 4}.area()), 12);
    EXPECT_EQ((Size{INT_MAX, INT_MAX}.area()), std::int64_t{INT_MAX} * INT_MAX);
    EXPECT_EQ((Size{max_image_side, max_image_side}.area()), 1073676289);
}

TEST(Geometry, IsEqualWhenEveryPartIs) {
    EXPECT_EQ((Size{1, 2}), (Size{1, 2}));
    EXPECT_NE((Size{1, 2}), (Size{2, 1}));
    EXPECT_NE((Size{1, 2}), (Size{1, 3}));
    EXPECT_EQ((Point{1, 2}), (Point{1, 2}));
    EXPECT_NE((Point{1, 2}), (Point{2, 2}));
    EXPECT_NE((Point{1, 2}), (Point{1, 1}));
    const SubPixelPoint coarse{SubPixel::from_int(1), SubPixel::from_int(2)};
    EXPECT_EQ(coarse, coarse);
    EXPECT_NE(coarse, (SubPixelPoint{SubPixel::from_int(1), SubPixel()}));
    const FinePoint fine{FinePixel::from_int(1), FinePixel::from_int(2)};
    EXPECT_EQ(fine, fine);
    EXPECT_NE(fine, (FinePoint{FinePixel(), FinePixel::from_int(2)}));
    EXPECT_TRUE((Rectangle{1, 2, 3, 4} == Rectangle{1, 2, 3, 4}));
    EXPECT_FALSE((Rectangle{1, 2, 3, 4} == Rectangle{0, 2, 3, 4}));
    EXPECT_FALSE((Rectangle{1, 2, 3, 4} == Rectangle{1, 0, 3, 4}));
    EXPECT_FALSE((Rectangle{1, 2, 3, 4} == Rectangle{1, 2, 0, 4}));
    EXPECT_FALSE((Rectangle{1, 2, 3, 4} == Rectangle{1, 2, 3, 0}));
}

TEST(Rectangle, ContainsItsOutermostPixelsAndNoneBeyond) {
    constexpr Rectangle area{-2, 5, 4, 3};
    static_assert(area.right() == 1 && area.bottom() == 7 && area.size() == Size{4, 3} && !area.empty());
    for (int y = 3; y <= 9; ++y)
        for (int x = -4; x <= 3; ++x)
            EXPECT_EQ(area.contains({x, y}), x >= -2 && x <= 1 && y >= 5 && y <= 7) << x << " " << y;
    EXPECT_TRUE(Rectangle().empty());
    EXPECT_FALSE(Rectangle().contains({0, 0}));
    EXPECT_FALSE((Rectangle{0, 0, -3, 3}.contains({-1, 1})));
}

TEST(Rectangle, ReachesTheEndsOfAnIntWithoutOverflow) {
    constexpr Rectangle last{INT_MAX, INT_MAX, 1, 1};
    static_assert(last.right() == INT_MAX && last.bottom() == INT_MAX);
    EXPECT_TRUE(last.contains({INT_MAX, INT_MAX}));
    EXPECT_FALSE(last.contains({INT_MIN, INT_MIN}));
    EXPECT_FALSE(last.contains({INT_MAX - 1, INT_MAX}));
    constexpr Rectangle beyond{INT_MAX - 1, INT_MAX - 1, 100, INT_MAX};
    EXPECT_TRUE(beyond.contains({INT_MAX, INT_MAX}));
    EXPECT_FALSE(beyond.contains({INT_MIN, INT_MAX}));
    constexpr Rectangle widest{INT_MIN, INT_MIN, INT_MAX, INT_MAX};
    EXPECT_TRUE(widest.contains({INT_MIN, -2}));
    EXPECT_FALSE(widest.contains({INT_MAX, -2}));
    EXPECT_FALSE(widest.contains({-1, -2}));
}

}  // namespace
}  // namespace fovea::test
