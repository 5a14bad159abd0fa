// SPDX-License-Identifier: MIT
//
// SifiveUart: the UART of SiFive's E31 chips (FE310-G002 manual, ch. 18).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>

namespace fovea::bare_metal {

class SifiveUart {
public:
    explicit SifiveUart(std::uintptr_t base) : base_(base) {}

    /// divider = clock over the rate, less one.
    void start(std::uint32_t divider) {
        word_at(base_ + baud_divider) = divider;
        word_at(base_ + transmit_control) = 1;
        word_at(base_ + receive_control) = 1;
    }
    bool receive(std::uint8_t& byte) {
        // Looking takes the byte.
        const std::uint32_t data = word_at(base_ + receive_data);
        if ((data & empty) != 0) return false;
        byte = static_cast<std::uint8_t>(data);
        return true;
    }
    bool send(std::uint8_t byte) {
        if ((word_at(base_ + transmit_data) & full) != 0) return false;
        word_at(base_ + transmit_data) = byte;
        return true;
    }

private:
    static constexpr std::uintptr_t transmit_data = 0x00, receive_data = 0x04, transmit_control = 0x08,
                                    receive_control = 0x0C, baud_divider = 0x18;
    static constexpr std::uint32_t empty = 1u << 31, full = 1u << 31;
    std::uintptr_t base_;
};

}  // namespace fovea::bare_metal
