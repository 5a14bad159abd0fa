// SPDX-License-Identifier: MIT
//
// CameraDoctor: looks at a camera, one thing after the other, and says what is wrong and what to try.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/list.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/camera_mode.hpp>
#include <fovea/linux/device_identity.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/v4l2_camera.hpp>
#include <fovea/linux/video_controls.hpp>

#include <daemon/gray_frame.hpp>
#include <daemon/settings.hpp>
#include <probe/camera_facts.hpp>
#include <probe/check.hpp>
#include <probe/holders.hpp>
#include <probe/light.hpp>
#include <probe/machine.hpp>
#include <probe/wiring.hpp>

namespace fovea::apps {

/// The checks of the camera, each upon those before it: it is there, it may be opened, nobody else has it, it
/// has the mode, its controls keep what is set, it streams, its frames come in time and whole, there is
/// light.
template <class System>
class CameraDoctor {
public:
    CameraDoctor(System system, const MachineFolders& folders, const Settings& settings, int frames,
                 CheckList& checks)
        : system_(system), folders_(folders), settings_(settings), frames_(frames), checks_(checks) {}

    void look() {
        if (settings_.camera.replay.size() > 0)
            return checks_.warn("camera",
                                "replay is set: pictures come from files, and no camera is looked at",
                                "take replay out of [camera] to judge what a camera sees");
        if (find() && open() && choose() && configure() && set_controls() && start()) watch();
    }

private:
    using Camera = linux_port::V4l2Camera<System>;

    bool find() {
        linux_port::DeviceFinder<System> finder(system_, {folders_.sysfs, folders_.nodes});
        const char* const wanted = settings_.camera.device.c_str();
        const Status found = finder.find("video4linux", wanted, paths_.view());
        if (!paths_.empty()) return true;
        const bool any = found == Status::not_found && std::string(wanted) == "auto";
        checks_.fail("camera",
                     any ? std::string("there is no camera")
                         : std::string("\"") + wanted + "\": " + linux_port::reason(finder.fault()),
                     found == Status::bad_argument ? "correct device in [camera]; fovea probe tells its name"
                                                   : "plug it in; fovea probe lists those that are there");
        return false;
    }

    bool open() {
        Status status = Status::not_found;
        for (const linux_port::DevicePath& path : paths_) {
            path_ = path.c_str();
            status = camera_.open(path.c_str());
            // A camera has nodes that give no pictures: the next may.
            if (status != Status::unsupported) break;
        }
        if (status == Status::ok) {
            checks_.ok("camera", path_ + ": " + driver_text(camera_.capability().card));
            return look_for_others();
        }
        if (camera_.fault().error == EACCES) {
            const Denial denial = denial_of(system_, folders_, path_);
            checks_.fail("rights", denial.what, denial.next);
        } else {
            refuse("camera", camera_.fault());
        }
        return false;
    }
    bool look_for_others() {
        // Many may have it open; one may stream.
        others_ = holders_of(system_, folders_, path_);
        if (!others_.programs.empty())
            checks_.warn("holders", "open in " + others_.words() + " too", others_.advice());
        return true;
    }

    bool choose() {
        const Status listed_modes = camera_.modes(modes_.view());
        if (listed_modes != Status::ok && listed_modes != Status::capacity_exceeded)
            return refuse("mode", camera_.fault());
        wish_.size = {static_cast<int>(settings_.camera.width), static_cast<int>(settings_.camera.height)};
        wish_.format = settings_.camera.format;
        wish_.interval_us = static_cast<std::int32_t>(1000000 / settings_.camera.rate_per_s);
        choice_ = linux_port::choose_mode(modes_.span(), wish_);
        if (choice_.index >= 0) return true;
        checks_.fail("mode", describe(choice_.reason),
                     "fovea probe lists what it offers; then correct [camera]");
        return false;
    }

    bool configure() {
        const linux_port::CameraMode& mode = modes_[choice_.index];
        if (camera_.configure(mode.code, choice_.size, wish_.interval_us) != Status::ok)
            return refuse("mode", camera_.fault());
        const std::string text = std::string(hal::describe(mode.format)) + " (" + code_text(mode.code) +
                                 ") " + std::to_string(choice_.size.width) + "x" +
                                 std::to_string(choice_.size.height) + ": " + describe(choice_.reason);
        if (choice_.reason == linux_port::CameraReason::slow)
            checks_.warn("mode", text, "lower rate_per_s in [camera], or take another size or format");
        else
            checks_.ok("mode", text);
        return true;
    }

    bool set_controls() {
        List<linux_port::ControlSetting, Settings::most_controls> list;
        for (const ControlChoice& choice : settings_.controls) {
            linux_port::ControlSetting setting;
            setting.name = choice.name.c_str();
            setting.value = choice.value;
            static_cast<void>(list.push(setting));
        }
        if (list.empty()) {
            checks_.ok("controls", "none is set: the camera chooses exposure and gain itself");
            return true;
        }
        linux_port::Fault fault;
        const Status status =
            linux_port::set_controls(system_, camera_.file(), {list.begin(), list.size()}, fault);
        for (const linux_port::ControlSetting& setting : list) {
            const std::string name = std::string(setting.name) + " = " + std::to_string(setting.value);
            if (setting.status != Status::ok)
                checks_.fail("controls", name + ": " + complaint(setting, fault),
                             "fovea probe lists the controls and what they take");
            else if (setting.inactive)
                checks_.warn("controls", name + " has no effect while an automatic mode has the say",
                             "set the automatic mode to manual in a [[control]] of its own");
        }
        if (status == Status::ok)
            checks_.ok("controls", std::to_string(list.size()) + " set, and the camera has kept them");
        return status == Status::ok;
    }
    static std::string complaint(const linux_port::ControlSetting& setting, const linux_port::Fault& fault) {
        switch (setting.status) {
            case Status::not_found: return "the camera has no such control";
            case Status::out_of_range:
                return "it takes " + std::to_string(setting.smallest) + " to " +
                       std::to_string(setting.largest) + " in steps of " + std::to_string(setting.step);
            case Status::irregular: return "the camera made " + std::to_string(setting.now) + " of it";
            default: return linux_port::reason(fault);
        }
    }

    bool start() {
        if (camera_.start(static_cast<int>(settings_.camera.buffers)) != Status::ok)
            return refuse("stream", camera_.fault());
        checks_.ok("stream", "it has started");
        return true;
    }

    /// Takes frames, and looks at how they came and at the last of them.
    void watch() {
        const std::int64_t patience_us = std::max(std::int64_t{2000000}, std::int64_t{5} * wish_.interval_us);
        typename Camera::Frame frame;
        // The first frames of many cameras are cut short, or come late.
        constexpr int warming_up = 5;
        hal::FrameCounters before;
        std::int64_t first_us = 0, last_us = 0, oldest_us = 0;
        bool forward = true;
        for (int k = 0; k < warming_up + frames_; ++k) {
            if (const Status s = camera_.next(patience_us, frame); s != Status::ok) {
                const bool none = s == Status::timeout || s == Status::no_signal;
                const std::string count =
                    std::to_string(camera_.counters().lent) + " whole frames came, then ";
                if (none)
                    checks_.fail("frames",
                                 count + "none within " + std::to_string(patience_us / 1000) + " ms, and " +
                                     std::to_string(camera_.counters().damaged) + " were damaged",
                                 s == Status::no_signal
                                     ? "there is no signal: look at the cable to the sensor"
                                     : "plug the camera in again, without a hub; look at dmesg");
                else
                    refuse("frames", camera_.fault());
                return;
            }
            const std::int64_t taken_us = frame.info().time_us;
            if (k >= warming_up) {
                forward = forward && taken_us > last_us;
                oldest_us = std::max(oldest_us, system_.monotonic_us() - taken_us);
            }
            if (k == warming_up - 1) {
                first_us = taken_us;
                before = camera_.counters();
            }
            last_us = taken_us;
        }
        tell_frames(before, last_us - first_us);
        if (!forward)
            checks_.warn("stamps", "the times of frames do not go forward",
                         "triggers by a line need them: take another camera for that");
        else if (oldest_us > 500000)
            checks_.warn("stamps",
                         "frames are " + std::to_string(oldest_us / 1000) + " ms old when they come",
                         "the machine is busy, or buffers in [camera] is large");
        else
            checks_.ok("stamps",
                       "frames are " + std::to_string(oldest_us / 1000) + " ms old at most when they come");
        tell_light(frame.info());
    }

    void tell_frames(const hal::FrameCounters& before, std::int64_t lasted_us) {
        const std::uint64_t damaged = camera_.counters().damaged - before.damaged;
        const std::uint64_t missed = camera_.counters().missed - before.missed;
        const std::int64_t interval_us = lasted_us / frames_;
        const std::string rate =
            rate_text(static_cast<std::int32_t>(std::min<std::int64_t>(interval_us, 1000000000)));
        const std::string figures =
            ",\"frames\":" + std::to_string(frames_) + ",\"interval_us\":" + std::to_string(interval_us) +
            ",\"damaged\":" + std::to_string(damaged) + ",\"missed\":" + std::to_string(missed);
        const std::string text = std::to_string(frames_) + " frames, " + rate + " a second";
        // A tenth slower is what clocks and loads make of a rate.
        if (interval_us > std::int64_t{wish_.interval_us} * 11 / 10)
            checks_.warn(
                "frames", text + ", and " + std::to_string(settings_.camera.rate_per_s) + " are wished for",
                "more light or a fixed exposure makes many cameras faster; or lower rate_per_s", figures);
        else
            checks_.ok("frames", text, figures);
        if (damaged > 0)
            checks_.warn(
                "damaged", std::to_string(damaged) + " frames came damaged",
                "another cable or port, without a hub; MJPEG or a smaller picture needs less of the bus");
        if (missed > 0)
            checks_.warn("gaps", std::to_string(missed) + " frames are missing in the numbering",
                         "the machine or the bus is busy: look at top, or take a lower rate");
    }

    void tell_light(const hal::FrameInfo& info) {
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(gray_frame_scratch(info.format, info.size)));
        const Result<ImageView<const Gray8>> gray =
            gray_frame(info, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
        if (!gray)
            return checks_.fail("light", std::string("the frame cannot be read: ") + describe(gray.status()),
                                "take another pixel_format in [camera]");
        check_light(*gray, settings_.quality, checks_);
    }

    /// What the kernel refused, with whoever has the camera.
    bool refuse(const char* check, const linux_port::Fault& fault) {
        const std::string what = path_ + ": " + fault.call + ": " + linux_port::reason(fault);
        if (fault.error == EBUSY)
            checks_.fail(check, what + (others_.programs.empty() ? "" : ": " + others_.words() + " has it"),
                         others_.programs.empty() ? others_.advice() : "end it first: " + others_.advice());
        else
            checks_.fail(check, what, linux_port::advice(fault));
        return false;
    }

    System system_;
    MachineFolders folders_;
    Settings settings_;
    int frames_;
    CheckList& checks_;
    Camera camera_{system_};
    List<linux_port::DevicePath, 16> paths_;
    List<linux_port::CameraMode, 256> modes_;
    linux_port::CameraWish wish_;
    linux_port::CameraChoice choice_;
    std::string path_;
    Holders others_;
};

}  // namespace fovea::apps
