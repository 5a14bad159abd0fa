// SPDX-License-Identifier: MIT
//
// What a folder holds, without memory of its own: names one by one, and paths of its files.
#pragma once

#include <fcntl.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

/// The path of a folder and room for the name of a file in it.
class FolderPath {
public:
    /// The longest path of a folder; names have 255 bytes at most (NAME_MAX).
    static constexpr std::size_t max_folder = 1024;

    /// Errors  bad_argument for an empty path or one that is too long
    Status set(const char* folder) {
        folder_ = std::strlen(folder);
        if (folder_ == 0 || folder_ > max_folder) {
            folder_ = 0;
            return Status::bad_argument;
        }
        std::memcpy(path_, folder, folder_ + 1);
        return Status::ok;
    }
    const char* folder() {
        path_[folder_] = '\0';
        return path_;
    }
    /// The path of a file; names longer than 255 bytes are cut. Valid until the next call.
    const char* file(const char* name) {
        std::size_t length = std::strlen(name);
        if (length > 255) length = 255;
        path_[folder_] = '/';
        std::memcpy(path_ + folder_ + 1, name, length);
        path_[folder_ + 1 + length] = '\0';
        return path_;
    }

private:
    char path_[max_folder + 258] = {};
    std::size_t folder_ = 0;
};

/// Calls visit(const char* name) for all that a folder holds, in no order.
///
/// Errors  as the calls say; io_error for records that the kernel would not make
template <class System, class Visit>
Status each_name(System& system, const char* folder, Fault& fault, Visit visit) {
    int file = uninterrupted([&] { return system.open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
    if (file < 0) return refused(fault, "open", file);
    // getdents64(2): 8 bytes of number, 8 of offset, 2 of length, 1 of type, and the name with its zero.
    constexpr std::ptrdiff_t name_at = 19;
    alignas(8) std::uint8_t records[4096];
    Status status = Status::ok;
    while (status == Status::ok) {
        const std::ptrdiff_t got = uninterrupted([&] { return system.entries(file, records); });
        if (got < 0) status = refused(fault, "getdents64", got);
        if (got <= 0) break;
        for (std::ptrdiff_t at = 0; at < got;) {
            std::uint16_t length = 0;
            if (got - at > name_at) std::memcpy(&length, records + at + 16, sizeof length);
            const auto* const name = reinterpret_cast<const char*>(records + at + name_at);
            if (length <= name_at || length > got - at ||
                std::memchr(name, 0, static_cast<std::size_t>(length - name_at)) == nullptr) {
                status = unusable(fault, "getdents64", Status::io_error, "records that cannot be read");
                break;
            }
            visit(name);
            at += length;
        }
    }
    static_cast<void>(close_file(system, file));
    return status;
}

/// True if a name ends so; the ending is of small letters, the name of either.
inline bool has_ending(const char* name, const char* ending) {
    const std::size_t length = std::strlen(name);
    const std::size_t last = std::strlen(ending);
    if (length <= last) return false;
    for (std::size_t i = 0; i < last; ++i) {
        const char c = name[length - last + i];
        if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != ending[i]) return false;
    }
    return true;
}

}  // namespace fovea::linux_port
