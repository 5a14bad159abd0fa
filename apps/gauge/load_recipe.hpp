// SPDX-License-Identifier: MIT
//
// Recipes from a storage, with a word on what is wrong with them.
#pragma once

#include <cstdint>
#include <string>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/any_picture.hpp>

#include <common/io.hpp>
#include <gauge/recipe_reader.hpp>

namespace fovea::apps {

/// Reads a recipe by its name. False, and complained about, if there is none; who takes it is "--job takes"
/// and the like.
template <class Io>
bool load_recipe(Io& io, const std::string& name, const std::string& who_takes, RecipeFile& file) {
    const Result<Span<const std::uint8_t>> text = io.storage().load(name.c_str());
    if (!text) {
        io.complain(file_problem(name, text.status(), io.storage()));
        return false;
    }
    if (picture_format(*text) != PictureFormat::unknown) {
        io.complain(name + ": a picture, not a recipe; " + who_takes + " the file that `fovea teach` wrote");
        return false;
    }
    file = read_recipe(std::string(text->begin(), text->end()));
    if (file.problem.empty()) return true;
    io.complain(name + ":" + std::to_string(file.place.line) + ":" + std::to_string(file.place.column) +
                ": " + file.problem);
    return false;
}

}  // namespace fovea::apps
