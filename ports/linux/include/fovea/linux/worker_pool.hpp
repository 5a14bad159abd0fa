// SPDX-License-Identifier: MIT
//
// WorkerPool: a fixed number of threads that do the pieces of one picture's work at once.
#pragma once

#include <pthread.h>
#include <semaphore.h>

#include <algorithm>
#include <atomic>
#include <cerrno>

#include <fovea/base/assert.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/workers.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/thread.hpp>

namespace fovea::linux_port {

/// The thread that calls is one of the workers, so a pool of one has no thread of its own. Between two calls
/// the others sleep. Nothing is allocated after start(). For one caller at a time; a piece must not hand out
/// pieces itself.
class WorkerPool {
public:
    /// The workers as operators take them, see OneWorker. A handle: the pool must outlive it.
    class Workers {
    public:
        explicit Workers(WorkerPool& pool) : pool_(&pool) {}
        int count() const { return pool_->count_; }
        template <class Piece>
        void run(int pieces, const Piece& piece) const {
            pool_->run(pieces, piece);
        }

    private:
        WorkerPool* pool_;
    };

    WorkerPool() = default;
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;
    ~WorkerPool() { stop(); }

    /// Begins the threads.
    ///
    /// Errors  bad_argument for other than 1 to most_workers, or a pool that runs already; io_error as
    ///         pthread_create() says, with no thread left
    Status start(int workers, Fault& fault);
    /// Ends them.
    void stop();

    Workers workers() { return Workers(*this); }

private:
    struct Thread {
        WorkerPool* pool = nullptr;
        int worker = 0;
        pthread_t thread{};
    };

    template <class Piece>
    void run(int pieces, const Piece& piece) {
        piece_ = &piece;
        call_ = [](const void* which, int index, int worker) {
            (*static_cast<const Piece*>(which))(index, worker);
        };
        pieces_ = pieces;
        next_.store(0, std::memory_order_relaxed);
        const int helpers = std::max(std::min(count_, pieces) - 1, 0);
        // What stands here in front of a post is seen by who was waiting for it, and the other way round.
        for (int k = 0; k < helpers; ++k) static_cast<void>(::sem_post(&begin_));
        take_pieces(0);
        for (int k = 0; k < helpers; ++k) wait_for(done_);
    }
    void take_pieces(int worker) {
        for (;;) {
            const int index = next_.fetch_add(1, std::memory_order_relaxed);
            if (index >= pieces_) return;
            call_(piece_, index, worker);
        }
    }
    static void* help(void* about) {
        const Thread& self = *static_cast<const Thread*>(about);
        WorkerPool& pool = *self.pool;
        for (;;) {
            wait_for(pool.begin_);
            if (pool.ending_.load(std::memory_order_relaxed)) return nullptr;
            pool.take_pieces(self.worker);
            static_cast<void>(::sem_post(&pool.done_));
        }
    }

    int count_ = 1;
    bool running_ = false;
    const void* piece_ = nullptr;
    void (*call_)(const void* which, int index, int worker) = nullptr;
    int pieces_ = 0;
    std::atomic<int> next_{0};
    std::atomic<bool> ending_{false};
    sem_t begin_{};
    sem_t done_{};
    Thread threads_[most_workers];
};

// ---- Implementation ---------------------------------------------------------------

inline Status WorkerPool::start(int workers, Fault& fault) {
    if (running_ || workers < 1 || workers > most_workers) return Status::bad_argument;
    if (::sem_init(&begin_, 0, 0) != 0) return refused(fault, "sem_init", -errno);
    if (::sem_init(&done_, 0, 0) != 0) {
        static_cast<void>(::sem_destroy(&begin_));
        return refused(fault, "sem_init", -errno);
    }
    running_ = true;
    ending_ = false;
    for (count_ = 1; count_ < workers; ++count_) {
        Thread& fresh = threads_[count_];
        fresh.pool = this;
        fresh.worker = count_;
        if (const int error = begin_thread(fresh.thread, &help, &fresh); error != 0) {
            stop();
            return refused(fault, "pthread_create", -error);
        }
    }
    return Status::ok;
}

inline void WorkerPool::stop() {
    if (!running_) return;
    ending_ = true;
    for (int k = 1; k < count_; ++k) static_cast<void>(::sem_post(&begin_));
    for (int k = 1; k < count_; ++k) static_cast<void>(::pthread_join(threads_[k].thread, nullptr));
    static_cast<void>(::sem_destroy(&begin_));
    static_cast<void>(::sem_destroy(&done_));
    count_ = 1;
    running_ = false;
}

}  // namespace fovea::linux_port
