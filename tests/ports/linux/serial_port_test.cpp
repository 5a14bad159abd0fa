// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fovea/hal/line_reader.hpp>
#include <fovea/hal/record_queue.hpp>
#include <fovea/linux/serial_port.hpp>
#include <support/failing_system.hpp>
#include <support/pty.hpp>

namespace fovea::test {
namespace {

using linux_port::Kernel;
using linux_port::Parity;
using linux_port::Rs485;

Span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())};
}

/// So many bytes, or what arrives within two seconds.
template <class Port>
std::string heard(Port& port, std::size_t expected) {
    std::string all;
    pollfd one = {port.file(), POLLIN, 0};
    while (all.size() < expected && ::poll(&one, 1, 2000) > 0) {
        std::uint8_t some[1000];
        const Result<int> got = port.read(some);
        if (!got || *got == 0) break;
        all.append(some, some + *got);
    }
    return all;
}

std::ptrdiff_t open_files() {
    namespace files = std::filesystem;
    return std::distance(files::directory_iterator("/proc/self/fd"), files::directory_iterator());
}

struct SerialPort : testing::Test {
    Pty pty;
    linux_port::SerialPort<> port;
};

TEST_F(SerialPort, PassesEveryByteAsItIs) {
    ASSERT_EQ(port.open(pty.path()), Status::ok) << port.fault().call;
    std::string all;
    for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
    EXPECT_EQ(port.write(bytes_of(all)).value(), 256);
    EXPECT_EQ(pty.heard(256), all);
    ASSERT_TRUE(pty.say(all));
    EXPECT_EQ(heard(port, 256), all);
    EXPECT_EQ(pty.heard(), "") << "no echo";
}

TEST_F(SerialPort, SaysThatNothingHasArrived) {
    ASSERT_EQ(port.open(pty.path()), Status::ok);
    std::uint8_t some[10];
    EXPECT_EQ(port.read(some).value(), 0);
    EXPECT_EQ(port.read({some, 0}).value(), 0);
    EXPECT_EQ(port.write({some, 0}).value(), 0);
}

TEST_F(SerialPort, SetsAnyBaudRate) {
    for (const std::uint32_t baud : {50u, 9600u, 115200u, 250000u, 1234567u, 4000000u}) {
        ASSERT_EQ(port.open(pty.path(), {baud}), Status::ok) << baud;
        EXPECT_EQ(port.baud(), baud);
        termios2 is{};
        ASSERT_EQ(::ioctl(pty.file(), TCGETS2, &is), 0);
    }
    port.close();
    EXPECT_EQ(port.baud(), 0u);
    EXPECT_EQ(port.open(pty.path(), {0}), Status::bad_argument);
}

TEST_F(SerialPort, DropsWhatHadArrivedBefore) {
    // It goes through a queue of the kernel, and has arrived when another program could read it.
    const int other = ::open(pty.path(), O_RDWR | O_NOCTTY);
    ASSERT_TRUE(pty.say("stale\n"));
    pollfd one = {other, POLLIN, 0};
    ASSERT_EQ(::poll(&one, 1, 2000), 1);
    // The terminal has said it again, as terminals do.
    EXPECT_EQ(pty.heard(7), "stale\r\n");
    ASSERT_EQ(port.open(pty.path()), Status::ok);
    ASSERT_TRUE(pty.say("new"));
    EXPECT_EQ(heard(port, 3), "new");
    ::close(other);
}

/// Writes down what it is asked.
struct Witness : Kernel {
    std::vector<std::string>* log = nullptr;
    int ioctl(int file, unsigned long request, void* argument) {
        if (request == TCFLSH)
            log->push_back("flush " + std::to_string(reinterpret_cast<std::intptr_t>(argument)));
        return Kernel::ioctl(file, request, argument);
    }
    int close(int file) {
        log->push_back("close");
        return Kernel::close(file);
    }
};

/// What a pseudo-terminal has passed on is not dropped, so that only the order of the calls can be seen here.
TEST_F(SerialPort, DropsWhatWasNotSentBeforeItCloses) {
    std::vector<std::string> log;
    linux_port::SerialPort witnessed(Witness{{}, &log});
    ASSERT_EQ(witnessed.open(pty.path()), Status::ok);
    EXPECT_EQ(log, (std::vector<std::string>{"flush " + std::to_string(TCIFLUSH)}));
    log.clear();
    witnessed.close();
    EXPECT_EQ(log, (std::vector<std::string>{"flush " + std::to_string(TCOFLUSH), "close"}));
}

/// A pseudo-terminal has no parity, and the call that sets it succeeds.
TEST_F(SerialPort, LooksWhatTheDriverHasSet) {
    EXPECT_EQ(port.open(pty.path(), {9600, Parity::even}), Status::unsupported);
    EXPECT_STREQ(port.fault().call, "TCSETS2");
    EXPECT_STREQ(port.fault().about, "it takes another parity or frame only");
    EXPECT_FALSE(port.is_open());
    EXPECT_EQ(port.open(pty.path(), {9600, Parity::none, Rs485::on}), Status::unsupported);
    EXPECT_STREQ(port.fault().call, "TIOCSRS485");
}

/// A driver with a clock of its own.
struct Divider : Kernel {
    std::uint32_t has = 0;
    int ioctl(int file, unsigned long request, void* argument) {
        const int got = Kernel::ioctl(file, request, argument);
        if (request == TCGETS2) static_cast<termios2*>(argument)->c_ospeed = has;
        return got;
    }
};

TEST_F(SerialPort, TakesABaudRateWithinTwoPercent) {
    for (const std::uint32_t has : {98000u, 98001u, 100000u, 102000u})
        EXPECT_EQ(linux_port::SerialPort(Divider{{}, has}).open(pty.path(), {100000}), Status::ok) << has;
    for (const std::uint32_t has : {0u, 97999u, 102001u, 4294967295u})
        EXPECT_EQ(linux_port::SerialPort(Divider{{}, has}).open(pty.path(), {100000}), Status::unsupported)
            << has;
}

TEST_F(SerialPort, SaysWhatIsNoSerialPort) {
    EXPECT_EQ(port.open("/dev/null"), Status::unsupported);
    EXPECT_STREQ(linux_port::advice(port.fault()), "this is not a serial port");
    EXPECT_EQ(port.open("/dev/ttyNothing0"), Status::not_found);
    EXPECT_STREQ(port.fault().call, "open");
    EXPECT_EQ(port.fault().error, ENOENT);
    EXPECT_EQ(port.open(""), Status::not_found);
    EXPECT_EQ(port.read({}).status(), Status::device_lost) << "a closed port";
    EXPECT_EQ(port.write({}).status(), Status::device_lost);
}

/// F30: the kernel lets the superuser in, so that the lock has to say it.
TEST_F(SerialPort, HasOneOwner) {
    ASSERT_EQ(port.open(pty.path()), Status::ok);
    ASSERT_EQ(::chmod(pty.path(), 0666), 0);
    linux_port::SerialPort<> second;
    EXPECT_EQ(second.open(pty.path()), Status::io_error);
    EXPECT_STREQ(linux_port::advice(second.fault()),
                 ::geteuid() == 0 ? "another program has this port for itself: end it first"
                                  : "another program holds it: end it first");
    if (::geteuid() == 0) {
        ASSERT_EQ(::seteuid(65534), 0);
        EXPECT_EQ(second.open(pty.path()), Status::io_error);
        ASSERT_EQ(::seteuid(0), 0);
        EXPECT_STREQ(second.fault().call, "open");
        EXPECT_EQ(second.fault().error, EBUSY);
    }
    // The first one goes on, and gives it free for another.
    EXPECT_EQ(port.write(bytes_of("still")).value(), 5);
    EXPECT_EQ(pty.heard(5), "still");
    port.close();
    EXPECT_EQ(second.open(pty.path()), Status::ok);
}

TEST_F(SerialPort, StaysOutOfAPortThatAProgramHasWithoutALock) {
    const int other = ::open(pty.path(), O_RDWR | O_NOCTTY);
    ASSERT_EQ(::ioctl(other, TIOCEXCL), 0);
    EXPECT_EQ(port.open(pty.path()), Status::io_error);
    EXPECT_EQ(port.fault().error, EBUSY);
    ASSERT_EQ(::ioctl(other, TIOCNXCL), 0);
    EXPECT_EQ(port.open(pty.path()), Status::ok);
    ::close(other);
}

/// F13.
TEST_F(SerialPort, SaysThatItsPeerIsGone) {
    const std::ptrdiff_t before = open_files();
    std::uint8_t some[10];
    for (int round = 0; round < 100; ++round) {
        Pty end;
        ASSERT_EQ(port.open(end.path()), Status::ok);
        end.hang_up();
        if (round % 2 == 0)
            EXPECT_EQ(port.read(some).status(), Status::device_lost);
        else
            EXPECT_EQ(port.write(bytes_of("x")).status(), Status::device_lost);
        EXPECT_FALSE(port.is_open());
        EXPECT_EQ(port.fault().status, Status::device_lost);
        EXPECT_EQ(port.read(some).status(), Status::device_lost);
        EXPECT_EQ(port.write(bytes_of("x")).status(), Status::device_lost);
    }
    EXPECT_EQ(open_files(), before);
}

TEST_F(SerialPort, IsClosedBeforeItOpensAgain) {
    const std::ptrdiff_t before = open_files();
    ASSERT_EQ(port.open(pty.path()), Status::ok);
    ASSERT_EQ(port.open(pty.path()), Status::ok);
    EXPECT_EQ(open_files(), before + 1);
    EXPECT_EQ(port.open("/dev/null"), Status::unsupported);
    EXPECT_EQ(open_files(), before);
}

/// F14: nobody reads for a while. What then arrives are whole records in their order, the newest among them.
TEST_F(SerialPort, SendsWholeRecordsToAPeerThatDoesNotRead) {
    ASSERT_EQ(port.open(pty.path()), Status::ok);
    std::vector<std::uint8_t> memory(1000);
    hal::RecordQueue queue({memory.data(), 1000});
    std::uint32_t given = 0;
    const auto send = [&] {
        ++given;
        EXPECT_EQ(queue.send(bytes_of(std::to_string(given) + ":" + std::string(given % 90, 'x') + "\n")),
                  Status::ok);
        EXPECT_EQ(queue.pump(port), Status::ok);
    };
    for (int i = 0; i < 3000; ++i) send();
    EXPECT_GT(queue.dropped(), 1000u);
    EXPECT_TRUE(queue.begun() || queue.waiting() > 0);
    std::string all;
    for (int turn = 0; queue.waiting() > 0 && turn < 1000; ++turn) {
        all += pty.heard(1);
        EXPECT_EQ(queue.pump(port), Status::ok);
    }
    const std::string newest = "\n" + std::to_string(given) + ":" + std::string(given % 90, 'x') + "\n";
    const auto ends = [&] {
        return all.size() > newest.size() && all.substr(all.size() - newest.size()) == newest;
    };
    for (std::string more = "?"; !ends() && !more.empty(); all += more) more = pty.heard(1);
    ASSERT_TRUE(ends());
    EXPECT_EQ(all.back(), '\n');
    std::uint32_t last = 0, arrived = 0;
    for (std::size_t at = 0; at < all.size();) {
        const std::size_t end = all.find('\n', at);
        const std::string record = all.substr(at, end - at);
        const std::uint32_t number = static_cast<std::uint32_t>(std::stoul(record));
        ASSERT_EQ(record, std::to_string(number) + ":" + std::string(number % 90, 'x'));
        ASSERT_GT(number, last);
        last = number;
        ++arrived;
        at = end + 1;
    }
    EXPECT_EQ(last, given);
    EXPECT_EQ(arrived + queue.dropped(), given);
}

TEST_F(SerialPort, SendsOnlyWholeRecordsToTheNextPeer) {
    ASSERT_EQ(port.open(pty.path()), Status::ok);
    std::vector<std::uint8_t> memory(1000);
    hal::RecordQueue queue({memory.data(), 1000});
    const std::string record = std::string(300, 'x') + "\n";
    while (!queue.begun()) {
        ASSERT_EQ(queue.send(bytes_of(record)), Status::ok);
        ASSERT_EQ(queue.pump(port), Status::ok);
    }
    ASSERT_EQ(queue.send(bytes_of("next\n")), Status::ok);
    pty.hang_up();
    EXPECT_EQ(queue.pump(port), Status::device_lost);
    EXPECT_EQ(queue.dropped(), 1u);
    Pty other;
    ASSERT_EQ(port.open(other.path()), Status::ok);
    EXPECT_EQ(queue.pump(port), Status::ok);
    EXPECT_EQ(other.heard(5), "next\n");
}

/// F15: a peer that never stops costs a turn no more than its share.
TEST_F(SerialPort, IsReadByTheLine) {
    ASSERT_EQ(port.open(pty.path()), Status::ok);
    hal::LineReader<> reader;
    int lines = 0, turns = 0;
    std::string flood;
    for (int i = 0; i < 5000; ++i) flood += "trigger\r\n";
    for (std::size_t said = 0; lines < 5000 && turns < 20000; ++turns) {
        const ssize_t went = ::write(pty.file(), flood.data() + said, flood.size() - said);
        if (went > 0) said += static_cast<std::size_t>(went);
        pollfd one = {port.file(), POLLIN, 0};
        ::poll(&one, 1, 2000);
        ASSERT_EQ(reader.fill(port), Status::ok);
        int here = 0;
        for (Result<Span<const char>> line = reader.next(); line.ok() && !line->empty();
             line = reader.next()) {
            ASSERT_EQ(std::string(line->begin(), line->end()), "trigger");
            ++here;
        }
        ASSERT_LE(here, 512 / 9 + 1);
        lines += here;
    }
    EXPECT_EQ(lines, 5000);
    EXPECT_EQ(reader.refused(), 0u);
}

/// Every call fails once, and from every call on all of them.
TEST(SerialPortSweep, EndsWithAStatusAndGivesAllBack) {
    int good = 0, lost = 0;
    std::string claim;
    const auto check = [&](bool holds, const char* what) {
        if (!holds) claim = what;
    };
    const int runs = sweep(
        Kernel{}, {EINTR, EIO, ENODEV, ENXIO, ENOSPC, EAGAIN, EBUSY, ENOTTY, EINVAL},
        [&](auto system) {
            Pty pty;
            linux_port::SerialPort port(system);
            const Status opened = port.open(pty.path());
            check(opened == Status::ok || (port.fault().status == opened && port.fault().call[0] != '\0'),
                  "open: a fault");
            check((opened == Status::ok) == port.is_open(), "open: open or not");
            if (opened != Status::ok) return;
            check(port.baud() == 115200, "open: baud");
            static_cast<void>(pty.say("in"));
            pollfd one = {port.file(), POLLIN, 0};
            ::poll(&one, 1, 2000);
            std::uint8_t some[3] = {'?', '?', '?'};
            const Result<int> got = port.read(some);
            const bool untouched = some[0] == '?' && some[1] == '?';
            check(got.ok() && *got > 0 ? some[0] == 'i' : untouched, "read: untouched");
            check(got.ok() || port.fault().status == got.status(), "read: a fault");
            if (!got) lost += got.status() == Status::device_lost;
            const Result<int> wrote = port.write(bytes_of("out"));
            check(
                wrote.ok() || port.fault().status == wrote.status() || wrote.status() == Status::device_lost,
                "write: a fault");
            const bool sent = wrote.ok() && *wrote == 3;
            check(pty.heard(sent ? 3 : 0) == (sent ? "out" : ""), "write: what was said");
            port.close();
            check(!port.is_open(), "close");
            good += got.ok() && wrote.ok();
        },
        [&](const SystemScript& script) {
            ASSERT_TRUE(script.all_given_back()) << script.fail_at << " " << script.error;
            ASSERT_EQ(claim, "") << script.fail_at << " " << script.error << " " << script.for_ever;
        });
    EXPECT_GE(runs, 200);
    EXPECT_GT(good, 20);
    EXPECT_GT(lost, 5);
    RecordProperty("runs", runs);
}

}  // namespace
}  // namespace fovea::test
