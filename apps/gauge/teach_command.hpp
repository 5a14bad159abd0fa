// SPDX-License-Identifier: MIT
//
// fovea teach: proposes a recipe from pictures of good parts.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fovea/codec/any_picture.hpp>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>
#include <gauge/explain.hpp>
#include <gauge/gauge_command.hpp>
#include <gauge/recipe_file.hpp>
#include <gauge/teach.hpp>

namespace fovea::apps {

inline Command teach_help() {
    return {"teach",
            "--out RECIPE GOOD...",
            "Proposes a recipe from pictures of good parts.",
            {{"out", "RECIPE",
              "the recipe to write, - for the standard output; required.\nOne that is there already is kept "
              "as RECIPE~"},
             {"name", "NAME", "what the part is called"},
             {"part", "dark|bright", "brightness of the part on its ground; found out if not\ngiven"},
             {"known-length", "MM",
              "the part's length along its axis, or its diameter: makes\nthe scale. Pictures of "
              "parts that lie along the rows and\nacross them make one for each direction"},
             {"mm-per-px", "MM", "the length of a pixel, if it is known"},
             {"tolerance", "T",
              "allowed deviation of every length, in mm if there is a\nscale, else in px; half a pixel if "
              "not given"},
             {"explain", "PICTURE", "write the first picture with the proposal drawn in"}},
            "Parts must lie whole in the pictures; several parts in one picture are several samples.\n"
            "Nominal values are the means over all of them. Read the recipe before you rely on it:\n"
            "names, nominal values and tolerances are yours to set.\n"};
}

namespace detail {

/// Reads a positive decimal option; false if it is none.
inline bool positive_option(const Arguments& arguments, const std::string& name,
                            std::optional<std::int64_t>& value, std::string& problem) {
    if (!arguments.has(name)) return true;
    const std::string text = arguments.value(name);
    const Result<Decimal> number = parse_decimal(span_of(text));
    if (number && number->millionths > 0 && number->millionths <= max_part_coordinate) {
        value = number->millionths;
        return true;
    }
    problem = "--" + name + " takes a positive number up to 100000 such as 12.5, not '" + text + "'";
    return false;
}

inline bool teach_options(const Arguments& arguments, TeachOptions& options, std::string& problem) {
    options.name = arguments.value("name");
    if (arguments.has("name") && !good_name(options.name)) {
        problem =
            "--name takes 1 to " + std::to_string(Feature::max_name) + " bytes without control characters";
        return false;
    }
    const std::string part = arguments.value("part");
    if (arguments.has("part") && part != "dark" && part != "bright") {
        problem = "--part is dark or bright, not '" + part + "'";
        return false;
    }
    if (arguments.has("part")) options.dark = part == "dark";
    std::optional<std::int64_t> per_pixel;
    if (!positive_option(arguments, "known-length", options.known_length, problem) ||
        !positive_option(arguments, "mm-per-px", per_pixel, problem) ||
        !positive_option(arguments, "tolerance", options.tolerance, problem))
        return false;
    if (per_pixel) options.scale = Scale{LengthUnit::millimetre, *per_pixel, *per_pixel};
    if (per_pixel && options.known_length)
        problem = "--known-length and --mm-per-px both give the scale; give one";
    if (per_pixel && !scale_in_range(*options.scale)) problem = "--mm-per-px is from 0.00001 to 100";
    return problem.empty();
}

/// What is wrong with the names of the files to write; "" if nothing is.
inline std::string overwritten(const Arguments& arguments) {
    const std::vector<std::string>& pictures = arguments.operands();
    const std::string explain_name = arguments.value("explain");
    if (explain_name == "-") return "--explain writes a file; give it a name";
    if (const std::string refusal = picture_name_problem(explain_name); !refusal.empty())
        return "--explain " + refusal;
    for (const char* option : {"out", "explain"}) {
        const std::string name = arguments.value(option);
        if (name != "-" && std::find(pictures.begin(), pictures.end(), name) != pictures.end())
            return std::string("--") + option + " would overwrite the picture " + name +
                   "; give another name";
    }
    if (!explain_name.empty() && explain_name == arguments.value("out"))
        return "--explain would overwrite the recipe " + explain_name + "; give another name";
    return "";
}

/// Saves a recipe. The one that it replaces is kept beside it, because people edit recipes; a picture is
/// never replaced. Answers what went wrong, "" if nothing; note says what was kept.
template <class Io>
std::string save_recipe(Io& io, const std::string& name, const std::string& text, std::string& note) {
    const auto save = [&](const std::string& to, Span<const std::uint8_t> bytes) -> std::string {
        const Status status = io.storage().save(to.c_str(), bytes);
        return status == Status::ok ? "" : file_problem(to, status, io.storage());
    };
    // A stream or a device keeps nothing, and reading from it would wait.
    Result<Span<const std::uint8_t>> old = Status::not_found;
    if (name != "-" && name.rfind("/dev/", 0) != 0) old = io.storage().load(name.c_str());
    if (old && picture_format(*old) != PictureFormat::unknown)
        return "fovea teach: --out would overwrite the picture " + name + "; give the recipe another name";
    if (old && !old->empty() && std::string(old->begin(), old->end()) != text) {
        std::string problem = save(name + "~", *old);
        if (!problem.empty()) return problem;
        note = "the recipe before is " + name + "~\n";
    }
    return save(name, bytes_of(text));
}

/// What was proposed, for people.
inline std::string summary(const Taught& taught) {
    const Recipe& recipe = taught.recipe;
    const std::size_t count = taught.samples.parts.size();
    std::string text = std::to_string(count) + (count == 1 ? " good part, " : " good parts, ") +
                       (recipe.locate.dark_part ? "dark on bright" : "bright on dark") + ", ";
    switch (recipe.locate.orientation) {
        case OrientationRule::full: text += "with ends that can be told apart\n"; break;
        case OrientationRule::symmetric: text += "the same when turned by half\n"; break;
        case OrientationRule::rotational:
            text += "the same in " + std::to_string(recipe.locate.symmetry_order) + " directions\n";
            break;
        case OrientationRule::none: text += "without a direction\n"; break;
    }
    if (recipe.scale.unit == LengthUnit::millimetre)
        text += "a pixel is " + shortest(Decimal{recipe.scale.x_per_pixel}) + " mm wide and " +
                shortest(Decimal{recipe.scale.y_per_pixel}) + " mm high\n";
    for (const Feature& feature : recipe.features) {
        const int places = places_of(feature, recipe.scale);
        const std::string unit = unit_of(feature, recipe.scale);
        const std::string name = "  " + text_of(feature.name);
        text += name + std::string(name.size() < 22 ? 22 - name.size() : 1, ' ') +
                number(feature.tolerance.nominal, places) + (unit.empty() ? "" : " ") + unit + "  -" +
                number(feature.tolerance.minus, places) + " +" + number(feature.tolerance.plus, places) +
                "\n";
    }
    return text;
}

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode teach_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(teach_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(teach_help()));
        return exit_ok;
    }
    std::string problem = arguments.problem();
    TeachOptions options;
    const std::string out = arguments.value("out");
    if (problem.empty() && out.empty()) problem = "where to? give --out RECIPE";
    if (problem.empty() && arguments.operands().empty())
        problem = "which picture? give at least one GOOD part";
    if (problem.empty()) detail::teach_options(arguments, options, problem);
    if (problem.empty()) problem = detail::overwritten(arguments);
    if (!problem.empty()) {
        io.complain("fovea teach: " + problem);
        return exit_failed;
    }
    std::vector<Picture<Gray8>> images(arguments.operands().size());
    for (std::size_t i = 0; i < images.size(); ++i)
        if (!load_gray(io.storage(), arguments.operands()[i], images[i], problem)) {
            io.complain(problem);
            return exit_failed;
        }
    const Taught taught = teach(images, arguments.operands(), options);
    for (const std::string& note : taught.notes) io.complain("note: " + note);
    if (!taught.problem.empty()) {
        io.complain("fovea teach: " + taught.problem);
        return exit_failed;
    }
    const std::string text = write_recipe(taught.recipe);
    if (const RecipeFile file = read_recipe(text); !file.problem.empty()) {
        io.complain("fovea teach: the recipe would be out of range: " + file.problem);
        return exit_failed;
    }
    std::string kept;
    problem = detail::save_recipe(io, out, text, kept);
    if (!problem.empty()) {
        io.complain(problem);
        return exit_failed;
    }
    if (out != "-") io.print(detail::summary(taught) + "wrote " + out + "\n" + kept);
    if (arguments.has("explain")) {
        std::vector<PartResult> parts;
        static_cast<void>(gauge_picture(images[0], taught.recipe, parts));
        if (!save_picture(io.storage(), arguments.value("explain"), explain(images[0], taught.recipe, parts),
                          problem)) {
            io.complain(problem);
            return exit_failed;
        }
    }
    return exit_ok;
}

}  // namespace fovea::apps
