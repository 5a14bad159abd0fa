// SPDX-License-Identifier: MIT
//
// ServiceNotify: tells the manager of services how the program is - ready, reading its settings anew, ending,
// alive.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/watchdog.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/text.hpp>

namespace fovea::linux_port {

// ---- Interface --------------------------------------------------------------------

/// What the manager has put into the environment of the program; nullptr where a variable is not set.
struct NotifyEnvironment {
    const char* notify_socket = nullptr;  ///< NOTIFY_SOCKET
    const char* watchdog_usec = nullptr;  ///< WATCHDOG_USEC
    const char* watchdog_pid = nullptr;   ///< WATCHDOG_PID
};

/// One datagram a message, to a socket with a path or an abstract one; without NOTIFY_SOCKET all of them do
/// nothing and are ok. None of them waits.
///
/// Errors  timeout where the manager has not read what it was sent: tell it again. bad_argument for an
///         address that is none. not_found and io_error of the system
/// Source  sd_notify(3) and sd_watchdog_enabled(3) of systemd
template <class System = Kernel>
class ServiceNotify {
public:
    explicit ServiceNotify(System system = {}, const NotifyEnvironment& environment = {});
    ~ServiceNotify() { static_cast<void>(close_file(system_, file_)); }
    ServiceNotify(const ServiceNotify&) = delete;
    ServiceNotify& operator=(const ServiceNotify&) = delete;

    Status ready() { return send("READY=1"); }
    /// Until the next ready().
    Status reloading();
    Status stopping() { return send("STOPPING=1"); }
    /// A line for people; of a longer one the beginning.
    Status status(const char* line);
    Status watchdog() { return send("WATCHDOG=1"); }

    /// As hal/watchdog.hpp has it. It may be called as often as one likes: it tells the manager four times in
    /// each period, and nothing where it does not wait for it. What failed, the fault says, and the next call
    /// tells it again.
    void feed();

    /// True if somebody listens.
    bool used() const { return address_bytes_ != 0; }
    /// The time after which the manager takes the program for hung; 0 where it does not watch this process.
    std::int64_t watchdog_period_us() const { return period_us_; }
    const Fault& fault() const { return fault_; }

private:
    using Message = Text<500>;

    Status fail(const char* call, int error, Status status, const char* about = "") {
        fault_ = {call, error, status, about};
        return status;
    }
    void read_address(const char* text);
    Status send(const char* text) { return send(Message(text)); }
    Status send(const Message& message);

    System system_;
    sockaddr_un address_{};
    unsigned address_bytes_ = 0;
    int file_ = -1;
    std::int64_t period_us_ = 0;
    bool fed_ = false;
    std::int64_t fed_us_ = 0;
    Fault fault_;
};

static_assert(hal::is_watchdog_v<ServiceNotify<>>);

// ---- Implementation ---------------------------------------------------------------

template <class System>
ServiceNotify<System>::ServiceNotify(System system, const NotifyEnvironment& environment) : system_(system) {
    if (environment.notify_socket != nullptr && environment.notify_socket[0] != '\0')
        read_address(environment.notify_socket);
    // A period may be for a parent of ours, which has left its environment to us.
    std::uint64_t period = 0, process = 0;
    constexpr std::uint64_t most = std::uint64_t{1} << 62;
    const char* const pid = environment.watchdog_pid;
    const bool ours = pid == nullptr || (parse_number(pid, most, process) &&
                                         process == static_cast<std::uint64_t>(system_.process_id()));
    if (ours && environment.watchdog_usec != nullptr && parse_number(environment.watchdog_usec, most, period))
        period_us_ = static_cast<std::int64_t>(period);
}

template <class System>
void ServiceNotify<System>::read_address(const char* text) {
    const std::size_t size = std::strlen(text);
    address_.sun_family = AF_UNIX;
    // A path closes with a zero; an abstract name begins with one, written as @, and ends with its last byte.
    const bool path = text[0] == '/', abstract = text[0] == '@' && size > 1;
    if ((!path && !abstract) || size + (path ? 1 : 0) > sizeof address_.sun_path) {
        static_cast<void>(
            fail("sendto", 0, Status::bad_argument, "NOTIFY_SOCKET is no address of a local socket"));
        return;
    }
    std::memcpy(address_.sun_path, text, size);
    if (abstract) address_.sun_path[0] = '\0';
    address_bytes_ = static_cast<unsigned>(offsetof(sockaddr_un, sun_path) + size + (path ? 1 : 0));
}

template <class System>
Status ServiceNotify<System>::send(const Message& message) {
    if (!used()) return fault_.status == Status::bad_argument ? Status::bad_argument : Status::ok;
    if (file_ < 0) {
        const int got =
            uninterrupted([&] { return system_.socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK); });
        if (got < 0) return fail("socket", -got, status_of(-got));
        file_ = got;
    }
    const std::ptrdiff_t got =
        uninterrupted([&] { return system_.send_to(file_, message.bytes(), address_, address_bytes_); });
    if (got == -EAGAIN)
        return fail("sendto", EAGAIN, Status::timeout, "the manager of services does not read");
    if (got < 0)
        return fail("sendto", static_cast<int>(-got), status_of(static_cast<int>(-got)), "NOTIFY_SOCKET");
    return Status::ok;
}

template <class System>
Status ServiceNotify<System>::reloading() {
    const std::int64_t now = system_.monotonic_us();
    return send(Message("RELOADING=1\nMONOTONIC_USEC=").add_number(static_cast<std::uint64_t>(now)));
}

template <class System>
Status ServiceNotify<System>::status(const char* line) {
    constexpr std::size_t most = 400;
    std::size_t size = std::min(std::strlen(line), most);
    // Not within a letter of several bytes.
    if (line[size] != '\0')
        while (size > 0 && (static_cast<unsigned char>(line[size]) & 0xc0) == 0x80) --size;
    Message message("STATUS=");
    for (std::size_t i = 0; i < size; ++i) {
        // What follows the end of a line would be another message.
        const char byte = line[i] == '\n' || line[i] == '\r' ? ' ' : line[i];
        message.add({&byte, 1});
    }
    return send(message);
}

template <class System>
void ServiceNotify<System>::feed() {
    if (period_us_ == 0 || !used()) return;
    const std::int64_t now = system_.monotonic_us();
    if (fed_ && now - fed_us_ < period_us_ / 4) return;
    if (watchdog() != Status::ok) return;
    fed_ = true;
    fed_us_ = now;
}

}  // namespace fovea::linux_port
