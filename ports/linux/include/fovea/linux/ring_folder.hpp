// SPDX-License-Identifier: MIT
//
// RingFolder: the newest pictures of a kind in a folder, each with what is told of it, within a budget.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/folder_path.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

/// What a ring may take.
struct RingLimits {
    /// Lengths of all files. What a file system takes beside that, for blocks and names, is not counted.
    std::int64_t bytes = std::int64_t{64} << 20;
    int pairs = 100;
};

/// Pairs of files NNNNNNNN.pgm and NNNNNNNN.json, numbered in the order they were stored; after a restart by
/// one more than the largest number found. The oldest pairs go first, before a new one is written.
///
/// Both files are written beside their names, synced, and renamed, the picture last: a picture that is there
/// is whole, and so is what belongs to it. What a power cut or an error has left of a pair is removed with
/// the next store. Of the folder only files with these names, or these and ".new", are touched; no name leads
/// out of it. Nothing is kept in memory but the next number: the folder is looked through at every store, so
/// that it is right also when others have taken files away.
///
/// Blocks for as long as the disk does. Not for two threads, nor a folder for two rings.
template <class System = Kernel>
class RingFolder {
public:
    /// More of them would make each store slow.
    static constexpr int most_pairs = 1000;

    explicit RingFolder(System system = {}) : system_(system) {}

    /// Sets the folder, which is made with the first store if its parent is there.
    ///
    /// Errors  bad_argument for a path that is too long or limits below one pair or above most_pairs
    Status open(const char* folder, const RingLimits& limits) {
        if (limits.bytes < 1 || limits.pairs < 1 || limits.pairs > most_pairs) return Status::bad_argument;
        limits_ = limits;
        next_ = 0;
        return path_.set(folder);
    }

    /// Stores a pair, and makes room for it before.
    ///
    /// Errors  buffer_too_small for a pair above the budget, with all that was there left there; else as the
    ///         calls say. Nothing is left of the pair then, if the system let it be removed
    Status store(Span<const std::uint8_t> picture, Span<const std::uint8_t> sidecar);

    /// The number of the pair that was stored last.
    std::int64_t last_number() const { return next_ - 1; }
    const Fault& fault() const { return fault_; }

private:
    enum Kind : std::uint8_t { pgm, json, new_pgm, new_json };
    static constexpr const char* endings[] = {".pgm", ".json", ".pgm.new", ".json.new"};
    /// Of a number: eight digits at least, so that names sort as numbers do.
    static constexpr int least_digits = 8;
    static constexpr int most_digits = 15;
    struct Name {
        char text[32];
    };

    /// What the folder holds.
    struct Found {
        int pairs = 0;
        std::int64_t bytes = 0;
        std::int64_t oldest = -1;
        std::int64_t largest = -1;
        /// A file that belongs to no whole pair.
        bool left_over = false;
        Name left{};
    };

    static Name name_of(std::int64_t number, Kind kind);
    static bool is_own(const char* name, std::int64_t& number, Kind& kind);
    Status refused_by(const char* call, std::ptrdiff_t got) { return refused(fault_, call, got); }
    /// Bytes of a file of the folder; below 0 where there is none of them. What the system does not tell must
    /// not be taken for a file that is not there.
    std::int64_t length_of(std::int64_t number, Kind kind, Status& status) {
        struct stat what {};
        const char* const path = path_.file(name_of(number, kind).text);
        const int got = uninterrupted([&] { return system_.about(path, what); });
        if (got < 0 && got != -ENOENT && got != -ELOOP) status = refused_by("stat", got);
        return got < 0 || !S_ISREG(what.st_mode) ? -1 : what.st_size;
    }
    Status remove(const Name& name) {
        const char* const path = path_.file(name.text);
        int got = uninterrupted([&] { return system_.remove(path); });
        // Half a pair is worse than one try more.
        if (got < 0 && got != -ENOENT) got = uninterrupted([&] { return system_.remove(path); });
        return got < 0 && got != -ENOENT ? refused_by("unlink", got) : Status::ok;
    }

    Status look(Found& found);
    Status clean(Found& found);
    Status make_room(std::int64_t bytes);
    Status write_new(const Name& name, Span<const std::uint8_t> bytes);
    Status rename_new(std::int64_t number, Kind from, Kind to);

    System system_;
    FolderPath path_;
    /// For the second path of a call.
    FolderPath other_path_;
    RingLimits limits_;
    std::int64_t next_ = 0;
    Fault fault_;
};

// ---- Implementation ---------------------------------------------------------------

template <class System>
typename RingFolder<System>::Name RingFolder<System>::name_of(std::int64_t number, Kind kind) {
    Name name{};
    int digits = least_digits;
    for (std::int64_t rest = number / 100000000; rest > 0; rest /= 10) ++digits;
    for (int i = digits - 1; i >= 0; --i, number /= 10) name.text[i] = static_cast<char>('0' + number % 10);
    std::strcpy(name.text + digits, endings[kind]);
    return name;
}

/// True for a name that name_of() makes.
template <class System>
bool RingFolder<System>::is_own(const char* name, std::int64_t& number, Kind& kind) {
    int digits = 0;
    number = 0;
    for (; name[digits] >= '0' && name[digits] <= '9' && digits <= most_digits; ++digits)
        number = number * 10 + (name[digits] - '0');
    if (digits < least_digits || digits > most_digits || (digits > least_digits && name[0] == '0'))
        return false;
    for (const Kind one : {pgm, json, new_pgm, new_json})
        if (std::strcmp(name + digits, endings[one]) == 0) {
            kind = one;
            return true;
        }
    return false;
}

template <class System>
Status RingFolder<System>::look(Found& found) {
    found = {};
    Status status = Status::ok;
    const Status all = each_name(system_, path_.folder(), fault_, [&](const char* name) {
        std::int64_t number = 0;
        Kind kind = pgm;
        if (status != Status::ok || !is_own(name, number, kind)) return;
        if (number > found.largest) found.largest = number;
        const std::int64_t own = length_of(number, kind, status);
        if (own < 0) return;
        if (kind != pgm) {
            // What is told of a picture is counted with it.
            const bool told = kind == json && length_of(number, pgm, status) >= 0;
            if (told || status != Status::ok) return;
            found.left_over = true;
            found.left = name_of(number, kind);
            return;
        }
        const std::int64_t sidecar = length_of(number, json, status);
        const std::int64_t bytes = own + (sidecar > 0 ? sidecar : 0);
        ++found.pairs;
        found.bytes += bytes;
        if (found.oldest < 0 || number < found.oldest) found.oldest = number;
    });
    return status == Status::ok ? all : status;
}

/// Looks through the folder until nothing is left over in it.
template <class System>
Status RingFolder<System>::clean(Found& found) {
    for (;;) {
        if (const Status s = look(found); s != Status::ok) return s;
        if (found.largest >= next_) next_ = found.largest + 1;
        if (!found.left_over) return Status::ok;
        if (const Status s = remove(found.left); s != Status::ok) return s;
    }
}

template <class System>
Status RingFolder<System>::make_room(std::int64_t bytes) {
    for (;;) {
        Found found;
        if (const Status s = clean(found); s != Status::ok) return s;
        if (found.pairs < limits_.pairs && found.bytes + bytes <= limits_.bytes) return Status::ok;
        // The picture first: what is left without it is known to belong to none.
        if (const Status s = remove(name_of(found.oldest, pgm)); s != Status::ok) return s;
        if (const Status s = remove(name_of(found.oldest, json)); s != Status::ok) return s;
    }
}

template <class System>
Status RingFolder<System>::write_new(const Name& name, Span<const std::uint8_t> bytes) {
    const char* const path = path_.file(name.text);
    // Made anew and no other way, so that nothing that bears the name leads elsewhere.
    int file = uninterrupted(
        [&] { return system_.open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644); });
    if (file < 0) return refused_by("open", file);
    Status status = Status::ok;
    while (status == Status::ok && !bytes.empty()) {
        const std::ptrdiff_t wrote = uninterrupted([&] { return system_.write(file, bytes); });
        if (wrote > 0)
            bytes = bytes.from(wrote);
        else
            status = refused_by("write", wrote < 0 ? wrote : -ENOSPC);
    }
    if (status == Status::ok)
        if (const int got = uninterrupted([&] { return system_.sync(file); }); got < 0)
            status = refused_by("fsync", got);
    const int closed = close_file(system_, file);
    return status == Status::ok && closed < 0 ? refused_by("close", closed) : status;
}

template <class System>
Status RingFolder<System>::rename_new(std::int64_t number, Kind from, Kind to) {
    if (const Status s = other_path_.set(path_.folder()); s != Status::ok) return s;
    const char* const old_path = other_path_.file(name_of(number, from).text);
    const char* const new_path = path_.file(name_of(number, to).text);
    const int got = uninterrupted([&] { return system_.rename(old_path, new_path); });
    return got < 0 ? refused_by("rename", got) : Status::ok;
}

template <class System>
Status RingFolder<System>::store(Span<const std::uint8_t> picture, Span<const std::uint8_t> sidecar) {
    const std::int64_t bytes = std::int64_t{picture.size()} + sidecar.size();
    if (bytes > limits_.bytes)
        return unusable(fault_, "write", Status::buffer_too_small, "a picture is larger than the whole ring");
    const int made = uninterrupted([&] { return system_.make_folder(path_.folder(), 0755); });
    // Whatever else is wrong with the folder, looking into it tells.
    if (made < 0 && made != -EEXIST && made != -EROFS && made != -EACCES) return refused_by("mkdir", made);
    if (const Status s = make_room(bytes); s != Status::ok) return s;

    const std::int64_t number = next_++;
    Status status = write_new(name_of(number, new_json), sidecar);
    if (status == Status::ok) status = write_new(name_of(number, new_pgm), picture);
    if (status == Status::ok) status = rename_new(number, new_json, json);
    if (status == Status::ok) status = rename_new(number, new_pgm, pgm);
    if (status == Status::ok) return status;
    const Fault first = fault_;
    for (const Kind kind : {new_pgm, new_json, json}) static_cast<void>(remove(name_of(number, kind)));
    next_ = number;
    fault_ = first;
    return status;
}

}  // namespace fovea::linux_port
