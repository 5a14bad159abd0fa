// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/morphology/distance_transform.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

GuardedImage<Sum32> squares(const GuardedImage<Gray8>& src) {
    GuardedImage<Sum32> dst(src.view().size());
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(squared_distance_scratch(src.view().size())));
    EXPECT_EQ(squared_distance(src.view(), {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                               dst.view()),
              Status::ok);
    return dst;
}
GuardedImage<Gray16> chamfers(const GuardedImage<Gray8>& src) {
    GuardedImage<Gray16> dst(src.view().size());
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(chamfer_distance_scratch(src.view().size())));
    EXPECT_EQ(chamfer_distance(src.view(), {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                               dst.view()),
              Status::ok);
    return dst;
}

GuardedImage<Gray8> with_zeros(Size size, std::uint32_t one_in, Random& random) {
    GuardedImage<Gray8> image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image(x, y) = random.below(one_in) == 0 ? Gray8{0} : static_cast<Gray8>(random.between(1, 255));
    return image;
}

TEST(SquaredDistance, RisesAroundOneZeroPixel) {
    GuardedImage<Gray8> src({7, 5});
    src.fill(Gray8{1});
    src(2, 1) = 0;
    const auto dst = squares(src);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x)
            EXPECT_EQ(dst(x, y), static_cast<Sum32>((x - 2) * (x - 2) + (y - 1) * (y - 1)));
}

TEST(SquaredDistance, EqualsTheReferenceOfAllPairs) {
    Random random(11);
    for (const Size size :
         {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{2, 2}, Size{17, 11}, Size{40, 3}, Size{31, 33}})
        for (const std::uint32_t one_in : {1u, 2u, 5u, 30u, 200u}) {
            const auto src = with_zeros(size, one_in, random);
            const auto dst = squares(src);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    Sum32 least = no_ground_squared;
                    for (int v = 0; v < size.height; ++v)
                        for (int u = 0; u < size.width; ++u)
                            if (src(u, v) == 0)
                                least = std::min(least,
                                                 static_cast<Sum32>((u - x) * (u - x) + (v - y) * (v - y)));
                    ASSERT_EQ(dst(x, y), least)
                        << size.width << "x" << size.height << " at " << x << "," << y;
                }
        }
}

TEST(SquaredDistance, ReachesAcrossTheLongestSides) {
    // The farthest a pixel may be along either side: squares and differences of squares at their bounds.
    GuardedImage<Gray8> wide({max_image_side, 2});
    wide.fill(Gray8{255});
    wide(0, 0) = 0;
    const auto far = squares(wide);
    EXPECT_EQ(far(max_image_side - 1, 1), static_cast<Sum32>(32766) * 32766 + 1);
    GuardedImage<Gray8> tall({2, max_image_side});
    tall.fill(Gray8{255});
    tall(1, max_image_side - 1) = 0;
    EXPECT_EQ(squares(tall)(0, 0), static_cast<Sum32>(32766) * 32766 + 1);
    const auto steps = chamfers(tall);
    EXPECT_EQ(steps(0, 0), farthest_chamfer);
    EXPECT_EQ(steps(1, max_image_side - 1 - 21844), 3 * 21844);
}

TEST(SquaredDistance, SaysSoWhereThereIsNoGround) {
    GuardedImage<Gray8> src({6, 4});
    src.fill(Gray8{9});
    const auto dst = squares(src);
    const auto steps = chamfers(src);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x) {
            EXPECT_EQ(dst(x, y), no_ground_squared);
            EXPECT_EQ(steps(x, y), farthest_chamfer);
        }
    src.fill(Gray8{0});
    EXPECT_EQ(squares(src)(3, 3), 0u);
}

TEST(ChamferDistance, IsTheShortestWayInStepsOf3And4) {
    Random random(12);
    for (const Size size : {Size{1, 1}, Size{1, 8}, Size{8, 1}, Size{2, 5}, Size{23, 19}, Size{50, 4}})
        for (const std::uint32_t one_in : {2u, 9u, 90u}) {
            const auto src = with_zeros(size, one_in, random);
            const auto dst = chamfers(src);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    int least = farthest_chamfer;
                    for (int v = 0; v < size.height; ++v)
                        for (int u = 0; u < size.width; ++u)
                            if (src(u, v) == 0) {
                                const int dx = std::abs(u - x), dy = std::abs(v - y);
                                least = std::min(least, 3 * std::abs(dx - dy) + 4 * std::min(dx, dy));
                            }
                    ASSERT_EQ(dst(x, y), least)
                        << size.width << "x" << size.height << " at " << x << "," << y;
                }
        }
}

TEST(ChamferDistance, StaysWithinEightPercentOfTheDistance) {
    GuardedImage<Gray8> src({201, 201});
    src.fill(Gray8{1});
    src(100, 100) = 0;
    const auto steps = chamfers(src);
    const auto exact = squares(src);
    for (int y = 0; y < 201; ++y)
        for (int x = 0; x < 201; ++x) {
            // 100 * (step / 3)^2 between 92^2 and 108^2 percent of the square.
            const std::int64_t square = std::int64_t{steps(x, y)} * steps(x, y) * 10000;
            EXPECT_GE(square, 9 * 92 * 92 * std::int64_t{exact(x, y)});
            EXPECT_LE(square, 9 * 108 * 108 * std::int64_t{exact(x, y)});
        }
}

}  // namespace
}  // namespace fovea::test
