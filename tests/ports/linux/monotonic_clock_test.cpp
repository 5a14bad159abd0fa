// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <time.h>

#include <cstdint>

#include <fovea/linux/monotonic_clock.hpp>

namespace fovea::test {
namespace {

TEST(MonotonicClock, GoesForwardWithTheClockOfTheKernel) {
    linux_port::MonotonicClock clock;
    const auto kernel_us = [] {
        timespec now{};
        ::clock_gettime(CLOCK_MONOTONIC, &now);
        return std::int64_t{now.tv_sec} * 1000000 + now.tv_nsec / 1000;
    };
    std::int64_t before = kernel_us();
    for (int i = 0; i < 1000; ++i) {
        const std::int64_t now = clock.microseconds();
        ASSERT_GE(now, before);
        before = kernel_us();
        ASSERT_LE(now, before);
    }
}

}  // namespace
}  // namespace fovea::test
