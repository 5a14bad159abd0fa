// SPDX-License-Identifier: MIT
//
// The vector table and the first instructions of any Cortex-M (ARMv6-M, v7-M and v8-M Architecture Reference
// Manuals, exception model).
#include <cstdint>

#include <fovea/bare_metal/memory_layout.hpp>
#include <fovea/bare_metal/register.hpp>
#include <fovea/bare_metal/systick.hpp>

extern "C" {
[[noreturn]] void fovea_start();
[[noreturn]] void fovea_fault();

[[noreturn]] void fovea_reset() {
#if defined(__ARM_FEATURE_MVE) || defined(__ARM_FP)
    // CPACR: the registers of vectors and floats may be used. Before anything that could.
    fovea::bare_metal::word_at(0xE000ED88) |= 0xFu << 20;
    __asm volatile("dsb\n isb" ::: "memory");
#endif
    fovea_start();
}

// The clock of systick.hpp; without one it never comes.
void fovea_systick() { fovea::bare_metal::count_millisecond(); }
}

using Handler = void (*)();
struct VectorTable {
    std::uint32_t* stack_top;
    Handler handlers[15];
};

// What is not used faults: a spurious interrupt must not go unseen.
extern "C" {
extern const VectorTable fovea_vectors;
[[gnu::section(".vectors"), gnu::used]] const VectorTable fovea_vectors = {
    fovea_stack_top,
    {fovea_reset, fovea_fault, fovea_fault, fovea_fault, fovea_fault, fovea_fault, fovea_fault, fovea_fault,
     nullptr, nullptr, fovea_fault, fovea_fault, nullptr, fovea_fault, fovea_systick},
};
}
