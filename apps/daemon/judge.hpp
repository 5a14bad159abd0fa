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
#include <fovea/number/integer.hpp>

#include <daemon/inspection.hpp>
#include <daemon/jobs.hpp>
#include <read/code_judge.hpp>

namespace fovea::apps {

/// Room for the results of a picture.
inline constexpr int judge_parts = 64;

/// Bytes of scratch that judging pictures of that size by a job needs, with so many workers.
inline std::int64_t judge_scratch(Size size, const Job& job, int workers = 1) {
    const std::int64_t parts =
        job.gauges ? gauge_scratch(size, RecipeView(job.recipe).locate, judge_parts, workers) : 0;
    return maximum(parts, job.reads ? read_job_scratch(job.codes.looked_at(size)) : 0);
}

class Judge {
public:
    /// Judges a picture: its parts, then its codes. The answer, the reason, the values of the worst part and
    /// the codes go into the inspection. Parts are measured by all workers, codes are read by one.
    template <class Workers>
    void judge(ImageView<const Gray8> picture, const Job& job, Span<std::uint8_t> scratch,
               const Workers& workers, Inspection& inspection) {
        inspection.answer = Answer::ok;
        inspection.reason = "";
        inspection.feature = {};
        if (job.gauges) judge_parts_of(picture, job.recipe, scratch, workers, inspection);
        if (!job.reads) return;
        const CodesVerdict codes = codes_.judge(picture, job.codes, scratch);
        inspection.codes = codes_.codes();
        // What is not OK says more than what could not be judged; of the same the parts were first.
        if (rank(codes.verdict) > rank(inspection.answer)) {
            inspection.answer = answer_of(codes.verdict);
            inspection.reason = codes.reason;
            inspection.feature = {};
        }
        if (inspection.answer == Answer::ok) codes_.remember();
    }

    /// Takes the codes of a picture as those that a job allows. "" if it could, or a word for why not.
    const char* teach(ImageView<const Gray8> picture, const Job& job, Span<std::uint8_t> scratch) {
        return codes_.teach(picture, job.codes, scratch).reason;
    }
    Span<const CodeReading> taught() const { return codes_.taught(); }
    void forget_taught() { codes_.forget_taught(); }
    /// Another job begins.
    void forget() { codes_.forget(); }

private:
    static int rank(Verdict verdict) {
        return verdict == Verdict::ok ? 0 : verdict == Verdict::unmeasured ? 1 : 2;
    }
    static int rank(Answer answer) { return answer == Answer::ok ? 0 : answer == Answer::error ? 1 : 2; }
    static Answer answer_of(Verdict verdict) {
        return verdict == Verdict::ok       ? Answer::ok
               : verdict == Verdict::not_ok ? Answer::not_ok
                                            : Answer::error;
    }

    template <class Workers>
    void judge_parts_of(ImageView<const Gray8> picture, RecipeView recipe, Span<std::uint8_t> scratch,
                        const Workers& workers, Inspection& inspection) {
        parts_.clear();
        inspection.answer = Answer::error;
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
        inspection.answer = answer_of(all);
        inspection.reason = all == Verdict::ok ? "" : "unmeasured";
        take_values(parts_[worst], recipe, inspection);
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
    CodeJudge codes_;
};

}  // namespace fovea::apps
