// SPDX-License-Identifier: MIT
//
// The serial port on the kernel's drivers: a 16550, and a USB adapter that is pulled. At the other end the
// host reads records, or does not. It prints "ready NAME" where the host is to do something, and goes on with
// a line from it.
// usage: serial_on_board PORT records|blocked|owner|sweep|unplugging...
//        PORT  a path, or the identity of a USB adapter
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>
#include <vector>

#include <fovea/hal/record_queue.hpp>
#include <fovea/linux/device_identity.hpp>
#include <fovea/linux/serial_port.hpp>

#include "board/proof.hpp"
#include "support/failing_system.hpp"

namespace fovea::board {
namespace {

using linux_port::DeviceFinder;
using linux_port::DevicePath;
using linux_port::Kernel;
using linux_port::SerialPort;

constexpr std::int64_t second = 1000000;

std::string port;

void ready(const char* name) { std::cout << "ready " << name << std::endl; }
void await_host() {
    std::string line;
    std::getline(std::cin, line);
}

/// The node that the port has today; empty while there is none.
std::string node_of_port() {
    DeviceFinder<> finder;
    DevicePath path;
    return finder.resolve("tty", port.c_str(), path) == Status::ok ? path.c_str() : "";
}

std::string fault_of(const SerialPort<>& serial) {
    return std::string(serial.fault().call) + ": " + reason(serial.fault());
}

/// "record 000007 " and letters up to its number's own length.
std::string record(int number) {
    char head[32];
    std::snprintf(head, sizeof head, "record %06d ", number);
    return head +
           std::string(static_cast<std::size_t>(number * 37 % 90), static_cast<char>('a' + number % 26)) +
           "\n";
}

/// Sends records, one every so often, and then waits until all have left. The longest that a call took.
std::int64_t send(SerialPort<>& serial, hal::RecordQueue& queue, int first, int count,
                  std::int64_t every_us) {
    Kernel kernel;
    std::int64_t longest = 0;
    for (int k = first; k < first + count; ++k) {
        const std::string text = record(k);
        const std::int64_t begin = kernel.monotonic_us();
        static_cast<void>(queue.send(
            {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())}));
        if (queue.pump(serial) != Status::ok) break;
        longest = std::max(longest, kernel.monotonic_us() - begin);
        static_cast<void>(kernel.poll({nullptr, 0}, every_us));
    }
    return longest;
}
void flush(SerialPort<>& serial, hal::RecordQueue& queue) {
    Kernel kernel;
    const std::int64_t until = kernel.monotonic_us() + 10 * second;
    while (queue.waiting() > 0 && kernel.monotonic_us() < until) {
        pollfd asked{serial.file(), POLLOUT, 0};
        static_cast<void>(kernel.poll({&asked, 1}, second));
        if (queue.pump(serial) != Status::ok) break;
    }
}

/// Both ways: 100 records, and each byte back that the host sends.
void records(Proof& proof) {
    SerialPort<> serial;
    if (!proof.status(serial.open(node_of_port().c_str()), Status::ok, port + ": open")) return;
    proof.equal(serial.baud(), 115200u, port + ": the baud rate");
    std::uint8_t memory[4096];
    hal::RecordQueue queue(memory);
    ready("records");
    send(serial, queue, 0, 100, 1000);
    flush(serial, queue);
    proof.equal(queue.waiting(), 0, port + ": all records have left");
    proof.equal(queue.dropped(), 0u, port + ": none was dropped");
    await_host();
    // The host has sent every byte there is.
    Kernel kernel;
    int right = 0;
    const std::int64_t until = kernel.monotonic_us() + 5 * second;
    for (bool wrong = false; right < 256 && !wrong && kernel.monotonic_us() < until;) {
        pollfd asked{serial.file(), POLLIN, 0};
        static_cast<void>(kernel.poll({&asked, 1}, second));
        std::uint8_t bytes[64];
        const Result<int> got = serial.read(bytes);
        if (!got) break;
        for (int k = 0; k < *got && !wrong; ++k) wrong = bytes[k] != right, right += wrong ? 0 : 1;
    }
    proof.equal(right, 256, port + ": every byte comes as it was sent");
}

/// Nobody reads, and later somebody does.
void blocked(Proof& proof) {
    SerialPort<> serial;
    if (!proof.status(serial.open(node_of_port().c_str()), Status::ok, port + ": open")) return;
    std::uint8_t memory[4096];
    hal::RecordQueue queue(memory);
    constexpr int count = 1000;
    const std::int64_t longest = send(serial, queue, 0, count, 500);
    proof.check(queue.dropped() > 0 && queue.waiting() > 0, "F14: nobody reads, and the oldest are dropped",
                std::to_string(queue.dropped()) + " dropped");
    proof.figure("F14: the longest call while nobody reads", longest, "us");
    proof.at_most(longest, 100000, "F14: no call waits");
    ready("blocked");
    flush(serial, queue);
    proof.equal(queue.waiting(), 0, "F14: when somebody reads again, all that wait leave");
    std::printf("dropped %u of %d\n", queue.dropped(), count);
    std::fflush(stdout);
    await_host();

    // Closing does not wait for a reader either.
    send(serial, queue, count, count, 500);
    Kernel kernel;
    const std::int64_t begin = kernel.monotonic_us();
    serial.close();
    const std::int64_t took = kernel.monotonic_us() - begin;
    proof.figure("F14: closing while nobody reads", took, "us");
    proof.at_most(took, second, "F14: closing waits less than a second");
}

void owner(Proof& proof) {
    SerialPort<> serial;
    const std::string node = node_of_port();
    if (!proof.status(serial.open(node.c_str()), Status::ok, port + ": open")) return;
    SerialPort<> other;
    proof.status(other.open(node.c_str()), Status::io_error, "F30: a second owner");
    proof.check(std::strlen(advice(other.fault())) > 0, "F30: is told what to try", fault_of(other));
    // As another user's program, whom the kernel itself keeps out.
    ::chmod(node.c_str(), 0666);
    std::fflush(stdout);
    const int process = ::fork();
    if (process == 0) {
        const bool other_user = ::setuid(1000) == 0;
        const int file = ::open(node.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
        ::_exit(other_user && file < 0 ? errno : 0);
    }
    int status = 0;
    ::waitpid(process, &status, 0);
    proof.equal(WEXITSTATUS(status), EBUSY, "F30: and a program of another user gets EBUSY");
    serial.close();
    proof.status(other.open(node.c_str()), Status::ok, "F30: until the first owner closes");
    proof.status(serial.open("/dev/null"), Status::unsupported, "a file that is no serial port");
    proof.status(serial.open("/dev/ttyUSB9"), Status::not_found, "a port that is not there");
}

void sweep(Proof& proof) {
    const Holdings before = holdings();
    int leaks = 0;
    int typed = 0;
    const std::string node = node_of_port();
    const int runs = test::sweep(
        Kernel(), {EINTR, EIO, EINVAL, ENODEV, ENOMEM, EBUSY, EACCES, EAGAIN},
        [&](auto system) {
            SerialPort serial(system);
            Status got = serial.open(node.c_str());
            const std::uint8_t bytes[] = {'x', '\n'};
            std::uint8_t into[16];
            if (got == Status::ok) got = serial.write(bytes).status();
            if (got == Status::ok) got = serial.read(into).status();
            if (got == Status::ok || got == serial.fault().status) ++typed;
        },
        [&](const test::SystemScript& script) {
            if (!script.all_given_back()) ++leaks;
        });
    proof.figure("n-th-call sweep of " + port + ": runs", runs, "");
    proof.check(runs > 80 && typed >= runs,
                port + ": the sweep reaches every call, each fault has its status",
                std::to_string(typed) + " of " + std::to_string(runs));
    proof.equal(leaks, 0, port + ": no file is left");
    proof.equal(holdings().files, before.files, port + ": by the count of the kernel too");
    SerialPort<> serial;
    proof.status(serial.open(node.c_str()), Status::ok, port + ": the port is free after it");
}

/// The host pulls it and plugs it in, 10 times.
void unplugging(Proof& proof) {
    constexpr int cycles = 10;
    const Holdings before = holdings();
    Kernel kernel;
    std::vector<std::int64_t> from_node;
    int lost = 0;
    int renumbered = 0;
    std::string node = node_of_port();
    SerialPort<> serial;
    proof.status(serial.open(node.c_str()), Status::ok, port + ": open");
    for (int k = 0; k < cycles; ++k) {
        ready("to be pulled");
        std::uint8_t bytes[16];
        Result<int> got = 0;
        while (got) {
            pollfd asked{serial.file(), POLLIN, 0};
            if (kernel.poll({&asked, 1}, 10 * second) == 0) break;
            got = serial.read(bytes);
        }
        if (!got && got.status() == Status::device_lost && !serial.is_open()) ++lost;
        await_host();
        const std::string last = node;
        ready("to be plugged in");
        for (int tries = 0; tries < 2000 && (node = node_of_port()).empty(); ++tries)
            static_cast<void>(kernel.poll({nullptr, 0}, 5000));
        const std::int64_t found = kernel.monotonic_us();
        Status status = Status::not_found;
        // The node is there a little before its driver lets it be opened.
        for (int tries = 0; tries < 100 && status != Status::ok; ++tries) {
            if (tries > 0) static_cast<void>(kernel.poll({nullptr, 0}, 5000));
            status = serial.open(node_of_port().c_str());
        }
        from_node.push_back(kernel.monotonic_us() - found);
        if (!proof.check(status == Status::ok, "F13: found again and open", fault_of(serial))) return;
        renumbered += node != last ? 1 : 0;
        await_host();
        const std::string text = record(k);
        proof.check(serial.write({reinterpret_cast<const std::uint8_t*>(text.data()),
                                  static_cast<std::ptrdiff_t>(text.size())})
                            .status() == Status::ok,
                    "F13: a record is taken");
    }
    ready("records of 10 cycles");
    await_host();
    serial.close();
    proof.equal(lost, cycles, "F13: each time the port is lost, and closed");
    proof.equal(renumbered, 0, "F13: it comes back under its old number, which the port had given free");
    proof.spread("F13: from the node to the open port", from_node);
    proof.equal(holdings().files, before.files, "F13: as many files are open as before");
}

}  // namespace
}  // namespace fovea::board

int main(int count, char** words) {
    using namespace fovea::board;
    Proof proof;
    if (count > 1) port = words[1];
    for (int k = 2; k < count; ++k) {
        const std::string part = words[k];
        if (part == "records")
            records(proof);
        else if (part == "blocked")
            blocked(proof);
        else if (part == "owner")
            owner(proof);
        else if (part == "sweep")
            sweep(proof);
        else if (part == "unplugging")
            unplugging(proof);
        else
            proof.check(false, "a part named " + part);
    }
    return proof.end();
}
