// SPDX-License-Identifier: MIT
//
// FileStream: the standard output, or any file that others have open too, as a stream that never waits.
#pragma once

#include <poll.h>

#include <cerrno>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/byte_stream.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

/// A file that somebody else opened and closes. It may be shared with other programs, so that it cannot be
/// told not to wait: a write asks for room first, and takes no more than a pipe that has room takes at once.
template <class System = Kernel>
class FileStream {
public:
    FileStream(System system, int file) : system_(system), file_(file) {}

    Result<int> read(Span<std::uint8_t> into) { return pass(POLLIN, into); }
    Result<int> write(Span<const std::uint8_t> bytes) { return pass(POLLOUT, bytes); }

    int file() const { return file_; }
    const Fault& fault() const { return fault_; }

private:
    /// PIPE_BUF of Linux: with POLLOUT so many bytes are taken whole.
    static constexpr std::ptrdiff_t most_at_once = 4096;

    std::ptrdiff_t move(Span<std::uint8_t> into) { return system_.read(file_, into); }
    std::ptrdiff_t move(Span<const std::uint8_t> bytes) { return system_.write(file_, bytes); }

    template <class Byte>
    Result<int> pass(short wanted, Span<Byte> bytes) {
        if (bytes.empty()) return 0;
        pollfd asked{file_, wanted, 0};
        const int ready = uninterrupted([&] { return system_.poll({&asked, 1}, 0); });
        if (ready < 0) return refused(fault_, "poll", ready);
        // An end that is gone shows in the call itself.
        if (ready == 0) return 0;
        const std::ptrdiff_t most = bytes.size() < most_at_once ? bytes.size() : most_at_once;
        const std::ptrdiff_t got = move(bytes.first(most));
        if (got == -EAGAIN || got == -EINTR) return 0;
        if (got == -EPIPE) return unusable(fault_, "write", Status::device_lost, "nobody reads any more");
        if (got < 0) return refused(fault_, wanted == POLLIN ? "read" : "write", got);
        if (got == 0 && wanted == POLLIN)
            return unusable(fault_, "read", Status::device_lost, "the other end is closed");
        return static_cast<int>(got);
    }

    System system_;
    int file_;
    Fault fault_;
};

static_assert(hal::is_byte_stream_v<FileStream<>>);

}  // namespace fovea::linux_port
