// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <core/draw/draw_reference.hpp>
#include <fovea/base/random.hpp>
#include <fovea/draw/slope.hpp>

namespace fovea::test {
namespace {

TEST(Slope, ClimbsTwoInFive) {
    // 2 t / 5 = 0, 0.4, 0.8, 1.2, 1.6, 2, to the nearest.
    Slope slope(10, 2, 5, 5 / 2, 0);
    for (const int value : {10, 10, 11, 11, 12, 12}) {
        EXPECT_EQ(slope.value(), value);
        slope.step();
    }
}

TEST(Slope, RoundsTiesTowardPlusInfinityBothWays) {
    Slope up(0, 1, 2, 1, 1);
    EXPECT_EQ(up.value(), 1);
    Slope down(0, -1, 2, 1, 1);
    EXPECT_EQ(down.value(), 0);
}

TEST(Slope, RoundsUpWithTheLargestBias) {
    // -3 t / 4 = 0, -0.75, -1.5, -2.25, -3, up.
    Slope slope(0, -3, 4, 3, 0);
    for (const int value : {0, 0, -1, -2, -3}) {
        EXPECT_EQ(slope.value(), value);
        slope.step();
    }
}

TEST(Slope, EqualsTheFormulaFromAnyStart) {
    Random random(101);
    for (int round = 0; round < 20000; ++round) {
        const int bits = random.between(1, 31);
        const std::int64_t run = std::int64_t{1} + random.below(1u << (bits - 1)) * 2u % (1u << 31);
        const int start = random.between(1 - (1 << 30), (1 << 30) - 1);
        const int end = random.between(1 - (1 << 30), (1 << 30) - 1);
        const std::int64_t rise = std::int64_t{end} - start;
        const auto bias = static_cast<std::int64_t>(random.below(static_cast<std::uint32_t>(run)));
        const auto first = static_cast<std::int64_t>(random.below(static_cast<std::uint32_t>(run)));
        Slope slope(start, rise, run, bias, first);
        for (std::int64_t t = first; t <= run && t < first + 20; ++t) {
            if (t > first) slope.step();
            ASSERT_EQ(slope.value(), static_cast<int>(start + floor_of(Wide{rise} * t + bias, run)))
                << start << " rise " << rise << " run " << run << " bias " << bias << " at " << t;
        }
    }
}

TEST(Slope, HoldsAtTheEndsOfItsRange) {
    const std::int64_t far = std::int64_t{1} << 31;
    EXPECT_EQ(Slope(-(1 << 30), far, far, far / 2, far).value(), 1 << 30);
    EXPECT_EQ(Slope(1 << 30, -far, far, far - 1, far).value(), -(1 << 30));
    EXPECT_EQ(Slope(-(1 << 30), far, 1, 0, 1).value(), 1 << 30);
    EXPECT_EQ(Slope(1 << 30, -far, 1, 0, 1).value(), -(1 << 30));
}

}  // namespace
}  // namespace fovea::test
