// SPDX-License-Identifier: MIT
//
// BackgroundWriter: a thread that does what may take long - writing to a disk - for one that must not wait.
#pragma once

#include <pthread.h>
#include <semaphore.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/thread.hpp>

namespace fovea::linux_port {

/// Whose turn the places of a ring are: of the one thread that fills them or of the one that empties them.
/// Neither waits for the other.
class Turns {
public:
    explicit Turns(int places = 0) : places_(places) {}
    void restart(int places) {
        places_ = places;
        filled_.store(0, std::memory_order_relaxed);
        emptied_.store(0, std::memory_order_relaxed);
    }
    /// For who fills: a place, or -1 while all are full; then filled().
    int free_place() const {
        const std::uint32_t next = filled_.load(std::memory_order_relaxed);
        const std::uint32_t waiting = next - emptied_.load(std::memory_order_acquire);
        return waiting >= static_cast<std::uint32_t>(places_) ? -1 : place(next);
    }
    void filled() { filled_.store(filled_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }
    /// For who empties: the place that was filled first, or -1 while all are empty; then emptied().
    int full_place() const {
        const std::uint32_t next = emptied_.load(std::memory_order_relaxed);
        return next == filled_.load(std::memory_order_acquire) ? -1 : place(next);
    }
    void emptied() {
        emptied_.store(emptied_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    }

private:
    int place(std::uint32_t number) const {
        return static_cast<int>(number % static_cast<std::uint32_t>(places_));
    }

    int places_;
    // They run over from 2^32 - 1 to 0, which places_ has to divide: see BackgroundWriter::start().
    std::atomic<std::uint32_t> filled_{0};
    std::atomic<std::uint32_t> emptied_{0};
};

/// Two runs of bytes that belong together, as a picture and what is told of it.
struct WritingJob {
    Span<std::uint8_t> first;
    Span<std::uint8_t> second;
};

/// Hands jobs to a thread of its own, in their order, through places that are given at the start. offer()
/// never waits, however long a job takes: where no place is free, the job is dropped and counted.
///
/// Work is called by that thread: void operator()(WritingJob). No signal is delivered to it.
template <class Work, class System = Kernel>
class BackgroundWriter {
public:
    static constexpr int most_places = 16;

    explicit BackgroundWriter(Work& work, System system = {}) : work_(work), system_(system) {}
    BackgroundWriter(const BackgroundWriter&) = delete;
    BackgroundWriter& operator=(const BackgroundWriter&) = delete;
    /// Waits for the thread without end: its memory dies here.
    ~BackgroundWriter() {
        if (!running_) return;
        finish();
        static_cast<void>(::pthread_join(thread_, nullptr));
        static_cast<void>(::sem_destroy(&something_));
    }

    /// Bytes of memory for so many places.
    static constexpr std::int64_t memory_bytes(int places, std::int64_t first_bytes,
                                               std::int64_t second_bytes) {
        return places * (first_bytes + second_bytes);
    }

    /// Begins the thread.
    ///
    /// Errors  bad_argument for other than 1, 2, 4, 8 or 16 places, or a thread that runs already;
    ///         scratch_too_small; io_error as pthread_create() says
    Status start(int places, std::int64_t first_bytes, std::int64_t second_bytes, Span<std::uint8_t> memory,
                 Fault& fault);

    /// Where the next job is to be written; false if it has to be dropped, which is counted.
    bool offer(WritingJob& job) {
        const int place = running_ && !finishing_.load(std::memory_order_relaxed) ? turns_.free_place() : -1;
        if (place < 0) {
            ++dropped_;
            return false;
        }
        job = {rooms_[place].first, rooms_[place].second};
        return true;
    }
    /// Hands it over, with as many bytes as are used.
    void hand_over(std::ptrdiff_t first_bytes, std::ptrdiff_t second_bytes) {
        const int place = turns_.free_place();
        FOVEA_ASSERT(place >= 0);
        jobs_[place] = {rooms_[place].first.first(first_bytes), rooms_[place].second.first(second_bytes)};
        turns_.filled();
        static_cast<void>(::sem_post(&something_));
    }

    /// Ends the thread when it has done what it was given, or the job that it is at when the patience is
    /// over.
    ///
    /// Errors  timeout if it is still at that job 200 ms later. The thread is in the hands of the kernel
    ///         then: a program that must not wait for it ends by _exit()
    Status stop(std::int64_t patience_us);

    bool running() const { return running_; }
    /// Jobs for which there was no place.
    std::uint64_t dropped() const { return dropped_; }

private:
    static void* run(void* self) {
        static_cast<BackgroundWriter*>(self)->work();
        return nullptr;
    }
    void work() {
        for (;;) {
            wait_for(something_);
            if (abandoned_.load(std::memory_order_acquire)) break;
            const int place = turns_.full_place();
            // finish() posts once more than there are jobs.
            if (place < 0) break;
            work_(jobs_[place]);
            turns_.emptied();
        }
        done_.store(true, std::memory_order_release);
    }
    void finish() {
        if (!finishing_.exchange(true, std::memory_order_relaxed)) static_cast<void>(::sem_post(&something_));
    }
    /// True when the thread has ended within the patience.
    bool ended(std::int64_t patience_us) {
        const std::int64_t until_us = system_.monotonic_us() + patience_us;
        while (!done_.load(std::memory_order_acquire)) {
            if (system_.monotonic_us() >= until_us) return false;
            static_cast<void>(system_.poll({}, 1000));
        }
        return true;
    }

    Work& work_;
    System system_;
    Turns turns_;
    WritingJob rooms_[most_places];
    WritingJob jobs_[most_places];
    std::uint64_t dropped_ = 0;
    bool running_ = false;
    std::atomic<bool> finishing_{false};
    std::atomic<bool> abandoned_{false};
    std::atomic<bool> done_{false};
    sem_t something_{};
    pthread_t thread_{};
};

// ---- Implementation ---------------------------------------------------------------

template <class Work, class System>
Status BackgroundWriter<Work, System>::start(int places, std::int64_t first_bytes, std::int64_t second_bytes,
                                             Span<std::uint8_t> memory, Fault& fault) {
    if (running_ || places < 1 || places > most_places || (places & (places - 1)) != 0 || first_bytes < 0 ||
        second_bytes < 0)
        return Status::bad_argument;
    if (memory.size() < memory_bytes(places, first_bytes, second_bytes)) return Status::scratch_too_small;
    for (int k = 0; k < places; ++k) {
        rooms_[k].first = memory.first(first_bytes);
        memory = memory.from(first_bytes);
        rooms_[k].second = memory.first(second_bytes);
        memory = memory.from(second_bytes);
    }
    turns_.restart(places);
    finishing_ = abandoned_ = done_ = false;
    if (::sem_init(&something_, 0, 0) != 0) return refused(fault, "sem_init", -errno);
    const int error = begin_thread(thread_, &run, this);
    if (error != 0) {
        static_cast<void>(::sem_destroy(&something_));
        return refused(fault, "pthread_create", -error);
    }
    running_ = true;
    return Status::ok;
}

template <class Work, class System>
Status BackgroundWriter<Work, System>::stop(std::int64_t patience_us) {
    if (!running_) return Status::ok;
    finish();
    if (!ended(patience_us)) {
        abandoned_.store(true, std::memory_order_release);
        if (!ended(200000)) return Status::timeout;
    }
    static_cast<void>(::pthread_join(thread_, nullptr));
    static_cast<void>(::sem_destroy(&something_));
    running_ = false;
    return Status::ok;
}

}  // namespace fovea::linux_port
