// SPDX-License-Identifier: MIT
//
// Storage: named byte strings that survive the program - recipes, pictures, counters.
#pragma once

#include <cstdint>
#include <utility>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/contract.hpp>

namespace fovea::hal {

/// Keeps byte strings under names.
///   Result<Span<const std::uint8_t>> load(const char* name)
///   Status save(const char* name, Span<const std::uint8_t> bytes)
/// load: the bytes stay valid until the next load() of the same storage or its end. save: all or nothing;
/// after an error the old bytes stand. not_found: no such name.  io_error: the medium refused; the port says
/// why.  buffer_too_small: no room.
template <class T>
using load_call = decltype(std::declval<T&>().load(std::declval<const char*>()));
template <class T>
using save_call = decltype(std::declval<T&>().save(std::declval<const char*>(), Span<const std::uint8_t>{}));
template <class T>
inline constexpr bool is_storage_v =
    answers_v<Result<Span<const std::uint8_t>>, load_call, T>&& answers_v<Status, save_call, T>;

}  // namespace fovea::hal
