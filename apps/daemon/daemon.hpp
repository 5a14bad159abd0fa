// SPDX-License-Identifier: MIT
//
// Daemon: from triggers and frames to verdicts on lines, on a serial line and as JSON. One loop, which never
// waits.
//
//     no camera or no job --both there--> ready --trigger--> busy --answer--> ready
//
// In free run every frame is its own trigger. Otherwise a trigger is an edge on a line or the command TRG;
// its frame is the first that was wholly taken after it. Every trigger gets exactly one answer: OK, NG, ERROR
// or MISSED.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/number/integer.hpp>

#include <daemon/camera_keeper.hpp>
#include <daemon/command.hpp>
#include <daemon/daemon_events.hpp>
#include <daemon/daemon_options.hpp>
#include <daemon/daemon_replies.hpp>
#include <daemon/failure_ring.hpp>
#include <daemon/image_quality.hpp>
#include <daemon/inspection.hpp>
#include <daemon/jobs.hpp>
#include <daemon/judge.hpp>
#include <daemon/tally.hpp>
#include <daemon/teaching.hpp>
#include <daemon/text_buffer.hpp>
#include <daemon/verdict_lines.hpp>
#include <daemon/world.hpp>

namespace fovea::apps {

/// World is what world.hpp says.
template <class World>
class Daemon {
public:
    Daemon(World& world, const DaemonOptions& options) : world_(world), options_(options) {}

    /// Takes a job by its number; false if it does not fit the memory.
    bool take_job(int number);
    int job() const { return job_; }

    /// Between two turns: other options, and jobs that the world has changed already; the result before is
    /// forgotten, for it was by those that are gone. A trigger that waits goes on waiting.
    void take_options(const DaemonOptions& options) {
        options_ = options;
        has_last_ = false;
    }
    /// Goes on counting where another ended, whose last trigger had that number.
    void go_on_from(const Tally& tally, std::uint64_t number) {
        tally_ = tally;
        numbers_ = number;
    }
    /// Of the last trigger; the statistics may have begun anew since the first.
    std::uint64_t last_number() const { return numbers_; }

    /// One turn of the loop. The moment of the next at the latest; earlier when the camera, the serial line
    /// or the trigger's line has something.
    std::int64_t turn();

    /// Ends: a trigger that waits is answered, and all lines are inactive.
    void stop();

    const Tally& tally() const { return tally_; }
    bool ready() const {
        return job_ != 0 && world_.trigger_status() == Status::ok && world_.camera().streaming() &&
               world_.camera().trouble() == CameraTrouble::none;
    }
    bool busy() const { return waiting_; }
    std::uint64_t damaged_pictures() const { return damaged_pictures_; }

private:
    using Frame = typename std::remove_reference_t<decltype(std::declval<World&>().camera())>::Frame;

    void take_commands();
    void obey(const SerialCommand& command);
    CommandError change_job(const SerialCommand& command, TextBuffer& text);
    CommandError begin_teach(const SerialCommand& command);
    /// TEACH says which codes the job allows.
    bool takes_codes() const {
        return job_ != 0 && world_.jobs()[job_].reads && world_.jobs()[job_].codes.taught;
    }
    void reply(const TextBuffer& text);
    void take_edges();
    void begin_trigger(std::int64_t time_us);
    void count_missed(std::int64_t time_us);
    void take_frame();
    void judge_frame(const hal::FrameInfo& info);
    void answer_error(const char* reason);
    void answer(const ImageView<const Gray8>* picture);

    World& world_;
    DaemonOptions options_;
    DaemonEvents<World> events_{world_};
    Judge judge_;
    Tally tally_;
    Inspection inspection_;
    int job_ = 0;
    /// A trigger waits for its frame since then.
    bool waiting_ = false;
    std::int64_t trigger_us_ = 0;
    std::uint64_t numbers_ = 0;
    std::uint64_t damaged_pictures_ = 0;
    std::int64_t busy_until_us_ = 0;
    bool has_last_ = false;
    Teaching<World> teaching_{world_};
    char line_room_[16384];
    /// For a result, and what LAST? has around it.
    char reply_room_[16384 + 64];
    Frame frame_;
};

// ---- Implementation ---------------------------------------------------------------

template <class World>
bool Daemon<World>::take_job(int number) {
    if (number < 1 || number > world_.jobs().size()) return false;
    teaching_.give_up("another_job", Status::not_found, events_);
    job_ = number;
    judge_.forget();
    return true;
}

template <class World>
void Daemon<World>::reply(const TextBuffer& text) {
    TextBuffer line = text;
    line.text("\r\n");
    if (!line.full()) static_cast<void>(world_.link().send(line.bytes()));
}

template <class World>
void Daemon<World>::take_commands() {
    // A flood of lines takes no more of a turn than so many replies.
    for (int most = 16; most > 0; --most) {
        const Result<Span<const char>> line = world_.link().next_line();
        if (line && line->empty()) return;
        if (!options_.commands) continue;
        if (!line) {
            TextBuffer text{Span<char>(reply_room_)};
            reply_error({}, CommandError::malformed, text);
            reply(text);
            continue;
        }
        obey(read_command(*line));
    }
}

template <class World>
void Daemon<World>::obey(const SerialCommand& command) {
    TextBuffer text{Span<char>(reply_room_)};
    reply_ok(command, text);
    CommandError error = command.error;
    if (error == CommandError::none) switch (command.verb) {
            case CommandVerb::none: return;
            case CommandVerb::trigger:
                if (!waiting_) {
                    // In front of the result.
                    if (!options_.silent) reply(text);
                    return begin_trigger(world_.now_us());
                }
                count_missed(world_.now_us());
                error = CommandError::busy;
                break;
            case CommandVerb::list_jobs: add_jobs(world_.jobs(), text); break;
            case CommandVerb::ask_job: add_job(world_.jobs(), job_, text); break;
            case CommandVerb::take_job: error = change_job(command, text); break;
            case CommandVerb::ask_tally: add_tally(tally_, text); break;
            case CommandVerb::reset_tally: tally_ = {}; break;
            case CommandVerb::ask_last:
                if (has_last_)
                    write_json(inspection_, text.put(' '));
                else
                    error = CommandError::nothing_yet;
                break;
            case CommandVerb::ask_ready: text.text(ready() && !waiting_ ? " 1" : " 0"); break;
            case CommandVerb::teach: error = begin_teach(command); break;
            case CommandVerb::ask_version: text.text(" fovead ").text(options_.version); break;
        }
    if (error != CommandError::none) {
        text.clear();
        reply_error(command, error, text);
    }
    if (!options_.silent || asks(command.verb) || error != CommandError::none) reply(text);
}

template <class World>
CommandError Daemon<World>::change_job(const SerialCommand& command, TextBuffer& text) {
    const int number = world_.jobs().find(command.name, command.number);
    if (number == 0) return CommandError::no_such_job;
    if (!take_job(number)) return CommandError::job_refused;
    add_job(world_.jobs(), job_, text);
    events_.tell_job(letters_of(world_.jobs()[job_].name.c_str()));
    return CommandError::none;
}

template <class World>
CommandError Daemon<World>::begin_teach(const SerialCommand& command) {
    if (!options_.samples && !takes_codes()) return CommandError::keeps_none;
    if (!ready()) return CommandError::not_ready;
    teaching_.give_up("another_teach", Status::not_found, events_);
    teaching_.begin(command.name, options_.samples, takes_codes());
    // At once, so that no verdict is by codes that are to be replaced, whatever becomes of the next frame.
    judge_.forget_taught();
    return CommandError::none;
}

template <class World>
void Daemon<World>::take_edges() {
    TriggerEdge edge;
    while (world_.next_edge(edge)) {
        for (std::uint32_t k = 0; k < edge.lost; ++k) count_missed(edge.time_us);
        if (options_.source != TriggerSource::line) continue;
        if (waiting_ || edge.time_us < busy_until_us_)
            count_missed(edge.time_us);
        else
            begin_trigger(edge.time_us);
    }
}

template <class World>
void Daemon<World>::begin_trigger(std::int64_t time_us) {
    inspection_.number = ++numbers_;
    trigger_us_ = time_us;
    waiting_ = true;
    world_.lines().begin();
    if (!ready()) answer_error(job_ == 0 ? "no_job" : "no_camera");
}

template <class World>
void Daemon<World>::count_missed(std::int64_t time_us) {
    ++numbers_;
    tally_.count(Answer::missed);
    events_.tell_missed(numbers_, time_us);
}

template <class World>
void Daemon<World>::take_frame() {
    const bool free = options_.source == TriggerSource::free;
    const bool teaching = teaching_.pending();
    const bool wanted = free || waiting_ || teaching;
    const std::int64_t oldest_us = world_.frame_interval_us() * 3 / 2;
    // A frame that nobody waits for goes back at once: so the camera is heard, and what comes is fresh.
    const FramePolicy policy = waiting_ || teaching            ? FramePolicy::after_trigger
                               : free && !options_.every_frame ? FramePolicy::latest
                                                               : FramePolicy::every;
    const std::int64_t asked_us = maximum(waiting_ ? trigger_us_ : 0, teaching ? teaching_.since_us() : 0);
    const Status got = world_.camera().fetch(policy, waiting_ || teaching ? asked_us : oldest_us, frame_);
    events_.tell_camera();
    if (got == Status::ok && wanted && job_ != 0) {
        judge_frame(frame_.info());
    } else if (waiting_ && world_.camera().trouble() != CameraTrouble::none) {
        answer_error("no_camera");
    }
    frame_.give_back();
    if (world_.camera().trouble() != CameraTrouble::none)
        teaching_.give_up("no_camera", Status::device_lost, events_);
    else if (world_.now_us() - teaching_.since_us() > options_.timeout_us)
        teaching_.give_up("no_frame", Status::timeout, events_);
    if (waiting_ && world_.now_us() - trigger_us_ > options_.timeout_us) answer_error("no_frame");
}

template <class World>
void Daemon<World>::judge_frame(const hal::FrameInfo& info) {
    ImageView<const Gray8> picture;
    if (world_.gray(info, picture) != Status::ok) {
        // What could not be decoded is no frame: the trigger waits for the next.
        ++damaged_pictures_;
        return;
    }
    if (teaching_.pending()) {
        teaching_.take(picture, world_.jobs()[job_], judge_, events_);
        if (options_.source != TriggerSource::free && !waiting_) return;
    }
    if (!waiting_) {
        inspection_.number = ++numbers_;
        trigger_us_ = info.time_us;
        world_.lines().begin();
    }
    const std::int64_t begin_us = world_.now_us();
    inspection_.clear();
    inspection_.has_frame = true;
    inspection_.frame = info.sequence;
    inspection_.age_us = begin_us - info.time_us;
    const ImageVerdict quality = world_.quality(picture);
    if (quality != ImageVerdict::fine) {
        inspection_.answer = Answer::error;
        inspection_.reason = word_of(quality);
    } else {
        judge_.judge(picture, world_.jobs()[job_], world_.scratch(), world_.workers(), inspection_);
    }
    inspection_.judged_us = world_.now_us() - begin_us;
    answer(&picture);
    events_.tell_quality(quality);
}

template <class World>
void Daemon<World>::answer_error(const char* reason) {
    inspection_.clear();
    inspection_.answer = Answer::error;
    inspection_.reason = reason;
    answer(nullptr);
}

template <class World>
void Daemon<World>::answer(const ImageView<const Gray8>* picture) {
    const std::int64_t now_us = world_.now_us();
    // The lines first: a machine waits for them.
    world_.lines().show(inspection_.answer, now_us);
    waiting_ = false;
    busy_until_us_ = now_us;
    inspection_.time_us = now_us;
    inspection_.took_us = now_us - trigger_us_;
    inspection_.missed_frames = world_.missed_frames();
    inspection_.job_number = job_;
    inspection_.job = job_ == 0 ? Span<const char>() : letters_of(world_.jobs()[job_].name.c_str());
    inspection_.job_crc = job_ == 0 ? 0 : world_.jobs()[job_].crc;
    inspection_.reads_codes = job_ != 0 && world_.jobs()[job_].reads;
    has_last_ = true;
    tally_.count(inspection_.answer);
    if (inspection_.answer == Answer::ok || inspection_.answer == Answer::not_ok)
        tally_.took(inspection_.took_us);

    TextBuffer line{Span<char>(line_room_)};
    if (options_.serial_results) {
        if (options_.serial_json)
            write_json(inspection_, line), line.text("\r\n");
        else
            options_.serial_template.write(inspection_, tally_, line);
        if (!line.full() && line.size() > 0) static_cast<void>(world_.link().send(line.bytes()));
    }
    if (options_.json) {
        line.clear();
        write_json(inspection_, line);
        if (!line.full()) world_.print(line.letters());
    }
    if (inspection_.answer != Answer::ok && picture != nullptr) world_.keep_failure(*picture, inspection_);
}

template <class World>
std::int64_t Daemon<World>::turn() {
    const std::int64_t now_us = world_.now_us();
    world_.link().turn(now_us);
    events_.tell_link();
    take_commands();
    take_edges();
    take_frame();
    auto& lines = world_.lines();
    lines.set_ready(ready() && !waiting_);
    lines.set_alarm(job_ == 0 || world_.trigger_status() != Status::ok ||
                    world_.camera().trouble() != CameraTrouble::none || events_.quality_bad());
    std::int64_t next_us = world_.camera().next_try_us();
    const auto sooner = [&](std::int64_t at_us) { next_us = at_us < next_us ? at_us : next_us; };
    if (const std::int64_t pulse_us = lines.turn(now_us); pulse_us >= 0) sooner(pulse_us);
    events_.tell_lines(lines.take_fault(), lines.lost());
    events_.tell_trigger(world_.trigger_status());
    FailureRingEvent failure;
    while (world_.take_failure_event(failure)) events_.tell_failures(failure);
    if (waiting_) sooner(trigger_us_ + options_.timeout_us + 1);
    if (world_.link().wired() && !world_.link().open()) sooner(world_.link().next_try_us());
    // Replies leave in the turn in which they were made.
    world_.link().turn(now_us);
    return next_us;
}

template <class World>
void Daemon<World>::stop() {
    if (waiting_) answer_error("stopped");
    frame_.give_back();
    world_.lines().make_safe();
    world_.link().turn(world_.now_us());
}

}  // namespace fovea::apps
