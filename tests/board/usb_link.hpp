// SPDX-License-Identifier: MIT
//
// A USB device written as a program: the kernel's vhci-hcd is the socket it is plugged into, and asks over a
// stream of USB/IP packets what it would ask a device on a wire. All numbers of that stream are big-endian.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include <board/test_frame.hpp>

namespace fovea::test {

class UsbLink {
public:
    /// What the host controller wants: a transfer, or that one it asked for is forgotten.
    struct Request {
        bool forget;
        std::uint32_t number;
        std::uint32_t forgotten;  // the number of that transfer
        bool to_host;
        std::uint32_t endpoint;
        std::uint32_t length;
        std::array<std::uint8_t, 8> setup;  // of a control transfer
        Bytes data;                         // that comes from the host
    };

    UsbLink() = default;
    UsbLink(const UsbLink&) = delete;
    UsbLink& operator=(const UsbLink&) = delete;
    /// Pulls the plug.
    ~UsbLink() { ::close(socket_); }

    /// Plugs the device into a port, 0 to 7 for USB 2.
    bool plug_in(int port) {
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return false;
        socket_ = ends[0];
        const int room = 4 << 20;
        ::setsockopt(socket_, SOL_SOCKET, SO_SNDBUF, &room, sizeof room);
        const int high_speed = 3;
        const std::string words = std::to_string(port) + " " + std::to_string(ends[1]) + " " +
                                  std::to_string(0x10002 + port) + " " + std::to_string(high_speed);
        const int attach = ::open("/sys/devices/platform/vhci_hcd.0/attach", O_WRONLY | O_CLOEXEC);
        const bool done = attach >= 0 && ::write(attach, words.data(), words.size()) >= 0;
        ::close(attach);
        ::close(ends[1]);
        return done;
    }

    /// Is there a request within so many milliseconds?
    bool wait(int milliseconds) const {
        pollfd waiting{socket_, POLLIN, 0};
        return ::poll(&waiting, 1, milliseconds) > 0;
    }

    /// The next request, once it comes; nothing if the host is gone.
    std::optional<Request> next() {
        std::array<std::uint32_t, 12> head;
        if (!receive(head.data(), sizeof head)) return std::nullopt;
        Request request{};
        request.forget = ntohl(head[0]) == unlink_command;
        request.number = ntohl(head[1]);
        request.to_host = ntohl(head[3]) == 1;
        request.endpoint = ntohl(head[4]);
        if (request.forget) {
            request.forgotten = ntohl(head[5]);
            return request;
        }
        request.length = ntohl(head[6]);
        std::memcpy(request.setup.data(), &head[10], request.setup.size());
        request.data.resize(request.to_host ? 0 : request.length);
        if (!receive(request.data.data(), request.data.size())) return std::nullopt;
        return request;
    }

    /// A transfer is done. Towards the host: with these bytes.
    bool answer(const Request& request, const Bytes& data) {
        const std::size_t length = request.to_host ? data.size() : request.length;
        return send(submit_answer, request.number, 0, length, request.to_host ? data : Bytes{});
    }
    /// The device does not know what is asked for.
    bool stall(const Request& request) { return send(submit_answer, request.number, -EPIPE, 0, {}); }
    /// A transfer was still waiting, and will have no answer; or it had its answer before.
    bool forget(const Request& request, bool was_waiting) {
        return send(unlink_answer, request.number, was_waiting ? -ECONNRESET : 0, 0, {});
    }

private:
    static constexpr std::uint32_t unlink_command = 2;
    static constexpr std::uint32_t submit_answer = 3;
    static constexpr std::uint32_t unlink_answer = 4;

    bool receive(void* to, std::size_t size) const {
        return size == 0 || ::recv(socket_, to, size, MSG_WAITALL) == static_cast<ssize_t>(size);
    }

    bool send(std::uint32_t kind, std::uint32_t number, int status, std::size_t length,
              const Bytes& data) const {
        std::array<std::uint32_t, 12> head{};
        head[0] = htonl(kind);
        head[1] = htonl(number);
        head[5] = htonl(static_cast<std::uint32_t>(status));
        head[6] = htonl(static_cast<std::uint32_t>(length));
        Bytes packet(sizeof head + data.size());
        std::memcpy(packet.data(), head.data(), sizeof head);
        if (!data.empty()) std::memcpy(packet.data() + sizeof head, data.data(), data.size());
        std::size_t sent = 0;
        while (sent < packet.size()) {
            const ssize_t now = ::send(socket_, packet.data() + sent, packet.size() - sent, MSG_NOSIGNAL);
            if (now <= 0) return false;
            sent += static_cast<std::size_t>(now);
        }
        return true;
    }

    int socket_ = -1;
};

}  // namespace fovea::test
