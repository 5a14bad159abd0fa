// SPDX-License-Identifier: MIT
//
// Whether a picture has the light to be judged: plain figures of one frame.
#pragma once

#include <cstdint>
#include <string>

#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/statistics/histogram.hpp>

#include <daemon/settings.hpp>
#include <probe/check.hpp>

namespace fovea::apps {

/// Shares are in tenths of a per cent.
struct Light {
    int mean = 0;
    int dark = 0;       ///< below level 16
    int saturated = 0;  ///< above level 250
    int contrast = 0;   ///< between the levels of the darkest and of the brightest hundredth
};

inline Light light_of(ImageView<const Gray8> picture) {
    Histogram histogram;
    Light light;
    if (histogram_of(picture, histogram) != Status::ok) return light;
    const std::int64_t area = picture.size().area();
    std::int64_t sum = 0, dark = 0, bright = 0, seen = 0;
    int low = -1, high = 0;
    for (int level = 0; level < Histogram::levels; ++level) {
        const auto count = static_cast<std::int64_t>(histogram[level]);
        sum += count * level;
        if (level < 16) dark += count;
        if (level > 250) bright += count;
        seen += count;
        if (low < 0 && seen * 100 >= area) low = level;
        if (count > 0 && (seen - count) * 100 < area * 99) high = level;
    }
    light.mean = static_cast<int>(round_divide(sum, area));
    light.dark = static_cast<int>(round_divide(dark * 1000, area));
    light.saturated = static_cast<int>(round_divide(bright * 1000, area));
    light.contrast = high - low;
    return light;
}

inline void check_light(const Light& light, const Settings::Quality& limits, CheckList& checks) {
    const auto percent = [](int tenths) {
        return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " %";
    };
    const std::string figures = ",\"mean\":" + std::to_string(light.mean) +
                                ",\"dark_permille\":" + std::to_string(light.dark) +
                                ",\"saturated_permille\":" + std::to_string(light.saturated) +
                                ",\"contrast\":" + std::to_string(light.contrast);
    const std::string text = "mean " + std::to_string(light.mean) + ", " + percent(light.dark) + " dark, " +
                             percent(light.saturated) + " saturated, contrast " +
                             std::to_string(light.contrast);
    if (light.dark >= limits.dark_percent * 10)
        checks.warn("light", text + ": too dark to judge",
                    "take the cap off, switch the light on, or expose longer", figures);
    else if (light.saturated >= limits.saturated_percent * 10)
        checks.warn("light", text + ": too bright to judge", "expose shorter, or less gain or light",
                    figures);
    else if (light.contrast < limits.contrast)
        checks.warn("light", text + ": nothing stands out",
                    "look at focus, light and what is in front of the lens", figures);
    else
        checks.ok("light", text, figures);
}

}  // namespace fovea::apps
