// SPDX-License-Identifier: MIT
//
// CodeJudge: the codes of a picture against a job.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/tolerance.hpp>
#include <fovea/image/image_view.hpp>

#include <read/code_job.hpp>
#include <read/code_readings.hpp>

namespace fovea::apps {

/// What became of the codes of a picture: unmeasured where they could not be judged.
struct CodesVerdict {
    Verdict verdict = Verdict::unmeasured;
    /// One word; empty for ok. Of not_ok: no_code, undecided_code, wrong_code, too_few_codes, too_many_codes,
    /// duplicate_code, repeated_code, low_grade. Of unmeasured: not_taught, region_outside, codes_too_long,
    /// no_judgement.
    const char* reason = "";
};

/// Takes no memory. What it remembers is of one job: forget() before another.
class CodeJudge {
public:
    /// Judges a picture; codes() are its codes then.
    CodesVerdict judge(ImageView<const Gray8> picture, const CodeJob& job, Span<std::uint8_t> scratch);

    /// Takes what stands in a picture as what is allowed from now on, in place of what was. Not ok, with
    /// nothing allowed, if there are not as many codes as expected, alike where they must be distinct, or one
    /// that no pattern of the job fits.
    CodesVerdict teach(ImageView<const Gray8> picture, const CodeJob& job, Span<std::uint8_t> scratch);

    /// The picture was OK: its codes are the last ones.
    void remember() { last_.take(readings_.codes()); }
    void forget() {
        forget_taught();
        last_.clear();
    }
    void forget_taught() { taught_.clear(); }
    Span<const CodeReading> codes() const { return readings_.codes(); }
    /// Of the last teach().
    Span<const CodeReading> taught() const { return taught_readings_.codes(); }

private:
    static CodesVerdict verdict_of(Status read);
    static CodesVerdict count_of(const CodeReadings& readings, const CodeJob& job);

    CodeReadings readings_;
    /// Apart, so that the last result stays as it was told.
    CodeReadings taught_readings_;
    KnownCodes taught_;
    KnownCodes last_;
};

// ---- Implementation ---------------------------------------------------------------

inline CodesVerdict CodeJudge::verdict_of(Status read) {
    switch (read) {
        case Status::ok: return {Verdict::ok, ""};
        case Status::not_found: return {Verdict::not_ok, "no_code"};
        case Status::undecided: return {Verdict::not_ok, "undecided_code"};
        case Status::out_of_range: return {Verdict::unmeasured, "region_outside"};
        case Status::buffer_too_small:
        case Status::capacity_exceeded: return {Verdict::unmeasured, "codes_too_long"};
        default: return {Verdict::unmeasured, "no_judgement"};
    }
}

inline CodesVerdict CodeJudge::count_of(const CodeReadings& readings, const CodeJob& job) {
    const std::ptrdiff_t count = readings.codes().size();
    if (count < job.count) return {Verdict::not_ok, "too_few_codes"};
    if (count > job.count) return {Verdict::not_ok, "too_many_codes"};
    return {Verdict::ok, ""};
}

inline CodesVerdict CodeJudge::judge(ImageView<const Gray8> picture, const CodeJob& job,
                                     Span<std::uint8_t> scratch) {
    const auto allowed = [&](const CodeReading& reading) {
        return job.allowed.allows(reading.text) && (!job.taught || taught_.contains(reading));
    };
    const bool untaught = job.taught && taught_.empty();
    const Status read = readings_.read(picture, job, scratch, [&](const CodeReading& reading) {
        return !job.ignores_others || untaught || allowed(reading);
    });
    if (untaught) return {Verdict::unmeasured, "not_taught"};
    CodesVerdict all = verdict_of(read);
    if (read != Status::ok) return all;
    const auto blame = [&](const char* fault, auto is_faulty) {
        for (CodeReading& reading : readings_.codes()) {
            if (reading.fault[0] != '\0' || !is_faulty(reading)) continue;
            reading.fault = fault;
            if (all.verdict == Verdict::ok) all = {Verdict::not_ok, fault};
        }
    };
    blame("wrong_code", [&](const CodeReading& reading) { return !allowed(reading); });
    if (all.verdict == Verdict::ok) all = count_of(readings_, job);
    blame("duplicate_code",
          [&](const CodeReading& reading) { return job.distinct && readings_.times(reading.text) > 1; });
    blame("repeated_code",
          [&](const CodeReading& reading) { return job.unlike_last && last_.contains(reading); });
    // One that was read out of focus has no grade, which is none that was asked for.
    blame("low_grade", [&](const CodeReading& reading) {
        return job.least_grade > 0 && reading.code.grade.overall < job.least_grade;
    });
    return all;
}

inline CodesVerdict CodeJudge::teach(ImageView<const Gray8> picture, const CodeJob& job,
                                     Span<std::uint8_t> scratch) {
    forget_taught();
    const auto fits = [&](const CodeReading& reading) { return job.allowed.allows(reading.text); };
    const Status read = taught_readings_.read(picture, job, scratch, [&](const CodeReading& reading) {
        return !job.ignores_others || fits(reading);
    });
    CodesVerdict all = verdict_of(read);
    if (read == Status::ok) all = count_of(taught_readings_, job);
    for (const CodeReading& reading : taught_readings_.codes())
        if (all.verdict == Verdict::ok && !fits(reading)) all = {Verdict::not_ok, "wrong_code"};
    for (const CodeReading& reading : taught_readings_.codes())
        if (all.verdict == Verdict::ok && job.distinct && taught_readings_.times(reading.text) > 1)
            all = {Verdict::not_ok, "duplicate_code"};
    if (all.verdict == Verdict::ok)
        taught_.take(taught_readings_.codes());
    else
        taught_readings_.clear();
    return all;
}

}  // namespace fovea::apps
