// SPDX-License-Identifier: MIT
//
// Templates for results that have a name of their own.
#pragma once

#include <cstddef>

#include <fovea/base/span.hpp>

namespace fovea::apps {

/// Templates that have a name of their own; nullptr for any other name.
constexpr const char* result_preset(Span<const char> name) {
    struct Preset {
        const char* name;
        const char* text;
    };
    constexpr Preset presets[] = {
        {"plain", "{verdict}\\r\\n"},
        {"pass-fail", "{pass}\\r\\n"},
        {"stx-etx", "\\x02{seq:6};{verdict}\\x03\\r\\n"},
        {"csv", "{seq},{job},{verdict},{parts},{why}\\r\\n"},
        {"code", "{verdict},{code}\\r\\n"},
    };
    for (const Preset& preset : presets) {
        std::ptrdiff_t k = 0;
        while (k < name.size() && preset.name[k] != '\0' && name[k] == preset.name[k]) ++k;
        if (k == name.size() && preset.name[k] == '\0') return preset.text;
    }
    return nullptr;
}

}  // namespace fovea::apps
