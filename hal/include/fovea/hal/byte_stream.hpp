// SPDX-License-Identifier: MIT
//
// ByteStream: bytes in and out, in order, without waiting - a UART, a USB serial port, a socket.
#pragma once

#include <cstdint>
#include <utility>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/contract.hpp>

namespace fovea::hal {

/// Takes and gives bytes as far as they go at once.
///   Result<int> read(Span<std::uint8_t> into)
///   Result<int> write(Span<const std::uint8_t> bytes)
/// read: how many came, 0 where nothing has arrived. write: how many were taken, 0 where there is no room;
/// the caller keeps the rest. Neither waits. io_error: the device refused; the port says why. device_lost: it
/// is gone, with all that was written and not sent yet.
template <class T>
using read_call = decltype(std::declval<T&>().read(Span<std::uint8_t>{}));
template <class T>
using write_call = decltype(std::declval<T&>().write(Span<const std::uint8_t>{}));
template <class T>
inline constexpr bool is_byte_stream_v =
    answers_v<Result<int>, read_call, T>&& answers_v<Result<int>, write_call, T>;

}  // namespace fovea::hal
