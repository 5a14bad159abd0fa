// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <climits>
#include <cmath>
#include <cstdint>

#include <fovea/base/random.hpp>

namespace fovea::test {
namespace {

TEST(Random, GivesTheNumbersOfTheDemoOfPcg) {
    // pcg32-demo of the reference implementation, seed 42, stream 54, round 1.
    Random random(42, 54);
    for (const std::uint32_t expected :
         {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
        EXPECT_EQ(random.next(), expected);
}

TEST(Random, DiffersBySeedAndByStream) {
    Random one(1);
    Random same(1, 1);
    Random other_seed(2);
    Random other_stream(1, 2);
    int seeds_agree = 0;
    int streams_agree = 0;
    for (int i = 0; i < 1000; ++i) {
        const std::uint32_t draw = one.next();
        ASSERT_EQ(draw, same.next());
        seeds_agree += draw == other_seed.next() ? 1 : 0;
        streams_agree += draw == other_stream.next() ? 1 : 0;
    }
    EXPECT_LE(seeds_agree, 1);
    EXPECT_LE(streams_agree, 1);
}

TEST(Random, WorksInConstants) {
    static_assert([] {
        Random random(42, 54);
        return random.next();
    }() == 0xa15c02b7u);
}

TEST(RandomBelow, IsWithoutTheBiasOfARemainder) {
    // 3/4 of all 32-bit numbers: a bare remainder would give the lowest third of them half of the draws.
    // The share of a third has a standard deviation of sqrt(2 / 9 / n); five of them are allowed.
    constexpr int draws = 40000;
    constexpr std::uint32_t bound = 3u << 30;
    Random random(44);
    int lowest = 0;
    for (int i = 0; i < draws; ++i) {
        const std::uint32_t draw = random.below(bound);
        ASSERT_LT(draw, bound);
        lowest += draw < (1u << 30) ? 1 : 0;
    }
    EXPECT_NEAR(lowest, draws / 3.0, 5 * std::sqrt(draws * 2 / 9.0));
}

TEST(RandomBelow, DrawsEveryNumberEquallyOften) {
    // Each count is binomial with n p q = 60000 * 5 / 36.
    int count[6] = {};
    Random random(45);
    for (int i = 0; i < 60000; ++i) ++count[random.below(6)];
    for (const int times : count) EXPECT_NEAR(times, 10000, 5 * std::sqrt(60000 * 5 / 36.0));
}

TEST(RandomBelow, TakesTheSmallestAndTheLargestBound) {
    Random random(46);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(random.below(1), 0u);
    for (int i = 0; i < 100; ++i) EXPECT_LT(random.below(UINT32_MAX), UINT32_MAX);
}

TEST(RandomBetween, ReachesBothEndsAndNothingBeyond) {
    Random random(47);
    bool low = false;
    bool high = false;
    for (int i = 0; i < 1000; ++i) {
        const int draw = random.between(-3, 4);
        ASSERT_GE(draw, -3);
        ASSERT_LE(draw, 4);
        low = low || draw == -3;
        high = high || draw == 4;
    }
    EXPECT_TRUE(low);
    EXPECT_TRUE(high);
    EXPECT_EQ(random.between(5, 5), 5);
}

TEST(RandomBetween, TakesRangesAtAndAcrossTheEndsOfAnInt) {
    Random random(48);
    bool negative = false;
    bool positive = false;
    for (int i = 0; i < 1000; ++i) {
        EXPECT_LE(random.between(INT_MIN, INT_MIN + 1), INT_MIN + 1);
        EXPECT_GE(random.between(INT_MAX - 1, INT_MAX), INT_MAX - 1);
        EXPECT_LT(random.between(INT_MIN, INT_MAX - 1), INT_MAX);
        const int wide = random.between(INT_MIN + 1, INT_MAX);
        negative = negative || wide < INT_MIN / 2;
        positive = positive || wide > INT_MAX / 2;
    }
    EXPECT_EQ(random.between(INT_MIN, INT_MIN), INT_MIN);
    EXPECT_EQ(random.between(INT_MAX, INT_MAX), INT_MAX);
    EXPECT_TRUE(negative && positive);
}

}  // namespace
}  // namespace fovea::test
