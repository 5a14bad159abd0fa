// SPDX-License-Identifier: MIT
//
// Regions and holes of a binary image, and what is asked of them.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Area and centroid alone, at a fraction of the cost of Moments: what most sorting of regions asks for.
struct FirstMoments {
    std::int64_t m00 = 0;
    std::int64_t m10 = 0, m01 = 0;

    constexpr std::int64_t area() const { return m00; }
    /// Adds the pixels first..end-1 of row y.
    constexpr void add_run(int first, int end, int y);
    constexpr void add(const FirstMoments& other);
    /// The mean place of the pixels, to the nearest 1/65536 px. There must be one.
    constexpr FinePoint centroid() const;
};

/// Which neighbours hold together. The ground holds together by the other of the two.
enum class Connectivity : std::uint8_t {
    four,   ///< neighbours that share a side
    eight,  ///< corners too
};

enum class BorderRegions : std::uint8_t {
    keep,  ///< list regions that touch the border of the image
    drop,  ///< leave them out: a part of them may be outside
};

struct ComponentOptions {
    Connectivity connectivity = Connectivity::eight;
    BorderRegions at_border = BorderRegions::keep;
    std::int64_t area_min = 1;         ///< pixels; smaller regions are dirt
    std::int64_t area_max = 67092481;  ///< pixels; all of the largest image
    std::int64_t hole_area_min = 1;    ///< pixels; smaller holes are dirt
    bool find_holes = true;            ///< false: no hole is listed or counted, and the ground takes no time
};

/// A connected set of non-zero pixels, with the sums over them that Accumulated holds.
template <class Accumulated>
struct RegionOf {
    Accumulated moments;         ///< of its pixels, without its holes
    Rectangle box;               ///< the smallest upright rectangle around it
    Point first;                 ///< its first pixel, row by row
    bool at_border = false;      ///< it touches the border of the image
    int holes = 0;               ///< its holes of at least hole_area_min
    std::int64_t hole_area = 0;  ///< pixels in them
    int number = 0;              ///< its place in the list
};

/// A connected set of zero pixels that a region surrounds.
template <class Accumulated>
struct HoleOf {
    Accumulated moments;
    Rectangle box;
    Point first;     ///< its first pixel, row by row
    int region = 0;  ///< place of the surrounding region in its list
};

using Region = RegionOf<Moments>;
using Hole = HoleOf<Moments>;

/// The shapes of regions that are wanted.
struct RegionFilter {
    std::int64_t area_min = 1;                   ///< pixels
    std::int64_t area_max = 67092481;            ///< pixels; all of the largest image
    int side_min = 1;                            ///< pixels; the shorter side of the box
    Ratio aspect_max = Ratio::from_ratio(7, 2);  ///< longer by shorter side of the box, 1 or more
    Ratio fill_min = Ratio::from_raw(19660);  ///< share of the box that the region fills, 0 to 1; 3/10, down
};

enum class Compactness : std::uint8_t { not_compact, compact };

/// Whether a region of this area and box is compact: neither too small or large, nor thin, nor full of gaps.
///
/// Rounding  none: ratios are compared by products
/// Errors    bad_argument for limits that are negative or crossed, an aspect below 1, a share above 1, or an
///           empty box
/// Source    the compact-region test of the IVT, with sides in pixels: there a side is one less
constexpr Result<Compactness> filter_region(std::int64_t area, Rectangle box, const RegionFilter& filter);

// ---- Implementation ---------------------------------------------------------------

constexpr void FirstMoments::add_run(int first, int end, int y) {
    const std::int64_t count = end - first;
    m00 += count;
    m10 += count * (first + end - 1) / 2;
    m01 += count * y;
}

constexpr void FirstMoments::add(const FirstMoments& other) {
    m00 += other.m00;
    m10 += other.m10;
    m01 += other.m01;
}

constexpr FinePoint FirstMoments::centroid() const {
    return {FinePixel::from_ratio(m10, m00), FinePixel::from_ratio(m01, m00)};
}

constexpr Result<Compactness> filter_region(std::int64_t area, Rectangle box, const RegionFilter& filter) {
    if (filter.area_min < 0 || filter.area_min > filter.area_max || filter.side_min < 0 ||
        filter.aspect_max.raw() < Ratio::one || filter.fill_min.raw() < 0 ||
        filter.fill_min.raw() > Ratio::one || box.empty())
        return Status::bad_argument;
    const std::int64_t longer = maximum(box.width, box.height);
    const std::int64_t shorter = minimum(box.width, box.height);
    // Sides are below 2^31 and ratios too, so that the first product fits 62 bits; areas take 128.
    const bool thin = longer * Ratio::one > shorter * filter.aspect_max.raw();
    const bool sparse =
        Int128::product(area, Ratio::one) < Int128::product(longer * shorter, filter.fill_min.raw());
    const bool wanted =
        area >= filter.area_min && area <= filter.area_max && shorter >= filter.side_min && !thin && !sparse;
    return wanted ? Compactness::compact : Compactness::not_compact;
}

}  // namespace fovea
