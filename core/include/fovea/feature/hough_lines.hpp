// SPDX-License-Identifier: MIT
//
// Straight lines in an edge image, by the Hough transform. Book sec. 2.8.4.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/feature/canny_points.hpp>
#include <fovea/feature/edge_pixels.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// The points with x cos(theta) + y sin(theta) = distance.
struct PolarLine {
    FineAngle theta;    ///< direction of the normal, from 0 to just below half a turn
    SubPixel distance;  ///< from the centre of pixel (0, 0), negative against the normal
    int votes = 0;      ///< edge pixels that lie on the line
};

struct HoughLineOptions {
    int angles = 180;  ///< steps to half a turn, 2..4096; more separate lines better and need more scratch
    SubPixel distance_step = SubPixel::from_int(1);  ///< 1/4..16 px; wider joins what is not quite straight
    int min_votes = 50;                              ///< of a line, 1 or more
    int max_lines = 1000;                            ///< the strongest so many are wanted, 1 or more
    int suppressed_angles = 10;     ///< no second line within so many steps of an angle, 0..angles / 2,
    int suppressed_distances = 10;  ///< and within so many steps of distance, 0 or more
    Angle window =
        Angle::from_degrees(5);  ///< for directed points: how far a normal may be from the gradient
};

/// Scratch bytes that hough_lines() and hough_lines_directed() need; 0 if they refuse the size.
constexpr std::int64_t hough_lines_scratch(Size size, const HoughLineOptions& options);

/// Lines through the pixels of edges that are not 0, the strongest first. Every pixel votes for all lines
/// through it; the line with most votes is taken, its neighbours are struck out, and so on. Half a turn on,
/// the same lines follow with the other sign of distance, and are struck out as well.
///
/// Shapes    1x1 or larger
/// Units     steps of the options; distances are whole steps from the middle of the image
/// Rounding  nearest step; the position of a pixel is exact to 1/8 step in the largest image, 1/200 at
///           640x480
/// Order     by votes; of equal ones the lower angle, then the lower distance in the middle's measure
/// Scratch   hough_lines_scratch(edges.size(), options) bytes, undefined afterwards: 16-bit counters,
///           angles * diagonal / distance_step of them
/// Errors    empty_image; image_too_large where a line could have more than 65535 votes; bad_argument for
///           options out of range; scratch_too_small; capacity_exceeded: lines holds the strongest
/// Source    Duda and Hart, CACM 15(1), 1972; book sec. 2.8.4. The toolkit's function refused every gray
///           image, and struck out with the wrong sign beyond half a turn
inline Status hough_lines(ImageView<const Gray8> edges, const HoughLineOptions& options,
                          Span<std::uint8_t> scratch, ListView<PolarLine> lines);

/// The same from points with directions, in an image of the size: a point votes only for lines whose normal
/// is within the window of its gradient or against it. Faster by as much, and a crowd of pixels of other
/// directions makes no lines. All else as hough_lines(); points outside the image do not vote.
///
/// Source  the toolkit's directed form never told how many points a line had
inline Status hough_lines_directed(Span<const EdgePoint> points, Size size, const HoughLineOptions& options,
                                   Span<std::uint8_t> scratch, ListView<PolarLine> lines);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// The form of the counters of a size: rows of distances about the middle, which is bin half.
struct HoughGrid {
    int angles = 0;
    int half = 0;
    bool fits = false;

    constexpr HoughGrid(Size size, const HoughLineOptions& options) {
        const int step = options.distance_step.raw();
        if (size.empty() || size.width > max_image_side || size.height > max_image_side || !allowed(options))
            return;
        const std::int64_t reach =
            isqrt(static_cast<std::uint64_t>(std::int64_t{size.width / 2} * (size.width / 2) +
                                             std::int64_t{size.height / 2} * (size.height / 2))) +
            1;
        angles = options.angles;
        half = static_cast<int>(reach * SubPixel::one / step) + 1;
        // Pixels in a strip of step by 2 reach: in rows or columns, whichever cross it more steeply, step *
        // root of 2 + 1 in each of 2 reach / 1 + 1.
        const std::int64_t most =
            (2 * reach + 1) * (std::int64_t{step} * 3 / 2 + SubPixel::one) / SubPixel::one;
        fits = most <= 65535 && half <= 32766;
    }
    constexpr int distances() const { return 2 * half + 1; }
    constexpr std::int64_t bins() const { return std::int64_t{angles} * distances(); }

    static constexpr bool allowed(const HoughLineOptions& o) {
        return o.angles >= 2 && o.angles <= 4096 && o.distance_step.raw() >= SubPixel::one / 4 &&
               o.distance_step.raw() <= 16 * SubPixel::one && o.min_votes >= 1 && o.max_lines >= 1 &&
               o.suppressed_angles >= 0 && o.suppressed_angles <= o.angles / 2 &&
               o.suppressed_distances >= 0 && o.suppressed_distances <= max_image_side;
    }
};

/// Pixels that vote together: one row of counters after the other stays in the nearest cache.
inline constexpr int hough_crowd = 1024;

struct HoughPixel {
    std::int16_t x = 0;
    std::int16_t y = 0;
};
/// Cosine and sine by distance step, in 2^-16.
struct HoughDirection {
    std::int32_t cosine = 0;
    std::int32_t sine = 0;
};
/// The highest counter of a row, the first of equal ones.
struct HoughRowBest {
    std::uint16_t votes = 0;
    std::uint16_t bin = 0;
};

class HoughCounters {
public:
    static constexpr std::int64_t scratch(const HoughGrid& grid) {
        return arena_bytes<std::uint16_t>(grid.bins()) + arena_bytes<HoughDirection>(grid.angles) +
               arena_bytes<HoughRowBest>(grid.angles) + arena_bytes<HoughPixel>(hough_crowd);
    }

    HoughCounters(const HoughGrid& grid, Size size, const HoughLineOptions& options,
                  Span<std::uint8_t> scratch)
        : grid_(grid), options_(options), middle_{(size.width - 1) / 2, (size.height - 1) / 2} {
        Arena arena(scratch);
        directions_ = arena.take<HoughDirection>(grid.angles);
        best_ = arena.take<HoughRowBest>(grid.angles);
        crowd_ = arena.take<HoughPixel>(hough_crowd);
        counters_ = arena.take<std::uint16_t>(static_cast<std::ptrdiff_t>(grid.bins()));
        const std::int64_t divisor = std::int64_t{options.distance_step.raw()} << 14;
        for (int k = 0; k < grid.angles; ++k) {
            const UnitVector normal = unit_vector(theta(k));
            directions_[k] = {static_cast<std::int32_t>(
                                  round_divide(std::int64_t{normal.x.raw()} * SubPixel::one, divisor)),
                              static_cast<std::int32_t>(
                                  round_divide(std::int64_t{normal.y.raw()} * SubPixel::one, divisor))};
        }
    }

    /// A pixel votes for all angles.
    void add(int x, int y) {
        crowd_[crowded_++] = {static_cast<std::int16_t>(x - middle_.x),
                              static_cast<std::int16_t>(y - middle_.y)};
        if (crowded_ == hough_crowd) vote();
    }
    void vote() {
        const HoughPixel* const crowd = crowd_.data();
        const int count = crowded_;
        for (int k = 0; k < grid_.angles; ++k) {
            const HoughDirection way = directions_[k];
            std::uint16_t* const row = row_of(k) + grid_.half;
            // |x cosine + y sine| is at most half * 2^16, below 2^31.
            for (int i = 0; i < count; ++i)
                ++row[(crowd[i].x * way.cosine + crowd[i].y * way.sine + 32768) >> 16];
        }
        crowded_ = 0;
    }
    /// A point votes for the angles about its gradient. It lies in the image.
    void add(const EdgePoint& point) {
        const std::int64_t x = point.place.x.raw() - std::int64_t{middle_.x} * SubPixel::one;
        const std::int64_t y = point.place.y.raw() - std::int64_t{middle_.y} * SubPixel::one;
        const int towards = point.gradient.raw() & 0x7fff;
        const int window = minimum<int>(options_.window.raw(), 0x3fff);
        const int first = floor_divide((towards - window) * grid_.angles + 0x7fff, 0x8000);
        const int last = floor_divide((towards + window) * grid_.angles, 0x8000);
        for (int step = first; step <= last; ++step) {
            const int k = floor_modulo(step, grid_.angles);
            const std::int64_t place = x * directions_[k].cosine + y * directions_[k].sine;
            std::uint16_t& counter = row_of(k)[grid_.half + static_cast<int>(round_shift(place, 24))];
            // A caller may give more points than an image has pixels.
            if (counter != 65535) ++counter;
        }
    }

    Status take_lines(ListView<PolarLine> lines) {
        lines.clear();
        for (int k = 0; k < grid_.angles; ++k) find_best(k);
        while (lines.size() < options_.max_lines) {
            int k = 0;
            for (int i = 1; i < grid_.angles; ++i)
                if (best_[i].votes > best_[k].votes) k = i;
            if (best_[k].votes < options_.min_votes) break;
            if (lines.push(line(k, best_[k].bin, best_[k].votes)) != Status::ok)
                return Status::capacity_exceeded;
            strike_out(k, best_[k].bin);
        }
        return Status::ok;
    }

private:
    FineAngle theta(int k) const {
        return FineAngle::from_raw(
            static_cast<std::uint32_t>(round_divide(std::int64_t{k} << 31, std::int64_t{grid_.angles})));
    }
    std::uint16_t* row_of(int k) {
        return counters_.data() + static_cast<std::ptrdiff_t>(k) * grid_.distances();
    }
    PolarLine line(int k, int bin, int votes) const {
        const UnitVector normal = unit_vector(theta(k));
        const std::int64_t middle =
            std::int64_t{middle_.x} * normal.x.raw() + std::int64_t{middle_.y} * normal.y.raw();
        const auto from_middle = static_cast<std::int32_t>((bin - grid_.half) * options_.distance_step.raw());
        return {theta(k),
                SubPixel::from_raw(from_middle + static_cast<std::int32_t>(round_shift(middle, 22))), votes};
    }
    void find_best(int k) {
        const std::uint16_t* row = row_of(k);
        std::uint16_t votes = 0;
        for (int bin = 0; bin < grid_.distances(); ++bin) votes = maximum(votes, row[bin]);
        int bin = 0;
        while (row[bin] != votes) ++bin;
        best_[k] = {votes, static_cast<std::uint16_t>(bin)};
    }
    void strike_out(int k, int bin) {
        for (int step = k - options_.suppressed_angles; step <= k + options_.suppressed_angles; ++step) {
            const bool turned = step < 0 || step >= grid_.angles;
            const int there = turned ? 2 * grid_.half - bin : bin;
            const int row_number = floor_modulo(step, grid_.angles);
            const int first = maximum(there - options_.suppressed_distances, 0);
            const int last = minimum(there + options_.suppressed_distances, grid_.distances() - 1);
            std::uint16_t* row = row_of(row_number);
            for (int i = first; i <= last; ++i) row[i] = 0;
            const int best = best_[row_number].bin;
            if (best >= first && best <= last) find_best(row_number);
        }
    }

    HoughGrid grid_;
    const HoughLineOptions& options_;
    Point middle_;
    Span<std::uint16_t> counters_;
    Span<HoughDirection> directions_;
    Span<HoughRowBest> best_;
    Span<HoughPixel> crowd_;
    int crowded_ = 0;
};

/// What is wrong with a size, the options and the scratch.
inline Status hough_refusal(Size size, const HoughLineOptions& options, Span<std::uint8_t> scratch) {
    if (size.empty()) return Status::empty_image;
    const bool allowed = HoughGrid::allowed(options);
    const HoughGrid grid(size, options);
    if (allowed && !grid.fits) return Status::image_too_large;
    if (!allowed) return Status::bad_argument;
    if (scratch.size() < HoughCounters::scratch(grid)) return Status::scratch_too_small;
    return Status::ok;
}

}  // namespace detail

constexpr std::int64_t hough_lines_scratch(Size size, const HoughLineOptions& options) {
    const detail::HoughGrid grid(size, options);
    return grid.fits ? detail::HoughCounters::scratch(grid) : 0;
}

inline Status hough_lines(ImageView<const Gray8> edges, const HoughLineOptions& options,
                          Span<std::uint8_t> scratch, ListView<PolarLine> lines) {
    if (const Status s = detail::hough_refusal(edges.size(), options, scratch); s != Status::ok) return s;
    detail::HoughCounters counters(detail::HoughGrid(edges.size(), options), edges.size(), options, scratch);
    detail::for_each_edge(edges, [&](int x, int y) { counters.add(x, y); });
    counters.vote();
    return counters.take_lines(lines);
}

inline Status hough_lines_directed(Span<const EdgePoint> points, Size size, const HoughLineOptions& options,
                                   Span<std::uint8_t> scratch, ListView<PolarLine> lines) {
    if (const Status s = detail::hough_refusal(size, options, scratch); s != Status::ok) return s;
    detail::HoughCounters counters(detail::HoughGrid(size, options), size, options, scratch);
    for (const EdgePoint& point : points) {
        const std::int32_t x = point.place.x.raw();
        const std::int32_t y = point.place.y.raw();
        if (x >= 0 && y >= 0 && x <= (size.width - 1) * SubPixel::one &&
            y <= (size.height - 1) * SubPixel::one)
            counters.add(point);
    }
    return counters.take_lines(lines);
}

}  // namespace fovea
