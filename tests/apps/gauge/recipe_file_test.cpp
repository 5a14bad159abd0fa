// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <gauge/recipe_file.hpp>
#include <support/recipe_problem.hpp>
#include <support/recipes.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::read_recipe;
using apps::RecipeFile;
using apps::write_recipe;

TEST(RecipeFile, GivesBackEveryRandomRecipeWithAndWithoutComments) {
    Random random(201);
    for (int i = 0; i < 400; ++i) {
        const Recipe recipe = random_recipe(random);
        for (const bool comments : {true, false}) {
            const std::string text = write_recipe(recipe, comments);
            const RecipeFile file = read_recipe(text);
            ASSERT_EQ(file.problem, "") << file.place.line << ":" << file.place.column << "\n" << text;
            ASSERT_TRUE(same(file.recipe, recipe)) << i << "\n" << text;
            // What was read is written the same again.
            ASSERT_EQ(write_recipe(file.recipe, comments), text);
        }
    }
}

TEST(RecipeFile, IsTheSameWithLineEndsOfWindowsAndWithoutALastOne) {
    Random random(202);
    const Recipe recipe = random_recipe(random);
    std::string text = write_recipe(recipe);
    std::string windows;
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(problem_of(windows), "");
    EXPECT_TRUE(same(read_recipe(windows).recipe, recipe));
    text.pop_back();
    EXPECT_EQ(problem_of(text), "");
    EXPECT_TRUE(same(read_recipe(text).recipe, recipe));
}

TEST(RecipeFile, ExplainsEveryKeyOfAFeatureWhereItsKindComesFirst) {
    Random random(203);
    Recipe recipe;
    recipe.scale.unit = LengthUnit::millimetre;
    for (const FeatureKind kind :
         {FeatureKind::angle, FeatureKind::hole_count, FeatureKind::width, FeatureKind::width}) {
        Feature feature = random_feature(random, kind);
        set_name(feature.name, "f" + std::to_string(recipe.features.size()));
        ASSERT_EQ(recipe.features.push(feature), Status::ok);
    }
    std::vector<std::string> nominal, from;
    for (const std::string& line : lines_of(write_recipe(recipe))) {
        const std::size_t comment = line.find(" # ");
        const std::string text = comment == std::string::npos ? "" : line.substr(comment + 3);
        if (line.compare(0, 9, "nominal =") == 0) nominal.push_back(text);
        if (line.compare(0, 6, "from =") == 0) from.push_back(text);
    }
    EXPECT_EQ(nominal, (std::vector<std::string>{"the value wanted, degrees", "the value wanted",
                                                 "the value wanted, mm", ""}));
    EXPECT_EQ(from, (std::vector<std::string>{"start of the probe, or of the first edge, mm",
                                              "start of the probe, or of the first edge, mm", ""}));
}

TEST(RecipeFile, WritesOnlyKeysThatMeanSomething) {
    Recipe recipe;
    const std::string text = write_recipe(recipe, false);
    EXPECT_EQ(text.find("level"), std::string::npos);
    EXPECT_EQ(text.find("quantile"), std::string::npos);
    EXPECT_EQ(text.find("ends"), std::string::npos);
    EXPECT_EQ(text.find("name"), std::string::npos);
    recipe.locate.threshold = ThresholdRule::quantile;
    EXPECT_NE(write_recipe(recipe, false).find("dark_quantile = 0.02\nbright_quantile = 0.98\n"),
              std::string::npos);
}

TEST(RecipeHelp, NamesEveryKeyOfEveryTableOnce) {
    const std::vector<std::string> lines = lines_of(apps::recipe_help());
    std::vector<std::string> found;
    for (const std::string& line : lines)
        if (line.compare(0, 2, "  ") == 0) found.push_back(line.substr(2, line.find(' ', 2) - 2));
    std::vector<std::string> expected;
    for (const apps::Key& key : apps::recipe_keys()) expected.push_back(key.name);
    EXPECT_EQ(found, expected);
    EXPECT_NE(std::find(lines.begin(), lines.end(), "[scale]"), lines.end());
    EXPECT_NE(std::find(lines.begin(), lines.end(), "[locate]"), lines.end());
}

TEST(RecipeHelp, TellsRangesUnitsDefaultsAndKinds) {
    const std::string help = apps::recipe_help();
    const auto line_of = [&](const std::string& key) {
        for (const std::string& line : lines_of(help))
            if (line.compare(0, key.size() + 3, "  " + key + " ") == 0) return line.substr(20);
        return std::string("none");
    };
    EXPECT_EQ(line_of("format"), "version of this file format, always 1; required");
    EXPECT_EQ(line_of("unit"), "unit of every length below: px or mm; \"px\" if left out");
    EXPECT_EQ(line_of("per_pixel_x"),
              "length of a pixel along the rows of the image, px or mm, 0.00001 to 100; 1 if left out");
    EXPECT_EQ(line_of("level"),
              "of \"fixed\": the least level that counts as bright, grey level, 1 to 255; 128 if left out");
    EXPECT_EQ(line_of("at_border"),
              "measure parts that touch the border of the image too; false if left out");
    EXPECT_EQ(line_of("ends"),
              "third moments that tell the part's ends apart, array of 4, -4 to 4; [0, 0, 0, 0] if left out");
    EXPECT_EQ(line_of("second_to"),
              "end of the second edge, px or mm, array of 2, -100000 to 100000; required (angle)");
    EXPECT_EQ(line_of("plus"),
              "how far above it is still OK, px, mm, degrees or a count, 0 to 100000; required");
}

TEST(RecipeFile, IsTomlForPythonWhetherWrittenOrAccepted) {
    if (std::system("python3 -c 'import tomllib' > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "no python3 with tomllib";
    Random random(205);
    std::vector<std::string> texts;
    std::vector<Recipe> recipes;
    const auto keep = [&](const std::string& text) {
        const RecipeFile file = read_recipe(text);
        if (!file.problem.empty()) return;
        texts.push_back(text);
        recipes.push_back(file.recipe);
    };
    for (int i = 0; i < 40; ++i) keep(write_recipe(random_recipe(random), i % 2 == 0));
    ASSERT_EQ(texts.size(), 40u);
    // Damaged ones that are accepted all the same.
    const std::string good = write_recipe(random_recipe(random));
    for (int i = 0; i < 3000; ++i) {
        std::string text = good;
        for (int k = random.between(1, 3); k > 0; --k) {
            const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
            text[at] = random.below(2) == 0 ? static_cast<char>(random.below(256))
                                            : "+-0123456789.,_\" \t\r\n#\\"[random.below(22)];
        }
        keep(text);
    }
    ASSERT_GT(texts.size(), 200u);

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("fovea_recipes_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < texts.size(); ++i)
        std::ofstream(folder / (std::to_string(i) + ".toml"), std::ios::binary) << texts[i];
    std::ofstream(folder / "read.py") << "import sys, tomllib\n"
                                         "from decimal import Decimal\n"
                                         "for i in range(int(sys.argv[2])):\n"
                                         "    with open(f'{sys.argv[1]}/{i}.toml', 'rb') as file:\n"
                                         "        recipe = tomllib.load(file, parse_float=Decimal)\n"
                                         "    for feature in recipe['feature']:\n"
                                         "        value = feature['nominal'] * 1000000\n"
                                         "        assert value == int(value)\n"
                                         "        print(i, int(value), feature['name'].encode().hex())\n";
    const std::string command = "python3 '" + (folder / "read.py").string() + "' '" + folder.string() + "' " +
                                std::to_string(texts.size()) + " 2>&1";
    std::string said;
    FILE* python = ::popen(command.c_str(), "r");
    ASSERT_NE(python, nullptr);
    char buffer[4096];
    for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, python)) > 0;)
        said.append(buffer, got);
    const int code = ::pclose(python);

    std::string expected;
    for (std::size_t i = 0; i < recipes.size(); ++i)
        for (const Feature& feature : recipes[i].features) {
            expected += std::to_string(i) + " " + std::to_string(feature.tolerance.nominal.millionths) + " ";
            for (const char c : name_text(feature.name)) {
                const auto byte = static_cast<unsigned char>(c);
                expected += "0123456789abcdef"[byte >> 4];
                expected += "0123456789abcdef"[byte & 15];
            }
            expected += "\n";
        }
    EXPECT_EQ(code, 0) << said;
    EXPECT_TRUE(said == expected) << said.substr(0, 2000);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace fovea::test
