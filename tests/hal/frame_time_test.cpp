// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include <fovea/hal/frame_time.hpp>

namespace fovea::hal {
namespace {

TEST(SequenceGaps, CountsTheNumbersThatAreMissing) {
    SequenceGaps gaps;
    EXPECT_EQ(gaps.before(7), 0u);  // the first may have any number
    EXPECT_EQ(gaps.before(8), 0u);
    EXPECT_EQ(gaps.before(12), 3u);
}

TEST(SequenceGaps, RunsOverFromTheLastNumberToTheFirst) {
    SequenceGaps gaps;
    EXPECT_EQ(gaps.before(0xfffffffeu), 0u);
    EXPECT_EQ(gaps.before(0xffffffffu), 0u);
    EXPECT_EQ(gaps.before(0), 0u);
    EXPECT_EQ(gaps.before(3), 2u);
}

TEST(SequenceGaps, TakesNumbersThatDoNotAdvanceForNoNumbering) {
    SequenceGaps gaps;
    EXPECT_EQ(gaps.before(0), 0u);
    EXPECT_EQ(gaps.before(0), 0u);
    EXPECT_EQ(gaps.before(5), 4u);
    EXPECT_EQ(gaps.before(2), 0u);  // numbered anew
    EXPECT_EQ(gaps.before(3), 0u);
    gaps.restart();
    EXPECT_EQ(gaps.before(100), 0u);
}

TEST(FrameStamps, BelievesAStampOfThePast) {
    FrameStamps stamps;
    stamps.restart(1000);
    EXPECT_EQ(stamps.taken(5000, 5300), 5000);
}

TEST(FrameStamps, SetsStampsOfTheFutureBackByTheMostThatWasSeen) {
    FrameStamps stamps;
    stamps.restart(1000);
    EXPECT_EQ(stamps.taken(180000, 10000), 10000);
    EXPECT_EQ(stamps.taken(220000, 52000), 50000);  // 2000 late by the driver's own clock
    EXPECT_EQ(stamps.taken(260000, 89000), 89000);  // ahead by more than before
    EXPECT_EQ(stamps.taken(300000, 130000), 129000);
    stamps.restart(200000);
    EXPECT_EQ(stamps.taken(250000, 260000), 250000);
}

TEST(FrameStamps, TakesTheArrivalForAStampFromBeforeTheStream) {
    FrameStamps stamps;
    stamps.restart(1000000);
    EXPECT_EQ(stamps.taken(0, 1040000), 1040000);
    EXPECT_EQ(stamps.taken(999999, 1080000), 1080000);
    EXPECT_EQ(stamps.taken(1000000, 1120000), 1000000);
}

TEST(FrameStamps, SurvivesAStampThatWrapsAround) {
    // As large as a kernel's nanoseconds reach, in microseconds.
    constexpr std::int64_t end = std::numeric_limits<std::int64_t>::max() / 1000;
    FrameStamps stamps;
    stamps.restart(1000000);
    EXPECT_EQ(stamps.taken(end - 10, 1040000), 1040000);
    EXPECT_EQ(stamps.taken(-end, 1080000), 1080000);
    EXPECT_EQ(stamps.taken(-end + 40000, 1120000), 1120000);
}

}  // namespace
}  // namespace fovea::hal
