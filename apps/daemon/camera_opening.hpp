// SPDX-License-Identifier: MIT
//
// CameraOpening: finds the camera that the settings name, chooses what it sends, sets its controls and starts
// it.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linux/camera_mode.hpp>
#include <fovea/linux/device_identity.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/v4l2_camera.hpp>
#include <fovea/linux/video_controls.hpp>

#include <daemon/settings.hpp>
#include <daemon/text_buffer.hpp>

namespace fovea::apps {

template <class System = linux_port::Kernel>
class CameraOpening {
public:
    using Camera = linux_port::V4l2Camera<System>;
    using Calls = System;
    /// A camera wakes who waits for it.
    static constexpr std::int64_t look_us = 1000000;

    CameraOpening(const Settings& settings, System system = {}, linux_port::DeviceFolders folders = {})
        : settings_(settings), finder_(system, folders), system_(system) {}

    /// From the second time on the frames must have the size of the first: memory was laid out for it.
    ///
    /// Errors  not_found and device_lost where there is no such camera; size_mismatch; otherwise what the
    ///         camera says, or its controls. problem() and advice() tell more
    Status operator()(Camera& camera) {
        problem_.clear();
        advice_ = "";
        List<linux_port::DevicePath, 16> paths;
        const Status found = finder_.find("video4linux", settings_.camera.device.c_str(), paths.view());
        if (paths.empty()) return fail(found, finder_.fault());
        // A camera may have nodes that give no pictures, or several that do: the first is taken.
        Status status = Status::not_found;
        for (const linux_port::DevicePath& path : paths) {
            path_ = path;
            status = camera.open(path.c_str());
            if (status == Status::ok) return begin(camera);
            if (status != Status::unsupported) break;
        }
        return fail(status, camera.fault());
    }

    /// What wakes for its frames.
    static int file(const Camera& camera) { return camera.file(); }
    const char* problem() const { return problem_.c_str(); }
    const char* advice() const { return advice_; }
    const linux_port::DevicePath& path() const { return path_; }
    Size size() const { return size_; }
    hal::PixelFormat format() const { return format_; }
    /// A control that was set without effect; empty if there is none.
    const char* control_note() const { return control_note_.c_str(); }

private:
    using Problem = Text<400>;

    Status fail(Status status, const linux_port::Fault& fault) {
        problem_.clear();
        problem_.add(path_.empty() ? settings_.camera.device.c_str() : path_.c_str())
            .add(": ")
            .add(fault.call);
        problem_.add(": ").add(linux_port::reason(fault));
        advice_ = linux_port::advice(fault);
        return status;
    }
    Status fail(Status status, const char* what, const char* advice) {
        problem_.clear();
        problem_.add(path_.c_str()).add(": ").add(what);
        advice_ = advice;
        return status;
    }

    Status begin(Camera& camera) {
        // One that is back takes the mode that it had. To list all is most of the calls of an opening, and
        // one that is silent is opened every 2 s.
        const bool again = code_ != 0 && camera.configure(code_, size_, wished_interval_us()) == Status::ok;
        if (!again)
            if (const Status s = choose(camera); s != Status::ok) return s;
        if (const Status s = set_controls(camera); s != Status::ok) return s;
        if (const Status s = camera.start(static_cast<int>(settings_.camera.buffers)); s != Status::ok)
            return fail(s, camera.fault());
        return Status::ok;
    }

    std::int32_t wished_interval_us() const {
        return static_cast<std::int32_t>(1000000 / settings_.camera.rate_per_s);
    }

    Status choose(Camera& camera) {
        if (const Status s = camera.modes(modes_.view()); s != Status::ok && s != Status::capacity_exceeded)
            return fail(s, camera.fault());
        linux_port::CameraWish wish;
        wish.size = {static_cast<int>(settings_.camera.width), static_cast<int>(settings_.camera.height)};
        // What was laid out once stays: a camera that comes back in another size does not fit.
        if (!size_.empty()) wish.size = size_;
        wish.format = settings_.camera.format;
        wish.interval_us = wished_interval_us();
        const linux_port::CameraChoice choice = linux_port::choose_mode(modes_.span(), wish);
        if (choice.index < 0)
            return fail(choice.reason == linux_port::CameraReason::no_such_size ? Status::size_mismatch
                                                                                : Status::unsupported,
                        describe(choice.reason), "fovea probe lists what it offers");
        const linux_port::CameraMode& mode = modes_[choice.index];
        if (const Status s = camera.configure(mode.code, choice.size, wish.interval_us); s != Status::ok)
            return fail(s, camera.fault());
        code_ = mode.code;
        size_ = choice.size;
        format_ = mode.format;
        return Status::ok;
    }

    Status set_controls(Camera& camera) {
        control_note_.clear();
        List<linux_port::ControlSetting, Settings::most_controls> list;
        for (const ControlChoice& choice : settings_.controls) {
            linux_port::ControlSetting setting;
            setting.name = choice.name.c_str();
            setting.value = choice.value;
            static_cast<void>(list.push(setting));
        }
        linux_port::Fault fault;
        const Status status =
            linux_port::set_controls(system_, camera.file(), {list.begin(), list.size()}, fault);
        for (const linux_port::ControlSetting& setting : list) {
            if (setting.inactive && control_note_.empty())
                control_note_.add(setting.name).add(" has no effect while an automatic mode has the say");
            if (setting.status == Status::ok) continue;
            problem_.clear();
            problem_.add(path_.c_str()).add(": control ").add(setting.name).add(": ");
            problem_.add(setting.status == Status::not_found      ? "the camera has no such control"
                         : setting.status == Status::out_of_range ? "a value that it cannot take"
                         : setting.status == Status::irregular    ? "it does not keep the value"
                                                                  : linux_port::reason(fault));
            advice_ = "fovea probe lists its controls and what they take";
            // A camera that was pulled meanwhile is no wrong setting.
            return fault.status == Status::device_lost ? Status::device_lost : Status::bad_argument;
        }
        return status;
    }

    Settings settings_;
    linux_port::DeviceFinder<System> finder_;
    System system_;
    linux_port::DevicePath path_;
    List<linux_port::CameraMode, 256> modes_;
    /// Of the mode that was chosen last.
    std::uint32_t code_ = 0;
    Size size_;
    hal::PixelFormat format_ = hal::PixelFormat::none;
    Problem problem_;
    const char* advice_ = "";
    Text<160> control_note_;
};

}  // namespace fovea::apps
