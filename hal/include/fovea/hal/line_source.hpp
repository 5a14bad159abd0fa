// SPDX-License-Identifier: MIT
//
// LineSource: a frame line by line, as a sensor sends it - for chips that cannot hold a frame.
#pragma once

#include <cstdint>
#include <utility>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/contract.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea::hal {

/// Lends the lines of a frame from top to bottom.
///   Size size()
///   Status start()
///   Result<Span<const std::uint8_t>> next()
/// size: of every frame, in pixels. start: waits for the top of a frame, so that the line that comes next is
/// its first; what has not been taken of the frame before is gone. next: the bytes of the line, aligned as
/// its pixels are and good until the next call; none where it has not arrived yet, or the frame is at its
/// end. None of them keeps the caller. truncated: a line was lost or came too late, and nothing more of this
/// frame comes: start() the next one. io_error: the sensor refused; the port says why.
template <class T>
using frame_size_call = decltype(std::declval<T&>().size());
template <class T>
using start_frame_call = decltype(std::declval<T&>().start());
template <class T>
using next_line_call = decltype(std::declval<T&>().next());
template <class T>
inline constexpr bool is_line_source_v = answers_v<Size, frame_size_call, T>&&
    answers_v<Status, start_frame_call, T>&& answers_v<Result<Span<const std::uint8_t>>, next_line_call, T>;

}  // namespace fovea::hal
