// SPDX-License-Identifier: MIT
//
// The options of hough_circles(), and its first stage: where gradients meet.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/feature/canny_points.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What a circle is beside its surroundings.
enum class CircleTone : std::uint8_t { any, bright, dark };

struct HoughCircleOptions {
    int min_radius = 10;   ///< px, 2 or more
    int max_radius = 100;  ///< px, up to 8192; a narrow range is quicker and finds less by chance
    int cell = 3;          ///< side of a cell for centres, 1..16 px: larger is quicker and takes less scratch
    int min_votes = 40;    ///< points of a circle, 1 or more
    Ratio min_share = Ratio::from_ratio(1, 4);  ///< of its circumference; 0 for any arc
    int min_distance = 10;                      ///< px from a centre to the next, in x or in y
    int max_misses = 16;  ///< places in a row without a circle that end the search, 1 or more
    Angle window =
        Angle::from_degrees(10);  ///< how far a gradient may turn from its radius, below 90 degrees
    CircleTone tone = CircleTone::any;
};

// ---- Implementation ---------------------------------------------------------------

namespace detail {

constexpr bool allowed(const HoughCircleOptions& o) {
    return o.min_radius >= 2 && o.max_radius >= o.min_radius && o.max_radius <= 8192 && o.cell >= 1 &&
           o.cell <= 16 && o.min_votes >= 1 && o.min_share >= Ratio() && o.min_distance >= 0 &&
           o.min_distance <= max_image_side && o.max_misses >= 1 && o.window.raw() < 0x4000;
}

/// Counters for centres. The centre of cell (0, 0) is that of pixel (0, 0).
class CentreVotes {
public:
    static constexpr std::int64_t scratch(Size size, const HoughCircleOptions& options) {
        const Size cells = cells_of(size, options);
        return arena_bytes<std::uint16_t>(cells.area()) + arena_bytes<std::uint16_t>(cells.width) +
               arena_bytes<std::uint32_t>(cells.width) + arena_bytes<RowBest>(cells.height);
    }

    CentreVotes(Size size, const HoughCircleOptions& options, Arena& arena)
        : options_(options),
          cells_(cells_of(size, options)),
          cells_per_pixel_(round_divide(std::int64_t{1} << 22, std::int64_t{options.cell})),
          sums_(arena.take<std::uint32_t>(cells_.width)),
          best_(arena.take<RowBest>(cells_.height)),
          above_(arena.take<std::uint16_t>(cells_.width)),
          counters_(arena.take<std::uint16_t>(static_cast<std::ptrdiff_t>(cells_.area()))) {}

    /// A vote a cell's side along the gradient, on one side or on both.
    void add(const EdgePoint& point) {
        const UnitVector way = unit_vector(point.gradient);
        if (options_.tone != CircleTone::dark) add_ray(point.place, way.x.raw(), way.y.raw());
        if (options_.tone != CircleTone::bright) add_ray(point.place, -way.x.raw(), -way.y.raw());
    }
    /// Every counter becomes the sum of 3x3, since directions are not quite true.
    void gather() {
        const int width = cells_.width;
        for (int y = 0; y < cells_.height; ++y) {
            std::uint16_t* const here = row_of(y);
            const std::uint16_t* const below = y + 1 < cells_.height ? row_of(y + 1) : nullptr;
            for (int x = 0; x < width; ++x) {
                sums_[x] = std::uint32_t{above_[x]} + here[x] + (below != nullptr ? below[x] : 0u);
                above_[x] = here[x];
            }
            for (int x = 0; x < width; ++x) {
                const std::uint32_t sum =
                    sums_[x] + (x > 0 ? sums_[x - 1] : 0u) + (x + 1 < width ? sums_[x + 1] : 0u);
                here[x] = static_cast<std::uint16_t>(minimum<std::uint32_t>(sum, 65535));
            }
            find_best(y);
        }
    }
    /// The cell with most votes; of equal ones the highest, then the most left.
    Point best() const {
        int y = 0;
        for (int i = 1; i < cells_.height; ++i)
            if (best_[i].votes > best_[y].votes) y = i;
        return {best_[y].x, y};
    }
    int votes(Point cell) const { return best_[cell.y].votes; }
    /// The middle of the votes in 3x3 cells, above the lowest of them.
    SubPixelPoint place(Point cell) const {
        const int left = maximum(cell.x - 1, 0);
        const int right = minimum(cell.x + 1, cells_.width - 1);
        const int top = maximum(cell.y - 1, 0);
        const int bottom = minimum(cell.y + 1, cells_.height - 1);
        int lowest = 65535;
        for (int y = top; y <= bottom; ++y)
            for (int x = left; x <= right; ++x) lowest = minimum<int>(lowest, row_of(y)[x]);
        std::int64_t sum = 0;
        std::int64_t sum_x = 0;
        std::int64_t sum_y = 0;
        for (int y = top; y <= bottom; ++y)
            for (int x = left; x <= right; ++x) {
                const int votes = row_of(y)[x] - lowest;
                sum += votes;
                sum_x += votes * (x - cell.x);
                sum_y += votes * (y - cell.y);
            }
        const std::int64_t unit = std::int64_t{options_.cell} * SubPixel::one;
        const auto along = [&](int from, std::int64_t moment) {
            const std::int64_t shift = sum > 0 ? round_divide(moment * unit, sum) : 0;
            return SubPixel::from_raw(static_cast<std::int32_t>(from * unit + shift));
        };
        return {along(cell.x, sum_x), along(cell.y, sum_y)};
    }
    /// No second centre within reach cells.
    void strike_out(Point cell, int reach) {
        const int left = maximum(cell.x - reach, 0);
        const int right = minimum(cell.x + reach, cells_.width - 1);
        for (int y = maximum(cell.y - reach, 0); y <= minimum(cell.y + reach, cells_.height - 1); ++y) {
            for (int x = left; x <= right; ++x) row_of(y)[x] = 0;
            if (best_[y].x >= left && best_[y].x <= right) find_best(y);
        }
    }

private:
    /// The highest counter of a row, the first of equal ones.
    struct RowBest {
        std::uint16_t votes = 0;
        std::uint16_t x = 0;
    };
    static constexpr Size cells_of(Size size, const HoughCircleOptions& options) {
        return {(size.width - 1) / options.cell + 2, (size.height - 1) / options.cell + 2};
    }
    std::uint16_t* row_of(int y) { return counters_.data() + static_cast<std::ptrdiff_t>(y) * cells_.width; }
    const std::uint16_t* row_of(int y) const {
        return counters_.data() + static_cast<std::ptrdiff_t>(y) * cells_.width;
    }
    void find_best(int y) {
        const std::uint16_t* row = row_of(y);
        std::uint16_t votes = 0;
        for (int x = 0; x < cells_.width; ++x) votes = maximum(votes, row[x]);
        int x = 0;
        while (row[x] != votes) ++x;
        best_[y] = {votes, static_cast<std::uint16_t>(x)};
    }
    /// From the smallest radius on; x and y of a unit vector in 2^-30. The point lies in the image.
    void add_ray(SubPixelPoint from, std::int64_t x, std::int64_t y) {
        // Cells in 2^-14, half a cell on, so that the whole part is the nearest one. Below 2^30: 2^15 cells
        // of the image and 2^13 of a radius.
        const auto step_x = static_cast<std::int32_t>(round_shift(x, 16));
        const auto step_y = static_cast<std::int32_t>(round_shift(y, 16));
        // The place of the smallest radius in 2^-8 px, below 2^24, then in cells.
        const auto start = [&](std::int32_t place, std::int64_t direction) {
            const std::int64_t along = place + round_shift(direction * options_.min_radius, 22);
            return static_cast<std::int32_t>(round_shift(along * cells_per_pixel_, 16)) + 8192;
        };
        std::int32_t u = start(from.x.raw(), x);
        std::int32_t v = start(from.y.raw(), y);
        const auto width = static_cast<std::uint32_t>(cells_.width);
        const auto height = static_cast<std::uint32_t>(cells_.height);
        std::uint16_t* const counters = counters_.data();
        const int steps = (options_.max_radius - options_.min_radius) / options_.cell + 1;
        for (int i = 0; i < steps; ++i, u += step_x, v += step_y) {
            const auto column = static_cast<std::uint32_t>(u >> 14);
            const auto row = static_cast<std::uint32_t>(v >> 14);
            // What has left the image does not come back.
            if (column >= width || row >= height) return;
            std::uint16_t& counter = counters[static_cast<std::size_t>(row) * width + column];
            counter = static_cast<std::uint16_t>(counter + (counter != 65535 ? 1 : 0));
        }
    }

    const HoughCircleOptions& options_;
    Size cells_;
    std::int64_t cells_per_pixel_;  ///< in 2^-22
    Span<std::uint32_t> sums_;
    Span<RowBest> best_;
    Span<std::uint16_t> above_;
    Span<std::uint16_t> counters_;
};

}  // namespace detail

}  // namespace fovea
