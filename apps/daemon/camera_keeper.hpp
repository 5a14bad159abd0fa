// SPDX-License-Identifier: MIT
//
// CameraKeeper: a camera that comes back - after a broken stream, silence, or the plug pulled - and says so
// once.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>

namespace fovea::apps {

/// What has happened to a camera, in the words of events.
enum class CameraTrouble : std::uint8_t {
    none,
    lost,       ///< the device is gone, or cannot be opened
    broken,     ///< the stream ended with an error
    silent,     ///< it streams, and no frame comes
    no_signal,  ///< the sensor has no picture
    changed,    ///< it sends another size than was set
    refused,    ///< it is there, and not as the job needs it
};

constexpr const char* word_of(CameraTrouble trouble) {
    switch (trouble) {
        case CameraTrouble::none: return "none";
        case CameraTrouble::lost: return "camera_lost";
        case CameraTrouble::broken: return "camera_broken";
        case CameraTrouble::silent: return "camera_silent";
        case CameraTrouble::no_signal: return "camera_no_signal";
        case CameraTrouble::changed: return "camera_changed";
        case CameraTrouble::refused: return "camera_refused";
    }
    return "none";
}

/// An onset, or with trouble none the end of all trouble.
struct CameraEvent {
    CameraTrouble trouble = CameraTrouble::none;
    Status status = Status::ok;
    /// Of the end: how long there was trouble.
    std::int64_t lasted_us = 0;
};

/// Which frame is wanted.
enum class FramePolicy : std::uint8_t { latest, every, after_trigger };

/// Keeps a camera streaming.
///
/// Camera is a frame source with stop(), start(), close() and interval_us(). Opening finds, opens, sets and
/// starts one: Status operator()(Camera&); not_found and device_lost of it mean that there is none, anything
/// else that it is not as it must be. Never waits: what is to be tried later is tried in a later call.
///
/// A broken stream is started again at once, and if that does not bring a frame, the camera is opened again.
/// A lost camera is looked for at once, then after 25 and 75 ms, 0.2, 0.5, 1 and every 2 s. A silent one is
/// started again after the longer of 1 s and 5 intervals, then opened again, and if that does not help every
/// 2 s: it is there, and does not come sooner for being opened more often.
template <class Camera, class Clock, class Opening>
class CameraKeeper {
public:
    using Frame = typename Camera::Frame;

    CameraKeeper(Camera& camera, Clock& clock, Opening opening)
        : camera_(camera), clock_(clock), opening_(opening) {
        next_try_us_ = clock_.microseconds();
    }

    /// Opens the camera if that is due, and takes no frame of it. True if it streams.
    bool open() {
        Frame none;
        return streaming_ || try_to_open(none);
    }

    /// A frame if there is one; timeout where none has come yet. Anything else: the camera is in trouble, or
    /// lost.
    Status fetch(FramePolicy policy, std::int64_t moment_us, Frame& frame) {
        if (!streaming_ && !try_to_open(frame)) return trouble_status_;
        const Status got = policy == FramePolicy::latest  ? camera_.latest(moment_us, 0, frame)
                           : policy == FramePolicy::every ? camera_.next(0, frame)
                                                          : camera_.after(moment_us, 0, frame);
        const std::int64_t now_us = clock_.microseconds();
        switch (got) {
            case Status::ok:
                heard_us_ = now_us;
                restarted_ = false;
                tries_ = 0;
                end_trouble(now_us);
                return got;
            case Status::timeout:
                // What was passed over is no silence: whoever asks was busy, and all that came is too old.
                if (const std::uint64_t passed = camera_.counters().passed_over; passed != passed_over_) {
                    passed_over_ = passed;
                    heard_us_ = now_us;
                }
                return now_us - heard_us_ > silence_us() ? break_silence(now_us) : got;
            case Status::no_signal:
                heard_us_ = now_us;
                begin_trouble(CameraTrouble::no_signal, got, now_us);
                return got;
            case Status::device_lost:
                begin_trouble(CameraTrouble::lost, got, now_us);
                lose(now_us);
                return got;
            default:
                begin_trouble(got == Status::size_mismatch ? CameraTrouble::changed : CameraTrouble::broken,
                              got, now_us);
                // Another size is set by opening alone.
                if (got == Status::size_mismatch || restarted_ || !restart(now_us)) lose(now_us);
                return got;
        }
    }

    /// The next event that has not been taken; false if there is none.
    bool take_event(CameraEvent& event) {
        if (!told_) return false;
        event = event_;
        told_ = false;
        return true;
    }

    /// Something was plugged in: the schedule of a lost camera begins anew.
    void hurry() {
        if (streaming_) return;
        tries_ = 0;
        schedule(clock_.microseconds());
    }

    CameraTrouble trouble() const { return trouble_; }
    /// What its trouble began with.
    Status trouble_status() const { return trouble_status_; }
    /// True while frames are expected of it.
    bool streaming() const { return streaming_; }
    /// When fetch() has something to try: not before that, unless the camera has a frame.
    std::int64_t next_try_us() const { return streaming_ ? heard_us_ + silence_us() + 1 : next_try_us_; }
    /// How often it was opened again or started again.
    std::uint64_t recoveries() const { return recoveries_; }

private:
    std::int64_t silence_us() const {
        const std::int64_t five = std::int64_t{5} * camera_.interval_us();
        return five > 1000000 ? five : 1000000;
    }

    /// The schedule of tries: microseconds until the one after so many.
    static constexpr std::int64_t delay_us(int tries) {
        constexpr std::int64_t delays[] = {0, 25000, 75000, 200000, 500000, 1000000, 2000000};
        return delays[tries < last_try ? tries : last_try];
    }
    static constexpr int last_try = 6;

    bool try_to_open(Frame& frame) {
        const std::int64_t now_us = clock_.microseconds();
        if (now_us < next_try_us_) return false;
        frame.give_back();
        camera_.close();
        const Status got = opening_(camera_);
        if (got == Status::ok) {
            streaming_ = true;
            restarted_ = true;  // what fails before a frame came is not mended by another start
            heard_us_ = clock_.microseconds();
            if (opened_before_) ++recoveries_;
            opened_before_ = true;
            return true;
        }
        camera_.close();
        const bool there = got != Status::not_found && got != Status::device_lost;
        begin_trouble(there ? CameraTrouble::refused : CameraTrouble::lost, got, now_us);
        schedule(now_us);
        return false;
    }

    void lose(std::int64_t now_us) {
        camera_.close();
        streaming_ = false;
        schedule(now_us);
    }
    void schedule(std::int64_t now_us) { next_try_us_ = now_us + delay_us(tries_++); }

    bool restart(std::int64_t now_us) {
        camera_.stop();
        if (camera_.start() != Status::ok) return false;
        restarted_ = true;
        heard_us_ = now_us;
        ++recoveries_;
        return true;
    }

    Status break_silence(std::int64_t now_us) {
        begin_trouble(CameraTrouble::silent, Status::timeout, now_us);
        if (restarted_ || !restart(now_us)) {
            if (tries_ > 0) tries_ = last_try;
            lose(now_us);
        }
        return Status::timeout;
    }

    void begin_trouble(CameraTrouble trouble, Status status, std::int64_t now_us) {
        trouble_status_ = status;
        // What follows from the trouble that was told, as a broken stream whose camera is then gone, is
        // another.
        if (trouble_ == trouble) return;
        if (trouble_ == CameraTrouble::none) since_us_ = now_us;
        trouble_ = trouble;
        event_ = {trouble, status, 0};
        told_ = true;
    }
    void end_trouble(std::int64_t now_us) {
        if (trouble_ == CameraTrouble::none) return;
        trouble_ = CameraTrouble::none;
        trouble_status_ = Status::timeout;
        event_ = {CameraTrouble::none, Status::ok, now_us - since_us_};
        told_ = true;
    }

    Camera& camera_;
    Clock& clock_;
    Opening opening_;
    bool streaming_ = false;
    bool restarted_ = false;
    bool opened_before_ = false;
    bool told_ = false;
    int tries_ = 0;
    std::int64_t next_try_us_ = 0;
    std::int64_t heard_us_ = 0;
    std::int64_t since_us_ = 0;
    std::uint64_t recoveries_ = 0;
    std::uint64_t passed_over_ = 0;
    CameraTrouble trouble_ = CameraTrouble::none;
    Status trouble_status_ = Status::timeout;
    CameraEvent event_;
};

}  // namespace fovea::apps
