// SPDX-License-Identifier: MIT
//
// Recipe: what a gauge looks for and what it measures. Data alone, of fixed size: a file on a host, flash on
// a chip.
#pragma once

#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/tolerance.hpp>
#include <fovea/measure/half_turn.hpp>
#include <fovea/number/decimal.hpp>

namespace fovea {

/// The unit of every length in a recipe and of what is measured.
enum class LengthUnit : std::uint8_t { pixel, millimetre };

/// Units per pixel along x and y of the image, in millionths (nanometres a pixel when the unit is mm).
struct Scale {
    LengthUnit unit = LengthUnit::pixel;
    std::int64_t x_per_pixel = 1000000;
    std::int64_t y_per_pixel = 1000000;
};

/// The height of a pixel in widths of one. Both scales must be positive.
constexpr PixelAspect aspect_of(const Scale& scale) {
    return PixelAspect::from_ratio(scale.y_per_pixel, scale.x_per_pixel);
}

/// The finest and the coarsest scale, in millionths of a unit per pixel: 10 nm to 100 mm. One may be four
/// times the other.
inline constexpr std::int64_t min_units_per_pixel = 10;
inline constexpr std::int64_t max_units_per_pixel = 100000000;

enum class ThresholdRule : std::uint8_t { fixed, otsu, quantile };

/// How the direction of a part is found.
enum class OrientationRule : std::uint8_t {
    full,        ///< axis and the 180-degree decision; a part without a certain one is not judged
    symmetric,   ///< the axis alone: the part looks the same when turned by half
    rotational,  ///< one of several like directions: a square, a nut, a flange with holes around its middle
    none,        ///< the image's own directions: round parts, or parts that lie in a fixture
};

/// What the origin and the axis of a part rest on.
enum class PoseRule : std::uint8_t {
    region,   ///< its pixels, as in the book: a hole that grows moves the frame
    outline,  ///< all inside its outline, holes too
};

struct LocateRule {
    bool dark_part = true;  ///< dark part on bright ground (back light), else bright on dark
    ThresholdRule threshold = ThresholdRule::otsu;
    std::uint8_t level = 128;            ///< of the fixed rule: the least grey level that counts as bright
    std::int64_t dark_quantile = 20000;  ///< of the quantile rule, in millionths of all pixels: the level is
    std::int64_t bright_quantile = 980000;  ///< the middle between the grey levels of these two
    int opening = 1;                   ///< side of the square that clears specks and hairs first; odd, 1 none
    std::int64_t area_min = 100;       ///< pixels
    std::int64_t area_max = 67092481;  ///< pixels; all of the largest image
    std::int64_t hole_area_min = 20;   ///< pixels; smaller holes are dirt
    bool at_border = false;            ///< measure parts that touch the border of the image too
    PoseRule pose = PoseRule::region;
    OrientationRule orientation = OrientationRule::full;
    Asymmetry
        ends;  ///< of the full rule: the taught part's, which tells its ends apart; zero if none is taught
    int symmetry_order = 4;  ///< of the rotational rule: in how many directions the part looks the same
};

enum class FeatureKind : std::uint8_t {
    distance,       ///< between two edges along a probe
    width,          ///< of the material along a probe, outer edge to outer edge
    diameter,       ///< of a circle through radial probes around a place
    angle,          ///< between two straight edges
    hole_count,     ///< holes of at least hole_area_min
    hole_diameter,  ///< of the hole nearest to a place
    position,       ///< distance of the hole nearest to a place from that place
};

/// A place in the frame of the part, in millionths of the unit: origin at the centroid, x along the axis of
/// the part, y a quarter turn clockwise from it on screen.
struct PartPoint {
    std::int64_t x = 0;
    std::int64_t y = 0;
};

/// The farthest a coordinate or length in a recipe may be from zero, in millionths.
inline constexpr std::int64_t max_part_coordinate = 100000000000;

struct Feature {
    static constexpr int max_name = 31;
    static constexpr int max_probes = 128;

    char name[max_name + 1] = {};
    FeatureKind kind = FeatureKind::width;
    PartPoint from;           ///< distance, width: start of the probe. angle: start of the first edge
    PartPoint to;             ///< distance, width: end of the probe. angle: end of the first edge
    PartPoint second_from;    ///< angle: start of the second edge
    PartPoint second_to;      ///< angle: end of the second edge
    PartPoint centre;         ///< diameter, hole_diameter, position: the place
    std::int64_t radius = 0;  ///< diameter: where the edge is expected, in millionths of the unit
    std::int64_t search =
        0;             ///< how far from the expected edge or place is looked, in millionths of the unit
    int lines = 15;    ///< distance, width: parallel lines that are averaged, one pixel apart
    int probes = 48;   ///< diameter, hole_diameter, angle: probes along the contour; 3..max_probes
    int outliers = 4;  ///< diameter, hole_diameter: percent of the probes that may meet something else; 0..50
    int smoothing = 1;  ///< along every probe, in pixels, see EdgeProbe
    int contrast_min =
        0;               ///< the least step of an edge in grey levels; 0 is a quarter of that of the outline
    int first_edge = 1;  ///< distance: number of the edge from the start, or from the end when negative
    int second_edge = -1;  ///< distance: likewise
    Tolerance tolerance;   ///< in the unit; degrees for angle, a number for hole_count
};

/// A recipe with room for so many features. A chip may keep room for fewer than a Recipe has: each is 192
/// bytes.
template <int Capacity>
struct RecipeOf {
    static constexpr int max_features = Capacity;

    char name[Feature::max_name + 1] = {};
    Scale scale;
    LocateRule locate;
    List<Feature, Capacity> features;
};
using Recipe = RecipeOf<24>;

/// What is measured and how, wherever it lies.
struct RecipeView {
    const Scale& scale;
    const LocateRule& locate;
    Span<const Feature> features;

    template <int Capacity>
    constexpr RecipeView(const RecipeOf<Capacity>& recipe)
        : scale(recipe.scale),
          locate(recipe.locate),
          features(recipe.features.begin(), recipe.features.size()) {}
};

/// The length of a name that ends with a zero or at its capacity.
template <std::size_t N>
constexpr Span<const char> name_of(const char (&name)[N]) {
    std::ptrdiff_t length = 0;
    while (length < static_cast<std::ptrdiff_t>(N) && name[length] != '\0') ++length;
    return {name, length};
}

}  // namespace fovea
