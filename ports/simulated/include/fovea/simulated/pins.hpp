// SPDX-License-Identifier: MIT
//
// Pins and a clock in memory, for tests of the applications.
#pragma once

#include <cstdint>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/hal/clock.hpp>
#include <fovea/hal/digital_pin.hpp>

namespace fovea::simulated {

/// A line that remembers all it was set to. While `broken`, it answers io_error.
class Pin {
public:
    Status set(bool level) {
        if (broken) return Status::io_error;
        if (level && !now_) edge_ = true;
        now_ = level;
        history.push_back(level);
        return Status::ok;
    }
    Result<bool> active() {
        if (broken) return Status::io_error;
        return now_;
    }
    Result<bool> take_edge() {
        if (broken) return Status::io_error;
        const bool edge = edge_;
        edge_ = false;
        return edge;
    }

    std::vector<bool> history;
    bool broken = false;

private:
    bool now_ = false;
    bool edge_ = false;
};

static_assert(hal::is_output_pin_v<Pin> && hal::is_input_pin_v<Pin> && hal::is_edge_pin_v<Pin>);

/// Time that passes when a test says so, and by a step with every question.
class Clock {
public:
    std::int64_t microseconds() { return now += step; }

    std::int64_t now = 0;
    std::int64_t step = 0;
};

static_assert(hal::is_clock_v<Clock>);

}  // namespace fovea::simulated
