// SPDX-License-Identifier: MIT
//
// replace_file: a file gets new bytes so that a power cut leaves the old ones or the new ones.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

// ---- Interface --------------------------------------------------------------------

/// Writes all of the bytes, however many go at once.
///
/// Errors  io_error, with the call in the fault
template <class System>
Status write_all(System& system, int file, Span<const std::uint8_t> bytes, Fault& fault);

/// Writes head and bytes to the file `beside`, syncs it, renames it to path, and syncs the folder, which
/// holds both. A file system that cannot sync folders (EINVAL, ENOSYS) is taken as it is.
///
/// Errors  not_found, io_error. Where the fault says "fsync of the folder", the new bytes stand until a power
///         cut, and after it they or the old ones; else the old ones do
template <class System>
Status replace_file(System& system, const char* folder, const char* beside, const char* path,
                    Span<const std::uint8_t> head, Span<const std::uint8_t> bytes, Fault& fault);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline Status refuse_storage(const char* call, std::ptrdiff_t answer, Fault& fault) {
    const int error = static_cast<int>(-answer);
    fault = {call, error, error == ENOENT ? Status::not_found : Status::io_error};
    return fault.status;
}

template <class System>
Status sync_folder(System& system, const char* folder, Fault& fault) {
    int file = uninterrupted([&] { return system.open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
    // Whoever may write into a folder without reading it cannot do better.
    if (file == -EACCES) return Status::ok;
    const int got = file < 0 ? file : uninterrupted([&] { return system.sync(file); });
    static_cast<void>(close_file(system, file));
    if (got >= 0 || got == -EINVAL || got == -ENOSYS) return Status::ok;
    fault = {"fsync of the folder", -got, Status::io_error};
    return Status::io_error;
}

}  // namespace detail

template <class System>
Status write_all(System& system, int file, Span<const std::uint8_t> bytes, Fault& fault) {
    while (!bytes.empty()) {
        const std::ptrdiff_t wrote = uninterrupted([&] { return system.write(file, bytes); });
        if (wrote <= 0) return detail::refuse_storage("write", wrote < 0 ? wrote : -EIO, fault);
        bytes = bytes.from(wrote);
    }
    return Status::ok;
}

template <class System>
Status replace_file(System& system, const char* folder, const char* beside, const char* path,
                    Span<const std::uint8_t> head, Span<const std::uint8_t> bytes, Fault& fault) {
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC;
    int file = uninterrupted([&] { return system.open(beside, flags, 0666); });
    if (file < 0) return detail::refuse_storage("open", file, fault);
    Status status = write_all(system, file, head, fault);
    if (status == Status::ok) status = write_all(system, file, bytes, fault);
    if (status == Status::ok)
        if (const int got = uninterrupted([&] { return system.sync(file); }); got < 0 && got != -EINVAL)
            status = detail::refuse_storage("fsync", got, fault);
    if (const int got = close_file(system, file); got < 0 && status == Status::ok)
        status = detail::refuse_storage("close", got, fault);
    if (status == Status::ok)
        if (const int got = uninterrupted([&] { return system.rename(beside, path); }); got < 0)
            status = detail::refuse_storage("rename", got, fault);
    if (status != Status::ok) {
        static_cast<void>(uninterrupted([&] { return system.remove(beside); }));
        return status;
    }
    return detail::sync_folder(system, folder, fault);
}

}  // namespace fovea::linux_port
