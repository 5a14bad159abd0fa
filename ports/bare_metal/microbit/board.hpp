// SPDX-License-Identifier: MIT
//
// BBC micro:bit (first version): nRF51822, Cortex-M0 at 16 MHz, 256 KiB of flash, 16 KiB of RAM.
#pragma once

#include <cstdint>

#include <fovea/bare_metal/active_level.hpp>
#include <fovea/bare_metal/nrf51_pin.hpp>
#include <fovea/bare_metal/nrf51_uart.hpp>
#include <fovea/bare_metal/nrf51_watchdog.hpp>
#include <fovea/bare_metal/polled_stream.hpp>
#include <fovea/bare_metal/semihosting.hpp>
#include <fovea/bare_metal/systick.hpp>

namespace fovea::board {

inline constexpr char name[] = "microbit";
inline constexpr std::uint32_t clock_hz = 16'000'000;

using Serial = bare_metal::PolledStream<bare_metal::Nrf51Uart>;

/// The serial line, 115200 bits a second.
inline Serial start_serial() {
    Serial serial(bare_metal::Nrf51Uart(0x40002000));
    serial.uart().start({24, 25}, 0x01D7E000);  // TX, RX; 115200
    return serial;
}

using Clock = bare_metal::Systick;
inline Clock start_clock() { return Clock(clock_hz); }

/// Verdicts and trigger on pins 0, 1 and 2 of the edge connector (P0.03, P0.02, P0.01), active high.
using OutputPin = bare_metal::Nrf51Output;
using TriggerPin = bare_metal::Nrf51Input;
inline OutputPin ok_pin() { return {3, bare_metal::ActiveLevel::high}; }
inline OutputPin not_ok_pin() { return {2, bare_metal::ActiveLevel::high}; }
inline TriggerPin trigger_pin() { return {1, bare_metal::ActiveLevel::high}; }

/// Bites after 3 seconds.
using Watchdog = bare_metal::Nrf51Watchdog;
inline Watchdog start_watchdog() { return Watchdog(3000); }

[[noreturn]] inline void finish(int code) { bare_metal::end_program(code); }

}  // namespace fovea::board
