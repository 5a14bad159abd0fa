// SPDX-License-Identifier: MIT
//
// FpgaioLed: the user LEDs of Arm's MPS2 and MPS3 boards (AN385 and its like, FPGA system control and I/O).
#pragma once

#include <cstdint>

#include <fovea/bare_metal/register.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/digital_pin.hpp>

namespace fovea::bare_metal {

class FpgaioLed {
public:
    /// The LED is dark at once.
    FpgaioLed(std::uintptr_t base, unsigned number) : base_(base), bit_(1u << number) {
        static_cast<void>(set(false));
    }
    Status set(bool active) {
        if (active)
            word_at(base_) |= bit_;
        else
            word_at(base_) &= ~bit_;
        return Status::ok;
    }

private:
    std::uintptr_t base_;
    std::uint32_t bit_;
};

static_assert(hal::is_output_pin_v<FpgaioLed>);

}  // namespace fovea::bare_metal
