// SPDX-License-Identifier: MIT
//
// ProposedFeatures: the list of features that teaching makes, each with the values that it has on the good
// parts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>

#include <gauge/proposed_tolerance.hpp>
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

/// Features that could be measured on every good part. The samples and the options must outlive it.
class ProposedFeatures {
public:
    ProposedFeatures(const Samples& samples, const LocateRule& rule, const Scale& scale,
                     const TeachOptions& options)
        : meter_(samples, rule, scale), options_(options) {
        recipe_.locate = rule;
        recipe_.scale = scale;
        detail::copy_name(recipe_.name, options.name);
        pixel_ = std::max(scale.x_per_pixel, scale.y_per_pixel);
    }

    /// Begins anew, with a least smoothing.
    void clear(int least_smoothing) {
        recipe_.features.clear();
        notes_.clear();
        least_smoothing_ = least_smoothing;
    }
    /// Finds out how blurred the edges of the features are, for the smoothing of those to come. False if
    /// there are none.
    bool learn_blur() {
        blur_ = meter_.blur_of(recipe_.features);
        return blur_.raw() > 0;
    }
    /// Keeps features whatever the samples differ by: they do while their scale is not known.
    void keep_all() { keep_all_ = true; }

    const Recipe& recipe() const { return recipe_; }
    const SampleMeter& meter() const { return meter_; }
    const std::vector<std::string>& notes() const { return notes_; }
    void note(const std::string& text) { notes_.push_back(text); }
    /// The longer side of a pixel.
    std::int64_t pixel() const { return pixel_; }

    /// The largest power of two up to one and a half times the blur, and to an eighth of the length: the
    /// noise falls with it, but edges must not reach into each other.
    int smoothing_for(const Feature& feature) const {
        const std::int64_t length = length_in(feature);
        int smoothing = least_smoothing_;
        while (smoothing < 8 &&
               blur_.raw() * 9 / 4 > SquarePixels::from_int(4 * smoothing * smoothing).raw() &&
               length > 16 * smoothing * pixel_)
            smoothing *= 2;
        return smoothing;
    }

    /// Places the probes around a circle four pixels apart as far as it goes, and lets one of them miss it.
    void set_probes(Feature& circle, std::int64_t radius) const {
        const Feature usual;
        circle.probes = static_cast<int>(
            std::clamp<std::int64_t>(radius * 157 / 100 / pixel_, usual.probes, Feature::max_probes));
        circle.outliers =
            circle.probes == usual.probes ? usual.outliers : (99 + circle.probes) / circle.probes;
    }

    /// True if a recipe can hold so many more; else notes that there is more to measure, once.
    bool room_for(int count) {
        if (count <= Recipe::max_features - recipe_.features.size()) return true;
        const std::string full =
            "a recipe holds " + std::to_string(Recipe::max_features) + " features: there is more to measure";
        if (std::find(notes_.begin(), notes_.end(), full) == notes_.end()) note(full);
        return false;
    }
    bool has(const std::string& name) const {
        for (const Feature& feature : recipe_.features)
            if (detail::text_of(feature.name) == name) return true;
        return false;
    }

    /// In how many ways a part may lie that the rule cannot tell apart; for no direction at all, some of
    /// them.
    int turns() const {
        switch (recipe_.locate.orientation) {
            case OrientationRule::full: break;
            case OrientationRule::symmetric: return 2;
            case OrientationRule::rotational: return recipe_.locate.symmetry_order;
            case OrientationRule::none: return 13;
        }
        return 1;
    }
    /// The turn from the first of these ways to another. Without direction they are golden sections of a
    /// turn, which no part that repeats itself has in common.
    FineAngle turn(int way) const {
        const std::int64_t whole = std::int64_t{1} << 32;
        const std::int64_t part = recipe_.locate.orientation == OrientationRule::none
                                      ? way * std::int64_t{0x9e3779b9}
                                      : whole * way / turns();
        return FineAngle::from_raw(static_cast<std::uint32_t>(part % whole));
    }
    /// The values of a feature on every sample, measured in every way in which it may lie; empty if one has
    /// none, or if there are many ways and a value depends on them.
    std::vector<std::int64_t> values_of(const Feature& feature) const {
        std::vector<std::int64_t> values;
        std::vector<std::int64_t> first;
        for (int i = 0; i < turns(); ++i) {
            const std::vector<std::int64_t> turned = meter_.values_of(feature, turn(i));
            if (turned.empty()) return {};
            if (i == 0) first = turned;
            // More than noise: it is no symmetry of this feature.
            const std::int64_t most = feature.kind == FeatureKind::angle ? 1000000 : pixel_ / 2;
            for (std::size_t k = 0; turns() > 2 && !keep_all_ && k < turned.size(); ++k)
                if (std::abs(turned[k] - first[k]) > most) return {};
            values.insert(values.end(), turned.begin(), turned.end());
        }
        return values;
    }

    /// Adds a feature with its nominal value and tolerances, unless a sample refuses it.
    bool add(Feature feature, const std::string& name) {
        detail::copy_name(feature.name, name);
        feature.smoothing = smoothing_for(feature);
        const bool circle =
            feature.kind == FeatureKind::diameter || feature.kind == FeatureKind::hole_diameter;
        const std::vector<std::int64_t> values =
            circle ? values_of_circle(feature, name) : values_of(feature);
        if (values.empty()) return false;
        const Spread spread = spread_of(values);
        feature.tolerance = proposed_tolerance(feature, recipe_.scale, spread, options_.tolerance);
        const std::string note = spread_note(feature, recipe_.scale, spread, options_.tolerance);
        if (!note.empty()) notes_.push_back(note);
        if (!keep_all_ && too_wide(feature, spread)) return false;
        return room_for(1) && recipe_.features.push(feature) == Status::ok;
    }

private:
    /// The values of a circle. If a share of it is missing on the good parts, sets how much may be: a
    /// twentieth more than that, because other poses show more of it.
    std::vector<std::int64_t> values_of_circle(Feature& feature, const std::string& name) {
        Feature whole = feature;
        whole.outliers = 0;
        std::vector<std::int64_t> values = values_of(whole);
        constexpr int most = 40;
        for (int outliers = feature.outliers; values.empty() && outliers <= most; outliers += 5) {
            feature.outliers = outliers;
            values = values_of(feature);
            if (values.empty()) continue;
            feature.outliers += 5;
            note(name + " is not round all around: damage is seen where it is more than " +
                 std::to_string(feature.outliers) + " % of the edge (outliers)");
        }
        return values;
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

    SampleMeter meter_;
    const TeachOptions& options_;
    Recipe recipe_;
    std::int64_t pixel_ = 0;
    SquarePixels blur_;  ///< of the edges, once it is known
    int least_smoothing_ = 1;
    bool keep_all_ = false;
    std::vector<std::string> notes_;
};

}  // namespace fovea::apps
