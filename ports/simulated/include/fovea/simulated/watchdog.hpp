// SPDX-License-Identifier: MIT
//
// Watchdog in memory, for tests of the applications.
#pragma once

#include <cstdint>

#include <fovea/hal/watchdog.hpp>
#include <fovea/simulated/pins.hpp>

namespace fovea::simulated {

/// Barks when it was not fed for longer than its patience, by the time of a clock.
class Watchdog {
public:
    Watchdog(Clock& clock, std::int64_t patience) : clock_(clock), patience_(patience) {}

    void feed() {
        if (barks()) hungry_ = true;
        fed_ = clock_.microseconds();
    }
    /// True from the first time on that the patience was over.
    bool barks() { return hungry_ || clock_.microseconds() - fed_ > patience_; }

private:
    Clock& clock_;
    std::int64_t patience_;
    std::int64_t fed_ = 0;
    bool hungry_ = false;
};

static_assert(hal::is_watchdog_v<Watchdog>);

}  // namespace fovea::simulated
