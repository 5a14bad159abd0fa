// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/simulated/byte_pipe.hpp>

#include <daemon/serial_link.hpp>

namespace fovea::apps {
namespace {

/// A port that may be pulled, and counts how often it was opened.
struct Port : simulated::BytePipe {
    Result<int> read(Span<std::uint8_t> into) {
        return pulled ? Result<int>(Status::device_lost) : BytePipe::read(into);
    }
    Result<int> write(Span<const std::uint8_t> bytes) {
        return pulled ? Result<int>(Status::device_lost) : BytePipe::write(bytes);
    }
    void close() { ++closed; }
    bool pulled = false;
    int opened = 0;
    int closed = 0;
};
struct Opening {
    Status operator()(Port& port) const {
        ++port.opened;
        return port.pulled ? Status::not_found : Status::ok;
    }
};

Span<const std::uint8_t> bytes(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())};
}
std::string take_sent(Port& port) {
    const std::string text(port.sent.begin(), port.sent.end());
    port.sent.clear();
    return text;
}

struct Bench {
    Port port;
    std::uint8_t memory[64];
    SerialLink<Port, Opening> link{port, Opening{}, memory};
};

TEST(SerialLink, SendsAndReads) {
    Bench bench;
    EXPECT_EQ(bench.link.send(bytes("one\n")), Status::ok);
    for (const char c : std::string("TRG\r\n")) bench.port.arriving.push_back(static_cast<std::uint8_t>(c));
    bench.link.turn(0);
    EXPECT_EQ(take_sent(bench.port), "one\n");
    const Result<Span<const char>> line = bench.link.next_line();
    ASSERT_TRUE(line);
    EXPECT_EQ(std::string(line->begin(), line->end()), "TRG");
    EXPECT_FALSE(bench.link.take_event());
}

TEST(SerialLink, OpensALostPortEverySecondAndTellsOnce) {
    Bench bench;
    bench.link.turn(0);
    bench.port.pulled = true;
    for (std::int64_t now = 0; now <= 5000000; now += 10000) bench.link.turn(now);
    EXPECT_EQ(bench.port.opened, 6);
    EXPECT_TRUE(bench.link.take_event());
    EXPECT_EQ(bench.link.trouble(), Status::not_found);
    EXPECT_FALSE(bench.link.take_event());
    bench.port.pulled = false;
    bench.link.turn(5500000);
    EXPECT_FALSE(bench.link.open());
    bench.link.hurry();
    bench.link.turn(5500001);
    EXPECT_TRUE(bench.link.open());
    EXPECT_TRUE(bench.link.take_event());
    EXPECT_EQ(bench.link.trouble(), Status::ok);
}

TEST(SerialLink, TellsOnceOfAPortThatIsGoneAndThenNotFound) {
    Bench bench;
    bench.link.turn(0);
    bench.port.pulled = true;
    int told = 0;
    for (std::int64_t now = 0; now <= 5000000; now += 10000) {
        bench.link.turn(now);
        if (bench.link.take_event()) ++told;
    }
    EXPECT_EQ(told, 1);
}

TEST(SerialLink, NeverSendsTheRestOfARecordToAPortThatWasOpenedAnew) {
    Bench bench;
    bench.port.room = 3;
    EXPECT_EQ(bench.link.send(bytes("torn in two\n")), Status::ok);
    EXPECT_EQ(bench.link.send(bytes("whole\n")), Status::ok);
    bench.link.turn(0);
    EXPECT_EQ(take_sent(bench.port), "tor");
    bench.port.pulled = true;
    bench.link.turn(10000);
    bench.port.pulled = false;
    bench.port.room = 1000;
    bench.link.turn(1010000);
    EXPECT_EQ(take_sent(bench.port), "whole\n");
    EXPECT_EQ(bench.link.dropped(), 1u);
}

TEST(SerialLink, DoesNothingWithoutAPort) {
    Port port;
    std::uint8_t memory[64];
    SerialLink<Port, Opening> link(port, Opening{}, memory, false);
    link.turn(0);
    EXPECT_EQ(port.opened, 0);
    EXPECT_FALSE(link.take_event());
    EXPECT_EQ(link.trouble(), Status::ok);
}

}  // namespace
}  // namespace fovea::apps
