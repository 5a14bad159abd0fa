// SPDX-License-Identifier: MIT
//
// fovea gauge: measures the parts in pictures by a recipe.
#pragma once

#include <string>
#include <vector>

#include <fovea/decision/gauge.hpp>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>
#include <gauge/explain.hpp>
#include <gauge/recipe_file.hpp>
#include <gauge/report.hpp>

namespace fovea::apps {

/// The most parts that are measured in one image.
inline constexpr int max_parts = 256;

inline Command gauge_help() {
    return {"gauge",
            "--job RECIPE IMAGE...",
            "Measures the parts in pictures by a recipe and says OK or not OK.",
            {{"job", "RECIPE", "the recipe, a file that `fovea teach` made or you wrote; required"},
             {"json", "", "one JSON object a part instead of one line for people"},
             {"explain", "PICTURE",
              "write an annotated picture, PNG or PPM; of several\nimages, number n goes to "
              "PICTURE with -n before its ending"},
             {"recipe-keys", "", "list every key of a recipe, and end"}},
            "Pictures are PGM, PPM, BMP, PNG or baseline JPEG; - is the standard input. Places and\n"
            "angles are those of the image: pixels, x right, y down, clockwise.\n\n"
            "Ends with 0 when every part is OK, with 1 when one is not, and with 2 when something\n"
            "could not be judged: no part, a feature without value, a file that cannot be read.\n"};
}

/// Measures one picture.
inline Status gauge_picture(const Picture<Gray8>& image, const Recipe& recipe,
                            std::vector<PartResult>& parts) {
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(gauge_scratch(image.size, recipe.locate, max_parts)));
    parts.resize(max_parts);
    int count = 0;
    const Status status =
        gauge(image.view(), recipe, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
              ListView<PartResult>(parts.data(), max_parts, &count));
    parts.resize(static_cast<std::size_t>(count));
    return status;
}

/// Why an image has no judged part, for people.
inline std::string gauge_problem(Status status) {
    if (status == Status::ok) return "no part found: is `part` (dark or bright) right, and `area_min`?";
    if (status == Status::degenerate) return "part and ground cannot be told apart: all pixels are alike";
    return describe(status);
}

namespace detail {

/// "a/b.png" and 2 make "a/b-2.png".
inline std::string numbered(const std::string& name, std::size_t number) {
    const std::size_t dot = name.rfind('.');
    const std::size_t slash = name.rfind('/');
    const bool has_ending = dot != std::string::npos && (slash == std::string::npos || dot > slash + 1);
    const std::string ending = has_ending ? name.substr(dot) : "";
    return name.substr(0, name.size() - ending.size()) + "-" + std::to_string(number) + ending;
}

/// Says on the error stream which features have no value and where the recipe asks for them.
template <class Io>
void complain_unmeasured(Io& io, const std::string& job, const RecipeFile& file, const std::string& image,
                         std::size_t index, const PartResult& part) {
    for (int i = 0; i < part.feature_count; ++i) {
        const FeatureResult& result = part.features[i];
        if (result.status == Status::ok) continue;
        const TextPlace place = file.feature_places[static_cast<std::size_t>(i)];
        io.complain(job + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": " +
                    text_of(file.recipe.features[i].name) + ": " +
                    reason_of(result, file.recipe.features[i]) + " (" + image + " part " +
                    std::to_string(index) + ")");
    }
}

template <class Io>
ExitCode gauge_image(Io& io, const std::string& job, const RecipeFile& file, const std::string& name,
                     const std::string& explain_name, bool json) {
    Picture<Gray8> image;
    std::string problem;
    std::vector<PartResult> parts;
    if (load_gray(io.storage(), name, image, problem)) {
        const Status status = gauge_picture(image, file.recipe, parts);
        if (status == Status::capacity_exceeded)
            io.complain(name + ": more than " + std::to_string(max_parts) +
                        " parts; the largest are measured");
        else if (status != Status::ok || parts.empty())
            problem = name + ": " + gauge_problem(status);
    }
    ExitCode code = parts.empty() ? exit_failed : exit_ok;
    if (!problem.empty()) {
        io.complain(problem);
        if (json) io.print(json_no_part(name, problem));
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const PartResult& part = parts[i];
        const int index = static_cast<int>(i);
        io.print(json ? json_part(name, index, part, file.recipe)
                      : human_part(name, index, part, file.recipe));
        complain_unmeasured(io, job, file, name, i, part);
        code = worse(code, part.verdict == Verdict::ok       ? exit_ok
                           : part.verdict == Verdict::not_ok ? exit_not_ok
                                                             : exit_failed);
    }
    if (!explain_name.empty() && !image.size.empty() &&
        !save_picture(io.storage(), explain_name, explain(image, file.recipe, parts), problem)) {
        io.complain(problem);
        code = exit_failed;
    }
    return code;
}

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode gauge_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(gauge_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(gauge_help()));
        return exit_ok;
    }
    if (arguments.has("recipe-keys")) {
        io.print(recipe_help());
        return exit_ok;
    }
    std::string problem = arguments.problem();
    const std::string job = arguments.value("job");
    if (problem.empty() && job.empty()) problem = "which recipe? give --job RECIPE; `fovea teach` makes one";
    if (problem.empty() && arguments.operands().empty()) problem = "which picture? give at least one IMAGE";
    if (!problem.empty()) {
        io.complain("fovea gauge: " + problem);
        return exit_failed;
    }
    const Result<Span<const std::uint8_t>> text = io.storage().load(job.c_str());
    if (!text) {
        io.complain(file_problem(job, text.status(), io.storage()));
        return exit_failed;
    }
    const RecipeFile file = read_recipe(std::string(text->begin(), text->end()));
    if (!file.problem.empty()) {
        io.complain(job + ":" + std::to_string(file.place.line) + ":" + std::to_string(file.place.column) +
                    ": " + file.problem);
        return exit_failed;
    }
    const std::string explain_name = arguments.value("explain");
    const std::vector<std::string>& images = arguments.operands();
    ExitCode code = exit_ok;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const std::string picture =
            explain_name.empty() || images.size() == 1 ? explain_name : detail::numbered(explain_name, i);
        code = worse(code, detail::gauge_image(io, job, file, images[i], picture, arguments.has("json")));
    }
    return code;
}

}  // namespace fovea::apps
