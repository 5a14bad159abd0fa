// SPDX-License-Identifier: MIT
//
// The tolerance that teaching proposes for a feature, from what the good parts differ by.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fovea/decision/recipe.hpp>

#include <common/text.hpp>
#include <gauge/recipe_schema.hpp>
#include <gauge/report.hpp>

namespace fovea::apps {

/// The mean of some values, and how far the farthest is from it.
struct Spread {
    std::int64_t mean = 0;
    std::int64_t farthest = 0;
};
Spread spread_of(const std::vector<std::int64_t>& values);

/// Half a pixel, or three times what the good parts differ by, and of an angle half a degree at least; of a
/// length what was asked for, if it was; of a count nothing.
Tolerance proposed_tolerance(const Feature& feature, const Scale& scale, const Spread& spread,
                             std::optional<std::int64_t> asked);

/// True if parts that differ so are not of one kind: by more than an eighth of a length, or 10 degrees.
bool too_wide(const Feature& feature, const Spread& spread);

/// What to say if good parts differ by more than half a pixel or 2 degrees, or by more than was asked for.
/// "" if they do not.
std::string spread_note(const Feature& feature, const Scale& scale, const Spread& spread,
                        std::optional<std::int64_t> asked);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline bool is_length(const Feature& feature) {
    return feature.kind != FeatureKind::angle && feature.kind != FeatureKind::hole_count;
}
inline std::int64_t pixel_of(const Scale& scale) { return std::max(scale.x_per_pixel, scale.y_per_pixel); }

}  // namespace detail

inline Spread spread_of(const std::vector<std::int64_t>& values) {
    if (values.empty()) return {};
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    std::int64_t sum = 0;
    for (const std::int64_t value : values) sum += value;
    const std::int64_t mean = round_divide(sum, static_cast<std::int64_t>(values.size()));
    return {mean, std::max(*most - mean, mean - *least)};
}

inline Tolerance proposed_tolerance(const Feature& feature, const Scale& scale, const Spread& spread,
                                    std::optional<std::int64_t> asked) {
    std::int64_t step = 1;  // of the last place that is shown
    for (int i = places_of(feature, scale); i < 6; ++i) step *= 10;
    const auto up = [&](std::int64_t value) { return (value + step - 1) / step * step; };
    const std::int64_t nominal = round_divide(spread.mean, step) * step;
    if (feature.kind == FeatureKind::hole_count) return {{nominal}, {}, {}};
    const std::int64_t least = feature.kind == FeatureKind::angle ? 500000 : detail::pixel_of(scale) / 2;
    std::int64_t wide = up(std::max(least, 3 * spread.farthest));
    if (detail::is_length(feature) && asked) wide = *asked;
    if (feature.kind == FeatureKind::position) return {{}, {}, {up(spread.mean) + wide}};
    return {{nominal}, {wide}, {wide}};
}

inline bool too_wide(const Feature& feature, const Spread& spread) {
    if (feature.kind == FeatureKind::position || feature.kind == FeatureKind::hole_count) return false;
    return spread.farthest > (feature.kind == FeatureKind::angle ? 10000000 : spread.mean / 8);
}

inline std::string spread_note(const Feature& feature, const Scale& scale, const Spread& spread,
                               std::optional<std::int64_t> asked) {
    const bool given = detail::is_length(feature) && asked;
    const std::int64_t most = given                        ? *asked
                              : detail::is_length(feature) ? detail::pixel_of(scale) / 2
                                                           : 2000000;
    if (spread.farthest <= most) return "";
    const std::string unit = unit_of(feature, scale);
    return detail::text_of(feature.name) + " differs by up to " +
           number(Decimal{spread.farthest}, places_of(feature, scale)) + (unit.empty() ? "" : " " + unit) +
           " from the mean of what was measured; " +
           (too_wide(feature, spread) ? "it is left out: is all of this one kind of part?"
            : given                   ? "that is more than --tolerance"
                                      : "its tolerance follows from that");
}

}  // namespace fovea::apps
