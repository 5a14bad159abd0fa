// SPDX-License-Identifier: MIT
//
// The reset of a Cortex-M by its own program (ARMv7-M Architecture Reference Manual, B3.2.6, AIRCR).
#pragma once

#include <fovea/bare_metal/register.hpp>

namespace fovea::bare_metal {

[[noreturn]] inline void restart() {
    word_at(0xE000ED0C) = 0x05FA0004;  // the key, SYSRESETREQ
    // Clang would take away a loop in which nothing happens.
    for (;;) __asm volatile("");
}

}  // namespace fovea::bare_metal
