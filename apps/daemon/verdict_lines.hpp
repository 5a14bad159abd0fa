// SPDX-License-Identifier: MIT
//
// VerdictLines: the six lines by which a machine follows an inspection: ready, busy, valid, OK, NG and alarm.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>

#include <daemon/tally.hpp>

namespace fovea::apps {

/// How long an answer stands.
enum class LineMode : std::uint8_t {
    hold,   ///< until the next trigger
    pulse,  ///< for the time of a pulse
};

struct LineTiming {
    LineMode mode = LineMode::hold;
    std::int64_t pulse_us = 50000;
    /// An answer that is neither is shown as NG, so that the part is sorted out. Otherwise busy ends and
    /// valid stays inactive.
    bool error_is_not_ok = false;
};

/// The state of the lines, and the order in which they change. A null pin is not wired.
///
///     trigger    __|~|__________________________|~|________
///     ready      ~~~~|_________________|~~~~~~~~~~|________
///     busy       ____|~~~~~~~~~~~~~~~~~|__________|~~~~~~~~
///     OK or NG   ~~~~|_________________|~~~~~~~~~~|________    (hold: until the next trigger)
///     valid      ~~~~|__________________|~~~~~~~~~|________
///     OK or NG   ______________________|~~~~~|_____________    (pulse)
///     valid      _______________________|~~~|______________
///
/// An answer may be read while valid is active, and only then: the line of the answer is set before valid and
/// cleared after it. OK and NG are never active together. ready says that a trigger will be answered: the
/// camera streams, a job is loaded, and none is being answered. alarm is active while something is wrong that
/// a person must see to. All lines inactive is the safe state: that of a device without power, too, if the
/// lines are pulled so.
template <class Output>
class VerdictLines {
public:
    struct Pins {
        Output* ready = nullptr;
        Output* busy = nullptr;
        Output* valid = nullptr;
        Output* ok = nullptr;
        Output* not_ok = nullptr;
        Output* alarm = nullptr;
    };

    /// All lines inactive.
    VerdictLines(const Pins& pins, const LineTiming& timing) : pins_(pins), timing_(timing) { make_safe(); }

    /// All inactive. Tried on every pin, whatever the others answer.
    void make_safe() {
        withdraw();
        set(pins_.busy, busy_, false);
        set(pins_.ready, ready_, false);
        set(pins_.alarm, alarm_, false);
    }

    /// From the next answer on.
    void set_timing(const LineTiming& timing) { timing_ = timing; }

    /// Whether a trigger would be answered now.
    void set_ready(bool ready) { set(pins_.ready, ready_, ready && !busy()); }
    void set_alarm(bool alarm) { set(pins_.alarm, alarm_, alarm); }

    /// A trigger is being answered: the answer before is gone.
    void begin() {
        set(pins_.ready, ready_, false);
        withdraw();
        set(pins_.busy, busy_, true);
    }

    /// The answer. missed has none: that trigger never began.
    void show(Answer answer, std::int64_t now_us) {
        withdraw();
        const bool rejected =
            answer == Answer::not_ok || (answer == Answer::error && timing_.error_is_not_ok);
        if (answer == Answer::ok) set(pins_.ok, ok_, true);
        if (rejected) set(pins_.not_ok, not_ok_, true);
        // A line of which nobody knows how it stands must not be read.
        const bool known = ok_ != Level::unknown && not_ok_ != Level::unknown;
        if ((answer == Answer::ok || rejected) && known) set(pins_.valid, valid_, true);
        set(pins_.busy, busy_, false);
        ends_us_ = now_us + timing_.pulse_us;
    }

    /// Ends a pulse that is over. When to call it again, or -1 for when something else happens.
    std::int64_t turn(std::int64_t now_us) {
        const bool gone = ok_ == Level::inactive && not_ok_ == Level::inactive;
        if (gone || timing_.mode == LineMode::hold) return -1;
        if (now_us < ends_us_) return ends_us_;
        withdraw();
        return -1;
    }

    /// The first refusal of a pin since the last call, ok if none.
    Status take_fault() {
        const Status fault = failed_;
        failed_ = Status::ok;
        return fault;
    }

    /// True while it is not known how a line stands, since it refused.
    bool lost() const {
        for (const Level level : {ready_, busy_, valid_, ok_, not_ok_, alarm_})
            if (level == Level::unknown) return true;
        return false;
    }

    bool busy() const { return busy_ == Level::active; }
    bool valid() const { return valid_ == Level::active; }

private:
    enum class Level : std::uint8_t { inactive, active, unknown };

    void withdraw() {
        set(pins_.valid, valid_, false);
        set(pins_.ok, ok_, false);
        set(pins_.not_ok, not_ok_, false);
    }
    /// Sets a line that is not so yet, or of which that is not known since it refused.
    void set(Output* pin, Level& level, bool active) {
        const Level wanted = active ? Level::active : Level::inactive;
        if (level == wanted) return;
        const Status got = pin == nullptr ? Status::ok : pin->set(active);
        level = got == Status::ok ? wanted : Level::unknown;
        if (failed_ == Status::ok) failed_ = got;
    }

    Pins pins_;
    LineTiming timing_;
    Level ready_ = Level::unknown;
    Level busy_ = Level::unknown;
    Level valid_ = Level::unknown;
    Level ok_ = Level::unknown;
    Level not_ok_ = Level::unknown;
    Level alarm_ = Level::unknown;
    std::int64_t ends_us_ = 0;
    Status failed_ = Status::ok;
};

}  // namespace fovea::apps
