// SPDX-License-Identifier: MIT
//
// Spots that may be circles of a board: regions with the shape of an ellipse, and their centres.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/camera/board_lattice.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/statistics/moments.hpp>

namespace fovea {

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// An ellipse: its centre in 1/256 px, and the second moments of its area, four times the variances in 1/256
/// square pixels, so that it is all d with d' M^-1 d up to 1.
struct CircleSpot {
    BoardVector centre;
    std::int64_t area = 0;  ///< pixels
    std::int64_t xx = 0, xy = 0, yy = 0;
};

/// The spot of a region that is an ellipse: its area is that of the ellipse with its moments to a quarter,
/// and one axis is at most six times the other.
///
/// Errors  not_found for other shapes
inline Result<CircleSpot> circle_spot(const Region& region) {
    if (region.at_border) return Status::not_found;
    const Result<CentralMoments> moments = central_moments(region.moments);
    if (!moments) return moments.status();
    CircleSpot spot;
    spot.area = moments->area;
    spot.centre =
        board_vector({moments->centroid.x.convert<SubPixel>(), moments->centroid.y.convert<SubPixel>()});
    // A pixel has a variance of its own, 1/12.
    spot.xx = 4 * (moments->mu20.raw() / spot.area) + 85;
    spot.xy = 4 * (moments->mu11.raw() / spot.area);
    spot.yy = 4 * (moments->mu02.raw() / spot.area) + 85;
    const std::int64_t size = spot.xx * spot.yy - spot.xy * spot.xy;
    const std::int64_t sum = spot.xx + spot.yy;
    if (size <= 0 || 37 * 37 * size < 36 * sum * sum) return Status::not_found;
    // pi times both half-axes, in 1/256 px^2.
    const std::int64_t ellipse = isqrt(static_cast<std::uint64_t>(size)) * std::int64_t{355} / 113;
    const std::int64_t off = 256 * spot.area - ellipse;
    // Of few pixels the area is not as certain.
    if ((off < 0 ? -off : off) > ellipse / 4 + 512) return Status::not_found;
    return spot;
}

/// The centre of a spot by the brightness of the image: pixels count by how far they are from the ground
/// towards the spot, from a quarter of the way on and fully from three quarters on, so that uneven light
/// does not count. One step; repeat from where it leads.
///
/// Errors  not_found where there is no step of least_contrast from the ground to the spot
inline Result<BoardVector> spot_centre(ImageView<const Gray8> src, const CircleSpot& spot, bool bright,
                                       int least_contrast) {
    // Moments of 16 bits, of distances in 1/16 px: products stay below 2^46.
    int drop = 0;
    while (maximum(spot.xx, spot.yy) >> drop >= 1 << 16) ++drop;
    const std::int64_t xx = spot.xx >> drop;
    const std::int64_t xy = spot.xy >> drop;
    const std::int64_t yy = spot.yy >> drop;
    const std::int64_t size = xx * yy - xy * xy;
    if (size <= 0) return Status::not_found;
    // What distance() is where d' M^-1 d is so many 1/256; that is below 2^12, and drop below 13.
    const auto limit = [&](std::int64_t share) { return (share * size * (std::int64_t{1} << drop)) >> 8; };
    const auto distance = [&](std::int64_t dx, std::int64_t dy) {
        return yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy;
    };
    // The ring outside: half as wide again as the spot, and a pixel and a half more for blur.
    const std::int64_t least = maximum<std::int64_t>(minimum(spot.xx, spot.yy), 256);
    const int thin = static_cast<int>(isqrt(static_cast<std::uint64_t>(least * 256)));
    const std::int64_t share = 333 + 384 * 256 / maximum(thin, 256);
    const std::int64_t core = limit(64);
    const std::int64_t inner = limit(share * share / 256);
    const std::int64_t outer = limit((share + 64) * (share + 64) / 256);
    const auto reach = [&](std::int64_t moment) {
        return static_cast<int>((isqrt(static_cast<std::uint64_t>(moment * 256)) * (share + 64) / 256 + 255) /
                                256);
    };
    const int half_x = reach(spot.xx);
    const int half_y = reach(spot.yy);
    const int x = round_shift(spot.centre.x, 8);
    const int y = round_shift(spot.centre.y, 8);
    const int left = maximum(x - half_x, 0);
    const int right = minimum(x + half_x, src.width() - 1);
    const int top = maximum(y - half_y, 0);
    const int bottom = minimum(y + half_y, src.height() - 1);

    const auto for_each = [&](auto take) {
        for (int row = top; row <= bottom; ++row)
            for (int column = left; column <= right; ++column) {
                const std::int64_t d =
                    distance((column * 256 - spot.centre.x) >> 4, (row * 256 - spot.centre.y) >> 4);
                if (d <= outer) take(column, row, d);
            }
    };
    std::int64_t ground = 0, ground_count = 0, middle = 0, middle_count = 0;
    for_each([&](int column, int row, std::int64_t d) {
        if (d > inner) {
            ground += src(column, row);
            ++ground_count;
        } else if (d < core) {
            middle += src(column, row);
            ++middle_count;
        }
    });
    if (ground_count == 0 || middle_count == 0) return Status::not_found;
    const std::int64_t base = ground * 256 / ground_count;
    const std::int64_t step = middle * 256 / middle_count - base;
    if ((bright ? step : -step) < least_contrast * 256) return Status::not_found;
    const std::int64_t scale = (std::int64_t{1} << 25) / step;
    std::int64_t weights = 0, sum_x = 0, sum_y = 0;
    for_each([&](int column, int row, std::int64_t d) {
        if (d > inner) return;
        const std::int64_t part = (((src(column, row) * 256 - base) * scale) >> 16) - 128;
        const std::int64_t weight = clamp<std::int64_t>(part, 0, 256);
        weights += weight;
        sum_x += weight * (column - x);
        sum_y += weight * (row - y);
    });
    if (weights == 0) return Status::not_found;
    return BoardVector{x * 256 + static_cast<std::int32_t>(round_divide(sum_x * 256, weights)),
                       y * 256 + static_cast<std::int32_t>(round_divide(sum_y * 256, weights))};
}

}  // namespace detail

}  // namespace fovea
