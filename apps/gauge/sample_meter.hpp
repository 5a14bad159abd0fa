// SPDX-License-Identifier: MIT
//
// SampleMeter: measures features on the good parts that a recipe is taught from.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <fovea/base/order.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>

#include <gauge/samples.hpp>

namespace fovea::apps {

/// Measures by a rule and a scale. The samples must outlive it.
class SampleMeter {
public:
    SampleMeter(const Samples& samples, const LocateRule& rule, const Scale& scale)
        : samples_(samples), rule_(rule), scale_(scale) {
        for (const Sample& sample : samples.parts) {
            const Result<PartMoments> moments = sample.moments_under(rule, scale);
            frames_.push_back(pose_of(moments ? *moments : sample.moments, rule, scale).frame);
        }
    }

    /// sample is one of those that it was made with.
    const PartFrame& frame_of(const Sample& sample) const {
        return frames_[static_cast<std::size_t>(&sample - samples_.parts.data())];
    }
    Result<Measurement> measure(const Sample& sample, const Feature& feature, FineAngle turn = {}) const {
        const PartFrame& frame = frame_of(sample);
        std::vector<std::uint8_t> scratch(
            static_cast<std::size_t>(measure_feature_scratch(sample.image->size)));
        const PartView view{sample.image->view(),
                            PartFrame(frame.origin(), frame.angle() + turn, scale_),
                            &sample.region,
                            {sample.holes.data(), static_cast<std::ptrdiff_t>(sample.holes.size())},
                            rule_,
                            sample.threshold,
                            scale_};
        const Result<Measurement> found =
            measure_feature(view, feature, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
        if (found && !found->regular) return Status::irregular;
        return found;
    }

    /// The values of a feature on every sample, the part turned as it is or further; empty if one of them has
    /// none.
    std::vector<std::int64_t> values_of(const Feature& feature, FineAngle turn = {}) const {
        std::vector<std::int64_t> values;
        for (const Sample& sample : samples_.parts) {
            const Result<Measurement> found = measure(sample, feature, turn);
            if (!found) return {};
            values.push_back(found->value.millionths);
        }
        return values;
    }
    /// The mean place of the holes that a position finds; nothing if a sample has none there.
    std::optional<PartPoint> mean_place(const Feature& position) const {
        PartPoint sum;
        for (const Sample& sample : samples_.parts) {
            const Result<Measurement> found = measure(sample, position);
            if (!found) return {};
            sum = sum + frame_of(sample).to_part(found->marks[0]);
        }
        const auto count = static_cast<std::int64_t>(samples_.parts.size());
        return PartPoint{round_divide(sum.x, count), round_divide(sum.y, count)};
    }
    /// The direction in the image in which a probe runs on every sample.
    std::vector<FineAngle> directions_of(const Feature& feature) const {
        std::vector<FineAngle> directions;
        for (const Sample& sample : samples_.parts)
            directions.push_back(frame_of(sample).angle() +
                                 angle_of(feature.to.x - feature.from.x, feature.to.y - feature.from.y));
        return directions;
    }

    /// The middle one of the blurs at the features of the first sample.
    SquarePixels blur_of(const List<Feature, Recipe::max_features>& features) const {
        std::vector<SquarePixels> found;
        for (const Feature& feature : features) {
            const Result<Measurement> measured = measure(samples_.parts.front(), feature);
            if (measured && measured->blur.raw() > 0) found.push_back(measured->blur);
        }
        if (found.empty()) return {};
        return median(Span<SquarePixels>(found.data(), static_cast<std::ptrdiff_t>(found.size())));
    }

private:
    const Samples& samples_;
    LocateRule rule_;
    Scale scale_;
    std::vector<PartFrame> frames_;  ///< of the samples
};

}  // namespace fovea::apps
