// SPDX-License-Identifier: MIT
//
// SerialPort: a serial port of a Linux system - a UART, a USB adapter, a pseudo-terminal - as a stream of
// bytes.
#pragma once

// The kernel's own words for terminals, because only they set any baud rate. They say struct termios
// otherwise than <termios.h>: who includes this header cannot include that one.
#include <asm/termbits.h>
#include <linux/serial.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/byte_stream.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>

namespace fovea::linux_port {

// ---- Interface --------------------------------------------------------------------

enum class Parity : std::uint8_t { none, even, odd };

/// A bus of two wires, on which a sender switches itself off behind what it sent.
enum class Rs485 : std::uint8_t {
    as_found,  ///< as the board's description or another program has set it
    on,        ///< the driver switches by RTS
};

/// 8 data bits and 1 stop bit, without handshake.
struct SerialOptions {
    /// Bits a second, any that the device can: one that is more than 2 % off is refused.
    std::uint32_t baud = 115200;
    Parity parity = Parity::none;
    Rs485 rs485 = Rs485::as_found;
};

/// Nothing here waits, neither for a carrier nor for a byte. A byte that came with an error of the line, and
/// a break, are read as 0.
///
/// A port has one owner. Others cannot open it (TIOCEXCL), but for the superuser, whom the kernel lets in; so
/// it is locked (flock) as well, which also keeps out a second fovea that runs as root.
template <class System = Kernel>
class SerialPort {
public:
    explicit SerialPort(System system = {}) : system_(system) {}
    ~SerialPort() { close(); }
    SerialPort(const SerialPort&) = delete;
    SerialPort& operator=(const SerialPort&) = delete;

    /// Takes a port and sets it up; what had arrived before is dropped.
    ///
    /// Errors  bad_argument for 0 baud, which would hang up; not_found, device_lost and io_error of the
    ///         system; unsupported for what is no serial port, and for what it did not accept
    Status open(const char* path, const SerialOptions& options = {});

    /// Drops what has not been sent, for the kernel would wait for it up to 30 seconds.
    void close();

    /// As hal/byte_stream.hpp has them. After device_lost the port is closed, so that a device that returns
    /// can have its old name.
    Result<int> read(Span<std::uint8_t> into);
    Result<int> write(Span<const std::uint8_t> bytes);

    bool is_open() const { return file_ >= 0; }
    /// For poll; -1 where the port is closed. When it hangs up, read() says so.
    int file() const { return file_; }
    /// The baud rate that the device has really taken.
    std::uint32_t baud() const { return baud_; }
    /// What was wrong with the last call that failed.
    const Fault& fault() const { return fault_; }

private:
    static constexpr std::ptrdiff_t most_at_once = 1 << 20;
    static void* number(int value) { return reinterpret_cast<void*>(std::intptr_t{value}); }

    int control(unsigned long request, void* argument) {
        return uninterrupted([&] { return system_.ioctl(file_, request, argument); });
    }
    /// What an errno of a terminal means: EIO says that it is hung up, or that there is no UART behind it.
    static Status meaning(int error) { return error == EIO ? Status::device_lost : status_of(error); }
    Status fail(const char* call, int error, Status status, const char* about = "") {
        fault_ = {call, error, status, about};
        return status;
    }
    Status fail(const char* call, int answer) { return fail(call, -answer, meaning(-answer)); }
    Status unlike(const char* what) { return fail("TCSETS2", 0, Status::unsupported, what); }
    Result<int> failed_transfer(const char* call, std::ptrdiff_t answer);
    Status take();
    Status set_up(termios2 asked, const SerialOptions& options);
    Status set_up_bus();

    System system_;
    int file_ = -1;
    bool taken_ = false;
    std::uint32_t baud_ = 0;
    Fault fault_;
};

static_assert(hal::is_byte_stream_v<SerialPort<>>);

// ---- Implementation ---------------------------------------------------------------

template <class System>
Status SerialPort<System>::open(const char* path, const SerialOptions& options) {
    close();
    fault_ = {};
    if (options.baud == 0) return fail("open", 0, Status::bad_argument, "0 baud would hang up");
    file_ = uninterrupted([&] { return system_.open(path, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC); });
    if (file_ < 0) return fail("open", file_);
    termios2 found{};
    Status status = Status::ok;
    if (const int got = control(TCGETS2, &found); got < 0) status = fail("TCGETS2", got);
    if (status == Status::ok) status = take();
    if (status == Status::ok) status = set_up(found, options);
    if (status == Status::ok && options.rs485 == Rs485::on) status = set_up_bus();
    if (status != Status::ok) close();
    return status;
}

template <class System>
Status SerialPort<System>::take() {
    if (const int got = uninterrupted([&] { return system_.lock(file_); }); got < 0)
        return fail("flock", got);
    // The superuser is let into a port that another program has for itself, so we ask: he gets the answer of
    // all others.
    int taken = 0;
    if (const int got = control(TIOCGEXCL, &taken); got < 0) return fail("TIOCGEXCL", got);
    if (taken != 0) return fail("TIOCEXCL", EBUSY, Status::io_error);
    if (const int got = control(TIOCEXCL, nullptr); got < 0) return fail("TIOCEXCL", got);
    taken_ = true;
    return Status::ok;
}

template <class System>
Status SerialPort<System>::set_up(termios2 asked, const SerialOptions& options) {
    // Without HUPCL the lines of a modem keep their levels when the port closes: some boards restart by them.
    constexpr tcflag_t ours = CSIZE | CSTOPB | PARENB | PARODD | CMSPAR | CRTSCTS | HUPCL | CLOCAL | CREAD;
    asked.c_iflag = INPCK;
    asked.c_oflag = 0;
    asked.c_lflag = 0;
    asked.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (BOTHER << IBSHIFT);
    if (options.parity != Parity::none) asked.c_cflag |= PARENB;
    if (options.parity == Parity::odd) asked.c_cflag |= PARODD;
    asked.c_ispeed = asked.c_ospeed = options.baud;
    // With one byte at least, a read of no bytes tells the end of the device from silence.
    asked.c_cc[VMIN] = 1;
    asked.c_cc[VTIME] = 0;
    if (const int got = control(TCSETS2, &asked); got < 0) return fail("TCSETS2", got);

    // The call succeeds where anything could be set: what was, has to be asked.
    termios2 is{};
    if (const int got = control(TCGETS2, &is); got < 0) return fail("TCGETS2", got);
    if ((is.c_cflag & ours) != (asked.c_cflag & ours)) return unlike("it takes another parity or frame only");
    if (is.c_iflag != asked.c_iflag || is.c_oflag != 0 || is.c_lflag != 0 || is.c_cc[VMIN] != 1)
        return unlike("it does not pass bytes as they are");
    const std::int64_t off = std::abs(std::int64_t{is.c_ospeed} - std::int64_t{options.baud});
    // A receiver finds its last bit, the tenth, in the middle for up to 5 % between both ends: each may have
    // 2.
    if (off * 50 > options.baud) return unlike("it has no such baud rate");
    baud_ = is.c_ospeed;
    if (const int got = control(TCFLSH, number(TCIFLUSH)); got < 0) return fail("TCFLSH", got);
    return Status::ok;
}

template <class System>
Status SerialPort<System>::set_up_bus() {
    serial_rs485 bus{};
    int got = control(TIOCGRS485, &bus);
    if (got == 0) {
        bus.flags |= SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND;
        bus.flags &= ~static_cast<unsigned>(SER_RS485_RTS_AFTER_SEND);
        got = control(TIOCSRS485, &bus);
    }
    // A driver that does not know the call says EINVAL or ENOTTY, by its age.
    if (got == -EINVAL) return fail("TIOCSRS485", EINVAL, Status::unsupported, "its driver has no RS-485");
    return got < 0 ? fail("TIOCSRS485", got) : Status::ok;
}

template <class System>
void SerialPort<System>::close() {
    if (file_ < 0) return;
    // Not of a port that turned out to be another's.
    if (taken_) {
        static_cast<void>(control(TCFLSH, number(TCOFLUSH)));
        // A terminal stays taken as long as anyone has it open, and the other end of a pseudo-terminal has.
        static_cast<void>(control(TIOCNXCL, nullptr));
    }
    taken_ = false;
    static_cast<void>(close_file(system_, file_));
    baud_ = 0;
}

template <class System>
Result<int> SerialPort<System>::failed_transfer(const char* call, std::ptrdiff_t answer) {
    if (answer == -EAGAIN) return 0;
    // It hung up: the file will never give anything again.
    const Status status =
        answer == 0 ? fail(call, 0, Status::device_lost, "it hung up") : fail(call, static_cast<int>(answer));
    if (status == Status::device_lost) close();
    return status;
}

template <class System>
Result<int> SerialPort<System>::read(Span<std::uint8_t> into) {
    if (file_ < 0) return Status::device_lost;
    if (into.empty()) return 0;
    const Span<std::uint8_t> some = into.first(std::min(into.size(), most_at_once));
    const std::ptrdiff_t got = uninterrupted([&] { return system_.read(file_, some); });
    return got > 0 ? Result<int>(static_cast<int>(got)) : failed_transfer("read", got);
}

template <class System>
Result<int> SerialPort<System>::write(Span<const std::uint8_t> bytes) {
    if (file_ < 0) return Status::device_lost;
    if (bytes.empty()) return 0;
    const Span<const std::uint8_t> some = bytes.first(std::min(bytes.size(), most_at_once));
    const std::ptrdiff_t got = uninterrupted([&] { return system_.write(file_, some); });
    if (got == 0) return 0;
    return got > 0 ? Result<int>(static_cast<int>(got)) : failed_transfer("write", got);
}

}  // namespace fovea::linux_port
