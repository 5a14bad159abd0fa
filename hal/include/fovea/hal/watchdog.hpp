// SPDX-License-Identifier: MIT
//
// Watchdog: what starts a board anew when its program no longer turns.
#pragma once

#include <utility>

#include <fovea/hal/contract.hpp>

namespace fovea::hal {

/// Runs from its start on.
///   void feed()
/// Starts the patience anew, which the port tells. Who feeds it is the loop of the program, once a turn, and
/// nothing that runs without that loop.
template <class T>
using feed_call = decltype(std::declval<T&>().feed());
template <class T>
inline constexpr bool is_watchdog_v = answers_v<void, feed_call, T>;

}  // namespace fovea::hal
