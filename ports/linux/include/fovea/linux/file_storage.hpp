// SPDX-License-Identifier: MIT
//
// FileStorage: files of a Linux system as hal storage. A file is replaced whole or not at all.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/storage.hpp>

namespace fovea::linux_port {

/// Reads and replaces files. "-" is the standard input for load() and the standard output for save().
class FileStorage {
public:
    /// max_file is the size of the largest file that load() takes, so that a wrong name cannot fill the
    /// memory.
    explicit FileStorage(std::size_t max_file = std::size_t{256} << 20) : max_file_(max_file) {}

    Result<Span<const std::uint8_t>> load(const char* name);

    /// Writes beside the file, syncs, and renames over it, so that a power cut leaves the old or the new
    /// bytes.
    Status save(const char* name, Span<const std::uint8_t> bytes);

    /// What the system said about the last io_error or not_found.
    const char* problem() const { return problem_.c_str(); }

private:
    Status refuse(int error) {
        problem_ = std::strerror(error);
        return error == ENOENT ? Status::not_found : Status::io_error;
    }
    static int open_again(const char* name, int flags, int mode = 0) {
        int file = -1;
        do file = ::open(name, flags | O_CLOEXEC, mode);
        while (file < 0 && errno == EINTR);
        return file;
    }
    Status write_all(int file, Span<const std::uint8_t> bytes);
    Status replace(const std::string& path, Span<const std::uint8_t> bytes);

    std::size_t max_file_;
    std::vector<std::uint8_t> bytes_;
    std::string problem_;
};

static_assert(hal::is_storage_v<FileStorage>);

inline Result<Span<const std::uint8_t>> FileStorage::load(const char* name) {
    const bool standard = std::strcmp(name, "-") == 0;
    const int file = standard ? STDIN_FILENO : open_again(name, O_RDONLY);
    if (file < 0) return refuse(errno);
    bytes_.clear();
    Status status = Status::ok;
    for (;;) {
        const std::size_t have = bytes_.size();
        if (have > max_file_) {
            status = refuse(EFBIG);
            break;
        }
        // One byte more than allowed tells a file that is too large from one that just fits.
        bytes_.resize(std::min(std::max(2 * have, std::size_t{65536}), max_file_ + 1));
        const ssize_t got = ::read(file, bytes_.data() + have, bytes_.size() - have);
        const int error = errno;
        bytes_.resize(have + static_cast<std::size_t>(got > 0 ? got : 0));
        if (got == 0) break;
        if (got < 0 && error != EINTR) {
            status = refuse(error);
            break;
        }
    }
    if (!standard) ::close(file);
    if (status != Status::ok) return status;
    return Span<const std::uint8_t>(bytes_.data(), static_cast<std::ptrdiff_t>(bytes_.size()));
}

inline Status FileStorage::write_all(int file, Span<const std::uint8_t> bytes) {
    std::ptrdiff_t done = 0;
    while (done < bytes.size()) {
        const ssize_t wrote =
            ::write(file, bytes.data() + done, static_cast<std::size_t>(bytes.size() - done));
        if (wrote < 0 && errno != EINTR) return refuse(errno);
        if (wrote > 0) done += wrote;
    }
    return Status::ok;
}

inline Status FileStorage::replace(const std::string& path, Span<const std::uint8_t> bytes) {
    const std::string beside = path + "." + std::to_string(::getpid()) + ".new";
    const int file = open_again(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file < 0) return refuse(errno);
    Status status = write_all(file, bytes);
    if (status == Status::ok && ::fsync(file) != 0 && errno != EINVAL) status = refuse(errno);
    if (::close(file) != 0 && status == Status::ok) status = refuse(errno);
    if (status == Status::ok && ::rename(beside.c_str(), path.c_str()) != 0) status = refuse(errno);
    if (status != Status::ok) {
        ::unlink(beside.c_str());
        return status;
    }
    // The new name is safe only when its folder is.
    const std::size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
    if (const int parent = open_again(folder.c_str(), O_RDONLY | O_DIRECTORY); parent >= 0) {
        ::fsync(parent);
        ::close(parent);
    }
    return Status::ok;
}

inline Status FileStorage::save(const char* name, Span<const std::uint8_t> bytes) {
    if (std::strcmp(name, "-") == 0) return write_all(STDOUT_FILENO, bytes);
    // Devices and pipes cannot be replaced, only written to.
    struct stat about {};
    if (::stat(name, &about) == 0 && !S_ISREG(about.st_mode)) {
        const int file = open_again(name, O_WRONLY);
        if (file < 0) return refuse(errno);
        const Status status = write_all(file, bytes);
        ::close(file);
        return status;
    }
    return replace(name, bytes);
}

}  // namespace fovea::linux_port
