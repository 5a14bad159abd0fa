// SPDX-License-Identifier: MIT
//
// Digital pins: lines that are active or not. Which level that is, high or low, only the board knows.
#pragma once

#include <utility>

#include <fovea/base/status.hpp>
#include <fovea/hal/contract.hpp>

namespace fovea::hal {

/// An output: a verdict, a light.
///   Status set(bool active)
/// The line keeps what it was set to. io_error: the device refused; the port says why. device_lost: it is
/// gone.
template <class T>
using set_call = decltype(std::declval<T&>().set(bool{}));
template <class T>
inline constexpr bool is_output_pin_v = answers_v<Status, set_call, T>;

/// An input: a switch.
///   Result<bool> active()
/// The level now. io_error as above.
template <class T>
using active_call = decltype(std::declval<T&>().active());
template <class T>
inline constexpr bool is_input_pin_v = answers_v<Result<bool>, active_call, T>;

/// An input that remembers: a trigger, the sync of a camera.
///   Result<bool> take_edge()
/// True if the line has become active since the last call; several times count once. How short a pulse may
/// be, the port tells.
template <class T>
using take_edge_call = decltype(std::declval<T&>().take_edge());
template <class T>
inline constexpr bool is_edge_pin_v = answers_v<Result<bool>, take_edge_call, T>;

}  // namespace fovea::hal
