// SPDX-License-Identifier: MIT
//
// What a command of the tool talks to: files, two streams of text, and the devices of a machine.
//
// A command is a template over Io, so that tests run it on storage in memory:
//   Io::Storage      a hal storage that also tells problem()
//   Storage& storage()
//   void print(const std::string& text)      results, for the standard output
//   void complain(const std::string& text)   one line about an error or a notice, for the standard error
//   system(), machine()   the calls into a kernel, and where it shows its devices: see probe/machine.hpp
#pragma once

#include <string>

#include <fovea/base/status.hpp>

namespace fovea::apps {

/// How a command ends, as grep and cmp do.
enum ExitCode : int {
    exit_ok = 0,      ///< all is well
    exit_not_ok = 1,  ///< judged, and something is out of tolerance
    exit_failed = 2,  ///< could not judge, or wrong use
};

/// What became of a part of a command's work; the worst counts.
constexpr ExitCode worse(ExitCode a, ExitCode b) { return a > b ? a : b; }

/// "name: what went wrong" for a file, with what the system said where there is something.
template <class Storage>
std::string file_problem(const std::string& name, Status status, Storage& storage) {
    if (status == Status::not_found || status == Status::io_error) return name + ": " + storage.problem();
    return name + ": " + describe(status);
}

}  // namespace fovea::apps
