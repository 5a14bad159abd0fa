// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include <support/commands.hpp>

namespace fovea::apps {

template ExitCode gauge_command(test::TestIo&, const std::vector<std::string>&);
template ExitCode make_part_command(test::TestIo&, const std::vector<std::string>&);

}  // namespace fovea::apps

namespace fovea::test {

Status gauge_parts(const apps::Picture<Gray8>& picture, const Recipe& recipe,
                   std::vector<PartResult>& parts) {
    return apps::gauge_picture(picture, recipe, parts);
}

}  // namespace fovea::test
