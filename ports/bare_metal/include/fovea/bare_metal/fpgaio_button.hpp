// SPDX-License-Identifier: MIT
//
// FpgaioButton: the user buttons of Arm's MPS2 boards. The emulator never presses them.
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/digital_pin.hpp>

namespace fovea::bare_metal {

/// Asked, not remembered: an edge counts if the button is found pressed after it was found released.
class FpgaioButton {
public:
    FpgaioButton(std::uintptr_t base, unsigned number) : base_(base), bit_(1u << number) {}

    Result<bool> active() { return pressed(); }
    Result<bool> take_edge() {
        const bool now = pressed();
        const bool edge = now && !was_pressed_;
        was_pressed_ = now;
        return edge;
    }

private:
    bool pressed() const { return (word_at(base_ + 8) & bit_) != 0; }
    std::uintptr_t base_;
    std::uint32_t bit_;
    bool was_pressed_ = false;
};

static_assert(hal::is_input_pin_v<FpgaioButton> && hal::is_edge_pin_v<FpgaioButton>);

}  // namespace fovea::bare_metal
