// SPDX-License-Identifier: MIT
//
// Kernel: the calls into a Linux kernel that the ports make, all in one place, so that a test can stand in
// it.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include <fovea/base/span.hpp>

namespace fovea::linux_port {

/// What a port calls, as a system: a handle that is cheap to copy. Every call answers what the kernel
/// answers, or the negative errno; nothing is tried again here, not even what a signal interrupted.
///
/// A port takes its system as a template parameter and by value. A test gives it one that lets the n-th call
/// fail: tests/support/failing_system.hpp.
class Kernel {
public:
    int open(const char* path, int flags, unsigned mode = 0) { return answer(::open(path, flags, mode)); }
    int close(int file) { return answer(::close(file)); }
    /// What follows on this file does not wait.
    int stop_waiting(int file) { return answer(::fcntl(file, F_SETFL, O_NONBLOCK)); }
    /// Takes the file for itself among the programs that ask likewise, until it is closed; does not wait.
    int lock(int file) { return answer(::flock(file, LOCK_EX | LOCK_NB)); }
    std::ptrdiff_t read(int file, Span<std::uint8_t> into) {
        return answer(::read(file, into.data(), static_cast<std::size_t>(into.size())));
    }
    std::ptrdiff_t write(int file, Span<const std::uint8_t> bytes) {
        return answer(::write(file, bytes.data(), static_cast<std::size_t>(bytes.size())));
    }
    int ioctl(int file, unsigned long request, void* argument) {
        return answer(::ioctl(file, request, argument));
    }
    /// How many of the files have something to tell; 0 when the patience is over, which is without end below
    /// 0.
    int poll(Span<pollfd> files, std::int64_t patience_us) {
        // Seconds have 32 bits on some boards: a billion of them are 31 years.
        patience_us = std::min(patience_us, std::int64_t{1000000000} * 1000000);
        const timespec patience = {static_cast<time_t>(patience_us / 1000000),
                                   static_cast<long>(patience_us % 1000000 * 1000)};
        return answer(::ppoll(files.data(), static_cast<nfds_t>(files.size()),
                              patience_us < 0 ? nullptr : &patience, nullptr));
    }
    /// Memory of a device, shared with it, for reading and writing.
    std::ptrdiff_t map(int file, std::int64_t offset, std::size_t length, std::uint8_t*& memory) {
        void* const got =
            ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, file, static_cast<off_t>(offset));
        if (got == MAP_FAILED) return -errno;
        memory = static_cast<std::uint8_t*>(got);
        return 0;
    }
    int unmap(std::uint8_t* memory, std::size_t length) { return answer(::munmap(memory, length)); }

    int sync(int file) { return answer(::fsync(file)); }
    int rename(const char* from, const char* to) { return answer(::rename(from, to)); }
    int make_folder(const char* path, unsigned mode) { return answer(::mkdir(path, mode)); }
    int remove(const char* path) { return answer(::unlink(path)); }
    int about(const char* path, struct stat& what) { return answer(::stat(path, &what)); }
    int about(int file, struct stat& what) { return answer(::fstat(file, &what)); }
    /// Where a symbolic link points to, without a closing zero.
    std::ptrdiff_t read_link(const char* path, Span<char> into) {
        return answer(::readlink(path, into.data(), static_cast<std::size_t>(into.size())));
    }
    /// Records of a folder as getdents64(2) describes them; 0 at its end.
    std::ptrdiff_t entries(int folder, Span<std::uint8_t> into) {
        return answer(::syscall(SYS_getdents64, folder, into.data(), into.size()));
    }

    /// A file that can be read when something of what is watched happens to a folder; see inotify(7).
    int begin_watch() { return answer(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)); }
    int watch(int file, const char* folder, std::uint32_t what) {
        return answer(::inotify_add_watch(file, folder, what));
    }

    int socket(int family, int type) { return answer(::socket(family, type, 0)); }
    std::ptrdiff_t send_to(int file, Span<const std::uint8_t> bytes, const sockaddr_un& to,
                           unsigned to_bytes) {
        return answer(::sendto(file, bytes.data(), static_cast<std::size_t>(bytes.size()), MSG_NOSIGNAL,
                               reinterpret_cast<const sockaddr*>(&to), to_bytes));
    }

    int process_id() { return ::getpid(); }
    /// How many processors this program may use.
    int processors() {
        cpu_set_t set;
        CPU_ZERO(&set);
        const int got = ::sched_getaffinity(0, sizeof set, &set);
        return got < 0 ? answer(got) : CPU_COUNT(&set);
    }
    /// Time that only goes forward, as the kernel stamps frames and edges.
    std::int64_t monotonic_us() {
        timespec now{};
        ::clock_gettime(CLOCK_MONOTONIC, &now);
        return std::int64_t{now.tv_sec} * 1000000 + now.tv_nsec / 1000;
    }

private:
    template <class Answer>
    static Answer answer(Answer got) {
        return got < 0 ? static_cast<Answer>(-errno) : got;
    }
};

/// Makes a call again for as long as signals interrupt it. Not for calls that wait: who waits looks first
/// what the signal wants.
template <class Call>
auto uninterrupted(Call call) {
    auto got = call();
    while (got == -EINTR) got = call();
    return got;
}

/// Closes a file, once: the kernel gives the number free whatever it answers.
template <class System>
int close_file(System& system, int& file) {
    if (file < 0) return 0;
    const int got = system.close(file);
    file = -1;
    return got == -EINTR ? 0 : got;
}

}  // namespace fovea::linux_port
