// SPDX-License-Identifier: MIT
//
// Circles through the points of an edge, by the Hough transform in two stages: centres, then radii. Book
// sec. 2.8.4.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/feature/canny_points.hpp>
#include <fovea/feature/circle_centres.hpp>
#include <fovea/feature/strongest.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

struct HoughCircle {
    SubPixelPoint centre;
    SubPixel radius;
    int votes = 0;  ///< points within 1 px of the circle whose gradient points at the centre or away from it
    Ratio share;    ///< votes by circumference; a whole circle gives 0.8 to 1.2 with the points of canny()
};

/// Scratch bytes that hough_circles() needs for so many points; 0 if it refuses the size or the options.
constexpr std::int64_t hough_circles_scratch(Size size, std::int64_t points,
                                             const HoughCircleOptions& options);

/// Circles whose centres are in an image of the size, the one with most votes first. Every point votes for
/// the centres that lie in the direction of its gradient, or against it, at the distances of the radii. At
/// the places with most votes the distances of the points are counted; where enough agree, centre and radius
/// are fitted to those once. Circles about one centre are all found.
///
/// Shapes    1x1 or larger
/// Units     pixels; cells of the options
/// Rounding  centre and radius to 1/256 px; within 0.15 px of the truth where a clean circle is seen whole.
///           measure/fit_circle.hpp makes more of the points
/// Order     by votes; of equal ones the higher, then the more left, then the smaller circle first
/// Scratch   hough_circles_scratch(size, points.size(), options) bytes, undefined afterwards: a 16-bit
///           counter a cell, a byte a point
/// Cost      points * (max_radius - min_radius) / cell votes, and some looks at all points for every circle
///           and every miss
/// Errors    empty_image; image_too_large above max_image_side; bad_argument; scratch_too_small;
///           capacity_exceeded: circles holds the strongest
/// Source    book sec. 2.8.4; Davies, Machine Vision, for the two stages. The toolkit counted in three
///           dimensions, 104 MB at 640x480 for radii of 10 to 100, and its suppression tested the wrong
///           coordinate and could write outside
inline Status hough_circles(Span<const EdgePoint> points, Size size, const HoughCircleOptions& options,
                            Span<std::uint8_t> scratch, ListView<HoughCircle> circles);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A cosine and a sine in 2^-14.
struct CoarseDirection {
    std::int16_t x = 0;
    std::int16_t y = 0;
};
/// To 0.7 degrees, which is little beside the window.
inline constexpr int coarse_directions = 256;

/// What the points say about circles around a place.
class RadiusVotes {
public:
    static constexpr std::int64_t scratch(std::int64_t points, const HoughCircleOptions& options) {
        return arena_bytes<CoarseDirection>(coarse_directions) + arena_bytes<std::uint16_t>(bins(options)) +
               arena_bytes<std::uint8_t>(points);
    }

    /// Points outside the image do not count.
    RadiusVotes(Span<const EdgePoint> points, Size size, const HoughCircleOptions& options, Arena& arena)
        : points_(points),
          options_(options),
          directions_(arena.take<CoarseDirection>(coarse_directions)),
          votes_(arena.take<std::uint16_t>(bins(options))),
          taken_(arena.take<std::uint8_t>(points.size())) {
        for (int i = 0; i < coarse_directions; ++i) {
            const UnitVector way = unit_vector(FineAngle::from_raw(static_cast<std::uint32_t>(i) << 24));
            directions_[i] = {static_cast<std::int16_t>(round_shift(way.x.raw(), 16)),
                              static_cast<std::int16_t>(round_shift(way.y.raw(), 16))};
        }
        std::int32_t lowest = 0;
        for (std::ptrdiff_t i = 0; i < points_.size(); ++i) {
            const SubPixelPoint place = points_[i].place;
            const bool inside = place.x.raw() >= 0 && place.y.raw() >= 0 &&
                                place.x.raw() <= (size.width - 1) * SubPixel::one &&
                                place.y.raw() <= (size.height - 1) * SubPixel::one;
            taken_[i] = inside ? 0 : 1;
            in_rows_ = in_rows_ && place.y.raw() >= lowest - row_slack;
            lowest = maximum(lowest, place.y.raw());
        }
        // Both sides in 2^-14; the window ends before a quarter of a turn.
        const UnitVector edge = unit_vector(options.window);
        window_cosine_ = round_shift(edge.x.raw(), 16);
        window_sine_ = round_shift(edge.y.raw(), 16);
    }

    bool is_free(std::ptrdiff_t number) const { return taken_[number] == 0; }
    /// Counts the radii around a centre.
    void count(SubPixelPoint centre) {
        for (std::uint16_t& votes : votes_) votes = 0;
        const int longest = options_.max_radius * SubPixel::one + SubPixel::one;
        const int shortest = options_.min_radius * SubPixel::one - SubPixel::one;
        for_each_member(centre, shortest, longest,
                        [&](std::ptrdiff_t, std::int64_t, std::int64_t, int distance) {
                            std::uint16_t& votes = votes_[round_shift(distance, 8) - options_.min_radius + 1];
                            if (votes != 65535) ++votes;
                        });
    }
    /// The radius with most votes, its neighbours' added: min_radius + the index; negative if they are below
    /// min_votes. Of equal ones the smaller.
    int best() const {
        int found = -1;
        int most = options_.min_votes - 1;
        for (int i = 1; i + 1 < votes_.size(); ++i) {
            const int votes = votes_[i - 1] + votes_[i] + votes_[i + 1];
            if (votes <= most) continue;
            most = votes;
            found = i - 1;
        }
        return found;
    }
    void strike_out(int index) {
        const int last = minimum(index + 1 + 3, static_cast<int>(votes_.size()) - 1);
        for (int i = maximum(index + 1 - 3, 0); i <= last; ++i) votes_[i] = 0;
    }
    /// The circle that fits the points about a radius best, seen from a centre that is nearly right.
    HoughCircle fitted(SubPixelPoint centre, int radius) const {
        const int about = radius * SubPixel::one;
        std::int64_t count = 0, sum_x = 0, sum_y = 0, xx = 0, xy = 0, yy = 0, sum_d = 0, xd = 0, yd = 0;
        for_each_member(centre, about - 3 * SubPixel::one / 2, about + 3 * SubPixel::one / 2,
                        [&](std::ptrdiff_t, std::int64_t x, std::int64_t y, int distance) {
                            // The unit vector in 2^-12, the distance less the radius in 2^-8.
                            const std::int64_t u = round_divide(x * 4096, std::int64_t{distance});
                            const std::int64_t v = round_divide(y * 4096, std::int64_t{distance});
                            const std::int64_t d = distance - about;
                            ++count;
                            sum_x += u;
                            sum_y += v;
                            sum_d += d;
                            xx += u * u;
                            xy += u * v;
                            yy += v * v;
                            xd += u * d;
                            yd += v * d;
                        });
        HoughCircle circle{centre, SubPixel::from_raw(about), 0, Ratio()};
        if (count > 0) {
            const auto covariance = [&](std::int64_t product, std::int64_t a, std::int64_t b) {
                return round_divide(product, count) - round_divide(a, count) * round_divide(b, count);
            };
            // At most 2^24, and 2^21 for those with a distance.
            const std::int64_t cxx = covariance(xx, sum_x, sum_x);
            const std::int64_t cxy = covariance(xy, sum_x, sum_y);
            const std::int64_t cyy = covariance(yy, sum_y, sum_y);
            const std::int64_t cxd = covariance(xd, sum_x, sum_d);
            const std::int64_t cyd = covariance(yd, sum_y, sum_d);
            const std::int64_t determinant = cxx * cyy - cxy * cxy;
            std::int64_t x = 0;
            std::int64_t y = 0;
            // An arc says the less about its centre the shorter it is: a quarter has a 180th of what the
            // whole circle has, 2^46.
            if (determinant > std::int64_t{1} << 38) {
                const std::int64_t most = 2 * options_.cell * SubPixel::one;
                x = clamp(round_divide((cyy * cxd - cxy * cyd) * 4096, determinant), -most, most);
                y = clamp(round_divide((cxx * cyd - cxy * cxd) * 4096, determinant), -most, most);
            }
            const std::int64_t along = round_divide(sum_x * x + sum_y * y, count * 4096);
            circle.centre = {centre.x + SubPixel::from_raw(static_cast<std::int32_t>(x)),
                             centre.y + SubPixel::from_raw(static_cast<std::int32_t>(y))};
            circle.radius =
                SubPixel::from_raw(static_cast<std::int32_t>(about + round_divide(sum_d, count) - along));
        }
        count = 0;
        for_each_member(circle.centre, circle.radius.raw() - SubPixel::one,
                        circle.radius.raw() + SubPixel::one,
                        [&](std::ptrdiff_t, std::int64_t, std::int64_t, int) { ++count; });
        circle.votes = static_cast<int>(count);
        // A turn is 411775 / 65536; 2^16 of a share and 2^8 of the radius.
        circle.share = Ratio::from_raw(saturate_cast<std::int32_t>(
            round_divide(count << 40, std::int64_t{411775} * maximum<std::int32_t>(circle.radius.raw(), 1))));
        return circle;
    }
    /// The points of a circle count no more.
    void take(const HoughCircle& circle) {
        for_each_member(circle.centre, circle.radius.raw() - 2 * SubPixel::one,
                        circle.radius.raw() + 2 * SubPixel::one,
                        [&](std::ptrdiff_t i, std::int64_t, std::int64_t, int) { taken_[i] = 1; });
    }

private:
    static constexpr int bins(const HoughCircleOptions& options) {
        return options.max_radius - options.min_radius + 3;
    }
    /// visit(number, x, y, distance) for every free point between two distances whose gradient runs along its
    /// radius: the vector from the centre, and its length, in 2^-8.
    template <class Visit>
    void for_each_member(SubPixelPoint centre, int shortest, int longest, Visit visit) const {
        if (longest <= 0) return;
        const std::int64_t least = shortest > 0 ? std::int64_t{shortest} * shortest : 1;
        const std::int64_t most = std::int64_t{longest} * longest;
        const std::ptrdiff_t end = first_below(centre.y.raw() + longest);
        for (std::ptrdiff_t i = first_from(centre.y.raw() - longest); i < end; ++i) {
            if (taken_[i] != 0) continue;
            const EdgePoint& point = points_[i];
            // Below 2^24, for the place lies in the image and the centre is near it.
            const std::int64_t x = std::int64_t{point.place.x.raw()} - centre.x.raw();
            const std::int64_t y = std::int64_t{point.place.y.raw()} - centre.y.raw();
            const std::int64_t square = x * x + y * y;
            if (square < least || square >= most) continue;
            const CoarseDirection way =
                directions_[static_cast<std::uint8_t>((point.gradient.raw() + 128) >> 8)];
            const std::int64_t outwards = x * way.x + y * way.y;
            const std::int64_t beside = x * way.y - y * way.x;
            if (maximum(beside, -beside) * window_cosine_ > maximum(outwards, -outwards) * window_sine_)
                continue;
            if (options_.tone == CircleTone::bright && outwards > 0) continue;
            if (options_.tone == CircleTone::dark && outwards < 0) continue;
            visit(i, x, y, static_cast<int>(isqrt(static_cast<std::uint64_t>(square))));
        }
    }

    /// The points of canny_points() come row by row, but for what a place is off its pixel. No point is
    /// higher than one before it by more than the slack, so whatever comes before one that is higher than y
    /// by the slack is higher than y, and whatever comes behind one that is as much lower is lower.
    static constexpr std::int32_t row_slack = SubPixel::one;
    /// No point before it is at y or lower.
    std::ptrdiff_t first_from(std::int32_t y) const {
        std::ptrdiff_t first = 0;
        for (std::ptrdiff_t end = in_rows_ ? points_.size() : 0; first < end;) {
            const std::ptrdiff_t middle = first + (end - first) / 2;
            if (points_[middle].place.y.raw() < y - row_slack)
                first = middle + 1;
            else
                end = middle;
        }
        return first;
    }
    /// No point from it on is at y or higher.
    std::ptrdiff_t first_below(std::int32_t y) const {
        std::ptrdiff_t end = points_.size();
        for (std::ptrdiff_t first = in_rows_ ? 0 : end; first < end;) {
            const std::ptrdiff_t middle = first + (end - first) / 2;
            if (points_[middle].place.y.raw() > y + row_slack)
                end = middle;
            else
                first = middle + 1;
        }
        return end;
    }

    Span<const EdgePoint> points_;
    const HoughCircleOptions& options_;
    Span<CoarseDirection> directions_;
    Span<std::uint16_t> votes_;
    Span<std::uint8_t> taken_;
    std::int32_t window_cosine_ = 0;
    std::int32_t window_sine_ = 0;
    bool in_rows_ = true;
};

/// Whether a is to leave a full list before b.
constexpr bool weaker_circle(const HoughCircle& a, const HoughCircle& b) {
    if (a.votes != b.votes) return a.votes < b.votes;
    if (a.centre.y != b.centre.y) return a.centre.y > b.centre.y;
    if (a.centre.x != b.centre.x) return a.centre.x > b.centre.x;
    return a.radius > b.radius;
}

}  // namespace detail

constexpr std::int64_t hough_circles_scratch(Size size, std::int64_t points,
                                             const HoughCircleOptions& options) {
    if (size.empty() || size.width > max_image_side || size.height > max_image_side ||
        !detail::allowed(options))
        return 0;
    return detail::CentreVotes::scratch(size, options) + detail::RadiusVotes::scratch(points, options);
}

inline Status hough_circles(Span<const EdgePoint> points, Size size, const HoughCircleOptions& options,
                            Span<std::uint8_t> scratch, ListView<HoughCircle> circles) {
    if (size.empty()) return Status::empty_image;
    if (size.width > max_image_side || size.height > max_image_side) return Status::image_too_large;
    if (!detail::allowed(options)) return Status::bad_argument;
    if (scratch.size() < hough_circles_scratch(size, points.size(), options))
        return Status::scratch_too_small;

    Arena arena(scratch);
    detail::RadiusVotes radii(points, size, options, arena);
    detail::CentreVotes centres(size, options, arena);
    for (std::ptrdiff_t i = 0; i < points.size(); ++i)
        if (radii.is_free(i)) centres.add(points[i]);
    centres.gather();
    detail::Strongest strongest(circles, detail::weaker_circle);
    for (int misses = 0; misses < options.max_misses;) {
        const Point cell = centres.best();
        // A ray that meets a centre votes in two of the 3x3 cells about it at least.
        if (centres.votes(cell) < 2 * std::int64_t{options.min_votes}) break;
        const SubPixelPoint centre = centres.place(cell);
        bool found = false;
        radii.count(centre);
        for (int index = radii.best(); index >= 0; index = radii.best()) {
            radii.strike_out(index);
            const HoughCircle circle = radii.fitted(centre, options.min_radius + index);
            if (circle.votes < options.min_votes || circle.share < options.min_share) continue;
            strongest.add(circle);
            radii.take(circle);
            found = true;
        }
        misses = found ? 0 : misses + 1;
        centres.strike_out(cell, found ? maximum(options.min_distance / options.cell, 1) : 1);
    }
    sort(circles.span(),
         [](const HoughCircle& a, const HoughCircle& b) { return detail::weaker_circle(b, a); });
    return strongest.status();
}

}  // namespace fovea
