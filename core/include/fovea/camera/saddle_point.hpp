// SPDX-License-Identifier: MIT
//
// Saddle points to a fraction of a pixel: where four squares of a checkerboard meet. Book sec. 2.10, the
// toolkit's CornerSubpixel.
#pragma once

#include <cstdint>

#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/real.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Radii that refine_saddle_point() takes.
inline constexpr SubPixel min_saddle_radius = SubPixel::from_int(2);
inline constexpr SubPixel max_saddle_radius = SubPixel::from_int(64);

/// The ellipse that a circle becomes on a board that is seen askew: all au + bv with a^2 + b^2 up to 1.
struct SaddleWindow {
    SubPixelPoint u;  ///< along one edge, as long as the window reaches
    SubPixelPoint v;  ///< along the other
};

/// The place around which the edges near start run: each gradient stands across the way from the place to its
/// pixel. Least squares over a disc, moved until it stands on the place itself.
///
/// Shapes    src 3x3 or larger; radius should end before the next parallel edges, which would pull
/// Units     1/256 px
/// Rounding  nearest; within a step of 1/1024 px of where the iteration leads, 20 steps at most
/// Border    the outermost pixels have no gradient and do not count
/// Time      the pixels of the disc, about 30 instructions each, in every step; three to five are usual
/// Errors    empty_image; bad_argument for a radius out of range; out_of_range for a start outside of the
///           image; degenerate where gradients have one direction or none; not_found if the place is farther
///           than half the radius from start, or does not come to rest
/// Source    Foerstner and Guelch, "A fast operator for detection and precise location of distinct points,
///           corners and centres of circular features", 1987; the toolkit's CornerSubpixel::Refine and OpenCV's
///           cornerSubPix sample a square at fractions of pixels, with weights that do not end at 0. Here
///           pixels count as they are, and a weight (1 - (distance / radius)^2)^2 moves with the place, so
///           that nothing jumps where pixels enter
inline Result<SubPixelPoint> refine_saddle_point(ImageView<const Gray8> src, SubPixelPoint start,
                                                 SubPixel radius);

/// The same in a window that follows the board: more pixels where squares are seen askew.
///
/// Shapes    u and v as long as radii may be; by the way to the other, 1 px or more wide
/// Errors    also bad_argument for ways that are too long, short, or almost parallel. Half the shorter one
///           is how far the place may be from start
inline Result<SubPixelPoint> refine_saddle_point(ImageView<const Gray8> src, SubPixelPoint start,
                                                 const SaddleWindow& window);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Sums of gradients in a disc, weighed; with distances in 1/2048 px. Largest: gradients of 12 * 255, weights
/// that are 2^10 in the middle and a third of it in the mean, distances of 2^17, 2^13.7 pixels make 2^62.3.
struct SaddleSums {
    std::int64_t xx = 0, xy = 0, yy = 0;
    std::int64_t x = 0, y = 0;
};

/// Gradients along a row, each of 5 by 3 pixels: a difference of two pixels after a mean of 1 2 1 by 1 2 1.
/// The mean keeps what is sharper than pixels can show from pulling to their centres.
class SaddleGradients {
public:
    /// From pixel x - 1 on, for next() to give that of x.
    SaddleGradients(ImageView<const Gray8> src, int y, int x)
        : rows_{src.row(y - 2), src.row(y - 1), src.row(y), src.row(y + 1), src.row(y + 2)}, x_(x + 2) {
        for (int k = 0; k < 4; ++k) {
            means_[k + 1] = mean(x - 2 + k);
            steps_[k + 1] = step(x - 2 + k);
        }
    }
    void next(int& gx, int& gy) {
        for (int k = 0; k < 4; ++k) {
            means_[k] = means_[k + 1];
            steps_[k] = steps_[k + 1];
        }
        means_[4] = mean(x_);
        steps_[4] = step(x_);
        ++x_;
        gx = means_[4] + 2 * (means_[3] - means_[1]) - means_[0];
        gy = steps_[1] + 2 * steps_[2] + steps_[3];
    }

private:
    int mean(int x) const { return rows_[1][x] + 2 * rows_[2][x] + rows_[3][x]; }
    int step(int x) const { return rows_[4][x] + 2 * (rows_[3][x] - rows_[1][x]) - rows_[0][x]; }

    const Gray8* rows_[5];
    int x_;
    int means_[5] = {};
    int steps_[5] = {};
};

/// A SaddleWindow as it is asked for each pixel.
class SaddleWeights {
public:
    explicit SaddleWeights(const SaddleWindow& w)
        : half_width_(static_cast<std::int32_t>(hypotenuse(w.u.x.raw(), w.v.x.raw()))),
          half_height_(static_cast<std::int32_t>(hypotenuse(w.u.y.raw(), w.v.y.raw()))) {
        const std::int64_t ux = w.u.x.raw(), uy = w.u.y.raw(), vx = w.v.x.raw(), vy = w.v.y.raw();
        const Real area = Real::from_int(ux * vy - uy * vx);
        const Real share = Real::from_int(1, 46) / (area * area);
        xx_ = (Real::from_int(uy * uy + vy * vy) * share).rounded(0);
        xy_ = (Real::from_int(-2 * (ux * uy + vx * vy)) * share).rounded(0);
        yy_ = (Real::from_int(ux * ux + vx * vx) * share).rounded(0);
    }
    /// In 1/256 px.
    std::int32_t half_width() const { return half_width_; }
    std::int32_t half_height() const { return half_height_; }
    /// 2^10 (1 - a^2 - b^2) at a distance in 1/2048 px from the middle, below 0 outside of the window. Distances
    /// are below 2^18 and factors at most 2^30.
    std::int64_t part(std::int64_t dx, std::int64_t dy) const {
        const std::int64_t sum = ((dx * dx) >> 7) * xx_ + ((dx * dy) >> 7) * xy_ + ((dy * dy) >> 7) * yy_;
        return 1024 - (sum >> 35);
    }

private:
    std::int32_t half_width_;
    std::int32_t half_height_;
    std::int64_t xx_ = 0, xy_ = 0, yy_ = 0;
};

inline SaddleSums saddle_sums(ImageView<const Gray8> src, FinePoint centre, const SaddleWeights& weights) {
    SaddleSums sums;
    const auto first = [](FinePixel c, std::int32_t half) {
        return static_cast<int>(maximum<std::int64_t>((std::int64_t{c.raw()} - half * 256) >> 16, 2));
    };
    const auto last = [](FinePixel c, std::int32_t half, int side) {
        return static_cast<int>(
            minimum<std::int64_t>(((std::int64_t{c.raw()} + half * 256) >> 16) + 1, side - 3));
    };
    const int left = first(centre.x, weights.half_width());
    const int right = last(centre.x, weights.half_width(), src.width());
    const int bottom = last(centre.y, weights.half_height(), src.height());
    for (int y = first(centre.y, weights.half_height()); y <= bottom && left <= right; ++y) {
        SaddleGradients gradients(src, y, left);
        const std::int64_t dy = round_shift((std::int64_t{y} << 16) - centre.y.raw(), 5);
        for (int x = left; x <= right; ++x) {
            int gx = 0;
            int gy = 0;
            gradients.next(gx, gy);
            const std::int64_t dx = round_shift((std::int64_t{x} << 16) - centre.x.raw(), 5);
            const std::int64_t part = weights.part(dx, dy);
            if (part <= 0 || (gx | gy) == 0) continue;
            const std::int64_t weight = (part * part) >> 10;
            const std::int64_t across = gx * dx + gy * dy;
            sums.xx += weight * (gx * gx);
            sums.xy += weight * (gx * gy);
            sums.yy += weight * (gy * gy);
            sums.x += weight * gx * across;
            sums.y += weight * gy * across;
        }
    }
    return sums;
}

/// Whether radii are in range, and the window is not too thin.
constexpr bool is_valid(const SaddleWindow& w) {
    const auto length = [](SubPixelPoint p) { return hypotenuse(p.x.raw(), p.y.raw()); };
    const std::int64_t u = length(w.u);
    const std::int64_t v = length(w.v);
    if (minimum(u, v) < min_saddle_radius.raw() || maximum(u, v) > max_saddle_radius.raw()) return false;
    const std::int64_t area =
        std::int64_t{w.u.x.raw()} * w.v.y.raw() - std::int64_t{w.u.y.raw()} * w.v.x.raw();
    return (area < 0 ? -area : area) >= 256 * maximum(u, v);
}

}  // namespace detail

inline Result<SubPixelPoint> refine_saddle_point(ImageView<const Gray8> src, SubPixelPoint start,
                                                 SubPixel radius) {
    return refine_saddle_point(src, start, {{radius, {}}, {{}, radius}});
}

inline Result<SubPixelPoint> refine_saddle_point(ImageView<const Gray8> src, SubPixelPoint start,
                                                 const SaddleWindow& window) {
    if (src.empty()) return Status::empty_image;
    if (!detail::is_valid(window)) return Status::bad_argument;
    const auto outside = [](SubPixel c, int side) { return c.raw() < 0 || c.raw() > (side - 1) * 256; };
    if (outside(start.x, src.width()) || outside(start.y, src.height())) return Status::out_of_range;

    const FinePoint first{start.x.convert<FinePixel>(), start.y.convert<FinePixel>()};
    FinePoint place = first;
    const detail::SaddleWeights weights(window);
    // Half of the shorter way, in 1/65536 px.
    const std::int64_t reach = minimum(hypotenuse(window.u.x.raw(), window.u.y.raw()),
                                       hypotenuse(window.v.x.raw(), window.v.y.raw()))
                               << 7;
    for (int i = 0; i < 20; ++i) {
        const detail::SaddleSums sums = detail::saddle_sums(src, place, weights);
        const Real xx = Real::from_int(sums.xx);
        const Real xy = Real::from_int(sums.xy);
        const Real yy = Real::from_int(sums.yy);
        const Real size = xx * yy - xy * xy;
        const Real half = (xx + yy).scaled(-1);
        // The ratio of the eigenvalues of two edges that cross at an angle a is tan^2(a / 2).
        if (half.zero() || size < (half * half).scaled(-6)) return Status::degenerate;
        const Real x = Real::from_int(sums.x);
        const Real y = Real::from_int(sums.y);
        const std::int64_t dx = ((yy * x - xy * y) / size).rounded(5);
        const std::int64_t dy = ((xx * y - xy * x) / size).rounded(5);
        const std::int64_t to_x = place.x.raw() + clamp<std::int64_t>(dx, -reach, reach);
        const std::int64_t to_y = place.y.raw() + clamp<std::int64_t>(dy, -reach, reach);
        if (hypotenuse(to_x - first.x.raw(), to_y - first.y.raw()) > reach) return Status::not_found;
        place = {FinePixel::from_raw(static_cast<std::int32_t>(to_x)),
                 FinePixel::from_raw(static_cast<std::int32_t>(to_y))};
        const auto still = [](std::int64_t d) { return d >= -64 && d <= 64; };
        if (still(dx) && still(dy)) {
            const SubPixelPoint answer{place.x.convert<SubPixel>(), place.y.convert<SubPixel>()};
            if (outside(answer.x, src.width()) || outside(answer.y, src.height())) return Status::not_found;
            return answer;
        }
    }
    return Status::not_found;
}

}  // namespace fovea
