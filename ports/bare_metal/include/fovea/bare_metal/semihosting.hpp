// SPDX-License-Identifier: MIT
//
// The end of a program that a debugger or an emulator runs. A camera's program never ends.
#pragma once

#include <cstdint>

namespace fovea::bare_metal {

/// Ends with an exit code that the host sees (SYS_EXIT_EXTENDED of Arm's and RISC-V's semihosting
/// specifications). Without a debugger the processor stops here, on Arm by a fault.
[[noreturn]] inline void end_program(int code) {
    // ADP_Stopped_ApplicationExit and the code.
    [[maybe_unused]] const std::uint32_t block[2] = {0x20026u, static_cast<std::uint32_t>(code)};
#if defined(__arm__)
    __asm volatile("movs r0, #0x20\n mov r1, %0\n bkpt 0xAB" : : "r"(block) : "r0", "r1", "memory");
#elif defined(__riscv)
    // The three instructions are the sign, and must lie in one page: hence their alignment.
    __asm volatile(
        "li a0, 0x20\n mv a1, %0\n .balign 16\n .option push\n .option norvc\n"
        "slli x0, x0, 0x1f\n ebreak\n srai x0, x0, 7\n .option pop"
        :
        : "r"(block)
        : "a0", "a1", "memory");
#endif
    for (;;) __asm volatile("");  // Clang would take away a loop of nothing
}

}  // namespace fovea::bare_metal
