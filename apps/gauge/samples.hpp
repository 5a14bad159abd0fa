// SPDX-License-Identifier: MIT
//
// Samples: the good parts in the pictures that a recipe is taught from, and the rule that finds them again.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>

#include <common/picture_file.hpp>
#include <common/text.hpp>

namespace fovea::apps {

/// One good part.
struct Sample {
    const Picture<Gray8>* image = nullptr;
    Region region;
    std::vector<Hole> holes;  ///< its own
    Threshold threshold;
    PartMoments moments;
    FineAngle axis;  ///< in the image as it is
    std::int64_t filled_area() const { return region.moments.area() + region.hole_area; }
};

struct Samples {
    std::vector<Sample> parts;
    bool dark = true;
    PoseRule pose =
        PoseRule::region;  ///< the outline where there are holes, so that these do not move the frame
    std::vector<std::string> notes;
    std::string problem;  ///< why there are none
};

/// The parts of one kind in the pictures: the largest region that does not touch a border, and all that are
/// about as large. Without being told, takes the brightness whose regions enclose more.
Samples find_samples(const std::vector<Picture<Gray8>>& images, const std::vector<std::string>& names,
                     std::optional<bool> dark);

/// The rule that finds the samples.
LocateRule rule_from(const Samples& samples, const Scale& scale);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// What is smaller than this is dirt at first sight.
inline std::int64_t least_area(Size size) { return std::max<std::int64_t>(64, size.area() / 3000); }
inline constexpr std::int64_t least_hole_area = 12;

/// Adds every region of an image that may be a part.
inline Status collect_parts(const Picture<Gray8>& image, bool dark, std::vector<Sample>& parts) {
    LocateRule rule;
    rule.dark_part = dark;
    rule.area_min = least_area(image.size);
    rule.hole_area_min = least_hole_area;
    constexpr int most_regions = 1024;
    constexpr int most_holes = 8192;
    std::vector<Region> regions(most_regions);
    std::vector<Hole> holes(most_holes);
    int region_count = 0;
    int hole_count = 0;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(find_parts_scratch(image.size, rule)));
    Threshold threshold;
    const Status status =
        find_parts(image.view(), rule, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                   threshold, ListView<Region>(regions.data(), most_regions, &region_count),
                   ListView<Hole>(holes.data(), most_holes, &hole_count));
    if (status != Status::ok && status != Status::capacity_exceeded) return status;
    for (int i = 0; i < region_count; ++i) {
        Sample sample;
        sample.image = &image;
        sample.region = regions[static_cast<std::size_t>(i)];
        sample.threshold = threshold;
        for (int k = 0; k < hole_count; ++k) {
            Hole hole = holes[static_cast<std::size_t>(k)];
            if (hole.region != sample.region.number) continue;
            hole.region = 0;
            sample.holes.push_back(hole);
        }
        sample.region.number = 0;
        parts.push_back(sample);
    }
    return Status::ok;
}

/// Keeps the parts that enclose about as much as the largest.
inline void keep_kind(std::vector<Sample>& parts) {
    std::int64_t largest = 0;
    for (const Sample& part : parts) largest = std::max(largest, part.filled_area());
    parts.erase(std::remove_if(parts.begin(), parts.end(),
                               [&](const Sample& part) { return part.filled_area() < largest * 3 / 4; }),
                parts.end());
}

inline std::int64_t enclosed(const std::vector<Sample>& parts) {
    std::int64_t sum = 0;
    for (const Sample& part : parts) sum += part.filled_area();
    return sum;
}

}  // namespace detail

inline Samples find_samples(const std::vector<Picture<Gray8>>& images, const std::vector<std::string>& names,
                            std::optional<bool> dark) {
    Samples best;
    for (const bool tried : {true, false}) {
        if (dark && *dark != tried) continue;
        Samples found;
        found.dark = tried;
        for (std::size_t i = 0; i < images.size(); ++i) {
            const std::size_t before = found.parts.size();
            const Status status = detail::collect_parts(images[i], tried, found.parts);
            if (status != Status::ok) found.notes.push_back(names[i] + ": " + describe(status));
            if (found.parts.size() == before) found.notes.push_back(names[i] + ": no part found in it");
        }
        detail::keep_kind(found.parts);
        if (best.parts.empty() || detail::enclosed(found.parts) > detail::enclosed(best.parts)) best = found;
    }
    if (best.parts.empty())
        best.problem = "no part found: it must lie whole in the picture, on a ground of another brightness";
    for (const Sample& part : best.parts)
        if (!part.holes.empty()) best.pose = PoseRule::outline;
    for (Sample& part : best.parts) {
        LocateRule rule;
        rule.pose = best.pose;
        const Result<PartMoments> moments =
            moments_of(part.image->view(), rule, part.threshold.part, part.region,
                       {part.holes.data(), static_cast<std::ptrdiff_t>(part.holes.size())});
        if (moments) part.moments = *moments;
        const Result<Orientation> axis = orientation(part.moments.frame);
        if (axis) part.axis = axis->axis;
    }
    return best;
}

inline LocateRule rule_from(const Samples& samples, const Scale& scale) {
    LocateRule rule;
    rule.dark_part = samples.dark;
    rule.pose = samples.pose;
    std::int64_t least = samples.parts.front().region.moments.area();
    std::int64_t most = least;
    for (const Sample& part : samples.parts) {
        least = std::min(least, part.region.moments.area());
        most = std::max(most, part.region.moments.area());
    }
    rule.area_min = least * 3 / 4;
    rule.area_max = most * 5 / 4;
    rule.hole_area_min = std::max(detail::least_hole_area, least / 3000);

    // The axis must be clear on every sample, and the ends must follow from their common third moments.
    std::vector<Asymmetry> ends;
    for (const Sample& part : samples.parts) {
        const Result<Orientation> axis = orientation(stretched(part.moments.frame, aspect_of(scale)));
        if (!axis || axis->elongation < Ratio::from_ratio(1, 25)) {
            rule.orientation = OrientationRule::none;
            return rule;
        }
        const Result<Asymmetry> each =
            asymmetry(stretched(part.moments.region, aspect_of(scale)), axis->axis);
        if (each) ends.push_back(*each);
    }
    rule.orientation = OrientationRule::symmetric;
    if (ends.size() != samples.parts.size()) return rule;
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
