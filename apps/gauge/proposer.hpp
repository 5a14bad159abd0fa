// SPDX-License-Identifier: MIT
//
// Proposer: the features of a recipe, from what could be measured on every good part.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/trigonometry.hpp>

#include <gauge/hole_proposer.hpp>
#include <gauge/outline.hpp>
#include <gauge/proposed_features.hpp>
#include <gauge/sample_meter.hpp>
#include <gauge/samples.hpp>

namespace fovea::apps {

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Makes the features of a recipe, from the first sample, with nominal values from all.
class Proposer {
public:
    Proposer(const Samples& samples, const LocateRule& rule, const Scale& scale, const TeachOptions& options)
        : samples_(samples),
          rule_(rule),
          scale_(scale),
          features_(samples, rule, scale, options),
          pixel_(features_.pixel()) {}

    /// Proposes twice: the first time finds out how blurred the edges are.
    Recipe propose() {
        for (const int smoothing : {1, 4, 8}) {
            features_.clear(smoothing);
            propose_all();
            if (features_.learn_blur()) break;
        }
        features_.clear(1);
        propose_all();
        return features_.recipe();
    }
    /// Keeps features whatever the samples differ by: they do while their scale is not known.
    void keep_all() { features_.keep_all(); }
    const std::vector<std::string>& notes() const { return features_.notes(); }
    const SampleMeter& meter() const { return features_.meter(); }

private:
    void propose_all() {
        const Sample& first = samples_.parts.front();
        outline_ = outline_of(first, meter().frame_of(first));
        // No sample may reach beyond a probe that the first one sets.
        for (const Sample& sample : samples_.parts) {
            const Extent other = outline_of(sample, meter().frame_of(sample)).extent;
            extent_.left = std::min(extent_.left, other.left);
            extent_.right = std::max(extent_.right, other.right);
            extent_.top = std::min(extent_.top, other.top);
            extent_.bottom = std::max(extent_.bottom, other.bottom);
        }
        edges_ = straight_edges(outline_, scale_);
        const bool round = propose_round() && (all_round_ || rule_.orientation == OrientationRule::none);
        if (!round && rule_.orientation == OrientationRule::none) {
            features_.note(
                "the part has no clear axis and no symmetry, so how it lies turned is not known: only what "
                "does not depend on that is proposed");
        } else if (!round) {
            propose_parallel();
            if (!features_.has("length")) propose_length();
            if (!features_.has("width_1")) propose_widths();
            propose_angles();
        }
        HoleProposer(samples_, rule_, features_).propose();
    }

    /// True if a part lies in one of several ways that are not told apart.
    bool repeats() const { return rule_.orientation == OrientationRule::rotational; }

    /// True if a probe runs through the origin: turned by half it is the same, the other way round.
    bool is_central(const Feature& feature) const {
        const PartPoint way = feature.to - feature.from;
        const Int128 twice_area =
            Int128::product(feature.from.x, way.y) - Int128::product(feature.from.y, way.x);
        const std::int64_t off = round_divide(twice_area, Int128(std::max<std::int64_t>(length_of(way), 1)));
        return std::abs(off) <= pixel_ / 2;
    }
    /// Adds a probe, and of a part that repeats itself the like ones: any of them may meet the bad place.
    /// Leaves room for the count of holes.
    bool add_turned(const Feature& feature, const std::string& name) {
        const int order = repeats() ? rule_.symmetry_order : 1;
        const int places = order % 2 == 0 && is_central(feature) ? order / 2 : order;
        if (!features_.room_for(places + 1) || !features_.add(feature, name)) return false;
        for (int i = 1; i < places; ++i) {
            const UnitVector way = unit_vector(features_.turn(i));
            const auto place = [&](PartPoint p) {
                return PartPoint{multiply_divide(p.x, way.x.raw(), Unit::one) -
                                     multiply_divide(p.y, way.y.raw(), Unit::one),
                                 multiply_divide(p.x, way.y.raw(), Unit::one) +
                                     multiply_divide(p.y, way.x.raw(), Unit::one)};
            };
            Feature like = feature;
            like.from = place(feature.from);
            like.to = place(feature.to);
            if (!features_.add(like, name + "_" + std::to_string(i + 1)))
                features_.note(name + " is measured at some of its like places alone");
        }
        return true;
    }

    bool propose_round() {
        const Result<RoundOutline> round = circle_of(outline_, scale_);
        if (!round) return false;
        Feature feature;
        feature.kind = FeatureKind::diameter;
        feature.centre = part_point(round->circle.centre, scale_);
        feature.radius = multiply_divide(round->circle.radius.raw(), scale_.x_per_pixel, FinePixel::one);
        feature.search = std::min(feature.radius / 3, 8 * pixel_);
        features_.set_probes(feature, feature.radius);
        if (!features_.add(feature, "diameter")) return false;
        all_round_ = round->percent_off == 0;
        if (round->percent_off > 0)
            features_.note(std::to_string(round->percent_off) +
                           " % of the outline is off the circle (a notch, a flat, a tooth?): the diameter "
                           "does not measure that");
        return true;
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
        feature.smoothing = features_.smoothing_for(feature);
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
            if (!meter().values_of(shorter).empty()) return shorter;
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
    /// that of the whole part, up to three others that differ are widths. Of a part that repeats itself all
    /// are: any of them may be the bad one.
    void propose_parallel() {
        const int most_widths = repeats() ? Recipe::max_features : 3;
        struct Found {
            Feature feature;
            std::int64_t value;
        };
        std::vector<Found> found;
        for (std::size_t i = 0; i < edges_.size(); ++i)
            for (std::size_t k = i + 1; k < edges_.size(); ++k) {
                std::optional<Feature> feature = between_parallel(edges_[i], edges_[k]);
                if (feature) feature = within_images(*feature);
                if (feature) found.push_back({*feature, meter().values_of(*feature).front()});
            }
        // The longest first; where they are alike, the one along the axis.
        const auto off_axis = [](const Found& each) {
            const PartPoint way = each.feature.to - each.feature.from;
            return angle_of(std::abs(way.x), std::abs(way.y)).raw();
        };
        std::stable_sort(found.begin(), found.end(), [&](const Found& a, const Found& b) {
            return repeats() ? off_axis(a) < off_axis(b) : a.value > b.value;
        });
        int widths = 0;
        std::int64_t last = 0;
        bool alike = true;
        for (const Found& each : found) {
            if (repeats() && !features_.room_for(2)) break;
            const PartPoint way = each.feature.to - each.feature.from;
            const bool along = std::abs(way.x) >= std::abs(way.y);
            if (along && !features_.has("length") && is_whole(each.feature, each.value)) {
                alike = features_.add(each.feature, "length") && alike;
            } else if (widths < most_widths &&
                       (widths == 0 || repeats() || last - each.value > std::max(each.value / 50, pixel_))) {
                const bool added = features_.add(each.feature, "width_" + std::to_string(widths + 1));
                if (added) ++widths;
                alike = added && alike;
                last = each.value;
            }
        }
        if (repeats() && !alike)
            features_.note(
                "some distances between parallel edges are left out: they are not the same in all the "
                "directions that are not told apart");
    }

    static constexpr int few_lines = 3;

    /// A probe across the part at a share of its extent, along its axis or across it.
    Feature across_at(bool along_axis, int sixteenths) const {
        const Extent& box = extent_;
        const std::int64_t margin = 6 * pixel_;
        const std::int64_t x = (box.left + box.right) / 2 + (box.right - box.left) / 32 * sixteenths;
        const std::int64_t y = (box.top + box.bottom) / 2 + (box.bottom - box.top) / 32 * sixteenths;
        Feature feature;
        feature.kind = FeatureKind::width;
        feature.from = along_axis ? PartPoint{box.left - margin, y} : PartPoint{x, box.top - margin};
        feature.to = along_axis ? PartPoint{box.right + margin, y} : PartPoint{x, box.bottom + margin};
        feature.lines = 9;
        feature.smoothing = features_.smoothing_for(feature);
        return feature;
    }
    /// How much the value changes when the probe moves sideways, by two pixels or, of few lines, by one to
    /// either side: 0 where both edges are square to it.
    std::optional<std::int64_t> slope_of(const Feature& feature) const {
        const bool few = feature.lines <= few_lines;
        const Sample& first = samples_.parts.front();
        const Result<Measurement> here = meter().measure(first, feature);
        if (!here) return {};
        std::int64_t most = 0;
        for (const int sign : {1, -1}) {
            if (sign < 0 && !few) break;
            const PartPoint side = square_to(feature.to - feature.from, sign * (few ? 1 : 2) * pixel_);
            Feature moved = feature;
            moved.from = feature.from + side;
            moved.to = feature.to + side;
            const Result<Measurement> there = meter().measure(first, moved);
            if (!there) return {};
            most = std::max(most, std::abs(here->value.millionths - there->value.millionths));
        }
        // Few lines are for edges that are round or short, not for tips.
        if (few && most > pixel_ / 4) return {};
        return most;
    }
    /// The candidates of a direction, the steadiest first; near the middle where they are alike.
    std::vector<Feature> candidates(bool along_axis) const {
        struct Rated {
            Feature feature;
            std::int64_t rating;
        };
        std::vector<Rated> rated;
        for (int i = 0; i <= 24; ++i) {
            const int sixteenths = i % 2 == 0 ? i / 2 : -(i + 1) / 2;
            Feature across = across_at(along_axis, sixteenths);
            std::optional<Feature> feature;
            if (sixteenths % 2 == 0) feature = within_images(across);
            across.lines = few_lines;
            if (!feature) feature = within_images(across);
            const std::optional<std::int64_t> slope = feature ? slope_of(*feature) : std::nullopt;
            if (slope) rated.push_back({*feature, *slope + std::abs(sixteenths) * pixel_ / 80});
        }
        std::stable_sort(rated.begin(), rated.end(),
                         [](const Rated& a, const Rated& b) { return a.rating < b.rating; });
        std::vector<Feature> features;
        for (const Rated& each : rated) features.push_back(each.feature);
        return features;
    }

    void propose_length() {
        for (Feature feature : candidates(true)) {
            const std::int64_t value = meter().values_of(feature).front();
            // At a round end, many lines would shorten the part.
            Feature narrow = feature;
            narrow.lines = 1;
            const std::vector<std::int64_t> at_middle = meter().values_of(narrow);
            if (!at_middle.empty() && std::abs(at_middle.front() - value) > pixel_ / 8)
                feature.lines = few_lines;
            if (is_whole(feature, value) && add_turned(feature, "length")) return;
        }
        features_.note(
            "no length: no probe along the axis meets both ends of every part; it needs straight ends "
            "and 8 pixels of ground around it");
    }

    /// Up to three widths that differ by a twentieth.
    void propose_widths() {
        std::vector<std::int64_t> taken;
        for (const Feature& feature : candidates(false)) {
            if (taken.size() == 3) break;
            const std::vector<std::int64_t> values = meter().values_of(feature);
            if (values.empty()) continue;
            const bool known = std::any_of(taken.begin(), taken.end(), [&](std::int64_t other) {
                return std::abs(other - values[0]) < std::max(other, values[0]) / 20;
            });
            if (known || *slope_of(feature) > pixel_ / 4) continue;
            if (add_turned(feature, "width_" + std::to_string(taken.size() + 1))) taken.push_back(values[0]);
        }
    }

    /// The first two corners between long straight edges, or all of a part that repeats itself.
    void propose_angles() {
        const int most = repeats() ? Recipe::max_features : 2;
        const std::vector<Stretch>& edges = edges_;
        int count = 0;
        for (std::size_t i = 0; i < edges.size() && count < most; ++i) {
            const Stretch& one = edges[i];
            const Stretch& two = edges[(i + 1) % edges.size()];
            const std::int32_t corner = (two.direction() - one.direction()).signed_raw();
            // Between 15 and 165 degrees.
            if (magnitude(corner) < 0x0aaaaaaau || magnitude(corner) > 0x75555555u) continue;
            if (repeats() && !features_.room_for(2)) break;
            Feature feature;
            feature.kind = FeatureKind::angle;
            feature.from = one.from;
            feature.to = one.to;
            feature.second_from = two.from;
            feature.second_to = two.to;
            feature.search = 5 * pixel_;
            if (features_.add(feature, "angle_" + std::to_string(count + 1))) ++count;
        }
    }

    const Samples& samples_;
    LocateRule rule_;
    Scale scale_;
    ProposedFeatures features_;
    std::int64_t pixel_;  ///< its longer side
    Outline outline_;
    Extent extent_;  ///< of all samples
    std::vector<Stretch> edges_;
    bool all_round_ = false;  ///< of a part with a diameter: nothing is off its circle
};

}  // namespace detail

}  // namespace fovea::apps
