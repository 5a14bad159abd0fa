// SPDX-License-Identifier: MIT
//
// Recipes in files: read with line and column of every mistake, written with a comment for every key.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <fovea/codec/toml.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>

#include <common/text.hpp>
#include <gauge/recipe_schema.hpp>

namespace fovea::apps {

/// A recipe as it was read, and where its features stand.
struct RecipeFile {
    Recipe recipe;
    std::array<TextPlace, Recipe::max_features> feature_places{};
    TextPlace place;      ///< of the problem
    std::string problem;  ///< "" if the recipe is good
};

/// Reads a recipe. Stops at the first mistake: problem then says what, place where.
RecipeFile read_recipe(const std::string& text);

/// The text of a recipe. With comments, every key is explained.
std::string write_recipe(const Recipe& recipe, bool comments = true);

/// What a person may write in a recipe: every key with its unit, range and default.
std::string recipe_help();

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline std::vector<std::string> key_names(const std::string& table, unsigned kinds) {
    std::vector<std::string> names;
    for (const Key& key : recipe_keys())
        if (table == key.table && (table != "feature" || (key.kinds & kinds) != 0)) names.push_back(key.name);
    return names;
}

/// Reads the items of a recipe into it.
class RecipeReader {
public:
    explicit RecipeReader(const std::string& text) : reader_(span_of(text)) {}

    RecipeFile read() {
        for (;;) {
            const Result<TomlItem> item = reader_.next();
            if (!item) {
                fail(reader_.place(), reader_.problem());
                break;
            }
            if (item->kind == TomlKind::end || !take(*item)) break;
        }
        if (file_.problem.empty()) finish_table();
        if (file_.problem.empty()) check_whole();
        return file_;
    }

private:
    struct Seen {
        const Key* key;
        TextPlace place;
        KeyValue value;
    };

    bool fail(TextPlace place, const std::string& problem) {
        file_.place = place;
        file_.problem = problem;
        return false;
    }

    bool take(const TomlItem& item) {
        const std::string name = string_of(item.name);
        if (item.kind == TomlKind::pair) return take_pair(item, name);
        if (!finish_table()) return false;
        table_ = name;
        table_place_ = item.place;
        seen_.clear();
        const bool array = item.kind == TomlKind::array_table;
        if (name == "feature" && array) {
            if (!file_.recipe.features.view().full()) return true;
            return fail(item.place, "more than " + std::to_string(Recipe::max_features) + " features");
        }
        if (name == "feature") return fail(item.place, "features are written as [[feature]]");
        if (name != "scale" && name != "locate")
            return fail(item.place, "unknown table [" + name + "]" +
                                        hint(nearest_name(name, {"scale", "locate", "feature"})));
        if (array) return fail(item.place, "there is one [" + name + "], in single brackets");
        for (const std::string& before : tables_)
            if (before == name) return fail(item.place, "[" + name + "] stands twice");
        tables_.push_back(name);
        return true;
    }

    bool take_pair(const TomlItem& item, const std::string& name) {
        const Key* found = nullptr;
        for (const Key& key : recipe_keys())
            if (table_ == key.table && name == key.name) found = &key;
        if (found == nullptr)
            return fail(item.place, "unknown key " + name + (table_.empty() ? "" : " in [" + table_ + "]") +
                                        hint(nearest_name(name, key_names(table_, every_kind))));
        for (const Seen& before : seen_)
            if (before.key == found) return fail(item.place, name + " stands twice");
        Seen seen{found, item.place, {}};
        if (!read_value(*found, item.value, seen.value)) return false;
        seen_.push_back(seen);
        return true;
    }

    /// "name: expected what, found something".
    bool refuse(const Key& key, const TomlValue& value, const std::string& expected) {
        return fail(value.place, std::string(key.name) + ": expected " + expected);
    }

    bool read_number(const Key& key, const TomlValue& value, std::int64_t& number) {
        const bool whole = key.type == KeyType::integer;
        const bool is_number = value.type == TomlType::integer || (!whole && value.type == TomlType::decimal);
        const std::string unit = key.unit[0] != '\0' ? std::string(" ") + key.unit : "";
        const auto bound = [&](std::int64_t limit) {
            return whole ? std::to_string(limit) : shortest(Decimal{limit});
        };
        number = whole ? value.number.millionths / 1000000 : value.number.millionths;
        if (is_number && number >= key.low && number <= key.high) return true;
        return refuse(key, value,
                      std::string(whole ? "a whole number" : "a number") + " from " + bound(key.low) +
                          " to " + bound(key.high) + unit);
    }

    bool read_value(const Key& key, const TomlValue& value, KeyValue& out) {
        switch (key.type) {
            case KeyType::integer:
            case KeyType::decimal: return read_number(key, value, out.number[0]);
            case KeyType::boolean:
                out.number[0] = value.truth ? 1 : 0;
                return value.type == TomlType::boolean || refuse(key, value, "true or false");
            case KeyType::name:
            case KeyType::choice: return read_text(key, value, out);
            case KeyType::numbers: return read_numbers(key, value, out);
        }
        return false;
    }

    bool read_text(const Key& key, const TomlValue& value, KeyValue& out) {
        const std::vector<std::string> choices = split(key.choices, '|');
        std::vector<char> buffer(static_cast<std::size_t>(value.text.size()) + 1);
        const Result<int> length =
            toml_string(value, {buffer.data(), static_cast<std::ptrdiff_t>(buffer.size())});
        if (key.type == KeyType::name) {
            if (length && *length > 0 && *length <= Feature::max_name) {
                out.text.assign(buffer.data(), static_cast<std::size_t>(*length));
                return true;
            }
            return refuse(key, value, "a \"text\" of 1 to " + std::to_string(Feature::max_name) + " bytes");
        }
        std::vector<std::string> quoted;
        for (const std::string& choice : choices) quoted.push_back("\"" + choice + "\"");
        if (!length) return refuse(key, value, "one of " + listed(quoted));
        out.text.assign(buffer.data(), static_cast<std::size_t>(*length));
        for (std::size_t i = 0; i < choices.size(); ++i)
            if (choices[i] == out.text) {
                out.number[0] = static_cast<std::int64_t>(i);
                return true;
            }
        return refuse(key, value, "one of " + listed(quoted) + hint(nearest_name(out.text, choices)));
    }

    bool read_numbers(const Key& key, const TomlValue& value, KeyValue& out) {
        const std::string expected = "an array of " + std::to_string(key.count) + " numbers";
        if (value.type != TomlType::array) return refuse(key, value, expected);
        TomlArrayReader elements(value);
        int count = 0;
        for (;;) {
            const Result<TomlValue> element = elements.next();
            if (!element) break;
            if (count == key.count) return refuse(key, value, expected);
            if (!read_number(key, *element, out.number[static_cast<std::size_t>(count)])) return false;
            ++count;
        }
        return count == key.count || refuse(key, value, expected);
    }

    /// Puts the keys of a table into the recipe, and says which are missing or strange to the kind.
    bool finish_table() {
        Feature feature;
        Recipe& recipe = file_.recipe;
        const bool is_feature = table_ == "feature";
        for (const Seen& seen : seen_)
            if (std::string(seen.key->name) == "kind")
                feature.kind = static_cast<FeatureKind>(seen.value.number[0]);
        const unsigned kind = is_feature ? bit(feature.kind) : every_kind;
        const std::string kind_name = split(feature_kind_names, '|')[static_cast<std::size_t>(feature.kind)];
        for (const Key& key : recipe_keys()) {
            if (table_ != key.table) continue;
            const Seen* given = nullptr;
            for (const Seen& seen : seen_)
                if (seen.key == &key) given = &seen;
            const bool belongs = !is_feature || (key.kinds & kind) != 0;
            if (given == nullptr && belongs && key.required)
                return fail(table_place_, std::string(is_feature ? "this feature" : "the file") + " lacks " +
                                              key.name + ": " + key.text);
            if (given == nullptr) continue;
            if (!belongs)
                return fail(given->place, std::string(key.name) +
                                              " has no meaning for a feature of the kind \"" + kind_name +
                                              "\", which has " + listed(key_names("feature", kind)));
            key.load(recipe, feature, given->value);
        }
        if (is_feature) return finish_feature(feature);
        return true;
    }

    bool finish_feature(const Feature& feature) {
        Recipe& recipe = file_.recipe;
        for (const Feature& before : recipe.features)
            if (text_of(before.name) == text_of(feature.name))
                return fail(table_place_, "two features are called \"" + text_of(feature.name) + "\"");
        if (feature.kind == FeatureKind::distance && (feature.first_edge == 0 || feature.second_edge == 0))
            return fail(table_place_, "edges are numbered from 1, or from -1 at the end of the probe");
        file_.feature_places[static_cast<std::size_t>(recipe.features.size())] = table_place_;
        return recipe.features.push(feature) == Status::ok;
    }

    bool check_whole() {
        const Recipe& recipe = file_.recipe;
        if (!scale_in_range(recipe.scale))
            return fail({1, 1}, "per_pixel_x and per_pixel_y differ by more than four times");
        if (recipe.locate.area_min > recipe.locate.area_max)
            return fail({1, 1}, "area_min is above area_max");
        if (recipe.locate.opening % 2 == 0) return fail({1, 1}, "opening must be odd");
        if (recipe.features.empty()) return fail({1, 1}, "the recipe has no [[feature]] to measure");
        return true;
    }

    TomlReader reader_;
    RecipeFile file_;
    std::string table_;
    TextPlace table_place_;
    std::vector<std::string> tables_;
    std::vector<Seen> seen_;
};

/// False for keys of [locate] that mean nothing beside the others.
inline bool speaks(const Key& key, const Recipe& recipe) {
    const std::string name = key.name;
    if (name == "level") return recipe.locate.threshold == ThresholdRule::fixed;
    if (name == "dark_quantile" || name == "bright_quantile")
        return recipe.locate.threshold == ThresholdRule::quantile;
    if (name == "ends") return !(recipe.locate.ends == Asymmetry{});
    return true;
}

/// A value as it is written in a recipe.
inline std::string written(const Key& key, const KeyValue& value) {
    switch (key.type) {
        case KeyType::name: return json_string(value.text);
        case KeyType::choice:
            return "\"" + split(key.choices, '|')[static_cast<std::size_t>(value.number[0])] + "\"";
        case KeyType::boolean: return value.number[0] != 0 ? "true" : "false";
        case KeyType::integer: return std::to_string(value.number[0]);
        case KeyType::decimal: return shortest(Decimal{value.number[0]});
        case KeyType::numbers: break;
    }
    std::string text = "[";
    for (int i = 0; i < key.count; ++i)
        text += (i == 0 ? "" : ", ") + shortest(Decimal{value.number[static_cast<std::size_t>(i)]});
    return text + "]";
}

}  // namespace detail

inline RecipeFile read_recipe(const std::string& text) { return detail::RecipeReader(text).read(); }

inline std::string write_recipe(const Recipe& recipe, bool comments) {
    const std::string length_unit = recipe.scale.unit == LengthUnit::millimetre ? "mm" : "px";
    std::string text;
    const auto write_table = [&](const std::string& table, const Feature& feature, unsigned kinds,
                                 bool explain) {
        for (const Key& key : recipe_keys()) {
            if (table != key.table || (table == "feature" && (key.kinds & kinds) == 0)) continue;
            const KeyValue value = key.show(recipe, feature);
            if (key.type == KeyType::name && value.text.empty()) continue;
            if (!detail::speaks(key, recipe)) continue;
            std::string line = std::string(key.name) + " = " + detail::written(key, value);
            if (explain) {
                line += std::string(line.size() < 42 ? 42 - line.size() : 1, ' ') + "# " + key.text;
                const std::string unit = key.unit;
                if (!unit.empty()) line += ", " + (unit == "unit" ? length_unit : unit);
            }
            text += line + "\n";
        }
    };
    if (comments)
        text +=
            "# A recipe for `fovea gauge`. Lengths are in the unit below; places are in the frame of\n"
            "# the part: origin at its centroid, x along its axis, y a quarter turn clockwise.\n";
    write_table("", Feature(), 0, comments);
    text += "\n[scale]\n";
    write_table("scale", Feature(), 0, comments);
    text += "\n[locate]\n";
    write_table("locate", Feature(), 0, comments);
    unsigned explained = 0;
    for (const Feature& feature : recipe.features) {
        text += "\n[[feature]]\n";
        // Each kind is explained where it comes first.
        write_table("feature", feature, bit(feature.kind), comments && (explained & bit(feature.kind)) == 0);
        explained |= bit(feature.kind);
    }
    return text;
}

inline std::string recipe_help() {
    std::string text;
    std::string table = "-";
    const Recipe recipe;
    const Feature feature;
    for (const Key& key : recipe_keys()) {
        if (table != key.table) {
            table = key.table;
            text += table.empty()        ? ""
                    : table == "feature" ? "\n[[feature]], once for each\n"
                                         : "\n[" + table + "]\n";
        }
        std::string left = std::string("  ") + key.name;
        text += left + std::string(left.size() < 20 ? 20 - left.size() : 1, ' ') + key.text;
        const bool whole = key.type == KeyType::integer;
        if (key.type == KeyType::choice) text += ": " + listed(split(key.choices, '|'));
        if (key.unit[0] != '\0') text += std::string(", ") + key.unit;
        if (whole) text += ", " + std::to_string(key.low) + " to " + std::to_string(key.high);
        if (key.required)
            text += "; required";
        else if (key.type != KeyType::name)
            text += "; " + detail::written(key, key.show(recipe, feature)) + " if left out";
        if (table == "feature" && key.kinds != every_kind) {
            std::vector<std::string> kinds;
            const std::vector<std::string> names = split(feature_kind_names, '|');
            for (std::size_t i = 0; i < names.size(); ++i)
                if ((key.kinds >> i & 1) != 0) kinds.push_back(names[i]);
            text += " (" + listed(kinds) + ")";
        }
        text += "\n";
    }
    return text;
}

}  // namespace fovea::apps
