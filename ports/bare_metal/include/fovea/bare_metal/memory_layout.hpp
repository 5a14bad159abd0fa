// SPDX-License-Identifier: MIT
//
// Where startup/sections.ld has laid what, and how deep the stack has been.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {
extern std::uint32_t fovea_data_load[], fovea_data_start[], fovea_data_end[];
extern std::uint32_t fovea_bss_start[], fovea_bss_end[];
extern std::uint32_t fovea_stack_limit[], fovea_stack_top[];
}

namespace fovea::bare_metal {

/// What startup fills the stack with.
inline constexpr std::uint32_t stack_paint = 0xC0FFEE55u;

/// Bytes of the stack that were ever used: from its top to the last word that is no longer paint.
inline std::ptrdiff_t deepest_stack() {
    const std::uint32_t* word = fovea_stack_limit;
    while (word < fovea_stack_top && *word == stack_paint) ++word;
    return static_cast<std::ptrdiff_t>(sizeof(std::uint32_t)) * (fovea_stack_top - word);
}

}  // namespace fovea::bare_metal
