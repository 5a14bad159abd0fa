// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>

#include <fovea/simulated/lines.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

TEST(SimulatedLines, GivesOneLineAfterTheOtherAndThenNone) {
    GuardedImage<Gray8> image({2, 2});
    image(0, 0) = 7;
    image(1, 1) = 9;
    simulated::Lines lines(image.view());
    EXPECT_EQ(lines.size(), (Size{2, 2}));
    EXPECT_TRUE(lines.next()->empty()) << "no frame was begun";
    for (int frame = 0; frame < 2; ++frame) {
        ASSERT_EQ(lines.start(), Status::ok);
        const Result<Span<const std::uint8_t>> first = lines.next();
        ASSERT_EQ(first->size(), 2);
        EXPECT_EQ((*first)[0], 7);
        const Result<Span<const std::uint8_t>> second = lines.next();
        EXPECT_EQ((*second)[1], 9);
        EXPECT_TRUE(lines.next()->empty());
    }
}

TEST(SimulatedLines, LetsTheCallerAskSeveralTimes) {
    GuardedImage<Gray8> image({3, 2});
    simulated::Lines lines(image.view());
    lines.pause = 2;
    ASSERT_EQ(lines.start(), Status::ok);
    for (int y = 0; y < 2; ++y) {
        EXPECT_TRUE(lines.next()->empty());
        EXPECT_TRUE(lines.next()->empty());
        EXPECT_EQ(lines.next()->size(), 3);
    }
}

TEST(SimulatedLines, SpoilsTheFrameWhereALineIsLost) {
    GuardedImage<Gray8> image({3, 3});
    simulated::Lines lines(image.view());
    lines.lost = 1;
    ASSERT_EQ(lines.start(), Status::ok);
    EXPECT_EQ(lines.next()->size(), 3);
    EXPECT_EQ(lines.next().status(), Status::truncated);
    EXPECT_EQ(lines.next().status(), Status::truncated);
    lines.lost = -1;
    ASSERT_EQ(lines.start(), Status::ok);
    for (int y = 0; y < 3; ++y) EXPECT_EQ(lines.next()->size(), 3);
}

TEST(SimulatedLines, RefusesWhileBroken) {
    GuardedImage<Gray8> image({3, 3});
    simulated::Lines lines(image.view());
    lines.broken = true;
    EXPECT_EQ(lines.start(), Status::io_error);
    EXPECT_EQ(lines.next().status(), Status::io_error);
}

}  // namespace
}  // namespace fovea::test
