// SPDX-License-Identifier: MIT
//
// Stm32Usart: the USART of STM32F4 (RM0090, ch. 30).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>

namespace fovea::bare_metal {

class Stm32Usart {
public:
    explicit Stm32Usart(std::uintptr_t base) : base_(base) {}

    /// divider = clock of the bus over the rate; the clock and the pins are the board's to switch on.
    void start(std::uint32_t divider) {
        word_at(base_ + baud_rate) = divider;
        word_at(base_ + control) = 0x200C;  // on, transmitter and receiver
    }
    bool receive(std::uint8_t& byte) {
        if ((word_at(base_ + state) & 0x20) == 0) return false;
        byte = static_cast<std::uint8_t>(word_at(base_ + data));
        return true;
    }
    bool send(std::uint8_t byte) {
        if ((word_at(base_ + state) & 0x80) == 0) return false;
        word_at(base_ + data) = byte;
        return true;
    }

private:
    static constexpr std::uintptr_t state = 0x00, data = 0x04, baud_rate = 0x08, control = 0x0C;
    std::uintptr_t base_;
};

}  // namespace fovea::bare_metal
