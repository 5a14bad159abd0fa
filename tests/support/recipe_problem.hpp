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

}  // namespace fovea::test
