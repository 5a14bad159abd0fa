// SPDX-License-Identifier: MIT
//
// Recipes that nobody would write: each is read, or refused with a place and one line of text.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fovea/base/random.hpp>
#include <gauge/recipe_file.hpp>
#include <support/recipes.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::Key;
using apps::KeyType;
using apps::read_recipe;
using apps::RecipeFile;
using apps::write_recipe;

/// Reads any text. What is accepted must be written and read back the same; what is refused must have a place
/// in the text, and a line of text that a terminal can show.
RecipeFile read_anything(const std::string& text) {
    const RecipeFile file = read_recipe(text);
    const std::string start = text.substr(0, 200);
    if (file.problem.empty()) {
        const std::string again = write_recipe(file.recipe);
        const RecipeFile back = read_recipe(again);
        EXPECT_EQ(back.problem, "") << start << "\n" << again;
        EXPECT_TRUE(same(back.recipe, file.recipe)) << start << "\n" << again;
        return file;
    }
    EXPECT_TRUE(apps::printable(file.problem)) << start;
    EXPECT_LE(file.problem.size(), 300u) << file.problem;
    const std::vector<std::string> lines = lines_of(text);
    EXPECT_GE(file.place.line, 1) << start;
    EXPECT_GE(file.place.column, 1) << start;
    // A place behind the last line end is in the text too.
    EXPECT_LE(file.place.line, static_cast<int>(lines.size()) + 1) << start;
    if (file.place.line <= static_cast<int>(lines.size())) {
        const std::string& line = lines[static_cast<std::size_t>(file.place.line - 1)];
        EXPECT_LE(file.place.column, static_cast<int>(line.size()) + 1) << start << file.problem;
    }
    return file;
}

/// A feature of the first kind that has a key, or a hole count; with the required keys but for that one.
std::string feature_with(const Key& wanted, const std::string& value) {
    Random random(801);
    int kind = static_cast<int>(FeatureKind::hole_count);
    for (int i = 6; std::string(wanted.table) == "feature" && i >= 0; --i)
        if ((wanted.kinds >> i & 1) != 0) kind = i;
    Recipe recipe;
    Feature feature = random_feature(random, static_cast<FeatureKind>(kind));
    feature.first_edge = 1;
    feature.second_edge = -1;
    set_name(feature.name, "f");
    EXPECT_EQ(recipe.features.push(feature), Status::ok);
    const std::string all = write_recipe(recipe, false);
    std::string text = "[[feature]]\n";
    for (const std::string& line : lines_of(all.substr(all.find("[[feature]]") + 12)))
        if (line.compare(0, std::string(wanted.name).size() + 1, std::string(wanted.name) + " ") != 0 ||
            std::string(wanted.table) != "feature")
            text += line + "\n";
    return std::string(wanted.table) == "feature" ? text + wanted.name + " = " + value + "\n" : text;
}

/// A recipe in which one key has a value, and all else is good.
std::string recipe_with(const Key& key, const std::string& value) {
    const std::string line = std::string(key.name) + " = " + value + "\n";
    const std::string table = key.table;
    const std::string name = key.name;
    std::string text = name == "format" ? line : "format = 1\n";
    if (table.empty() && name != "format") text += line;
    if (table == "scale") {
        text += "[scale]\n" + line;
        if (name == "per_pixel_x") text += "per_pixel_y = " + value + "\n";
        if (name == "per_pixel_y") text += "per_pixel_x = " + value + "\n";
        if (name == "unit") text += "per_pixel_x = 1\nper_pixel_y = 1\n";
    }
    if (table == "locate") {
        text += "[locate]\n" + line;
        if (name == "level") text += "threshold = \"fixed\"\n";
        if (name.find("quantile") != std::string::npos) text += "threshold = \"quantile\"\n";
        if (name == "symmetry_order") text += "orientation = \"rotational\"\n";
        if (name == "area_max") text += "area_min = 1\n";
    }
    return text + feature_with(key, value);
}

bool is_number(const Key& key) {
    return key.type == KeyType::decimal || key.type == KeyType::integer || key.type == KeyType::numbers;
}
/// A number as the key takes it: alone, or as often as its array is long.
std::string value_of(const Key& key, const std::string& number) {
    if (key.type != KeyType::numbers) return number;
    std::string text = "[";
    for (int i = 0; i < key.count; ++i) text += (i == 0 ? "" : ", ") + number;
    return text + "]";
}
std::string limit_of(const Key& key, std::int64_t value) {
    return key.type == KeyType::integer ? std::to_string(value) : apps::shortest(Decimal{value});
}
/// A value of the right type that any key of that type takes.
std::string good_value(const Key& key) {
    switch (key.type) {
        case KeyType::name: return "\"f\"";
        case KeyType::choice: return "\"" + apps::split(key.choices, '|')[0] + "\"";
        case KeyType::boolean: return "true";
        case KeyType::integer:
        case KeyType::decimal:
        case KeyType::numbers: break;
    }
    return value_of(key, limit_of(key, key.high));
}

// ---- Every key ---------------------------------------------------------------------------------

TEST(HostileRecipe, EveryKeyTakesBothEndsOfItsRange) {
    for (const Key& key : apps::recipe_keys())
        for (const std::int64_t limit : {key.low, key.high}) {
            if (!is_number(key)) continue;
            const RecipeFile file = read_anything(recipe_with(key, value_of(key, limit_of(key, limit))));
            EXPECT_EQ(file.problem, "") << key.table << "." << key.name << " " << limit;
        }
}

TEST(HostileRecipe, EveryKeyRefusesWhatIsJustOutsideItsRange) {
    for (const Key& key : apps::recipe_keys())
        for (const std::int64_t beyond : {key.low - 1, key.high + 1}) {
            if (!is_number(key)) continue;
            const std::string text = recipe_with(key, value_of(key, limit_of(key, beyond)));
            EXPECT_EQ(read_anything(text).problem.compare(0, std::string(key.name).size() + 11,
                                                          std::string(key.name) + ": expected "),
                      0)
                << key.table << "." << key.name << ": " << read_recipe(text).problem;
        }
}

TEST(HostileRecipe, EveryKeyRefusesAbsurdNumbersAtTheirPlace) {
    const std::string zeros(400, '0');
    for (const Key& key : apps::recipe_keys())
        for (const std::string& number : {std::string("99999999"),
                                          std::string("-99999999"),
                                          std::string("100000001"),
                                          std::string("9223372036854775807"),
                                          std::string("-9223372036854775808"),
                                          std::string("18446744073709551616"),
                                          "1" + zeros,
                                          "-1" + zeros,
                                          "0." + zeros + "1",
                                          std::string("-0.0000001"),
                                          std::string("1e9"),
                                          std::string("nan"),
                                          std::string("inf"),
                                          std::string("-inf"),
                                          std::string("0x10"),
                                          std::string("1_000"),
                                          std::string("--1"),
                                          std::string("+"),
                                          std::string("."),
                                          std::string("1."),
                                          std::string(".5")}) {
            const RecipeFile file = read_anything(recipe_with(key, value_of(key, number)));
            const bool in_range =
                key.type != KeyType::integer && number == "99999999" && key.high >= 99999999000000;
            EXPECT_EQ(file.problem.empty(), in_range) << key.table << "." << key.name << " " << number;
        }
}

TEST(HostileRecipe, EveryKeyRefusesValuesOfOtherTypes) {
    for (const Key& key : apps::recipe_keys()) {
        const auto refused = [&](const std::string& value) {
            EXPECT_NE(read_anything(recipe_with(key, value)).problem, "")
                << key.table << "." << key.name << " = " << value;
        };
        EXPECT_EQ(read_anything(recipe_with(key, good_value(key))).problem, "")
            << key.table << "." << key.name;
        if (key.type != KeyType::name) refused("\"banana\"");
        refused("\"\"");
        refused("");
        if (key.type != KeyType::boolean) refused("true");
        if (!is_number(key)) refused("3");
        if (key.type == KeyType::integer) refused("1.0");
        refused("[]");
        refused("[" + good_value(key) + "]");
        refused("1979-05-27");
        refused("{ a = 1 }");
        refused("\"\"\"a\"\"\"");
    }
}

TEST(HostileRecipe, ArraysRefuseEveryWrongLength) {
    for (const Key& key : apps::recipe_keys()) {
        if (key.type != KeyType::numbers) continue;
        std::string numbers;
        for (int length = 0; length <= 40; ++length) {
            EXPECT_EQ(read_anything(recipe_with(key, "[" + numbers + "]")).problem.empty(),
                      length == key.count)
                << key.name << " " << length;
            numbers += (length == 0 ? "0" : ", 0");
        }
    }
}

TEST(HostileRecipe, NoKeyMayComeTwice) {
    for (const Key& key : apps::recipe_keys()) {
        std::string text = recipe_with(key, good_value(key));
        const std::string line = std::string(key.name) + " = " + good_value(key) + "\n";
        const std::size_t at = text.rfind(line);
        ASSERT_NE(at, std::string::npos) << key.name;
        text.insert(at, line);
        EXPECT_EQ(read_anything(text).problem, std::string(key.name) + " stands twice");
    }
}

// ---- Whole files -------------------------------------------------------------------------------

TEST(HostileRecipe, CutAnywhereIsRefusedOrStillARecipe) {
    Random random(802);
    for (const bool comments : {false, true}) {
        const std::string whole = write_recipe(random_recipe(random), comments);
        const std::size_t step = whole.size() / 1500 + 1;
        for (std::size_t length = 0; length < whole.size(); length += step)
            read_anything(whole.substr(0, length));
    }
}

TEST(HostileRecipe, OfAMegabyteOfOneCharacterIsRefusedAtOnce) {
    // One of each kind that the reader tells apart.
    const std::string characters("\0\t\n\r \"#'+-.,09=A[\\]_az{}~\x7f\x80\xc3\xff", 29);
    for (const char c : characters) {
        const RecipeFile file = read_anything(std::string(1 << 20, c));
        EXPECT_NE(file.problem, "") << static_cast<int>(c);
    }
}

TEST(HostileRecipe, OfAMegabyteBehindAKeyIsRefusedAtOnce) {
    const std::string mega(1 << 20, '1');
    for (const std::string& text :
         {"format = " + mega, "format = \"" + mega + "\"", "format = \"" + mega, "format = [" + mega + "]",
          mega + " = 1", "[" + mega + "]", "[[" + mega + "]]", "# " + mega, "format = -" + mega,
          "format = 0." + mega, "format = 1" + std::string(1 << 20, ' ') + "x"}) {
        const RecipeFile file = read_anything(text);
        EXPECT_NE(file.problem, "") << text.substr(0, 40);
    }
    std::string many = "format = [";
    for (int i = 0; i < 1 << 18; ++i) many += "1, ";
    EXPECT_NE(read_anything(many + "]").problem, "");
    std::string tables = "format = 1\n";
    for (int i = 0; i < 1 << 16; ++i) tables += "[[feature]]\n";
    EXPECT_NE(read_anything(tables).problem, "");
    std::string lines = "format = 1\n";
    for (int i = 0; i < 1 << 16; ++i) lines += "format = 1\n";
    EXPECT_EQ(read_anything(lines).place.line, 2);
}

TEST(HostileRecipe, MayHaveAMillionEmptyLinesAndAsLongAComment) {
    const std::string good = "format = 1\n" + feature_with(apps::recipe_keys()[0], "");
    EXPECT_EQ(read_anything(good).problem, "");
    EXPECT_EQ(read_anything(std::string(1 << 20, '\n') + good).problem, "");
    EXPECT_EQ(read_anything("#" + std::string(1 << 20, ' ') + "\n" + good).problem, "");
    EXPECT_EQ(read_anything(std::string(1 << 20, '\n') + "x" + good).place.line, (1 << 20) + 1);
    EXPECT_EQ(read_anything(good + std::string(1 << 20, ' ') + "x").place.column, (1 << 20) + 2);
}

TEST(HostileRecipe, IsRefusedWithANulAnywhere) {
    Random random(803);
    const std::string whole = write_recipe(random_recipe(random), false);
    for (std::size_t at = 0; at <= whole.size(); at += 3) {
        std::string text = whole;
        text.insert(at, 1, '\0');
        EXPECT_NE(read_anything(text).problem, "") << at;
    }
}

TEST(HostileRecipe, MayHaveLineEndsOfWindowsButNoneOfOldMacs) {
    Random random(804);
    const Recipe recipe = random_recipe(random);
    std::string windows, mac;
    for (const char c : write_recipe(recipe)) {
        windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
        mac += c == '\n' ? '\r' : c;
    }
    EXPECT_TRUE(same(read_anything(windows).recipe, recipe));
    EXPECT_NE(read_anything(mac).problem, "");
}

TEST(HostileRecipe, SaysThatItIsSavedInAnotherEncoding) {
    const std::string good = "format = 1\n" + feature_with(apps::recipe_keys()[0], "");
    EXPECT_EQ(read_anything("\xef\xbb\xbf" + good).problem,
              "the file begins with a byte order mark; save it as UTF-8 without one");
    std::string wide = "\xff\xfe";
    for (const char c : good) wide += {c, '\0'};
    EXPECT_EQ(read_anything(wide).problem, "not a text in UTF-8; save the file as such");
}

TEST(HostileRecipe, NestedDeeplyIsRefused) {
    const std::string open(100000, '[');
    const std::string close(100000, ']');
    for (const std::string& text :
         {open, "format = " + open, "format = " + open + close, open + "feature" + close,
          "[[" + std::string(100000, 'a') + ".b]]", "[a" + std::string(100000, '.') + "]"})
        EXPECT_NE(read_anything(text).problem, "") << text.substr(0, 20);
}

TEST(HostileRecipe, WithLinesLostDoubledAndExchangedIsReadOrRefused) {
    Random random(805);
    const std::vector<std::string> whole = lines_of(write_recipe(random_recipe(random), false));
    int accepted = 0;
    for (int i = 0; i < 2000; ++i) {
        std::vector<std::string> lines = whole;
        const auto any = [&]() -> std::string& {
            return lines[random.below(static_cast<std::uint32_t>(lines.size()))];
        };
        for (int k = random.between(1, 3); k > 0; --k) {
            const std::uint32_t what = random.below(3);
            if (what == 0) any().clear();
            if (what == 1) any() += "\n" + any();
            if (what == 2) std::swap(any(), any());
        }
        std::string text;
        for (const std::string& line : lines) text += line + "\n";
        if (read_anything(text).problem.empty()) ++accepted;
    }
    EXPECT_GT(accepted, 50);
    EXPECT_LT(accepted, 1950);
}

}  // namespace
}  // namespace fovea::test
