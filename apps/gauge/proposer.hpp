// SPDX-License-Identifier: MIT
//
// Proposer: the features of a recipe, from what could be measured on every good part.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fovea/base/order.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>

#include <common/picture_file.hpp>
#include <gauge/outline.hpp>
#include <gauge/proposed_tolerance.hpp>
#include <gauge/report.hpp>
#include <gauge/sample_meter.hpp>
#include <gauge/samples.hpp>

namespace fovea::apps {

struct TeachOptions {
    std::string name;
    std::optional<bool> dark;                  ///< brightness of the part; found out if not given
    std::optional<std::int64_t> known_length;  ///< of the part along its axis, in nm
    std::optional<Scale> scale;                ///< in mm; pixels if not given
    std::optional<std::int64_t> tolerance;     ///< of every length, in millionths of the unit
};

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Makes the features of a recipe, from the first sample, with nominal values from all.
class Proposer {
public:
    Proposer(const Samples& samples, const LocateRule& rule, const Scale& scale, const TeachOptions& options)
        : samples_(samples), meter_(samples, rule, scale), options_(options) {
        recipe_.locate = rule;
        recipe_.scale = scale;
        copy_name(recipe_.name, options.name);
        pixel_ = std::max(scale.x_per_pixel, scale.y_per_pixel);
    }

    /// Proposes twice: the first time finds out how blurred the edges are.
    Recipe propose() {
        for (const int start : {1, 4, 8}) {
            propose_with(start);
            blur_ = meter_.blur_of(recipe_.features);
            if (blur_.raw() > 0) break;
        }
        propose_with(1);
        return recipe_;
    }
    /// Keeps features whatever the samples differ by: they do while their scale is not known.
    void keep_all() { keep_all_ = true; }
    const std::vector<std::string>& notes() const { return notes_; }
    const SampleMeter& meter() const { return meter_; }

private:
    void propose_with(int smoothing) {
        recipe_.features.clear();
        notes_.clear();
        start_ = smoothing;
        propose_all();
    }
    /// The largest power of two up to one and a half times the blur, and to an eighth of the length: the
    /// noise falls with it, but edges must not reach into each other.
    int smoothing_for(std::int64_t length) const {
        int smoothing = start_;
        while (smoothing < 8 &&
               blur_.raw() * 9 / 4 > SquarePixels::from_int(4 * smoothing * smoothing).raw() &&
               length > 16 * smoothing * pixel_)
            smoothing *= 2;
        return smoothing;
    }

    void propose_all() {
        const Sample& first = samples_.parts.front();
        outline_ = outline_of(first, meter_.frame_of(first));
        // No sample may reach beyond a probe that the first one sets.
        for (const Sample& sample : samples_.parts) {
            const Extent other = outline_of(sample, meter_.frame_of(sample)).extent;
            extent_.left = std::min(extent_.left, other.left);
            extent_.right = std::max(extent_.right, other.right);
            extent_.top = std::min(extent_.top, other.top);
            extent_.bottom = std::max(extent_.bottom, other.bottom);
        }
        edges_ = straight_edges(outline_, recipe_.scale);
        if (!propose_round()) {
            propose_parallel();
            if (!has_feature("length")) propose_length();
            if (!has_feature("width_1")) propose_widths();
            propose_angles();
        }
        propose_holes();
    }

    /// The length between the edges of a feature, as far as it is known before it is measured.
    std::int64_t length_in(const Feature& feature) const {
        switch (feature.kind) {
            case FeatureKind::distance:
            case FeatureKind::width: return length_of(feature.to - feature.from) - 12 * pixel_;
            case FeatureKind::diameter: return 2 * feature.radius;
            case FeatureKind::hole_diameter: return 2 * feature.search;
            case FeatureKind::angle: return 4 * feature.search;
            case FeatureKind::hole_count:
            case FeatureKind::position: break;
        }
        return 0;
    }

    /// The values of a feature on every sample; empty if one of them has none. A part whose ends are alike is
    /// measured both ways, because nobody knows how it will lie.
    std::vector<std::int64_t> values_of(const Feature& feature) const {
        std::vector<std::int64_t> values = meter_.values_of(feature);
        if (values.empty() || recipe_.locate.orientation != OrientationRule::symmetric) return values;
        const std::vector<std::int64_t> turned = meter_.values_of(feature, FineAngle::half_turn());
        if (turned.empty()) return {};
        values.insert(values.end(), turned.begin(), turned.end());
        return values;
    }

    /// Adds a feature with its nominal value and tolerances, unless a sample refuses it.
    bool add(Feature feature, const std::string& name) {
        copy_name(feature.name, name);
        feature.smoothing = smoothing_for(length_in(feature));
        const std::vector<std::int64_t> values = values_of(feature);
        if (values.empty()) return false;
        const Spread spread = spread_of(values);
        feature.tolerance = proposed_tolerance(feature, recipe_.scale, spread, options_.tolerance);
        const std::string note = spread_note(feature, recipe_.scale, spread, options_.tolerance);
        if (!note.empty()) notes_.push_back(note);
        if (!keep_all_ && too_wide(feature, spread)) return false;
        return recipe_.features.push(feature) == Status::ok;
    }

    bool propose_round() {
        const Result<CircleFit> fit = circle_of(outline_, recipe_.scale);
        // Round: the contour stays within a fiftieth of the radius, two pixels at most.
        if (!fit || fit->rms > std::min(fine_ratio(fit->circle.radius, 50), FinePixel::from_int(2)))
            return false;
        Feature feature;
        feature.kind = FeatureKind::diameter;
        feature.centre = part_point(fit->circle.centre, recipe_.scale);
        feature.radius = multiply_divide(fit->circle.radius.raw(), recipe_.scale.x_per_pixel, FinePixel::one);
        feature.search = std::min(feature.radius / 3, 8 * pixel_);
        return add(feature, "diameter");
    }

    bool has_feature(const std::string& name) const {
        for (const Feature& feature : recipe_.features)
            if (text_of(feature.name) == name) return true;
        return false;
    }

    /// The probe between two edges that face away from each other; nothing if they do not.
    std::optional<Feature> between_parallel(const Stretch& one, const Stretch& two) const {
        // Square to the longer one, whose direction is known better.
        const std::optional<Facing> facing =
            one.length() >= two.length() ? facing_edges(one, two, pixel_) : facing_edges(two, one, pixel_);
        if (!facing) return {};
        Feature feature;
        feature.kind = FeatureKind::width;
        feature.from = facing->from;
        feature.to = facing->to;
        feature.lines = static_cast<int>(std::clamp<std::int64_t>(facing->breadth / pixel_ / 2, 1, 25));
        feature.smoothing = smoothing_for(length_in(feature));
        return feature;
    }

    /// The probe, or a shorter one where a part lies so near to a border that it would leave the image.
    std::optional<Feature> within_images(const Feature& feature) const {
        const PartPoint way = feature.to - feature.from;
        const std::int64_t length = std::max<std::int64_t>(length_of(way), 1);
        for (const std::int64_t cut : {std::int64_t{0}, 3 * pixel_, 19 * pixel_ / 4}) {
            const PartPoint off{multiply_divide(way.x, cut, length), multiply_divide(way.y, cut, length)};
            Feature shorter = feature;
            shorter.from = feature.from + off;
            shorter.to = feature.to - off;
            if (!meter_.values_of(shorter).empty()) return shorter;
        }
        return {};
    }

    /// True if a distance along a probe is that from one end of the part to the other.
    bool is_whole(const Feature& feature, std::int64_t value) const {
        const std::int64_t whole =
            breadth_of(outline_, angle_of(feature.to.x - feature.from.x, feature.to.y - feature.from.y));
        return value > whole - std::max(whole / 50, 2 * pixel_);
    }

    /// Distances between parallel edges: the longest within 45 degrees of the axis is the length if it is
    /// that of the whole part, up to three others that differ are widths.
    void propose_parallel() {
        struct Found {
            Feature feature;
            std::int64_t value;
        };
        std::vector<Found> found;
        for (std::size_t i = 0; i < edges_.size(); ++i)
            for (std::size_t k = i + 1; k < edges_.size(); ++k) {
                std::optional<Feature> feature = between_parallel(edges_[i], edges_[k]);
                if (feature) feature = within_images(*feature);
                if (feature) found.push_back({*feature, meter_.values_of(*feature).front()});
            }
        std::stable_sort(found.begin(), found.end(),
                         [](const Found& a, const Found& b) { return a.value > b.value; });
        int widths = 0;
        std::int64_t last = 0;
        for (const Found& each : found) {
            const PartPoint way = each.feature.to - each.feature.from;
            const bool along = std::abs(way.x) >= std::abs(way.y);
            if (along && !has_feature("length") && is_whole(each.feature, each.value)) {
                add(each.feature, "length");
            } else if (widths < 3 && (widths == 0 || last - each.value > std::max(each.value / 50, pixel_))) {
                if (add(each.feature, "width_" + std::to_string(widths + 1))) ++widths;
                last = each.value;
            }
        }
    }

    /// A probe across the part at a share of its extent, along its axis or across it.
    Feature across_at(bool along_axis, int eighths) const {
        const Extent& box = extent_;
        const std::int64_t margin = 6 * pixel_;
        const std::int64_t x = (box.left + box.right) / 2 + (box.right - box.left) / 16 * eighths;
        const std::int64_t y = (box.top + box.bottom) / 2 + (box.bottom - box.top) / 16 * eighths;
        Feature feature;
        feature.kind = FeatureKind::width;
        feature.from = along_axis ? PartPoint{box.left - margin, y} : PartPoint{x, box.top - margin};
        feature.to = along_axis ? PartPoint{box.right + margin, y} : PartPoint{x, box.bottom + margin};
        feature.lines = 9;
        feature.smoothing = smoothing_for(length_in(feature));
        return feature;
    }
    /// How much the value changes when the probe moves two pixels sideways: 0 where both edges are square to
    /// it.
    std::optional<std::int64_t> slope_of(const Feature& feature) const {
        const PartPoint side = square_to(feature.to - feature.from, 2 * pixel_);
        Feature moved = feature;
        moved.from = feature.from + side;
        moved.to = feature.to + side;
        const Sample& first = samples_.parts.front();
        const Result<Measurement> here = meter_.measure(first, feature);
        const Result<Measurement> there = meter_.measure(first, moved);
        if (!here || !there) return {};
        return std::abs(here->value.millionths - there->value.millionths);
    }
    /// The candidates of a direction, the steadiest first; near the middle where they are alike.
    std::vector<Feature> candidates(bool along_axis) const {
        struct Rated {
            Feature feature;
            std::int64_t rating;
        };
        std::vector<Rated> rated;
        for (const int eighths : {0, -1, 1, -2, 2, -3, 3, -4, 4, -5, 5, -6, 6}) {
            const std::optional<Feature> feature = within_images(across_at(along_axis, eighths));
            const std::optional<std::int64_t> slope = feature ? slope_of(*feature) : std::nullopt;
            if (slope) rated.push_back({*feature, *slope + std::abs(eighths) * pixel_ / 40});
        }
        std::stable_sort(rated.begin(), rated.end(),
                         [](const Rated& a, const Rated& b) { return a.rating < b.rating; });
        std::vector<Feature> features;
        for (const Rated& each : rated) features.push_back(each.feature);
        return features;
    }

    void propose_length() {
        for (Feature feature : candidates(true)) {
            const std::int64_t value = meter_.values_of(feature).front();
            // At a round end, many lines would shorten the part.
            Feature narrow = feature;
            narrow.lines = 1;
            const std::vector<std::int64_t> at_middle = meter_.values_of(narrow);
            if (!at_middle.empty() && std::abs(at_middle.front() - value) > pixel_ / 8) feature.lines = 3;
            if (is_whole(feature, value) && add(feature, "length")) return;
        }
        notes_.push_back(
            "no length: no probe along the axis meets both ends of every part; it needs straight ends "
            "and 8 pixels of ground around it");
    }

    /// Up to three widths that differ by a twentieth.
    void propose_widths() {
        std::vector<std::int64_t> taken;
        for (const Feature& feature : candidates(false)) {
            if (taken.size() == 3) break;
            const std::vector<std::int64_t> values = meter_.values_of(feature);
            if (values.empty()) continue;
            const bool known = std::any_of(taken.begin(), taken.end(), [&](std::int64_t other) {
                return std::abs(other - values[0]) < std::max(other, values[0]) / 20;
            });
            if (known || *slope_of(feature) > pixel_ / 4) continue;
            if (add(feature, "width_" + std::to_string(taken.size() + 1))) taken.push_back(values[0]);
        }
    }

    /// The first two corners between long straight edges.
    void propose_angles() {
        const std::vector<Stretch>& edges = edges_;
        int count = 0;
        for (std::size_t i = 0; i < edges.size() && count < 2; ++i) {
            const Stretch& one = edges[i];
            const Stretch& two = edges[(i + 1) % edges.size()];
            const std::int32_t corner = (two.direction() - one.direction()).signed_raw();
            // Between 15 and 165 degrees.
            if (magnitude(corner) < 0x0aaaaaaau || magnitude(corner) > 0x75555555u) continue;
            Feature feature;
            feature.kind = FeatureKind::angle;
            feature.from = one.from;
            feature.to = one.to;
            feature.second_from = two.from;
            feature.second_to = two.to;
            feature.search = 5 * pixel_;
            if (add(feature, "angle_" + std::to_string(count + 1))) ++count;
        }
    }

    void propose_holes() {
        const Sample& first = samples_.parts.front();
        const auto [fewest, most] = std::minmax_element(
            samples_.parts.begin(), samples_.parts.end(),
            [](const Sample& a, const Sample& b) { return a.holes.size() < b.holes.size(); });
        Feature count;
        count.kind = FeatureKind::hole_count;
        if (fewest->holes.size() == most->holes.size())
            add(count, "holes");
        else
            notes_.push_back("holes are not counted: the good parts have from " +
                             std::to_string(fewest->holes.size()) + " to " +
                             std::to_string(most->holes.size()));
        struct Found {
            Feature feature;
            bool round;
        };
        std::vector<Found> found;
        for (const Hole& hole : first.holes) {
            const Result<CentralMoments> moments =
                fine_moments(first.image->view(), first.threshold.part, hole);
            if (!moments) continue;
            Feature feature;
            feature.kind = FeatureKind::position;
            feature.centre = meter_.frame_of(first).to_part(moments->centroid);
            feature.search =
                std::max<std::int64_t>(pixel_ * std::max(hole.box.width, hole.box.height) / 2, pixel_);
            feature.centre = meter_.mean_place(feature).value_or(feature.centre);
            found.push_back({feature, is_disc(*moments)});
        }
        // By their place along the part and, less, across it: their numbers must not hang on noise.
        std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
            return 4 * a.feature.centre.x + a.feature.centre.y < 4 * b.feature.centre.x + b.feature.centre.y;
        });
        for (std::size_t i = 0; i < std::min<std::size_t>(found.size(), 6); ++i)
            propose_hole(found[i].feature, found[i].round, "hole_" + std::to_string(i + 1));
    }
    void propose_hole(Feature feature, bool round, const std::string& name) {
        if (values_of(feature).empty()) {
            const bool either_way = recipe_.locate.orientation == OrientationRule::symmetric;
            notes_.push_back(name + (either_way
                                         ? " lies elsewhere when the part is turned by half, which its "
                                           "outline does not tell: it is not measured"
                                         : " is not found on every part"));
            return;
        }
        const Feature position = feature;
        feature.kind = FeatureKind::hole_diameter;
        if (round && !add(feature, name))
            notes_.push_back(name + " has no diameter: its edge is not seen as a circle on every part");
        add(position, name + "_position");
    }

    const Samples& samples_;
    SampleMeter meter_;
    const TeachOptions& options_;
    Recipe recipe_;
    Outline outline_;
    Extent extent_;  ///< of all samples
    std::vector<Stretch> edges_;
    std::int64_t pixel_ = 0;
    SquarePixels blur_;  ///< of the edges, once it is known
    int start_ = 1;      ///< the least smoothing
    bool keep_all_ = false;
    std::vector<std::string> notes_;
};

}  // namespace detail

}  // namespace fovea::apps
