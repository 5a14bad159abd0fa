// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <poll.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <fovea/linux/service_notify.hpp>
#include <support/failing_system.hpp>

namespace fovea::test {
namespace {

namespace files = std::filesystem;
using linux_port::NotifyEnvironment;

/// A manager of services: a socket that listens.
class Manager {
public:
    /// name as in NOTIFY_SOCKET.
    explicit Manager(const std::string& name) : file_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::memcpy(address.sun_path, name.data(), name.size());
        const bool abstract = name[0] == '@';
        if (abstract) address.sun_path[0] = '\0';
        const std::size_t size = offsetof(sockaddr_un, sun_path) + name.size() + (abstract ? 0 : 1);
        bound_ =
            ::bind(file_, reinterpret_cast<const sockaddr*>(&address), static_cast<socklen_t>(size)) == 0;
    }
    ~Manager() { ::close(file_); }
    Manager(const Manager&) = delete;
    Manager& operator=(const Manager&) = delete;

    bool bound() const { return bound_; }
    std::vector<std::string> heard() {
        std::vector<std::string> all;
        char text[2000];
        for (pollfd one = {file_, POLLIN, 0}; ::poll(&one, 1, 0) > 0;) {
            const ssize_t got = ::recv(file_, text, sizeof text, 0);
            if (got < 0) break;
            all.emplace_back(text, static_cast<std::size_t>(got));
        }
        return all;
    }

private:
    int file_;
    bool bound_ = false;
};

using Messages = std::vector<std::string>;

/// Time that a test makes pass, and a number of the process.
struct Timed : linux_port::Kernel {
    std::int64_t* now = nullptr;
    std::int64_t monotonic_us() { return *now; }
    int process_id() { return 4711; }
};

struct ServiceNotify : testing::Test {
    ServiceNotify() {
        std::string pattern = (files::temp_directory_path() / "fovea_notify_XXXXXX").string();
        folder = ::mkdtemp(pattern.data());
        path = (folder / "socket").string();
    }
    ~ServiceNotify() override { files::remove_all(folder); }

    files::path folder;
    std::string path;
    std::int64_t now = 1234567;
    Timed system{{}, &now};
};

TEST_F(ServiceNotify, SaysHowTheServiceIs) {
    Manager manager(path);
    ASSERT_TRUE(manager.bound());
    linux_port::ServiceNotify notify(system, {path.c_str()});
    EXPECT_TRUE(notify.used());
    EXPECT_EQ(notify.ready(), Status::ok);
    EXPECT_EQ(notify.reloading(), Status::ok);
    EXPECT_EQ(notify.status("12 parts, 1 not ok"), Status::ok);
    EXPECT_EQ(notify.watchdog(), Status::ok);
    EXPECT_EQ(notify.stopping(), Status::ok);
    EXPECT_EQ(manager.heard(), (Messages{"READY=1", "RELOADING=1\nMONOTONIC_USEC=1234567",
                                         "STATUS=12 parts, 1 not ok", "WATCHDOG=1", "STOPPING=1"}));
}

TEST_F(ServiceNotify, SpeaksToAnAbstractSocket) {
    // As long as names can be, too.
    for (std::string name : {"@" + path, "@" + path + std::string(107 - path.size(), 'x')}) {
        Manager manager(name);
        ASSERT_TRUE(manager.bound());
        linux_port::ServiceNotify notify(system, {name.c_str()});
        EXPECT_EQ(notify.ready(), Status::ok) << name;
        EXPECT_EQ(manager.heard(), Messages{"READY=1"});
    }
}

TEST_F(ServiceNotify, DoesNothingWhereNobodyListens) {
    for (const char* unset : {static_cast<const char*>(nullptr), ""}) {
        SystemScript script;
        linux_port::ServiceNotify notify(FailingSystem<>(script), {unset, "1000000", nullptr});
        EXPECT_FALSE(notify.used());
        EXPECT_EQ(notify.ready(), Status::ok);
        EXPECT_EQ(notify.reloading(), Status::ok);
        EXPECT_EQ(notify.status("x"), Status::ok);
        EXPECT_EQ(notify.stopping(), Status::ok);
        notify.feed();
        EXPECT_EQ(script.calls, 0);
    }
}

TEST_F(ServiceNotify, RefusesWhatIsNoAddress) {
    const std::string longest = "/" + std::string(106, 'x');
    for (const std::string& bad : {std::string("socket"), std::string("@"), std::string("vsock:2:1"),
                                   longest + "x", "@" + std::string(108, 'x')}) {
        linux_port::ServiceNotify notify(system, {bad.c_str()});
        EXPECT_FALSE(notify.used());
        EXPECT_EQ(notify.ready(), Status::bad_argument) << bad;
        EXPECT_STREQ(notify.fault().about, "NOTIFY_SOCKET is no address of a local socket");
    }
    linux_port::ServiceNotify notify(system, {longest.c_str()});
    EXPECT_EQ(notify.ready(), Status::not_found) << "an address, and nobody there";
    EXPECT_EQ(notify.fault().error, ENOENT);
}

TEST_F(ServiceNotify, SaysOneLineOfStatus) {
    Manager manager(path);
    linux_port::ServiceNotify notify(system, {path.c_str()});
    EXPECT_EQ(notify.status("a\nREADY=1\r\nb"), Status::ok);
    EXPECT_EQ(notify.status(""), Status::ok);
    EXPECT_EQ(notify.status(std::string(1000, 'x').c_str()), Status::ok);
    // Of 400 bytes the last is the first of two that are one letter.
    EXPECT_EQ(notify.status((std::string(399, 'x') + "\xc3\xa4").c_str()), Status::ok);
    EXPECT_EQ(notify.status((std::string(398, 'x') + "\xc3\xa4").c_str()), Status::ok);
    EXPECT_EQ(manager.heard(),
              (Messages{"STATUS=a READY=1  b", "STATUS=", "STATUS=" + std::string(400, 'x'),
                        "STATUS=" + std::string(399, 'x'), "STATUS=" + std::string(398, 'x') + "\xc3\xa4"}));
}

TEST_F(ServiceNotify, DoesNotWaitForAManagerThatDoesNotRead) {
    Manager manager(path);
    linux_port::ServiceNotify notify(system, {path.c_str()});
    int sent = 0;
    while (sent < 100000 && notify.watchdog() == Status::ok) ++sent;
    EXPECT_LT(sent, 100000);
    EXPECT_EQ(notify.ready(), Status::timeout);
    EXPECT_EQ(notify.fault().error, EAGAIN);
    EXPECT_EQ(manager.heard().size(), static_cast<std::size_t>(sent));
    EXPECT_EQ(notify.ready(), Status::ok);
}

TEST_F(ServiceNotify, FindsAManagerThatStartedAnew) {
    linux_port::ServiceNotify notify(system, {path.c_str()});
    { EXPECT_TRUE(Manager(path).bound()); }
    EXPECT_EQ(notify.ready(), Status::io_error);
    EXPECT_EQ(notify.fault().error, ECONNREFUSED);
    files::remove(path);
    Manager manager(path);
    EXPECT_EQ(notify.ready(), Status::ok);
    EXPECT_EQ(manager.heard(), Messages{"READY=1"});
}

TEST_F(ServiceNotify, KnowsWhetherItIsWatched) {
    const auto period = [&](const char* usec, const char* pid) {
        return linux_port::ServiceNotify(system, {path.c_str(), usec, pid}).watchdog_period_us();
    };
    EXPECT_EQ(period("10000000", nullptr), 10000000);
    EXPECT_EQ(period("10000000", "4711"), 10000000);
    EXPECT_EQ(period("10000000", "4712"), 0) << "that is another process";
    EXPECT_EQ(period(nullptr, "4711"), 0);
    for (const char* bad : {"", "0", "-1", "1e6", "10 ", "99999999999999999999999"})
        EXPECT_EQ(period(bad, nullptr), 0) << bad;
    for (const char* bad : {"", "x", "04711x", "-4711"}) EXPECT_EQ(period("10", bad), 0) << bad;
    EXPECT_EQ(period("4611686018427387904", nullptr), std::int64_t{1} << 62);
    EXPECT_EQ(period("4611686018427387905", nullptr), 0);
}

TEST_F(ServiceNotify, FeedsFourTimesAPeriod) {
    Manager manager(path);
    linux_port::ServiceNotify notify(system, {path.c_str(), "1000000", "4711"});
    // A turn a millisecond, for 10 seconds.
    std::size_t all = 0;
    for (int turn = 0; turn < 10000; ++turn, now += 1000) {
        notify.feed();
        if (turn % 100 == 0) all += manager.heard().size();
    }
    EXPECT_EQ(all + manager.heard().size(), 40u);
    linux_port::ServiceNotify unwatched(system, {path.c_str()});
    unwatched.feed();
    EXPECT_EQ(manager.heard(), Messages());
}

TEST_F(ServiceNotify, FeedsAgainWhereItFailed) {
    linux_port::ServiceNotify notify(system, {path.c_str(), "1000000", nullptr});
    notify.feed();
    EXPECT_EQ(notify.fault().error, ENOENT);
    Manager manager(path);
    notify.feed();
    notify.feed();
    EXPECT_EQ(manager.heard(), Messages{"WATCHDOG=1"});
}

TEST_F(ServiceNotify, EndsEverySweepWithAStatus) {
    Manager manager(path);
    std::string claim;
    int said = 0;
    const int runs = sweep(
        system, {EINTR, EIO, ENODEV, ENOSPC, EAGAIN, ECONNREFUSED, EMFILE, ENOBUFS},
        [&](auto failing) {
            linux_port::ServiceNotify notify(failing, {path.c_str(), "1000000", nullptr});
            int ok = 0;
            for (int i = 0; i < 4; ++i) {
                const Status status = i == 0   ? notify.ready()
                                      : i == 1 ? notify.reloading()
                                               : notify.stopping();
                if (status != Status::ok && notify.fault().status != status) claim = describe(status);
                ok += status == Status::ok;
            }
            if (manager.heard().size() != static_cast<std::size_t>(ok)) claim = "not what was said";
            said += ok;
        },
        [&](const SystemScript& script) {
            ASSERT_TRUE(script.all_given_back()) << script.fail_at << " " << script.error;
            ASSERT_EQ(claim, "") << script.fail_at << " " << script.error;
        });
    RecordProperty("runs", runs);
    EXPECT_GE(runs, 70);
    EXPECT_GT(said, 100);
}

}  // namespace
}  // namespace fovea::test
