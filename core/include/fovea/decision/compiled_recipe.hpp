// SPDX-License-Identifier: MIT
//
// Recipes as bytes: what a chip keeps in its flash or gets over a line, with a version and a checksum.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/crc32.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/decision/recipe_range.hpp>
#include <fovea/draw/utf8.hpp>
#include <fovea/number/fixed.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What the bytes begin with: four letters and the version of all that follows.
inline constexpr std::uint8_t compiled_recipe_magic[4] = {'F', 'V', 'R', 'C'};
inline constexpr int compiled_recipe_version = 1;

/// The most bytes of a recipe with so many features; most take a quarter of it.
constexpr std::ptrdiff_t compiled_recipe_bytes(int features);

/// Writes a recipe as bytes, and answers how many.
///
/// Format  magic, version (1 byte), length of all (2 bytes, low byte first), fields, CRC-32 of all before it
///         (4 bytes, low byte first). A field is a number of 64 bits in groups of 7 bits, low group first,
///         the eighth bit set in all but the last; the sign is the lowest bit (zigzag). A name is its length
///         and its bytes. The fields stand in the order of Recipe, LocateRule and Feature
/// Errors  bad_argument for a recipe that gauge() would refuse in whole or in part, or a name that is not
///         printable UTF-8; buffer_too_small
template <int Capacity>
constexpr Result<std::ptrdiff_t> encode_recipe(const RecipeOf<Capacity>& recipe, Span<std::uint8_t> out);

/// Reads what encode_recipe() wrote. A recipe that is read can be measured with: every value is in its range.
///
/// Errors  truncated for less than the bytes say; unsupported for another version; malformed for other bytes,
///         a wrong checksum, or a value that no recipe has; capacity_exceeded for more features than there is
///         room for. The recipe stays as it was
template <int Capacity>
constexpr Status decode_recipe(Span<const std::uint8_t> bytes, RecipeOf<Capacity>& recipe);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr std::ptrdiff_t compiled_head = 7;
inline constexpr std::ptrdiff_t compiled_tail = 4;
inline constexpr std::ptrdiff_t most_number_bytes = 10;
inline constexpr int numbers_of_a_recipe = 21;
inline constexpr int numbers_of_a_feature = 23;

/// Puts fields behind each other. Counts on where there is no room.
class FieldWriter {
public:
    constexpr explicit FieldWriter(Span<std::uint8_t> out) : out_(out) {}

    constexpr std::ptrdiff_t size() const { return size_; }
    constexpr void byte(std::uint8_t value) {
        if (size_ < out_.size()) out_[size_] = value;
        ++size_;
    }
    constexpr void little_endian(std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) byte(static_cast<std::uint8_t>(value >> 8 * i));
    }
    template <class T>
    constexpr void number(const T& value) {
        const auto wide = static_cast<std::int64_t>(value);
        const auto bits = static_cast<std::uint64_t>(wide);
        std::uint64_t rest = bits << 1 ^ (wide < 0 ? ~std::uint64_t{0} : 0);
        for (; rest >= 0x80; rest >>= 7) byte(static_cast<std::uint8_t>(rest | 0x80));
        byte(static_cast<std::uint8_t>(rest));
    }
    constexpr void ratio(const Ratio& value) { number(value.raw()); }
    constexpr void name(const char (&text)[Feature::max_name + 1]) {
        const Span<const char> letters = name_of(text);
        number(letters.size());
        for (std::ptrdiff_t i = 0; i < letters.size(); ++i) byte(static_cast<std::uint8_t>(letters[i]));
    }

private:
    Span<std::uint8_t> out_;
    std::ptrdiff_t size_ = 0;
};

/// Takes fields one after the other; after the first that is not there or has no meaning, good() is false.
class FieldReader {
public:
    constexpr explicit FieldReader(Span<const std::uint8_t> in) : in_(in) {}

    constexpr bool good() const { return good_; }
    constexpr bool at_end() const { return in_.empty(); }
    /// False in good() also where the number is none of T.
    template <class T>
    constexpr void number(T& value) {
        const std::int64_t wide = next();
        value = static_cast<T>(wide);
        if (static_cast<std::int64_t>(value) != wide) good_ = false;
    }
    constexpr void ratio(Ratio& value) {
        std::int32_t raw = 0;
        number(raw);
        value = Ratio::from_raw(raw);
    }
    constexpr void name(char (&text)[Feature::max_name + 1]) {
        int length = 0;
        number(length);
        if (length < 0 || length > Feature::max_name || length > in_.size()) {
            good_ = false;
            length = 0;
        }
        for (int i = 0; i <= Feature::max_name; ++i) text[i] = i < length ? static_cast<char>(in_[i]) : '\0';
        in_ = in_.from(length);
        if (!is_printable(name_of(text)) || name_of(text).size() != length) good_ = false;
    }

private:
    constexpr std::int64_t next() {
        std::uint64_t bits = 0;
        for (int shift = 0; shift < 64 && !in_.empty(); shift += 7) {
            const std::uint8_t byte = in_[0];
            in_ = in_.from(1);
            bits |= std::uint64_t{byte & 0x7fu} << shift;
            if (shift == 63 && byte > 1) break;
            if (byte < 0x80) return static_cast<std::int64_t>(bits >> 1 ^ (~std::uint64_t{0} * (bits & 1)));
        }
        good_ = false;
        return 0;
    }

    Span<const std::uint8_t> in_;
    bool good_ = true;
};

/// The fields in their order, for a writer and for a reader.
template <class Fields, class Name, class TheScale, class Rule>
constexpr void recipe_fields(Fields& fields, Name& name, TheScale& scale, Rule& rule) {
    fields.name(name);
    fields.number(scale.unit);
    fields.number(scale.x_per_pixel);
    fields.number(scale.y_per_pixel);
    fields.number(rule.dark_part);
    fields.number(rule.threshold);
    fields.number(rule.level);
    fields.number(rule.dark_quantile);
    fields.number(rule.bright_quantile);
    fields.number(rule.opening);
    fields.number(rule.area_min);
    fields.number(rule.area_max);
    fields.number(rule.hole_area_min);
    fields.number(rule.at_border);
    fields.number(rule.pose);
    fields.number(rule.orientation);
    fields.ratio(rule.ends.sss);
    fields.ratio(rule.ends.sst);
    fields.ratio(rule.ends.stt);
    fields.ratio(rule.ends.ttt);
    fields.number(rule.symmetry_order);
}
template <class Fields, class TheFeature>
constexpr void feature_fields(Fields& fields, TheFeature& feature) {
    fields.name(feature.name);
    fields.number(feature.kind);
    for (auto* place :
         {&feature.from, &feature.to, &feature.second_from, &feature.second_to, &feature.centre}) {
        fields.number(place->x);
        fields.number(place->y);
    }
    fields.number(feature.radius);
    fields.number(feature.search);
    fields.number(feature.lines);
    fields.number(feature.probes);
    fields.number(feature.outliers);
    fields.number(feature.smoothing);
    fields.number(feature.contrast_min);
    fields.number(feature.first_edge);
    fields.number(feature.second_edge);
    fields.number(feature.tolerance.nominal.millionths);
    fields.number(feature.tolerance.minus.millionths);
    fields.number(feature.tolerance.plus.millionths);
}

constexpr bool recipe_in_range(const Scale& scale, const LocateRule& rule) {
    return scale.unit <= LengthUnit::millimetre && scale_in_range(scale) && rule_in_range(rule);
}
constexpr bool whole_feature_in_range(const Feature& feature) {
    return feature.kind <= FeatureKind::position && feature_in_range(feature);
}

/// The fields between head and checksum, if all about the bytes is right.
constexpr Result<Span<const std::uint8_t>> fields_of(Span<const std::uint8_t> bytes) {
    for (std::ptrdiff_t i = 0; i < 4; ++i) {
        if (i == bytes.size()) return Status::truncated;
        if (bytes[i] != compiled_recipe_magic[i]) return Status::malformed;
    }
    if (bytes.size() < compiled_head + compiled_tail) return Status::truncated;
    if (bytes[4] != compiled_recipe_version) return Status::unsupported;
    const std::ptrdiff_t length = bytes[5] | bytes[6] << 8;
    if (bytes.size() < length) return Status::truncated;
    if (bytes.size() > length || length < compiled_head + compiled_tail) return Status::malformed;
    const Span<const std::uint8_t> tail = bytes.from(length - compiled_tail);
    const std::uint32_t sum =
        tail[0] | std::uint32_t{tail[1]} << 8 | std::uint32_t{tail[2]} << 16 | std::uint32_t{tail[3]} << 24;
    if (crc32(bytes.first(length - compiled_tail)) != sum) return Status::malformed;
    return bytes.from(compiled_head).first(length - compiled_head - compiled_tail);
}

/// Reads all fields; the features only if there is a list for them, whose room was asked for before.
constexpr Status read_recipe_fields(FieldReader fields, char (&name)[Feature::max_name + 1], Scale& scale,
                                    LocateRule& rule, int capacity, const ListView<Feature>* features) {
    recipe_fields(fields, name, scale, rule);
    int count = 0;
    fields.number(count);
    if (!fields.good() || count < 0 || !recipe_in_range(scale, rule)) return Status::malformed;
    if (count > capacity) return Status::capacity_exceeded;
    if (features != nullptr) features->clear();
    Feature other;
    for (int i = 0; i < count; ++i) {
        Feature& feature = features != nullptr ? *features->append() : other;
        feature_fields(fields, feature);
        if (!fields.good() || !whole_feature_in_range(feature)) return Status::malformed;
    }
    return fields.at_end() ? Status::ok : Status::malformed;
}

}  // namespace detail

constexpr std::ptrdiff_t compiled_recipe_bytes(int features) {
    const auto with_name = [](int numbers) {
        return Feature::max_name + 1 + numbers * detail::most_number_bytes;
    };
    return detail::compiled_head + detail::compiled_tail + with_name(detail::numbers_of_a_recipe) +
           features * with_name(detail::numbers_of_a_feature);
}

template <int Capacity>
constexpr Result<std::ptrdiff_t> encode_recipe(const RecipeOf<Capacity>& recipe, Span<std::uint8_t> out) {
    static_assert(compiled_recipe_bytes(Capacity) <= 0xffff, "the length has two bytes");
    if (!detail::recipe_in_range(recipe.scale, recipe.locate) || !is_printable(name_of(recipe.name)))
        return Status::bad_argument;
    for (const Feature& feature : recipe.features)
        if (!detail::whole_feature_in_range(feature) || !is_printable(name_of(feature.name)))
            return Status::bad_argument;
    const auto write = [&recipe](detail::FieldWriter& fields, std::ptrdiff_t length) {
        for (const std::uint8_t letter : compiled_recipe_magic) fields.byte(letter);
        fields.byte(compiled_recipe_version);
        fields.little_endian(static_cast<std::uint32_t>(length), 2);
        detail::recipe_fields(fields, recipe.name, recipe.scale, recipe.locate);
        fields.number(recipe.features.size());
        for (const Feature& feature : recipe.features) detail::feature_fields(fields, feature);
    };
    // Once for the length, so that a buffer that is too small stays as it was.
    detail::FieldWriter counted({});
    write(counted, 0);
    const std::ptrdiff_t length = counted.size() + detail::compiled_tail;
    if (out.size() < length) return Status::buffer_too_small;
    detail::FieldWriter fields(out);
    write(fields, length);
    fields.little_endian(crc32(Span<const std::uint8_t>(out.data(), length - detail::compiled_tail)), 4);
    return length;
}

template <int Capacity>
constexpr Status decode_recipe(Span<const std::uint8_t> bytes, RecipeOf<Capacity>& recipe) {
    const Result<Span<const std::uint8_t>> fields = detail::fields_of(bytes);
    if (!fields) return fields.status();
    char name[Feature::max_name + 1] = {};
    Scale scale;
    LocateRule rule;
    // First to see whether it can be read, with room for one feature; then into the recipe.
    if (Status s =
            detail::read_recipe_fields(detail::FieldReader(*fields), name, scale, rule, Capacity, nullptr);
        s != Status::ok)
        return s;
    const ListView<Feature> features = recipe.features.view();
    return detail::read_recipe_fields(detail::FieldReader(*fields), recipe.name, recipe.scale, recipe.locate,
                                      Capacity, &features);
}

}  // namespace fovea
