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
    std::vector<std::int64_t> other_areas;  ///< of the regions of another kind in the same pictures
    std::vector<std::string> notes;
    std::string problem;  ///< why there are none
};

/// The parts of one kind in the pictures: the largest region that does not touch a border, and all that are
/// about as large. Without being told, takes the brightness whose regions enclose more.
Samples find_samples(const std::vector<Picture<Gray8>>& images, const std::vector<std::string>& names,
                     std::optional<bool> dark);

/// The rule that finds the samples, and nothing else in their pictures as far as an area can tell.
LocateRule rule_from(const Samples& samples, const Scale& scale);

/// True if a rule takes the ends of the parts for alike though those of single samples are not: they may be
/// of two kinds, or one is turned over.
bool ends_disagree(const Samples& samples, const LocateRule& rule, const Scale& scale);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// What is smaller than this is dirt at first sight.
inline std::int64_t least_area(Size size) { return std::max<std::int64_t>(64, size.area() / 3000); }
inline constexpr std::int64_t least_hole_area = 12;

/// Below this, brightness differs by noise and shading alone; edges are found from 8 levels on.
inline constexpr GrayLevel least_contrast = GrayLevel::from_int(12);

/// Adds every region of an image that may be a part. Answers why there is none, "" if there is.
inline std::string collect_parts(const Picture<Gray8>& image, bool dark, std::vector<Sample>& parts) {
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
    if (status == Status::degenerate) return "all pixels are alike";
    if (status != Status::ok && status != Status::capacity_exceeded) return describe(status);
    if (threshold.contrast < least_contrast)
        return "part and ground differ by " + number(decimal_of(threshold.contrast), 0) +
               " grey levels alone";
    if (region_count == 0) return "nothing in it is large enough and away from its border";
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
    return "";
}

/// Keeps the parts that enclose about as much as the largest.
inline void keep_kind(Samples& samples) {
    std::vector<Sample>& parts = samples.parts;
    std::int64_t largest = 0;
    for (const Sample& part : parts) largest = std::max(largest, part.filled_area());
    const auto others = std::stable_partition(parts.begin(), parts.end(), [&](const Sample& part) {
        return part.filled_area() >= largest * 3 / 4;
    });
    for (auto other = others; other != parts.end(); ++other)
        samples.other_areas.push_back(other->region.moments.area());
    parts.erase(others, parts.end());
}

inline std::int64_t least_part_area(const std::vector<Sample>& parts) {
    std::int64_t least = parts.front().region.moments.area();
    for (const Sample& part : parts) least = std::min(least, part.region.moments.area());
    return least;
}
inline std::int64_t hole_area_min_of(const std::vector<Sample>& parts) {
    return std::max(least_hole_area, least_part_area(parts) / 3000);
}

/// Forgets the holes that the rule takes for dirt.
inline void keep_holes(std::vector<Sample>& parts) {
    if (parts.empty()) return;
    const std::int64_t least = hole_area_min_of(parts);
    for (Sample& part : parts) {
        part.holes.erase(std::remove_if(part.holes.begin(), part.holes.end(),
                                        [&](const Hole& hole) { return hole.moments.area() < least; }),
                         part.holes.end());
        part.region.holes = static_cast<int>(part.holes.size());
        part.region.hole_area = 0;
        for (const Hole& hole : part.holes) part.region.hole_area += hole.moments.area();
    }
}

/// True if most of the border of the images is as bright as the parts: these may be holes in a part that
/// reaches beyond the border.
inline bool looks_like_ground(const std::vector<Sample>& parts) {
    std::int64_t alike = 0;
    std::int64_t other = 0;
    const Picture<Gray8>* seen = nullptr;
    for (const Sample& part : parts) {
        if (part.image == seen) continue;
        seen = part.image;
        const auto view = seen->view();
        const auto count = [&](int x, int y) {
            (part.threshold.part.contains(view(x, y)) ? alike : other) += 1;
        };
        for (int x = 0; x < view.width(); ++x) {
            count(x, 0);
            count(x, view.height() - 1);
        }
        for (int y = 0; y < view.height(); ++y) {
            count(0, y);
            count(view.width() - 1, y);
        }
    }
    return alike > other;
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
        std::vector<bool> has_parts(images.size());
        for (std::size_t i = 0; i < images.size(); ++i) {
            const std::string problem = detail::collect_parts(images[i], tried, found.parts);
            has_parts[i] = problem.empty();
            if (!problem.empty()) found.notes.push_back(names[i] + ": no part found: " + problem);
        }
        detail::keep_kind(found);
        for (std::size_t i = 0; i < images.size(); ++i)
            if (has_parts[i] && std::none_of(found.parts.begin(), found.parts.end(),
                                             [&](const Sample& part) { return part.image == &images[i]; }))
                found.notes.push_back(names[i] +
                                      ": not a sample: nothing in it is about as large as the part");
        detail::keep_holes(found.parts);
        if (best.parts.empty() || detail::enclosed(found.parts) > detail::enclosed(best.parts)) best = found;
    }
    if (best.parts.empty())
        best.problem = "no part found: it must lie whole in the picture, on a ground of another brightness";
    else if (!dark && detail::looks_like_ground(best.parts))
        best.notes.push_back(std::string("most of the border is as ") + (best.dark ? "dark" : "bright") +
                             " as the part; if that is not the part, give --part " +
                             (best.dark ? "bright" : "dark"));
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
    rule.orientation = ends.empty() ? OrientationRule::none : OrientationRule::symmetric;
    if (ends.empty()) return rule;
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
