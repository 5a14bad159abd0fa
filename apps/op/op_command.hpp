// SPDX-License-Identifier: MIT
//
// fovea op: applies operators of the catalogue to a picture.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>
#include <op/pipeline.hpp>
#include <op/show.hpp>

namespace fovea::apps {

inline Command op_help() {
    return {"op",
            "PIPELINE PICTURE [SECOND] OUT",
            "Applies operators to a picture.",
            {{"json", "", "one line of JSON for each step"}},
            "PIPELINE is one operator, or several with | between, in quotes:\n"
            "  fovea op sobel_magnitude part.jpg edges.png\n"
            "  fovea op 'gaussian_5x5 | otsu | open:3' part.jpg out.png\n"
            "  fovea op 'box:width=9,height=3,border=zero' part.jpg out.png\n"
            "The beginning of a name does where it is the only one. `fovea ops` lists them all.\n"
            "SECOND is for operators of two pictures, such as absolute_difference.\n"
            "Derivatives and sums are shown in grey levels: 128 stands for zero where there are\n"
            "negative numbers, and the largest number for the end of the range.\n"};
}

namespace detail {

/// A file as the pixels that an operator takes.
template <class Storage>
bool load_any(Storage& storage, const std::string& name, PixelKind kind, AnyPicture& picture,
              std::string& problem) {
    const auto take = [&](const auto& read) {
        picture = AnyPicture(kind, read.size);
        std::memcpy(picture.bytes.data(), read.pixels.data(), picture.bytes.size());
    };
    if (kind == PixelKind::gray8) {
        Picture<Gray8> read;
        if (!load_picture(storage, name, max_image_side, read, problem)) return false;
        take(read);
        return true;
    }
    if (kind == PixelKind::rgb888) {
        Picture<Rgb888> read;
        if (!load_picture(storage, name, max_image_side, read, problem)) return false;
        take(read);
        return true;
    }
    problem = std::string("a picture file cannot give ") + describe(kind);
    return false;
}

/// Runs a pipeline on files; second is for operators of two pictures. after(step, output, scratch_bytes) sees
/// what each step makes. False if something failed, and problem says what: a file, or an operator of command.
template <class Storage, class After>
bool run_pipeline(Storage& storage, const char* command, const std::vector<PipelineStep>& steps,
                  const std::string& first, const std::string& second, After after, AnyPicture& picture,
                  std::string& problem) {
    if (!load_any(storage, first, steps[0].op->inputs[0], picture, problem)) return false;
    for (const PipelineStep& step : steps) {
        AnyPicture other;
        const bool two = step.op->input_count() == 2;
        if (two && !load_any(storage, second, step.op->inputs[1], other, problem)) return false;
        AnyPicture output;
        std::int64_t scratch_bytes = 0;
        if (const Status status = run_step(step, picture, two ? &other : nullptr, output, scratch_bytes);
            status != Status::ok) {
            problem = std::string("fovea ") + command + ": " + step.op->name + ": " + describe(status) +
                      " (" + std::to_string(picture.size.width) + "x" + std::to_string(picture.size.height) +
                      ")";
            return false;
        }
        after(step, output, scratch_bytes);
        picture = std::move(output);
    }
    return true;
}

inline bool takes_two(const std::vector<PipelineStep>& steps) {
    return std::any_of(steps.begin(), steps.end(),
                       [](const PipelineStep& step) { return step.op->input_count() == 2; });
}

inline std::string json_step(const PipelineStep& step, const AnyPicture& output, std::int64_t scratch_bytes) {
    std::string text = "{\"schema\":1,\"op\":" + json_string(step.op->name) + ",\"values\":{";
    for (std::size_t i = 0; i < step.values.size(); ++i) {
        const OperatorParameter& parameter = step.op->parameters[i];
        const std::string value = value_text(parameter, step.values[i]);
        text += (i == 0 ? "" : ",") + json_string(parameter.name) + ":" +
                (parameter.choices != nullptr ? json_string(value) : value);
    }
    return text + "},\"pixel\":" + json_string(describe(step.op->output)) +
           ",\"width_px\":" + std::to_string(output.size.width) +
           ",\"height_px\":" + std::to_string(output.size.height) +
           ",\"scratch_bytes\":" + std::to_string(scratch_bytes) + "}\n";
}

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode op_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(op_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(op_help()));
        return exit_ok;
    }
    const std::vector<std::string>& operands = arguments.operands();
    std::string problem = arguments.problem();
    std::vector<PipelineStep> steps;
    if (problem.empty() && operands.size() < 3)
        problem =
            "needs a pipeline, a picture and the picture to write, such as: fovea op sobel_magnitude in.jpg "
            "out.png";
    if (problem.empty()) parse_pipeline(operands[0], steps, problem);
    const bool wants_second = detail::takes_two(steps);
    if (problem.empty() && operands.size() != (wants_second ? 4u : 3u))
        problem = wants_second ? "the pipeline takes two pictures, and the one to write behind them"
                               : "what is " + one_line(operands[3]) + "? the pipeline takes one picture";
    if (problem.empty()) problem = picture_name_problem(operands.back());
    if (!problem.empty()) {
        io.complain("fovea op: " + problem);
        return exit_failed;
    }

    AnyPicture picture;
    const auto after = [&](const PipelineStep& step, const AnyPicture& output, std::int64_t scratch_bytes) {
        if (arguments.has("json")) io.print(detail::json_step(step, output, scratch_bytes));
    };
    if (!detail::run_pipeline(io.storage(), "op", steps, operands[1], wants_second ? operands[2] : "", after,
                              picture, problem)) {
        io.complain(problem);
        return exit_failed;
    }
    std::string note;
    if (!save_shown(io.storage(), operands.back(), picture, note, problem)) {
        io.complain(problem);
        return exit_failed;
    }
    if (!arguments.has("json") && operands.back() != "-") io.print("wrote " + operands.back() + note + "\n");
    return exit_ok;
}

}  // namespace fovea::apps
