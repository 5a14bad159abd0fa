// SPDX-License-Identifier: MIT
//
// Pins of SiFive's E31 chips (FE310-G002 manual, ch. 17).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/active_level.hpp>
#include <fovea/bare_metal/register.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/digital_pin.hpp>

namespace fovea::bare_metal {

class SifiveOutput {
public:
    /// The pin is inactive at once.
    SifiveOutput(std::uintptr_t base, unsigned number, ActiveLevel level)
        : value_(base + 0x0C), bit_(1u << number), level_(level) {
        static_cast<void>(set(false));
        word_at(base + 0x08) |= bit_;
    }
    Status set(bool active) {
        if (active == (level_ == ActiveLevel::high))
            word_at(value_) |= bit_;
        else
            word_at(value_) &= ~bit_;
        return Status::ok;
    }

private:
    std::uintptr_t value_;
    std::uint32_t bit_;
    ActiveLevel level_;
};

class SifiveInput {
public:
    SifiveInput(std::uintptr_t base, unsigned number, ActiveLevel level)
        : base_(base),
          pending_(base + (level == ActiveLevel::high ? 0x1C : 0x24)),
          bit_(1u << number),
          level_(level) {
        word_at(base + 0x04) |= bit_;
        // Edges are remembered where their interrupt is enabled; the controller of interrupts does not let it
        // through.
        word_at(base + (level == ActiveLevel::high ? 0x18 : 0x20)) |= bit_;
        word_at(pending_) = bit_;
    }
    Result<bool> active() { return ((word_at(base_) & bit_) != 0) == (level_ == ActiveLevel::high); }
    Result<bool> take_edge() {
        if ((word_at(pending_) & bit_) == 0) return false;
        word_at(pending_) = bit_;
        return true;
    }

private:
    std::uintptr_t base_;
    std::uintptr_t pending_;
    std::uint32_t bit_;
    ActiveLevel level_;
};

static_assert(hal::is_output_pin_v<SifiveOutput>);
static_assert(hal::is_input_pin_v<SifiveInput> && hal::is_edge_pin_v<SifiveInput>);

}  // namespace fovea::bare_metal
