// SPDX-License-Identifier: MIT
//
// Arm's MPS2 with image AN386: Cortex-M4, 4 MiB for code and 4 MiB for data.
#pragma once

#include <cstdint>

#include <fovea/bare_metal/cmsdk_uart.hpp>
#include <fovea/bare_metal/cmsdk_watchdog.hpp>
#include <fovea/bare_metal/fpgaio_button.hpp>
#include <fovea/bare_metal/fpgaio_led.hpp>
#include <fovea/bare_metal/polled_stream.hpp>
#include <fovea/bare_metal/semihosting.hpp>
#include <fovea/bare_metal/systick.hpp>

namespace fovea::board {

inline constexpr char name[] = "mps2_an386";
inline constexpr std::uint32_t clock_hz = 25'000'000;

using Serial = bare_metal::PolledStream<bare_metal::CmsdkUart>;

/// The serial line, 115200 bits a second.
inline Serial start_serial() {
    Serial serial(bare_metal::CmsdkUart(0x40004000));
    serial.uart().start(217);  // 25 MHz / 115200
    return serial;
}

using Clock = bare_metal::Systick;
inline Clock start_clock() { return Clock(clock_hz); }

/// Verdicts on the two user LEDs, the trigger on the first user button.
using OutputPin = bare_metal::FpgaioLed;
using TriggerPin = bare_metal::FpgaioButton;
inline OutputPin ok_pin() { return {0x40028000, 0}; }
inline OutputPin not_ok_pin() { return {0x40028000, 1}; }
inline TriggerPin trigger_pin() { return {0x40028000, 0}; }

/// Bites after twice half as many seconds.
using Watchdog = bare_metal::CmsdkWatchdog;
inline Watchdog start_watchdog(std::uint32_t seconds = 3) { return {0x40008000, clock_hz / 2 * seconds}; }

[[noreturn]] inline void finish(int code) { bare_metal::end_program(code); }

}  // namespace fovea::board
