// SPDX-License-Identifier: MIT
//
// A file that the build was given, in the flash of the program: FOVEA_FLASH_FILE is its name.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>

#ifdef FOVEA_FLASH_FILE
extern "C" const std::uint8_t fovea_flash_file[], fovea_flash_file_end[];
__asm(
    ".section .rodata.fovea_flash_file, \"a\"\n"
    ".global fovea_flash_file, fovea_flash_file_end\n"
    "fovea_flash_file: .incbin \"" FOVEA_FLASH_FILE
    "\"\n"
    "fovea_flash_file_end:\n"
    ".balign 4\n"
    ".text\n");
#endif

namespace fovea::apps {

/// Whether the build was given a file; one without bytes is one too.
constexpr bool has_flash_file() {
#ifdef FOVEA_FLASH_FILE
    return true;
#else
    return false;
#endif
}

/// Empty if the build was given none. Of one source file of a program.
inline Span<const std::uint8_t> flash_file() {
#ifdef FOVEA_FLASH_FILE
    return {fovea_flash_file, fovea_flash_file_end - fovea_flash_file};
#else
    return {};
#endif
}

}  // namespace fovea::apps
