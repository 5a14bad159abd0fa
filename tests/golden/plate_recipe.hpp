// SPDX-License-Identifier: MIT
//
// A recipe of eight features for the synthetic plate, taught from a picture of it.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/locate.hpp>
#include <fovea/decision/part_frame.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/image/image_view.hpp>
#include <golden/plate.hpp>

namespace fovea::golden {

struct PlateRecipe {
    Status status = Status::not_found;
    Recipe recipe;
    Threshold threshold;
    PartPose pose;
};

inline Feature named_feature(const char* name, FeatureKind kind) {
    Feature feature;
    for (int i = 0; i < Feature::max_name && name[i] != '\0'; ++i) feature.name[i] = name[i];
    feature.kind = kind;
    return feature;
}

/// Places the eight features where the plate has them. Regions and holes hold what was found.
inline PlateRecipe plate_recipe(ImageView<const Gray8> image, const Plate& plate, Span<std::uint8_t> scratch,
                                ListView<Region> regions, ListView<Hole> holes) {
    PlateRecipe made;
    Recipe& recipe = made.recipe;
    recipe.locate.dark_part = plate.dark_part;
    made.status = find_parts(image, recipe.locate, scratch, made.threshold, regions, holes);
    if (made.status != Status::ok) return made;
    if (regions.size() != 1) {
        made.status = Status::not_found;
        return made;
    }
    const Result<PartMoments> moments =
        moments_of(image, recipe.locate, made.threshold.part, regions[0], holes.span(), recipe.scale);
    made.pose = pose_of(*moments, recipe.locate, recipe.scale);
    const Result<Asymmetry> ends = asymmetry(moments->region, made.pose.frame.angle());
    if (ends) recipe.locate.ends = *ends;

    const PartFrame frame = made.pose.frame;
    const auto at = [&](int x, int y) { return frame.to_part(plate.to_image(x, y)); };
    const std::int64_t unit = std::int64_t{1000000} * plate.scale;
    const auto add = [&](Feature feature, std::int64_t nominal) {
        feature.tolerance = {Decimal{nominal}, Decimal{200000}, Decimal{200000}};
        made.status = recipe.features.push(feature);
    };

    Feature length = named_feature("length", FeatureKind::width);
    length.from = at(-44, -10);
    length.to = at(44, -10);
    length.lines = 7;
    add(length, 2 * Plate::half_length * unit);
    Feature height = named_feature("height", FeatureKind::distance);
    height.from = at(0, -22);
    height.to = at(0, 22);
    add(height, 2 * Plate::half_height * unit);
    Feature large = named_feature("large hole", FeatureKind::hole_diameter);
    large.centre = at(Plate::holes[0].x, Plate::holes[0].y);
    large.search = 5 * unit;
    add(large, 2 * Plate::holes[0].radius * unit);
    Feature small = named_feature("small hole", FeatureKind::hole_diameter);
    small.centre = at(Plate::holes[1].x, Plate::holes[1].y);
    small.search = 5 * unit;
    add(small, 2 * Plate::holes[1].radius * unit);
    Feature circle = named_feature("circle", FeatureKind::diameter);
    circle.centre = large.centre;
    circle.radius = Plate::holes[0].radius * unit;
    circle.search = 3 * unit;
    add(circle, 2 * Plate::holes[0].radius * unit);
    Feature corner = named_feature("corner", FeatureKind::angle);
    corner.from = at(-36, Plate::half_height);
    corner.to = at(24, Plate::half_height);
    corner.second_from = at(30, 16);
    corner.second_to = at(38, 11);
    corner.search = 3 * unit;
    corner.probes = 24;
    add(corner, 36869898);
    add(named_feature("holes", FeatureKind::hole_count), 2000000);
    Feature place = named_feature("place", FeatureKind::position);
    place.centre = large.centre;
    place.search = 5 * unit;
    add(place, 0);
    return made;
}

}  // namespace fovea::golden
