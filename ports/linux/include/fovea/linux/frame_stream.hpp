// SPDX-License-Identifier: MIT
//
// FrameStream: where one frame ends and the next begins in bytes that come from a pipe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/pnm.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::linux_port {

/// What a pipe carries.
struct StreamFormat {
    /// none: PGM and PPM pictures one behind the other. Else the rows of frames, without padding.
    hal::PixelFormat format = hal::PixelFormat::none;
    /// Of frames. Pictures tell their own.
    Size size;
    /// Bytes behind each frame that are passed over.
    std::int64_t behind = 0;

    /// Bytes of a frame, of which nothing is passed over.
    constexpr std::int64_t frame_bytes() const {
        std::int64_t bytes = 0;
        for (int p = 0; p < hal::plane_count(format); ++p)
            bytes +=
                std::int64_t{hal::row_bytes(format, p, size.width)} * hal::plane_rows(format, p, size.height);
        return bytes;
    }
};

/// Planar YUV 4:2:0 (I420, YV12), of which the luma is used: the planes of colour differences lie behind it.
constexpr StreamFormat luma_of_yuv420(Size size) {
    const std::int64_t plane = std::int64_t{(size.width + 1) / 2} * ((size.height + 1) / 2);
    return {hal::PixelFormat::gray8, size, 2 * plane};
}

/// Collects the bytes of a stream in memory given to it, until a frame stands whole at its start.
///
/// Bytes are read into room() and announced by filled(); look() then says what there is. What cannot be the
/// start of a picture is passed over up to the next thing that can.
class FrameStream {
public:
    /// The longest header of a picture, with its comments, that is looked through.
    static constexpr std::ptrdiff_t max_header = 512;

    /// Errors  unsupported for what is compressed; image_too_large; bad_argument for a frame without size or
    ///         a negative number; buffer_too_small for a frame, or for max_header bytes of pictures
    Status begin(const StreamFormat& format, Span<std::uint8_t> buffer) {
        if (hal::compressed(format.format)) return Status::unsupported;
        const bool pictures = format.format == hal::PixelFormat::none;
        if (format.behind < 0 || (!pictures && format.size.empty())) return Status::bad_argument;
        if (format.size.width > max_image_side || format.size.height > max_image_side)
            return Status::image_too_large;
        if (buffer.size() < (pictures ? max_header : format.frame_bytes())) return Status::buffer_too_small;
        format_ = format;
        buffer_ = buffer;
        restart();
        return Status::ok;
    }

    /// Forgets what there is: the next byte begins a frame.
    void restart() {
        used_ = 0;
        pass_over_ = 0;
        searching_ = false;
        forget_header();
    }

    /// Where the next bytes are to be read to; empty while a frame stands whole. Never more than the frame
    /// that is being read may need, so that little has to be moved when it is dropped.
    Span<std::uint8_t> room() const {
        const std::int64_t wanted = pass_over_ > 0     ? buffer_.size()
                                    : frame_bytes_ > 0 ? frame_bytes_ - used_
                                                       : header_step;
        const Span<std::uint8_t> rest = buffer_.from(used_);
        return rest.first(clamp<std::int64_t>(wanted, 0, rest.size()));
    }
    void filled(std::ptrdiff_t bytes) {
        FOVEA_ASSERT(bytes >= 0 && bytes <= room().size());
        used_ += bytes;
    }

    /// What there is.
    ///
    /// ok: a frame, in bytes() until drop().  timeout: more bytes are needed.  Anything else: something was
    /// passed over, and it is to be asked again: malformed for what is no picture, as inspect_pnm() says for
    /// one that is not read, buffer_too_small for one that has no room.
    Status look() {
        pass_over();
        if (pass_over_ > 0) return Status::timeout;
        if (frame_bytes_ == 0)
            if (const Status s = read_header(); s != Status::ok) return s;
        return used_ >= frame_bytes_ ? Status::ok : Status::timeout;
    }
    Span<const std::uint8_t> bytes() const { return buffer_.first(frame_bytes_); }
    void drop() {
        FOVEA_ASSERT(frame_bytes_ > 0 && used_ >= frame_bytes_);
        pass_over_ = frame_bytes_ + format_.behind;
        forget_header();
        pass_over();
    }

    /// True between frames: the stream may end here without a loss. What is passed over belongs to no frame.
    bool between_frames() const { return used_ == 0; }

    /// Where the rows of a whole frame lie. Not of pictures.
    void place(Span<const std::uint8_t> frame, hal::FrameInfo& info) const {
        info.format = format_.format;
        info.size = format_.size;
        for (int p = 0; p < hal::plane_count(format_.format); ++p) {
            const int row = hal::row_bytes(format_.format, p, format_.size.width);
            const std::int64_t bytes =
                std::int64_t{row} * hal::plane_rows(format_.format, p, format_.size.height);
            info.planes[p] = {frame.first(bytes), row};
            frame = frame.from(bytes);
        }
    }

private:
    static constexpr std::int64_t header_step = 64;

    void forget_header() {
        frame_bytes_ = format_.format == hal::PixelFormat::none ? 0 : format_.frame_bytes();
        header_bytes_ = 0;
    }

    void remove(std::ptrdiff_t bytes) {
        std::memmove(buffer_.data(), buffer_.data() + bytes, static_cast<std::size_t>(used_ - bytes));
        used_ -= bytes;
    }
    void pass_over() {
        const auto now = static_cast<std::ptrdiff_t>(minimum<std::int64_t>(pass_over_, used_));
        if (now == 0) return;
        remove(now);
        pass_over_ -= now;
    }

    /// Steps to where a picture may begin. White space between pictures is no damage.
    bool find_start() {
        std::ptrdiff_t at = 0;
        const auto space = [](std::uint8_t c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
        while (at < used_ && (searching_ ? !may_begin(at) : space(buffer_[at]))) ++at;
        if (at > 0) remove(at);
        return used_ > 0;
    }
    bool may_begin(std::ptrdiff_t at) const {
        return buffer_[at] == 'P' && (at + 1 == used_ || buffer_[at + 1] == '5' || buffer_[at + 1] == '6');
    }

    /// The header of a picture ends with the first byte with which it can be read.
    Status read_header() {
        while (header_bytes_ > 0 || find_start()) {
            Status status = Status::truncated;
            while (status == Status::truncated && header_bytes_ < used_ && header_bytes_ < max_header)
                status = try_header();
            if (status == Status::ok || status == Status::buffer_too_small) return status;
            if (status == Status::truncated && header_bytes_ < max_header) return Status::timeout;
            // The next picture is looked for behind the first byte of this one, and told of once.
            remove(1);
            forget_header();
            if (!searching_) {
                searching_ = true;
                return status == Status::truncated ? Status::malformed : status;
            }
        }
        return Status::timeout;
    }
    /// A header of one byte more than before.
    Status try_header() {
        const Result<PictureInfo> info = inspect_pnm(buffer_.first(++header_bytes_));
        if (!info) return info.status();
        searching_ = false;
        const PictureContent content = info->content;
        const bool gray = content == PictureContent::gray8 || content == PictureContent::gray16;
        const bool narrow = content == PictureContent::gray8 || content == PictureContent::rgb888;
        frame_bytes_ = header_bytes_ + info->size.area() * (gray ? 1 : 3) * (narrow ? 1 : 2);
        if (frame_bytes_ <= buffer_.size()) return Status::ok;
        pass_over_ = frame_bytes_ + format_.behind;
        forget_header();
        return Status::buffer_too_small;
    }

    StreamFormat format_;
    Span<std::uint8_t> buffer_;
    std::ptrdiff_t used_ = 0;
    std::int64_t pass_over_ = 0;
    /// Of the frame at the start, once it is known; else 0.
    std::int64_t frame_bytes_ = 0;
    /// Looked at, and not yet a whole header.
    std::ptrdiff_t header_bytes_ = 0;
    /// After damage, for something that a picture may begin with.
    bool searching_ = false;
};

}  // namespace fovea::linux_port
