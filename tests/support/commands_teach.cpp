// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <list>
#include <optional>
#include <string>
#include <vector>

#include <support/commands.hpp>
#include <support/teaching.hpp>

namespace fovea::apps {

template ExitCode teach_command(test::TestIo&, const std::vector<std::string>&);

}  // namespace fovea::apps

namespace fovea::test {

apps::Taught taught_from(const std::vector<apps::Picture<Gray8>>& pictures,
                         const apps::TeachOptions& options) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < pictures.size(); ++i) names.push_back("good_" + std::to_string(i));
    return apps::teach(pictures, names, options);
}

apps::Samples samples_of(const apps::Picture<Gray8>& picture, std::optional<bool> dark) {
    static std::list<std::vector<apps::Picture<Gray8>>> kept;
    kept.push_back({picture});
    return apps::find_samples(kept.back(), {"a.png"}, dark);
}
apps::Samples samples_in(const std::vector<apps::Picture<Gray8>>& pictures,
                         const std::vector<std::string>& names) {
    return apps::find_samples(pictures, names, {});
}

}  // namespace fovea::test
