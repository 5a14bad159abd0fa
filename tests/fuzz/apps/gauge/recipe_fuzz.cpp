// SPDX-License-Identifier: MIT
//
// Any bytes as a recipe: it is refused with a place and a line of text, or it is written and read back as the
// same recipe, and measures a small picture without a slip.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gauge/gauge_command.hpp>
#include <gauge/recipe_file.hpp>
#include <support/recipes.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

/// 48 x 32: a dark plate with a cut corner and two holes, and a bright and a dark speck at the border.
apps::Picture<Gray8> plate() {
    apps::Picture<Gray8> picture({48, 32});
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x) {
            const bool part = x >= 8 && x < 40 && y >= 8 && y < 24 && x + y < 60;
            const bool hole = (x - 14) * (x - 14) + (y - 15) * (y - 15) < 12 ||
                              (x - 30) * (x - 30) + (y - 16) * (y - 16) < 20;
            picture.view()(x, y) = static_cast<Gray8>((part && !hole ? 40 : 200) + (x * 7 + y * 13) % 5);
        }
    picture.view()(0, 16) = 30;
    picture.view()(47, 31) = 255;
    return picture;
}

void gauge_with(const Recipe& recipe) {
    static const apps::Picture<Gray8> picture = plate();
    // Few parts, so that the scratch memory is small.
    constexpr int most = 4;
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(gauge_scratch(picture.size, recipe.locate, most)));
    std::vector<PartResult> parts(most);
    int count = 0;
    const Status status =
        gauge(picture.view(), recipe, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
              ListView<PartResult>(parts.data(), most, &count));
    require(status == Status::ok || status == Status::degenerate || status == Status::capacity_exceeded);
    for (int i = 0; i < count; ++i) {
        const PartResult& part = parts[static_cast<std::size_t>(i)];
        require(part.feature_count == recipe.features.size());
        for (int k = 0; k < part.feature_count; ++k)
            require((part.features[k].status == Status::ok) ==
                    (part.features[k].verdict != Verdict::unmeasured));
        require(!apps::human_part("picture", i, part, recipe).empty());
        require(!apps::json_part("picture", i, 0, part, recipe).empty());
    }
    parts.resize(static_cast<std::size_t>(count));
    require(!apps::explain(picture, recipe, parts).size.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const apps::RecipeFile file = apps::read_recipe(std::string(data, data + size));
    if (!file.problem.empty()) {
        require(apps::printable(file.problem) && file.place.line >= 1 && file.place.column >= 1);
        return 0;
    }
    for (const bool comments : {false, true}) {
        const std::string text = apps::write_recipe(file.recipe, comments);
        const apps::RecipeFile back = apps::read_recipe(text);
        require(back.problem.empty() && test::same(back.recipe, file.recipe));
        require(apps::write_recipe(back.recipe, comments) == text);
    }
    gauge_with(file.recipe);
    return 0;
}
