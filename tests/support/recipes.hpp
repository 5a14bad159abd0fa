// SPDX-License-Identifier: MIT
//
// Random recipes within their ranges, and whether two are the same. Host tests only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/decision/recipe_range.hpp>
#include <fovea/measure/edge_probe.hpp>
#include <fovea/morphology/morphology.hpp>

namespace fovea::test {

template <std::size_t N>
void set_name(char (&name)[N], const std::string& text) {
    for (std::size_t i = 0; i < N; ++i) name[i] = i < text.size() && i + 1 < N ? text[i] : '\0';
}
template <std::size_t N>
std::string name_text(const char (&name)[N]) {
    const Span<const char> span = name_of(name);
    return {span.data(), static_cast<std::size_t>(span.size())};
}

/// A number low..high, the ends more often than others.
inline std::int64_t between(Random& random, std::int64_t low, std::int64_t high) {
    const std::uint32_t kind = random.below(8);
    if (kind == 0) return low;
    if (kind == 1) return high;
    const std::uint64_t draw = std::uint64_t{random.next()} << 32 | random.next();
    return low + static_cast<std::int64_t>(draw % static_cast<std::uint64_t>(high - low + 1));
}

/// 1 to 31 bytes that need care: quotes, backslashes, brackets, letters of two to four bytes.
inline std::string random_name(Random& random) {
    static const std::vector<std::string> pieces = {"a",
                                                    "Z",
                                                    "0",
                                                    "_",
                                                    " ",
                                                    "\"",
                                                    "\\",
                                                    "#",
                                                    "[",
                                                    "]",
                                                    "=",
                                                    "'",
                                                    "\\n",
                                                    "\\u0041",
                                                    "\xc3\x98",
                                                    "\xe2\x82\xac",
                                                    "\xf0\x9f\x98\x80",
                                                    "\xef\xbf\xbd"};
    std::string name;
    const int wanted = random.between(1, Feature::max_name);
    for (int tries = 0; tries < 64 && static_cast<int>(name.size()) < wanted; ++tries) {
        const std::string& piece = pieces[random.below(static_cast<std::uint32_t>(pieces.size()))];
        if (name.size() + piece.size() <= static_cast<std::size_t>(Feature::max_name)) name += piece;
    }
    return name;
}

inline PartPoint random_point(Random& random) {
    return {between(random, -max_part_coordinate, max_part_coordinate),
            between(random, -max_part_coordinate, max_part_coordinate)};
}

/// A feature of a kind with only those members set that belong to it.
inline Feature random_feature(Random& random, FeatureKind kind) {
    Feature feature;
    feature.kind = kind;
    const auto is = [&](auto... kinds) { return ((kind == kinds) || ...); };
    using K = FeatureKind;
    if (is(K::distance, K::width, K::angle)) {
        feature.from = random_point(random);
        feature.to = random_point(random);
    }
    if (is(K::angle)) {
        feature.second_from = random_point(random);
        feature.second_to = random_point(random);
    }
    if (is(K::diameter, K::hole_diameter, K::position)) feature.centre = random_point(random);
    if (is(K::diameter)) feature.radius = between(random, 1, max_part_coordinate);
    if (is(K::diameter, K::hole_diameter, K::position, K::angle))
        feature.search = between(random, 1, max_part_coordinate);
    if (is(K::distance, K::width)) feature.lines = static_cast<int>(between(random, 1, max_probe_lines));
    if (is(K::diameter, K::hole_diameter, K::angle))
        feature.probes = static_cast<int>(between(random, 3, Feature::max_probes));
    if (is(K::distance, K::width, K::diameter, K::hole_diameter, K::angle)) {
        feature.contrast_min = static_cast<int>(between(random, 0, 255));
        feature.smoothing = static_cast<int>(between(random, 1, max_probe_smoothing));
    }
    if (is(K::distance)) {
        do {
            feature.first_edge = static_cast<int>(between(random, -64, 64));
            feature.second_edge = static_cast<int>(between(random, -64, 64));
        } while (feature.first_edge == 0 || feature.second_edge == 0 ||
                 feature.first_edge == feature.second_edge);
    }
    feature.tolerance.nominal.millionths = between(random, -max_part_coordinate, max_part_coordinate);
    feature.tolerance.minus.millionths = between(random, 0, max_part_coordinate);
    feature.tolerance.plus.millionths = between(random, 0, max_part_coordinate);
    return feature;
}

/// A recipe with features of every kind, each value anywhere in its range.
inline Recipe random_recipe(Random& random) {
    Recipe recipe;
    if (random.below(4) != 0) set_name(recipe.name, random_name(random));
    Scale& scale = recipe.scale;
    scale.unit = random.below(2) == 0 ? LengthUnit::pixel : LengthUnit::millimetre;
    scale.x_per_pixel = between(random, min_units_per_pixel, max_units_per_pixel);
    scale.y_per_pixel = between(random, std::max(min_units_per_pixel, (scale.x_per_pixel + 3) / 4),
                                std::min(max_units_per_pixel, scale.x_per_pixel * 4));
    LocateRule& locate = recipe.locate;
    locate.dark_part = random.below(2) == 0;
    locate.threshold = static_cast<ThresholdRule>(random.below(3));
    if (locate.threshold == ThresholdRule::fixed)
        locate.level = static_cast<std::uint8_t>(between(random, 1, 255));
    if (locate.threshold == ThresholdRule::quantile) {
        locate.dark_quantile = between(random, 0, 1000000);
        locate.bright_quantile = between(random, 0, 1000000);
    }
    locate.opening = 2 * static_cast<int>(between(random, 0, (max_element_side - 1) / 2)) + 1;
    locate.area_min = between(random, 1, 67092481);
    locate.area_max = between(random, locate.area_min, 67092481);
    locate.hole_area_min = between(random, 1, 67092481);
    locate.at_border = random.below(2) == 0;
    locate.pose = static_cast<PoseRule>(random.below(2));
    locate.orientation = static_cast<OrientationRule>(random.below(4));
    if (locate.orientation == OrientationRule::rotational)
        locate.symmetry_order = static_cast<int>(between(random, min_symmetry_order, max_symmetry_order));
    if (needs_outline(locate)) locate.pose = PoseRule::outline;
    const auto end = [&] {
        return Ratio::from_raw(static_cast<std::int32_t>(between(random, -4 * Ratio::one, 4 * Ratio::one)));
    };
    if (random.below(4) != 0) locate.ends = {end(), end(), end(), end()};
    std::vector<std::string> names;
    const int count = random.between(1, Recipe::max_features);
    for (int i = 0; i < count; ++i) {
        Feature feature = random_feature(random, static_cast<FeatureKind>(i < 7 ? i : random.between(0, 6)));
        std::string name;
        do name = random_name(random);
        while (std::find(names.begin(), names.end(), name) != names.end());
        names.push_back(name);
        set_name(feature.name, name);
        static_cast<void>(recipe.features.push(feature));
    }
    return recipe;
}

inline bool same(PartPoint a, PartPoint b) { return a.x == b.x && a.y == b.y; }
inline bool same(const Feature& a, const Feature& b) {
    return name_text(a.name) == name_text(b.name) && a.kind == b.kind && same(a.from, b.from) &&
           same(a.to, b.to) && same(a.second_from, b.second_from) && same(a.second_to, b.second_to) &&
           same(a.centre, b.centre) && a.radius == b.radius && a.search == b.search && a.lines == b.lines &&
           a.probes == b.probes && a.smoothing == b.smoothing && a.contrast_min == b.contrast_min &&
           a.first_edge == b.first_edge && a.second_edge == b.second_edge &&
           a.tolerance.nominal == b.tolerance.nominal && a.tolerance.minus == b.tolerance.minus &&
           a.tolerance.plus == b.tolerance.plus;
}
inline bool same(const Recipe& a, const Recipe& b) {
    const LocateRule& p = a.locate;
    const LocateRule& q = b.locate;
    if (name_text(a.name) != name_text(b.name) || a.scale.unit != b.scale.unit ||
        a.scale.x_per_pixel != b.scale.x_per_pixel || a.scale.y_per_pixel != b.scale.y_per_pixel ||
        p.dark_part != q.dark_part || p.threshold != q.threshold || p.level != q.level ||
        p.dark_quantile != q.dark_quantile || p.bright_quantile != q.bright_quantile ||
        p.opening != q.opening || p.area_min != q.area_min || p.area_max != q.area_max ||
        p.hole_area_min != q.hole_area_min || p.at_border != q.at_border || p.pose != q.pose ||
        p.orientation != q.orientation || p.symmetry_order != q.symmetry_order || !(p.ends == q.ends) ||
        a.features.size() != b.features.size())
        return false;
    for (int i = 0; i < a.features.size(); ++i)
        if (!same(a.features[i], b.features[i])) return false;
    return true;
}

}  // namespace fovea::test
