// SPDX-License-Identifier: MIT
//
// Whether a picture can be judged, as the daemon sees it: its light, its contrast and its focus.
#pragma once

#include <string>

#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>

#include <daemon/image_quality.hpp>
#include <daemon/settings.hpp>
#include <probe/check.hpp>

namespace fovea::apps {

inline void check_light(ImageView<const Gray8> picture, const Settings::Quality& settings,
                        CheckList& checks) {
    const ImageQualityLimits limits = quality_limits(settings);
    const Result<ImageQuality> measured = image_quality(picture, limits);
    if (!measured)
        return checks.fail("light", describe(measured.status()), "take another mode of the camera");
    const auto percent = [](int thousandths) {
        return std::to_string(thousandths / 10) + "." + std::to_string(thousandths % 10) + " %";
    };
    const std::string figures = ",\"mean\":" + std::to_string(measured->mean) +
                                ",\"dark_permille\":" + std::to_string(measured->dark) +
                                ",\"saturated_permille\":" + std::to_string(measured->saturated) +
                                ",\"contrast\":" + std::to_string(measured->contrast) +
                                ",\"sharpness_permille\":" + std::to_string(measured->sharpness);
    const std::string text = "mean " + std::to_string(measured->mean) + ", " + percent(measured->dark) +
                             " dark, " + percent(measured->saturated) + " saturated, contrast " +
                             std::to_string(measured->contrast) + ", sharpness " +
                             std::to_string(measured->sharpness);
    switch (judge(*measured, limits)) {
        case ImageVerdict::dark:
            return checks.warn("light", text + ": too dark to judge",
                               "take the cap off, switch the light on, or expose longer", figures);
        case ImageVerdict::saturated:
            return checks.warn("light", text + ": too bright to judge",
                               "expose shorter, or less gain or light", figures);
        case ImageVerdict::covered:
            return checks.warn("light", text + ": nothing stands out",
                               "look at the light and at what is in front of the lens", figures);
        case ImageVerdict::defocused:
            return checks.warn("light", text + ": no edge is sharp", "turn the lens until it is in focus",
                               figures);
        case ImageVerdict::fine: return checks.ok("light", text, figures);
    }
}

}  // namespace fovea::apps
