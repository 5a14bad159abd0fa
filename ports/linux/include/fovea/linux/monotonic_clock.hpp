// SPDX-License-Identifier: MIT
//
// MonotonicClock: the clock by which the kernel stamps frames and edges. Setting the date does not move it.
#pragma once

#include <cstdint>

#include <fovea/hal/clock.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

/// Microseconds since the start of the system, without those in which it slept.
template <class System = Kernel>
class MonotonicClock {
public:
    explicit MonotonicClock(System system = {}) : system_(system) {}

    std::int64_t microseconds() { return system_.monotonic_us(); }

private:
    System system_;
};

static_assert(hal::is_clock_v<MonotonicClock<>>);

}  // namespace fovea::linux_port
