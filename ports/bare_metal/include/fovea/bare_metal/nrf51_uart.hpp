// SPDX-License-Identifier: MIT
//
// Nrf51Uart: the UART of Nordic's nRF51 (nRF51 Series Reference Manual, ch. 29).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>

namespace fovea::bare_metal {

class Nrf51Uart {
public:
    explicit Nrf51Uart(std::uintptr_t base) : base_(base) {}

    struct Pins {
        std::uint32_t transmit;
        std::uint32_t receive;
    };
    /// rate as the manual's table of BAUDRATE has it: 0x01D7E000 for 115200.
    void start(Pins pins, std::uint32_t rate) {
        word_at(base_ + pin_transmit) = pins.transmit;
        word_at(base_ + pin_receive) = pins.receive;
        word_at(base_ + baud_rate) = rate;
        word_at(base_ + enable) = 4;
        word_at(base_ + start_receiver) = 1;
        word_at(base_ + start_transmitter) = 1;
        sending_ = false;
    }
    bool receive(std::uint8_t& byte) {
        if (word_at(base_ + received) == 0) return false;
        // Cleared before the byte is taken, for taking it brings the next event.
        word_at(base_ + received) = 0;
        byte = static_cast<std::uint8_t>(word_at(base_ + receive_data));
        return true;
    }
    bool send(std::uint8_t byte) {
        if (sending_ && word_at(base_ + sent) == 0) return false;
        word_at(base_ + sent) = 0;
        word_at(base_ + transmit_data) = byte;
        sending_ = true;
        return true;
    }

private:
    static constexpr std::uintptr_t start_receiver = 0x000, start_transmitter = 0x008, received = 0x108,
                                    sent = 0x11C, enable = 0x500, pin_transmit = 0x50C, pin_receive = 0x514,
                                    receive_data = 0x518, transmit_data = 0x51C, baud_rate = 0x524;
    std::uintptr_t base_;
    bool sending_ = false;  // the event of the byte before has not been seen
};

}  // namespace fovea::bare_metal
