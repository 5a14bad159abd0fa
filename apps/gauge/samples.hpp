// SPDX-License-Identifier: MIT
//
// Samples: the good parts in the pictures that a recipe is taught from.
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
    std::int64_t filled_area() const { return region.moments.area() + region.hole_area; }
    Result<PartMoments> moments_under(const LocateRule& rule, const Scale& scale) const {
        return moments_of(image->view(), rule, threshold.part, region,
                          {holes.data(), static_cast<std::ptrdiff_t>(holes.size())}, scale);
    }
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
        const Result<PartMoments> moments = part.moments_under(rule, Scale());
        if (moments) part.moments = *moments;
    }
    return best;
}

}  // namespace fovea::apps
