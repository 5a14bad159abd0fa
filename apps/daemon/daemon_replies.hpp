// SPDX-License-Identifier: MIT
//
// What stands behind the OK of a reply.
#pragma once

#include <cstdint>

#include <daemon/command.hpp>
#include <daemon/jobs.hpp>
#include <daemon/tally.hpp>
#include <daemon/text_buffer.hpp>

namespace fovea::apps {

/// True for a command whose reply is what it is for: a silent device answers it too.
constexpr bool asks(CommandVerb verb) {
    switch (verb) {
        case CommandVerb::list_jobs:
        case CommandVerb::ask_job:
        case CommandVerb::ask_tally:
        case CommandVerb::ask_last:
        case CommandVerb::ask_ready:
        case CommandVerb::ask_version: return true;
        case CommandVerb::none:
        case CommandVerb::trigger:
        case CommandVerb::take_job:
        case CommandVerb::reset_tally:
        case CommandVerb::teach: break;
    }
    return false;
}

/// " 2 plate"; 0 for none.
inline void add_job(const JobList& jobs, int number, TextBuffer& text) {
    text.put(' ').number(number);
    if (number != 0) text.put(' ').text(jobs[number].name.c_str());
}
/// " 1 cap, 2 plate".
inline void add_jobs(const JobList& jobs, TextBuffer& text) {
    for (int number = 1; number <= jobs.size(); ++number) {
        if (number > 1) text.put(',');
        add_job(jobs, number, text);
    }
}
/// " triggers 9 ok 7 ng 1 error 0 missed 1 us 5210 6020 7404": shortest, average and longest time.
inline void add_tally(const Tally& tally, TextBuffer& text) {
    const auto count = [&](const char* word, std::uint64_t value) {
        text.put(' ').text(word).put(' ').number(static_cast<std::int64_t>(value));
    };
    count("triggers", tally.triggers);
    count("ok", tally.ok);
    count("ng", tally.not_ok);
    count("error", tally.error);
    count("missed", tally.missed);
    text.text(" us ").number(tally.shortest_us).put(' ').number(tally.average_us());
    text.put(' ').number(tally.longest_us);
}

}  // namespace fovea::apps
