// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <fovea/simulated/pins.hpp>

namespace fovea::test {
namespace {

TEST(SimulatedPin, KeepsWhatItWasSetToAndAllBefore) {
    simulated::Pin pin;
    EXPECT_FALSE(*pin.active());
    ASSERT_EQ(pin.set(true), Status::ok);
    EXPECT_TRUE(*pin.active());
    ASSERT_EQ(pin.set(false), Status::ok);
    EXPECT_FALSE(*pin.active());
    EXPECT_EQ(pin.history, (std::vector<bool>{true, false}));
}

TEST(SimulatedPin, RemembersOneEdgeUntilItIsTaken) {
    simulated::Pin pin;
    EXPECT_FALSE(*pin.take_edge());
    for (const bool level : {true, false, true, true, false}) ASSERT_EQ(pin.set(level), Status::ok);
    EXPECT_TRUE(*pin.take_edge());
    EXPECT_FALSE(*pin.take_edge());
    ASSERT_EQ(pin.set(false), Status::ok);
    EXPECT_FALSE(*pin.take_edge());
}

TEST(SimulatedPin, RefusesWhileBroken) {
    simulated::Pin pin;
    ASSERT_EQ(pin.set(true), Status::ok);
    pin.broken = true;
    EXPECT_EQ(pin.set(false), Status::io_error);
    EXPECT_EQ(pin.active().status(), Status::io_error);
    EXPECT_EQ(pin.take_edge().status(), Status::io_error);
    pin.broken = false;
    EXPECT_TRUE(*pin.active());
    EXPECT_TRUE(*pin.take_edge());
}

TEST(SimulatedClock, StandsStillUntilItIsSet) {
    simulated::Clock clock;
    EXPECT_EQ(clock.microseconds(), 0);
    clock.now = 1500;
    EXPECT_EQ(clock.microseconds(), 1500);
}

}  // namespace
}  // namespace fovea::test
