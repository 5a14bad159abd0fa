// SPDX-License-Identifier: MIT
//
// SimulatedCamera: a V4L2 device in memory, for tests of what is done with one. How the kernel itself behaves
// is seen on the emulated board: tests/board.
#pragma once

#include <linux/videodev2.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fovea/linux/kernel.hpp>

namespace fovea::test {

/// A byte of the picture of a frame.
inline std::uint8_t camera_byte(std::uint32_t sequence, std::size_t offset) {
    return static_cast<std::uint8_t>((sequence * 31 + offset * 7 + offset / 251) & 255);
}

/// The device, and the time. A frame is taken every interval_us while it streams, into the buffer that was
/// queued first; without one it is lost. Time passes in poll() and when a test says so.
struct SimulatedCamera {
    struct Mode {
        std::uint32_t code;
        int width;
        int height;
        std::int32_t interval_us;
    };

    std::vector<Mode> offered = {{V4L2_PIX_FMT_GREY, 64, 48, 40000}};
    std::string path = "/dev/video0";
    std::uint32_t device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    int padding = 0;        ///< bytes behind each row
    int memory_planes = 1;  ///< of the multi-planar kind
    int data_offset = 0;    ///< bytes in front of each plane of the multi-planar kind
    int most_buffers = 32;
    int wrong_width = 0;  ///< added to the width that is asked for
    bool lists_sizes = true;
    std::uint32_t field = V4L2_FIELD_NONE;
    std::uint32_t first_sequence = 0;
    std::int64_t stamp_ahead_us = 0;
    std::uint32_t stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    /// By the number of the frame since the start of the stream.
    std::set<std::uint32_t> damaged;
    std::set<std::uint32_t> cut_short;
    std::set<std::uint32_t> dropped;
    bool silent = false;  ///< no frame comes
    bool fatal = false;   ///< the stream is broken until it is stopped
    bool unplugged = false;
    bool has_timings = false;  ///< an input for video signals
    bool signal = true;
    int timings_width = 64;
    int timings_set = 64;
    /// What of the frame is filled after a format was set; 0 where the driver has no such rectangle.
    int compose_width = 0;
    bool compose_can_be_set = true;
    /// What the sensor sees, row by row without padding; nullptr for the bytes of camera_byte().
    const std::vector<std::uint8_t>* scene = nullptr;
    /// Requests that are refused once, with that errno.
    std::map<unsigned long, int> refused_once;

    std::int64_t now_us = 1000000;
    int open_handles = 0;
    int opened = 0;
    int polls = 0;
    int calls = 0;             ///< of the system, all of them
    std::int64_t call_us = 0;  ///< that each takes
    bool streaming = false;

    /// The signal changes, as an event tells.
    void set_signal(bool there) {
        signal = there;
        events.push_back(V4L2_EVENT_SOURCE_CHANGE);
    }

    /// Lets frames come until that moment.
    void run_until(std::int64_t until_us) {
        while (streaming && !silent && !fatal && !unplugged && next_frame_us <= until_us) expose();
        now_us = std::max(now_us, until_us);
    }

    struct Buffer {
        std::vector<std::vector<std::uint8_t>> planes;
        bool queued = false;
        std::uint32_t flags = 0;
        std::uint32_t sequence = 0;
        std::vector<std::uint32_t> used;
        std::int64_t stamp_us = 0;
    };
    Mode mode = {V4L2_PIX_FMT_GREY, 64, 48, 40000};
    std::vector<Buffer> buffers;
    std::deque<int> queued;
    std::deque<int> filled;
    std::deque<std::uint32_t> events;
    std::int64_t next_frame_us = 0;
    std::uint32_t frame = 0;
    /// The frames of this stream that were marked or cut short, by their sequence.
    std::set<std::uint32_t> flagged;

    /// A call of the system: time passes.
    void enter_call() {
        ++calls;
        if (call_us > 0) run_until(now_us + call_us);
    }
    /// Whether poll() would come back at once.
    bool would_wake() const {
        return open_handles > 0 && (unplugged || fatal || !filled.empty() || !events.empty());
    }
    /// When something will wake a poll(), or never.
    std::int64_t wakes_at_us() const {
        return streaming && !silent && !fatal && !unplugged ? next_frame_us : INT64_MAX;
    }

    int plane_count() const { return memory_planes; }
    int rows(int plane) const {
        if (mode.code == V4L2_PIX_FMT_NV12) return mode.height + (mode.height + 1) / 2;
        return plane == 1 ? (mode.height + 1) / 2 : mode.height;
    }
    int stride() const {
        const int pixel = mode.code == V4L2_PIX_FMT_YUYV || mode.code == V4L2_PIX_FMT_Y16 ? 2
                          : mode.code == V4L2_PIX_FMT_RGB24                               ? 3
                                                                                          : 1;
        return mode.width * pixel + padding;
    }
    std::uint32_t plane_bytes(int plane) const { return static_cast<std::uint32_t>(stride() * rows(plane)); }

    void expose() {
        const std::uint32_t number = frame++;
        const std::int64_t taken_us = next_frame_us;
        next_frame_us += mode.interval_us;
        if (dropped.count(number) != 0 || queued.empty()) return;
        const int index = queued.front();
        queued.pop_front();
        Buffer& buffer = buffers[static_cast<std::size_t>(index)];
        buffer.queued = false;
        buffer.sequence = first_sequence + number;
        buffer.stamp_us = taken_us + stamp_ahead_us;
        if (damaged.count(number) != 0 || cut_short.count(number) != 0) flagged.insert(buffer.sequence);
        buffer.flags = stamp_flags | (damaged.count(number) != 0 ? V4L2_BUF_FLAG_ERROR : 0u);
        buffer.used.clear();
        std::size_t offset = 0;
        for (auto& plane : buffer.planes) {
            std::fill(plane.begin(), plane.end(), std::uint8_t{0});
            for (std::size_t k = static_cast<std::size_t>(data_offset); k < plane.size(); ++k)
                plane[k] = scene != nullptr && offset < scene->size()
                               ? (*scene)[offset++]
                               : camera_byte(buffer.sequence, offset++);
            const auto all = static_cast<std::uint32_t>(plane.size());
            buffer.used.push_back(cut_short.count(number) != 0 ? all / 2 : all);
        }
        filled.push_back(index);
    }
};

/// A handle to the calls that a SimulatedCamera answers. Of files, it has its own node alone.
class SimulatedVideo {
public:
    explicit SimulatedVideo(SimulatedCamera& camera) : camera_(&camera) {}

    int open(const char* path, int, unsigned = 0) {
        camera_->enter_call();
        if (camera_->path != path) return -ENOENT;
        if (camera_->unplugged) return -ENODEV;
        ++camera_->open_handles;
        return 1000 + camera_->opened++;
    }
    int close(int) {
        camera_->enter_call();
        if (--camera_->open_handles > 0) return 0;
        stop();
        camera_->buffers.clear();
        return 0;
    }
    int ioctl(int, unsigned long request, void* argument) {
        camera_->enter_call();
        if (camera_->unplugged) return -ENODEV;
        const auto refused = camera_->refused_once.find(request);
        if (refused != camera_->refused_once.end()) {
            const int error = refused->second;
            camera_->refused_once.erase(refused);
            return -error;
        }
        switch (request) {
            case VIDIOC_QUERYCAP: return capability(*static_cast<v4l2_capability*>(argument));
            case VIDIOC_ENUM_FMT: return list_format(*static_cast<v4l2_fmtdesc*>(argument));
            case VIDIOC_ENUM_FRAMESIZES: return list_size(*static_cast<v4l2_frmsizeenum*>(argument));
            case VIDIOC_ENUM_FRAMEINTERVALS: return list_interval(*static_cast<v4l2_frmivalenum*>(argument));
            case VIDIOC_S_FMT: return set_format(*static_cast<v4l2_format*>(argument));
            case VIDIOC_G_FMT: return answer_format(*static_cast<v4l2_format*>(argument));
            case VIDIOC_S_PARM: return 0;
            case VIDIOC_G_PARM: return rate(*static_cast<v4l2_streamparm*>(argument));
            case VIDIOC_REQBUFS: return request_buffers(*static_cast<v4l2_requestbuffers*>(argument));
            case VIDIOC_QUERYBUF: return query_buffer(*static_cast<v4l2_buffer*>(argument));
            case VIDIOC_QBUF: return queue(*static_cast<v4l2_buffer*>(argument));
            case VIDIOC_DQBUF: return dequeue(*static_cast<v4l2_buffer*>(argument));
            case VIDIOC_STREAMON: return start();
            case VIDIOC_STREAMOFF: return stop();
            case VIDIOC_SUBSCRIBE_EVENT: return camera_->has_timings ? 0 : -EINVAL;
            case VIDIOC_DQEVENT: return event(*static_cast<v4l2_event*>(argument));
            case VIDIOC_QUERY_DV_TIMINGS:
                if (!camera_->has_timings) return -ENOTTY;
                if (!camera_->signal) return -ENOLINK;
                static_cast<v4l2_dv_timings*>(argument)->bt.width =
                    static_cast<std::uint32_t>(camera_->timings_width);
                return 0;
            case VIDIOC_G_DV_TIMINGS:
                if (!camera_->has_timings) return -ENOTTY;
                static_cast<v4l2_dv_timings*>(argument)->bt.width =
                    static_cast<std::uint32_t>(camera_->timings_set);
                return 0;
            case VIDIOC_G_SELECTION: return selection(*static_cast<v4l2_selection*>(argument));
            case VIDIOC_S_SELECTION:
                if (!camera_->compose_can_be_set) return -EBUSY;
                camera_->compose_width = static_cast<int>(static_cast<v4l2_selection*>(argument)->r.width);
                return 0;
            case VIDIOC_S_DV_TIMINGS:
                camera_->timings_set = static_cast<int>(static_cast<v4l2_dv_timings*>(argument)->bt.width);
                return 0;
            case VIDIOC_G_INPUT: *static_cast<int*>(argument) = 0; return 0;
            case VIDIOC_ENUMINPUT:
                static_cast<v4l2_input*>(argument)->status = camera_->signal ? 0 : V4L2_IN_ST_NO_SIGNAL;
                return 0;
            default: return -ENOTTY;
        }
    }
    int poll(Span<pollfd> files, std::int64_t patience_us) {
        camera_->enter_call();
        ++camera_->polls;
        pollfd& file = files[0];
        const std::int64_t until_us = camera_->now_us + patience_us;
        for (;;) {
            file.revents = 0;
            if (camera_->unplugged)
                file.revents = POLLPRI | POLLERR | POLLHUP;
            else if (camera_->fatal ||
                     (camera_->streaming && camera_->queued.empty() && camera_->filled.empty()))
                file.revents = POLLERR;
            else {
                if (!camera_->filled.empty()) file.revents |= POLLIN;
                if (!camera_->events.empty()) file.revents |= POLLPRI;
            }
            file.revents = static_cast<short>(file.revents & (file.events | POLLERR | POLLHUP));
            if (file.revents != 0) return 1;
            if (camera_->now_us >= until_us) return 0;
            const bool running = camera_->streaming && !camera_->silent;
            camera_->run_until(running
                                   ? std::min(until_us, std::max(camera_->now_us + 1, camera_->next_frame_us))
                                   : until_us);
        }
    }
    std::ptrdiff_t map(int, std::int64_t offset, std::size_t length, std::uint8_t*& memory) {
        camera_->enter_call();
        const auto index = static_cast<std::size_t>(offset / 16);
        const auto plane = static_cast<std::size_t>(offset % 16);
        if (index >= camera_->buffers.size() || plane >= camera_->buffers[index].planes.size())
            return -EINVAL;
        if (length != camera_->buffers[index].planes[plane].size()) return -EINVAL;
        memory = camera_->buffers[index].planes[plane].data();
        return 0;
    }
    int unmap(std::uint8_t*, std::size_t) {
        camera_->enter_call();
        return 0;
    }
    std::int64_t monotonic_us() { return camera_->now_us; }

    // What a camera does not need.
    std::ptrdiff_t read(int, Span<std::uint8_t>) { return -EINVAL; }
    std::ptrdiff_t write(int, Span<const std::uint8_t>) { return -EINVAL; }
    int processors() { return 1; }
    int sync(int) { return -EINVAL; }
    int rename(const char*, const char*) { return -EINVAL; }
    int make_folder(const char*, unsigned) { return -EINVAL; }
    int remove(const char*) { return -EINVAL; }
    int about(const char*, struct stat&) { return -ENOENT; }
    int about(int, struct stat&) { return -EINVAL; }
    std::ptrdiff_t read_link(const char*, Span<char>) { return -EINVAL; }
    std::ptrdiff_t entries(int, Span<std::uint8_t>) { return -EINVAL; }
    int socket(int, int) { return -EINVAL; }
    std::ptrdiff_t send_to(int, Span<const std::uint8_t>, const sockaddr_un&, unsigned) { return -EINVAL; }

private:
    bool multi() const { return (camera_->device_caps & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0; }

    int capability(v4l2_capability& answer) {
        answer.capabilities = camera_->device_caps | V4L2_CAP_DEVICE_CAPS | V4L2_CAP_META_CAPTURE;
        answer.device_caps = camera_->device_caps;
        std::strcpy(reinterpret_cast<char*>(answer.card), "simulated");
        return 0;
    }
    std::vector<std::uint32_t> codes() const {
        std::vector<std::uint32_t> found;
        for (const auto& mode : camera_->offered)
            if (std::find(found.begin(), found.end(), mode.code) == found.end()) found.push_back(mode.code);
        return found;
    }
    int list_format(v4l2_fmtdesc& ask) {
        const auto found = codes();
        if (ask.index >= found.size()) return -EINVAL;
        ask.pixelformat = found[ask.index];
        ask.flags = 0;
        return 0;
    }
    int list_size(v4l2_frmsizeenum& ask) {
        if (!camera_->lists_sizes) return -ENOTTY;
        std::uint32_t k = 0;
        for (const auto& mode : camera_->offered) {
            if (mode.code != ask.pixel_format || k++ != ask.index) continue;
            ask.type = V4L2_FRMSIZE_TYPE_DISCRETE;
            ask.discrete = {static_cast<std::uint32_t>(mode.width), static_cast<std::uint32_t>(mode.height)};
            return 0;
        }
        return -EINVAL;
    }
    int list_interval(v4l2_frmivalenum& ask) {
        for (const auto& mode : camera_->offered)
            if (ask.index == 0 && mode.code == ask.pixel_format &&
                static_cast<std::uint32_t>(mode.width) == ask.width) {
                ask.type = V4L2_FRMIVAL_TYPE_DISCRETE;
                ask.discrete = {static_cast<std::uint32_t>(mode.interval_us), 1000000};
                return 0;
            }
        return -EINVAL;
    }
    int set_format(v4l2_format& format) {
        if (camera_->streaming || !camera_->buffers.empty()) return -EBUSY;
        const std::uint32_t code = multi() ? format.fmt.pix_mp.pixelformat : format.fmt.pix.pixelformat;
        const std::uint32_t width = multi() ? format.fmt.pix_mp.width : format.fmt.pix.width;
        camera_->mode = camera_->offered.front();
        for (const auto& mode : camera_->offered)
            if (mode.code == code &&
                (camera_->mode.code != code || static_cast<std::uint32_t>(mode.width) == width))
                camera_->mode = mode;
        camera_->mode.width += camera_->wrong_width;
        return answer_format(format);
    }
    int answer_format(v4l2_format& format) {
        const auto& mode = camera_->mode;
        const auto stride = static_cast<std::uint32_t>(camera_->stride());
        if (multi()) {
            auto& pixels = format.fmt.pix_mp;
            pixels = {};
            pixels.pixelformat = mode.code;
            pixels.width = static_cast<std::uint32_t>(mode.width);
            pixels.height = static_cast<std::uint32_t>(mode.height);
            pixels.field = camera_->field;
            pixels.num_planes = static_cast<std::uint8_t>(camera_->memory_planes);
            for (int p = 0; p < camera_->memory_planes; ++p)
                pixels.plane_fmt[p] = {camera_->plane_bytes(p), stride, {}};
        } else {
            auto& pixels = format.fmt.pix;
            pixels = {};
            pixels.pixelformat = mode.code;
            pixels.width = static_cast<std::uint32_t>(mode.width);
            pixels.height = static_cast<std::uint32_t>(mode.height);
            pixels.field = camera_->field;
            pixels.bytesperline = stride;
            pixels.sizeimage = camera_->plane_bytes(0);
        }
        return 0;
    }
    int selection(v4l2_selection& answer) {
        const bool compose =
            answer.target == V4L2_SEL_TGT_COMPOSE || answer.target == V4L2_SEL_TGT_COMPOSE_DEFAULT;
        if (camera_->compose_width == 0 || !compose) return -ENOTTY;
        const bool whole = answer.target == V4L2_SEL_TGT_COMPOSE_DEFAULT;
        answer.r = {0, 0, static_cast<std::uint32_t>(whole ? camera_->mode.width : camera_->compose_width),
                    static_cast<std::uint32_t>(camera_->mode.height)};
        return 0;
    }
    int rate(v4l2_streamparm& answer) {
        answer.parm.capture.timeperframe = {static_cast<std::uint32_t>(camera_->mode.interval_us), 1000000};
        return 0;
    }
    int request_buffers(v4l2_requestbuffers& request) {
        if (camera_->streaming) return -EBUSY;
        request.count = std::min(request.count, static_cast<std::uint32_t>(camera_->most_buffers));
        camera_->buffers.assign(request.count, {});
        camera_->queued.clear();
        camera_->filled.clear();
        for (auto& buffer : camera_->buffers)
            for (int p = 0; p < camera_->memory_planes; ++p)
                buffer.planes.emplace_back(camera_->plane_bytes(p) +
                                           static_cast<std::size_t>(camera_->data_offset));
        return 0;
    }
    int query_buffer(v4l2_buffer& answer) {
        if (answer.index >= camera_->buffers.size()) return -EINVAL;
        const auto& planes = camera_->buffers[answer.index].planes;
        if (multi()) {
            if (answer.length < planes.size()) return -EINVAL;
            for (std::size_t p = 0; p < planes.size(); ++p) {
                answer.m.planes[p].length = static_cast<std::uint32_t>(planes[p].size());
                answer.m.planes[p].m.mem_offset = answer.index * 16 + static_cast<std::uint32_t>(p);
            }
            answer.length = static_cast<std::uint32_t>(planes.size());
        } else {
            answer.length = static_cast<std::uint32_t>(planes[0].size());
            answer.m.offset = answer.index * 16;
        }
        return 0;
    }
    int queue(v4l2_buffer& buffer) {
        if (buffer.index >= camera_->buffers.size() || camera_->buffers[buffer.index].queued) return -EINVAL;
        if (camera_->fatal) return -EIO;
        camera_->buffers[buffer.index].queued = true;
        camera_->queued.push_back(static_cast<int>(buffer.index));
        return 0;
    }
    int dequeue(v4l2_buffer& answer) {
        if (!camera_->streaming) return -EINVAL;
        if (camera_->fatal) return -EIO;
        camera_->run_until(camera_->now_us);
        if (camera_->filled.empty()) return -EAGAIN;
        const int index = camera_->filled.front();
        camera_->filled.pop_front();
        const auto& buffer = camera_->buffers[static_cast<std::size_t>(index)];
        answer.index = static_cast<std::uint32_t>(index);
        answer.flags = buffer.flags;
        answer.sequence = buffer.sequence;
        answer.timestamp.tv_sec = static_cast<decltype(answer.timestamp.tv_sec)>(buffer.stamp_us / 1000000);
        answer.timestamp.tv_usec = static_cast<decltype(answer.timestamp.tv_usec)>(buffer.stamp_us % 1000000);
        if (multi())
            for (std::size_t p = 0; p < buffer.used.size(); ++p) {
                answer.m.planes[p].bytesused = buffer.used[p];
                answer.m.planes[p].data_offset = static_cast<std::uint32_t>(camera_->data_offset);
            }
        else
            answer.bytesused = buffer.used[0];
        return 0;
    }
    int start() {
        if (camera_->buffers.empty()) return -EINVAL;
        camera_->streaming = true;
        camera_->frame = 0;
        camera_->flagged.clear();
        camera_->next_frame_us = camera_->now_us + camera_->mode.interval_us;
        return 0;
    }
    int stop() {
        camera_->streaming = false;
        camera_->fatal = false;
        camera_->queued.clear();
        camera_->filled.clear();
        for (auto& buffer : camera_->buffers) buffer.queued = false;
        return 0;
    }
    int event(v4l2_event& answer) {
        if (camera_->events.empty()) return -ENOENT;
        answer.type = camera_->events.front();
        camera_->events.pop_front();
        return 0;
    }

    SimulatedCamera* camera_;
};

}  // namespace fovea::test
