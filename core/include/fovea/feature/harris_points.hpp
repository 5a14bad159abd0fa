// SPDX-License-Identifier: MIT
//
// Corners of a picture as points, by Harris' response.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/feature/harris.hpp>
#include <fovea/feature/strongest.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A corner: the pixel, and its response, which is above zero.
struct HarrisPoint {
    Point place;
    std::int32_t response = 0;
};

/// What harris_points() takes for a corner.
struct HarrisPointOptions {
    /// Share of the strongest response that a point must have, 0..1. Lower finds weaker corners.
    Ratio quality = Ratio::from_ratio(1, 100);
    /// Two points are at least that many pixels apart, in a straight line; 0..32767.
    int min_distance = 5;
    /// How many of the strongest maxima compete for the distance, 1..65535. More cost 12 bytes each.
    int candidates = 1000;
};

inline namespace FOVEA_ISA {

/// Scratch bytes that harris_points() needs; 0 if it refuses the options.
constexpr std::int64_t harris_points_scratch(Size size, const HarrisPointOptions& options);

/// The corners of a picture, the strongest first. A corner is a maximum of harris_response() among its eight
/// neighbours that is above zero and reaches its share of the strongest; of two that are closer than the
/// distance the stronger one stays. A flat image has none: the list is empty.
///
/// Shapes    1x1 or larger
/// Units     pixels; response as harris_response()
/// Rounding  none: places are whole pixels
/// Border    of the picture as border says
/// Order     by response; of equal ones the higher, then the more left first. Of equal neighbours the first
///           is the maximum
/// Scratch   harris_points_scratch(src.size(), options) bytes, undefined afterwards: some rows and the
///           candidates, never a frame
/// Errors    empty_image; bad_argument; scratch_too_small; capacity_exceeded: points holds the strongest, or,
///           where the candidates were too few, those that are among them
/// Source    as harris_response(); the toolkit's CalculateHarrisInterestPoints compared no neighbours, found
///           80 corners on a flat image, and kept a square free where it spoke of a distance
inline Status harris_points(ImageView<const Gray8> src, const HarrisPointOptions& options, Border border,
                            Span<std::uint8_t> scratch, ListView<HarrisPoint> points);

// ---- Implementation ---------------------------------------------------------------

}  // namespace FOVEA_ISA

namespace detail {

constexpr bool is_valid(const HarrisPointOptions& options) {
    return options.quality.raw() >= 0 && options.quality.raw() <= Ratio::one && options.min_distance >= 0 &&
           options.min_distance <= max_image_side && options.candidates >= 1 && options.candidates <= 65535;
}

/// True if a comes behind b in the list.
struct WeakerHarrisPoint {
    constexpr bool operator()(const HarrisPoint& a, const HarrisPoint& b) const {
        if (a.response != b.response) return a.response < b.response;
        if (a.place.y != b.place.y) return a.place.y > b.place.y;
        return a.place.x > b.place.x;
    }
};

/// Gathers the maxima of rows of responses.
class HarrisMaxima {
public:
    HarrisMaxima(ListView<HarrisPoint> room, Ratio quality) : strongest_(room, {}), quality_(quality) {}

    /// Row y between its neighbours; null where the image ends.
    void take_row(const std::int32_t* above, const std::int32_t* here, const std::int32_t* below, int width,
                  int y) {
        for (int x = 0; x < width; ++x) {
            const std::int32_t response = here[x];
            // What is too weak for the strongest so far will be too weak for the strongest of all.
            if (response < least_) continue;
            if (response > highest_) {
                highest_ = response;
                least_ = least_of(highest_);
            }
            // Of equal neighbours the first is the maximum.
            if ((x > 0 && here[x - 1] >= response) || (x < width - 1 && here[x + 1] > response)) continue;
            if (exceeds(above, x, width, response - 1) || exceeds(below, x, width, response)) continue;
            strongest_.add({{x, y}, response});
        }
    }
    /// The least response that counts.
    std::int32_t least() const { return least_; }
    bool exceeded() const { return strongest_.status() != Status::ok; }

private:
    /// True if one of the three neighbours in a row is above level.
    static bool exceeds(const std::int32_t* row, int x, int width, std::int32_t level) {
        if (row == nullptr) return false;
        return row[x] > level || (x > 0 && row[x - 1] > level) || (x < width - 1 && row[x + 1] > level);
    }
    /// highest * quality, rounded up, and above zero.
    std::int32_t least_of(std::int32_t highest) const {
        const std::int64_t share = (std::int64_t{highest} * quality_.raw() + Ratio::one - 1) >> 16;
        return static_cast<std::int32_t>(maximum<std::int64_t>(share, 1));
    }

    Strongest<HarrisPoint, WeakerHarrisPoint> strongest_;
    Ratio quality_;
    std::int32_t highest_ = 0;
    std::int32_t least_ = 1;
};

/// True if one of the points is closer to place than distance.
inline bool is_near(Span<const HarrisPoint> points, Point place, int distance) {
    const std::int64_t least = std::int64_t{distance} * distance;
    for (const HarrisPoint& point : points) {
        const std::int64_t x = point.place.x - place.x;
        const std::int64_t y = point.place.y - place.y;
        if (x * x + y * y < least) return true;
    }
    return false;
}

}  // namespace detail

inline namespace FOVEA_ISA {

constexpr std::int64_t harris_points_scratch(Size size, const HarrisPointOptions& options) {
    if (!detail::is_valid(options)) return 0;
    return arena_bytes<HarrisPoint>(options.candidates) +
           arena_bytes<std::int32_t>(3 * std::int64_t{size.width}) + size.width +
           kernels::HarrisRow::scratch(size.width);
}

inline Status harris_points(ImageView<const Gray8> src, const HarrisPointOptions& options, Border border,
                            Span<std::uint8_t> scratch, ListView<HarrisPoint> points) {
    if (src.empty()) return Status::empty_image;
    if (!detail::is_valid(options)) return Status::bad_argument;
    if (scratch.size() < harris_points_scratch(src.size(), options)) return Status::scratch_too_small;

    const int width = src.width();
    const int last = src.height() - 1;
    Arena arena(scratch);
    int count = 0;
    const ListView<HarrisPoint> room(arena.take<HarrisPoint>(options.candidates).data(), options.candidates,
                                     &count);
    std::int32_t* const rows = arena.take<std::int32_t>(3 * std::ptrdiff_t{width}).data();
    const auto row = [&](int y) { return rows + std::ptrdiff_t{y % 3} * width; };
    const Gray8* zeros = arena.take<Gray8>(width).data();
    kernels::HarrisRow kernel(border, arena.rest(), width);
    detail::HarrisMaxima maxima(room, options.quality);
    for (int y = 0; y <= last + 1; ++y) {
        if (y <= last)
            for_each_row(src, border, y, y, kernel, ImageView<Response32>(row(y), {width, 1}, 0), zeros);
        if (y > 0)
            maxima.take_row(y > 1 ? row(y - 2) : nullptr, row(y - 1), y <= last ? row(y) : nullptr, width,
                            y - 1);
    }

    points.clear();
    sort(room.span(),
         [](const HarrisPoint& a, const HarrisPoint& b) { return detail::WeakerHarrisPoint()(b, a); });
    for (const HarrisPoint& point : room) {
        if (point.response < maxima.least()) return Status::ok;
        if (detail::is_near(points.span(), point.place, options.min_distance)) continue;
        if (points.push(point) != Status::ok) return Status::capacity_exceeded;
    }
    return maxima.exceeded() ? Status::capacity_exceeded : Status::ok;
}

}  // namespace FOVEA_ISA
}  // namespace fovea
