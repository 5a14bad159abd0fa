// SPDX-License-Identifier: MIT
//
// StatusLine: what a manager of services shows of the daemon - its job, its counts, and what is wrong.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>

#include <daemon/camera_keeper.hpp>
#include <daemon/tally.hpp>
#include <daemon/text_buffer.hpp>

namespace fovea::apps {

class StatusLine {
public:
    /// The line if it has become another one, nullptr if not; once a second at most. World and Daemon are
    /// those of daemon.hpp.
    ///
    ///     cap: 120 OK, 3 NG, 0 ERROR, 1 missed
    ///     cap: 120 OK, 3 NG, 9 ERROR, 1 missed; camera_lost: No such device
    template <class World, class Daemon>
    const char* turn(World& world, const Daemon& daemon) {
        const std::int64_t now_us = world.now_us();
        if (shown_[0] != '\0' && now_us - shown_us_ < 1000000) return nullptr;
        char room[sizeof shown_];
        // What is too long is cut: people read it, and no program.
        TextBuffer line(Span<char>(room, sizeof room - 1));
        const Tally& tally = daemon.tally();
        line.text(daemon.job() == 0 ? "no job" : world.jobs()[daemon.job()].name.c_str()).text(": ");
        count(line, tally.ok, " OK, ");
        count(line, tally.not_ok, " NG, ");
        count(line, tally.error, " ERROR, ");
        count(line, tally.missed, " missed");
        if (const CameraTrouble trouble = world.camera().trouble(); trouble != CameraTrouble::none)
            line.text("; ").text(word_of(trouble)).text(": ").text(world.camera_fault());
        room[line.size()] = '\0';
        if (std::strcmp(room, shown_) == 0) return nullptr;
        std::memcpy(shown_, room, sizeof shown_);
        shown_us_ = now_us;
        return shown_;
    }

private:
    static void count(TextBuffer& line, std::uint64_t number, const char* what) {
        line.number(static_cast<std::int64_t>(number)).text(what);
    }

    char shown_[300] = {};
    std::int64_t shown_us_ = 0;
};

}  // namespace fovea::apps
