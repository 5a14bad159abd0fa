// SPDX-License-Identifier: MIT
//
// MachineTimer: the clock of a RISC-V chip (RISC-V Privileged Architecture, sec. 3.2.1; FE310-G002 manual,
// ch. 9).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>
#include <fovea/hal/clock.hpp>

namespace fovea::bare_metal {

class MachineTimer {
public:
    /// address of mtime, and how often it counts in a second.
    MachineTimer(std::uintptr_t address, std::uint32_t rate) : address_(address), rate_(rate) {}

    std::int64_t microseconds() {
        // The upper half must not change between the two.
        std::uint32_t high = word_at(address_ + 4);
        std::uint32_t low = word_at(address_);
        for (std::uint32_t again = word_at(address_ + 4); again != high; again = word_at(address_ + 4)) {
            high = again;
            low = word_at(address_);
        }
        const std::uint64_t ticks = std::uint64_t{high} << 32 | low;
        const std::uint64_t seconds = ticks / rate_;
        return static_cast<std::int64_t>(seconds * 1000000 + (ticks - seconds * rate_) * 1000000 / rate_);
    }

private:
    std::uintptr_t address_;
    std::uint32_t rate_;
};

static_assert(hal::is_clock_v<MachineTimer>);

}  // namespace fovea::bare_metal
