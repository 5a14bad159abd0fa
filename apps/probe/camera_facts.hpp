// SPDX-License-Identifier: MIT
//
// What a camera of Linux says of itself: its modes, its controls, and why a node gives no pictures.
#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/list.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/camera_mode.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/v4l2_camera.hpp>
#include <fovea/linux/video_controls.hpp>

#include <common/text.hpp>
#include <probe/machine.hpp>

namespace fovea::apps {

/// A control as settings can set it.
struct ControlFacts {
    std::string name;  ///< as settings and v4l2-ctl write it
    std::int64_t smallest = 0;
    std::int64_t largest = 0;
    std::uint64_t step = 1;
    std::int64_t otherwise = 0;  ///< its default
    std::int64_t now = 0;
    bool readable = true;              ///< now is known
    bool settable = true;              ///< it holds a number and may be written
    bool inactive = false;             ///< another control has the say for now
    std::vector<std::string> choices;  ///< of a menu: "1 = Manual Mode"
};

struct CameraFacts {
    DeviceNode node;
    std::string card, driver, bus;
    /// False for a node that gives no pictures that can be read; then problem says why.
    bool camera = false;
    std::string problem, advice;
    std::vector<linux_port::CameraMode> modes;
    std::vector<std::string> unread;  ///< formats that cannot be read: "H264 (H.264)"
    std::vector<ControlFacts> controls;
};

/// "YUYV" of a four-character code; "Y16-BE" where the higher byte comes first.
inline std::string code_text(std::uint32_t code) {
    std::string text;
    for (int k = 0; k < 4; ++k) text += static_cast<char>(code >> (8 * k) & 127);
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return one_line(text) + ((code >> 31) != 0 ? "-BE" : "");
}

/// What a driver writes of itself, as one line.
template <std::size_t Bytes>
std::string driver_text(const std::uint8_t (&bytes)[Bytes]) {
    std::string text;
    for (std::size_t k = 0; k < Bytes && bytes[k] != 0; ++k) text += static_cast<char>(bytes[k]);
    return one_line(text);
}

/// "640x480", or "16x16 to 1920x1080 in steps of 8x8".
inline std::string size_text(const linux_port::CameraMode& mode) {
    const auto text = [](Size size) {
        return std::to_string(size.width) + "x" + std::to_string(size.height);
    };
    if (mode.smallest == mode.largest) return text(mode.largest);
    return text(mode.smallest) + " to " + text(mode.largest) +
           (mode.step.width > 1 || mode.step.height > 1 ? " in steps of " + text(mode.step) : "");
}

/// Frames a second, to hundredths; "?" where the driver does not say.
inline std::string rate_text(std::int32_t interval_us) {
    if (interval_us <= 0) return "?";
    return shortest({round_divide(std::int64_t{100000000}, std::int64_t{interval_us}) * 10000});
}

/// "exposure_time_absolute" of "Exposure Time, Absolute".
inline std::string control_name(const char* name) {
    std::string text;
    for (; *name != '\0'; ++name) {
        const char c = *name;
        const bool word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (word)
            text += c;
        else if (!text.empty() && text.back() != '_')
            text += '_';
    }
    while (!text.empty() && text.back() == '_') text.pop_back();
    return small_letters(text);
}

namespace detail {

/// Lists of a driver that never end are cut here.
inline constexpr std::uint32_t most_formats = 256;

/// Raw pictures of a sensor of more than 8 bits: V4L2 names them "10-bit Bayer BGBG/GRGR" and the like.
inline bool is_raw(const std::string& description) { return description.find("Bayer") != std::string::npos; }

template <class System>
void list_controls(System& system, int file, CameraFacts& facts) {
    linux_port::Fault ignored;
    v4l2_query_ext_ctrl about{};
    for (std::uint32_t id = 0; facts.controls.size() < 512; id = about.id) {
        if (linux_port::next_control(system, file, id, about, ignored) != Status::ok) break;
        if (about.type == V4L2_CTRL_TYPE_CTRL_CLASS || (about.flags & V4L2_CTRL_FLAG_DISABLED) != 0) continue;
        ControlFacts control;
        about.name[sizeof about.name - 1] = '\0';
        control.name = control_name(about.name);
        control.smallest = about.minimum;
        control.largest = about.maximum;
        control.step = about.step;
        control.otherwise = about.default_value;
        control.inactive = (about.flags & V4L2_CTRL_FLAG_INACTIVE) != 0;
        control.settable = linux_port::can_be_set(about);
        control.readable = linux_port::control_value(system, file, about, control.now, ignored) == Status::ok;
        const bool names = about.type == V4L2_CTRL_TYPE_MENU;
        for (std::int64_t k = about.minimum; names && k <= about.maximum && k < about.minimum + 64; ++k) {
            v4l2_querymenu item{};
            item.id = about.id;
            item.index = static_cast<std::uint32_t>(k);
            // A menu may have holes.
            if (system.ioctl(file, VIDIOC_QUERYMENU, &item) < 0) continue;
            control.choices.push_back(std::to_string(k) + " = " + driver_text(item.name));
        }
        facts.controls.push_back(control);
    }
}

/// The formats of a node that are no modes of ours. True if one of them is raw.
template <class System>
bool list_unread(System& system, int file, std::uint32_t type, CameraFacts& facts) {
    bool raw = false;
    for (std::uint32_t k = 0; k < most_formats; ++k) {
        v4l2_fmtdesc ask{};
        ask.index = k;
        ask.type = type;
        if (linux_port::uninterrupted([&] { return system.ioctl(file, VIDIOC_ENUM_FMT, &ask); }) < 0) break;
        const bool emulated = (ask.flags & V4L2_FMT_FLAG_EMULATED) != 0;
        if (linux_port::find_video_format(ask.pixelformat) != nullptr && !emulated) continue;
        const std::string description = driver_text(ask.description);
        raw = raw || is_raw(description);
        facts.unread.push_back(code_text(ask.pixelformat) +
                               (description.empty() ? "" : " (" + description + ")"));
    }
    return raw;
}

}  // namespace detail

/// Asks a node. It is open only meanwhile, and nothing of it is changed.
template <class System>
void ask_camera(System system, CameraFacts& facts) {
    linux_port::V4l2Camera<System> camera(system);
    const Status opened = camera.open(facts.node.path.c_str());
    const v4l2_capability& about = camera.capability();
    facts.card = driver_text(about.card);
    facts.driver = driver_text(about.driver);
    facts.bus = driver_text(about.bus_info);
    const auto fail = [&](const linux_port::Fault& fault) {
        facts.problem = fault.error != 0 ? std::string(fault.call) + ": " + linux_port::reason(fault)
                                         : linux_port::reason(fault);
        facts.advice = linux_port::advice(fault);
    };
    if (opened != Status::ok) return fail(camera.fault());
    static List<linux_port::CameraMode, 256> modes;
    const Status listed_modes = camera.modes(modes.view());
    if (listed_modes != Status::ok && listed_modes != Status::capacity_exceeded) return fail(camera.fault());
    facts.modes.assign(modes.begin(), modes.end());
    const std::uint32_t can =
        (about.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? about.device_caps : about.capabilities;
    const bool raw =
        detail::list_unread(system, camera.file(),
                            (can & V4L2_CAP_VIDEO_CAPTURE) != 0 ? V4L2_BUF_TYPE_VIDEO_CAPTURE
                                                                : V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE,
                            facts);
    detail::list_controls(system, camera.file(), facts);
    facts.camera = !facts.modes.empty();
    if (facts.camera) return;
    facts.problem = facts.unread.empty() ? "the driver lists no format"
                                         : "its formats cannot be read: " + listed(facts.unread);
    facts.advice =
        raw ? "these are raw pictures of a sensor: a program as libcamera must make pictures of them"
        : facts.unread.empty() ? "the sensor may not be set up: media-ctl shows what is linked"
                               : "";
}

}  // namespace fovea::apps
