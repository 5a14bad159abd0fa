// SPDX-License-Identifier: MIT
//
// V4l2Camera: a camera of Linux, with its frames where the driver put them.
#pragma once

#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <fovea/base/assert.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/hal/frame_time.hpp>
#include <fovea/hal/lent_frame.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linux/camera_mode.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/video_buffers.hpp>
#include <fovea/linux/video_format.hpp>
#include <fovea/linux/video_layout.hpp>
#include <fovea/linux/video_modes.hpp>
#include <fovea/linux/video_selection.hpp>
#include <fovea/linux/video_signal.hpp>

namespace fovea::linux_port {

/// One camera: open(), configure(), start(), then frames; close() undoes all of it, from any state.
///
/// Every frame that is lent is whole and was taken while the sensor had a signal. After an error fault()
/// tells which call was refused, and the camera is as the status says: io_error, size_mismatch: stop() and
/// start() or configure(); device_lost: close() and open(). Allocates nothing; waits only in its frames, for
/// as long as it may. Not for two threads.
///
/// Source  the kernel's documentation of V4L2, "Input/Output" and "Streaming I/O (Memory Mapping)"
template <class System = Kernel>
class V4l2Camera {
public:
    /// A frame of the driver's.
    using Frame = hal::LentFrame<V4l2Camera>;

    explicit V4l2Camera(System system = {}) : system_(system) {}
    V4l2Camera(const V4l2Camera&) = delete;
    V4l2Camera& operator=(const V4l2Camera&) = delete;
    ~V4l2Camera() { close(); }

    /// Opens a device node.
    ///
    /// Errors  as open() says; unsupported for what is no camera
    Status open(const char* path);
    /// What it can send: see list_modes().
    Status modes(ListView<CameraMode> found) {
        if (file_ < 0) return closed();
        return list_modes(system_, file_, type_, found, fault_);
    }
    /// Sets the format, the size and the rate, and reads back what the driver made of them. A rate that the
    /// driver does not keep is no error: interval_us() tells.
    ///
    /// Errors  as the calls say; unsupported, size_mismatch and malformed as VideoLayout::read() says
    Status configure(std::uint32_t code, Size size, std::int32_t interval_us);
    /// Begins to take frames, into at least two buffers and at most VideoBuffers::most.
    Status start(int buffers = 4);
    /// Ends that; all frames have been given back.
    void stop();
    void close();

    Status next(std::int64_t patience_us, Frame& frame) {
        return first(patience_us, frame, [](const hal::FrameInfo&) { return true; });
    }
    Status latest(std::int64_t max_age_us, std::int64_t patience_us, Frame& frame);
    Status after(std::int64_t moment_us, std::int64_t patience_us, Frame& frame) {
        return first(patience_us, frame, [&](const hal::FrameInfo& info) {
            // A stamp of the end says that the frame began an interval before it at the earliest.
            return info.time_us - (stamped_at_end_ ? interval_us_ : 0) >= moment_us;
        });
    }

    bool opened() const { return file_ >= 0; }
    bool streaming() const { return streaming_; }
    /// For ioctls of controls; -1 when closed.
    int file() const { return file_; }
    const VideoLayout& layout() const { return layout_; }
    /// From frame to frame; 0 where the driver does not say.
    std::int32_t interval_us() const { return interval_us_; }
    /// How it calls itself and where it is plugged in, of the last open().
    const v4l2_capability& capability() const { return capability_; }
    const hal::FrameCounters& counters() const { return counters_; }
    const Fault& fault() const { return fault_; }

private:
    friend Frame;
    void take_back(int index) { buffers_.give_back(index); }

    template <class Argument>
    int call(unsigned long request, Argument& argument) {
        return uninterrupted([&] { return system_.ioctl(file_, request, &argument); });
    }
    Status closed() { return unusable(fault_, "open", Status::device_lost, "the camera is not open"); }
    Status check_capability();

    template <class Wanted>
    Status first(std::int64_t patience_us, Frame& frame, Wanted wanted);
    Status begin(Frame& frame);
    Status take(Frame& frame, bool& usable);
    Status wait(std::int64_t until_us, bool& alarmed);

    System system_;
    VideoBuffers<System> buffers_;
    VideoSignal<System> signal_;
    VideoLayout layout_;
    v4l2_capability capability_{};
    hal::FrameCounters counters_;
    hal::SequenceGaps gaps_;
    hal::FrameStamps stamps_;
    /// When all that had come was taken last.
    std::int64_t emptied_us_ = 0;
    Fault fault_;
    int file_ = -1;
    std::uint32_t type_ = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    std::int32_t interval_us_ = 0;
    bool streaming_ = false;
    /// Of the frame taken last: its stamp is of its end.
    bool stamped_at_end_ = false;
};

static_assert(hal::is_frame_source_v<V4l2Camera<>>);

// ---- Implementation ---------------------------------------------------------------

template <class System>
Status V4l2Camera<System>::open(const char* path) {
    close();
    const int got = uninterrupted([&] { return system_.open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC); });
    if (got < 0) return refused(fault_, "open", got);
    file_ = got;
    counters_ = {};
    if (const Status s = check_capability(); s != Status::ok) {
        close();
        return s;
    }
    signal_.watch(system_, file_);
    return Status::ok;
}

template <class System>
Status V4l2Camera<System>::check_capability() {
    capability_ = {};
    if (const int got = call(VIDIOC_QUERYCAP, capability_); got < 0)
        return refused(fault_, "VIDIOC_QUERYCAP", got);
    // Of several nodes of a device, each tells its own part.
    const bool of_node = (capability_.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
    const std::uint32_t can = of_node ? capability_.device_caps : capability_.capabilities;
    if ((can & (V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_VIDEO_CAPTURE_MPLANE)) == 0)
        return unusable(fault_, "VIDIOC_QUERYCAP", Status::unsupported,
                        (can & V4L2_CAP_META_CAPTURE) != 0
                            ? "this node has data about pictures, not pictures: take the "
                              "camera's other node"
                            : "this node gives no pictures");
    if ((can & V4L2_CAP_STREAMING) == 0)
        return unusable(fault_, "VIDIOC_QUERYCAP", Status::unsupported,
                        "this camera cannot lend its buffers");
    type_ = (can & V4L2_CAP_VIDEO_CAPTURE) != 0 ? V4L2_BUF_TYPE_VIDEO_CAPTURE
                                                : V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
    return Status::ok;
}

template <class System>
Status V4l2Camera<System>::configure(std::uint32_t code, Size size, std::int32_t interval_us) {
    if (file_ < 0) return closed();
    const VideoFormat* const wanted = find_video_format(code);
    if (wanted == nullptr || size.empty() || interval_us < 0 || streaming_)
        return unusable(fault_, "VIDIOC_S_FMT", Status::bad_argument,
                        streaming_ ? "the camera is streaming" : "no format, size or rate of a camera");
    v4l2_format format = video_format_request(type_, *wanted, size);
    const VideoSelection<System> selection(system_, file_);
    selection.adopt(V4L2_SEL_TGT_CROP_DEFAULT, V4L2_SEL_TGT_CROP);
    if (const int got = call(VIDIOC_S_FMT, format); got < 0) return refused(fault_, "VIDIOC_S_FMT", got);
    selection.adopt(V4L2_SEL_TGT_COMPOSE_DEFAULT, V4L2_SEL_TGT_COMPOSE);
    if (const Status s = layout_.read(format, *wanted, size); s != Status::ok)
        return unusable(fault_, "VIDIOC_S_FMT", s,
                        "the driver gives another format or size than was asked for");
    if (!selection.fills(V4L2_SEL_TGT_COMPOSE, size))
        return unusable(fault_, "VIDIOC_S_SELECTION", Status::size_mismatch,
                        "the driver fills a part of the frame only");

    interval_us_ = 0;
    v4l2_streamparm rate{};
    rate.type = type_;
    if (interval_us > 0) {
        rate.parm.capture.timeperframe = {static_cast<std::uint32_t>(interval_us), 1000000};
        // A driver without rates refuses; one that is gone will say so again.
        if (const int got = call(VIDIOC_S_PARM, rate); got == -ENODEV)
            return refused(fault_, "VIDIOC_S_PARM", got);
    }
    rate = {};
    rate.type = type_;
    if (call(VIDIOC_G_PARM, rate) >= 0) interval_us_ = detail::interval_us_of(rate.parm.capture.timeperframe);
    return Status::ok;
}

template <class System>
Status V4l2Camera<System>::start(int buffers) {
    if (file_ < 0) return closed();
    if (streaming_ || layout_.size.empty() || buffers < 2 || buffers > VideoBuffers<System>::most)
        return unusable(fault_, "VIDIOC_STREAMON", Status::bad_argument,
                        "not configured, or streaming already");
    Status status = buffers_.allocate(system_, file_, type_, layout_.memory_planes, buffers, fault_);
    if (status != Status::ok) return status;
    status = buffers_.queue_idle(system_, fault_);
    if (status == Status::ok) {
        int type = static_cast<int>(type_);
        if (const int got = call(VIDIOC_STREAMON, type); got < 0)
            status = refused(fault_, "VIDIOC_STREAMON", got);
    }
    streaming_ = true;
    if (status != Status::ok) {
        stop();
        return status;
    }
    gaps_.restart();
    emptied_us_ = system_.monotonic_us();
    stamps_.restart(emptied_us_);
    // A camera without a signal streams, and tells so with its frames.
    const Status signal = signal_.check(system_, fault_);
    if (signal == Status::ok || signal == Status::no_signal) return Status::ok;
    stop();
    return signal;
}

template <class System>
void V4l2Camera<System>::stop() {
    if (!streaming_) return;
    FOVEA_ASSERT(buffers_.lent() == 0);
    streaming_ = false;
    int type = static_cast<int>(type_);
    static_cast<void>(call(VIDIOC_STREAMOFF, type));
    buffers_.all_idle();
    buffers_.release(system_);
}

template <class System>
void V4l2Camera<System>::close() {
    stop();
    static_cast<void>(close_file(system_, file_));
    layout_ = {};
}

/// What comes before any frame: the one before is given back, and the camera can give another.
template <class System>
Status V4l2Camera<System>::begin(Frame& frame) {
    frame.give_back();
    if (file_ < 0) return closed();
    if (!streaming_)
        return unusable(fault_, "VIDIOC_DQBUF", Status::bad_argument, "the camera was not started");
    return Status::ok;
}

/// Takes the oldest frame that is there; timeout where there is none. usable tells whether frame holds it.
template <class System>
Status V4l2Camera<System>::take(Frame& frame, bool& usable) {
    usable = false;
    FilledBuffer filled;
    if (const Status s = buffers_.take(system_, filled, fault_); s != Status::ok) return s;
    const std::int64_t now = system_.monotonic_us();
    counters_.missed += gaps_.before(filled.sequence);
    hal::FrameInfo info;
    if ((filled.flags & V4L2_BUF_FLAG_ERROR) != 0 || layout_.place(filled.planes, info) != Status::ok) {
        ++counters_.damaged;
        take_back(filled.index);
        return Status::ok;
    }
    const bool monotonic = (filled.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    stamped_at_end_ = (filled.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_EOF;
    info.sequence = filled.sequence;
    info.time_us = monotonic ? stamps_.taken(filled.stamp_us, now) : now;
    frame.lend(*this, filled.index, info);
    usable = true;
    return Status::ok;
}

/// Waits for the driver to have something. alarmed: it says that something is wrong, which the next take()
/// tells.
template <class System>
Status V4l2Camera<System>::wait(std::int64_t until_us, bool& alarmed) {
    const std::int64_t left_us = until_us - system_.monotonic_us();
    if (left_us <= 0) return Status::timeout;
    pollfd asked{file_, static_cast<short>(signal_.lost() ? POLLPRI : POLLIN | POLLPRI), 0};
    const int got = system_.poll({&asked, 1}, left_us);
    // Who waits looks first what the signal wants.
    if (got == -EINTR) return Status::timeout;
    if (got < 0) return refused(fault_, "poll", got);
    alarmed = (asked.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0;
    if (got == 0) {
        const Status signal = signal_.check(system_, fault_);
        return signal == Status::ok ? Status::timeout : signal;
    }
    return Status::ok;
}

/// The first frame that is wanted.
template <class System>
template <class Wanted>
Status V4l2Camera<System>::first(std::int64_t patience_us, Frame& frame, Wanted wanted) {
    if (const Status s = begin(frame); s != Status::ok) return s;
    const std::int64_t until_us = system_.monotonic_us() + patience_us;
    for (bool alarmed = false;;) {
        if (const Status s = buffers_.queue_idle(system_, fault_); s != Status::ok) return s;
        bool usable = false;
        const Status status = take(frame, usable);
        if (status != Status::ok && status != Status::timeout) return status;
        const Status event = signal_.read(system_, fault_);
        if (event == Status::ok && usable && wanted(frame.info())) {
            ++counters_.lent;
            return Status::ok;
        }
        if (usable) ++counters_.passed_over;
        frame.give_back();
        if (event != Status::ok && event != Status::no_signal) return event;
        // Frames that are not wanted may come as fast as they are taken.
        if (status == Status::ok && system_.monotonic_us() < until_us) continue;
        if (status == Status::timeout && alarmed)
            return unusable(fault_, "poll", Status::io_error, "the stream is broken");
        if (const Status s = wait(until_us, alarmed); s != Status::ok)
            return s == Status::timeout && signal_.lost() ? Status::no_signal : s;
    }
}

/// The newest frame there is, or the next if that is too old. One that was not there a moment ago is as new
/// as any can be, however long it was on its way from the sensor.
template <class System>
Status V4l2Camera<System>::latest(std::int64_t max_age_us, std::int64_t patience_us, Frame& frame) {
    if (const Status s = begin(frame); s != Status::ok) return s;
    const std::int64_t until_us = system_.monotonic_us() + patience_us;
    for (bool alarmed = false;;) {
        if (const Status s = buffers_.queue_idle(system_, fault_); s != Status::ok) return s;
        // Until all that is there has been taken, no buffer goes back, so that this ends.
        Frame newest;
        Status status = Status::ok;
        for (bool usable = false; (status = take(frame, usable)) == Status::ok;) {
            if (!usable) continue;
            if (!newest.empty()) ++counters_.passed_over;
            newest = std::move(frame);
            alarmed = false;
        }
        if (status != Status::timeout) return status;
        status = signal_.read(system_, fault_);
        const std::int64_t now_us = system_.monotonic_us();
        const bool fresh = std::min(now_us - newest.info().time_us, now_us - emptied_us_) <= max_age_us;
        emptied_us_ = now_us;
        if (status == Status::ok && !newest.empty() && fresh) {
            ++counters_.lent;
            frame = std::move(newest);
            return Status::ok;
        }
        if (!newest.empty()) ++counters_.passed_over;
        newest.give_back();
        if (status != Status::ok && status != Status::no_signal) return status;
        if (alarmed) return unusable(fault_, "poll", Status::io_error, "the stream is broken");
        if (const Status s = buffers_.queue_idle(system_, fault_); s != Status::ok) return s;
        if (const Status s = wait(until_us, alarmed); s != Status::ok)
            return s == Status::timeout && signal_.lost() ? Status::no_signal : s;
    }
}

}  // namespace fovea::linux_port
