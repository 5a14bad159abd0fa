// SPDX-License-Identifier: MIT
//
// What a folder has in it, and the one line that files of /sys have.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

/// Shows visit(name) every entry of a folder but "." and "..", in no order, until it answers something else
/// than ok.
///
/// Errors  what visit answered, or what the fault says
template <class System, class Visit>
Status each_entry(System& system, const char* folder, Fault& fault, Visit visit) {
    const auto fail = [&](const char* call, std::ptrdiff_t answer) {
        const int error = static_cast<int>(-answer);
        fault = {call, error, status_of(error), "a folder"};
        return fault.status;
    };
    int file = uninterrupted([&] { return system.open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
    if (file < 0) return fail("open", file);
    Status status = Status::ok;
    while (status == Status::ok) {
        std::uint8_t records[2048];
        const std::ptrdiff_t got = uninterrupted([&] { return system.entries(file, records); });
        if (got < 0) status = fail("getdents64", got);
        if (got <= 0) break;
        // A record: 16 bytes, its length in 2, its kind in 1, its name with a closing zero.
        constexpr std::ptrdiff_t name_at = 19;
        std::uint16_t length = 0;
        for (std::ptrdiff_t at = 0; status == Status::ok && at + name_at < got; at += length) {
            std::memcpy(&length, records + at + 16, 2);
            // Behind the zero lies whatever was there.
            if (length <= name_at || length > got - at ||
                std::memchr(records + at + name_at, 0, static_cast<std::size_t>(length - name_at)) ==
                    nullptr) {
                status = unusable(fault, "getdents64", Status::io_error, "records that cannot be read");
                break;
            }
            const char* const name = reinterpret_cast<const char*>(records + at + name_at);
            if (std::strcmp(name, ".") != 0 && std::strcmp(name, "..") != 0) status = visit(name);
        }
    }
    static_cast<void>(close_file(system, file));
    return status;
}

/// The beginning of a small file up to the end of its first line, with a closing zero. 0, or the negative
/// errno, with the line empty then.
template <class System, std::size_t Bytes>
int read_line(System& system, const char* path, char (&line)[Bytes]) {
    line[0] = '\0';
    int file = uninterrupted([&] { return system.open(path, O_RDONLY | O_CLOEXEC); });
    if (file < 0) return file;
    std::uint8_t bytes[Bytes];
    const std::ptrdiff_t got = uninterrupted([&] { return system.read(file, Span<std::uint8_t>(bytes)); });
    static_cast<void>(close_file(system, file));
    if (got < 0) return static_cast<int>(got);
    const std::size_t most = std::min(static_cast<std::size_t>(got), Bytes - 1);
    std::size_t size = 0;
    for (; size < most && bytes[size] != '\n'; ++size) line[size] = static_cast<char>(bytes[size]);
    line[size] = '\0';
    return 0;
}

}  // namespace fovea::linux_port
