// SPDX-License-Identifier: MIT
//
// From reset to main(), the same for every board.
#include <cstdint>

#include <board.hpp>
#include <fovea/bare_metal/memory_layout.hpp>

extern "C" {

// C++ forbids to call main() by its name.
int fovea_main() __asm("main");

/// What a fault ends in. A product has its own, which makes its outputs safe and starts again.
[[gnu::weak, noreturn]] void fovea_fault() { fovea::board::finish(99); }

/// Memory as C++ expects it, then main(). The processor's own start has set the stack pointer.
[[noreturn]] void fovea_start() {
    const std::uint32_t* load = fovea_data_load;
    for (std::uint32_t* word = fovea_data_start; word < fovea_data_end;) *word++ = *load++;
    for (std::uint32_t* word = fovea_bss_start; word < fovea_bss_end;) *word++ = 0;
    // Painted up to a little below the frame of this function.
    const auto* frame = static_cast<std::uint32_t*>(__builtin_frame_address(0)) - 16;
    for (volatile std::uint32_t* word = fovea_stack_limit; word < frame;)
        *word++ = fovea::bare_metal::stack_paint;
    fovea::board::finish(fovea_main());
}
}
