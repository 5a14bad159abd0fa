// SPDX-License-Identifier: MIT
//
// What is wrong with the text of a recipe. Host tests only.
#pragma once

#include <string>

#include <gauge/recipe_file.hpp>

namespace fovea::test {

/// "line:column: problem", "" for a good recipe.
inline std::string problem_of(const std::string& text) {
    const apps::RecipeFile file = apps::read_recipe(text);
    if (file.problem.empty()) return "";
    return std::to_string(file.place.line) + ":" + std::to_string(file.place.column) + ": " + file.problem;
}

inline const std::string a_count =
    "[[feature]]\nname = \"n\"\nkind = \"hole_count\"\nnominal = 2\nminus = 0\nplus = 0\n";
/// A recipe with a line of [locate] or [scale] at 3:1, and a feature.
inline std::string in_locate(const std::string& line) {
    return "format = 1\n[locate]\n" + line + "\n" + a_count;
}
inline std::string in_scale(const std::string& line) {
    return "format = 1\n[scale]\n" + line + "\n" + a_count;
}

}  // namespace fovea::test
