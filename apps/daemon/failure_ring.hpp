// SPDX-License-Identifier: MIT
//
// FailureRing: keeps the pictures of failures in a folder, without ever holding up a verdict.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/pnm.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/linux/background_writer.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/ring_folder.hpp>

namespace fovea::apps {

/// Pictures cannot be kept, or with status ok: they can again.
struct FailureRingEvent {
    Status status = Status::ok;
    linux_port::Fault fault;
};

/// Stores pairs in a ring and tells of a fault once: when it begins, when it becomes another, and when the
/// next pair could be stored. Any one thread stores, any one takes the events.
template <class System = linux_port::Kernel>
class RingKeeper {
public:
    explicit RingKeeper(System system = {}) : ring_(system) {}

    Status open(const char* folder, const linux_port::RingLimits& limits) {
        return ring_.open(folder, limits);
    }

    void operator()(const linux_port::WritingJob& job) {
        const Status status = ring_.store(job.first, job.second);
        ++(status == Status::ok ? stored_ : failed_);
        const linux_port::Fault fault = status == Status::ok ? linux_port::Fault{} : ring_.fault();
        // Which call is refused first may differ from pair to pair; a full disk is one fault all the same.
        if (status == told_.status && fault.error == told_.fault.error) return;
        // Where nobody takes the events, this one is told with the next pair, if it is still so.
        const int place = turns_.free_place();
        if (place < 0) return;
        events_[place] = told_ = {status, fault};
        turns_.filled();
    }

    /// The next event that has not been taken; false if there is none.
    bool take_event(FailureRingEvent& event) {
        const int place = turns_.full_place();
        if (place < 0) return false;
        event = events_[place];
        turns_.emptied();
        return true;
    }

    /// Pairs that were stored, and that could not be.
    std::uint64_t stored() const { return stored_.load(std::memory_order_relaxed); }
    std::uint64_t failed() const { return failed_.load(std::memory_order_relaxed); }

private:
    static constexpr int most_events = 4;

    linux_port::RingFolder<System> ring_;
    FailureRingEvent told_;
    FailureRingEvent events_[most_events];
    linux_port::Turns turns_{most_events};
    std::atomic<std::uint64_t> stored_{0};
    std::atomic<std::uint64_t> failed_{0};
};

/// The ring behind a thread. offer() copies a picture to a place that was given at the start, and never
/// waits; the folder is made, looked through and written by the thread alone.
template <class System = linux_port::Kernel>
class FailureRing {
public:
    /// The longest text beside a picture: that of a result.
    static constexpr int most_text = 16384;

    explicit FailureRing(System system = {}) : keeper_(system), writer_(keeper_, system) {}

    /// Bytes of memory for pictures up to a size, of which so many may wait.
    static constexpr std::int64_t memory_bytes(int places, Size largest) {
        return linux_port::BackgroundWriter<RingKeeper<System>, System>::memory_bytes(
            places, encoded_pnm_bytes<Gray8>(largest), most_text);
    }

    /// Begins. What is wrong with the folder is told by an event, when there is something to store.
    ///
    /// Errors  as RingFolder::open() and BackgroundWriter::start() say
    Status start(const char* folder, const linux_port::RingLimits& limits, int places, Size largest,
                 Span<std::uint8_t> memory) {
        if (const Status s = keeper_.open(folder, limits); s != Status::ok) return s;
        return writer_.start(places, encoded_pnm_bytes<Gray8>(largest), most_text, memory, fault_);
    }

    /// Takes a picture and the text beside it, one JSON object.
    ///
    /// Errors  capacity_exceeded if as many pictures wait as may, which is counted as dropped; as
    ///         encode_pnm() says for what does not fit a place, and buffer_too_small for a longer text
    Status offer(ImageView<const Gray8> picture, Span<const char> text) {
        if (text.size() > most_text) return Status::buffer_too_small;
        linux_port::WritingJob job;
        if (!writer_.offer(job)) return Status::capacity_exceeded;
        const Result<std::ptrdiff_t> length = encode_pnm(picture, job.first);
        if (!length) return length.status();
        if (!text.empty()) std::memcpy(job.second.data(), text.data(), static_cast<std::size_t>(text.size()));
        writer_.hand_over(*length, text.size());
        return Status::ok;
    }

    bool take_event(FailureRingEvent& event) { return keeper_.take_event(event); }
    std::uint64_t stored() const { return keeper_.stored(); }
    std::uint64_t failed() const { return keeper_.failed(); }
    std::uint64_t dropped() const { return writer_.dropped(); }
    /// Of start().
    const linux_port::Fault& fault() const { return fault_; }
    /// As BackgroundWriter::stop().
    Status stop(std::int64_t patience_us) { return writer_.stop(patience_us); }

private:
    linux_port::Fault fault_;
    RingKeeper<System> keeper_;
    linux_port::BackgroundWriter<RingKeeper<System>, System> writer_;
};

}  // namespace fovea::apps
