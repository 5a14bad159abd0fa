// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/hal/record_queue.hpp>
#include <fovea/simulated/byte_pipe.hpp>

namespace fovea::test {
namespace {

/// Takes as much as a test says, or is gone.
struct Line {
    Result<int> read(Span<std::uint8_t>) { return 0; }
    Result<int> write(Span<const std::uint8_t> bytes) {
        if (answer != Status::ok) return answer;
        const int count = static_cast<int>(std::min<std::ptrdiff_t>(bytes.size(), room));
        sent.append(bytes.begin(), bytes.begin() + count);
        room -= count;
        return count;
    }

    std::string sent;
    int room = 0;
    Status answer = Status::ok;
};

struct Records : testing::Test {
    explicit Records(std::size_t bytes = 30)
        : memory(bytes), queue({memory.data(), static_cast<std::ptrdiff_t>(bytes)}) {}

    Status send(const std::string& text) {
        return queue.send(
            {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())});
    }
    /// What the line has after so many bytes more.
    std::string after(int bytes) {
        line.room = bytes;
        EXPECT_EQ(queue.pump(line), Status::ok);
        return line.sent;
    }

    std::vector<std::uint8_t> memory;
    hal::RecordQueue queue;
    Line line;
};

TEST_F(Records, SendsThemInTheirOrder) {
    ASSERT_EQ(send("one,"), Status::ok);
    ASSERT_EQ(send("two,"), Status::ok);
    EXPECT_EQ(queue.waiting(), 2);
    EXPECT_EQ(after(100), "one,two,");
    EXPECT_EQ(queue.waiting(), 0);
    EXPECT_EQ(queue.dropped(), 0u);
    EXPECT_EQ(after(100), "one,two,");
}

TEST_F(Records, GoesOnWhereTheStreamStopped) {
    ASSERT_EQ(send("one,"), Status::ok);
    EXPECT_EQ(after(0), "");
    EXPECT_FALSE(queue.begun());
    EXPECT_EQ(after(1), "o");
    EXPECT_TRUE(queue.begun());
    EXPECT_EQ(after(2), "one");
    EXPECT_EQ(queue.waiting(), 1);
    EXPECT_EQ(after(9), "one,");
    EXPECT_EQ(queue.waiting(), 0);
}

TEST_F(Records, KeepsTheNewest) {
    // Room for three of 6 bytes.
    for (const char* text : {"first,", "secon,", "third,", "fourt,", "fifth,"})
        ASSERT_EQ(send(text), Status::ok);
    EXPECT_EQ(queue.dropped(), 2u);
    EXPECT_EQ(queue.waiting(), 3);
    EXPECT_EQ(after(100), "third,fourt,fifth,");
}

TEST_F(Records, FinishesTheOneThatHasBegunBeforeAnyNewer) {
    ASSERT_EQ(send("first,"), Status::ok);
    EXPECT_EQ(after(2), "fi");
    for (const char* text : {"secon,", "third,", "fourt,", "fifth,"}) ASSERT_EQ(send(text), Status::ok);
    EXPECT_EQ(queue.dropped(), 2u);
    EXPECT_EQ(after(100), "first,fourt,fifth,");
}

TEST_F(Records, DropsAHalfSentOneWhenTheDeviceIsLost) {
    ASSERT_EQ(send("first,"), Status::ok);
    ASSERT_EQ(send("secon,"), Status::ok);
    EXPECT_EQ(after(2), "fi");
    line.answer = Status::device_lost;
    EXPECT_EQ(queue.pump(line), Status::device_lost);
    EXPECT_EQ(queue.dropped(), 1u);
    EXPECT_EQ(queue.waiting(), 1);
    Line other;
    other.room = 100;
    EXPECT_EQ(queue.pump(other), Status::ok);
    EXPECT_EQ(other.sent, "secon,");
}

TEST_F(Records, KeepsAHalfSentOneAfterAnyOtherError) {
    ASSERT_EQ(send("first,"), Status::ok);
    EXPECT_EQ(after(2), "fi");
    line.answer = Status::io_error;
    EXPECT_EQ(queue.pump(line), Status::io_error);
    line.answer = Status::ok;
    EXPECT_EQ(after(100), "first,");
    EXPECT_EQ(queue.dropped(), 0u);
}

TEST_F(Records, DropsNothingWhereNoneHasBegun) {
    ASSERT_EQ(send("first,"), Status::ok);
    queue.drop_begun();
    EXPECT_EQ(queue.dropped(), 0u);
    EXPECT_EQ(after(100), "first,");
}

TEST_F(Records, RefusesWhatCanNeverFit) {
    ASSERT_EQ(send("first,"), Status::ok);
    EXPECT_EQ(send(""), Status::bad_argument);
    EXPECT_EQ(queue.dropped(), 0u);
    EXPECT_EQ(send(std::string(27, 'x')), Status::buffer_too_small);
    EXPECT_EQ(queue.dropped(), 1u);
    EXPECT_EQ(queue.waiting(), 1) << "nothing makes place for it";
    ASSERT_EQ(send(std::string(26, 'x')), Status::ok);
    EXPECT_EQ(queue.dropped(), 2u);
    EXPECT_EQ(after(100), std::string(26, 'x'));
}

TEST_F(Records, RefusesWhatCannotFitBesideTheOneThatHasBegun) {
    ASSERT_EQ(send("first,"), Status::ok);
    ASSERT_EQ(send("secon,"), Status::ok);
    EXPECT_EQ(after(2), "fi");
    EXPECT_EQ(send(std::string(23, 'x')), Status::capacity_exceeded);
    EXPECT_EQ(queue.waiting(), 2);
    ASSERT_EQ(send(std::string(22, 'x')), Status::ok);
    EXPECT_EQ(after(100), "first," + std::string(22, 'x'));
    EXPECT_EQ(queue.dropped(), 2u);
}

TEST_F(Records, WorksWithoutMemory) {
    hal::RecordQueue none({});
    const std::uint8_t byte[1] = {1};
    EXPECT_EQ(none.send(byte), Status::buffer_too_small);
    EXPECT_EQ(none.pump(line), Status::ok);
    EXPECT_EQ(none.dropped(), 1u);
}

/// Any sizes, any room, losses in between: the other end sees whole records in their order, and those that it
/// does not see are counted.
TEST(RecordsAtRandom, ArriveWholeAndInOrderOrAreCounted) {
    constexpr int runs = 3000;
    long whole = 0, half = 0;
    for (int run = 0; run < runs; ++run) {
        Random random(static_cast<std::uint64_t>(run));
        std::vector<std::uint8_t> memory(20 + random.below(100));
        hal::RecordQueue queue({memory.data(), static_cast<std::ptrdiff_t>(memory.size())});
        Line line;
        std::uint32_t given = 0, arrived = 0, last = 0;
        // Records are "number:xxx;" with as many x as the number says.
        const auto read_all = [&] {
            std::size_t from = 0;
            for (std::size_t end; (end = line.sent.find(';', from)) != std::string::npos; from = end + 1) {
                const std::string record = line.sent.substr(from, end - from);
                const std::size_t colon = record.find(':');
                ASSERT_NE(colon, std::string::npos) << line.sent;
                const std::uint32_t number = static_cast<std::uint32_t>(std::stoul(record.substr(0, colon)));
                ASSERT_EQ(record.substr(colon + 1), std::string(number * 7 % 23, 'x'));
                ASSERT_GT(number, last);
                last = number;
                ++arrived;
            }
            half += from != line.sent.size();
            line.sent.erase(0, from);
        };
        for (int step = 0; step < 60; ++step) {
            switch (random.below(8)) {
                case 0:
                    line.answer = Status::device_lost;
                    static_cast<void>(queue.pump(line));
                    ASSERT_FALSE(queue.begun());
                    read_all();
                    line = {};
                    break;
                case 1:
                case 2:
                case 3: {
                    ++given;
                    const std::string text =
                        std::to_string(given) + ":" + std::string(given * 7 % 23, 'x') + ";";
                    static_cast<void>(queue.send({reinterpret_cast<const std::uint8_t*>(text.data()),
                                                  static_cast<std::ptrdiff_t>(text.size())}));
                    break;
                }
                default:
                    line.room = static_cast<int>(random.below(30));
                    ASSERT_EQ(queue.pump(line), Status::ok);
                    read_all();
            }
            if (HasFatalFailure()) return;
        }
        line.room = 1 << 20;
        ASSERT_EQ(queue.pump(line), Status::ok);
        read_all();
        ASSERT_EQ(line.sent, "");
        ASSERT_EQ(queue.waiting(), 0);
        ASSERT_EQ(arrived + queue.dropped(), given) << run;
        whole += arrived;
    }
    EXPECT_GT(whole, 10 * runs / 2);
    EXPECT_GT(half, runs) << "records must be seen half sent, too";
}

}  // namespace
}  // namespace fovea::test
