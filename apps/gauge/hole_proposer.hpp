// SPDX-License-Identifier: MIT
//
// HoleProposer: the features of the holes of a part.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fovea/decision/recipe.hpp>
#include <fovea/segment/fine_moments.hpp>

#include <gauge/outline.hpp>
#include <gauge/proposed_features.hpp>
#include <gauge/sample_meter.hpp>
#include <gauge/samples.hpp>

namespace fovea::apps {

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Adds the features of the holes of the first sample to the others.
class HoleProposer {
public:
    HoleProposer(const Samples& samples, const LocateRule& rule, ProposedFeatures& features)
        : samples_(samples), rule_(rule), features_(features) {}

    /// The number of holes, and the place of each, with its diameter if it is round.
    void propose() {
        const Sample& first = samples_.parts.front();
        const auto [fewest, most] = std::minmax_element(
            samples_.parts.begin(), samples_.parts.end(),
            [](const Sample& a, const Sample& b) { return a.holes.size() < b.holes.size(); });
        Feature count;
        count.kind = FeatureKind::hole_count;
        if (fewest->holes.size() == most->holes.size())
            features_.add(count, "holes");
        else
            features_.note("holes are not counted: the good parts have from " +
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
            feature.centre = features_.meter().frame_of(first).to_part(moments->centroid);
            feature.search = std::max<std::int64_t>(
                features_.pixel() * std::max(hole.box.width, hole.box.height) / 2, features_.pixel());
            feature.centre = features_.meter().mean_place(feature).value_or(feature.centre);
            found.push_back({feature, is_disc(*moments)});
        }
        // By their place along the part and, less, across it: their numbers must not hang on noise.
        std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
            return 4 * a.feature.centre.x + a.feature.centre.y < 4 * b.feature.centre.x + b.feature.centre.y;
        });
        // All of a part that repeats itself, as far as a recipe holds them: any may be the bad one.
        const std::size_t limit = repeats() ? found.size() : std::min<std::size_t>(found.size(), 6);
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (i == limit || !features_.room_for(2)) {
                features_.note(std::to_string(found.size() - i) + " of " + std::to_string(found.size()) +
                               " holes are not measured one by one");
                break;
            }
            propose_hole(found[i].feature, found[i].round, "hole_" + std::to_string(i + 1));
        }
    }

private:
    /// True if a part lies in one of several ways that are not told apart.
    bool repeats() const { return rule_.orientation == OrientationRule::rotational; }
    /// By what a part is turned when it looks the same in its outline.
    std::string turn_text() const {
        switch (rule_.orientation) {
            case OrientationRule::symmetric: return " by half, which its outline does not tell";
            case OrientationRule::rotational:
                return " by 1/" + std::to_string(rule_.symmetry_order) + " of a turn, which is not told";
            default: return "";
        }
    }
    void propose_hole(const Feature& position, bool round, const std::string& name) {
        Feature diameter = position;
        diameter.kind = FeatureKind::hole_diameter;
        features_.set_probes(diameter, position.search);
        const bool has_diameter = round && features_.add(diameter, name);
        if (features_.values_of(position).empty()) {
            const std::string what = has_diameter ? "its place" : "it";
            features_.note(name + (features_.turns() > 1 ? " lies elsewhere when the part is turned" +
                                                               turn_text() + ": " + what + " is not measured"
                                                         : " is not found on every part"));
            return;
        }
        if (!has_diameter)
            features_.note(name + (round ? " has no diameter: its edge is not seen as a circle on every part"
                                         : " is not round: its size is not measured"));
        features_.add(position, name + "_position");
    }

    const Samples& samples_;
    const LocateRule& rule_;
    ProposedFeatures& features_;
};

}  // namespace detail

}  // namespace fovea::apps
