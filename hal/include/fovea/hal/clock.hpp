// SPDX-License-Identifier: MIT
//
// Clock: time that only goes forward, for patience and time stamps. No date.
#pragma once

#include <cstdint>
#include <utility>

#include <fovea/hal/contract.hpp>

namespace fovea::hal {

/// Microseconds since some moment before the first call.
///   std::int64_t microseconds()
/// Never less than the call before gave.
template <class T>
using microseconds_call = decltype(std::declval<T&>().microseconds());
template <class T>
inline constexpr bool is_clock_v = answers_v<std::int64_t, microseconds_call, T>;

}  // namespace fovea::hal
