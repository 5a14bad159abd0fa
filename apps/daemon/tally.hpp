// SPDX-License-Identifier: MIT
//
// Tally: what became of every trigger. Each has exactly one answer.
#pragma once

#include <cstdint>

namespace fovea::apps {

/// The answer to a trigger.
enum class Answer : std::uint8_t {
    ok,      ///< judged, all within tolerance
    not_ok,  ///< judged, something is not
    error,   ///< could not be judged: no frame in time, no part, a value that could not be measured
    missed,  ///< came while another was being answered
};

constexpr const char* word_of(Answer answer) {
    switch (answer) {
        case Answer::ok: return "OK";
        case Answer::not_ok: return "NG";
        case Answer::error: return "ERROR";
        case Answer::missed: return "MISSED";
    }
    return "ERROR";
}

/// Counts since the start, or since reset(). 64 bits do not run over.
struct Tally {
    std::uint64_t triggers = 0;
    std::uint64_t ok = 0;
    std::uint64_t not_ok = 0;
    std::uint64_t error = 0;
    std::uint64_t missed = 0;
    /// From the trigger, or in free run from the frame, to the answer; of those that were judged.
    std::int64_t shortest_us = 0;
    std::int64_t longest_us = 0;
    std::int64_t sum_us = 0;

    /// A trigger and its answer at once.
    void count(Answer answer) {
        ++triggers;
        switch (answer) {
            case Answer::ok: ++ok; break;
            case Answer::not_ok: ++not_ok; break;
            case Answer::error: ++error; break;
            case Answer::missed: ++missed; break;
        }
    }
    void took(std::int64_t us) {
        if (judged() == 1 || us < shortest_us) shortest_us = us;
        if (us > longest_us) longest_us = us;
        sum_us += us;
    }
    std::uint64_t judged() const { return ok + not_ok; }
    std::int64_t average_us() const {
        return judged() == 0 ? 0 : sum_us / static_cast<std::int64_t>(judged());
    }
    /// True as long as no trigger was lost or answered twice.
    bool adds_up() const { return triggers == ok + not_ok + error + missed; }
};

}  // namespace fovea::apps
