// SPDX-License-Identifier: MIT
//
// A board that judges frames: a trigger, a frame line by line over the serial line, a verdict on two pins and
// a line of JSON. Everything but the verdict of the last good frame leaves both pins inactive.
//
//   idle --trigger--> armed --frame--> receiving --last line--> judged, idle
//     any --error, patience over--> idle
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/packet.hpp>
#include <fovea/decision/tolerance.hpp>
#include <fovea/image/geometry.hpp>

#include <common/verdicts.hpp>
#include <firmware/json_line.hpp>

namespace fovea::apps {

/// What packets begin with. Numbers have two bytes, the low one first.
enum class PacketKind : std::uint8_t {
    trigger = 'T',  ///< nothing more: as an edge on the trigger's pin
    frame = 'F',    ///< width, height: the lines of a frame follow
    line = 'L',     ///< number of the line, its pixels
    recipe = 'R',   ///< what encode_recipe() wrote; until the next reset
    state = '?',    ///< nothing more: the board says what it is
};

/// Bytes of the longest packet of a line: its kind, its number, its pixels and its checksum.
constexpr std::ptrdiff_t line_packet_bytes(std::ptrdiff_t pixels) { return 3 + pixels + 4; }

/// What the firmware is connected to.
template <class TheSerial, class TheTrigger, class TheOutput, class TheClock, class TheWatchdog>
struct FirmwarePorts {
    using Serial = TheSerial;
    using Clock = TheClock;
    using Watchdog = TheWatchdog;

    TheSerial& serial;
    TheTrigger& trigger;
    TheOutput& ok;
    TheOutput& not_ok;
    TheClock& clock;
    TheWatchdog& watchdog;
};

/// A job is what is done with frames:
///   Span<std::uint8_t> packet_room()   where packets arrive; asked anew when a frame has begun
///   bool takes_recipes                 static: packets of kind 'R' come to load()
///   const char* load(bytes)            nullptr, or why the bytes are refused and all is as it was
///   const char* missing()              nullptr, or what it lacks before it can judge
///   const char* begin(Size)            nullptr, or why it takes no such frame
///   void take_line(int y, pixels)      the next line, as wide as the frame
///   const char* judge(Verdict&)        after the last line: nullptr, or why there is no verdict
///   void tell_judged(Line&), tell_state(Line&)   members of the object of JSON, ",name:value" each
template <class Ports, class Job>
class FrameFirmware {
public:
    /// How long a frame may take to begin after its trigger, each line to come, and a packet to end.
    static constexpr std::int64_t patience = 2000000;  ///< microseconds

    FrameFirmware(const Ports& ports, Job& job, const char* board)
        : ports_(ports),
          job_(job),
          board_(board),
          reader_(job.packet_room()),
          line_(ports.serial, ports.clock, ports.watchdog) {}

    /// The first words.
    void start() {
        set_outputs(Verdict::unmeasured);
        heard_ = ports_.clock.microseconds();
        tell_state();
    }
    /// The same, with what lies in flash for the job: a file without bytes is refused, and not as if there
    /// were none.
    void start(Span<const std::uint8_t> in_flash) {
        load(in_flash);
        start();
    }

    /// One turn of the loop. Never waits but for its own line.
    void turn() {
        ports_.watchdog.feed();
        take_edge();
        std::uint8_t bytes[16];
        const Result<int> count = ports_.serial.read(bytes);
        if (count)
            for (int i = 0; i < *count; ++i) take(bytes[i]);
        const std::int64_t now = ports_.clock.microseconds();
        if (count && *count > 0 && state_ == State::idle) heard_ = now;
        if (now - heard_ > patience && (state_ != State::idle || reader_.in_packet())) run_out();
    }

private:
    enum class State : std::uint8_t { idle, armed, receiving, judging };

    // ---- What arrives ----

    /// A pin that cannot be read is told of once, and a packet still triggers.
    void take_edge() {
        const Result<bool> edge = ports_.trigger.take_edge();
        if (!edge && !trigger_lost_) fail("the trigger cannot be read");
        trigger_lost_ = !edge;
        if (edge && *edge) trigger();
    }

    void take(std::uint8_t byte) {
        const Result<bool> whole = reader_.add(byte);
        if (whole.status() == Status::capacity_exceeded) return take_too_long(reader_.beginning());
        if (!whole) return fail("packet damaged");
        if (!*whole) return;
        heard_ = ports_.clock.microseconds();
        const Span<const std::uint8_t> content = reader_.content();
        switch (static_cast<PacketKind>(content[0])) {
            case PacketKind::trigger: return content.size() == 1 ? trigger() : fail("packet of a wrong size");
            case PacketKind::frame: return begin_frame(content.from(1));
            case PacketKind::line: return take_line(content.from(1));
            case PacketKind::recipe:
                if (!Job::takes_recipes) break;
                if (state_ != State::idle) return fail("recipe within a frame");
                if (load(content.from(1))) tell_state();
                return;
            case PacketKind::state: return tell_state();
        }
        fail("packet of an unknown kind");
    }

    static int number_at(Span<const std::uint8_t> bytes, std::ptrdiff_t at) {
        return bytes[at] | bytes[at + 1] << 8;
    }

    void trigger() {
        set_outputs(Verdict::unmeasured);
        ++triggers_;
        if (state_ != State::idle) {
            // The frame that is being taken is still judged; there will be none of this trigger.
            line_.text("{\"frame\":").number(triggers_).text(",\"missed\":true}").end();
            return;
        }
        frame_ = triggers_;
        state_ = State::armed;
        if (const char* what = job_.missing()) return fail(what);
        heard_ = ports_.clock.microseconds();
        line_.text("{\"frame\":").number(frame_).text(",\"ready\":true}").end();
    }

    void begin_frame(Span<const std::uint8_t> rest) {
        if (state_ == State::receiving) return fail("frame within a frame");
        if (state_ == State::idle) return fail("frame without a trigger");
        if (rest.size() != 4) return fail("packet of a wrong size");
        size_ = {number_at(rest, 0), number_at(rest, 2)};
        if (size_.empty()) return fail("frame without pixels");
        if (const char* reason = job_.begin(size_)) return fail(reason);
        reader_ = PacketReader(job_.packet_room());
        state_ = State::receiving;
        next_line_ = 0;
        lines_expected_ = false;
    }

    void take_line(Span<const std::uint8_t> rest) {
        if (state_ != State::receiving) {
            // After an error the rest of its frame still comes, even behind the next trigger, with room
            // or without.
            if (!lines_expected_) fail("line without a frame");
            return;
        }
        if (rest.size() != 2 + size_.width) return fail("line of a wrong length");
        if (number_at(rest, 0) != next_line_) return fail("line missing");
        job_.take_line(next_line_, rest.from(2));
        if (++next_line_ == size_.height) judge_frame();
    }

    /// A packet without room. Where what it begins with says that it is a line, it is taken for one.
    void take_too_long(Span<const std::uint8_t> beginning) {
        const bool is_line = static_cast<PacketKind>(beginning[0]) == PacketKind::line;
        if (!is_line || state_ == State::receiving || !lines_expected_) return fail("packet too long");
        heard_ = ports_.clock.microseconds();
    }

    /// False, and all as it was, if the job refuses the bytes.
    bool load(Span<const std::uint8_t> bytes) {
        const char* reason = job_.load(bytes);
        if (reason == nullptr) return true;
        set_outputs(Verdict::unmeasured);
        line_.text("{\"error\":\"").text(reason).text("\"}").end();
        return false;
    }

    void run_out() {
        const bool begun = reader_.in_packet();
        reader_.drop();
        heard_ = ports_.clock.microseconds();
        if (state_ == State::receiving) return fail("line too late");
        if (state_ == State::armed) return fail("no frame came");
        if (begun) fail("packet cut off");
    }

    // ---- What leaves ----

    /// Both inactive but for a frame that was judged.
    void set_outputs(Verdict verdict) {
        const Status ok = ports_.ok.set(verdict == Verdict::ok);
        const Status not_ok = ports_.not_ok.set(verdict == Verdict::not_ok);
        if (ok != Status::ok || not_ok != Status::ok)
            line_.text("{\"error\":\"a verdict's pin cannot be set\"}").end();
    }

    void fail(const char* reason) {
        set_outputs(Verdict::unmeasured);
        line_.text("{");
        if (state_ != State::idle) line_.text("\"frame\":").number(frame_).text(",");
        line_.text("\"error\":\"").text(reason).text("\"");
        if (state_ == State::receiving) line_.text(",\"line\":").number(next_line_);
        line_.text(",\"verdict\":\"unmeasured\"}").end();
        state_ = State::idle;
        lines_expected_ = true;
    }

    void judge_frame() {
        state_ = State::judging;
        Verdict verdict = Verdict::unmeasured;
        const char* reason = job_.judge(verdict);
        ports_.watchdog.feed();
        if (reason != nullptr) return fail(reason);
        set_outputs(verdict);
        line_.text("{\"frame\":").number(frame_);
        job_.tell_judged(line_);
        line_.text(",\"verdict\":\"").text(word_of(verdict)).text("\"}").end();
        state_ = State::idle;
    }

    void tell_state() {
        line_.text("{\"board\":\"").text(board_).text("\"");
        job_.tell_state(line_);
        line_.text("}").end();
    }

    Ports ports_;
    Job& job_;
    const char* board_;
    PacketReader reader_;
    JsonLine<typename Ports::Serial, typename Ports::Clock, typename Ports::Watchdog> line_;
    State state_ = State::idle;
    bool lines_expected_ = false;
    int next_line_ = 0;
    Size size_{};
    bool trigger_lost_ = false;
    std::int64_t frame_ = 0;
    std::int64_t triggers_ = 0;
    std::int64_t heard_ = 0;
};

}  // namespace fovea::apps
