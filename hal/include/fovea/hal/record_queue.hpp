// SPDX-License-Identifier: MIT
//
// RecordQueue: whole records into a stream that may have no room - the newest stay, and none arrives torn.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/byte_stream.hpp>

namespace fovea::hal {

/// Records wait in a ring of the caller's memory, which outlives the queue. Each takes its bytes and
/// record_overhead more.
class RecordQueue {
public:
    static constexpr std::ptrdiff_t record_overhead = 4;

    explicit RecordQueue(Span<std::uint8_t> memory) : memory_(memory) {}

    /// Takes a record behind all others, and never waits. Where there is no room, the oldest that have not
    /// begun are dropped for it.
    ///
    /// Errors  bad_argument for a record without bytes; buffer_too_small for one that can never fit, and
    ///         capacity_exceeded for one that cannot beside the one that has begun: it is dropped, nothing
    ///         else
    Status send(Span<const std::uint8_t> record) {
        if (record.empty()) return Status::bad_argument;
        const Status room = make_room(record.size());
        if (room != Status::ok) {
            ++dropped_;
            return room;
        }
        const std::uint32_t size = static_cast<std::uint32_t>(record.size());
        for (int i = 0; i < record_overhead; ++i) push(static_cast<std::uint8_t>(size >> (8 * i)));
        for (const std::uint8_t byte : record) push(byte);
        ++waiting_;
        return Status::ok;
    }

    /// Moves on as far as the stream takes bytes. A record that has begun is finished before any other.
    ///
    /// Errors  those of the stream. With device_lost, the record that has begun is dropped
    template <class Stream>
    Status pump(Stream& stream) {
        static_assert(is_byte_stream_v<Stream>, "records go into a stream of bytes: hal/byte_stream.hpp");
        while (waiting_ > 0) {
            const std::ptrdiff_t from = begun_ > 0 ? 0 : record_overhead;
            const std::ptrdiff_t left = begun_ > 0 ? begun_ : size_at(0);
            const std::ptrdiff_t start = place(from);
            const std::ptrdiff_t up_to_end = memory_.size() - start;
            const Result<int> took =
                stream.write(memory_.from(start).first(left < up_to_end ? left : up_to_end));
            if (!took) {
                if (took.status() == Status::device_lost) drop_begun();
                return took.status();
            }
            if (*took == 0) return Status::ok;
            take(from + *took);
            begun_ = left - *took;
            if (begun_ == 0) --waiting_;
        }
        return Status::ok;
    }

    /// Drops the record that has begun, if one has. Before the first pump() into a stream that was opened
    /// anew: its other end has not seen the beginning.
    void drop_begun() {
        if (begun_ == 0) return;
        take(begun_);
        begun_ = 0;
        --waiting_;
        ++dropped_;
    }

    /// How many records have not been sent to their end.
    int waiting() const { return waiting_; }
    /// How many were dropped so far.
    std::uint32_t dropped() const { return dropped_; }
    /// True while the stream has a part of a record.
    bool begun() const { return begun_ > 0; }

private:
    std::ptrdiff_t place(std::ptrdiff_t from_head) const {
        const std::ptrdiff_t up_to_end = memory_.size() - head_;
        return from_head < up_to_end ? head_ + from_head : from_head - up_to_end;
    }
    std::ptrdiff_t size_at(std::ptrdiff_t from_head) const {
        std::uint32_t size = 0;
        for (int i = 0; i < record_overhead; ++i)
            size |= std::uint32_t{memory_[place(from_head + i)]} << (8 * i);
        return static_cast<std::ptrdiff_t>(size);
    }
    void push(std::uint8_t byte) { memory_[place(used_++)] = byte; }
    void take(std::ptrdiff_t count) {
        head_ = place(count);
        used_ -= count;
        if (used_ == 0) head_ = 0;
    }

    Status make_room(std::ptrdiff_t bytes) {
        // Both sides without a sum, which could overflow.
        if (bytes > memory_.size() - record_overhead) return Status::buffer_too_small;
        if (bytes > memory_.size() - record_overhead - begun_) return Status::capacity_exceeded;
        while (bytes > memory_.size() - record_overhead - used_) drop_oldest();
        return Status::ok;
    }
    /// Drops the oldest record that has not begun. What is left of the one that has, in front of it, moves
    /// over its place.
    void drop_oldest() {
        const std::ptrdiff_t gone = record_overhead + size_at(begun_);
        for (std::ptrdiff_t i = begun_ - 1; i >= 0; --i) memory_[place(gone + i)] = memory_[place(i)];
        take(gone);
        --waiting_;
        ++dropped_;
    }

    Span<std::uint8_t> memory_;
    std::ptrdiff_t head_ = 0;
    std::ptrdiff_t used_ = 0;
    /// Bytes at the head that are the rest of a record, without its size; 0 where none has begun.
    std::ptrdiff_t begun_ = 0;
    int waiting_ = 0;
    std::uint32_t dropped_ = 0;
};

}  // namespace fovea::hal
