// SPDX-License-Identifier: MIT
//
// FrameLines: the lines of a camera that gives whole frames, for what measures line by line.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/hal/line_source.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea::hal {

/// Lends the rows of the first plane where the driver put them: of the gray formats and NV12 brightness, of
/// the packed ones pixels as they are packed. A frame stays with its source's driver no longer than its lines
/// are asked for.
///
/// Frames are of the size and the format that the source was set to; the newest is taken that is no older
/// than that.
///
/// Errors  of next(): truncated for a frame of another size or format, which is passed over; io_error for
///         whatever else the source says than timeout: source_status() has it
template <class Source>
class FrameLines {
    static_assert(is_frame_source_v<Source>, "lines come from a source of frames: hal/frame_source.hpp");

public:
    FrameLines(Source& source, PixelFormat format, Size size, std::int64_t max_age_us)
        : source_(source), format_(format), size_(size), max_age_us_(max_age_us) {}

    Size size() const { return size_; }
    /// The frame comes with its first line.
    Status start() {
        frame_ = {};
        state_ = State::wanted;
        return Status::ok;
    }
    Result<Span<const std::uint8_t>> next() {
        if (state_ == State::wanted)
            if (const Status s = take(); s != Status::ok) return s;
        if (state_ != State::lent) return Span<const std::uint8_t>();
        if (y_ == size_.height) {
            // What was lent last may be read until now.
            frame_ = {};
            state_ = State::ended;
            return Span<const std::uint8_t>();
        }
        const Plane& plane = frame_.info().planes[0];
        return plane.bytes.from(y_++ * plane.stride_bytes).first(row_bytes(format_, 0, size_.width));
    }

    /// Why next() answered io_error.
    Status source_status() const { return source_status_; }

private:
    enum class State : std::uint8_t { ended, wanted, lent };

    /// Asks for a frame. ok also while there is none.
    Status take() {
        const Status got = source_.latest(max_age_us_, 0, frame_);
        if (got == Status::timeout) return Status::ok;
        state_ = State::ended;
        source_status_ = got;
        if (got != Status::ok) return Status::io_error;
        const FrameInfo& info = frame_.info();
        if (info.format != format_ || info.size != size_ || compressed(format_)) {
            frame_ = {};
            return Status::truncated;
        }
        y_ = 0;
        state_ = State::lent;
        return Status::ok;
    }

    Source& source_;
    typename Source::Frame frame_;
    PixelFormat format_;
    Size size_;
    std::int64_t max_age_us_;
    int y_ = 0;
    State state_ = State::ended;
    Status source_status_ = Status::ok;
};

}  // namespace fovea::hal
