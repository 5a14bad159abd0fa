// SPDX-License-Identifier: MIT
//
// What a picture holds beside the parts that were measured: regions of a part's brightness that touch the
// border, or are too small or too large. What is below a quarter of area_min is dirt.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/decision/locate.hpp>
#include <fovea/decision/recipe.hpp>

#include <common/picture_file.hpp>

namespace fovea::apps {

/// The regions that are neither parts nor dirt, each kind with its largest first.
struct LeftOut {
    std::vector<Region> at_border;  ///< touch the border, and the rule does not take such
    std::vector<Region> too_small;  ///< below area_min
    std::vector<Region> too_large;  ///< above area_max

    std::size_t count() const { return at_border.size() + too_small.size() + too_large.size(); }
};

/// Of a picture with very many regions only the largest are looked at.
inline constexpr int max_left_out = 4096;

/// Finds the regions of a picture that a rule leaves out. None where part and ground cannot be told apart.
LeftOut left_out_of(const Picture<Gray8>& image, const LocateRule& rule);

/// "not measured: 1 dark region of 24248 px at the border, 2 above `area_max`, the largest of 31000 px"; ""
/// if nothing was left out.
std::string left_out_note(const LeftOut& left_out, const LocateRule& rule);

/// Why an image has no judged part, for people: what find_parts() answered, and what is there instead.
std::string no_part_problem(const Picture<Gray8>& image, const LocateRule& rule, Status status);

/// With less between the means of part and ground, in grey levels, there may be neither: noise of a deviation
/// of 7 is cut into two halves that are as far apart.
inline constexpr GrayLevel little_contrast = GrayLevel::from_int(12);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// What is of the part's brightness, whatever its area.
struct RegionsFound {
    Threshold threshold;
    std::vector<Region> regions;  ///< the largest first
};

/// The largest regions of at least area_min, with those at the border or without.
inline RegionsFound regions_of(const Picture<Gray8>& image, LocateRule rule, std::int64_t area_min,
                               bool at_border, int most) {
    rule.area_min = area_min;
    rule.area_max = LocateRule().area_max;
    rule.hole_area_min = LocateRule().area_max;  // holes do not matter here
    rule.at_border = at_border;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(find_parts_scratch(image.size, rule)));
    RegionsFound found;
    found.regions.resize(static_cast<std::size_t>(most));
    int count = 0;
    int holes = 0;
    Hole hole;
    // A full list keeps the largest; after an error it is empty.
    static_cast<void>(find_parts(
        image.view(), rule, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, found.threshold,
        ListView<Region>(found.regions.data(), most, &count), ListView<Hole>(&hole, 1, &holes)));
    found.regions.resize(static_cast<std::size_t>(count));
    std::stable_sort(found.regions.begin(), found.regions.end(),
                     [](const Region& a, const Region& b) { return a.moments.area() > b.moments.area(); });
    return found;
}

inline std::int64_t largest_area(const std::vector<Region>& regions) {
    return regions.empty() ? 0 : regions.front().moments.area();
}
inline std::string pixels(std::int64_t area) { return std::to_string(area) + " px"; }
inline const char* brightness(const LocateRule& rule) { return rule.dark_part ? "dark" : "bright"; }

}  // namespace detail

inline LeftOut left_out_of(const Picture<Gray8>& image, const LocateRule& rule) {
    LeftOut left_out;
    const std::int64_t least = std::max<std::int64_t>(rule.area_min / 4, 1);
    for (const Region& region : detail::regions_of(image, rule, least, true, max_left_out).regions) {
        const std::int64_t area = region.moments.area();
        if (region.at_border && !rule.at_border)
            left_out.at_border.push_back(region);
        else if (area < rule.area_min)
            left_out.too_small.push_back(region);
        else if (area > rule.area_max)
            left_out.too_large.push_back(region);
    }
    return left_out;
}

inline std::string left_out_note(const LeftOut& left_out, const LocateRule& rule) {
    std::string text;
    const auto add = [&](const std::vector<Region>& regions, const std::string& where) {
        if (regions.empty()) return;
        const std::string area = detail::pixels(detail::largest_area(regions));
        const std::string region =
            text.empty() ? std::string(" ") + detail::brightness(rule) + " region" : "";
        text += (text.empty() ? "not measured: " : ", ") + std::to_string(regions.size()) + region;
        if (regions.size() == 1)
            text += " of " + area + " " + where;
        else
            text += (region.empty() ? " " : "s ") + where + " (the largest of " + area + ")";
    };
    add(left_out.at_border, "at the border");
    add(left_out.too_small, "below `area_min`");
    add(left_out.too_large, "above `area_max`");
    return text;
}

inline std::string no_part_problem(const Picture<Gray8>& image, const LocateRule& rule, Status status) {
    if (status == Status::degenerate)
        return std::string("part and ground cannot be told apart: all pixels are ") +
               (rule.threshold == ThresholdRule::otsu ? "alike" : "on one side of the threshold");
    if (status != Status::ok) return describe(status);
    const detail::RegionsFound any = detail::regions_of(image, rule, 1, true, 1);
    const std::int64_t largest = detail::largest_area(any.regions);
    const std::int64_t whole =
        rule.at_border ? largest : detail::largest_area(detail::regions_of(image, rule, 1, false, 1).regions);
    const std::string kind = detail::brightness(rule);
    std::string text = "no part found: ";
    if (any.threshold.contrast < little_contrast)
        return text + "part and ground differ by " + number(decimal_of(any.threshold.contrast), 1) +
               " grey levels alone; the picture may be empty or dark";
    if (largest == 0) return text + "`opening` clears everything that is " + kind;
    if (whole < rule.area_min && largest > whole)
        return text + "the largest " + kind + " region, " + detail::pixels(largest) +
               ", touches the border; does the part lie whole in the picture, is `part` right, is the light "
               "even?";
    text += "the largest " + kind + " region has " + detail::pixels(whole);
    if (whole < rule.area_min) return text + ", and `area_min` is " + std::to_string(rule.area_min);
    return text + ", and `area_max` is " + std::to_string(rule.area_max);
}

}  // namespace fovea::apps
