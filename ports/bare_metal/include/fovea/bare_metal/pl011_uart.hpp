// SPDX-License-Identifier: MIT
//
// Pl011Uart: Arm's PL011 as Stellaris chips have it (PL011 TRM, ch. 3; LM3S6965 data sheet, ch. 12).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>

namespace fovea::bare_metal {

class Pl011Uart {
public:
    explicit Pl011Uart(std::uintptr_t base) : base_(base) {}

    /// 8 bits, no parity, one stop bit, queues on. divider_64 = 64 * clock / (16 * rate), rounded.
    void start(std::uint32_t divider_64) {
        word_at(base_ + control) = 0;
        word_at(base_ + integer_divider) = divider_64 >> 6;
        word_at(base_ + fraction_divider) = divider_64 & 63;
        word_at(base_ + line_control) = 0x70;
        word_at(base_ + control) = 0x301;
    }
    bool receive(std::uint8_t& byte) {
        if ((word_at(base_ + flags) & 0x10) != 0) return false;
        byte = static_cast<std::uint8_t>(word_at(base_ + data));
        return true;
    }
    bool send(std::uint8_t byte) {
        if ((word_at(base_ + flags) & 0x20) != 0) return false;
        word_at(base_ + data) = byte;
        return true;
    }

private:
    static constexpr std::uintptr_t data = 0x00, flags = 0x18, integer_divider = 0x24,
                                    fraction_divider = 0x28, line_control = 0x2C, control = 0x30;
    std::uintptr_t base_;
};

}  // namespace fovea::bare_metal
