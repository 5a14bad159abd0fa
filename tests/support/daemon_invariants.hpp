// SPDX-License-Identifier: MIT
//
// DaemonInvariants: what must hold of every run of the daemon, whatever is wrong around it: I1 to I6 of
// docs/faults.md. On the emulated board tests/board/invariants.py looks at the same.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace fovea::test {

/// Is told what goes in and comes out, in order. complaints are sentences, each with the invariant in front.
class DaemonInvariants {
public:
    enum Line { ready, busy, valid, ok, not_ok, alarm };

    std::vector<std::string> complaints;

    void take_edges(std::uint64_t count) { edges_ += count; }

    /// A frame is about to be looked at; whole is false for one that is marked, cut short or undecodable.
    void take_frame(std::uint32_t sequence, std::int64_t time_us, std::int64_t interval_us, bool whole) {
        frame_ = {sequence, time_us, interval_us, whole};
    }

    void take_level(Line line, bool active) {
        if (level_[valid] && (line == ok || line == not_ok) && level_[line] != active)
            complain("I3: OK or NG changed while VALID was active");
        level_[line] = active;
        if (level_[ok] && level_[not_ok]) complain("I3: OK and NG together");
        if (level_[valid] && level_[ok] == level_[not_ok]) complain("I3: VALID with neither OK nor NG");
        if (level_[ready] && level_[busy]) complain("I3: READY and BUSY together");
    }

    /// A line of JSON that the daemon said.
    void take_said(const std::string& line) {
        const std::string event = text_of(line, "\"ev\":\"");
        if (event == "result" || event == "trigger_missed") take_answer(line, event == "result");
        if (event == "result") take_verdict(line);
        take_event(line, event);
    }

    /// A turn of the loop that nothing brought but the time: with so many system calls, while so many things
    /// were wrong.
    void take_idle_turn(std::int64_t now_us, int calls, int troubles) {
        if (troubles == 0) return end_wait(now_us);
        if (wait_since_us_ < 0) wait_since_us_ = now_us, idle_calls_ = 0, troubles_at_once_ = 0;
        idle_calls_ += calls;
        troubles_at_once_ = std::max(troubles_at_once_, troubles);
    }
    /// What was wrong is not any more.
    void end_wait(std::int64_t now_us) {
        const std::int64_t lasted_us = wait_since_us_ < 0 ? 0 : now_us - wait_since_us_;
        wait_since_us_ = -1;
        // Of a shorter wait the first looks are the most.
        if (lasted_us >= 6000000 && idle_calls_ * 1000000 > 20 * troubles_at_once_ * lasted_us)
            complain("I5: " + std::to_string(idle_calls_) + " system calls in " +
                     std::to_string(lasted_us / 1000) + " ms of waiting");
    }

    /// The end. edges: triggers come of nothing else; waiting: the last has no answer yet; handles: of the
    /// camera that are open, and how many should be.
    void end(std::int64_t now_us, bool by_edges, bool waiting, int handles, int wanted_handles) {
        end_wait(now_us);
        const std::uint64_t open = waiting ? 1 : 0;
        if (!answers_.empty() && answers_.rbegin()->first > answers_.size() + open)
            complain("I1: a trigger has no answer");
        if (by_edges && edges_ != answers_.size() + open)
            complain("I1: " + std::to_string(edges_) + " edges, " + std::to_string(answers_.size()) +
                     " answers");
        if (handles != wanted_handles)
            complain("I4: " + std::to_string(handles) + " handles of the camera are open");
    }

    /// How many triggers have that answer.
    std::uint64_t count(const std::string& answer) const {
        return static_cast<std::uint64_t>(std::count_if(
            answers_.begin(), answers_.end(), [&](const auto& each) { return each.second == answer; }));
    }
    std::uint64_t answers() const { return answers_.size(); }

private:
    struct Frame {
        std::uint32_t sequence = 0;
        std::int64_t time_us = 0;
        std::int64_t interval_us = 0;
        bool whole = false;
    };

    void complain(const std::string& what) { complaints.push_back(what); }
    static std::string text_of(const std::string& line, const std::string& key) {
        const std::size_t at = line.find(key);
        if (at == std::string::npos) return "";
        return line.substr(at + key.size(), line.find('"', at + key.size()) - at - key.size());
    }
    static std::int64_t number_of(const std::string& line, const std::string& key) {
        const std::size_t at = line.find(key);
        return at == std::string::npos ? -1 : std::strtoll(line.c_str() + at + key.size(), nullptr, 10);
    }

    void take_answer(const std::string& line, bool result) {
        const auto number = static_cast<std::uint64_t>(number_of(line, "\"seq\":"));
        const std::string answer = result ? text_of(line, "\"verdict\":\"") : "MISSED";
        if (answer != "OK" && answer != "NG" && answer != "ERROR" && answer != "MISSED")
            complain("I1: the answer " + answer);
        if (!answers_.emplace(number, answer).second)
            complain("I1: trigger " + std::to_string(number) + " has two answers");
    }

    void take_verdict(const std::string& line) {
        const std::string answer = text_of(line, "\"verdict\":\"");
        if (answer != "OK" && answer != "NG") return;
        const std::int64_t trigger_us = number_of(line, "\"t_mono_us\":") - number_of(line, "\"answer\":");
        if (troubles_.count("camera_back") != 0) complain("I2: a verdict while " + troubles_["camera_back"]);
        if (number_of(line, "\"frame\":{\"seq\":") != frame_.sequence)
            complain("I2: a verdict of another frame");
        if (number_of(line, "\"age_us\":") < 0) complain("I2: a frame of the future");
        if (!frame_.whole) complain("I2: a verdict of a frame that is not whole");
        if (frame_.time_us <= judged_us_) complain("I2: a second verdict of a frame");
        // In free run a frame is its own trigger.
        if (frame_.time_us != trigger_us && frame_.time_us - frame_.interval_us < trigger_us)
            complain("I2: a verdict of a frame that began before its trigger");
        judged_us_ = frame_.time_us;
    }

    void take_event(const std::string& line, const std::string& event) {
        static const std::map<std::string, std::string> ends = {
            {"camera_lost", "camera_back"},        {"camera_broken", "camera_back"},
            {"camera_silent", "camera_back"},      {"camera_no_signal", "camera_back"},
            {"camera_changed", "camera_back"},     {"camera_refused", "camera_back"},
            {"serial_lost", "serial_back"},        {"lines_lost", "lines_back"},
            {"failures_lost", "failures_kept"},    {"image_quality", "image_quality_back"},
            {"trigger_lost", "the end of the run"}};
        const auto onset = ends.find(event);
        if (onset != ends.end()) {
            std::string& open = troubles_[onset->second];
            // Of a camera another trouble may follow from the first.
            if (open == event || (!open.empty() && onset->second != "camera_back"))
                complain("I6: " + event + " again before its end");
            if (text_of(line, "\"reason\":\"").size() < 3) complain("I6: " + event + " without a reason");
            open = event;
        }
        const bool is_end =
            std::any_of(ends.begin(), ends.end(), [&](const auto& each) { return each.second == event; });
        if (is_end && troubles_.erase(event) == 0) complain("I6: " + event + " of no trouble");
    }

    std::uint64_t edges_ = 0;
    std::map<std::uint64_t, std::string> answers_;
    Frame frame_;
    std::int64_t judged_us_ = -1;
    bool level_[6] = {};
    std::map<std::string, std::string> troubles_;
    std::int64_t wait_since_us_ = -1;
    std::int64_t idle_calls_ = 0;
    int troubles_at_once_ = 0;
};

}  // namespace fovea::test
