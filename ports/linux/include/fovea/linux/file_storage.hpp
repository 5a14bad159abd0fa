// SPDX-License-Identifier: MIT
//
// FileStorage: files of a Linux system as hal storage. A file is replaced whole or not at all.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/storage.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/replace_file.hpp>

namespace fovea::linux_port {

// ---- Interface --------------------------------------------------------------------

/// Reads and replaces files. "-" is the standard input for load() and the standard output for save().
template <class System = Kernel>
class FileStorage {
public:
    /// max_file is the size of the largest file that load() takes, so that a wrong name cannot fill the
    /// memory.
    explicit FileStorage(System system = {}, std::size_t max_file = std::size_t{256} << 20)
        : system_(system), max_file_(max_file) {}

    Result<Span<const std::uint8_t>> load(const char* name);

    /// Writes beside the file, syncs, and renames over it, so that a power cut leaves the old or the new
    /// bytes. When the folder cannot be synced, which comes last, the new bytes stand and an error is told.
    Status save(const char* name, Span<const std::uint8_t> bytes);

    /// What the system said about the last io_error or not_found.
    const char* problem() const { return fault_.call[0] == '\0' ? "" : reason(fault_); }
    const Fault& fault() const { return fault_; }

private:
    Status refuse(const char* call, std::ptrdiff_t answer) {
        return detail::refuse_storage(call, answer, fault_);
    }
    int open(const char* name, int flags) {
        return uninterrupted([&] { return system_.open(name, flags | O_CLOEXEC); });
    }
    Status replace(const std::string& path, Span<const std::uint8_t> bytes);

    System system_;
    std::size_t max_file_;
    std::vector<std::uint8_t> bytes_;
    Fault fault_;
};

static_assert(hal::is_storage_v<FileStorage<>>);

// ---- Implementation ---------------------------------------------------------------

template <class System>
Result<Span<const std::uint8_t>> FileStorage<System>::load(const char* name) {
    const bool standard = std::strcmp(name, "-") == 0;
    int file = standard ? STDIN_FILENO : open(name, O_RDONLY);
    if (file < 0) return refuse("open", file);
    bytes_.clear();
    Status status = Status::ok;
    for (;;) {
        const std::size_t have = bytes_.size();
        if (have > max_file_) {
            status = refuse("read", -EFBIG);
            break;
        }
        // One byte more than allowed tells a file that is too large from one that just fits.
        bytes_.resize(std::min(std::max(2 * have, std::size_t{65536}), max_file_ + 1));
        const Span<std::uint8_t> room(bytes_.data() + have,
                                      static_cast<std::ptrdiff_t>(bytes_.size() - have));
        const std::ptrdiff_t got = uninterrupted([&] { return system_.read(file, room); });
        bytes_.resize(have + static_cast<std::size_t>(got > 0 ? got : 0));
        if (got < 0) status = refuse("read", got);
        if (got <= 0) break;
    }
    if (!standard) static_cast<void>(close_file(system_, file));
    if (status != Status::ok) return status;
    return Span<const std::uint8_t>(bytes_.data(), static_cast<std::ptrdiff_t>(bytes_.size()));
}

template <class System>
Status FileStorage<System>::replace(const std::string& path, Span<const std::uint8_t> bytes) {
    const std::string beside = path + "." + std::to_string(system_.process_id()) + ".new";
    const std::size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
    return replace_file(system_, folder.c_str(), beside.c_str(), path.c_str(), {}, bytes, fault_);
}

template <class System>
Status FileStorage<System>::save(const char* name, Span<const std::uint8_t> bytes) {
    if (std::strcmp(name, "-") == 0) return write_all(system_, STDOUT_FILENO, bytes, fault_);
    // Devices and pipes cannot be replaced, only written to.
    struct stat about {};
    if (uninterrupted([&] { return system_.about(name, about); }) < 0 || S_ISREG(about.st_mode))
        return replace(name, bytes);
    int file = open(name, O_WRONLY);
    if (file < 0) return refuse("open", file);
    const Status status = write_all(system_, file, bytes, fault_);
    static_cast<void>(close_file(system_, file));
    return status;
}

}  // namespace fovea::linux_port
