// SPDX-License-Identifier: MIT
//
// ActiveLevel: what a board says of its pins, so that nobody else speaks of high and low.
#pragma once

#include <cstdint>

namespace fovea::bare_metal {

/// The level at which a line is active.
enum class ActiveLevel : std::uint8_t { low, high };

}  // namespace fovea::bare_metal
