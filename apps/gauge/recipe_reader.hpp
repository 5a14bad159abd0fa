// SPDX-License-Identifier: MIT
//
// Recipes read from text: every mistake with its line and column, and what was probably meant.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
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

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline std::vector<std::string> key_names(const std::string& table, unsigned kinds) {
    std::vector<std::string> names;
    for (const Key& key : recipe_keys())
        if (table == key.table && (table != "feature" || (key.kinds & kinds) != 0)) names.push_back(key.name);
    return names;
}

/// What a key of [locate] needs beside it in a recipe to mean anything; "" if it does.
inline std::string lacking_beside(const Key& key, const Recipe& recipe) {
    const std::string name = key.name;
    const LocateRule& locate = recipe.locate;
    if (name == "level" && locate.threshold != ThresholdRule::fixed) return "threshold = \"fixed\"";
    if ((name == "dark_quantile" || name == "bright_quantile") && locate.threshold != ThresholdRule::quantile)
        return "threshold = \"quantile\"";
    if (name == "symmetry_order" && locate.orientation != OrientationRule::rotational)
        return "orientation = \"rotational\"";
    return "";
}

/// False for keys that a recipe is written without.
inline bool speaks(const Key& key, const Recipe& recipe) {
    if (std::string(key.name) == "ends") return !(recipe.locate.ends == Asymmetry{});
    return lacking_beside(key, recipe).empty();
}

/// What a recipe or a feature may be called.
inline bool good_name(const std::string& name) {
    return !name.empty() && name.size() <= static_cast<std::size_t>(Feature::max_name) && printable(name);
}

/// ", always 1" for a key that takes one value alone.
inline std::string only_value(const Key& key) {
    return key.type == KeyType::integer && key.low == key.high ? ", always " + std::to_string(key.low) : "";
}

/// Reads the items of a recipe into it.
class RecipeReader {
public:
    explicit RecipeReader(const std::string& text) : text_(text), reader_(span_of(text)) {}

    RecipeFile read() {
        if (!check_text()) return file_;
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

    /// TOML is UTF-8 throughout, in comments too.
    bool check_text() {
        if (text_.compare(0, 3, "\xef\xbb\xbf") == 0)
            return fail({1, 1}, "the file begins with a byte order mark; save it as UTF-8 without one");
        TextPlace place;
        for (Span<const char> rest = span_of(text_); !rest.empty();) {
            const CodePoint read = first_code_point(rest);
            if (is_no_utf8(read, rest)) return fail(place, "not a text in UTF-8; save the file as such");
            place = rest[0] == '\n' ? TextPlace{place.line + 1, 1}
                                    : TextPlace{place.line, place.column + read.bytes};
            rest = rest.from(read.bytes);
        }
        return true;
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
        if (name == "codes")
            return fail(item.place,
                        "[codes] is no part of a recipe; `fovead` and `fovea read --job` take it");
        if (name != "scale" && name != "locate")
            return fail(item.place, "unknown table [" + shortened(name, 40) + "]" +
                                        hint(bracketed(nearest_name(name, {"scale", "locate", "feature"}))));
        if (array) return fail(item.place, "there is one [" + name + "], in single brackets");
        for (const std::string& before : tables_)
            if (before == name) return fail(item.place, "[" + name + "] stands twice");
        tables_.push_back(name);
        return true;
    }

    static std::string bracketed(const std::string& table) {
        return table.empty() ? "" : table == "feature" ? "[[feature]]" : "[" + table + "]";
    }

    bool take_pair(const TomlItem& item, const std::string& name) {
        const Key* found = nullptr;
        const Key* elsewhere = nullptr;
        for (const Key& key : recipe_keys()) {
            if (name != key.name) continue;
            (table_ == key.table ? found : elsewhere) = &key;
        }
        if (found == nullptr && elsewhere != nullptr)
            return fail(item.place, name + " belongs " +
                                        (elsewhere->table[0] == '\0' ? "before every table"
                                                                     : "in " + bracketed(elsewhere->table)) +
                                        ", not " +
                                        (table_.empty() ? "before it" : "in " + bracketed(table_)));
        if (found == nullptr)
            return fail(item.place, "unknown key " + shortened(name, 40) +
                                        (table_.empty() ? "" : " in " + bracketed(table_)) +
                                        hint(nearest_name(name, key_names(table_, every_kind))));
        for (const Seen& before : seen_)
            if (before.key == found) return fail(item.place, name + " stands twice");
        Seen seen{found, item.place, {}};
        if (!read_value(*found, item.value, seen.value)) return false;
        seen_.push_back(seen);
        return true;
    }

    /// "name: expected this, not that".
    bool refuse(const Key& key, const TomlValue& value, const std::string& expected,
                const std::string& meant = "") {
        std::string found = shortened(one_line(string_of(value.text)), 40);
        if (value.type == TomlType::string) found = "\"" + found + "\"";
        if (value.type == TomlType::array) found = "[" + found + "]";
        return fail(value.place,
                    std::string(key.name) + ": expected " + expected + ", not " + found + hint(meant));
    }

    bool read_number(const Key& key, const TomlValue& value, std::int64_t& number) {
        const bool whole = key.type == KeyType::integer;
        const bool is_number = value.type == TomlType::integer || (!whole && value.type == TomlType::decimal);
        const bool depends = std::string(key.unit) == length_unit || std::string(key.unit) == value_unit;
        const std::string unit = key.unit[0] != '\0' && !depends ? std::string(" ") + key.unit : "";
        const auto bound = [&](std::int64_t limit) {
            return whole ? std::to_string(limit) : shortest(Decimal{limit});
        };
        number = whole ? value.number.millionths / 1000000 : value.number.millionths;
        if (is_number && number >= key.low && number <= key.high) return true;
        if (key.low == key.high) return refuse(key, value, bound(key.low));
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
            if (length) out.text.assign(buffer.data(), static_cast<std::size_t>(*length));
            if (length && good_name(out.text)) return true;
            return refuse(key, value,
                          "a \"name\" of 1 to " + std::to_string(Feature::max_name) +
                              " bytes without control characters");
        }
        std::vector<std::string> quoted;
        for (const std::string& choice : choices) quoted.push_back("\"" + choice + "\"");
        if (!length) return refuse(key, value, listed(quoted, "or"));
        out.text.assign(buffer.data(), static_cast<std::size_t>(*length));
        for (std::size_t i = 0; i < choices.size(); ++i)
            if (choices[i] == out.text) {
                out.number[0] = static_cast<std::int64_t>(i);
                return true;
            }
        const std::string meant = nearest_name(out.text, choices);
        return refuse(key, value, listed(quoted, "or"), meant.empty() ? "" : "\"" + meant + "\"");
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
                                              key.name + ": " + key.text + only_value(key));
            if (given == nullptr) continue;
            if (!is_feature) places_.push_back({key.name, given->place});
            if (!belongs)
                return fail(given->place, std::string(key.name) +
                                              " has no meaning for a feature of the kind \"" + kind_name +
                                              "\", which has " + listed(key_names("feature", kind)));
            key.load(recipe, feature, given->value);
        }
        if (is_feature) return finish_feature(feature);
        return true;
    }

    /// Where a key of the table that was read last stands; the table itself if it was left out.
    TextPlace place_in_table(const std::string& name) const {
        for (const Seen& seen : seen_)
            if (name == seen.key->name) return seen.place;
        return table_place_;
    }

    bool finish_feature(const Feature& feature) {
        Recipe& recipe = file_.recipe;
        for (const Feature& before : recipe.features)
            if (text_of(before.name) == text_of(feature.name))
                return fail(place_in_table("name"),
                            "two features are called \"" + text_of(feature.name) + "\"");
        if (feature.kind == FeatureKind::distance) {
            if (feature.first_edge == 0 || feature.second_edge == 0)
                return fail(place_in_table(feature.first_edge == 0 ? "first_edge" : "second_edge"),
                            "edges are numbered from 1, or from -1 at the end of the probe");
            if (feature.first_edge == feature.second_edge)
                return fail(place_in_table("second_edge"), "first_edge and second_edge are the same edge");
        }
        file_.feature_places[static_cast<std::size_t>(recipe.features.size())] = table_place_;
        return recipe.features.push(feature) == Status::ok;
    }

    /// The last of these keys that was given.
    TextPlace place_of(const std::vector<std::string>& names) const {
        TextPlace last;
        for (const auto& [name, place] : places_)
            if (std::find(names.begin(), names.end(), name) != names.end() && place.line >= last.line)
                last = place;
        return last;
    }
    bool given(const std::string& name) const {
        return std::any_of(places_.begin(), places_.end(),
                           [&](const auto& each) { return each.first == name; });
    }

    bool check_whole() {
        const Recipe& recipe = file_.recipe;
        const bool x = given("per_pixel_x");
        const bool y = given("per_pixel_y");
        if (x != y || (!x && recipe.scale.unit == LengthUnit::millimetre))
            return fail(place_of({"unit", "per_pixel_x", "per_pixel_y"}),
                        std::string("[scale] lacks ") + (x ? "per_pixel_y" : "per_pixel_x") +
                            ": how long a pixel is in " +
                            (recipe.scale.unit == LengthUnit::millimetre ? "mm" : "px"));
        if (!scale_in_range(recipe.scale))
            return fail(place_of({"per_pixel_x", "per_pixel_y"}),
                        "per_pixel_x and per_pixel_y differ by more than four times");
        for (const Key& key : recipe_keys())
            if (given(key.name) && !lacking_beside(key, recipe).empty())
                return fail(place_of({key.name}),
                            std::string(key.name) + " has no meaning without " + lacking_beside(key, recipe));
        if (recipe.locate.orientation == OrientationRule::rotational && !given("symmetry_order"))
            return fail(place_of({"orientation"}),
                        "[locate] lacks symmetry_order: in how many directions the part looks the same");
        if (needs_outline(recipe.locate))
            return fail(place_of({"opening", "orientation", "pose"}),
                        "orientation = \"rotational\" with an opening needs pose = \"outline\"");
        if (recipe.locate.opening % 2 == 0)
            return fail(place_of({"opening"}), "opening: expected an odd number, so that it has a middle");
        if (recipe.locate.area_min > recipe.locate.area_max)
            return fail(place_of({"area_min", "area_max"}), "area_min is above area_max");
        if (recipe.features.empty()) return fail({1, 1}, "the recipe has no [[feature]] to measure");
        return true;
    }

    const std::string& text_;
    TomlReader reader_;
    RecipeFile file_;
    std::string table_;
    TextPlace table_place_;
    std::vector<std::string> tables_;
    std::vector<Seen> seen_;
    std::vector<std::pair<std::string, TextPlace>> places_;  ///< of the keys outside features
};

}  // namespace detail

inline RecipeFile read_recipe(const std::string& text) { return detail::RecipeReader(text).read(); }

}  // namespace fovea::apps
