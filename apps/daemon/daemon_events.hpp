// SPDX-License-Identifier: MIT
//
// DaemonEvents: what the daemon says beside its results, a line of JSON each: once when it begins, once when
// it ends.
#pragma once

#include <cerrno>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/linux/fault.hpp>

#include <daemon/camera_keeper.hpp>
#include <daemon/failure_ring.hpp>
#include <daemon/image_quality.hpp>
#include <daemon/inspection.hpp>
#include <daemon/text_buffer.hpp>

namespace fovea::apps {

/// World as Daemon has it.
template <class World>
class DaemonEvents {
public:
    explicit DaemonEvents(World& world) : world_(world) {}

    void tell_camera() {
        CameraEvent event;
        if (!world_.camera().take_event(event)) return;
        if (event.trouble == CameraTrouble::none) {
            begin("camera_back").text(",\"after_us\":").number(event.lasted_us);
            return end();
        }
        // Where nothing came, no call was refused: the fault that the camera remembers is an older one.
        const bool silent = event.status == Status::timeout;
        const char* const reason = silent ? "no frame comes" : world_.camera_fault();
        const char* const advice =
            silent ? "look at its cable, its light and its trigger" : world_.camera_advice();
        begin(word_of(event.trouble)).text(",\"reason\":").json(letters_of(reason));
        if (advice[0] != '\0') line_.text(",\"try\":").json(letters_of(advice));
        end();
    }

    void tell_link() {
        if (!world_.link().take_event()) return;
        const Status trouble = world_.link().trouble();
        begin(trouble == Status::ok ? "serial_back" : "serial_lost");
        if (trouble != Status::ok) line_.text(",\"reason\":").json(letters_of(world_.link_fault()));
        line_.text(",\"dropped\":").number(world_.link().dropped());
        end();
    }

    /// Of every picture. The trouble ends after a few that are fine, so that a lamp that flickers is one
    /// event.
    void tell_quality(ImageVerdict verdict) {
        if (!image_.changed_by(verdict)) return;
        begin(quality_bad() ? "image_quality" : "image_quality_back");
        if (quality_bad()) line_.text(",\"reason\":\"").text(word_of(image_.trouble())).text("\"");
        end();
    }
    bool quality_bad() const { return image_.trouble() != ImageVerdict::fine; }

    /// Whether the pictures of failures can be kept.
    void tell_failures(const FailureRingEvent& event) {
        const bool kept = event.status == Status::ok;
        begin(kept ? "failures_kept" : "failures_lost");
        if (!kept) line_.text(",\"reason\":").json(letters_of(linux_port::reason(event.fault)));
        const char* const advice = kept ? "" : linux_port::advice(event.fault);
        if (advice[0] != '\0') line_.text(",\"try\":").json(letters_of(advice));
        end();
    }

    /// Of every turn: what a pin answered, and whether there is one of which it is not known how it stands.
    void tell_lines(Status pin, bool lost) {
        if (lost == lines_lost_) return;
        lines_lost_ = lost;
        begin(lost ? "lines_lost" : "lines_back");
        if (lost) line_.text(",\"reason\":").json(letters_of(describe(pin)));
        end();
    }

    /// Of every turn: whether edges of the trigger's line are heard. A line that is lost stays so.
    void tell_trigger(Status status) {
        if (status == trigger_) return;
        trigger_ = status;
        begin("trigger_lost").text(",\"reason\":").json(letters_of(describe(status)));
        end();
    }

    void tell_missed(std::uint64_t number, std::int64_t trigger_us) {
        begin("trigger_missed").text(",\"seq\":").number(static_cast<std::int64_t>(number));
        line_.text(",\"trigger_us\":").number(trigger_us);
        end();
    }
    void tell_sample(Span<const char> name, Status kept, const linux_port::Fault& fault) {
        begin(kept == Status::ok ? "sample" : "sample_lost").text(",\"name\":").json(name);
        if (kept != Status::ok) {
            const char* const reason = fault.error != 0 ? linux_port::reason(fault) : describe(kept);
            line_.text(",\"reason\":").json(letters_of(reason));
        }
        const char* advice = kept != Status::ok ? linux_port::advice(fault) : "";
        if (fault.error == ENOENT) advice = "the folder above that of [teach] is not there: make it";
        if (advice[0] != '\0') line_.text(",\"try\":").json(letters_of(advice));
        end();
    }
    /// Which codes are allowed from now on; none, and the reason, if none could be taken.
    void tell_taught(Span<const char> name, Span<const CodeReading> codes, const char* reason) {
        begin(reason[0] == '\0' ? "taught" : "not_taught").text(",\"name\":").json(name);
        if (reason[0] != '\0') line_.text(",\"reason\":\"").text(reason).put('"');
        write_json_codes(codes, line_.text(",\"codes\":"));
        end();
    }
    void tell_job(Span<const char> name) {
        begin("job").text(",\"job\":").json(name);
        end();
    }

private:
    TextBuffer& begin(const char* event) {
        line_.clear();
        return line_.text("{\"v\":1,\"ev\":\"").text(event).text("\",\"t_mono_us\":").number(world_.now_us());
    }
    void end() {
        line_.put('}');
        if (!line_.full()) world_.print(line_.letters());
    }

    World& world_;
    /// For the codes that were taught; everything else is shorter than 1 kB.
    char room_[12288];
    TextBuffer line_{Span<char>(room_)};
    ImageTrouble image_;
    bool lines_lost_ = false;
    Status trigger_ = Status::ok;
};

}  // namespace fovea::apps
