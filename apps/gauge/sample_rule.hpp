// SPDX-License-Identifier: MIT
//
// The rule that finds the good parts of the pictures again: what area they have, and what says how they lie.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <fovea/decision/locate.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/measure/half_turn.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/statistics/moments.hpp>
#include <fovea/statistics/polygon_symmetry.hpp>

#include <gauge/samples.hpp>

namespace fovea::apps {

/// The rule that finds the samples, and nothing else in their pictures as far as an area can tell.
LocateRule rule_from(const Samples& samples, const Scale& scale);

/// True if a rule takes the ends of the parts for alike though those of single samples are not: they may be
/// of two kinds, or one is turned over.
bool ends_disagree(const Samples& samples, const LocateRule& rule, const Scale& scale);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The third moments of every sample in the frame of its axis; none if one of them has no clear axis.
inline std::vector<Asymmetry> ends_of(const Samples& samples, const Scale& scale) {
    std::vector<Asymmetry> ends;
    for (const Sample& part : samples.parts) {
        const Result<Orientation> axis = orientation(stretched(part.moments.frame, aspect_of(scale)));
        if (!axis || axis->elongation < Ratio::from_ratio(1, 25)) return {};
        const Result<Asymmetry> each =
            asymmetry(stretched(part.moments.region, aspect_of(scale)), axis->axis);
        if (!each) return {};
        ends.push_back(*each);
    }
    return ends;
}

/// The least strength of the symmetry of all samples under a rule, in millionths; 0 if one has none.
inline std::int64_t strength_of(const Samples& samples, const LocateRule& rule, const Scale& scale) {
    std::int64_t least = 1000000;
    for (const Sample& part : samples.parts) {
        const Result<PartMoments> moments = part.moments_under(rule, scale);
        if (!moments || !moments->symmetry) return 0;
        const std::int64_t strength = moments->symmetry->strength.raw();
        least = std::min(least, round_shift(strength * 1000000, Ratio::fraction_bits));
    }
    return least;
}

/// The order by which all samples repeat themselves under a pose rule; 0 if none stands out.
inline int order_of(const Samples& samples, LocateRule rule, const Scale& scale) {
    std::int64_t strengths[max_symmetry_order + 1] = {};
    for (int order = min_symmetry_order; order <= max_symmetry_order; ++order) {
        rule.symmetry_order = order;
        strengths[order] = strength_of(samples, rule, scale);
    }
    // A part that repeats itself has its own order and multiples of it, of which one may be stronger: a
    // hexagon with three holes. A nick has all orders alike.
    const auto stands_out = [&](int order) {
        if (strengths[order] * Ratio::one <= 2 * std::int64_t{least_symmetry.raw()} * 1000000) return false;
        for (int other = min_symmetry_order; other <= max_symmetry_order; ++other)
            if (other % order != 0 && strengths[other] * 2 > strengths[order]) return false;
        return true;
    };
    for (int order = min_symmetry_order; order <= max_symmetry_order; ++order)
        if (stands_out(order)) return order;
    return 0;
}

/// Directs a rule by the symmetry that all samples have, in their outline or, where they have less of it,
/// with their holes; by none if no order stands out.
inline void use_symmetry(const Samples& samples, const Scale& scale, LocateRule& rule) {
    rule.orientation = OrientationRule::rotational;
    int order = order_of(samples, rule, scale);
    if (rule.pose == PoseRule::outline) {
        LocateRule by_region = rule;
        by_region.pose = PoseRule::region;
        const int with_holes = order_of(samples, by_region, scale);
        if (with_holes != 0 && (order == 0 || (with_holes < order && order % with_holes == 0))) {
            rule.pose = PoseRule::region;
            order = with_holes;
        }
    }
    if (order != 0) {
        rule.symmetry_order = order;
    } else {
        rule.orientation = OrientationRule::none;
    }
}

}  // namespace detail

inline bool ends_disagree(const Samples& samples, const LocateRule& rule, const Scale& scale) {
    if (rule.orientation != OrientationRule::symmetric) return false;
    const std::vector<Asymmetry> ends = detail::ends_of(samples, scale);
    // Twice what can decide at all.
    return std::any_of(ends.begin(), ends.end(), [](const Asymmetry& each) {
        const auto square = [](Ratio ratio) { return std::int64_t{ratio.raw()} * ratio.raw(); };
        return square(each.sss) + square(each.sst) + square(each.stt) + square(each.ttt) >
               4 * square(least_asymmetry);
    });
}

inline LocateRule rule_from(const Samples& samples, const Scale& scale) {
    LocateRule rule;
    rule.dark_part = samples.dark;
    rule.pose = samples.pose;
    const std::int64_t least = detail::least_part_area(samples.parts);
    std::int64_t most = least;
    for (const Sample& part : samples.parts) most = std::max(most, part.region.moments.area());
    rule.area_min = std::max<std::int64_t>(least * 3 / 4, 1);
    rule.area_max = std::min(most * 5 / 4, LocateRule().area_max);
    // Halfway to what else is in the pictures, where that is nearer.
    for (const std::int64_t other : samples.other_areas) {
        if (other < least) rule.area_min = std::max(rule.area_min, (other + least + 1) / 2);
        if (other > most) rule.area_max = std::min(rule.area_max, (other + most) / 2);
    }
    rule.hole_area_min = detail::hole_area_min_of(samples.parts);

    // The axis must be clear on every sample, and the ends must follow from their common third moments.
    const std::vector<Asymmetry> ends = detail::ends_of(samples, scale);
    if (ends.empty()) {
        detail::use_symmetry(samples, scale, rule);
        return rule;
    }
    rule.orientation = OrientationRule::symmetric;
    std::int64_t sums[4] = {0, 0, 0, 0};
    for (const Asymmetry& each : ends) {
        // The first sample says which end is the front.
        const std::int64_t along = std::int64_t{each.sss.raw()} * ends[0].sss.raw() +
                                   std::int64_t{each.sst.raw()} * ends[0].sst.raw() +
                                   std::int64_t{each.stt.raw()} * ends[0].stt.raw() +
                                   std::int64_t{each.ttt.raw()} * ends[0].ttt.raw();
        const std::int64_t sign = along < 0 ? -1 : 1;
        const Ratio parts[] = {each.sss, each.sst, each.stt, each.ttt};
        for (int i = 0; i < 4; ++i) sums[i] += sign * parts[i].raw();
    }
    const auto mean = [&](int i) {
        // In whole millionths, as the recipe file holds it.
        const std::int64_t millionths =
            round_divide(sums[i] * 1000000, static_cast<std::int64_t>(ends.size()) * Ratio::one);
        return Ratio::from_ratio(millionths, 1000000);
    };
    const Asymmetry common{mean(0), mean(1), mean(2), mean(3)};
    for (const Asymmetry& each : ends)
        if (!half_turn(each, common)) return rule;
    rule.orientation = OrientationRule::full;
    rule.ends = common;
    return rule;
}

}  // namespace fovea::apps
