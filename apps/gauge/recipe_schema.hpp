// SPDX-License-Identifier: MIT
//
// The one table of recipe keys: the parser, the writer, the help and the sample are all made from it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>

#include <fovea/decision/recipe.hpp>
#include <fovea/measure/edge_probe.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/statistics/polygon_symmetry.hpp>

namespace fovea::apps {

/// Units of keys that depend on the recipe: its length unit, and that of a feature's value.
inline constexpr const char* length_unit = "unit";
inline constexpr const char* value_unit = "value";

enum class KeyType : std::uint8_t { name, choice, decimal, integer, boolean, numbers };

/// A value on its way between text and recipe: millionths for decimals and arrays of numbers, a number from 0
/// for a choice.
struct KeyValue {
    std::array<std::int64_t, 4> number{};
    std::string text;
};

/// Bits of the feature kinds a key belongs to.
constexpr unsigned bit(FeatureKind kind) { return 1u << static_cast<unsigned>(kind); }
inline constexpr unsigned every_kind = ~0u;

/// One key of a recipe file.
struct Key {
    using Load = void (*)(Recipe& recipe, Feature& feature, const KeyValue& value);
    using Show = KeyValue (*)(const Recipe& recipe, const Feature& feature);

    const char* table;  ///< "", "scale", "locate" or "feature"
    const char* name;
    KeyType type;
    const char* text;  ///< one line of help
    Load load;
    Show show;
    const char* unit = "";        ///< "" when it has none; see length_unit and value_unit
    std::int64_t low = 0;         ///< smallest value, in millionths for decimals and arrays
    std::int64_t high = 0;        ///< largest value
    const char* choices = "";     ///< "a|b|c", in the order of the enumeration
    int count = 1;                ///< how many numbers an array has
    unsigned kinds = every_kind;  ///< of a feature key: the kinds it belongs to
    bool required = false;

    constexpr Key range(std::int64_t least, std::int64_t most, const char* what = "") const {
        Key key = *this;
        key.low = least;
        key.high = most;
        key.unit = what;
        return key;
    }
    constexpr Key one_of(const char* words) const {
        Key key = *this;
        key.choices = words;
        return key;
    }
    constexpr Key array_of(int numbers) const {
        Key key = *this;
        key.count = numbers;
        return key;
    }
    constexpr Key of(unsigned which) const {
        Key key = *this;
        key.kinds = which;
        return key;
    }
    constexpr Key needed() const {
        Key key = *this;
        key.required = true;
        return key;
    }
};

namespace detail {

inline constexpr std::int64_t far = max_part_coordinate;
inline constexpr unsigned along_a_probe = bit(FeatureKind::distance) | bit(FeatureKind::width);
inline constexpr unsigned around_a_place =
    bit(FeatureKind::diameter) | bit(FeatureKind::hole_diameter) | bit(FeatureKind::position);
inline constexpr unsigned along_a_contour =
    bit(FeatureKind::diameter) | bit(FeatureKind::hole_diameter) | bit(FeatureKind::angle);
inline constexpr unsigned with_edges = along_a_probe | along_a_contour;

// How a member goes in and out of a recipe. Member pointers keep the table free of code.
template <auto Part, auto Member>
void load_recipe(Recipe& recipe, Feature&, const KeyValue& value) {
    auto& member = (recipe.*Part).*Member;
    member = static_cast<std::remove_reference_t<decltype(member)>>(value.number[0]);
}
template <auto Part, auto Member>
KeyValue show_recipe(const Recipe& recipe, const Feature&) {
    return {{static_cast<std::int64_t>((recipe.*Part).*Member)}, {}};
}
template <auto Member>
void load_feature(Recipe&, Feature& feature, const KeyValue& value) {
    auto& member = feature.*Member;
    member = static_cast<std::remove_reference_t<decltype(member)>>(value.number[0]);
}
template <auto Member>
KeyValue show_feature(const Recipe&, const Feature& feature) {
    return {{static_cast<std::int64_t>(feature.*Member)}, {}};
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
    return {{(feature.tolerance.*Member).millionths}, {}};
}
inline void load_ends(Recipe& recipe, Feature&, const KeyValue& value) {
    const auto ratio = [](std::int64_t millionths) { return Ratio::from_ratio(millionths, 1000000); };
    recipe.locate.ends = {ratio(value.number[0]), ratio(value.number[1]), ratio(value.number[2]),
                          ratio(value.number[3])};
}
inline KeyValue show_ends(const Recipe& recipe, const Feature&) {
    const auto millionths = [](Ratio ratio) { return round_shift(std::int64_t{ratio.raw()} * 1000000, 16); };
    const Asymmetry& ends = recipe.locate.ends;
    return {{millionths(ends.sss), millionths(ends.sst), millionths(ends.stt), millionths(ends.ttt)}, {}};
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
    using T = Tolerance;
    constexpr std::int64_t pixels = 67092481;
    static constexpr Key keys[] = {
        Key{"", "format", KeyType::integer, "version of this file format",
            [](Recipe&, Feature&, const KeyValue&) {},
            [](const Recipe&, const Feature&) {
                return KeyValue{{1}, {}};
            }}
            .range(1, 1)
            .needed(),
        Key{"", "name", KeyType::name, "what the part is called",
            [](Recipe& r, Feature&, const KeyValue& v) { copy_name(r.name, v.text); },
            [](const Recipe& r, const Feature&) {
                return KeyValue{{}, text_of(r.name)};
            }},

        Key{"scale", "unit", KeyType::choice, "unit of every length below",
            load_recipe<&R::scale, &Scale::unit>, show_recipe<&R::scale, &Scale::unit>}
            .one_of("px|mm"),
        Key{"scale", "per_pixel_x", KeyType::decimal, "length of a pixel along the rows of the image",
            load_recipe<&R::scale, &Scale::x_per_pixel>, show_recipe<&R::scale, &Scale::x_per_pixel>}
            .range(min_units_per_pixel, max_units_per_pixel, length_unit),
        Key{"scale", "per_pixel_y", KeyType::decimal, "length of a pixel down its columns",
            load_recipe<&R::scale, &Scale::y_per_pixel>, show_recipe<&R::scale, &Scale::y_per_pixel>}
            .range(min_units_per_pixel, max_units_per_pixel, length_unit),

        Key{"locate", "part", KeyType::choice, "brightness of the part on its ground",
            load_recipe<&R::locate, &L::dark_part>, show_recipe<&R::locate, &L::dark_part>}
            .one_of("bright|dark"),
        Key{"locate", "threshold", KeyType::choice, "how part and ground are told apart",
            load_recipe<&R::locate, &L::threshold>, show_recipe<&R::locate, &L::threshold>}
            .one_of("fixed|otsu|quantile"),
        Key{"locate", "level", KeyType::integer, "of \"fixed\": the least level that counts as bright",
            load_recipe<&R::locate, &L::level>, show_recipe<&R::locate, &L::level>}
            .range(1, 255, "grey level"),
        Key{"locate", "dark_quantile", KeyType::decimal,
            "of \"quantile\": the share of pixels darker than dark",
            load_recipe<&R::locate, &L::dark_quantile>, show_recipe<&R::locate, &L::dark_quantile>}
            .range(0, 1000000),
        Key{"locate", "bright_quantile", KeyType::decimal, "of \"quantile\": the share darker than bright",
            load_recipe<&R::locate, &L::bright_quantile>, show_recipe<&R::locate, &L::bright_quantile>}
            .range(0, 1000000),
        Key{"locate", "opening", KeyType::integer,
            "odd side of the square that clears hairs and specks, 1 for none",
            load_recipe<&R::locate, &L::opening>, show_recipe<&R::locate, &L::opening>}
            .range(1, max_element_side, "px"),
        Key{"locate", "area_min", KeyType::integer, "smallest area of a part",
            load_recipe<&R::locate, &L::area_min>, show_recipe<&R::locate, &L::area_min>}
            .range(1, pixels, "px"),
        Key{"locate", "area_max", KeyType::integer, "largest area of a part",
            load_recipe<&R::locate, &L::area_max>, show_recipe<&R::locate, &L::area_max>}
            .range(1, pixels, "px"),
        Key{"locate", "hole_area_min", KeyType::integer, "smallest area of a hole; what is smaller is dirt",
            load_recipe<&R::locate, &L::hole_area_min>, show_recipe<&R::locate, &L::hole_area_min>}
            .range(1, pixels, "px"),
        Key{"locate", "at_border", KeyType::boolean, "measure parts that touch the border of the image too",
            load_recipe<&R::locate, &L::at_border>, show_recipe<&R::locate, &L::at_border>},
        Key{"locate", "pose", KeyType::choice,
            "what origin and axis rest on, the part without its holes or all inside its outline",
            load_recipe<&R::locate, &L::pose>, show_recipe<&R::locate, &L::pose>}
            .one_of("region|outline"),
        Key{"locate", "orientation", KeyType::choice,
            "how its turn is found, by axis and ends, by the axis alone, by its symmetry or not at all",
            load_recipe<&R::locate, &L::orientation>, show_recipe<&R::locate, &L::orientation>}
            .one_of("full|symmetric|rotational|none"),
        Key{"locate", "symmetry_order", KeyType::integer,
            "of \"rotational\": in how many directions the part looks the same",
            load_recipe<&R::locate, &L::symmetry_order>, show_recipe<&R::locate, &L::symmetry_order>}
            .range(min_symmetry_order, max_symmetry_order),
        Key{"locate", "ends", KeyType::numbers, "third moments that tell the part's ends apart", load_ends,
            show_ends}
            .range(-4000000, 4000000)
            .array_of(4),

        Key{"feature", "name", KeyType::name, "name in the results, unique in the file",
            [](Recipe&, Feature& f, const KeyValue& v) { copy_name(f.name, v.text); },
            [](const Recipe&, const Feature& f) {
                return KeyValue{{}, text_of(f.name)};
            }}
            .needed(),
        Key{"feature", "kind", KeyType::choice, "what is measured", load_feature<&F::kind>,
            show_feature<&F::kind>}
            .one_of(feature_kind_names)
            .needed(),
        Key{"feature", "from", KeyType::numbers, "start of the probe, or of the first edge",
            load_point<&F::from>, show_point<&F::from>}
            .range(-far, far, length_unit)
            .array_of(2)
            .of(along_a_probe | bit(FeatureKind::angle))
            .needed(),
        Key{"feature", "to", KeyType::numbers, "end of the probe, or of the first edge", load_point<&F::to>,
            show_point<&F::to>}
            .range(-far, far, length_unit)
            .array_of(2)
            .of(along_a_probe | bit(FeatureKind::angle))
            .needed(),
        Key{"feature", "second_from", KeyType::numbers, "start of the second edge",
            load_point<&F::second_from>, show_point<&F::second_from>}
            .range(-far, far, length_unit)
            .array_of(2)
            .of(bit(FeatureKind::angle))
            .needed(),
        Key{"feature", "second_to", KeyType::numbers, "end of the second edge", load_point<&F::second_to>,
            show_point<&F::second_to>}
            .range(-far, far, length_unit)
            .array_of(2)
            .of(bit(FeatureKind::angle))
            .needed(),
        Key{"feature", "centre", KeyType::numbers, "expected centre", load_point<&F::centre>,
            show_point<&F::centre>}
            .range(-far, far, length_unit)
            .array_of(2)
            .of(around_a_place)
            .needed(),
        Key{"feature", "radius", KeyType::decimal, "expected radius", load_feature<&F::radius>,
            show_feature<&F::radius>}
            .range(1, far, length_unit)
            .of(bit(FeatureKind::diameter))
            .needed(),
        Key{"feature", "search", KeyType::decimal, "how far from the expected edge or place is looked",
            load_feature<&F::search>, show_feature<&F::search>}
            .range(1, far, length_unit)
            .of(around_a_place | bit(FeatureKind::angle))
            .needed(),
        Key{"feature", "lines", KeyType::integer, "parallel lines, a pixel apart, that are averaged",
            load_feature<&F::lines>, show_feature<&F::lines>}
            .range(1, max_probe_lines)
            .of(along_a_probe),
        Key{"feature", "probes", KeyType::integer, "probes along the contour", load_feature<&F::probes>,
            show_feature<&F::probes>}
            .range(3, Feature::max_probes)
            .of(along_a_contour),
        Key{"feature", "outliers", KeyType::integer, "share of the probes that may miss the circle",
            load_feature<&F::outliers>, show_feature<&F::outliers>}
            .range(0, 50, "percent")
            .of(bit(FeatureKind::diameter) | bit(FeatureKind::hole_diameter)),
        Key{"feature", "smoothing", KeyType::integer,
            "along the probes; more for blur and noise, less for close edges", load_feature<&F::smoothing>,
            show_feature<&F::smoothing>}
            .range(1, max_probe_smoothing, "px")
            .of(with_edges),
        Key{"feature", "contrast_min", KeyType::integer,
            "least step of an edge; 0 is a quarter of the outline's", load_feature<&F::contrast_min>,
            show_feature<&F::contrast_min>}
            .range(0, 255, "grey levels")
            .of(with_edges),
        Key{"feature", "first_edge", KeyType::integer, "number of the edge from the start; -1 is the last",
            load_feature<&F::first_edge>, show_feature<&F::first_edge>}
            .range(-64, 64)
            .of(bit(FeatureKind::distance)),
        Key{"feature", "second_edge", KeyType::integer, "number of the edge from the start; -1 is the last",
            load_feature<&F::second_edge>, show_feature<&F::second_edge>}
            .range(-64, 64)
            .of(bit(FeatureKind::distance)),
        Key{"feature", "nominal", KeyType::decimal, "the value wanted", load_tolerance<&T::nominal>,
            show_tolerance<&T::nominal>}
            .range(-far, far, value_unit)
            .needed(),
        Key{"feature", "minus", KeyType::decimal, "how far below it is still OK", load_tolerance<&T::minus>,
            show_tolerance<&T::minus>}
            .range(0, far, value_unit)
            .needed(),
        Key{"feature", "plus", KeyType::decimal, "how far above it is still OK", load_tolerance<&T::plus>,
            show_tolerance<&T::plus>}
            .range(0, far, value_unit)
            .needed(),
    };
    return keys;
}

}  // namespace fovea::apps
