// SPDX-License-Identifier: MIT
//
// Arm's MPS3 with image AN547: Cortex-M55, 2 MiB for code and 2 MiB for data. Addresses are
// those of the secure state, in which the processor starts.
#pragma once

#include <cstdint>

#include <fovea/bare_metal/cmsdk_uart.hpp>
#include <fovea/bare_metal/fpgaio_led.hpp>
#include <fovea/bare_metal/polled_stream.hpp>
#include <fovea/bare_metal/semihosting.hpp>
#include <fovea/bare_metal/systick.hpp>

namespace fovea::board {

inline constexpr char name[] = "mps3_an547";
inline constexpr std::uint32_t clock_hz = 32'000'000;

using Serial = bare_metal::PolledStream<bare_metal::CmsdkUart>;

/// The serial line, 115200 bits a second.
inline Serial start_serial() {
    Serial serial(bare_metal::CmsdkUart(0x59303000));
    serial.uart().start(277);  // 32 MHz / 115200
    return serial;
}

using Clock = bare_metal::Systick;
inline Clock start_clock() { return Clock(clock_hz); }

/// Verdicts on the two user LEDs.
using OutputPin = bare_metal::FpgaioLed;
inline OutputPin ok_pin() { return {0x59302000, 0}; }
inline OutputPin not_ok_pin() { return {0x59302000, 1}; }

[[noreturn]] inline void finish(int code) { bare_metal::end_program(code); }

}  // namespace fovea::board
