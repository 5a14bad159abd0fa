// SPDX-License-Identifier: MIT
//
// fovea gauge: measures the parts in pictures by a recipe.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fovea/decision/gauge.hpp>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>
#include <gauge/explain.hpp>
#include <gauge/left_out.hpp>
#include <gauge/load_recipe.hpp>
#include <gauge/recipe_file.hpp>
#include <gauge/report.hpp>

namespace fovea::apps {

/// The most parts that are measured in one image.
inline constexpr int max_parts = 256;

inline Command gauge_help() {
    return {"gauge",
            "--job RECIPE IMAGE...",
            "Measures the parts in pictures by a recipe and says OK or not OK.",
            {{"job", "RECIPE", "the recipe, made by `fovea teach` or written by you;\nrequired"},
             {"json", "", "one JSON object a part instead of one line for people"},
             {"explain", "PICTURE",
              "write an annotated picture, PNG or PPM; of several\nimages, number n goes to "
              "PICTURE with -n before its ending"},
             {"parts", "N",
              "how many parts every picture must hold; another number\nthat is measured is a failure"},
             {"recipe-keys", "", "list every key of a recipe, and end"}},
            "Pictures are PGM, PPM, BMP, PNG or baseline JPEG; - is the standard input. Places and\n"
            "angles are those of the image: pixels, x right, y down, clockwise.\n\n"
            "Ends with 0 when every part is OK, with 1 when one is not, and with 2 when something\n"
            "could not be judged: no part, a feature without value, a file that cannot be read.\n"
            "What touches the border, or is too small or too large for a part, is not measured: a\n"
            "note on the standard error tells of it, and \"left_out\" in JSON.\n"};
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

namespace detail {

/// Says on the error stream what of a part has no value, and where the recipe asks for it.
template <class Io>
void complain_unmeasured(Io& io, const std::string& job, const RecipeFile& file, const std::string& part_name,
                         const PartResult& part) {
    const Status orientation = part.pose.orientation;
    if (orientation != Status::ok) {
        io.complain(
            part_name + ": " + orientation_problem(orientation) +
            (orientation == Status::undecided ? "; it may be damaged, dirty, turned over or another part; if "
                                                "the ends of all parts are alike, "
                                                "orientation = \"symmetric\" measures it"
             : file.recipe.locate.orientation == OrientationRule::rotational
                 ? "; it may be dirty or another part, or symmetry_order is another"
                 : "; orientation = \"none\" measures it as it lies, \"rotational\" by its symmetry"));
        return;
    }
    for (int i = 0; i < part.feature_count; ++i) {
        const FeatureResult& result = part.features[i];
        if (result.status == Status::ok) continue;
        const TextPlace place = file.feature_places[static_cast<std::size_t>(i)];
        io.complain(job + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": " +
                    text_of(file.recipe.features[i].name) + ": " +
                    reason_of(result, file.recipe.features[i]) + " (" + part_name + ")");
    }
}

/// What the words of the command ask for.
struct GaugeOptions {
    std::string job;
    std::string explain_name;  ///< "" for no picture
    bool json = false;
    int parts = 0;  ///< that every image must hold; 0 for any number
};

/// Measures one image, and answers how it went; explain_name is that of its own picture.
template <class Io>
ExitCode gauge_image(Io& io, const GaugeOptions& options, const RecipeFile& file, const std::string& name,
                     const std::string& explain_name) {
    Picture<Gray8> image;
    std::string problem;  // names the image
    std::string reason;   // does not
    std::vector<PartResult> parts;
    LeftOut left_out;
    ExitCode code = exit_ok;
    if (load_gray(io.storage(), name, image, problem)) {
        const Status status = gauge_picture(image, file.recipe, parts);
        left_out = left_out_of(image, file.recipe.locate);
        if (status == Status::capacity_exceeded) {
            // What was left out was not judged.
            code = exit_failed;
            io.complain(name + ": " +
                        (parts.size() == max_parts
                             ? "more than " + std::to_string(max_parts) + " parts; the largest are measured"
                             : "more holes than there is room for; raise `hole_area_min`"));
        } else if (status != Status::ok || parts.empty()) {
            reason = no_part_problem(image, file.recipe.locate, status);
            problem = name + ": " + reason;
        }
    } else {
        reason =
            problem.compare(0, name.size() + 2, name + ": ") == 0 ? problem.substr(name.size() + 2) : problem;
    }
    if (parts.empty()) code = exit_failed;
    if (!problem.empty()) {
        io.complain(problem);
        if (options.json) io.print(json_no_part(name, left_out.count(), reason));
    } else if (left_out.count() > 0) {
        io.complain(name + ": note: " + left_out_note(left_out, file.recipe.locate));
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const PartResult& part = parts[i];
        const int index = static_cast<int>(i);
        io.print(options.json ? json_part(name, index, left_out.count(), part, file.recipe)
                              : human_part(name, index, part, file.recipe));
        complain_unmeasured(io, options.job, file, name + " part " + std::to_string(i), part);
        code = worse(code, part.verdict == Verdict::ok       ? exit_ok
                           : part.verdict == Verdict::not_ok ? exit_not_ok
                                                             : exit_failed);
    }
    if (options.parts != 0 && static_cast<int>(parts.size()) != options.parts && !image.size.empty()) {
        io.complain(name + ": " + std::to_string(parts.size()) + (parts.size() == 1 ? " part" : " parts") +
                    " measured, and --parts asks for " + std::to_string(options.parts));
        code = exit_failed;
    }
    if (!explain_name.empty() && !image.size.empty() &&
        !save_picture(io.storage(), explain_name, explain(image, file.recipe, parts, left_out, reason),
                      problem)) {
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
    detail::GaugeOptions options;
    options.job = arguments.value("job");
    options.explain_name = arguments.value("explain");
    options.json = arguments.has("json");
    const std::string& job = options.job;
    const std::string& explain_name = options.explain_name;
    if (problem.empty() && job.empty()) problem = "which recipe? give --job RECIPE; `fovea teach` makes one";
    if (problem.empty() && arguments.operands().empty()) problem = "which picture? give at least one IMAGE";
    if (problem.empty()) whole_option(arguments, "parts", 1, max_parts, options.parts, problem);
    const std::vector<std::string>& images = arguments.operands();
    const auto picture_of = [&](std::size_t i) {
        return explain_name.empty() || images.size() == 1 ? explain_name : numbered(explain_name, i);
    };
    if (problem.empty() && explain_name == "-")
        problem = "--explain writes a file; the standard output has the results";
    if (const std::string refusal = picture_name_problem(explain_name); problem.empty() && !refusal.empty())
        problem = "--explain " + refusal;
    for (std::size_t i = 0; problem.empty() && i < images.size(); ++i)
        if (const std::string picture = picture_of(i);
            picture == job || std::find(images.begin(), images.end(), picture) != images.end())
            problem = "--explain would overwrite " + picture + "; give another name";
    if (!problem.empty()) {
        io.complain("fovea gauge: " + problem);
        return exit_failed;
    }
    RecipeFile file;
    if (!load_recipe(io, job, "--job takes", file)) return exit_failed;
    ExitCode code = exit_ok;
    for (std::size_t i = 0; i < images.size(); ++i)
        code = worse(code, detail::gauge_image(io, options, file, images[i], picture_of(i)));
    return code;
}

}  // namespace fovea::apps
