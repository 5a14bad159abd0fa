// SPDX-License-Identifier: MIT
//
// Judge: a frame against a job.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/image/image_view.hpp>

#include <daemon/inspection.hpp>

namespace fovea::apps {

/// Room for the results of a picture.
inline constexpr int judge_parts = 64;

/// Bytes of scratch that judging pictures of that size by a recipe needs, with so many workers.
constexpr std::int64_t judge_scratch(Size size, RecipeView recipe, int workers = 1) {
    return gauge_scratch(size, recipe.locate, judge_parts, workers);
}

class Judge {
public:
    /// Judges a picture; the answer, the reason and the values of the worst part go into the inspection.
    template <class Workers>
    void judge(ImageView<const Gray8> picture, RecipeView recipe, Span<std::uint8_t> scratch,
               const Workers& workers, Inspection& inspection) {
        parts_.clear();
        inspection.answer = Answer::error;
        inspection.feature = {};
        const Status status = gauge(picture, recipe, scratch, parts_.view(), workers);
        inspection.parts = parts_.size();
        if (status != Status::ok) {
            inspection.reason = status == Status::capacity_exceeded ? "too_many_parts" : "no_judgement";
            return;
        }
        if (parts_.empty()) {
            inspection.reason = "no_part";
            return;
        }
        int worst = 0;
        Verdict all = parts_[0].verdict;
        for (int k = 1; k < parts_.size(); ++k) {
            if (rank(parts_[k].verdict) > rank(parts_[worst].verdict)) worst = k;
            all = combine(all, parts_[k].verdict);
        }
        inspection.answer = all == Verdict::ok       ? Answer::ok
                            : all == Verdict::not_ok ? Answer::not_ok
                                                     : Answer::error;
        inspection.reason = all == Verdict::ok ? "" : "unmeasured";
        take_values(parts_[worst], recipe, inspection);
    }

private:
    static int rank(Verdict verdict) {
        return verdict == Verdict::ok ? 0 : verdict == Verdict::unmeasured ? 1 : 2;
    }

    static void take_values(const PartResult& part, RecipeView recipe, Inspection& inspection) {
        inspection.values = 0;
        bool told = false;
        for (int k = 0; k < part.feature_count && k < Inspection::most_values; ++k) {
            const Feature& feature = recipe.features[k];
            const FeatureResult& result = part.features[k];
            inspection.value[inspection.values++] = {name_of(feature.name), result.status, result.verdict,
                                                     result.measurement.value,
                                                     feature.kind == FeatureKind::hole_count ? 0 : 3};
            // The first that explains the answer.
            const bool bad = result.verdict == Verdict::low || result.verdict == Verdict::high;
            const bool explains =
                inspection.answer == Answer::not_ok ? bad : result.verdict == Verdict::unmeasured;
            if (inspection.answer == Answer::ok || told || !explains) continue;
            told = true;
            inspection.reason = word_of(result.verdict);
            inspection.feature = name_of(feature.name);
        }
    }

    List<PartResult, judge_parts> parts_;
};

}  // namespace fovea::apps
