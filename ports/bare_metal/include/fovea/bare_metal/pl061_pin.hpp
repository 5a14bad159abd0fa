// SPDX-License-Identifier: MIT
//
// Pins of Arm's PL061 as Stellaris chips have it (LM3S6965 data sheet, ch. 8).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/active_level.hpp>
#include <fovea/bare_metal/register.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/digital_pin.hpp>

namespace fovea::bare_metal {

class Pl061Output {
public:
    /// base of the port, number of the pin in it. The pin is inactive at once.
    Pl061Output(std::uintptr_t base, unsigned number, ActiveLevel level)
        : data_(base + (4u << number)), bit_(1u << number), level_(level) {
        word_at(base + 0x51C) |= bit_;  // digital
        word_at(base + 0x400) |= bit_;  // output
        static_cast<void>(set(false));
    }
    Status set(bool active) {
        // Bits 2 to 9 of the address say which pins a write reaches.
        word_at(data_) = active == (level_ == ActiveLevel::high) ? bit_ : 0;
        return Status::ok;
    }

private:
    std::uintptr_t data_;
    std::uint32_t bit_;
    ActiveLevel level_;
};

class Pl061Input {
public:
    Pl061Input(std::uintptr_t base, unsigned number, ActiveLevel level)
        : base_(base), bit_(1u << number), level_(level) {
        word_at(base + 0x51C) |= bit_;   // digital
        word_at(base + 0x400) &= ~bit_;  // input
        word_at(base + 0x404) &= ~bit_;  // edges, not levels
        word_at(base + 0x408) &= ~bit_;  // of one direction
        if (level == ActiveLevel::high)
            word_at(base + 0x40C) |= bit_;
        else
            word_at(base + 0x40C) &= ~bit_;
        word_at(base + clear) = bit_;
    }
    Result<bool> active() { return ((word_at(base_ + 0x3FC) & bit_) != 0) == (level_ == ActiveLevel::high); }
    Result<bool> take_edge() {
        if ((word_at(base_ + happened) & bit_) == 0) return false;
        word_at(base_ + clear) = bit_;
        return true;
    }

private:
    static constexpr std::uintptr_t happened = 0x414, clear = 0x41C;
    std::uintptr_t base_;
    std::uint32_t bit_;
    ActiveLevel level_;
};

static_assert(hal::is_output_pin_v<Pl061Output>);
static_assert(hal::is_input_pin_v<Pl061Input> && hal::is_edge_pin_v<Pl061Input>);

}  // namespace fovea::bare_metal
