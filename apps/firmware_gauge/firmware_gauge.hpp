// SPDX-License-Identifier: MIT
//
// A board that gauges: a trigger, a frame line by line over the serial line, a verdict on two pins and a line
// of JSON. Everything but the verdict of the last good frame leaves both pins inactive.
//
//   idle --trigger--> armed --frame--> receiving --last line--> judged, idle
//     any --error, patience over--> idle
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/packet.hpp>
#include <fovea/decision/compiled_recipe.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/image/image_view.hpp>

#include <common/decimals.hpp>
#include <common/verdicts.hpp>
#include <firmware_gauge/json_line.hpp>

namespace fovea::apps {

/// What packets begin with. Numbers have two bytes, the low one first.
enum class PacketKind : std::uint8_t {
    trigger = 'T',  ///< nothing more: as an edge on the trigger's pin
    frame = 'F',    ///< width, height: the lines of a frame follow
    line = 'L',     ///< number of the line, its pixels
    recipe = 'R',   ///< what encode_recipe() wrote; until the next reset
    state = '?',    ///< nothing more: the board says what it is
};

/// All memory of the firmware, known when it is compiled.
template <std::size_t FrameBytes, std::size_t ScratchBytes, std::size_t LineBytes, int Features, int Parts>
struct GaugeMemory {
    static constexpr std::int64_t frame_bytes = FrameBytes;
    static constexpr std::int64_t line_bytes = LineBytes;

    RecipeOf<Features> recipe;
    List<PartResult, Parts> parts;
    /// Of the gauge; until a frame is whole, of the packet that arrives: a line, or a recipe.
    alignas(8) std::uint8_t scratch[ScratchBytes];
    std::uint8_t frame[FrameBytes];

    static constexpr std::ptrdiff_t packet_bytes = 3 + LineBytes + 4;
    static_assert(packet_bytes <= ScratchBytes, "a line must find room");
    Span<std::uint8_t> packet() { return {scratch, packet_bytes}; }
};

/// What the firmware is connected to.
template <class TheSerial, class TheTrigger, class TheOutput, class TheClock, class TheWatchdog>
struct GaugePorts {
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

template <class Ports, class Memory>
class FirmwareGauge {
public:
    /// How long a frame may take to begin after its trigger, each line to come, and a packet to end.
    static constexpr std::int64_t patience = 2000000;  ///< microseconds

    FirmwareGauge(const Ports& ports, Memory& memory, const char* board)
        : ports_(ports),
          memory_(memory),
          board_(board),
          reader_(memory.packet()),
          line_(ports.serial, ports.clock, ports.watchdog) {}

    /// The first words, with a recipe that lies in flash if there is one.
    void start(Span<const std::uint8_t> recipe) {
        set_outputs(Verdict::unmeasured);
        heard_ = ports_.clock.microseconds();
        if (!recipe.empty()) load(recipe);
        tell_state();
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
        if (whole.status() == Status::capacity_exceeded) return fail("packet too long");
        if (!whole) return fail("packet damaged");
        if (!*whole) return;
        heard_ = ports_.clock.microseconds();
        const Span<const std::uint8_t> content = reader_.content();
        switch (static_cast<PacketKind>(content[0])) {
            case PacketKind::trigger: return content.size() == 1 ? trigger() : fail("packet of a wrong size");
            case PacketKind::frame: return begin_frame(content.from(1));
            case PacketKind::line: return take_line(content.from(1));
            case PacketKind::recipe:
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
        if (!has_recipe_) return fail("no recipe");
        heard_ = ports_.clock.microseconds();
        line_.text("{\"frame\":").number(frame_).text(",\"ready\":true}").end();
    }

    void begin_frame(Span<const std::uint8_t> rest) {
        if (state_ == State::receiving) return fail("frame within a frame");
        if (state_ == State::idle) return fail("frame without a trigger");
        if (rest.size() != 4) return fail("packet of a wrong size");
        size_ = {number_at(rest, 0), number_at(rest, 2)};
        if (size_.empty()) return fail("frame without pixels");
        if (size_.area() > Memory::frame_bytes) return fail("frame too large");
        state_ = State::receiving;
        next_line_ = 0;
        lines_expected_ = false;
    }

    void take_line(Span<const std::uint8_t> rest) {
        if (state_ != State::receiving) {
            // After an error the rest of its frame still comes, even behind the next trigger.
            if (!lines_expected_) fail("line without a frame");
            return;
        }
        if (rest.size() != 2 + size_.width) return fail("line of a wrong length");
        if (number_at(rest, 0) != next_line_) return fail("line missing");
        std::uint8_t* row = memory_.frame + std::ptrdiff_t{next_line_} * size_.width;
        for (int x = 0; x < size_.width; ++x) row[x] = rest[2 + x];
        if (++next_line_ == size_.height) judge_frame();
    }

    /// False, and all as it was, if the bytes are no recipe for this board.
    bool load(Span<const std::uint8_t> bytes) {
        const Status status = decode_recipe(bytes, memory_.recipe);
        if (status == Status::ok) return has_recipe_ = true;
        set_outputs(Verdict::unmeasured);
        line_.text("{\"error\":\"recipe refused: ")
            .text(status == Status::unsupported         ? "of another version"
                  : status == Status::truncated         ? "it ends too early"
                  : status == Status::capacity_exceeded ? "more features than this board has room for"
                                                        : "damaged")
            .text("\"}")
            .end();
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

    /// Both inactive but for a part that was judged.
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
        const ImageView<const Gray8> image(memory_.frame, size_, size_.width);
        memory_.parts.clear();
        const Status status = gauge(image, memory_.recipe, memory_.scratch, memory_.parts);
        ports_.watchdog.feed();
        if (status != Status::ok) return fail(describe(status));
        if (memory_.parts.empty()) return fail("no part");
        Verdict all = Verdict::ok;
        for (const PartResult& part : memory_.parts) all = combine(all, part.verdict);
        set_outputs(all);
        line_.text("{\"frame\":").number(frame_).text(",\"parts\":[");
        for (int i = 0; i < memory_.parts.size(); ++i) tell_part(i);
        line_.text("],\"verdict\":\"").text(word_of(all)).text("\"}").end();
        state_ = State::idle;
    }

    void tell_part(int index) {
        const PartResult& part = memory_.parts[index];
        const PartFrame& frame = part.pose.frame;
        line_.text(index == 0 ? "{\"x\":" : ",{\"x\":").decimal(decimal_of(frame.origin().x), 3);
        line_.text(",\"y\":").decimal(decimal_of(frame.origin().y), 3);
        line_.text(",\"angle_deg\":").decimal(decimal_of(frame.angle()), 4);
        line_.text(",\"area_px\":").number(part.area).text(",\"holes\":").number(part.holes);
        line_.text(",\"features\":[");
        for (int i = 0; i < part.feature_count; ++i) {
            const Feature& feature = memory_.recipe.features[i];
            const FeatureResult& result = part.features[i];
            const int places = feature.kind == FeatureKind::hole_count ? 0 : 6;
            line_.text(i == 0 ? "{\"name\":" : ",{\"name\":").string(name_of(feature.name));
            if (result.status == Status::ok)
                line_.text(",\"value\":").decimal(result.measurement.value, places);
            else
                line_.text(",\"value\":null,\"reason\":\"").text(describe(result.status)).text("\"");
            line_.text(",\"verdict\":\"").text(word_of(result.verdict)).text("\"}");
            ports_.watchdog.feed();
        }
        line_.text("],\"verdict\":\"").text(word_of(part.verdict)).text("\"}");
    }

    void tell_state() {
        line_.text("{\"board\":\"").text(board_).text("\",\"recipe\":");
        if (has_recipe_)
            line_.string(name_of(memory_.recipe.name));
        else
            line_.text("null");
        line_.text(",\"features\":").number(memory_.recipe.features.size());
        line_.text(",\"frame_bytes\":").number(Memory::frame_bytes);
        line_.text(",\"line_bytes\":").number(Memory::line_bytes).text("}").end();
    }

    Ports ports_;
    Memory& memory_;
    const char* board_;
    PacketReader reader_;
    JsonLine<typename Ports::Serial, typename Ports::Clock, typename Ports::Watchdog> line_;
    State state_ = State::idle;
    bool lines_expected_ = false;
    int next_line_ = 0;
    Size size_{};
    bool has_recipe_ = false;
    bool trigger_lost_ = false;
    std::int64_t frame_ = 0;
    std::int64_t triggers_ = 0;
    std::int64_t heard_ = 0;
};

}  // namespace fovea::apps
