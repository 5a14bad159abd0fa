// SPDX-License-Identifier: MIT
//
// CmsdkUart: the UART of Arm's MPS2 and MPS3 boards (Cortex-M System Design Kit TRM, sec. 4.3).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>

namespace fovea::bare_metal {

class CmsdkUart {
public:
    explicit CmsdkUart(std::uintptr_t base) : base_(base) {}

    /// divider = clock of the device over the rate, 16 or more.
    void start(std::uint32_t divider) {
        word_at(base_ + baud_divider) = divider;
        word_at(base_ + control) = 3;  // transmitter and receiver
    }
    bool receive(std::uint8_t& byte) {
        if ((word_at(base_ + state) & 2) == 0) return false;
        byte = static_cast<std::uint8_t>(word_at(base_ + data));
        return true;
    }
    bool send(std::uint8_t byte) {
        if ((word_at(base_ + state) & 1) != 0) return false;
        word_at(base_ + data) = byte;
        return true;
    }

private:
    static constexpr std::uintptr_t data = 0x00, state = 0x04, control = 0x08, baud_divider = 0x10;
    std::uintptr_t base_;
};

}  // namespace fovea::bare_metal
