// SPDX-License-Identifier: MIT
//
// The first instructions of a RISC-V processor in machine mode (RISC-V Privileged Architecture, ch. 3).
extern "C" {
[[noreturn]] void fovea_start();
[[noreturn]] void fovea_fault();

/// Where traps lead: its address must be a multiple of four.
[[gnu::aligned(4), noreturn]] void fovea_trap() { fovea_fault(); }

[[gnu::naked, gnu::section(".init"), noreturn]] void fovea_reset() {
    __asm volatile(
        "la sp, fovea_stack_top\n"
        "la t0, fovea_trap\n"
        "csrw mtvec, t0\n"
        "j fovea_start");
}
}
