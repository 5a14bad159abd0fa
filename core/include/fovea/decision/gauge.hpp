// SPDX-License-Identifier: MIT
//
// Gauging: finds the parts in an image, measures every feature of a recipe on each of them and judges. Book
// ch. 6.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/locate.hpp>
#include <fovea/decision/measure_feature.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/decision/recipe_range.hpp>
#include <fovea/decision/tolerance.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/workers.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/segment/connected_components.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What became of one feature of one part. measurement counts only where status is ok.
struct FeatureResult {
    Status status = Status::not_found;
    Verdict verdict = Verdict::unmeasured;
    Measurement measurement;
};

/// One part: where it lies, what was measured, and the verdict.
struct PartResult {
    PartPose pose;
    std::int64_t area = 0;  ///< pixels
    Rectangle box;
    int holes = 0;
    Verdict verdict = Verdict::unmeasured;
    int feature_count = 0;
    FeatureResult features[Recipe::max_features];
};

/// Scratch bytes for gauge() with room for so many parts and with so many workers.
constexpr std::int64_t gauge_scratch(Size size, const LocateRule& rule, int parts, int workers = 1);

/// Measures every part in an image.
///
/// A part whose orientation is not certain is listed, with its features unmeasured but for the number of
/// holes: its probes would stand anywhere. So is a feature whose probes leave the image or meet no edge, and
/// with the status irregular a circle that is not round, and a distance or width that would be OK but whose
/// edges are not straight. Nothing unmeasured is ever OK.
///
/// Shapes   image 1x1 to max_moment_side squared
/// Order    parts by their first pixel, row by row; features as in the recipe
/// Scratch  gauge_scratch(), undefined afterwards
/// Errors   as find_parts(); bad_argument also for a scale out of its range; no part at all is ok with an
///          empty list; capacity_exceeded leaves the largest parts in the list, measured
/// Source   book sec. 6.2
inline Status gauge(ImageView<const Gray8> image, RecipeView recipe, Span<std::uint8_t> scratch,
                    ListView<PartResult> parts);
/// The same by several workers, see OneWorker: rows of the image in pieces, then part by part. The scratch is
/// more, the result the same.
template <class Workers>
Status gauge(ImageView<const Gray8> image, RecipeView recipe, Span<std::uint8_t> scratch,
             ListView<PartResult> parts, const Workers& workers);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Room for holes: a few for each part.
constexpr int gauge_holes(int parts) { return 16 * parts; }

inline void measure_part(const PartView& view, RecipeView recipe, Span<std::uint8_t> scratch,
                         PartResult& part) {
    part.feature_count = static_cast<int>(recipe.features.size());
    part.verdict = part.pose.orientation == Status::ok ? Verdict::ok : Verdict::unmeasured;
    for (int i = 0; i < part.feature_count; ++i) {
        const Feature& feature = recipe.features[i];
        FeatureResult& result = part.features[i];
        result = FeatureResult();
        result.status = part.pose.orientation;
        // A number of holes is the same however the part lies.
        if (part.pose.orientation == Status::ok || feature.kind == FeatureKind::hole_count) {
            const Result<Measurement> measured = measure_feature(view, feature, scratch);
            result.status = measured.status();
            if (measured) {
                result.measurement = *measured;
                result.verdict = judge(measured->value, feature.tolerance);
            }
            // Of another shape than what is measured, no value is OK; one that is bad says more.
            if (measured && !measured->regular && result.verdict == Verdict::ok) {
                result.status = Status::irregular;
                result.verdict = Verdict::unmeasured;
            }
        }
        part.verdict = combine(part.verdict, result.verdict);
    }
}

}  // namespace detail

constexpr std::int64_t gauge_scratch(Size size, const LocateRule& rule, int parts, int workers) {
    return arena_bytes<Region>(parts) + arena_bytes<Hole>(detail::gauge_holes(parts)) +
           maximum(find_parts_scratch(size, rule, workers), workers * measure_feature_scratch(size));
}

template <class Workers>
Status gauge(ImageView<const Gray8> image, RecipeView recipe, Span<std::uint8_t> scratch,
             ListView<PartResult> parts, const Workers& workers) {
    if (Status s = detail::check_find_parts(image, recipe.locate); s != Status::ok) return s;
    if (!scale_in_range(recipe.scale) || recipe.features.size() > Recipe::max_features)
        return Status::bad_argument;
    const int capacity = parts.capacity();
    const std::int64_t lists =
        arena_bytes<Region>(capacity) + arena_bytes<Hole>(detail::gauge_holes(capacity));
    const std::int64_t measuring = measure_feature_scratch(image.size());
    if (scratch.size() < lists + workers.count() * measuring) return Status::scratch_too_small;
    Arena arena(scratch);
    const Span<Region> region_room = arena.take<Region>(capacity);
    const Span<Hole> hole_room = arena.take<Hole>(detail::gauge_holes(capacity));
    int region_count = 0;
    int hole_count = 0;
    const ListView<Region> regions(region_room.data(), capacity, &region_count);
    const ListView<Hole> holes(hole_room.data(), detail::gauge_holes(capacity), &hole_count);

    Threshold threshold;
    const Status found = find_parts(image, recipe.locate, arena.rest(), threshold, regions, holes, workers);
    if (found != Status::ok && found != Status::capacity_exceeded) return found;
    parts.clear();
    while (parts.size() < regions.size()) parts.append();
    workers.run(regions.size(), [&](int index, int worker) {
        const Region& region = regions[index];
        PartResult& part = parts[index];
        const Result<PartMoments> moments =
            moments_of(image, recipe.locate, threshold.part, region, holes.span(), recipe.scale);
        part.area = 0;
        if (!moments) return;
        part.pose = pose_of(*moments, recipe.locate, recipe.scale);
        part.area = region.moments.area();
        part.box = region.box;
        part.holes = region.holes;
        detail::measure_part(
            {image, part.pose.frame, &region, holes.span(), recipe.locate, threshold, recipe.scale}, recipe,
            arena.rest().from(worker * measuring), part);
    });
    // What has no moments is no part. All others have pixels.
    int kept = 0;
    for (const PartResult& part : parts) {
        if (part.area == 0) continue;
        PartResult& place = parts[kept++];
        if (&place != &part) place = part;
    }
    parts.shrink(kept);
    return found;
}

inline Status gauge(ImageView<const Gray8> image, RecipeView recipe, Span<std::uint8_t> scratch,
                    ListView<PartResult> parts) {
    return gauge(image, recipe, scratch, parts, OneWorker());
}

}  // namespace fovea
