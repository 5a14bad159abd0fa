// SPDX-License-Identifier: MIT
//
// Asks a V4L2 device what it can send.
#pragma once

#include <linux/videodev2.h>

#include <cerrno>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linux/camera_mode.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/video_format.hpp>

namespace fovea::linux_port {

namespace detail {

/// Lists of a driver end with EINVAL; one that never ends is cut here.
inline constexpr std::uint32_t longest_listing = 256;

/// Microseconds of a fraction of a second, to the nearest; 0 for what is no time or over half an hour.
constexpr std::int32_t interval_us_of(const v4l2_fract& seconds) {
    if (seconds.denominator == 0) return 0;
    const std::uint64_t us =
        (std::uint64_t{seconds.numerator} * 1000000 + seconds.denominator / 2) / seconds.denominator;
    return us > 2000000000 ? 0 : static_cast<std::int32_t>(us);
}

constexpr Size size_of(std::uint32_t width, std::uint32_t height) {
    const auto side = [](std::uint32_t value) {
        return value > max_image_side ? max_image_side : static_cast<int>(value);
    };
    return {side(width), side(height)};
}

/// How drivers say that a list is at its end, or that they keep none.
constexpr bool ends_list(int got) { return got == -EINVAL || got == -ENOTTY; }

/// The shortest interval between frames of a mode at its largest; 0 where the driver does not say.
template <class System>
Status find_interval(System& system, int file, CameraMode& mode, Fault& fault) {
    for (std::uint32_t k = 0; k < longest_listing; ++k) {
        v4l2_frmivalenum ask{};
        ask.index = k;
        ask.pixel_format = mode.code;
        ask.width = static_cast<std::uint32_t>(mode.largest.width);
        ask.height = static_cast<std::uint32_t>(mode.largest.height);
        const int got = uninterrupted([&] { return system.ioctl(file, VIDIOC_ENUM_FRAMEINTERVALS, &ask); });
        if (ends_list(got)) break;
        if (got < 0) return refused(fault, "VIDIOC_ENUM_FRAMEINTERVALS", got);
        const bool discrete = ask.type == V4L2_FRMIVAL_TYPE_DISCRETE;
        const std::int32_t us = interval_us_of(discrete ? ask.discrete : ask.stepwise.min);
        if (us > 0 && (mode.interval_us == 0 || us < mode.interval_us)) mode.interval_us = us;
        if (!discrete) break;
    }
    return Status::ok;
}

inline Status no_room(Fault& fault, const char* call) {
    return unusable(fault, call, Status::capacity_exceeded,
                    "the camera lists more modes than there is room for");
}

/// The sizes of a format: each a mode.
template <class System>
Status list_sizes(System& system, int file, const VideoFormat& known, ListView<CameraMode> modes,
                  Fault& fault) {
    for (std::uint32_t k = 0; k < longest_listing; ++k) {
        v4l2_frmsizeenum ask{};
        ask.index = k;
        ask.pixel_format = known.code;
        const int got = uninterrupted([&] { return system.ioctl(file, VIDIOC_ENUM_FRAMESIZES, &ask); });
        if (ends_list(got)) break;
        if (got < 0) return refused(fault, "VIDIOC_ENUM_FRAMESIZES", got);
        CameraMode mode;
        mode.code = known.code;
        mode.format = known.format;
        const bool discrete = ask.type == V4L2_FRMSIZE_TYPE_DISCRETE;
        if (discrete) {
            mode.smallest = mode.largest = size_of(ask.discrete.width, ask.discrete.height);
        } else {
            mode.smallest = size_of(ask.stepwise.min_width, ask.stepwise.min_height);
            mode.largest = size_of(ask.stepwise.max_width, ask.stepwise.max_height);
            mode.step = size_of(ask.stepwise.step_width, ask.stepwise.step_height);
        }
        if (mode.smallest.empty() || mode.largest.empty()) continue;
        if (const Status s = find_interval(system, file, mode, fault); s != Status::ok) return s;
        if (modes.push(mode) != Status::ok) return no_room(fault, "VIDIOC_ENUM_FRAMESIZES");
        if (!discrete) break;
    }
    return Status::ok;
}

}  // namespace detail

/// Lists what a device can send in formats that the camera reads, in the order of the driver. A driver that
/// does not list sizes is asked for its present one.
///
/// Errors  capacity_exceeded with the list full; otherwise as the calls say, with the reason in fault
template <class System>
Status list_modes(System& system, int file, std::uint32_t buffer_type, ListView<CameraMode> modes,
                  Fault& fault) {
    modes.clear();
    for (std::uint32_t k = 0; k < detail::longest_listing; ++k) {
        v4l2_fmtdesc ask{};
        ask.index = k;
        ask.type = buffer_type;
        const int got = uninterrupted([&] { return system.ioctl(file, VIDIOC_ENUM_FMT, &ask); });
        if (got == -EINVAL && k > 0) break;
        if (got < 0) return refused(fault, "VIDIOC_ENUM_FMT", got);
        const VideoFormat* const known = find_video_format(ask.pixelformat);
        // A format that is made of another by software costs what nobody says.
        if (known == nullptr || (ask.flags & V4L2_FMT_FLAG_EMULATED) != 0) continue;
        const int before = modes.size();
        if (const Status s = detail::list_sizes(system, file, *known, modes, fault); s != Status::ok)
            return s;
        if (modes.size() > before) continue;
        v4l2_format now{};
        now.type = buffer_type;
        if (uninterrupted([&] { return system.ioctl(file, VIDIOC_G_FMT, &now); }) < 0) continue;
        CameraMode mode;
        mode.code = known->code;
        mode.format = known->format;
        mode.largest = buffer_type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE
                           ? detail::size_of(now.fmt.pix_mp.width, now.fmt.pix_mp.height)
                           : detail::size_of(now.fmt.pix.width, now.fmt.pix.height);
        mode.smallest = mode.largest;
        if (mode.largest.empty()) continue;
        if (modes.push(mode) != Status::ok) return detail::no_room(fault, "VIDIOC_ENUM_FMT");
    }
    return Status::ok;
}

}  // namespace fovea::linux_port
