// SPDX-License-Identifier: MIT
//
// The recipe that docs/gauge.md shows, to be copied, measures what the page says.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gauge/recipe_file.hpp>
#include <make_part/part_scene.hpp>
#include <support/commands.hpp>

namespace fovea::test {
namespace {

/// The block of a page that begins with such a fence.
std::string block_of(const std::string& page, const std::string& fence) {
    std::ifstream file(std::string(FOVEA_SOURCE_DIR) + page);
    std::stringstream all;
    all << file.rdbuf();
    const std::string text = all.str();
    const std::size_t start = text.find(fence + "\n");
    if (start == std::string::npos) return "";
    const std::size_t first = start + fence.size() + 1;
    return text.substr(first, text.find("```", first) - first);
}

TEST(DocumentedRecipe, MeasuresThePlateThatMakePartRendersWithEveryKindOfFeature) {
    const apps::RecipeFile file = apps::read_recipe(block_of("/docs/gauge.md", "```toml"));
    ASSERT_EQ(file.problem, "") << file.place.line;
    unsigned kinds = 0;
    for (const Feature& feature : file.recipe.features) kinds |= apps::bit(feature.kind);
    EXPECT_EQ(kinds, 0x7fu);

    std::vector<PartResult> parts;
    ASSERT_EQ(gauge_parts(render(apps::PartScene()), file.recipe, parts), Status::ok);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].verdict, Verdict::ok);
    // As the page prints it.
    EXPECT_EQ(apps::human_part("plate.png", 0, parts[0], file.recipe),
              "plate.png part 0: OK  length 360.02 px, edge_to_hole 66.04 px, large_hole 60.01 px, "
              "small_hole 36.00 px, holes 2, small_hole_place 0.03 px, corner 90.00 deg  "
              "[x 316.67, y 237.54 px, 15.54 deg]\n");
}

}  // namespace
}  // namespace fovea::test
