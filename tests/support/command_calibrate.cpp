// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include <support/command_calibrate.hpp>

namespace fovea::apps {

template ExitCode calibrate_command(test::TestIo&, const std::vector<std::string>&);

}  // namespace fovea::apps
