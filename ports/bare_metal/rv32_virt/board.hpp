// SPDX-License-Identifier: MIT
//
// The virtual RISC-V board of QEMU, as RV32IMAC: 16 MiB of its RAM, the first of which hold the code. No such
// board can be bought; it has room for tables that no chip has.
#pragma once

#include <cstdint>

#include <fovea/bare_metal/machine_timer.hpp>
#include <fovea/bare_metal/ns16550_uart.hpp>
#include <fovea/bare_metal/polled_stream.hpp>
#include <fovea/bare_metal/register.hpp>

namespace fovea::board {

inline constexpr char name[] = "rv32_virt";
inline constexpr std::uint32_t clock_hz = 10'000'000;

using Serial = bare_metal::PolledStream<bare_metal::Ns16550Uart>;

/// The serial line, 115200 bits a second.
inline Serial start_serial() {
    Serial serial(bare_metal::Ns16550Uart(0x10000000));
    serial.uart().start(1);
    return serial;
}

using Clock = bare_metal::MachineTimer;
inline Clock start_clock() { return {0x0200BFF8, 10'000'000}; }

/// Ends the emulation with an exit code, by a device that is there for it.
[[noreturn]] inline void finish(int code) {
    bare_metal::word_at(0x100000) = code == 0 ? 0x5555u : static_cast<std::uint32_t>(code) << 16 | 0x3333u;
    for (;;) __asm volatile("");  // Clang would take away a loop of nothing
}

}  // namespace fovea::board
