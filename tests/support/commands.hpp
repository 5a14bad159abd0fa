// SPDX-License-Identifier: MIT
//
// The commands of the tool upon TestIo. They are compiled once, in commands_*.cpp: with sanitizers each takes
// half a minute, and many tests run them. Host tests only.
#pragma once

#include <string>
#include <vector>

#include <gauge/gauge_command.hpp>
#include <gauge/teach_command.hpp>
#include <make_part/make_part_command.hpp>
#include <support/test_io.hpp>

namespace fovea::apps {

extern template ExitCode gauge_command(test::TestIo&, const std::vector<std::string>&);
extern template ExitCode teach_command(test::TestIo&, const std::vector<std::string>&);
extern template ExitCode make_part_command(test::TestIo&, const std::vector<std::string>&);

}  // namespace fovea::apps

namespace fovea::test {

/// apps::gauge_picture().
Status gauge_parts(const apps::Picture<Gray8>& picture, const Recipe& recipe, std::vector<PartResult>& parts);

}  // namespace fovea::test
