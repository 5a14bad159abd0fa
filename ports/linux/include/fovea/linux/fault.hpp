// SPDX-License-Identifier: MIT
//
// Fault: what the kernel refused, as a sentence that says what to try.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstring>

#include <fovea/base/status.hpp>

namespace fovea::linux_port {

/// A call that did not do what was asked.
struct Fault {
    /// Its name as manuals have it ("VIDIOC_STREAMON", "open"); empty when nothing has failed.
    const char* call = "";
    /// The errno, or 0 where the call was answered and the answer was wrong.
    int error = 0;
    /// What it means for the caller.
    Status status = Status::ok;
    /// What of the answer was wrong, or what the call was about; may be empty.
    const char* about = "";
};

/// One sentence in front of the advice: the system's own words, or what was wrong with the answer.
inline const char* reason(const Fault& fault) {
    if (fault.error != 0) return std::strerror(fault.error);
    return fault.about[0] != '\0' ? fault.about : describe(fault.status);
}

/// What to try when that call answers that errno; empty where there is nothing better to say than the reason.
/// The same errno means different things in different calls: "no space left on device" of a camera is about
/// USB.
inline const char* advice(const Fault& fault) {
    struct Row {
        const char* call;
        int error;
        const char* text;
    };
    static constexpr Row rows[] = {
        {"VIDIOC_STREAMON", ENOSPC,
         "the USB bus has no bandwidth left: use MJPEG, a smaller picture or a lower rate, or another USB "
         "controller"},
        {"VIDIOC_STREAMON", EINVAL, "the driver has no buffers or the link to the sensor is not set up"},
        {"VIDIOC_STREAMON", EPIPE,
         "the formats along the media pipeline do not agree: set them with media-ctl"},
        {"VIDIOC_STREAMON", EPROTO, "the camera does not answer: plug it in again, without a hub"},
        {"VIDIOC_S_FMT", EBUSY, "another program is streaming from this camera: end it first"},
        {"VIDIOC_REQBUFS", EBUSY, "another program is streaming from this camera: end it first"},
        {"VIDIOC_REQBUFS", ENOMEM,
         "there is no memory for the buffers: use a smaller picture, or more CMA memory"},
        {"VIDIOC_REQBUFS", EINVAL, "the driver lends no memory-mapped buffers"},
        {"VIDIOC_DQBUF", EIO, "the stream is broken: it is started again"},
        {"VIDIOC_QUERYCAP", ENOTTY, "this is not a camera: fovea probe lists those that are there"},
        {"flock", EAGAIN, "another program has this port for itself: end it first"},
        {"TIOCEXCL", EBUSY, "another program has this port for itself: end it first"},
        {"TCGETS2", ENOTTY, "this is not a serial port"},
        {"TCGETS2", EIO, "there is no hardware behind this port"},
        {"GPIO_GET_LINE", EBUSY, "the line is taken: fovea probe says by whom"},
        {"GPIO_GET_LINE", EINVAL, "the line cannot be what is asked of it, or the chip has no such line"},
        {"GPIO_GET_LINE", ENOTTY, "this kernel is older than 5.10, where lines are asked for another way"},
        {"GPIO_GET_CHIPINFO", ENOTTY, "this is not a GPIO chip: they are /dev/gpiochip*"},
        {"open", EBUSY, "another program holds it: end it first"},
        {"open", ENOENT, "it is not there: plug it in, or correct its name"},
        {"open", EACCES,
         "this user has no right to it: add the user to the group of the file (video, dialout, gpio)"},
        {"open", EPERM, "the sandbox of the service forbids it: see DeviceAllow= of its unit"},
        {"open", EMFILE, "too many files are open: raise the limit (ulimit -n)"},
        {"", ENODEV, "the device is gone: it is looked for again"},
        {"", ENXIO, "there is no hardware behind this file"},
        {"", ENOSPC, "the disk is full: remove files"},
        {"", EDQUOT, "the quota of this user is used up: remove files"},
        {"", EROFS, "the file system can only be read: mount it for writing"},
        {"", EACCES, "this user has no right to it: look at the rights of the file and its folders"},
        {"", EIO, "the device or the cable to it is at fault: look at dmesg"},
    };
    for (const Row& row : rows)
        if (row.error == fault.error && (row.call[0] == '\0' || std::strcmp(row.call, fault.call) == 0))
            return row.text;
    return "";
}

/// What an errno means for the caller where the call itself says nothing more.
constexpr Status status_of(int error) {
    switch (error) {
        case ENODEV:
        case ENXIO:
        case ESHUTDOWN: return Status::device_lost;
        case ENOENT: return Status::not_found;
        case ENOTTY:
        case EOPNOTSUPP: return Status::unsupported;
        case ENOLINK:
        case ENOLCK: return Status::no_signal;
        default: return Status::io_error;
    }
}

/// Notes that the kernel answered a call with a negative errno.
inline Status refused(Fault& fault, const char* call, std::ptrdiff_t got) {
    const int error = static_cast<int>(-got);
    fault = {call, error, status_of(error), ""};
    return fault.status;
}

/// Notes that a call was answered with what cannot be used.
inline Status unusable(Fault& fault, const char* call, Status status, const char* about) {
    fault = {call, 0, status, about};
    return status;
}

}  // namespace fovea::linux_port
