// SPDX-License-Identifier: MIT
//
// Measuring one feature of a part that was located. Book sec. 6.2.2.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/feature_meter.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/decision/recipe_range.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Scratch bytes for measure_feature() in images of this size.
constexpr std::int64_t measure_feature_scratch(Size size);

/// Measures one feature.
///
///   distance       along the probe, between the edges with the two numbers
///   width          along the probe, from the first edge into the part to the last edge out of it
///   diameter       twice the radius of the circle fitted to the strongest edges of radial probes
///   hole_diameter  the same around the hole nearest to the place
///   position       from the place to the centroid of the hole nearest to it
///   angle          between two edges, each a line fitted to the strongest edges of probes across it, both
///                  pointing from their start to their end: 0 to 180 degrees
///   hole_count     the number of holes
///
/// The result is regular if each edge of a distance or a width is straight over the lines of the probe, up to
/// `smoothing` pixels (edge_straightness()). Of the probes of a circle no more than the share `outliers` may
/// meet no edge or one off the circle by more than `smoothing` pixels, or four deviations of the noise up to
/// three times that: else it is irregular and has no diameter.
///
/// A round edge is seen nearer to its centre than it is, by half its blur's variance over its radius; circles
/// are corrected for that.
///
/// Scratch  measure_feature_scratch(), undefined afterwards
/// Errors   out_of_range if a probe or a place leaves the image; not_found if there are fewer edges than
///          asked for, less than half of the probes see one, or no hole is within the search; degenerate if
///          no line or circle follows from the edges; irregular for a circle that is not round; bad_argument
///          for a feature out of its range; capacity_exceeded for more than 64 edges along a probe;
///          scratch_too_small
/// Source   book sec. 6.2.2. Blurred discs: the derivative of exp(-(r^2 + R^2) / 2s^2) I0(r R / s^2) has its
///          extreme at r = R - s^2 / 2R, to the second order in s / R
inline Result<Measurement> measure_feature(const PartView& part, const Feature& feature,
                                           Span<std::uint8_t> scratch);

// ---- Implementation ---------------------------------------------------------------

constexpr std::int64_t measure_feature_scratch(Size size) {
    return arena_bytes<std::uint16_t>(edge_probe_scratch(size)) + arena_bytes<Edge>(detail::max_probe_edges) +
           arena_bytes<FinePoint>(Feature::max_probes) + arena_bytes<FinePixel>(Feature::max_probes) +
           arena_bytes<SquarePixels>(Feature::max_probes);
}

inline Result<Measurement> measure_feature(const PartView& part, const Feature& feature,
                                           Span<std::uint8_t> scratch) {
    if (part.image.empty()) return Status::empty_image;
    if (!detail::feature_in_range(feature)) return Status::bad_argument;
    if (scratch.size() < measure_feature_scratch(part.image.size())) return Status::scratch_too_small;
    detail::FeatureMeter meter(part, feature, scratch);
    switch (feature.kind) {
        case FeatureKind::distance: return meter.distance();
        case FeatureKind::width: return meter.width();
        case FeatureKind::diameter: return meter.circle(feature.centre, feature.radius, feature.search);
        case FeatureKind::angle: return meter.angle();
        case FeatureKind::hole_count: return meter.hole_count();
        case FeatureKind::hole_diameter: return meter.hole_diameter();
        case FeatureKind::position: return meter.position();
    }
    return Status::bad_argument;
}

}  // namespace fovea
