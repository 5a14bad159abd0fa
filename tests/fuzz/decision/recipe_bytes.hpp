// SPDX-License-Identifier: MIT
//
// A recipe and a small picture from any bytes: a part that can be measured, and then changes to single fields
// of the recipe, each to a value inside or outside its range.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include <fovea/decision/recipe.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::fuzz {

/// Bytes one after another; zeros behind the last one.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

    bool empty() const { return next_ == end_; }
    std::uint8_t byte() { return empty() ? std::uint8_t{0} : *next_++; }
    std::int64_t word() {
        std::uint64_t word = 0;
        for (int i = 0; i < 8; ++i) word = word << 8 | byte();
        return static_cast<std::int64_t>(word);
    }
    /// Any number: a few steps from zero, an end of a range, or all bits at will.
    std::int64_t number(std::int64_t step, std::int64_t low, std::int64_t high) {
        constexpr auto least = std::numeric_limits<std::int64_t>::min();
        constexpr auto most = std::numeric_limits<std::int64_t>::max();
        const std::int64_t ends[] = {low, high, low - 1, high + 1, 0, -1, least, most};
        const std::uint8_t kind = byte();
        if (kind % 4 == 0) return ends[kind / 4 % std::size(ends)];
        if (kind % 4 == 1) return word();
        return static_cast<std::int8_t>(byte()) * step;
    }
    int integer(int low, int high) { return saturate_cast<int>(number(1, low, high)); }

private:
    const std::uint8_t* next_;
    const std::uint8_t* end_;
};

/// An image on the heap without a byte to spare.
struct SmallPicture {
    Size size;
    std::vector<Gray8> pixels;

    ImageView<const Gray8> view() const { return {pixels.data(), size, size.width}; }
};

/// A rectangle with a hole off its middle, soft at its edges, or any bytes again and again.
inline SmallPicture picture_from(Bytes& bytes) {
    SmallPicture picture;
    const int width = 64 - bytes.byte() % 64;
    picture.size = {width, 64 - bytes.byte() % 64};
    const std::uint8_t kind = bytes.byte();
    const int dark = kind % 2 == 0 ? 30 : bytes.byte();
    const int bright = kind % 2 == 0 ? 220 : bytes.byte();
    const int softness = 1 + kind / 2 % 4;
    std::uint8_t pattern[16] = {};
    const bool any_bytes = kind >= 192;
    for (std::uint8_t& level : pattern)
        if (any_bytes) level = bytes.byte();
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < width; ++x) {
            const int inside = std::min({x - 9, 52 - x, y - 19, 44 - y});
            const int hole = 36 - (x - 42) * (x - 42) - (y - 31) * (y - 31);
            const int depth = std::clamp(std::min(inside, -hole / 12), -softness, softness);
            const int soft = bright + (dark - bright) * (depth + softness) / (2 * softness);
            picture.pixels.push_back(any_bytes ? pattern[static_cast<std::size_t>((x * 7 + y * 3) / 4 % 16)]
                                               : static_cast<Gray8>(std::clamp(soft, 0, 255)));
        }
    return picture;
}

constexpr std::int64_t half_pixel = 500000;

inline std::int64_t coordinate(Bytes& bytes) {
    return bytes.number(half_pixel, -max_part_coordinate, max_part_coordinate);
}

/// One feature that the part of picture_from() has.
inline Feature feature_from(Bytes& bytes) {
    Feature feature;
    feature.kind = static_cast<FeatureKind>(bytes.byte() % 7);
    feature.lines = 3;
    feature.probes = 12;
    feature.from = {-30 * half_pixel, -20 * half_pixel};
    feature.to = {30 * half_pixel, -20 * half_pixel};
    if (feature.kind == FeatureKind::distance || feature.kind == FeatureKind::width) {
        feature.from = {-10 * half_pixel, -34 * half_pixel};
        feature.to = {-10 * half_pixel, 34 * half_pixel};
    }
    feature.second_from = {-38 * half_pixel, -16 * half_pixel};
    feature.second_to = {-38 * half_pixel, 16 * half_pixel};
    feature.centre = {22 * half_pixel, 0};
    feature.radius = 12 * half_pixel;
    feature.search = 6 * half_pixel;
    feature.tolerance = {Decimal{24 * half_pixel}, Decimal{half_pixel}, Decimal{half_pixel}};
    return feature;
}

inline void change_rule(Bytes& bytes, LocateRule& rule) {
    const auto end = [&] { return Ratio::from_raw(bytes.integer(-4 * Ratio::one, 4 * Ratio::one)); };
    constexpr std::int64_t pixels = 67092481;
    switch (bytes.byte() % 14) {
        case 0: rule.dark_part = bytes.byte() % 2 == 0; break;
        case 1: rule.threshold = static_cast<ThresholdRule>(bytes.byte() % 5); break;
        case 2: rule.level = bytes.byte(); break;
        case 3: rule.dark_quantile = bytes.number(8000, 0, 1000000); break;
        case 4: rule.bright_quantile = bytes.number(8000, 0, 1000000); break;
        case 5: rule.opening = bytes.integer(1, 255); break;
        case 6: rule.area_min = bytes.number(10, 1, pixels); break;
        case 7: rule.area_max = bytes.number(40, 1, pixels); break;
        case 8: rule.hole_area_min = bytes.number(1, 1, pixels); break;
        case 9: rule.at_border = bytes.byte() % 2 == 0; break;
        case 10: rule.pose = static_cast<PoseRule>(bytes.byte() % 4); break;
        case 11: rule.orientation = static_cast<OrientationRule>(bytes.byte() % 5); break;
        case 12: rule.symmetry_order = bytes.integer(min_symmetry_order, max_symmetry_order); break;
        default: rule.ends = {end(), end(), end(), end()}; break;
    }
}

inline void change_feature(Bytes& bytes, Feature& feature) {
    switch (bytes.byte() % 19) {
        case 0: feature.kind = static_cast<FeatureKind>(bytes.byte() % 9); break;
        case 1: feature.from.x = coordinate(bytes); break;
        case 2: feature.from.y = coordinate(bytes); break;
        case 3: feature.to.x = coordinate(bytes); break;
        case 4: feature.to.y = coordinate(bytes); break;
        case 5: feature.second_from = {coordinate(bytes), coordinate(bytes)}; break;
        case 6: feature.second_to = {coordinate(bytes), coordinate(bytes)}; break;
        case 7: feature.centre.x = coordinate(bytes); break;
        case 8: feature.centre.y = coordinate(bytes); break;
        case 9: feature.radius = coordinate(bytes); break;
        case 10: feature.search = coordinate(bytes); break;
        case 11: feature.lines = bytes.integer(1, 255); break;
        case 12: feature.probes = bytes.integer(3, Feature::max_probes); break;
        case 13: feature.smoothing = bytes.integer(1, 16); break;
        case 14: feature.contrast_min = bytes.integer(0, 255); break;
        case 15: feature.first_edge = bytes.integer(-64, 64); break;
        case 16: feature.second_edge = bytes.integer(-64, 64); break;
        case 17: feature.tolerance.nominal.millionths = coordinate(bytes); break;
        default:
            feature.tolerance.minus.millionths = coordinate(bytes);
            feature.tolerance.plus.millionths = coordinate(bytes);
            break;
    }
}

/// A recipe of up to three features, and as many changes to it as there are bytes.
inline Recipe recipe_from(Bytes& bytes) {
    Recipe recipe;
    const std::uint8_t first = bytes.byte();
    constexpr OrientationRule rules[] = {OrientationRule::symmetric, OrientationRule::full,
                                         OrientationRule::rotational, OrientationRule::full};
    recipe.locate.orientation = rules[first % 4];
    const int features = first / 4 % 4;
    for (int i = 0; i < features; ++i) static_cast<void>(recipe.features.push(feature_from(bytes)));
    while (!bytes.empty()) {
        const std::uint8_t what = bytes.byte();
        if (what % 8 == 0)
            recipe.scale.x_per_pixel = bytes.number(half_pixel, min_units_per_pixel, max_units_per_pixel);
        else if (what % 8 == 1)
            recipe.scale.y_per_pixel = bytes.number(half_pixel, min_units_per_pixel, max_units_per_pixel);
        else if (what % 8 < 4 || features == 0)
            change_rule(bytes, recipe.locate);
        else
            change_feature(bytes, recipe.features[what / 8 % features]);
    }
    return recipe;
}

}  // namespace fovea::fuzz
