// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>

#include <fovea/linux/device_watch.hpp>

#include "support/failing_system.hpp"

namespace fovea::linux_port {
namespace {

struct Folder {
    Folder() { EXPECT_NE(::mkdtemp(path), nullptr); }
    ~Folder() {
        ::unlink(node().c_str());
        ::rmdir(path);
    }
    std::string node() const { return std::string(path) + "/node"; }
    void make() const { ::close(::open(node().c_str(), O_CREAT | O_WRONLY, 0600)); }
    char path[24] = "/tmp/fovea.XXXXXX";
};

TEST(DeviceWatch, TellsThatANodeCameAndThatItsRightsChanged) {
    Folder folder;
    DeviceWatch watch{Kernel()};
    ASSERT_EQ(watch.open(folder.path), Status::ok);
    EXPECT_FALSE(watch.take());
    folder.make();
    EXPECT_TRUE(watch.take());
    EXPECT_FALSE(watch.take());
    ::chmod(folder.node().c_str(), 0660);
    EXPECT_TRUE(watch.take());
    ::unlink(folder.node().c_str());
    EXPECT_FALSE(watch.take());  // what goes is told by itself
    watch.close();
    EXPECT_FALSE(watch.take());
}

TEST(DeviceWatch, SaysThatThereIsNoSuchFolder) {
    DeviceWatch watch{Kernel()};
    EXPECT_EQ(watch.open("/no/such/folder"), Status::not_found);
    EXPECT_EQ(watch.file(), -1);
    EXPECT_FALSE(watch.take());
}

TEST(DeviceWatch, GivesAllBackWhicheverCallFails) {
    Folder folder;
    const int runs = test::sweep(
        Kernel(), {EIO, EMFILE, ENOSPC},
        [&](auto system) {
            DeviceWatch watch(system);
            const bool opened = watch.open(folder.path) == Status::ok;
            EXPECT_EQ(opened, watch.file() >= 0);
            static_cast<void>(watch.take());
        },
        [](const test::SystemScript& script) { EXPECT_TRUE(script.all_given_back()) << script.failed; });
    EXPECT_GE(runs, 18);
}

}  // namespace
}  // namespace fovea::linux_port
