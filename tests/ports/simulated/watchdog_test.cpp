// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fovea/simulated/pins.hpp>
#include <fovea/simulated/watchdog.hpp>

namespace fovea::test {
namespace {

TEST(SimulatedWatchdog, BarksWhenItIsHungryAndDoesNotForget) {
    simulated::Clock clock;
    simulated::Watchdog watchdog(clock, 100);
    clock.now = 100;
    EXPECT_FALSE(watchdog.barks());
    watchdog.feed();
    clock.now = 200;
    EXPECT_FALSE(watchdog.barks());
    clock.now = 201;
    EXPECT_TRUE(watchdog.barks());
    watchdog.feed();
    EXPECT_TRUE(watchdog.barks());
}

}  // namespace
}  // namespace fovea::test
