// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <gauge/recipe_file.hpp>
#include <gauge/recipe_reader.hpp>
#include <support/recipe_problem.hpp>
#include <support/recipes.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::read_recipe;
using apps::RecipeFile;
using apps::write_recipe;

const std::string width =
    "[[feature]]\nname = \"w\"\nkind = \"width\"\nfrom = [-9, 0]\nto = [9, 0]\n"
    "nominal = 12\nminus = 0.1\nplus = 0.2\n";
/// A recipe whose width has one more line, at 10:1.
std::string in_width(const std::string& line) { return "format = 1\n" + width + line + "\n"; }

TEST(RecipeReader, ReadsWhatAPersonWrote) {
    const RecipeFile file = read_recipe(
        "# mine\n"
        "format = 1\n"
        "name = \"bracket \\\"A\\\"\"\n"
        "[scale]\n"
        "unit = \"mm\"\n"
        "per_pixel_x = 0.05\n"
        "per_pixel_y = +0.0501\n"
        "[locate]\n"
        "part = \"bright\"\n"
        "threshold = \"fixed\"\n"
        "level = 90\n"
        "opening = 3\n"
        "area_min = 500\n"
        "at_border = true\n"
        "pose = \"outline\"\n"
        "orientation = \"symmetric\"\n"
        "[[feature]]\n"
        "name = \"length\"\n"
        "kind = \"width\"\n"
        "from = [-10.5, 0]\n"
        "to = [10.5, 0.25]\n"
        "nominal = 20\n"
        "minus = 0.1\n"
        "plus = 0.2\n"
        "[[feature]]\n"
        "name = \"holes\"\n"
        "kind = \"hole_count\"\n"
        "nominal = 2\n"
        "minus = 0\n"
        "plus = 0\n");
    ASSERT_EQ(file.problem, "");
    const Recipe& recipe = file.recipe;
    EXPECT_EQ(name_text(recipe.name), "bracket \"A\"");
    EXPECT_EQ(recipe.scale.unit, LengthUnit::millimetre);
    EXPECT_EQ(recipe.scale.x_per_pixel, 50000);
    EXPECT_EQ(recipe.scale.y_per_pixel, 50100);
    EXPECT_FALSE(recipe.locate.dark_part);
    EXPECT_EQ(recipe.locate.threshold, ThresholdRule::fixed);
    EXPECT_EQ(recipe.locate.level, 90);
    EXPECT_EQ(recipe.locate.opening, 3);
    EXPECT_EQ(recipe.locate.area_min, 500);
    EXPECT_EQ(recipe.locate.area_max, LocateRule().area_max);
    EXPECT_TRUE(recipe.locate.at_border);
    EXPECT_EQ(recipe.locate.pose, PoseRule::outline);
    EXPECT_EQ(recipe.locate.orientation, OrientationRule::symmetric);
    ASSERT_EQ(recipe.features.size(), 2);
    EXPECT_EQ(name_text(recipe.features[0].name), "length");
    EXPECT_TRUE(same(recipe.features[0].from, {-10500000, 0}));
    EXPECT_TRUE(same(recipe.features[0].to, {10500000, 250000}));
    EXPECT_EQ(recipe.features[0].tolerance.plus, Decimal{200000});
    EXPECT_EQ(recipe.features[0].lines, Feature().lines);
    EXPECT_EQ(recipe.features[1].kind, FeatureKind::hole_count);
    // Where they stand, for what is said about them later.
    EXPECT_EQ(file.feature_places[0].line, 17);
    EXPECT_EQ(file.feature_places[1].line, 25);
    EXPECT_EQ(file.feature_places[1].column, 3);
}

TEST(RecipeMistakes, OfTheFile) {
    EXPECT_EQ(problem_of(""), "1:1: the file lacks format: version of this file format, always 1");
    EXPECT_EQ(problem_of("# nothing\n"), "1:1: the file lacks format: version of this file format, always 1");
    EXPECT_EQ(problem_of("\n" + width), "1:1: the file lacks format: version of this file format, always 1");
    EXPECT_EQ(problem_of("format = 2\n" + width), "1:10: format: expected 1, not 2");
    EXPECT_EQ(problem_of("format = 1.5\n" + width), "1:10: format: expected 1, not 1.5");
    EXPECT_EQ(problem_of("format = \"1\"\n" + width), "1:10: format: expected 1, not \"1\"");
    EXPECT_EQ(problem_of("format = 1\n"), "1:1: the recipe has no [[feature]] to measure");
    EXPECT_EQ(problem_of("\xef\xbb\xbf"
                         "format = 1\n" +
                         width),
              "1:1: the file begins with a byte order mark; save it as UTF-8 without one");
}

TEST(RecipeMistakes, OfBytesThatAreNoUtf8) {
    // TOML is UTF-8, in comments too; a recipe saved as Latin-1 is no TOML.
    EXPECT_EQ(problem_of("format = 1\n# \xd8 12\n" + width),
              "2:3: not a text in UTF-8; save the file as such");
    EXPECT_EQ(problem_of("format = 1\nname = \"\xed\xa0\x80\"\n" + width),
              "2:9: not a text in UTF-8; save the file as such");
    EXPECT_EQ(problem_of("format = 1\n" + width + "# \xe2\x82"),
              "10:3: not a text in UTF-8; save the file as such");
    EXPECT_EQ(problem_of("\x89PNG\r\n\x1a\n"), "1:1: not a text in UTF-8; save the file as such");
    EXPECT_EQ(problem_of("format = 1\n# \xc3\x98 12 \xe2\x82\xac \xef\xbf\xbd\n" + width), "");
}

TEST(RecipeMistakes, OfMalformedToml) {
    EXPECT_EQ(problem_of("format = 1\n[locate\n" + width), "2:8: expected ] behind the table's name");
    EXPECT_EQ(problem_of("format 1\n"), "1:8: expected = behind the key");
    EXPECT_EQ(problem_of("format = 1 2\n"), "1:12: something stands behind the value or name");
    EXPECT_EQ(problem_of("format = 1\nname = \"abc\n"), "2:8: expected \" at the end of the string");
    EXPECT_EQ(problem_of("format = 1\nname = 'abc'\n"),
              "2:8: expected a value: a \"string\", a number, true, false or an [array]");
    EXPECT_EQ(problem_of("format = 1\nname = \"a\\u0041\"\n"), "2:11: unknown escape in a string");
    EXPECT_EQ(problem_of("format = 1\n\n  = 3\n"), "3:3: expected a key, a [table] or a comment");
    EXPECT_EQ(problem_of("format = 01\n"), "1:10: a number must not begin with 0");
    EXPECT_EQ(problem_of(in_locate("level = 1e2")),
              "3:9: expected a number such as 25 or -2.5, without exponent or unit");
    EXPECT_EQ(problem_of(in_locate("ends = [1, 2,\n 3, 4]")),
              "3:14: expected a value: a \"string\", a number, true, false or an [array]");
    EXPECT_EQ(problem_of(in_locate("ends = [[1], 2]")), "3:9: an array inside an array");
}

TEST(RecipeMistakes, OfNumbersWithTooManyPlaces) {
    EXPECT_EQ(problem_of(in_scale("per_pixel_x = 0.0000001")),
              "3:15: a number with more than six places or beyond a hundred million");
    EXPECT_EQ(problem_of(in_scale("per_pixel_x = 100000001")),
              "3:15: a number with more than six places or beyond a hundred million");
    EXPECT_EQ(problem_of(in_width("nominal_ = 1.2345678")),
              "10:12: a number with more than six places or beyond a hundred million");
    // Zeros are no places.
    EXPECT_EQ(problem_of(in_scale("per_pixel_x = 0.50000000000\nper_pixel_y = 0.5")), "");
}

TEST(RecipeMistakes, OfTables) {
    EXPECT_EQ(problem_of("format = 1\n[scales]\n" + width),
              "2:2: unknown table [scales]; did you mean [scale]?");
    EXPECT_EQ(problem_of("format = 1\n[[features]]\n"),
              "2:3: unknown table [features]; did you mean [[feature]]?");
    EXPECT_EQ(problem_of("format = 1\n[banana]\n"), "2:2: unknown table [banana]");
    EXPECT_EQ(problem_of("format = 1\n[feature]\n"), "2:2: features are written as [[feature]]");
    EXPECT_EQ(problem_of("format = 1\n[[scale]]\n"), "2:3: there is one [scale], in single brackets");
    EXPECT_EQ(problem_of("format = 1\n[scale]\n[locate]\n [scale]\n" + width), "4:3: [scale] stands twice");
    EXPECT_EQ(problem_of("format = 1\n[locate]\n" + width + "[locate]\n"), "11:2: [locate] stands twice");
}

TEST(RecipeMistakes, OfKeys) {
    EXPECT_EQ(problem_of("format = 1\nnane = \"x\"\n" + width), "2:1: unknown key nane; did you mean name?");
    EXPECT_EQ(problem_of(in_locate("treshold = \"otsu\"")),
              "3:1: unknown key treshold in [locate]; did you mean threshold?");
    EXPECT_EQ(problem_of(in_width("nominl = 3")),
              "10:1: unknown key nominl in [[feature]]; did you mean nominal?");
    EXPECT_EQ(problem_of(in_width("banana = 3")), "10:1: unknown key banana in [[feature]]");
    EXPECT_EQ(problem_of("format = 1\nformat = 1\n" + width), "2:1: format stands twice");
    EXPECT_EQ(problem_of(in_locate("level = 3\nlevel = 4")), "4:1: level stands twice");
    EXPECT_EQ(problem_of(in_width("plus = 0.3")), "10:1: plus stands twice");
    // The same key in two features is none twice.
    EXPECT_EQ(problem_of("format = 1\n" + width + a_count), "");
}

TEST(RecipeMistakes, OfKeysInAnotherTable) {
    EXPECT_EQ(problem_of("format = 1\npart = \"dark\"\n" + width),
              "2:1: part belongs in [locate], not before it");
    EXPECT_EQ(problem_of(in_locate("unit = \"px\"")), "3:1: unit belongs in [scale], not in [locate]");
    EXPECT_EQ(problem_of(in_width("level = 3")), "10:1: level belongs in [locate], not in [[feature]]");
    EXPECT_EQ(problem_of(in_scale("format = 1")), "3:1: format belongs before every table, not in [scale]");
}

TEST(RecipeMistakes, OfTypes) {
    EXPECT_EQ(problem_of(in_locate("at_border = 1")), "3:13: at_border: expected true or false, not 1");
    EXPECT_EQ(problem_of(in_locate("at_border = \"true\"")),
              "3:13: at_border: expected true or false, not \"true\"");
    EXPECT_EQ(problem_of(in_locate("part = true")), "3:8: part: expected \"bright\" or \"dark\", not true");
    EXPECT_EQ(problem_of(in_locate("area_min = \"5\"")),
              "3:12: area_min: expected a whole number from 1 to 67092481 px, not \"5\"");
    EXPECT_EQ(problem_of(in_locate("area_min = 5.0")),
              "3:12: area_min: expected a whole number from 1 to 67092481 px, not 5.0");
    EXPECT_EQ(problem_of(in_locate("ends = 3")), "3:8: ends: expected an array of 4 numbers, not 3");
    EXPECT_EQ(problem_of(in_locate("level = [3]")),
              "3:9: level: expected a whole number from 1 to 255 grey level, not [3]");
    EXPECT_EQ(problem_of("format = 1\nname = 3\n" + width),
              "2:8: name: expected a \"name\" of 1 to 31 bytes without control characters, not 3");
    // A whole number is a decimal too.
    EXPECT_EQ(problem_of(in_scale("per_pixel_x = 1\nper_pixel_y = 1")), "");
}

TEST(RecipeMistakes, OfRanges) {
    EXPECT_EQ(problem_of(in_locate("threshold = \"fixed\"\nlevel = 0")),
              "4:9: level: expected a whole number from 1 to 255 grey level, not 0");
    EXPECT_EQ(problem_of(in_locate("threshold = \"fixed\"\nlevel = 256")),
              "4:9: level: expected a whole number from 1 to 255 grey level, not 256");
    EXPECT_EQ(problem_of(in_locate("area_max = 67092482")),
              "3:12: area_max: expected a whole number from 1 to 67092481 px, not 67092482");
    EXPECT_EQ(problem_of(in_scale("per_pixel_x = 0.000009")),
              "3:15: per_pixel_x: expected a number from 0.00001 to 100, not 0.000009");
    EXPECT_EQ(problem_of(in_scale("per_pixel_x = 100.000001")),
              "3:15: per_pixel_x: expected a number from 0.00001 to 100, not 100.000001");
    EXPECT_EQ(problem_of(in_locate("ends = [0, 0, 0, 4.1]")),
              "3:18: ends: expected a number from -4 to 4, not 4.1");
    EXPECT_EQ(problem_of(in_width("contrast_min = 256")),
              "10:16: contrast_min: expected a whole number from 0 to 255 grey levels, not 256");
    EXPECT_EQ(problem_of(in_width("lines = 0")), "10:9: lines: expected a whole number from 1 to 255, not 0");
    EXPECT_EQ(problem_of("format = 1\n[[feature]]\nminus = -0.1"),
              "3:9: minus: expected a number from 0 to 100000, not -0.1");
    EXPECT_EQ(problem_of("format = 1\n[[feature]]\nfrom = [0, 100001]"),
              "3:12: from: expected a number from -100000 to 100000, not 100001");
    // Both ends of a range are in it.
    EXPECT_EQ(problem_of(in_locate("threshold = \"fixed\"\nlevel = 1")), "");
    EXPECT_EQ(problem_of(in_locate("threshold = \"fixed\"\nlevel = 255")), "");
}

TEST(RecipeMistakes, OfChoices) {
    EXPECT_EQ(problem_of(in_scale("unit = \"MM\"")),
              "3:8: unit: expected \"px\" or \"mm\", not \"MM\"; did you mean \"mm\"?");
    EXPECT_EQ(
        problem_of(in_locate("threshold = \"osu\"")),
        "3:13: threshold: expected \"fixed\", \"otsu\" or \"quantile\", not \"osu\"; did you mean \"otsu\"?");
    EXPECT_EQ(problem_of(in_locate("part = \"grey\"")),
              "3:8: part: expected \"bright\" or \"dark\", not \"grey\"");
    EXPECT_EQ(problem_of(in_locate("part = \"\"")), "3:8: part: expected \"bright\" or \"dark\", not \"\"");
    EXPECT_EQ(problem_of("format = 1\n[[feature]]\nkind = \"diametre\""),
              "3:8: kind: expected \"distance\", \"width\", \"diameter\", \"angle\", \"hole_count\", "
              "\"hole_diameter\" or "
              "\"position\", not \"diametre\"; did you mean \"diameter\"?");
}

TEST(RecipeMistakes, OfArrays) {
    const std::string start = "format = 1\n[[feature]]\n";
    EXPECT_EQ(problem_of(start + "from = [1]"), "3:8: from: expected an array of 2 numbers, not [1]");
    EXPECT_EQ(problem_of(start + "from = []"), "3:8: from: expected an array of 2 numbers, not []");
    EXPECT_EQ(problem_of(start + "from = [1, 2, 3]"),
              "3:8: from: expected an array of 2 numbers, not [1, 2, 3]");
    EXPECT_EQ(problem_of(start + "from = [1, \"2\"]"),
              "3:12: from: expected a number from -100000 to 100000, not \"2\"");
    // A comma may end an array.
    EXPECT_EQ(problem_of(in_locate("ends = [ 0.1,0 , 0, 0, ]  # mine")), "");
}

TEST(RecipeMistakes, OfLongValuesAreCutShort) {
    const std::string problem = problem_of("format = 1\nname = \"" + std::string(500, 'x') + "\"\n");
    EXPECT_EQ(problem, "2:8: name: expected a \"name\" of 1 to 31 bytes without control characters, not \"" +
                           std::string(40, 'x') + "...\"");
}

TEST(RecipeMistakes, OfNames) {
    const auto named = [](const std::string& name) {
        return problem_of("format = 1\nname = \"" + name + "\"\n" + width);
    };
    const std::string wrong =
        "2:8: name: expected a \"name\" of 1 to 31 bytes without control characters, not \"";
    EXPECT_EQ(named(std::string(31, 'x')), "");
    EXPECT_EQ(named(std::string(32, 'x')), wrong + std::string(32, 'x') + "\"");
    EXPECT_EQ(named(""), wrong + "\"");
    // A line end in a name would break the lines of the report, and no recipe could be written with it.
    EXPECT_EQ(named("a\\nb"), wrong + "a\\nb\"");
    EXPECT_EQ(named("a\\tb"), wrong + "a\\tb\"");
    EXPECT_EQ(named("a\tb"), wrong + "a?b\"");
    EXPECT_EQ(named("a\\\\b \\\"c\\\""), "");
    EXPECT_EQ(problem_of("format = 1\n" + width + a_count + width), "17:1: two features are called \"w\"");
}

TEST(RecipeMistakes, OfWhatAFeatureLacks) {
    const auto without = [](const std::string& key) {
        std::string text = "format = 1\n";
        for (const std::string& line : lines_of(width))
            if (line.compare(0, key.size(), key) != 0) text += line + "\n";
        return problem_of(text);
    };
    EXPECT_EQ(without("name"), "2:3: this feature lacks name: name in the results, unique in the file");
    EXPECT_EQ(without("kind"), "2:3: this feature lacks kind: what is measured");
    EXPECT_EQ(without("from"), "2:3: this feature lacks from: start of the probe, or of the first edge");
    EXPECT_EQ(without("to"), "2:3: this feature lacks to: end of the probe, or of the first edge");
    EXPECT_EQ(without("nominal"), "2:3: this feature lacks nominal: the value wanted");
    EXPECT_EQ(without("minus"), "2:3: this feature lacks minus: how far below it is still OK");
    EXPECT_EQ(without("plus"), "2:3: this feature lacks plus: how far above it is still OK");
}

TEST(RecipeMistakes, OfKeysOfAnotherKind) {
    EXPECT_EQ(problem_of(in_width("radius = 3")),
              "10:1: radius has no meaning for a feature of the kind \"width\", which has name, kind, from, "
              "to, lines, "
              "smoothing, contrast_min, nominal, minus and plus");
    EXPECT_EQ(problem_of("format = 1\n" + a_count + "probes = 9\n"),
              "8:1: probes has no meaning for a feature of the kind \"hole_count\", which has name, kind, "
              "nominal, minus and "
              "plus");
}

TEST(RecipeMistakes, OfTheNumbersOfEdges) {
    const auto edges = [](const std::string& lines) {
        std::string text = "format = 1\n" + width + lines;
        text.replace(text.find("\"width\""), 7, "\"distance\"");
        return problem_of(text);
    };
    EXPECT_EQ(edges("first_edge = 0\n"),
              "10:1: edges are numbered from 1, or from -1 at the end of the probe");
    EXPECT_EQ(edges("first_edge = 2\nsecond_edge = 0\n"),
              "11:1: edges are numbered from 1, or from -1 at the end of the probe");
    EXPECT_EQ(edges("first_edge = 2\nsecond_edge = 2\n"),
              "11:1: first_edge and second_edge are the same edge");
    EXPECT_EQ(edges("first_edge = 65\n"),
              "10:14: first_edge: expected a whole number from -64 to 64, not 65");
    EXPECT_EQ(edges("first_edge = 2\nsecond_edge = 3\n"), "");
    EXPECT_EQ(edges(""), "");
}

TEST(RecipeMistakes, OfTooManyFeatures) {
    std::string text = "format = 1\n";
    for (int i = 0; i < Recipe::max_features; ++i) {
        std::string feature = a_count;
        feature.replace(feature.find("\"n\""), 3, "\"n" + std::to_string(i) + "\"");
        text += feature;
    }
    EXPECT_EQ(problem_of(text), "");
    EXPECT_EQ(problem_of(text + "[[feature]]\n"), "146:3: more than 24 features");
}

TEST(RecipeMistakes, AreToldOnOneLineWithinTheFileWhateverIsDamaged) {
    Random random(204);
    const std::string good = write_recipe(random_recipe(random));
    int accepted = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = good;
        for (int k = random.between(1, 4); k > 0; --k) {
            const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
            switch (random.below(4)) {
                case 0: text[at] = static_cast<char>(random.below(256)); break;
                case 1: text.erase(at, random.below(30)); break;
                case 2:
                    text.insert(at, text.substr(random.below(static_cast<std::uint32_t>(text.size())), 12));
                    break;
                default: text[at] = "0123456789.,=[]\"#\n-"[random.below(19)];
            }
        }
        const RecipeFile file = read_recipe(text);
        if (file.problem.empty()) {
            ++accepted;
            ASSERT_TRUE(same(read_recipe(write_recipe(file.recipe)).recipe, file.recipe)) << text;
            continue;
        }
        ASSERT_TRUE(apps::printable(file.problem)) << text;
        const std::vector<std::string> lines = lines_of(text + " ");
        ASSERT_GE(file.place.line, 1);
        ASSERT_LE(file.place.line, static_cast<int>(lines.size()) + 1);
        ASSERT_GE(file.place.column, 1);
    }
    EXPECT_GT(accepted, 100);
}

}  // namespace
}  // namespace fovea::test
