// SPDX-License-Identifier: MIT
//
// Watchdog of Arm's CMSDK, which Stellaris chips have too (Cortex-M System Design Kit Technical Reference
// Manual, APB watchdog; LM3S6965 data sheet, Watchdog Timer).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>
#include <fovea/hal/watchdog.hpp>

namespace fovea::bare_metal {

/// After the patience its interrupt comes, which is the non-maskable one on MPS2 boards; after it once more,
/// the reset.
class CmsdkWatchdog {
public:
    /// base of the device; patience in ticks of its clock.
    CmsdkWatchdog(std::uintptr_t base, std::uint32_t ticks) : base_(base) {
        word_at(base_ + lock) = unlocked;
        word_at(base_ + load) = ticks;
        word_at(base_ + control) = 3;  // interrupt, which starts it, and reset
        word_at(base_ + lock) = 0;
    }
    void feed() {
        word_at(base_ + lock) = unlocked;
        word_at(base_ + clear) = 1;  // counts from the start again
        word_at(base_ + lock) = 0;
    }

private:
    static constexpr std::uintptr_t load = 0, control = 8, clear = 0xC, lock = 0xC00;
    static constexpr std::uint32_t unlocked = 0x1ACCE551;
    std::uintptr_t base_;
};

static_assert(hal::is_watchdog_v<CmsdkWatchdog>);

}  // namespace fovea::bare_metal
