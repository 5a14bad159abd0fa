// SPDX-License-Identifier: MIT
//
// The controls of a V4L2 device by the names that its driver gives them: exposure, gain, white balance.
#pragma once

#include <linux/videodev2.h>

#include <cerrno>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

/// A value for a control, and what became of it.
struct ControlSetting {
    /// As v4l2-ctl and drivers write it: "exposure_time_absolute", "Exposure Time, Absolute".
    const char* name = "";
    std::int64_t value = 0;

    /// ok: the device has the value. not_found: it has no such control. bad_argument: nothing can be set
    /// there. out_of_range: it takes smallest to largest in steps. irregular: it took the value and answers
    /// `now`. Otherwise as the calls say.
    Status status = Status::undecided;
    std::int64_t now = 0;
    std::int64_t smallest = 0;
    std::int64_t largest = 0;
    std::uint64_t step = 1;
    /// Has no effect for now: another control, such as an automatic mode, has the say.
    bool inactive = false;
};

/// True if a name means a control: letters and digits agree in any case, and whatever else lies between them.
constexpr bool names_control(const char* name, const char* control) {
    const auto is_word = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    };
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    for (bool began = false;; began = true) {
        const bool gap_here = *name != '\0' && !is_word(*name);
        const bool gap_there = *control != '\0' && !is_word(*control);
        while (*name != '\0' && !is_word(*name)) ++name;
        while (*control != '\0' && !is_word(*control)) ++control;
        if (*name == '\0' || *control == '\0') return *name == *control;
        if (began && gap_here != gap_there) return false;
        if (lower(*name++) != lower(*control++)) return false;
    }
}

namespace detail {

/// True for a control that chooses who has the say over others: it is set first.
constexpr bool is_automatic(const v4l2_query_ext_ctrl& control) {
    if (control.type != V4L2_CTRL_TYPE_BOOLEAN && control.type != V4L2_CTRL_TYPE_MENU) return false;
    for (const char* c = control.name; *c != '\0'; ++c) {
        const char* word = "auto";
        const char* at = c;
        while (*word != '\0' && (*at == *word || *at == *word - 'a' + 'A')) ++at, ++word;
        if (*word == '\0') return true;
    }
    return false;
}

constexpr bool holds_number(const v4l2_query_ext_ctrl& control) {
    switch (control.type) {
        case V4L2_CTRL_TYPE_INTEGER:
        case V4L2_CTRL_TYPE_BOOLEAN:
        case V4L2_CTRL_TYPE_MENU:
        case V4L2_CTRL_TYPE_INTEGER_MENU:
        case V4L2_CTRL_TYPE_BITMASK:
        case V4L2_CTRL_TYPE_INTEGER64: return control.nr_of_dims == 0;
        default: return false;
    }
}

/// Reads or writes the value of a control.
template <class System>
int exchange_value(System& system, int file, unsigned long request, const v4l2_query_ext_ctrl& about,
                   std::int64_t& value) {
    v4l2_ext_control control{};
    control.id = about.id;
    const bool wide = about.type == V4L2_CTRL_TYPE_INTEGER64;
    if (wide)
        control.value64 = value;
    else
        control.value = static_cast<std::int32_t>(value);
    v4l2_ext_controls controls{};
    controls.which = V4L2_CTRL_WHICH_CUR_VAL;
    controls.count = 1;
    controls.controls = &control;
    const int got = uninterrupted([&] { return system.ioctl(file, request, &controls); });
    if (got >= 0) value = wide ? control.value64 : control.value;
    return got;
}

}  // namespace detail

/// True for a control that a number can be written to.
constexpr bool can_be_set(const v4l2_query_ext_ctrl& control) {
    return detail::holds_number(control) &&
           (control.flags & (V4L2_CTRL_FLAG_READ_ONLY | V4L2_CTRL_FLAG_DISABLED)) == 0;
}

/// What a control is set to.
///
/// Errors  unsupported for one that holds no number or tells none; otherwise as the call says
template <class System>
Status control_value(System& system, int file, const v4l2_query_ext_ctrl& control, std::int64_t& value,
                     Fault& fault) {
    if (!detail::holds_number(control) || (control.flags & V4L2_CTRL_FLAG_WRITE_ONLY) != 0)
        return unusable(fault, "VIDIOC_G_EXT_CTRLS", Status::unsupported, "it has no value to tell");
    const int got = detail::exchange_value(system, file, VIDIOC_G_EXT_CTRLS, control, value);
    return got < 0 ? refused(fault, "VIDIOC_G_EXT_CTRLS", got) : Status::ok;
}

/// The control after that of an id, which is 0 for the first. not_found at the end of the list.
template <class System>
Status next_control(System& system, int file, std::uint32_t id, v4l2_query_ext_ctrl& found, Fault& fault) {
    found = {};
    found.id = id | V4L2_CTRL_FLAG_NEXT_CTRL;
    const int got = uninterrupted([&] { return system.ioctl(file, VIDIOC_QUERY_EXT_CTRL, &found); });
    if (got == -EINVAL || got == -ENOTTY) return Status::not_found;
    if (got < 0) return refused(fault, "VIDIOC_QUERY_EXT_CTRL", got);
    // A driver that does not go on would keep the caller for ever.
    return found.id > id ? Status::ok : Status::not_found;
}

/// Sets controls, automatic modes first, then the others in their order, and reads all of them back at the
/// end. What became of each stands in its setting.
///
/// Errors  the first setting's that is not ok; what could be set is set
template <class System>
Status set_controls(System& system, int file, Span<ControlSetting> settings, Fault& fault) {
    for (ControlSetting& setting : settings) setting.status = Status::not_found;
    enum Round { automatic, others, reading };
    for (const Round round : {automatic, others, reading})
        for (ControlSetting& setting : settings) {
            v4l2_query_ext_ctrl control{};
            Status found = Status::ok;
            for (std::uint32_t id = 0;; id = control.id) {
                found = next_control(system, file, id, control, fault);
                if (found != Status::ok || names_control(setting.name, control.name)) break;
            }
            if (found == Status::not_found) continue;
            if (found != Status::ok) return setting.status = found;
            setting.smallest = control.minimum;
            setting.largest = control.maximum;
            setting.step = control.step;
            if (round == reading) {
                if (setting.status != Status::ok) continue;
                setting.inactive = (control.flags & V4L2_CTRL_FLAG_INACTIVE) != 0;
                const int got =
                    detail::exchange_value(system, file, VIDIOC_G_EXT_CTRLS, control, setting.now);
                if (got < 0)
                    setting.status = refused(fault, "VIDIOC_G_EXT_CTRLS", got);
                else if (setting.now != setting.value)
                    setting.status = unusable(fault, "VIDIOC_G_EXT_CTRLS", Status::irregular,
                                              "the driver has another value than was set");
                continue;
            }
            if (detail::is_automatic(control) != (round == automatic)) continue;
            if (!can_be_set(control)) {
                setting.status =
                    unusable(fault, "VIDIOC_S_EXT_CTRLS", Status::bad_argument, "nothing can be set there");
                continue;
            }
            const std::uint64_t above =
                static_cast<std::uint64_t>(setting.value) - static_cast<std::uint64_t>(control.minimum);
            if (setting.value < control.minimum || setting.value > control.maximum ||
                (control.type == V4L2_CTRL_TYPE_INTEGER && control.step > 1 && above % control.step != 0)) {
                setting.status =
                    unusable(fault, "VIDIOC_S_EXT_CTRLS", Status::out_of_range, "a value out of its range");
                continue;
            }
            std::int64_t value = setting.value;
            const int got = detail::exchange_value(system, file, VIDIOC_S_EXT_CTRLS, control, value);
            setting.status = got < 0 ? refused(fault, "VIDIOC_S_EXT_CTRLS", got) : Status::ok;
        }
    for (const ControlSetting& setting : settings)
        if (setting.status != Status::ok) return setting.status;
    return Status::ok;
}

}  // namespace fovea::linux_port
