// SPDX-License-Identifier: MIT
//
// Paths of the files of a folder, without memory of their own.
#pragma once

#include <cstddef>
#include <cstring>

#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/folder.hpp>

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

/// Calls visit(const char* name) for all that a folder holds; see each_entry().
template <class System, class Visit>
Status each_name(System& system, const char* folder, Fault& fault, Visit visit) {
    return each_entry(system, folder, fault, [&](const char* name) {
        visit(name);
        return Status::ok;
    });
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
