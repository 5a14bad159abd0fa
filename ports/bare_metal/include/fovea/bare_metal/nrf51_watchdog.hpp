// SPDX-License-Identifier: MIT
//
// Watchdog of Nordic's nRF51 (nRF51 Series Reference Manual, WDT). The emulator has none: it was compiled and
// never run on hardware.
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>
#include <fovea/hal/watchdog.hpp>

namespace fovea::bare_metal {

class Nrf51Watchdog {
public:
    explicit Nrf51Watchdog(std::uint32_t milliseconds) {
        word_at(base + 0x504) = milliseconds * 32768 / 1000 - 1;  // CRV, in ticks of 32768 Hz
        word_at(base + 0x508) = 1;                                // RREN: the first of eight reload registers
        word_at(base + 0x50C) = 1;                                // CONFIG: runs while the processor sleeps
        word_at(base + 0x000) = 1;                                // TASKS_START; nothing stops it
    }
    void feed() { word_at(base + 0x600) = 0x6E524635; }  // RR[0]

private:
    static constexpr std::uintptr_t base = 0x40010000;
};

static_assert(hal::is_watchdog_v<Nrf51Watchdog>);

}  // namespace fovea::bare_metal
