// SPDX-License-Identifier: MIT
//
// VideoOutput: shows pictures on an output of the driver vivid, whose input they then reach, byte by byte.
#pragma once

#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::board {

class VideoOutput {
public:
    ~VideoOutput() { close(); }

    /// Opens an output node and sets what it is to send; 0 or a negative errno.
    int open(const char* path, std::uint32_t code, Size size, bool multi_planar) {
        multi_ = multi_planar;
        type_ = multi_planar ? V4L2_BUF_TYPE_VIDEO_OUTPUT_MPLANE : V4L2_BUF_TYPE_VIDEO_OUTPUT;
        file_ = kernel_.open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
        if (file_ < 0) return file_;
        v4l2_format format{};
        format.type = type_;
        if (multi_) {
            format.fmt.pix_mp.pixelformat = code;
            format.fmt.pix_mp.width = static_cast<std::uint32_t>(size.width);
            format.fmt.pix_mp.height = static_cast<std::uint32_t>(size.height);
            format.fmt.pix_mp.field = V4L2_FIELD_NONE;
        } else {
            format.fmt.pix.pixelformat = code;
            format.fmt.pix.width = static_cast<std::uint32_t>(size.width);
            format.fmt.pix.height = static_cast<std::uint32_t>(size.height);
            format.fmt.pix.field = V4L2_FIELD_NONE;
        }
        if (const int got = kernel_.ioctl(file_, VIDIOC_S_FMT, &format); got < 0) return got;
        // What of the buffer is shown may still be the part that an earlier size had.
        v4l2_selection part{};
        part.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
        part.target = V4L2_SEL_TGT_CROP_DEFAULT;
        if (kernel_.ioctl(file_, VIDIOC_G_SELECTION, &part) >= 0) {
            part.target = V4L2_SEL_TGT_CROP;
            kernel_.ioctl(file_, VIDIOC_S_SELECTION, &part);
        }
        planes_ = multi_ ? format.fmt.pix_mp.num_planes : 1;
        v4l2_requestbuffers request{};
        request.count = 2;
        request.type = type_;
        request.memory = V4L2_MEMORY_MMAP;
        if (const int got = kernel_.ioctl(file_, VIDIOC_REQBUFS, &request); got < 0) return got;
        buffers_.resize(request.count);
        for (std::uint32_t k = 0; k < request.count; ++k) {
            v4l2_plane planes[VIDEO_MAX_PLANES] = {};
            v4l2_buffer buffer = describe(k, planes);
            if (const int got = kernel_.ioctl(file_, VIDIOC_QUERYBUF, &buffer); got < 0) return got;
            for (std::uint32_t p = 0; p < planes_; ++p) {
                Memory memory;
                memory.length = multi_ ? planes[p].length : buffer.length;
                const std::int64_t offset = multi_ ? planes[p].m.mem_offset : buffer.m.offset;
                if (const auto got = kernel_.map(file_, offset, memory.length, memory.bytes); got < 0)
                    return static_cast<int>(got);
                buffers_[k].push_back(memory);
            }
        }
        return 0;
    }

    /// Shows a picture: what paint(plane, bytes) puts into the memory of each plane. When it returns, the
    /// picture before has left, so that what is captured from then on is this one.
    int show(const std::function<void(int, Span<std::uint8_t>)>& paint) {
        std::uint32_t index = shown_;
        if (shown_ >= buffers_.size()) {
            // Of two buffers one is on show until the other is queued.
            if (const int got = take_back(index); got < 0) return got;
        }
        for (std::uint32_t p = 0; p < planes_; ++p) {
            const Memory& memory = buffers_[index][p];
            paint(static_cast<int>(p), {memory.bytes, static_cast<std::ptrdiff_t>(memory.length)});
        }
        v4l2_plane planes[VIDEO_MAX_PLANES] = {};
        v4l2_buffer buffer = describe(index, planes);
        buffer.field = V4L2_FIELD_NONE;
        for (std::uint32_t p = 0; p < planes_; ++p)
            planes[p].bytesused = static_cast<std::uint32_t>(buffers_[index][p].length);
        if (!multi_) buffer.bytesused = static_cast<std::uint32_t>(buffers_[index][0].length);
        if (const int got = kernel_.ioctl(file_, VIDIOC_QBUF, &buffer); got < 0) return got;
        if (shown_++ == 0) {
            int type = static_cast<int>(type_);
            return kernel_.ioctl(file_, VIDIOC_STREAMON, &type);
        }
        return 0;
    }

    void close() {
        for (auto& buffer : buffers_)
            for (const Memory& memory : buffer) kernel_.unmap(memory.bytes, memory.length);
        buffers_.clear();
        shown_ = 0;
        linux_port::close_file(kernel_, file_);
    }

private:
    struct Memory {
        std::uint8_t* bytes = nullptr;
        std::size_t length = 0;
    };

    v4l2_buffer describe(std::uint32_t index, v4l2_plane* planes) const {
        v4l2_buffer buffer{};
        buffer.index = index;
        buffer.type = type_;
        buffer.memory = V4L2_MEMORY_MMAP;
        if (multi_) {
            buffer.m.planes = planes;
            buffer.length = planes_;
        }
        return buffer;
    }
    int take_back(std::uint32_t& index) {
        v4l2_plane planes[VIDEO_MAX_PLANES] = {};
        v4l2_buffer buffer = describe(0, planes);
        pollfd file{file_, POLLOUT, 0};
        if (const int got = kernel_.poll({&file, 1}, 2000000); got < 0) return got;
        const int got = kernel_.ioctl(file_, VIDIOC_DQBUF, &buffer);
        index = buffer.index;
        return got;
    }

    linux_port::Kernel kernel_;
    int file_ = -1;
    bool multi_ = false;
    std::uint32_t type_ = 0;
    std::uint32_t planes_ = 1;
    std::uint32_t shown_ = 0;
    std::vector<std::vector<Memory>> buffers_;
};

}  // namespace fovea::board
