// SPDX-License-Identifier: MIT
//
// VideoSignal: whether a picture arrives at a V4L2 device, and what the driver tells about it.
#pragma once

#include <linux/videodev2.h>

#include <cerrno>
#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

template <class System>
class VideoSignal {
public:
    /// Begins with a device that was just opened. An input whose picture has its size from outside is set to
    /// the size that arrives.
    void watch(System& system, int file) {
        file_ = file;
        lost_ = false;
        v4l2_event_subscription subscription{};
        subscription.type = V4L2_EVENT_SOURCE_CHANGE;
        tells_ = call(system, VIDIOC_SUBSCRIBE_EVENT, subscription) >= 0;
        v4l2_dv_timings timings{};
        if (call(system, VIDIOC_QUERY_DV_TIMINGS, timings) >= 0)
            static_cast<void>(call(system, VIDIOC_S_DV_TIMINGS, timings));
    }

    bool lost() const { return lost_; }

    /// Reads what the driver has told since the last time. While the signal is lost, looks whether it is
    /// back.
    ///
    /// Errors  no_signal; size_mismatch for a picture of another size; otherwise as the calls say
    Status read(System& system, Fault& fault) {
        Status signal = Status::ok;
        bool changed = lost_;
        // A driver tells as many in a row as it keeps, which are few.
        for (int most = 32; tells_ && most > 0; --most) {
            v4l2_event event{};
            const int got = call(system, VIDIOC_DQEVENT, event);
            if (got == -ENOENT) break;
            if (got < 0) return refused(fault, "VIDIOC_DQEVENT", got);
            changed = changed || event.type == V4L2_EVENT_SOURCE_CHANGE;
        }
        if (changed) signal = check(system, fault);
        return signal;
    }

    /// Asks the device itself. Errors as read().
    Status check(System& system, Fault& fault) {
        const Status signal = ask(system, fault);
        lost_ = signal == Status::no_signal;
        return signal;
    }

private:
    template <class Argument>
    int call(System& system, unsigned long request, Argument& argument) {
        return uninterrupted([&] { return system.ioctl(file_, request, &argument); });
    }

    Status ask(System& system, Fault& fault) {
        v4l2_dv_timings arriving{};
        const int got = call(system, VIDIOC_QUERY_DV_TIMINGS, arriving);
        if (got == -ENOLINK || got == -ENOLCK || got == -ERANGE) {
            static_cast<void>(refused(fault, "VIDIOC_QUERY_DV_TIMINGS", got));
            return fault.status = Status::no_signal;
        }
        if (got == -ENODEV) return refused(fault, "VIDIOC_QUERY_DV_TIMINGS", got);
        v4l2_dv_timings set{};
        if (got >= 0 && call(system, VIDIOC_G_DV_TIMINGS, set) >= 0 &&
            (set.bt.width != arriving.bt.width || set.bt.height != arriving.bt.height))
            return unusable(fault, "VIDIOC_QUERY_DV_TIMINGS", Status::size_mismatch,
                            "the source sends another size now");
        int number = 0;
        v4l2_input input{};
        if (call(system, VIDIOC_G_INPUT, number) < 0) return Status::ok;
        input.index = static_cast<std::uint32_t>(number);
        if (call(system, VIDIOC_ENUMINPUT, input) < 0) return Status::ok;
        if ((input.status & V4L2_IN_ST_NO_POWER) != 0)
            return unusable(fault, "VIDIOC_ENUMINPUT", Status::no_signal, "the sensor has no power");
        if ((input.status & (V4L2_IN_ST_NO_SIGNAL | V4L2_IN_ST_NO_SYNC)) != 0)
            return unusable(fault, "VIDIOC_ENUMINPUT", Status::no_signal,
                            "nothing is plugged in, or it is off");
        return Status::ok;
    }

    int file_ = -1;
    bool tells_ = false;
    bool lost_ = false;
};

}  // namespace fovea::linux_port
