// SPDX-License-Identifier: MIT
//
// Where the rows of a V4L2 frame lie in the memory of its buffer.
#pragma once

#include <linux/videodev2.h>

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linux/video_format.hpp>

namespace fovea::linux_port {

/// What to ask of S_FMT: whole frames of a format and a size.
inline v4l2_format video_format_request(std::uint32_t type, const VideoFormat& wanted, Size size) {
    v4l2_format format{};
    format.type = type;
    const auto fill = [&](auto& pixels) {
        pixels.pixelformat = wanted.code;
        pixels.width = static_cast<std::uint32_t>(size.width);
        pixels.height = static_cast<std::uint32_t>(size.height);
        pixels.field = V4L2_FIELD_NONE;
    };
    if (type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
        fill(format.fmt.pix_mp);
        format.fmt.pix_mp.num_planes = static_cast<std::uint8_t>(wanted.memory_planes);
    } else {
        fill(format.fmt.pix);
    }
    return format;
}

/// The format a driver has settled on, read from its answer.
struct VideoLayout {
    hal::PixelFormat format = hal::PixelFormat::none;
    Size size;
    bool narrow_range = false;
    int memory_planes = 1;
    std::ptrdiff_t stride_bytes[hal::max_planes] = {};

    /// Reads the answer to S_FMT.
    ///
    /// Errors  size_mismatch and unsupported where it is not what was asked for; malformed where rows are
    ///         shorter than their pixels, or a frame than its rows
    Status read(const v4l2_format& answer, const VideoFormat& wanted, Size wanted_size) {
        const bool multi = answer.type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
        const v4l2_pix_format& single = answer.fmt.pix;
        const v4l2_pix_format_mplane& planar = answer.fmt.pix_mp;
        if ((multi ? planar.pixelformat : single.pixelformat) != wanted.code) return Status::unsupported;
        const std::uint32_t width = multi ? planar.width : single.width;
        const std::uint32_t height = multi ? planar.height : single.height;
        if (width != static_cast<std::uint32_t>(wanted_size.width) ||
            height != static_cast<std::uint32_t>(wanted_size.height))
            return Status::size_mismatch;
        // Rows of two moments are no picture to measure in.
        const std::uint32_t field = multi ? std::uint32_t{planar.field} : single.field;
        if (field != V4L2_FIELD_NONE && field != V4L2_FIELD_ANY) return Status::unsupported;
        const int planes = multi ? planar.num_planes : 1;
        if (planes != wanted.memory_planes) return Status::unsupported;

        VideoLayout layout;
        layout.format = wanted.format;
        layout.size = wanted_size;
        layout.narrow_range = linux_port::narrow_range(
            wanted.format, multi ? std::uint32_t{planar.quantization} : single.quantization,
            multi ? planar.colorspace : single.colorspace);
        layout.memory_planes = planes;
        for (int p = 0; p < hal::plane_count(layout.format); ++p) {
            const int m = p < planes ? p : 0;
            const std::uint32_t told = multi ? planar.plane_fmt[m].bytesperline : single.bytesperline;
            const int row = hal::row_bytes(layout.format, p, wanted_size.width);
            // 0 is what drivers say that pad nothing.
            layout.stride_bytes[p] = told == 0 ? row : static_cast<std::ptrdiff_t>(told);
            if (layout.stride_bytes[p] < row && !hal::compressed(layout.format)) return Status::malformed;
        }
        for (int m = 0; m < planes; ++m) {
            const std::uint32_t bytes = multi ? planar.plane_fmt[m].sizeimage : single.sizeimage;
            if (static_cast<std::int64_t>(bytes) < layout.memory_bytes(m)) return Status::malformed;
        }
        *this = layout;
        return Status::ok;
    }

    /// Bytes that a whole frame has at least in a memory plane.
    std::int64_t memory_bytes(int memory_plane) const {
        if (hal::compressed(format)) return 1;
        const int last = memory_planes == 1 && format == hal::PixelFormat::nv12 ? 1 : memory_plane;
        return offset(last) + std::int64_t{stride_bytes[last]} * (rows(last) - 1) +
               hal::row_bytes(format, last, size.width);
    }

    /// The planes of a frame in what a driver has filled; truncated where that is too little.
    Status place(const Span<const std::uint8_t>* memory, hal::FrameInfo& info) const {
        for (int m = 0; m < memory_planes; ++m)
            if (memory[m].size() < memory_bytes(m)) return Status::truncated;
        info.format = format;
        info.size = size;
        info.narrow_range = narrow_range;
        for (int p = 0; p < hal::plane_count(format); ++p) {
            if (hal::compressed(format)) {
                info.planes[p] = {memory[0], 0};
                continue;
            }
            const Span<const std::uint8_t> all = memory[memory_planes == 1 ? 0 : p];
            const std::ptrdiff_t bytes =
                stride_bytes[p] * (rows(p) - 1) + hal::row_bytes(format, p, size.width);
            info.planes[p] = {{all.data() + offset(p), bytes}, stride_bytes[p]};
        }
        return Status::ok;
    }

private:
    int rows(int plane) const { return hal::plane_rows(format, plane, size.height); }
    /// Of a plane within its memory: behind those in front of it.
    std::ptrdiff_t offset(int plane) const {
        return plane == 0 || memory_planes > 1 ? 0 : stride_bytes[0] * rows(0);
    }
};

}  // namespace fovea::linux_port
