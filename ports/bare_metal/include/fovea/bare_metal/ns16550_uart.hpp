// SPDX-License-Identifier: MIT
//
// Ns16550Uart: the UART of PCs, here with its registers a byte apart (PC16550D data sheet).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>

namespace fovea::bare_metal {

class Ns16550Uart {
public:
    explicit Ns16550Uart(std::uintptr_t base) : base_(base) {}

    /// 8 bits, no parity, one stop bit, queues on. divider = clock / (16 * rate).
    void start(std::uint32_t divider) {
        byte_at(base_ + line_control) = 0x83;
        byte_at(base_ + data) = static_cast<std::uint8_t>(divider);
        byte_at(base_ + interrupts) = static_cast<std::uint8_t>(divider >> 8);
        byte_at(base_ + line_control) = 0x03;
        byte_at(base_ + queue_control) = 0x07;
    }
    bool receive(std::uint8_t& byte) {
        if ((byte_at(base_ + line_state) & 1) == 0) return false;
        byte = byte_at(base_ + data);
        return true;
    }
    bool send(std::uint8_t byte) {
        if ((byte_at(base_ + line_state) & 0x20) == 0) return false;
        byte_at(base_ + data) = byte;
        return true;
    }

private:
    static constexpr std::uintptr_t data = 0, interrupts = 1, queue_control = 2, line_control = 3,
                                    line_state = 5;
    std::uintptr_t base_;
};

}  // namespace fovea::bare_metal
