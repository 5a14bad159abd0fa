// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <signal.h>
#include <time.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/linux/background_writer.hpp>

namespace fovea::linux_port {
namespace {

void sleep_ms(int milliseconds) {
    const timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000};
    ::nanosleep(&time, nullptr);
}

/// Notes what it is given; holds at a gate that a test opens.
struct Notes {
    std::atomic<bool> open{true};
    std::atomic<int> begun{0};
    std::atomic<int> done{0};
    std::atomic<bool> hears_signals{false};
    std::string all;  ///< of the thread, until it has ended

    void operator()(const WritingJob& job) {
        ++begun;
        while (!open) sleep_ms(1);
        sigset_t blocked;
        ::pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
        if (::sigismember(&blocked, SIGTERM) != 1) hears_signals = true;
        all.append(reinterpret_cast<const char*>(job.first.data()),
                   static_cast<std::size_t>(job.first.size()));
        all.append(reinterpret_cast<const char*>(job.second.data()),
                   static_cast<std::size_t>(job.second.size()));
        ++done;
    }
};

struct Bench {
    Notes notes;
    std::vector<std::uint8_t> memory = std::vector<std::uint8_t>(64);
    Fault fault;
    BackgroundWriter<Notes> writer{notes};

    Status start(int places) {
        return writer.start(places, 2, 1, {memory.data(), static_cast<std::ptrdiff_t>(memory.size())}, fault);
    }
    bool offer(char letter) {
        WritingJob job;
        if (!writer.offer(job)) return false;
        job.first[0] = static_cast<std::uint8_t>(letter);
        job.second[0] = '.';
        writer.hand_over(1, 1);
        return true;
    }
    void wait_until_begun(int jobs) {
        while (notes.begun < jobs) sleep_ms(1);
    }
};

TEST(BackgroundWriter, DoesWhatItIsGivenInOrder) {
    Bench bench;
    ASSERT_EQ(bench.start(4), Status::ok);
    std::string expected;
    for (int k = 0; k < 500; ++k) {
        const char letter = static_cast<char>('a' + k % 26);
        while (!bench.offer(letter)) sleep_ms(1);
        expected += letter;
        expected += '.';
    }
    EXPECT_EQ(bench.writer.stop(10000000), Status::ok);
    EXPECT_EQ(bench.notes.all, expected);
    EXPECT_FALSE(bench.notes.hears_signals);
    EXPECT_FALSE(bench.offer('x')) << "it has ended";
}

TEST(BackgroundWriter, DropsAndCountsWhileAJobHangs) {
    Bench bench;
    ASSERT_EQ(bench.start(2), Status::ok);
    bench.notes.open = false;
    EXPECT_TRUE(bench.offer('a'));
    bench.wait_until_begun(1);
    EXPECT_TRUE(bench.offer('b'));
    for (int k = 0; k < 1000; ++k) EXPECT_FALSE(bench.offer('c'));
    EXPECT_EQ(bench.writer.dropped(), 1000u);
    bench.notes.open = true;
    bench.wait_until_begun(2);
    while (!bench.offer('d')) sleep_ms(1);
    EXPECT_EQ(bench.writer.stop(10000000), Status::ok);
    EXPECT_EQ(bench.notes.all, "a.b.d.");
}

TEST(BackgroundWriter, EndsWithinItsPatience) {
    Bench bench;
    ASSERT_EQ(bench.start(4), Status::ok);
    bench.notes.open = false;
    for (const char letter : {'a', 'b', 'c'}) EXPECT_TRUE(bench.offer(letter));
    bench.wait_until_begun(1);
    Kernel kernel;
    const std::int64_t start_us = kernel.monotonic_us();
    EXPECT_EQ(bench.writer.stop(20000), Status::timeout);
    EXPECT_GE(kernel.monotonic_us() - start_us, 20000);
    EXPECT_LT(kernel.monotonic_us() - start_us, 5000000);
    EXPECT_TRUE(bench.writer.running());
    EXPECT_FALSE(bench.offer('x'));
    bench.notes.open = true;
    EXPECT_EQ(bench.writer.stop(10000000), Status::ok);
    EXPECT_EQ(bench.notes.all, "a.") << "what waited is given up";
}

TEST(BackgroundWriter, BeginsAgainAfterItsEnd) {
    Bench bench;
    for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(bench.start(1), Status::ok);
        EXPECT_EQ(bench.start(1), Status::bad_argument);
        EXPECT_TRUE(bench.offer('a'));
        EXPECT_EQ(bench.writer.stop(10000000), Status::ok);
    }
    EXPECT_EQ(bench.notes.done, 3);
    ASSERT_EQ(bench.start(1), Status::ok);
    EXPECT_TRUE(bench.offer('b'));
    // The destructor ends it, with what it was given.
}

TEST(BackgroundWriter, RefusesWhatDoesNotFit) {
    Bench bench;
    EXPECT_EQ(bench.writer.stop(0), Status::ok);
    EXPECT_FALSE(bench.offer('a'));
    for (const int places : {-1, 0, 3, 5, 32}) EXPECT_EQ(bench.start(places), Status::bad_argument) << places;
    EXPECT_EQ(bench.writer.start(4, 20, 1, {bench.memory.data(), 64}, bench.fault),
              Status::scratch_too_small);
    EXPECT_EQ((BackgroundWriter<Notes>::memory_bytes(4, 20, 1)), 84);
}

TEST(Turns, RunOverWithoutLosingAPlace) {
    Turns turns(4);
    // 2^32 turns are too many for a test: the count of places divides them, so that places go on in turn.
    for (int round = 0; round < 10; ++round) {
        for (int k = 0; k < 4; ++k) {
            EXPECT_EQ(turns.free_place(), k);
            turns.filled();
        }
        EXPECT_EQ(turns.free_place(), -1);
        for (int k = 0; k < 4; ++k) {
            EXPECT_EQ(turns.full_place(), k);
            turns.emptied();
        }
        EXPECT_EQ(turns.full_place(), -1);
    }
}

}  // namespace
}  // namespace fovea::linux_port
