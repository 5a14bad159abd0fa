// SPDX-License-Identifier: MIT
//
// fovea compile: makes of a recipe the bytes that a chip reads.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/compiled_recipe.hpp>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>
#include <common/text.hpp>
#include <gauge/load_recipe.hpp>
#include <gauge/recipe_reader.hpp>

namespace fovea::apps {

inline Command compile_help() {
    return {
        "compile",
        "RECIPE",
        "Makes of a recipe the bytes that a chip reads.",
        {{"out", "FILE",
          "where to; a name that ends in .hpp or .h becomes a header, others\nthe bytes; required"}},
        "The bytes hold a version and a checksum. They are for `firmware_gauge`, which takes them into\n"
        "its flash when it is built (FOVEA_RECIPE) or over its serial line, and for `decode_recipe()`.\n"};
}

namespace detail {

/// The bytes as an array for a program.
inline std::string header_of(const std::string& recipe, const std::string& bytes) {
    std::string text = "// " + one_line(recipe) +
                       ", made by `fovea compile`\n#pragma once\n\n#include <cstdint>\n\n"
                       "inline constexpr std::uint8_t compiled_recipe[] = {";
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i > 0) text += ",";
        text += (i % 16 == 0 ? "\n    " : " ") + std::to_string(static_cast<unsigned char>(bytes[i]));
    }
    return text + "};\n";
}

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode compile_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(compile_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(compile_help()));
        return exit_ok;
    }
    std::string problem = arguments.problem();
    const std::vector<std::string>& operands = arguments.operands();
    const std::string out = arguments.value("out");
    if (problem.empty() && operands.size() != 1)
        problem = "which recipe? give one RECIPE; `fovea teach` makes one";
    if (problem.empty() && out.empty()) problem = "where to? give --out FILE";
    if (problem.empty() && out == operands[0])
        problem = "--out would overwrite " + out + "; give another name";
    if (!problem.empty()) {
        io.complain("fovea compile: " + problem);
        return exit_failed;
    }
    RecipeFile file;
    if (!load_recipe(io, operands[0], "`fovea compile` takes", file)) return exit_failed;
    std::vector<std::uint8_t> room(static_cast<std::size_t>(compiled_recipe_bytes(Recipe::max_features)));
    const Result<std::ptrdiff_t> size =
        encode_recipe(file.recipe, {room.data(), static_cast<std::ptrdiff_t>(room.size())});
    if (!size) {
        io.complain(operands[0] + ": " + describe(size.status()));
        return exit_failed;
    }
    std::string bytes(room.begin(), room.begin() + *size);
    if (ends_with_one_of(out, ".hpp|.h")) bytes = detail::header_of(operands[0], bytes);
    if (Status s = io.storage().save(out.c_str(), bytes_of(bytes)); s != Status::ok) {
        io.complain(file_problem(out, s, io.storage()));
        return exit_failed;
    }
    if (out != "-")
        io.print("wrote " + out + ": " + std::to_string(*size) + " bytes, " +
                 std::to_string(file.recipe.features.size()) + " features\n");
    return exit_ok;
}

}  // namespace fovea::apps
