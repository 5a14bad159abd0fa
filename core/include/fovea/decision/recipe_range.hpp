// SPDX-License-Identifier: MIT
//
// The ranges of what stands in a recipe: within them no sum of the gauge leaves its bits.
#pragma once

#include <cstdint>

#include <fovea/decision/recipe.hpp>
#include <fovea/decision/tolerance.hpp>
#include <fovea/measure/edge_probe.hpp>
#include <fovea/measure/half_turn.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/statistics/polygon_symmetry.hpp>

namespace fovea {

/// True for a rule that asks for the symmetry of a part with its holes in an image that was opened, where the
/// holes are others than in the image.
constexpr bool needs_outline(const LocateRule& rule) {
    return rule.orientation == OrientationRule::rotational && rule.opening > 1 &&
           rule.pose != PoseRule::outline;
}

/// True if a scale can be used: both positive, within their bounds, and none more than four times the other.
constexpr bool scale_in_range(const Scale& scale) {
    const auto in_range = [](std::int64_t value) {
        return value >= min_units_per_pixel && value <= max_units_per_pixel;
    };
    return in_range(scale.x_per_pixel) && in_range(scale.y_per_pixel) &&
           scale.x_per_pixel <= 4 * scale.y_per_pixel && scale.y_per_pixel <= 4 * scale.x_per_pixel;
}

namespace detail {

constexpr bool within(std::int64_t value, std::int64_t low, std::int64_t high) {
    return value >= low && value <= high;
}

/// Ends within this keep the sums of half_turn() far inside 64 bits.
inline constexpr Ratio most_asymmetry = Ratio::from_int(4);

constexpr bool rule_in_range(const LocateRule& rule) {
    const auto share = [](std::int64_t millionths) { return within(millionths, 0, 1000000); };
    const auto end = [](Ratio value) {
        return within(value.raw(), -most_asymmetry.raw(), most_asymmetry.raw());
    };
    return rule.threshold <= ThresholdRule::quantile && rule.pose <= PoseRule::outline &&
           rule.orientation <= OrientationRule::none && share(rule.dark_quantile) &&
           share(rule.bright_quantile) && rule.opening >= 1 && rule.opening % 2 == 1 &&
           rule.opening <= max_element_side && rule.area_min >= 0 && rule.area_min <= rule.area_max &&
           rule.hole_area_min >= 0 && !needs_outline(rule) &&
           within(rule.symmetry_order, min_symmetry_order, max_symmetry_order) && end(rule.ends.sss) &&
           end(rule.ends.sst) && end(rule.ends.stt) && end(rule.ends.ttt);
}

/// Whether every field is in its range, also those that the kind does not use.
constexpr bool feature_in_range(const Feature& feature) {
    const auto length = [](std::int64_t value) { return within(value, 0, max_part_coordinate); };
    const auto place = [](PartPoint p) {
        return within(p.x, -max_part_coordinate, max_part_coordinate) &&
               within(p.y, -max_part_coordinate, max_part_coordinate);
    };
    const Tolerance& tolerance = feature.tolerance;
    return place(feature.from) && place(feature.to) && place(feature.second_from) &&
           place(feature.second_to) && place(feature.centre) && length(feature.radius) &&
           length(feature.search) && within(feature.lines, 1, max_probe_lines) &&
           within(feature.probes, 3, Feature::max_probes) && within(feature.outliers, 0, 50) &&
           within(feature.smoothing, 1, max_probe_smoothing) && within(feature.contrast_min, 0, 255) &&
           within(tolerance.nominal.millionths, -max_part_coordinate, max_part_coordinate) &&
           length(tolerance.minus.millionths) && length(tolerance.plus.millionths);
}

}  // namespace detail
}  // namespace fovea
