// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <signal.h>
#include <time.h>

#include <atomic>
#include <vector>

#include <fovea/linux/worker_pool.hpp>

namespace fovea::linux_port {
namespace {

void rest_us(int microseconds) {
    const timespec time = {0, microseconds * 1000L};
    ::nanosleep(&time, nullptr);
}

TEST(WorkerPool, DoesEveryPieceOnceAndNeverTwoOfOneWorker) {
    for (const int count : {1, 2, 5, most_workers}) {
        WorkerPool pool;
        Fault fault;
        ASSERT_EQ(pool.start(count, fault), Status::ok);
        const WorkerPool::Workers workers = pool.workers();
        EXPECT_EQ(workers.count(), count);
        for (const int pieces : {0, 1, 2, 7, 100}) {
            std::vector<int> done(static_cast<std::size_t>(pieces));
            std::atomic<bool> busy[most_workers] = {};
            std::atomic<int> faults{0};
            workers.run(pieces, [&](int index, int worker) {
                if (worker < 0 || worker >= count || busy[worker].exchange(true)) ++faults;
                ++done[static_cast<std::size_t>(index)];
                rest_us(10);
                busy[worker] = false;
            });
            EXPECT_EQ(faults, 0);
            EXPECT_EQ(done, std::vector<int>(static_cast<std::size_t>(pieces), 1));
        }
    }
}

TEST(WorkerPool, WorksOnPiecesAtOnce) {
    WorkerPool pool;
    Fault fault;
    ASSERT_EQ(pool.start(3, fault), Status::ok);
    // Each waits for the others: one thread alone would wait for ever.
    std::atomic<int> there{0};
    pool.workers().run(3, [&](int, int) {
        ++there;
        while (there < 3) rest_us(100);
    });
    EXPECT_EQ(there, 3);
}

TEST(WorkerPool, SeesWhatItsWorkersWrote) {
    WorkerPool pool;
    Fault fault;
    ASSERT_EQ(pool.start(4, fault), Status::ok);
    // Plain memory, written anew in each round by whoever comes: a sanitizer of threads looks on.
    std::vector<int> numbers(64, 0);
    for (int round = 1; round <= 2000; ++round) {
        pool.workers().run(8, [&](int index, int) {
            for (int k = 0; k < 8; ++k) ++numbers[static_cast<std::size_t>(8 * index + k)];
        });
        for (const int number : numbers) ASSERT_EQ(number, round);
    }
}

TEST(WorkerPool, HearsNoSignals) {
    WorkerPool pool;
    Fault fault;
    ASSERT_EQ(pool.start(2, fault), Status::ok);
    std::atomic<int> met{0};
    std::atomic<bool> hears{false};
    pool.workers().run(2, [&](int, int worker) {
        ++met;
        while (met < 2) rest_us(100);
        sigset_t blocked;
        ::pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
        if (worker > 0 && ::sigismember(&blocked, SIGTERM) != 1) hears = true;
    });
    EXPECT_FALSE(hears);
}

TEST(WorkerPool, EndsAndBeginsAgain) {
    WorkerPool pool;
    Fault fault;
    for (int round = 0; round < 20; ++round) {
        ASSERT_EQ(pool.start(3, fault), Status::ok);
        EXPECT_EQ(pool.start(3, fault), Status::bad_argument) << "it runs";
        std::atomic<int> done{0};
        pool.workers().run(5, [&](int, int) { ++done; });
        EXPECT_EQ(done, 5);
        pool.stop();
        EXPECT_EQ(pool.workers().count(), 1);
        pool.workers().run(5, [&](int, int worker) { EXPECT_EQ(worker, 0); });
        pool.stop();
    }
}

TEST(WorkerPool, RefusesWhatItCannotBe) {
    WorkerPool pool;
    Fault fault;
    for (const int count : {-1, 0, most_workers + 1})
        EXPECT_EQ(pool.start(count, fault), Status::bad_argument);
}

}  // namespace
}  // namespace fovea::linux_port
