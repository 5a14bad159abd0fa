// SPDX-License-Identifier: MIT
//
// fovea gauge: measures the parts in pictures by a recipe.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fovea/codec/any_picture.hpp>
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
            {{"job", "RECIPE", "the recipe, made by `fovea teach` or written by you;\nrequired"},
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

/// Why an image has no judged part, for people: what gauge_picture() answered, and what is there instead.
inline std::string no_part_problem(const Picture<Gray8>& image, const Recipe& recipe, Status status);

namespace detail {

/// The largest region of the part's brightness, whatever its area; an empty one if there is none.
inline Region largest_region(const Picture<Gray8>& image, LocateRule rule, bool at_border) {
    rule.area_min = 1;
    rule.area_max = LocateRule().area_max;
    rule.at_border = at_border;
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(find_parts_scratch(image.size, rule)));
    Threshold threshold;
    Region region;
    Hole hole;
    int regions = 0;
    int holes = 0;
    // A list for one region keeps the largest, and says that there were more.
    static_cast<void>(find_parts(image.view(), rule,
                                 {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, threshold,
                                 ListView<Region>(&region, 1, &regions), ListView<Hole>(&hole, 1, &holes)));
    return regions == 1 ? region : Region();
}

/// "a/b.png" and 2 make "a/b-2.png".
inline std::string numbered(const std::string& name, std::size_t number) {
    const std::size_t dot = name.rfind('.');
    const std::size_t slash = name.rfind('/');
    const std::size_t start = slash == std::string::npos ? 0 : slash + 1;
    const bool has_ending = dot != std::string::npos && dot > start;
    const std::string ending = has_ending ? name.substr(dot) : "";
    return name.substr(0, name.size() - ending.size()) + "-" + std::to_string(number) + ending;
}

/// Says on the error stream what of a part has no value, and where the recipe asks for it.
template <class Io>
void complain_unmeasured(Io& io, const std::string& job, const RecipeFile& file, const std::string& part_name,
                         const PartResult& part) {
    const Status orientation = part.pose.orientation;
    if (orientation != Status::ok) {
        io.complain(
            part_name + ": " + orientation_problem(orientation) +
            (orientation == Status::undecided
                 ? "; it may be dirty, turned over or another part, or orientation = \"symmetric\" suits it"
                 : "; orientation = \"none\" measures it as it lies"));
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

template <class Io>
ExitCode gauge_image(Io& io, const std::string& job, const RecipeFile& file, const std::string& name,
                     const std::string& explain_name, bool json) {
    Picture<Gray8> image;
    std::string problem;
    std::vector<PartResult> parts;
    ExitCode code = exit_ok;
    if (load_gray(io.storage(), name, image, problem)) {
        const Status status = gauge_picture(image, file.recipe, parts);
        if (status == Status::capacity_exceeded) {
            // What was left out was not judged.
            code = exit_failed;
            io.complain(name + ": " +
                        (parts.size() == max_parts
                             ? "more than " + std::to_string(max_parts) + " parts; the largest are measured"
                             : "more holes than there is room for; raise `hole_area_min`"));
        } else if (status != Status::ok || parts.empty()) {
            problem = name + ": " + no_part_problem(image, file.recipe, status);
        }
    }
    if (parts.empty()) code = exit_failed;
    if (!problem.empty()) {
        io.complain(problem);
        const std::size_t named = problem.compare(0, name.size(), name) == 0 ? name.size() + 2 : 0;
        if (json) io.print(json_no_part(name, problem.substr(std::min(named, problem.size()))));
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const PartResult& part = parts[i];
        const int index = static_cast<int>(i);
        io.print(json ? json_part(name, index, part, file.recipe)
                      : human_part(name, index, part, file.recipe));
        complain_unmeasured(io, job, file, name + " part " + std::to_string(i), part);
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

inline std::string no_part_problem(const Picture<Gray8>& image, const Recipe& recipe, Status status) {
    const LocateRule& rule = recipe.locate;
    if (status == Status::degenerate)
        return std::string("part and ground cannot be told apart: all pixels are ") +
               (rule.threshold == ThresholdRule::otsu ? "alike" : "on one side of the threshold");
    if (status != Status::ok) return describe(status);
    const Region whole = detail::largest_region(image, rule, rule.at_border);
    const Region any = detail::largest_region(image, rule, true);
    const std::string kind = rule.dark_part ? "dark" : "bright";
    const auto pixels = [](const Region& region) { return std::to_string(region.moments.area()) + " px"; };
    std::string text = "no part found: ";
    if (any.moments.area() == 0) return text + "`opening` clears everything that is " + kind;
    if (whole.moments.area() < rule.area_min && any.moments.area() > whole.moments.area())
        return text + "the largest " + kind + " region, " + pixels(any) +
               ", touches the border; does the part lie whole in the picture, and is `part` right?";
    text += "the largest " + kind + " region has " + pixels(whole);
    if (whole.moments.area() < rule.area_min)
        return text + ", and `area_min` is " + std::to_string(rule.area_min);
    return text + ", and `area_max` is " + std::to_string(rule.area_max);
}

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
    const std::string explain_name = arguments.value("explain");
    const std::vector<std::string>& images = arguments.operands();
    const auto picture_of = [&](std::size_t i) {
        return explain_name.empty() || images.size() == 1 ? explain_name : detail::numbered(explain_name, i);
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
    const Result<Span<const std::uint8_t>> text = io.storage().load(job.c_str());
    if (!text) {
        io.complain(file_problem(job, text.status(), io.storage()));
        return exit_failed;
    }
    if (picture_format(*text) != PictureFormat::unknown) {
        io.complain(job + ": a picture, not a recipe; --job takes the file that `fovea teach` wrote");
        return exit_failed;
    }
    const RecipeFile file = read_recipe(std::string(text->begin(), text->end()));
    if (!file.problem.empty()) {
        io.complain(job + ":" + std::to_string(file.place.line) + ":" + std::to_string(file.place.column) +
                    ": " + file.problem);
        return exit_failed;
    }
    ExitCode code = exit_ok;
    for (std::size_t i = 0; i < images.size(); ++i)
        code =
            worse(code, detail::gauge_image(io, job, file, images[i], picture_of(i), arguments.has("json")));
    return code;
}

}  // namespace fovea::apps
