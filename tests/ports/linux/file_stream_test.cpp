// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <unistd.h>
#include <csignal>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/linux/file_stream.hpp>

#include "support/failing_system.hpp"

namespace fovea::linux_port {
namespace {

/// A pipe that waits, as that of a shell does.
struct Pipe {
    Pipe() { EXPECT_EQ(::pipe(ends), 0); }
    ~Pipe() {
        for (const int end : ends)
            if (end >= 0) ::close(end);
    }
    int ends[2] = {-1, -1};
};

TEST(FileStream, FillsAPipeAndThenTakesNothing) {
    Pipe pipe;
    FileStream stream(Kernel(), pipe.ends[1]);
    const std::vector<std::uint8_t> bytes(10000, 7);
    int sent = 0;
    for (int k = 0; k < 1000; ++k) {
        const Result<int> took = stream.write({bytes.data(), 10000});
        ASSERT_TRUE(took);
        sent += *took;
        if (*took == 0) break;
    }
    EXPECT_GE(sent, 60000);
    EXPECT_EQ(stream.write({bytes.data(), 1}).value(), 0);
    FileStream reader(Kernel(), pipe.ends[0]);
    std::vector<std::uint8_t> got(8192);
    EXPECT_EQ(reader.read({got.data(), 8192}).value(), 4096);
    EXPECT_EQ(stream.write({bytes.data(), 10000}).value(), 4096);
}

TEST(FileStream, TellsThatTheOtherEndIsGone) {
    std::signal(SIGPIPE, SIG_IGN);
    Pipe pipe;
    FileStream stream(Kernel(), pipe.ends[1]);
    ::close(pipe.ends[0]);
    pipe.ends[0] = -1;
    const std::uint8_t byte = 1;
    EXPECT_EQ(stream.write({&byte, 1}).status(), Status::device_lost);
    Pipe other;
    FileStream reader(Kernel(), other.ends[0]);
    std::uint8_t got = 0;
    EXPECT_EQ(reader.read({&got, 1}).value(), 0);
    ::close(other.ends[1]);
    other.ends[1] = -1;
    EXPECT_EQ(reader.read({&got, 1}).status(), Status::device_lost);
}

TEST(FileStream, SaysWhichCallFailed) {
    Pipe pipe;
    const int runs = test::sweep(
        Kernel(), {EINTR, EIO, ENODEV, EAGAIN},
        [&](auto system) {
            FileStream stream(system, pipe.ends[1]);
            const std::uint8_t bytes[3] = {1, 2, 3};
            const Result<int> took = stream.write({bytes, 3});
            if (!took) {
                EXPECT_NE(stream.fault().error, 0);
            }
        },
        [](const test::SystemScript& script) { EXPECT_TRUE(script.all_given_back()); });
    EXPECT_EQ(runs, 14);
}

}  // namespace
}  // namespace fovea::linux_port
