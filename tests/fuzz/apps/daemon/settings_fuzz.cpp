// SPDX-License-Identifier: MIT
//
// Any settings file of the daemon: what is wrong has a place in it, and settings that were read stay within
// their ranges.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <common/text.hpp>
#include <daemon/settings.hpp>
#include <daemon/settings_reader.hpp>

using namespace fovea;
using namespace fovea::apps;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Settings settings;
    const SettingsProblem found =
        read_settings(std::string(reinterpret_cast<const char*>(data), size), settings);
    if (!found.problem.empty()) {
        if (!printable(found.problem) || found.place.line < 1 || found.place.column < 1) std::abort();
        return 0;
    }
    if (settings.camera.width < 0 || settings.camera.width > 32767 || settings.camera.rate_per_s < 1)
        std::abort();
    if (settings.camera.buffers < 2 || settings.camera.buffers > 16) std::abort();
    if (settings.controls.size() > Settings::most_controls || !settings.jobs.folder.fits()) std::abort();
    return 0;
}
