// SPDX-License-Identifier: MIT
//
// The commands of the tool, and which one a command line means.
#pragma once

#include <string>
#include <vector>

#include <calibrate/calibrate_command.hpp>
#include <camera/camera_command.hpp>
#include <camera/rectify_command.hpp>
#include <camera/undistort_command.hpp>
#include <common/arguments.hpp>
#include <common/io.hpp>
#include <gauge/compile_command.hpp>
#include <gauge/gauge_command.hpp>
#include <gauge/teach_command.hpp>
#include <make_code/make_code_command.hpp>
#include <make_part/make_part_command.hpp>
#include <op/op_command.hpp>
#include <op/ops_command.hpp>
#include <op/picture_commands.hpp>
#include <op/sheet_command.hpp>
#include <probe/doctor_command.hpp>
#include <probe/probe_command.hpp>
#include <read/read_command.hpp>
#include <tool/manual.hpp>

#ifndef FOVEA_VERSION
#define FOVEA_VERSION "unknown"
#endif

namespace fovea::apps {

namespace detail {

template <class Io>
struct Entry {
    Command help;
    ExitCode (*run)(Io& io, const std::vector<std::string>& words);
};

template <class Io>
std::vector<Entry<Io>> commands() {
    return {{gauge_help(), gauge_command<Io>},
            {teach_help(), teach_command<Io>},
            {compile_help(), compile_command<Io>},
            {read_help(), read_command<Io>},
            {make_code_help(), make_code_command<Io>},
            {make_part_help(), make_part_command<Io>},
            {calibrate_help(), calibrate_command<Io>},
            {undistort_help(), undistort_command<Io>},
            {rectify_help(), rectify_command<Io>},
            {camera_help(), camera_command<Io>},
            {op_help(), op_command<Io>},
            {sheet_help(), sheet_command<Io>},
            {ops_help(), ops_command<Io>},
            {info_help(), info_command<Io>},
            {compare_help(), compare_command<Io>},
            {probe_help(), probe_command<Io>},
            {doctor_help(), doctor_command<Io>}};
}

template <class Io>
std::string overview() {
    std::string text =
        "usage: fovea COMMAND [options] ...\n\nMeasures and decides with pictures.\n\ncommands:\n";
    for (const Entry<Io>& entry : commands<Io>()) {
        const std::string name = std::string("  ") + entry.help.name;
        text += name + std::string(14 - name.size(), ' ') + entry.help.summary + "\n";
    }
    return text +
           "\n`fovea COMMAND --help` tells more. `fovea --version` tells the version.\n"
           "`fovea --manual` prints all of it as a manual page.\n";
}

}  // namespace detail

/// Runs the tool with the words of its command line.
template <class Io>
ExitCode run_command(Io& io, const std::vector<std::string>& words) {
    const std::string name = words.empty() ? "--help" : words[0];
    if (name == "--help" || name == "-h" || name == "help") {
        io.print(detail::overview<Io>());
        return words.empty() ? exit_failed : exit_ok;
    }
    if (name == "--version") {
        io.print("fovea " FOVEA_VERSION "\n");
        return exit_ok;
    }
    if (name == "--manual") {
        std::vector<Command> helps;
        for (const detail::Entry<Io>& entry : detail::commands<Io>()) helps.push_back(entry.help);
        io.print(manual_page(helps));
        return exit_ok;
    }
    std::vector<std::string> names;
    for (const detail::Entry<Io>& entry : detail::commands<Io>()) {
        names.push_back(entry.help.name);
        if (name == entry.help.name) return entry.run(io, {words.begin() + 1, words.end()});
    }
    const std::string meant = hint(nearest_name(name, names));
    io.complain("fovea: unknown command " + one_line(name) + (meant.empty() ? ";" : meant) +
                " `fovea --help` lists them");
    return exit_failed;
}

}  // namespace fovea::apps
