// SPDX-License-Identifier: MIT
//
// The registers of a device, by address.
#pragma once

#include <cstdint>

namespace fovea::bare_metal {

/// A register of 32 bits. Every use is one access of that width.
inline volatile std::uint32_t& word_at(std::uintptr_t address) {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
}

/// A register of 8 bits.
inline volatile std::uint8_t& byte_at(std::uintptr_t address) {
    return *reinterpret_cast<volatile std::uint8_t*>(address);
}

}  // namespace fovea::bare_metal
