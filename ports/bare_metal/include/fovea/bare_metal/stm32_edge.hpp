// SPDX-License-Identifier: MIT
//
// Stm32Edge: an input of STM32F4 that remembers its edges (RM0090, ch. 9 and 12).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/active_level.hpp>
#include <fovea/bare_metal/register.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/digital_pin.hpp>

namespace fovea::bare_metal {

class Stm32Edge {
public:
    /// port: 0 for A and so on. The clocks of the port and of SYSCFG are the board's to switch on.
    Stm32Edge(unsigned port, unsigned number, ActiveLevel level) : bit_(1u << number) {
        volatile std::uint32_t& route = word_at(0x40013808 + (number & ~3u));
        route = (route & ~(15u << 4 * (number & 3))) | port << 4 * (number & 3);
        word_at(0x40013C00) |= bit_;  // EXTI: not masked
        word_at(level == ActiveLevel::high ? 0x40013C08 : 0x40013C0C) |= bit_;
        word_at(pending) = bit_;
    }
    Result<bool> take_edge() {
        if ((word_at(pending) & bit_) == 0) return false;
        word_at(pending) = bit_;
        return true;
    }

private:
    static constexpr std::uintptr_t pending = 0x40013C14;
    std::uint32_t bit_;
};

static_assert(hal::is_edge_pin_v<Stm32Edge>);

}  // namespace fovea::bare_metal
