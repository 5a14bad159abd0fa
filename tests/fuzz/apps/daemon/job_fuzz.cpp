// SPDX-License-Identifier: MIT
//
// Any bytes as a job: it is refused with a place in it and a line of text, or what it says of codes lies in
// its ranges and answers for any text.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include <common/text.hpp>
#include <daemon/jobs.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    apps::Job job;
    const std::string problem = apps::read_job(text, job);
    const apps::CodeJobFile file = apps::read_code_job(text);
    require(file.place.line >= 1 && file.place.column >= 1 && apps::printable(file.problem));
    if (file.place.line > 1) require(std::count(text.begin(), text.end(), '\n') >= file.place.line - 1);
    if (!problem.empty()) {
        require(apps::printable(problem) && problem.find(": ") != std::string::npos);
        return 0;
    }
    require(job.gauges || job.reads);
    if (!job.reads) return 0;
    // All else stands where it stood.
    require(file.recipe.size() == text.size());
    for (std::size_t k = 0; k < size; ++k) require(file.recipe[k] == text[k] || file.recipe[k] == ' ');
    const apps::CodeJob& codes = job.codes;
    require(codes.count >= 1 && codes.count <= apps::CodeJob::most_codes);
    require(codes.options.most_codes > codes.count && codes.options.most_codes <= apps::CodeJob::most_seen);
    require(!codes.options.symbologies.empty() && is_valid(codes.options.rules));
    require(codes.least_grade >= 0 && codes.least_grade <= 4);
    if (!codes.region.empty())
        require(codes.region.x >= 0 && codes.region.y >= 0 &&
                codes.inside({max_image_side * 2, max_image_side * 2}));
    const bool allowed = codes.allowed.allows(apps::span_of(text));
    require(allowed || !codes.allowed.empty());
    return 0;
}
