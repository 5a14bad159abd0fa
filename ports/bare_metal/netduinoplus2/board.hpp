// SPDX-License-Identifier: MIT
//
// Netduino Plus 2: STM32F405, Cortex-M4 at 168 MHz, 1 MiB of flash, 128 KiB of RAM. The emulated one has no
// clock control, and its ports of pins read zero.
#pragma once

#include <cstdint>

#include <fovea/bare_metal/active_level.hpp>
#include <fovea/bare_metal/polled_stream.hpp>
#include <fovea/bare_metal/register.hpp>
#include <fovea/bare_metal/semihosting.hpp>
#include <fovea/bare_metal/stm32_edge.hpp>
#include <fovea/bare_metal/stm32_usart.hpp>
#include <fovea/bare_metal/systick.hpp>

namespace fovea::board {

inline constexpr char name[] = "netduinoplus2";
inline constexpr std::uint32_t clock_hz = 168'000'000;

using Serial = bare_metal::PolledStream<bare_metal::Stm32Usart>;

/// The serial line, 115200 bits a second.
inline Serial start_serial() {
    using bare_metal::word_at;
    word_at(0x40023844) |= 0x10;  // RCC_APB2ENR: USART1 has its clock
    Serial serial(bare_metal::Stm32Usart(0x40011000));
    serial.uart().start(729);  // 84 MHz / 115200
    return serial;
}

using Clock = bare_metal::Systick;
inline Clock start_clock() { return Clock(clock_hz); }

/// The trigger on PA3, active high.
using TriggerPin = bare_metal::Stm32Edge;
inline TriggerPin trigger_pin() {
    bare_metal::word_at(0x40023830) |= 1;       // RCC_AHB1ENR: port A has its clock
    bare_metal::word_at(0x40023844) |= 0x4000;  // RCC_APB2ENR: and so has SYSCFG
    return {0, 3, bare_metal::ActiveLevel::high};
}

[[noreturn]] inline void finish(int code) { bare_metal::end_program(code); }

}  // namespace fovea::board
