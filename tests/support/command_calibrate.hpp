// SPDX-License-Identifier: MIT
//
// fovea calibrate upon TestIo, compiled once in command_calibrate.cpp. Host tests only.
#pragma once

#include <string>
#include <vector>

#include <calibrate/calibrate_command.hpp>
#include <support/test_io.hpp>

namespace fovea::apps {

extern template ExitCode calibrate_command(test::TestIo&, const std::vector<std::string>&);

}  // namespace fovea::apps
