// SPDX-License-Identifier: MIT
//
// ReplaySource: pictures of files, of a folder or of a pipe in place of a camera.
#pragma once

#include <poll.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/jpeg.hpp>
#include <fovea/codec/png_reader.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/hal/lent_frame.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/frame_stream.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/replay_files.hpp>
#include <fovea/linux/replay_picture.hpp>
#include <fovea/linux/replay_pipe.hpp>

namespace fovea::linux_port {

struct ReplayOptions {
    /// With a format: raw frames of it, out of a pipe or a file. Without: pictures.
    StreamFormat stream;
    /// What pictures are lent as: gray8 or rgb24.
    hal::PixelFormat pictures = hal::PixelFormat::gray8;
    /// That pictures must have; empty for that of the first.
    Size size;
    /// From frame to frame; 0 for as fast as they are asked for, or as a pipe brings them.
    std::int32_t interval_us = 0;
    ReplayEnd end = ReplayEnd::stop;
};

/// Memory that a source works in.
struct ReplayMemory {
    /// A file, or a frame as it is sent: FrameStream::max_header bytes at least.
    Span<std::uint8_t> file;
    /// The frame that is lent, and what its decoder needs.
    Span<std::uint8_t> picture;
};

/// Bytes of ReplayMemory::picture for pictures of that size, whatever their format.
constexpr std::int64_t replay_picture_bytes(hal::PixelFormat lent, Size size) {
    const std::int64_t jpeg = jpeg_scratch(size);
    const std::int64_t png = png_reader_scratch(size);
    return size.area() * (lent == hal::PixelFormat::gray8 ? 1 : 3) + (jpeg > png ? jpeg : png);
}

/// One source: open(), start(), then frames, one at a time; stop(), close().
///
/// Frames are numbered from 0 since open(), also those that cannot be used: these are counted as damaged,
/// fault() says what was wrong, and the next is taken. A frame is due an interval after the one before, and
/// its time is when it was due; without an interval it is when it was asked for, or for a pipe the last
/// moment at which the pipe was seen empty before it. latest() passes over what is due already, or what is in
/// the pipe; next() nothing. While nothing comes, no frame becomes due.
///
/// timeout: none is there yet.  no_signal: none is there and nobody to bring one: a FIFO that no program
/// has opened for writing, or after the last.  device_lost: the folder is gone. Allocates nothing, and waits
/// only as long as it may; files are read at once, from whatever disk they are on. Not for two threads.
template <class System = Kernel>
class ReplaySource {
public:
    /// There is one at a time.
    using Frame = hal::LentFrame<ReplaySource>;

    explicit ReplaySource(System system = {}) : system_(system) {}
    ReplaySource(const ReplaySource&) = delete;
    ReplaySource& operator=(const ReplaySource&) = delete;
    ~ReplaySource() { close(); }

    /// Opens a picture, a folder of pictures, a FIFO or "-", the standard input.
    ///
    /// Errors  as open() and stat() say; bad_argument for a negative interval, another format of pictures,
    ///         raw frames of a folder, or for watching what is no folder; as FrameStream::begin() says
    Status open(const char* path, const ReplayOptions& options, ReplayMemory memory);
    Status start();
    void stop() {
        FOVEA_ASSERT(!lent_);
        streaming_ = false;
    }
    void close() {
        if (opened_) stop();
        if (opened_ && !files_used_) pipe_.close(system_);
        opened_ = false;
    }

    Status next(std::int64_t patience_us, Frame& frame) {
        if (const Status s = begin(frame); s != Status::ok) return s;
        return first(system_.monotonic_us() + patience_us, frame, [](const hal::FrameInfo&) { return true; });
    }
    Status latest(std::int64_t max_age_us, std::int64_t patience_us, Frame& frame);
    Status after(std::int64_t moment_us, std::int64_t patience_us, Frame& frame);

    bool opened() const { return opened_; }
    bool streaming() const { return streaming_; }
    /// 0 where frames come as they are asked for. Of a watched folder the largest number: its pictures come
    /// when they come, and nobody is to take that for a fault.
    std::int32_t interval_us() const {
        return options_.end == ReplayEnd::watch ? std::numeric_limits<std::int32_t>::max()
                                                : options_.interval_us;
    }
    const hal::FrameCounters& counters() const { return counters_; }
    const Fault& fault() const { return fault_; }

private:
    friend Frame;
    void take_back(int) { lent_ = false; }

    /// How often a folder is looked at while nothing comes.
    static constexpr std::int64_t look_us = 300000;

    bool paced() const { return options_.interval_us > 0; }
    bool live() const { return !files_used_ && pipe_.live() && !paced(); }
    std::int64_t due_us() const { return epoch_us_ + number_ * options_.interval_us; }

    Status begin(Frame& frame);
    Taken take(hal::FrameInfo& info);
    void pass_over_until(std::int64_t limit_us);
    Status wait(std::int64_t until_us, Status otherwise);
    void lend(const hal::FrameInfo& info, Frame& frame);
    template <class Wanted>
    Status first(std::int64_t until_us, Frame& frame, Wanted wanted);

    System system_;
    ReplayFiles<System> files_;
    ReplayPipe<System> pipe_;
    ReplayPicture picture_;
    ReplayOptions options_;
    hal::FrameCounters counters_;
    Fault fault_;
    bool opened_ = false;
    bool streaming_ = false;
    bool lent_ = false;
    bool files_used_ = false;
    bool silent_ = false;
    /// There was nothing when it was looked last.
    bool idle_ = false;
    std::uint32_t sequence_ = 0;
    /// Frames since the moment from which they become due.
    std::int64_t number_ = 0;
    std::int64_t epoch_us_ = 0;
    /// When a folder is looked at again that had nothing.
    std::int64_t next_look_us_ = 0;
};

static_assert(hal::is_frame_source_v<ReplaySource<>>);

// ---- Implementation ---------------------------------------------------------------

template <class System>
Status ReplaySource<System>::open(const char* path, const ReplayOptions& options, ReplayMemory memory) {
    close();
    const bool standard = std::strcmp(path, "-") == 0;
    struct stat what {};
    const int got =
        uninterrupted([&] { return standard ? system_.about(0, what) : system_.about(path, what); });
    if (got < 0) return refused(fault_, "stat", got);
    const bool folder = S_ISDIR(what.st_mode);
    const bool regular = S_ISREG(what.st_mode);
    const bool raw = options.stream.format != hal::PixelFormat::none;
    const bool gray_or_rgb =
        options.pictures == hal::PixelFormat::gray8 || options.pictures == hal::PixelFormat::rgb24;
    if (options.interval_us < 0 || !gray_or_rgb || (raw && folder) ||
        (options.end == ReplayEnd::watch && !folder))
        return unusable(fault_, "open", Status::bad_argument, "these options do not fit this source");
    files_used_ = folder || (regular && !raw && !standard);
    if (files_used_) {
        if (const Status s = files_.open(path, folder, options.end, memory.file); s != Status::ok)
            return unusable(fault_, "open", s, "this path is too long");
    } else {
        using Kind = typename ReplayPipe<System>::Kind;
        const Kind kind = regular                               ? Kind::file
                          : S_ISFIFO(what.st_mode) && !standard ? Kind::fifo
                                                                : Kind::input;
        const Status s = pipe_.open(system_, path, kind, options.end == ReplayEnd::repeat, options.stream,
                                    memory.file, fault_);
        if (s != Status::ok) return s;
    }
    options_ = options;
    picture_ = {options.pictures, options.size, memory.picture};
    counters_ = {};
    fault_ = {};
    sequence_ = 0;
    opened_ = true;
    return Status::ok;
}

template <class System>
Status ReplaySource<System>::start() {
    if (!opened_ || streaming_)
        return unusable(fault_, "start", opened_ ? Status::bad_argument : Status::device_lost,
                        opened_ ? "the source is started already" : "the source is not open");
    streaming_ = true;
    idle_ = false;
    number_ = 0;
    epoch_us_ = next_look_us_ = system_.monotonic_us();
    pipe_.restart(epoch_us_);
    return Status::ok;
}

template <class System>
Status ReplaySource<System>::begin(Frame& frame) {
    frame.give_back();
    if (!opened_) return unusable(fault_, "next", Status::device_lost, "the source is not open");
    if (!streaming_ || lent_)
        return unusable(fault_, "next", Status::bad_argument,
                        lent_ ? "the frame before is still lent" : "the source was not started");
    return Status::ok;
}

/// Takes the next frame if one is there, into the picture's memory, and counts what cannot be used.
template <class System>
Taken ReplaySource<System>::take(hal::FrameInfo& info) {
    const std::int64_t now_us = system_.monotonic_us();
    if (files_used_ && now_us < next_look_us_) return silent_ ? Taken::silent : Taken::nothing;
    info = {};
    std::int64_t time_us = now_us;
    std::int64_t begun_us = now_us;
    const Taken taken = files_used_ ? files_.take(system_, now_us, picture_, info, fault_)
                                    : pipe_.take(system_, now_us, picture_, info, begun_us, fault_);
    silent_ = taken == Taken::silent;
    const bool came = taken != Taken::nothing && taken != Taken::silent;
    if (!came && files_used_) next_look_us_ = now_us + look_us;
    // What comes after a pause is due when it is seen, and the others behind it.
    if ((!came || idle_) && due_us() < now_us) epoch_us_ += now_us - due_us();
    idle_ = !came;
    if (taken != Taken::frame && taken != Taken::damaged && taken != Taken::gone) return taken;
    if (paced())
        time_us = due_us();
    else if (live())
        time_us = begun_us;
    info.sequence = sequence_++;
    info.time_us = time_us;
    ++number_;
    if (taken == Taken::damaged) ++counters_.damaged;
    if (taken == Taken::gone) ++counters_.missed;
    return taken;
}

/// Passes over files that were due before a moment, unread.
template <class System>
void ReplaySource<System>::pass_over_until(std::int64_t limit_us) {
    if (!files_used_ || !paced() || idle_) return;
    while (due_us() < limit_us && files_.pass_over(system_, fault_) == Taken::frame) {
        ++sequence_;
        ++number_;
        ++counters_.passed_over;
    }
}

/// Waits until something may have changed. ok: look again.
template <class System>
Status ReplaySource<System>::wait(std::int64_t until_us, Status otherwise) {
    const std::int64_t now_us = system_.monotonic_us();
    if (now_us >= until_us) return otherwise;
    std::int64_t wake_us = until_us;
    const auto sooner = [&](std::int64_t moment_us) {
        if (moment_us < wake_us) wake_us = moment_us;
    };
    pollfd asked{-1, 0, 0};
    if (paced() && due_us() > now_us)
        sooner(due_us());
    else if (!files_used_)
        asked = pipe_.asked();
    else if (otherwise != Status::no_signal)
        sooner(next_look_us_);
    if (wake_us <= now_us) return Status::ok;
    const int got = system_.poll({&asked, 1}, wake_us - now_us);
    // Who waits looks first what the signal wants.
    if (got == -EINTR) return otherwise;
    if (got < 0) return refused(fault_, "poll", got);
    if (got > 0) pipe_.answered(asked);
    return Status::ok;
}

template <class System>
void ReplaySource<System>::lend(const hal::FrameInfo& info, Frame& frame) {
    ++counters_.lent;
    lent_ = true;
    frame.lend(*this, 0, info);
}

/// The first frame that is wanted.
template <class System>
template <class Wanted>
Status ReplaySource<System>::first(std::int64_t until_us, Frame& frame, Wanted wanted) {
    for (;;) {
        Taken taken = Taken::nothing;
        if (!paced() || due_us() <= system_.monotonic_us()) {
            hal::FrameInfo info;
            taken = take(info);
            if (taken == Taken::failed) return fault_.status;
            if (taken == Taken::frame && wanted(info)) {
                lend(info, frame);
                return Status::ok;
            }
            if (taken == Taken::frame) ++counters_.passed_over;
        }
        const Status otherwise = taken == Taken::silent ? Status::no_signal : Status::timeout;
        const bool again = taken != Taken::nothing && taken != Taken::silent;
        if (again && system_.monotonic_us() < until_us) continue;
        if (const Status s = again ? Status::timeout : wait(until_us, otherwise); s != Status::ok) return s;
    }
}

/// The newest frame there is, or the next if that is too old.
template <class System>
Status ReplaySource<System>::latest(std::int64_t max_age_us, std::int64_t patience_us, Frame& frame) {
    if (const Status s = begin(frame); s != Status::ok) return s;
    const std::int64_t now_us = system_.monotonic_us();
    // All whose successor is due.
    pass_over_until(now_us - options_.interval_us + 1);
    const auto fresh = [&](const hal::FrameInfo& info) {
        return system_.monotonic_us() - info.time_us <= max_age_us;
    };
    if (files_used_) return first(now_us + patience_us, frame, fresh);
    // All that is in the pipe, or is due of it. What is read after that much was written since.
    const std::int64_t enough = pipe_.read_bytes() + ReplayPipe<System>::most_read;
    return first(now_us + patience_us, frame, [&](hal::FrameInfo& newest) {
        while (paced() ? due_us() <= now_us : pipe_.read_bytes() < enough) {
            hal::FrameInfo newer;
            const Taken taken = take(newer);
            if (taken == Taken::frame) {
                ++counters_.passed_over;
                newest = newer;
            } else if (taken != Taken::damaged) {
                break;
            }
        }
        return fresh(newest);
    });
}

/// The first frame that was wholly taken after a moment.
template <class System>
Status ReplaySource<System>::after(std::int64_t moment_us, std::int64_t patience_us, Frame& frame) {
    if (const Status s = begin(frame); s != Status::ok) return s;
    const std::int64_t now_us = system_.monotonic_us();
    const std::int64_t until_us = now_us + patience_us;
    pass_over_until(moment_us < now_us ? moment_us : now_us);
    // What comes when it is asked for is not asked for before the moment.
    while (!paced() && !live() && system_.monotonic_us() < moment_us) {
        const std::int64_t left_us = (moment_us < until_us ? moment_us : until_us) - system_.monotonic_us();
        if (left_us <= 0) return Status::timeout;
        pollfd nothing{-1, 0, 0};
        const int got = system_.poll({&nothing, 1}, left_us);
        if (got == -EINTR) return Status::timeout;
        if (got < 0) return refused(fault_, "poll", got);
    }
    return first(until_us, frame, [&](const hal::FrameInfo& info) { return info.time_us >= moment_us; });
}

}  // namespace fovea::linux_port
