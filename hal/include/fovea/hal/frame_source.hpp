// SPDX-License-Identifier: MIT
//
// FrameSource: whole frames, lent in the memory where the camera put them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/contract.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea::hal {

/// Rows of a frame; of what is compressed, its bytes with a stride of 0.
struct Plane {
    Span<const std::uint8_t> bytes;
    std::ptrdiff_t stride_bytes = 0;
};

/// What a frame holds. It is whole: a source keeps back what is damaged or cut short, and counts it.
struct FrameInfo {
    PixelFormat format = PixelFormat::none;
    /// Luma of 16..235 for black and white, not 0..255.
    bool narrow_range = false;
    Size size;
    Plane planes[max_planes];
    /// The source's own number.
    std::uint32_t sequence = 0;
    /// When it was taken, in the microseconds of the clock; never later than now.
    std::int64_t time_us = 0;
};

/// What became of the frames of a source since it was opened. Each frame is in one of them.
struct FrameCounters {
    std::uint64_t lent = 0;
    /// Marked by the driver, or shorter than its rows.
    std::uint64_t damaged = 0;
    /// Never seen: holes in the numbering.
    std::uint64_t missed = 0;
    /// Whole, and passed over because a newer one was there, or it was older than what was asked for.
    std::uint64_t passed_over = 0;
};

/// Lends frames in the order the sensor took them.
///   typename T::Frame                                     movable, without copies; info() tells what it
///   holds Status next(std::int64_t patience_us, Frame& frame)   the next frame
///   Status latest(std::int64_t max_age_us, std::int64_t patience_us, Frame& frame)
///                                                         the newest, no older than that when it is lent
///   Status after(std::int64_t moment_us, std::int64_t patience_us, Frame& frame)
///                                                         the first that was wholly taken after that moment
/// What frame held before is given back in any case. timeout: nothing came, ask again.  no_signal: the sensor
/// is silent.  size_mismatch: the sensor sends another size now.  io_error: start the stream again.
/// device_lost: open the source again. Frames die before their source stops. Not for interrupt handlers.
template <class T>
using next_frame_call = decltype(std::declval<T&>().next(std::int64_t{}, std::declval<typename T::Frame&>()));
template <class T>
using latest_frame_call =
    decltype(std::declval<T&>().latest(std::int64_t{}, std::int64_t{}, std::declval<typename T::Frame&>()));
template <class T>
using frame_after_call =
    decltype(std::declval<T&>().after(std::int64_t{}, std::int64_t{}, std::declval<typename T::Frame&>()));
template <class T>
using frame_info_call = decltype(std::declval<const typename T::Frame&>().info());
template <class T>
inline constexpr bool is_frame_source_v =
    answers_v<Status, next_frame_call, T>&& answers_v<Status, latest_frame_call, T>&&
        answers_v<Status, frame_after_call, T>&& answers_v<const FrameInfo&, frame_info_call, T>&&
            std::is_nothrow_move_assignable_v<typename T::Frame> &&
    !std::is_copy_constructible_v<typename T::Frame>;

}  // namespace fovea::hal
