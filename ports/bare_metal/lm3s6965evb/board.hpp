// SPDX-License-Identifier: MIT
//
// Stellaris LM3S6965 evaluation board: Cortex-M3, 256 KiB of flash, 64 KiB of RAM.
#pragma once

#include <cstdint>

#include <fovea/bare_metal/active_level.hpp>
#include <fovea/bare_metal/cmsdk_watchdog.hpp>
#include <fovea/bare_metal/pl011_uart.hpp>
#include <fovea/bare_metal/pl061_pin.hpp>
#include <fovea/bare_metal/polled_stream.hpp>
#include <fovea/bare_metal/register.hpp>
#include <fovea/bare_metal/semihosting.hpp>
#include <fovea/bare_metal/systick.hpp>

namespace fovea::board {

inline constexpr char name[] = "lm3s6965evb";
inline constexpr std::uint32_t clock_hz = 12'500'000;

using Serial = bare_metal::PolledStream<bare_metal::Pl011Uart>;

/// The serial line, 115200 bits a second.
inline Serial start_serial() {
    using bare_metal::word_at;
    word_at(0x400FE104) |= 1;     // RCGC1: the UART has its clock
    word_at(0x400FE108) |= 0x7F;  // RCGC2: and so do the ports A to G
    word_at(0x40004420) |= 3;     // PA0 and PA1 are the UART's
    word_at(0x4000451C) |= 3;     // and digital
    Serial serial(bare_metal::Pl011Uart(0x4000C000));
    serial.uart().start(434);  // 64 * 12.5 MHz / (16 * 115200)
    return serial;
}

using Clock = bare_metal::Systick;
inline Clock start_clock() { return Clock(clock_hz); }

/// Verdicts on PB0 and PB1, the trigger on PE2; active high.
using OutputPin = bare_metal::Pl061Output;
using TriggerPin = bare_metal::Pl061Input;
inline OutputPin ok_pin() { return {0x40005000, 0, bare_metal::ActiveLevel::high}; }
inline OutputPin not_ok_pin() { return {0x40005000, 1, bare_metal::ActiveLevel::high}; }
inline TriggerPin trigger_pin() { return {0x40024000, 2, bare_metal::ActiveLevel::high}; }

/// Bites after twice 1.5 seconds.
using Watchdog = bare_metal::CmsdkWatchdog;
inline Watchdog start_watchdog() {
    bare_metal::word_at(0x400FE100) |= 1u << 3;  // RCGC0: it has its clock
    return {0x40000000, clock_hz / 2 * 3};
}

[[noreturn]] inline void finish(int code) { bare_metal::end_program(code); }

}  // namespace fovea::board
