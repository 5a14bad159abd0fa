// SPDX-License-Identifier: MIT
//
// The buffers of a V4L2 device: memory of the driver, mapped, and whose turn each of them is.
#pragma once

#include <linux/videodev2.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

/// A buffer that the driver has filled.
struct FilledBuffer {
    int index = -1;
    std::uint32_t flags = 0;
    std::uint32_t sequence = 0;
    std::int64_t stamp_us = 0;
    /// What was written into each of its memory planes, in front of which data may be that are no pixels.
    Span<const std::uint8_t> planes[hal::max_planes];
};

template <class System>
class VideoBuffers {
public:
    static constexpr int most = 16;

    /// Asks the driver for buffers and maps them; none is queued. An earlier set was released.
    ///
    /// Errors  as the calls say; io_error for fewer than two buffers, or more planes than the format has.
    ///         After an error nothing is held
    Status allocate(System& system, int file, std::uint32_t type, int memory_planes, int count,
                    Fault& fault) {
        FOVEA_ASSERT(count_ == 0 && memory_planes >= 1 && memory_planes <= hal::max_planes && count <= most);
        file_ = file;
        type_ = type;
        memory_planes_ = memory_planes;
        v4l2_requestbuffers request{};
        request.count = static_cast<std::uint32_t>(count);
        request.type = type;
        request.memory = V4L2_MEMORY_MMAP;
        const int got = uninterrupted([&] { return system.ioctl(file, VIDIOC_REQBUFS, &request); });
        if (got < 0) return refused(fault, "VIDIOC_REQBUFS", got);
        requested_ = true;
        Status status = Status::ok;
        if (request.count < 2)
            status = unusable(fault, "VIDIOC_REQBUFS", Status::io_error,
                              "the driver lends fewer than two buffers");
        // A driver may give more than asked for; those beyond the list are left alone.
        const int given = request.count > std::uint32_t{most} ? most : static_cast<int>(request.count);
        for (; status == Status::ok && count_ < given; ++count_) status = map(system, count_, fault);
        if (status != Status::ok) release(system);
        return status;
    }

    /// Unmaps all and gives the buffers back to the driver. The stream is off.
    void release(System& system) {
        for (Buffer& buffer : buffers_) {
            for (Mapping& mapping : buffer.mappings)
                if (mapping.memory != nullptr) system.unmap(mapping.memory, mapping.length);
            buffer = {};
        }
        count_ = 0;
        if (!requested_) return;
        requested_ = false;
        v4l2_requestbuffers none{};
        none.type = type_;
        none.memory = V4L2_MEMORY_MMAP;
        // Closing the device gives them back as well, so there is nothing to do if this is refused.
        static_cast<void>(uninterrupted([&] { return system.ioctl(file_, VIDIOC_REQBUFS, &none); }));
    }

    /// Gives every buffer to the driver that is neither there nor lent. ok if at least one is with the
    /// driver.
    Status queue_idle(System& system, Fault& fault) {
        int queued = 0;
        for (int k = 0; k < count_; ++k) {
            if (buffers_[k].turn == Turn::idle) {
                v4l2_plane planes[hal::max_planes] = {};
                v4l2_buffer buffer = describe(k, planes);
                const int got = uninterrupted([&] { return system.ioctl(file_, VIDIOC_QBUF, &buffer); });
                if (got >= 0)
                    buffers_[k].turn = Turn::queued;
                else if (got == -ENODEV || got == -EIO)
                    return refused(fault, "VIDIOC_QBUF", got);
                else
                    static_cast<void>(refused(fault, "VIDIOC_QBUF", got));
            }
            if (buffers_[k].turn == Turn::queued) ++queued;
        }
        return queued > 0 || lent_ > 0      ? Status::ok
               : fault.status == Status::ok ? Status::io_error
                                            : fault.status;
    }

    /// Takes the oldest buffer that the driver has filled; timeout where there is none yet.
    ///
    /// Errors  as the call says; io_error for an answer that does not fit the buffers
    Status take(System& system, FilledBuffer& filled, Fault& fault) {
        v4l2_plane planes[hal::max_planes] = {};
        v4l2_buffer buffer = describe(0, planes);
        const int got = uninterrupted([&] { return system.ioctl(file_, VIDIOC_DQBUF, &buffer); });
        if (got == -EAGAIN) return Status::timeout;
        if (got < 0) return refused(fault, "VIDIOC_DQBUF", got);
        if (buffer.index >= static_cast<std::uint32_t>(count_) || buffers_[buffer.index].turn != Turn::queued)
            return unusable(fault, "VIDIOC_DQBUF", Status::io_error,
                            "the driver gave a buffer that it did not have");
        Buffer& taken = buffers_[buffer.index];
        taken.turn = Turn::lent;
        ++lent_;
        filled.index = static_cast<int>(buffer.index);
        filled.flags = buffer.flags;
        filled.sequence = buffer.sequence;
        // Seconds of a driver may be anything: 2^43 of them still fit, in microseconds.
        constexpr std::int64_t last_second = std::int64_t{1} << 43;
        const std::int64_t seconds = buffer.timestamp.tv_sec;
        filled.stamp_us = (seconds > last_second    ? last_second
                           : seconds < -last_second ? -last_second
                                                    : seconds) *
                              1000000 +
                          buffer.timestamp.tv_usec % 1000000;
        for (int p = 0; p < memory_planes_; ++p) {
            const std::size_t length = taken.mappings[p].length;
            const std::size_t used = multi_planar() ? planes[p].bytesused : buffer.bytesused;
            const std::size_t offset = multi_planar() ? planes[p].data_offset : 0;
            const std::size_t end = used < length ? used : length;
            const std::size_t begin = offset < end ? offset : end;
            filled.planes[p] = {taken.mappings[p].memory + begin, static_cast<std::ptrdiff_t>(end - begin)};
        }
        return Status::ok;
    }

    /// Takes a lent buffer back. It is queued with the next queue_idle().
    void give_back(int index) {
        FOVEA_ASSERT(index >= 0 && index < count_ && buffers_[index].turn == Turn::lent);
        buffers_[index].turn = Turn::idle;
        --lent_;
    }

    /// After STREAMOFF the driver has none of them.
    void all_idle() {
        for (int k = 0; k < count_; ++k)
            if (buffers_[k].turn == Turn::queued) buffers_[k].turn = Turn::idle;
    }

    int count() const { return count_; }
    int lent() const { return lent_; }
    /// Bytes of a buffer's memory plane.
    std::size_t length(int index, int plane) const { return buffers_[index].mappings[plane].length; }

private:
    enum class Turn : std::uint8_t { idle, queued, lent };
    struct Mapping {
        std::uint8_t* memory = nullptr;
        std::size_t length = 0;
    };
    struct Buffer {
        Mapping mappings[hal::max_planes];
        Turn turn = Turn::idle;
    };

    bool multi_planar() const { return type_ == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE; }

    v4l2_buffer describe(int index, v4l2_plane* planes) const {
        v4l2_buffer buffer{};
        buffer.index = static_cast<std::uint32_t>(index);
        buffer.type = type_;
        buffer.memory = V4L2_MEMORY_MMAP;
        if (multi_planar()) {
            buffer.m.planes = planes;
            buffer.length = hal::max_planes;
        }
        return buffer;
    }

    Status map(System& system, int index, Fault& fault) {
        v4l2_plane planes[hal::max_planes] = {};
        v4l2_buffer buffer = describe(index, planes);
        const int got = uninterrupted([&] { return system.ioctl(file_, VIDIOC_QUERYBUF, &buffer); });
        if (got < 0) return refused(fault, "VIDIOC_QUERYBUF", got);
        if (multi_planar() && buffer.length != static_cast<std::uint32_t>(memory_planes_))
            return unusable(fault, "VIDIOC_QUERYBUF", Status::io_error,
                            "buffers of other planes than the format has");
        for (int p = 0; p < memory_planes_; ++p) {
            const std::size_t length = multi_planar() ? planes[p].length : buffer.length;
            const std::int64_t offset = multi_planar() ? planes[p].m.mem_offset : buffer.m.offset;
            Mapping& mapping = buffers_[index].mappings[p];
            const std::ptrdiff_t mapped =
                uninterrupted([&] { return system.map(file_, offset, length, mapping.memory); });
            if (mapped < 0) {
                mapping.memory = nullptr;
                return refused(fault, "mmap", mapped);
            }
            mapping.length = length;
        }
        return Status::ok;
    }

    Buffer buffers_[most];
    int count_ = 0;
    int lent_ = 0;
    int file_ = -1;
    int memory_planes_ = 1;
    std::uint32_t type_ = 0;
    bool requested_ = false;
};

}  // namespace fovea::linux_port
