// SPDX-License-Identifier: MIT
//
// DaemonOptions: what the daemon does with its devices, as the settings say.
#pragma once

#include <cstdint>
#include <string>

#include <common/text.hpp>
#include <daemon/result_presets.hpp>
#include <daemon/result_template.hpp>
#include <daemon/settings.hpp>
#include <daemon/text_buffer.hpp>

namespace fovea::apps {

/// What is done with a result, and how triggers come.
struct DaemonOptions {
    TriggerSource source = TriggerSource::free;
    std::int64_t timeout_us = 1000000;
    bool every_frame = false;
    bool json = true;
    bool silent = false;
    bool commands = true;
    /// There is a folder for what TEACH keeps.
    bool samples = false;
    bool serial_results = false;
    bool serial_json = false;
    ResultTemplate serial_template;
    const char* version = "";
};

inline DaemonOptions daemon_options(const Settings& settings, const char* version) {
    DaemonOptions options;
    options.source = settings.trigger.source;
    options.timeout_us = settings.trigger.timeout_ms * 1000;
    options.every_frame = settings.camera.every_frame;
    options.json = settings.results.json;
    options.silent = settings.serial.silent;
    options.commands = settings.serial.commands;
    options.samples = !settings.teach.folder.empty();
    options.version = version;
    const std::string results = settings.serial.results.c_str();
    options.serial_json = results == "json";
    options.serial_results = !results.empty() && !settings.serial.device.empty();
    if (!options.serial_results || options.serial_json) return options;
    const char* const preset = result_preset(span_of(results));
    // read_settings() has read it before.
    static_cast<void>(options.serial_template.read(letters_of(preset != nullptr ? preset : results.c_str())));
    return options;
}

}  // namespace fovea::apps
