// SPDX-License-Identifier: MIT
//
// Recipes in files: written with a comment for every key, and explained.
#pragma once

#include <string>
#include <vector>

#include <fovea/decision/recipe.hpp>

#include <common/text.hpp>
#include <gauge/recipe_reader.hpp>
#include <gauge/recipe_schema.hpp>

namespace fovea::apps {

/// The text of a recipe. With comments, every key is explained.
std::string write_recipe(const Recipe& recipe, bool comments = true);

/// What a person may write in a recipe: every key with its unit, range and default.
std::string recipe_help();

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// ", 1 to 255": what values a key takes, "" if it is no number.
inline std::string range_of(const Key& key) {
    const auto bound = [&](std::int64_t limit) {
        return key.type == KeyType::integer ? std::to_string(limit) : shortest(Decimal{limit});
    };
    std::string each =
        key.low == key.high ? ", always " + bound(key.low) : ", " + bound(key.low) + " to " + bound(key.high);
    switch (key.type) {
        case KeyType::integer:
        case KeyType::decimal: return each;
        case KeyType::numbers: return ", array of " + std::to_string(key.count) + each;
        case KeyType::name: return ", 1 to " + std::to_string(Feature::max_name) + " bytes";
        case KeyType::choice:
        case KeyType::boolean: break;
    }
    return "";
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

inline std::string write_recipe(const Recipe& recipe, bool comments) {
    const std::string lengths = recipe.scale.unit == LengthUnit::millimetre ? "mm" : "px";
    const auto unit_in = [&](const Key& key, const Feature& feature) -> std::string {
        const std::string unit = key.unit;
        if (unit == value_unit && feature.kind == FeatureKind::angle) return "degrees";
        if (unit == value_unit && feature.kind == FeatureKind::hole_count) return "";
        return unit == length_unit || unit == value_unit ? lengths : unit;
    };
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
                if (key.type == KeyType::choice && table != "feature")
                    line += ": " + listed(split(key.choices, '|'), "or");
                const std::string unit = unit_in(key, feature);
                if (!unit.empty()) line += ", " + unit;
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
        if (key.type == KeyType::choice) text += ": " + listed(split(key.choices, '|'), "or");
        const std::string unit = key.unit;
        if (unit == length_unit) text += ", px or mm";
        if (unit == value_unit) text += ", px, mm, degrees or a count";
        if (!unit.empty() && unit != length_unit && unit != value_unit) text += ", " + unit;
        text += detail::range_of(key);
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
