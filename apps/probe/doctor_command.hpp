// SPDX-License-Identifier: MIT
//
// fovea doctor: says why fovead does not run as it should, and what to try.
#pragma once

#include <string>
#include <vector>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <daemon/daemon_files.hpp>
#include <probe/camera_doctor.hpp>
#include <probe/check.hpp>
#include <probe/machine.hpp>
#include <probe/wiring.hpp>

namespace fovea::apps {

inline Command doctor_help() {
    return {
        "doctor",
        "",
        "Looks at all that fovead needs, and says what is wrong and what to try.",
        {{"config", "FILE", "settings of fovead; /etc/fovea/fovead.toml"},
         {"frames", "N", "how many frames to take; 30"},
         {"json", "", "one line of JSON for each check"}},
        "Looks at settings and jobs, the camera (found, rights, other programs, mode, controls, stream,\n"
        "frames, light), the serial port and the lines. What depends on a check that failed is left out.\n"
        "The camera is set up as fovead does it; on the lines nothing changes. End fovead before:\n"
        "what it has cannot be looked at.\n"
        "Ends with 0 if nothing failed, with 1 if something did, with 2 if it could not look.\n"};
}

/// Runs `fovea doctor` with the words behind its name, on the machine that Io stands for.
template <class Io>
ExitCode doctor_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(doctor_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(doctor_help()));
        return exit_ok;
    }
    std::string problem = arguments.problem();
    int frames = 30;
    if (problem.empty() && !arguments.operands().empty())
        problem = "it takes no words, not '" + one_line(arguments.operands()[0]) + "'";
    if (problem.empty()) whole_option(arguments, "frames", 1, 10000, frames, problem);
    if (!problem.empty()) {
        io.complain("fovea doctor: " + problem);
        return exit_failed;
    }
    CheckList checks(
        &io, [](void* to, const std::string& text) { static_cast<Io*>(to)->print(text); },
        arguments.has("json"));
    const std::string config = arguments.value("config", "/etc/fovea/fovead.toml");
    const DaemonFiles files = read_daemon_files(config);
    if (!files.settings_good) {
        checks.fail("settings", files.problem, "fovead --sample-config prints settings to begin with");
        return exit_not_ok;
    }
    checks.ok("settings", config);
    if (files.problem.empty())
        checks.ok("jobs",
                  std::to_string(files.jobs.size()) + ", and it begins with " + files.jobs[files.job].name);
    else
        checks.fail("jobs", files.problem, "");  // it says what to do
    CameraDoctor(io.system(), io.machine(), files.settings, frames, checks).look();
    check_serial(io.system(), io.machine(), files.settings.serial, checks);
    check_lines(io.system(), io.machine(), files.settings, checks);
    return checks.failures() > 0 ? exit_not_ok : exit_ok;
}

}  // namespace fovea::apps
