// SPDX-License-Identifier: MIT
//
// ReplayPipe: frames that another program writes into a FIFO or into the standard input, or that lie one
// behind the other in a file.
#pragma once

#include <fcntl.h>
#include <poll.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/folder_path.hpp>
#include <fovea/linux/frame_stream.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/replay_picture.hpp>

namespace fovea::linux_port {

/// Never waits. The writer of a FIFO may go away, and another may come: what was left of a frame is damaged,
/// and the next byte begins a new one. The end of anything else is its end.
template <class System>
class ReplayPipe {
public:
    /// The most that is read in search of a frame before take() answers that there is none yet: more than a
    /// pipe holds unless its size was raised by the administrator (pipe-max-size).
    static constexpr std::ptrdiff_t most_read = 1 << 20;

    enum class Kind : std::uint8_t { fifo, input, file };

    /// "-" is the standard input. memory takes one frame as it is sent.
    Status open(System& system, const char* path, Kind kind, bool repeat, const StreamFormat& format,
                Span<std::uint8_t> memory, Fault& fault) {
        kind_ = kind;
        repeat_ = repeat && kind == Kind::file;
        standard_ = std::strcmp(path, "-") == 0;
        if (const Status s = path_.set(path); s != Status::ok)
            return unusable(fault, "open", s, "this path is too long");
        if (const Status s = stream_.begin(format, memory); s != Status::ok)
            return unusable(fault, "open", s, "no stream of frames for this memory");
        pictures_ = format.format == hal::PixelFormat::none;
        writer_ = hung_up_ = ended_ = whole_ = false;
        file_ = standard_ ? 0 : again(system);
        return file_ < 0 ? refused(fault, "open", file_) : Status::ok;
    }
    void close(System& system) {
        if (!standard_) static_cast<void>(close_file(system, file_));
        file_ = -1;
    }

    /// What is in it already counts as of now.
    void restart(std::int64_t now_us) {
        if (empty_us_ < now_us) empty_us_ = now_us;
    }

    /// The next frame. begun_us: it is not older than this, the last moment before its first byte at which
    /// the pipe was seen empty.
    Taken take(System& system, std::int64_t now_us, ReplayPicture& picture, hal::FrameInfo& info,
               std::int64_t& begun_us, Fault& fault) {
        for (std::ptrdiff_t read = 0; read <= most_read;) {
            const Status status = stream_.look();
            if (status == Status::ok) {
                begun_us = begun_us_;
                const Taken taken = finish(picture, info, fault);
                begun_us_ = empty_us_;
                return taken;
            }
            if (status != Status::timeout) {
                static_cast<void>(unusable(fault, "read", status, "there is no picture in the stream"));
                return Taken::damaged;
            }
            if (ended_) return Taken::silent;
            const std::ptrdiff_t got = read_more(system);
            if (got == -EAGAIN) {
                writer_ = true;
                empty_us_ = now_us;
                return Taken::nothing;
            }
            if (got < 0) {
                static_cast<void>(refused(fault, "read", got));
                return Taken::failed;
            }
            if (got == 0) return end(system, now_us, fault);
            writer_ = true;
            if (stream_.between_frames()) begun_us_ = empty_us_;
            stream_.filled(got);
            read += got;
        }
        return Taken::nothing;
    }

    /// What is to be waited for; a file below 0 is none.
    pollfd asked() const { return {ended_ ? -1 : file_, POLLIN, 0}; }
    /// Tells what was answered.
    void answered(const pollfd& file) {
        if ((file.revents & POLLHUP) != 0 && (file.revents & POLLIN) == 0) hung_up_ = true;
    }
    /// Frames come when the writer has them.
    bool live() const { return kind_ != Kind::file; }
    /// Bytes that were read in all.
    std::int64_t read_bytes() const { return read_bytes_; }

private:
    int again(System& system) {
        return uninterrupted([&] { return system.open(path_.folder(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); });
    }

    std::ptrdiff_t read_more(System& system) {
        // The standard input is shared with others and stays as it is, so it is asked before it is read.
        if (kind_ == Kind::input) {
            pollfd file{file_, POLLIN, 0};
            const int got = system.poll({&file, 1}, 0);
            if (got == 0 || got == -EINTR) return -EAGAIN;
            if (got < 0) return got;
        }
        const std::ptrdiff_t got = uninterrupted([&] { return system.read(file_, stream_.room()); });
        if (got > 0) read_bytes_ += got;
        return got;
    }

    Taken finish(ReplayPicture& picture, hal::FrameInfo& info, Fault& fault) {
        const Span<const std::uint8_t> bytes = stream_.bytes();
        Status status = Status::ok;
        if (pictures_) {
            status = picture.decode(bytes, info);
        } else if (picture.memory.size() < bytes.size()) {
            status = Status::buffer_too_small;
        } else {
            std::memcpy(picture.memory.data(), bytes.data(), static_cast<std::size_t>(bytes.size()));
            stream_.place(picture.memory.first(bytes.size()), info);
        }
        stream_.drop();
        whole_ = whole_ || status == Status::ok;
        if (status == Status::ok) return Taken::frame;
        static_cast<void>(unusable(fault, "decode", status, describe(status)));
        return Taken::damaged;
    }

    /// There are no more bytes, and nobody writes any.
    Taken end(System& system, std::int64_t now_us, Fault& fault) {
        const bool torn = !stream_.between_frames();
        stream_.restart();
        empty_us_ = now_us;
        const bool reopens = kind_ == Kind::fifo ? writer_ || hung_up_ : repeat_ && whole_;
        if (reopens) {
            // Opened before the old one is closed, so that a writer always has a reader. A new reader of a
            // FIFO is not told of writers that went away before, so that it can wait for the next.
            const int file = again(system);
            if (file < 0) {
                static_cast<void>(refused(fault, "open", file));
                if (fault.status == Status::not_found) fault.status = Status::device_lost;
                return Taken::failed;
            }
            static_cast<void>(close_file(system, file_));
            file_ = file;
            writer_ = hung_up_ = whole_ = false;
        } else if (kind_ != Kind::fifo) {
            ended_ = true;
        }
        if (torn) {
            static_cast<void>(unusable(fault, "read", Status::truncated, "the stream ended within a frame"));
            return Taken::damaged;
        }
        return kind_ == Kind::file && reopens ? Taken::nothing : Taken::silent;
    }

    FrameStream stream_;
    FolderPath path_;
    Kind kind_ = Kind::file;
    bool standard_ = false;
    bool repeat_ = false;
    bool pictures_ = false;
    bool writer_ = false;
    bool hung_up_ = false;
    bool ended_ = false;
    /// There was a frame that could be used, since the file was opened.
    bool whole_ = false;
    int file_ = -1;
    std::int64_t empty_us_ = 0;
    std::int64_t begun_us_ = 0;
    std::int64_t read_bytes_ = 0;
};

}  // namespace fovea::linux_port
