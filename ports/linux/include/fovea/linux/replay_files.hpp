// SPDX-License-Identifier: MIT
//
// ReplayFiles: the pictures of a folder in the order of their names, or one picture.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/folder_path.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/replay_picture.hpp>

namespace fovea::linux_port {

/// What follows the last frame.
enum class ReplayEnd : std::uint8_t {
    stop,    ///< nothing: the source is silent
    repeat,  ///< the first one again
    watch,   ///< of a folder: the next one that comes
};

/// Names are compared byte by byte, as LC_ALL=C ls has them: 9.pgm comes behind 10.pgm. Read are those that
/// end with .pgm, .ppm, .pnm, .png, .bmp, .jpg and .jpeg, capitals or not, and do not begin with a dot.
///
/// Of a watched folder the next picture is the first one behind the last: one that comes late, with a name
/// in front of it, is not taken. A picture counts as whole when its size and its time have not changed for
/// settle_us, or when one with a later name is there and it can be decoded; one that is renamed into the
/// folder is whole by then.
template <class System>
class ReplayFiles {
public:
    static constexpr std::int64_t settle_us = 250000;

    /// memory takes a file as it is. Opened again with the folder that it watched before, it goes on where
    /// it was: a folder that was gone for a while is not taken for a new one.
    Status open(const char* path, bool folder, ReplayEnd end, Span<std::uint8_t> memory) {
        const bool goes_on =
            folder && end == ReplayEnd::watch && watched_ && std::strcmp(path_.folder(), path) == 0;
        if (const Status s = path_.set(path); s != Status::ok) return s;
        if (!goes_on) last_[0] = '\0';
        folder_ = folder;
        end_ = end;
        watched_ = folder && end == ReplayEnd::watch;
        memory_ = memory;
        whole_ = false;
        seen_[0] = '\0';
        return Status::ok;
    }

    /// The next picture.
    Taken take(System& system, std::int64_t now_us, ReplayPicture& picture, hal::FrameInfo& info,
               Fault& fault) {
        bool later = false;
        if (const Taken found = find(system, later, fault); found != Taken::frame) return found;
        const char* const path = folder_ ? path_.file(next_) : path_.folder();
        if (watched_ && !later && !settled(system, path, now_us)) return Taken::nothing;
        const Taken taken = load(system, path, picture, info, fault);
        if (taken == Taken::failed) return taken;
        if (taken == Taken::damaged && watched_ && !settled(system, path, now_us)) return Taken::nothing;
        whole_ = whole_ || taken == Taken::frame;
        std::memcpy(last_, next_, sizeof last_);
        return taken;
    }
    /// Steps over the next one, whatever it is.
    Taken pass_over(System& system, Fault& fault) {
        bool later = false;
        const Taken found = find(system, later, fault);
        if (found != Taken::frame) return found;
        std::memcpy(last_, next_, sizeof last_);
        // It may be good.
        whole_ = true;
        return found;
    }

private:
    using Name = char[256];

    static bool is_picture(const char* name) {
        if (name[0] == '.' || std::strlen(name) >= sizeof(Name)) return false;
        for (const char* ending : {".pgm", ".ppm", ".pnm", ".png", ".bmp", ".jpg", ".jpeg"})
            if (has_ending(name, ending)) return true;
        return false;
    }

    /// Sets the name behind the last, and whether there is one behind that.
    Taken find(System& system, bool& later, Fault& fault) {
        for (;;) {
            next_[0] = '\0';
            if (!folder_) {
                // A picture of its own is the only one, whatever its name.
                if (last_[0] == '\0') std::strcpy(next_, "it");
            } else if (const Status s = find_behind_last(system, later, fault); s != Status::ok) {
                // A folder that was there and is not has been taken away, with all that is in it.
                if (s == Status::not_found) fault.status = Status::device_lost;
                return Taken::failed;
            }
            if (next_[0] != '\0') return Taken::frame;
            if (end_ == ReplayEnd::watch) return Taken::nothing;
            // Without a whole picture, a second round would find none either.
            if (end_ == ReplayEnd::stop || !whole_) return Taken::silent;
            last_[0] = '\0';
            whole_ = false;
        }
    }
    Status find_behind_last(System& system, bool& later, Fault& fault) {
        later = false;
        return each_name(system, path_.folder(), fault, [&](const char* name) {
            if (!is_picture(name) || std::strcmp(name, last_) <= 0) return;
            if (next_[0] != '\0') later = true;
            if (next_[0] == '\0' || std::strcmp(name, next_) < 0) std::strcpy(next_, name);
        });
    }

    /// True if the file is as it was when it was looked at some time ago.
    bool settled(System& system, const char* path, std::int64_t now_us) {
        struct stat what {};
        // What cannot be looked at is not going to change; loading it tells.
        if (uninterrupted([&] { return system.about(path, what); }) < 0) return true;
        const bool same = std::strcmp(seen_, next_) == 0 && seen_bytes_ == what.st_size &&
                          seen_seconds_ == what.st_mtim.tv_sec && seen_nanoseconds_ == what.st_mtim.tv_nsec;
        if (same) return now_us - seen_us_ >= settle_us;
        std::memcpy(seen_, next_, sizeof seen_);
        seen_bytes_ = what.st_size;
        seen_seconds_ = what.st_mtim.tv_sec;
        seen_nanoseconds_ = what.st_mtim.tv_nsec;
        seen_us_ = now_us;
        return false;
    }

    /// A shortage of the whole system is no fault of the file: it is tried again.
    static bool shortage(std::ptrdiff_t got) { return got == -EMFILE || got == -ENFILE || got == -ENOMEM; }
    static Taken not_loaded(Fault& fault, const char* call, std::ptrdiff_t got) {
        static_cast<void>(refused(fault, call, got));
        return shortage(got) ? Taken::failed : got == -ENOENT ? Taken::gone : Taken::damaged;
    }

    Taken load(System& system, const char* path, ReplayPicture& picture, hal::FrameInfo& info, Fault& fault) {
        // Whatever bears the name of a picture, it must not block.
        int file = uninterrupted([&] { return system.open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC); });
        if (file < 0) return not_loaded(fault, "open", file);
        std::ptrdiff_t used = 0;
        Taken taken = read_all(system, file, used, fault);
        static_cast<void>(close_file(system, file));
        if (taken != Taken::frame) return taken;
        const Status status = picture.decode(memory_.first(used), info);
        if (status == Status::ok) return Taken::frame;
        static_cast<void>(unusable(fault, "decode", status, describe(status)));
        return Taken::damaged;
    }
    Taken read_all(System& system, int file, std::ptrdiff_t& used, Fault& fault) {
        struct stat what {};
        if (const int got = uninterrupted([&] { return system.about(file, what); }); got < 0)
            return not_loaded(fault, "fstat", got);
        if (!S_ISREG(what.st_mode)) {
            static_cast<void>(unusable(fault, "open", Status::unsupported, "this is not a file"));
            return Taken::damaged;
        }
        for (;;) {
            // One byte more than there is room for tells a file that is too large from one that just fits.
            std::uint8_t more = 0;
            const bool full = used == memory_.size();
            const Span<std::uint8_t> room = full ? Span<std::uint8_t>(&more, 1) : memory_.from(used);
            const std::ptrdiff_t got = uninterrupted([&] { return system.read(file, room); });
            if (got < 0) return not_loaded(fault, "read", got);
            if (got == 0) return Taken::frame;
            if (full) {
                static_cast<void>(unusable(fault, "read", Status::buffer_too_small, "the file is too large"));
                return Taken::damaged;
            }
            used += got;
        }
    }

    FolderPath path_;
    Span<std::uint8_t> memory_;
    bool folder_ = false;
    bool watched_ = false;
    /// There was one that could be used, since the first, or was passed over unread.
    bool whole_ = false;
    ReplayEnd end_ = ReplayEnd::stop;
    Name last_ = {};
    Name next_ = {};
    Name seen_ = {};
    std::int64_t seen_bytes_ = 0;
    std::int64_t seen_seconds_ = 0;
    std::int64_t seen_nanoseconds_ = 0;
    std::int64_t seen_us_ = 0;
};

}  // namespace fovea::linux_port
