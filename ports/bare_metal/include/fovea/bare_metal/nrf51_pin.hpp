// SPDX-License-Identifier: MIT
//
// Pins of Nordic's nRF51 (nRF51 Series Reference Manual, ch. 14).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/active_level.hpp>
#include <fovea/bare_metal/register.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/digital_pin.hpp>

namespace fovea::bare_metal {

class Nrf51Output {
public:
    /// The pin is inactive at once.
    Nrf51Output(unsigned number, ActiveLevel level) : bit_(1u << number), level_(level) {
        static_cast<void>(set(false));
        word_at(configuration + 4 * number) = 3;  // output, its level not read back
    }
    Status set(bool active) {
        word_at(active == (level_ == ActiveLevel::high) ? out_set : out_clear) = bit_;
        return Status::ok;
    }

private:
    static constexpr std::uintptr_t out_set = 0x50000508, out_clear = 0x5000050C, configuration = 0x50000700;
    std::uint32_t bit_;
    ActiveLevel level_;
};

/// Asked, not remembered: an edge counts if the line is found active after it was found inactive, so a pulse
/// must be longer than the time between two questions.
class Nrf51Input {
public:
    Nrf51Input(unsigned number, ActiveLevel level) : number_(number), level_(level) {
        word_at(configuration + 4 * number) = 0;  // input, read
        was_active_ = level_now();
    }
    Result<bool> active() { return level_now(); }
    Result<bool> take_edge() {
        const bool now = level_now();
        const bool edge = now && !was_active_;
        was_active_ = now;
        return edge;
    }

private:
    static constexpr std::uintptr_t in = 0x50000510, configuration = 0x50000700;
    bool level_now() const { return ((word_at(in) >> number_ & 1) != 0) == (level_ == ActiveLevel::high); }
    unsigned number_;
    ActiveLevel level_;
    bool was_active_ = false;
};

static_assert(hal::is_output_pin_v<Nrf51Output>);
static_assert(hal::is_input_pin_v<Nrf51Input> && hal::is_edge_pin_v<Nrf51Input>);

}  // namespace fovea::bare_metal
