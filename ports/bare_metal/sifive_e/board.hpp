// SPDX-License-Identifier: MIT
//
// SiFive E31 chip on a HiFive1-like board: RV32IMAC, flash beyond 4 MiB, 16 KiB of RAM.
#pragma once

#include <cstdint>

#include <fovea/bare_metal/active_level.hpp>
#include <fovea/bare_metal/machine_timer.hpp>
#include <fovea/bare_metal/polled_stream.hpp>
#include <fovea/bare_metal/semihosting.hpp>
#include <fovea/bare_metal/sifive_pin.hpp>
#include <fovea/bare_metal/sifive_uart.hpp>

namespace fovea::board {

inline constexpr char name[] = "sifive_e";
inline constexpr std::uint32_t clock_hz = 16'000'000;

using Serial = bare_metal::PolledStream<bare_metal::SifiveUart>;

/// The serial line, 115200 bits a second.
inline Serial start_serial() {
    Serial serial(bare_metal::SifiveUart(0x10013000));
    serial.uart().start(138);  // 16 MHz / 115200 - 1
    return serial;
}

using Clock = bare_metal::MachineTimer;
/// The emulated chip counts so fast; one of silicon 32768 times a second.
inline Clock start_clock() { return {0x0200BFF8, 10'000'000}; }

/// Verdicts on pins 19 and 20, the trigger on pin 7; active high.
using OutputPin = bare_metal::SifiveOutput;
using TriggerPin = bare_metal::SifiveInput;
inline OutputPin ok_pin() { return {0x10012000, 19, bare_metal::ActiveLevel::high}; }
inline OutputPin not_ok_pin() { return {0x10012000, 20, bare_metal::ActiveLevel::high}; }
inline TriggerPin trigger_pin() { return {0x10012000, 7, bare_metal::ActiveLevel::high}; }

[[noreturn]] inline void finish(int code) { bare_metal::end_program(code); }

}  // namespace fovea::board
