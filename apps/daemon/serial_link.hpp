// SPDX-License-Identifier: MIT
//
// SerialLink: a serial line that comes back when its plug was pulled, with whole records out and whole lines
// in.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/line_reader.hpp>
#include <fovea/hal/record_queue.hpp>

namespace fovea::apps {

/// Port is a byte stream with close(); Opening opens it: Status operator()(Port&). Never waits. A port that
/// is lost is opened again every second; what is sent meanwhile waits, the newest as far as there is room.
template <class Port, class Opening>
class SerialLink {
public:
    /// Without a port to open it does nothing, and nothing is wrong.
    SerialLink(Port& port, Opening opening, Span<std::uint8_t> memory, bool wired = true)
        : port_(port), opening_(opening), queue_(memory), wired_(wired) {}

    /// Opens what is not open, takes what has arrived and sends what waits.
    void turn(std::int64_t now_us) {
        if (!wired_) return;
        if (!open_) {
            if (now_us < next_try_us_) return;
            const Status got = opening_(port_);
            if (got != Status::ok) return lose(got, now_us);
            open_ = true;
            // The other end has seen neither the beginning of a record nor the end of a line.
            queue_.drop_begun();
            reader_.drop();
            if (trouble_ != Status::ok) {
                trouble_ = Status::ok;
                told_ = true;
            }
        }
        Status got = reader_.fill(port_);
        if (got == Status::ok) got = queue_.pump(port_);
        if (got != Status::ok) lose(got, now_us);
    }

    /// Something was plugged in: a port that is lost is looked for at once.
    void hurry() {
        if (!open_) next_try_us_ = 0;
    }

    /// The next line that came; empty if none is complete. malformed and capacity_exceeded for what was no
    /// line.
    Result<Span<const char>> next_line() { return reader_.next(); }

    /// Takes a record; it leaves with the next turns.
    Status send(Span<const std::uint8_t> record) { return queue_.send(record); }

    /// Whether something has changed since the last call: trouble() is the reason then, ok for the end of it.
    bool take_event() {
        const bool told = told_;
        told_ = false;
        return told;
    }
    Status trouble() const { return trouble_; }
    bool open() const { return open_; }
    bool wired() const { return wired_; }
    /// True while records wait for room.
    bool waiting() const { return queue_.waiting() > 0; }
    std::uint32_t dropped() const { return queue_.dropped(); }
    /// When turn() has something to try; only of a port that is not open.
    std::int64_t next_try_us() const { return next_try_us_; }

private:
    void lose(Status reason, std::int64_t now_us) {
        port_.close();
        open_ = false;
        next_try_us_ = now_us + 1000000;
        // A port that was lost is not there when it is looked for: that is the same trouble.
        told_ = told_ || !(trouble_ == reason || (gone(trouble_) && gone(reason)));
        trouble_ = reason;
    }
    static bool gone(Status reason) { return reason == Status::device_lost || reason == Status::not_found; }

    Port& port_;
    Opening opening_;
    hal::RecordQueue queue_;
    hal::LineReader<256, 512> reader_;
    bool wired_;
    bool open_ = false;
    bool told_ = false;
    Status trouble_ = Status::ok;
    std::int64_t next_try_us_ = 0;
};

}  // namespace fovea::apps
