// SPDX-License-Identifier: MIT
//
// The one table of recipe keys: the parser, the writer, the help and the sample are all made from it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>

#include <fovea/decision/recipe.hpp>

namespace fovea::apps {

enum class KeyType : std::uint8_t { name, choice, decimal, integer, boolean, point };

/// A value on its way between text and recipe: millionths for decimals and points, a number from 0 for a
/// choice.
struct KeyValue {
    std::array<std::int64_t, 2> number{};
    std::string text;
};

/// Bits of the feature kinds a key belongs to.
constexpr unsigned bit(FeatureKind kind) { return 1u << static_cast<unsigned>(kind); }

/// One key of a recipe file.
struct Key {
    const char* table;  ///< "", "scale", "locate" or "feature"
    const char* name;
    KeyType type;
    const char* unit;     ///< "" when it has none; "unit" is the recipe's length unit
    std::int64_t low;     ///< smallest value, in millionths for decimals and points
    std::int64_t high;    ///< largest value
    const char* choices;  ///< "a|b|c", in the order of the enumeration
    unsigned kinds;       ///< of a feature key: the kinds it belongs to
    bool required;
    const char* text;  ///< one line of help
    void (*load)(Recipe& recipe, Feature& feature, const KeyValue& value);
    KeyValue (*show)(const Recipe& recipe, const Feature& feature);
};

namespace detail {

inline constexpr std::int64_t unit = 1000000;
inline constexpr std::int64_t far = max_part_coordinate;
inline constexpr unsigned every_kind = ~0u;
inline constexpr unsigned along_a_probe = bit(FeatureKind::distance) | bit(FeatureKind::width);
inline constexpr unsigned around_a_place =
    bit(FeatureKind::diameter) | bit(FeatureKind::hole_diameter) | bit(FeatureKind::position);

// How a member goes in and out of a recipe. Member pointers keep the table free of code.
template <auto Part, auto Member>
void load_recipe(Recipe& recipe, Feature&, const KeyValue& value) {
    auto& member = (recipe.*Part).*Member;
    member = static_cast<std::remove_reference_t<decltype(member)>>(value.number[0]);
}
template <auto Part, auto Member>
KeyValue show_recipe(const Recipe& recipe, const Feature&) {
    return {{static_cast<std::int64_t>((recipe.*Part).*Member), 0}, {}};
}
template <auto Member>
void load_feature(Recipe&, Feature& feature, const KeyValue& value) {
    auto& member = feature.*Member;
    member = static_cast<std::remove_reference_t<decltype(member)>>(value.number[0]);
}
template <auto Member>
KeyValue show_feature(const Recipe&, const Feature& feature) {
    return {{static_cast<std::int64_t>(feature.*Member), 0}, {}};
}
template <auto Member>
void load_point(Recipe&, Feature& feature, const KeyValue& value) {
    feature.*Member = {value.number[0], value.number[1]};
}
template <auto Member>
KeyValue show_point(const Recipe&, const Feature& feature) {
    return {{(feature.*Member).x, (feature.*Member).y}, {}};
}
template <auto Member>
void load_tolerance(Recipe&, Feature& feature, const KeyValue& value) {
    (feature.tolerance.*Member).millionths = value.number[0];
}
template <auto Member>
KeyValue show_tolerance(const Recipe&, const Feature& feature) {
    return {{(feature.tolerance.*Member).millionths, 0}, {}};
}
template <std::size_t N>
void copy_name(char (&name)[N], const std::string& text) {
    for (std::size_t i = 0; i < N; ++i) name[i] = i < text.size() && i + 1 < N ? text[i] : '\0';
}
template <std::size_t N>
std::string text_of(const char (&name)[N]) {
    const Span<const char> span = name_of(name);
    return {span.data(), static_cast<std::size_t>(span.size())};
}

}  // namespace detail

inline constexpr const char* feature_kind_names =
    "distance|width|diameter|angle|hole_count|hole_diameter|position";

/// Every key, in the order in which files are written.
inline const auto& recipe_keys() {
    using namespace detail;
    using R = Recipe;
    using L = LocateRule;
    using F = Feature;
    static constexpr Key keys[] = {
        {"", "format", KeyType::integer, "", 1, 1, "", 0, true, "version of this file format",
         [](Recipe&, Feature&, const KeyValue&) {},
         [](const Recipe&, const Feature&) {
             return KeyValue{{1, 0}, {}};
         }},
        {"", "name", KeyType::name, "", 0, 0, "", 0, false, "what the part is called",
         [](Recipe& r, Feature&, const KeyValue& v) { copy_name(r.name, v.text); },
         [](const Recipe& r, const Feature&) {
             return KeyValue{{}, text_of(r.name)};
         }},

        {"scale", "unit", KeyType::choice, "", 0, 0, "px|mm", 0, false, "unit of every length below",
         load_recipe<&R::scale, &Scale::unit>, show_recipe<&R::scale, &Scale::unit>},
        {"scale", "per_pixel_x", KeyType::decimal, "unit per px", min_units_per_pixel, max_units_per_pixel,
         "", 0, false, "length of one pixel along the image's x", load_recipe<&R::scale, &Scale::x_per_pixel>,
         show_recipe<&R::scale, &Scale::x_per_pixel>},
        {"scale", "per_pixel_y", KeyType::decimal, "unit per px", min_units_per_pixel, max_units_per_pixel,
         "", 0, false, "length of one pixel along the image's y", load_recipe<&R::scale, &Scale::y_per_pixel>,
         show_recipe<&R::scale, &Scale::y_per_pixel>},

        {"locate", "part", KeyType::choice, "", 0, 0, "bright|dark", 0, false,
         "brightness of the part on its ground", load_recipe<&R::locate, &L::dark_part>,
         show_recipe<&R::locate, &L::dark_part>},
        {"locate", "threshold", KeyType::choice, "", 0, 0, "fixed|otsu|quantile", 0, false,
         "how part and ground are told apart", load_recipe<&R::locate, &L::threshold>,
         show_recipe<&R::locate, &L::threshold>},
        {"locate", "level", KeyType::integer, "grey level", 1, 255, "", 0, false,
         "threshold of the rule \"fixed\"", load_recipe<&R::locate, &L::level>,
         show_recipe<&R::locate, &L::level>},
        {"locate", "area_min", KeyType::integer, "px", 1, 1073741824, "", 0, false, "smallest area of a part",
         load_recipe<&R::locate, &L::area_min>, show_recipe<&R::locate, &L::area_min>},
        {"locate", "area_max", KeyType::integer, "px", 1, 1073741824, "", 0, false, "largest area of a part",
         load_recipe<&R::locate, &L::area_max>, show_recipe<&R::locate, &L::area_max>},
        {"locate", "hole_area_min", KeyType::integer, "px", 1, 1073741824, "", 0, false,
         "smallest area of a hole; what is smaller is dirt", load_recipe<&R::locate, &L::hole_area_min>,
         show_recipe<&R::locate, &L::hole_area_min>},
        {"locate", "at_border", KeyType::boolean, "", 0, 1, "", 0, false,
         "measure parts that touch the border of the image too", load_recipe<&R::locate, &L::at_border>,
         show_recipe<&R::locate, &L::at_border>},
        {"locate", "orientation", KeyType::choice, "", 0, 0, "full|symmetric|none", 0, false,
         "full: axis and which end is which; symmetric: the axis alone; none: the image's directions",
         load_recipe<&R::locate, &L::orientation>, show_recipe<&R::locate, &L::orientation>},

        {"feature", "name", KeyType::name, "", 0, 0, "", every_kind, true,
         "name in the results, unique in the file",
         [](Recipe&, Feature& f, const KeyValue& v) { copy_name(f.name, v.text); },
         [](const Recipe&, const Feature& f) {
             return KeyValue{{}, text_of(f.name)};
         }},
        {"feature", "kind", KeyType::choice, "", 0, 0, feature_kind_names, every_kind, true,
         "what is measured", load_feature<&F::kind>, show_feature<&F::kind>},
        {"feature", "from", KeyType::point, "unit", -far, far, "", along_a_probe | bit(FeatureKind::angle),
         true, "start of the probe, or of the first edge of an angle: [x, y] in the frame of the part",
         load_point<&F::from>, show_point<&F::from>},
        {"feature", "to", KeyType::point, "unit", -far, far, "", along_a_probe | bit(FeatureKind::angle),
         true, "end of the probe, or of the first edge", load_point<&F::to>, show_point<&F::to>},
        {"feature", "second_from", KeyType::point, "unit", -far, far, "", bit(FeatureKind::angle), true,
         "start of the second edge", load_point<&F::second_from>, show_point<&F::second_from>},
        {"feature", "second_to", KeyType::point, "unit", -far, far, "", bit(FeatureKind::angle), true,
         "end of the second edge", load_point<&F::second_to>, show_point<&F::second_to>},
        {"feature", "centre", KeyType::point, "unit", -far, far, "", around_a_place, true,
         "expected centre: [x, y] in the frame of the part", load_point<&F::centre>, show_point<&F::centre>},
        {"feature", "radius", KeyType::decimal, "unit", 1, far, "", bit(FeatureKind::diameter), true,
         "expected radius", load_feature<&F::radius>, show_feature<&F::radius>},
        {"feature", "search", KeyType::decimal, "unit", 1, far, "", around_a_place | bit(FeatureKind::angle),
         true, "how far from the expected edge or place is looked", load_feature<&F::search>,
         show_feature<&F::search>},
        {"feature", "lines", KeyType::integer, "", 1, 255, "", along_a_probe, false,
         "parallel lines, one pixel apart, that are averaged", load_feature<&F::lines>,
         show_feature<&F::lines>},
        {"feature", "probes", KeyType::integer, "", 3, 128, "",
         bit(FeatureKind::diameter) | bit(FeatureKind::hole_diameter) | bit(FeatureKind::angle), false,
         "probes along the contour", load_feature<&F::probes>, show_feature<&F::probes>},
        {"feature", "first_edge", KeyType::integer, "", -64, 64, "", bit(FeatureKind::distance), false,
         "number of the edge along the probe; negative counts from its end", load_feature<&F::first_edge>,
         show_feature<&F::first_edge>},
        {"feature", "second_edge", KeyType::integer, "", -64, 64, "", bit(FeatureKind::distance), false,
         "number of the edge along the probe; negative counts from its end", load_feature<&F::second_edge>,
         show_feature<&F::second_edge>},
        {"feature", "nominal", KeyType::decimal, "unit", -far, far, "", every_kind, true,
         "the value wanted (degrees for an angle, a number for hole_count)",
         load_tolerance<&Tolerance::nominal>, show_tolerance<&Tolerance::nominal>},
        {"feature", "minus", KeyType::decimal, "unit", 0, far, "", every_kind, true,
         "how far below it is still OK", load_tolerance<&Tolerance::minus>,
         show_tolerance<&Tolerance::minus>},
        {"feature", "plus", KeyType::decimal, "unit", 0, far, "", every_kind, true,
         "how far above it is still OK", load_tolerance<&Tolerance::plus>, show_tolerance<&Tolerance::plus>},
    };
    return keys;
}

}  // namespace fovea::apps
